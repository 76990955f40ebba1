"""Cases that fail in a worker: recorded with their reasons, told, and no obstacle to the others."""

import os

import pytest

from roughline import campaign
from small_campaign import PLAN, run, tree

PATCH = """
import roughline.campaign.batch as batch
original = batch.evaluate_case
def evaluate_case(ensemble, dimension, realisation):
    if (ensemble.name, dimension, realisation) == ("surfaces", 2.4, 2):
        {what}
    return original(ensemble, dimension, realisation)
batch.evaluate_case = evaluate_case
"""


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    path = tmp_path_factory.mktemp("plan") / "plan.toml"
    path.write_text(PLAN.replace("= 60", "= 6").replace("= 62", "= 5"))
    return path


@pytest.fixture(scope="module")
def calm(plan, two_workers, tmp_path_factory):
    """Every byte of the store of a campaign in which nothing fails."""
    store = tmp_path_factory.mktemp("calm") / "store"
    campaign.run(campaign.read_plan(plan), store, scheduler=two_workers)
    return tree(store)


@pytest.mark.parametrize(
    ("what", "reason"),
    [
        ("raise FloatingPointError('the sky fell')", "FloatingPointError: the sky fell"),
        ("raise MemoryError", "MemoryError: "),
        ("import os; os._exit(9)", "its worker died again and again, perhaps for want of memory"),
    ],
)
def test_a_case_that_fails(plan, calm, two_workers, tmp_path, what, reason):
    """It alone, even if it takes its worker and what lies with it along."""
    patched = tmp_path / "patched"
    patched.mkdir()
    (patched / "sitecustomize.py").write_text(PATCH.format(what=what))
    store = tmp_path / "store"
    code, out, err = run(plan, store, env={**os.environ, "PYTHONPATH": str(patched)})
    assert code == 1
    assert "Traceback" not in err
    assert "32 cases computed, 1 failed" in out
    assert f"1 failed: {reason}".strip() in out
    found = campaign.Store(store)
    assert found.counts("surfaces") == (14, 1, 15)
    assert found.counts("lines") == (18, 0, 18)
    assert found.failures("surfaces") == {"D_f 2.4, realisation 2": reason}
    # without the fault, the next run mends it and leaves no trace
    summary = campaign.run(campaign.read_plan(plan), store, scheduler=two_workers)
    assert (summary.done.total(), summary.failed.total()) == (1, 0)
    assert tree(store) == calm
