"""Cases that fail in a worker: recorded with their reasons, told, and no obstacle to the others."""

import os

import pytest

from roughline import campaign
from small_campaign import run, tree

PATCH = """
import roughline.campaign.batch as batch
original = batch.evaluate_case
def evaluate_case(ensemble, dimension, realisation):
    if (ensemble.name, dimension, realisation) == ("surfaces", 2.4, 2):
        {what}
    return original(ensemble, dimension, realisation)
batch.evaluate_case = evaluate_case
"""


@pytest.mark.parametrize(
    ("what", "reason"),
    [
        ("raise FloatingPointError('the sky fell')", "FloatingPointError: the sky fell"),
        ("raise MemoryError", "MemoryError: "),
        ("import os; os._exit(9)", "its worker died repeatedly, perhaps because memory ran out"),
    ],
)
def test_a_case_that_fails(few_plan_file, few_undisturbed, two_workers, tmp_path, what, reason):
    """It alone, even if it takes its worker and what lies with it along."""
    patched = tmp_path / "patched"
    patched.mkdir()
    (patched / "sitecustomize.py").write_text(PATCH.format(what=what))
    store = tmp_path / "store"
    code, out, err = run(
        few_plan_file, store, "--workers", 1, env={**os.environ, "PYTHONPATH": str(patched)}
    )
    assert code == 1
    assert "Traceback" not in err
    assert "29 cases computed, 1 failed" in out
    assert f"1 failed: {reason}".strip() in out
    found = campaign.Store(store)
    assert found.counts("surfaces") == (11, 1, 12)
    assert found.counts("lines") == (18, 0, 18)
    assert found.failures("surfaces") == {"D_f 2.4, realisation 2": reason}
    # without the fault, the next run mends it and leaves no trace
    summary = campaign.run(campaign.read_plan(few_plan_file), store, scheduler=two_workers)
    assert (summary.done.total(), summary.failed.total()) == (1, 0)
    assert tree(store) == few_undisturbed
