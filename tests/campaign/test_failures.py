"""Cases that fail in a worker: recorded with their reasons, told, and no obstacle to the others."""

import os

import dask
import pytest

from roughline import campaign
from roughline.campaign import cluster
from small_campaign import run, tree

FAILING = """
import os
import roughline.campaign.batch as batch
def evaluate_case(ensemble, dimension, realisation, original=batch.evaluate_case):
    if ensemble.name == "surfaces":
        if (dimension, realisation) == (2.4, 2):
            raise FloatingPointError("the sky fell")
        if (dimension, realisation) == (2.0, 3):
            raise MemoryError
        if (dimension, realisation) == (2.4, 1):
            os._exit(9)
    return original(ensemble, dimension, realisation)
batch.evaluate_case = evaluate_case
"""


REASONS = {
    "D_f 2, realisation 3": "MemoryError: ",
    "D_f 2.4, realisation 1": "its worker died repeatedly, perhaps because memory ran out",
    "D_f 2.4, realisation 2": "FloatingPointError: the sky fell",
}


@pytest.mark.parametrize("where", ["here", "there"])
def test_cases_that_fail(
    few_plan_file, few_undisturbed, two_workers, invoke, monkeypatch, tmp_path, where
):
    """They alone, even where one takes its worker and what lies with it along."""
    store = tmp_path / "store"
    if where == "here":
        # one death is enough, and every worker has the fault when it has started
        faults = {key: [FAILING, *each] for key, each in cluster._SILENT_WHEN_CLOSED.items()}
        monkeypatch.setattr(cluster, "_SILENT_WHEN_CLOSED", faults)
        with dask.config.set({"distributed.scheduler.allowed-failures": 0}):
            code, out, err = invoke("campaign", "run", few_plan_file, store=store, workers=1)
    else:
        failing = tmp_path / "failing"
        failing.mkdir()
        (failing / "sitecustomize.py").write_text(FAILING)
        fault = {**os.environ, "PYTHONPATH": str(failing)}
        code, out, err = run(few_plan_file, store, "--workers", 1, env=fault)
    assert code == 1
    assert "Traceback" not in err
    assert "27 cases computed, 3 failed" in out
    for reason in REASONS.values():
        assert f"1 failed: {reason}".strip() in out
    found = campaign.Store(store)
    assert found.counts("surfaces") == (9, 3, 12)
    assert found.counts("lines") == (18, 0, 18)
    assert found.failures("surfaces") == REASONS
    # without the fault, the next run mends them and leaves no trace
    summary = campaign.run(campaign.read_plan(few_plan_file), store, scheduler=two_workers)
    assert (summary.done.total(), summary.failed.total()) == (3, 0)
    assert tree(store) == few_undisturbed
