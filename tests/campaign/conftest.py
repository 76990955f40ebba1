"""Finished campaigns, and a Dask cluster that a test may disturb."""

import pytest

from dask_processes import start_scheduler, start_worker
from roughline import campaign
from small_campaign import FEW, PLAN, tree


@pytest.fixture(scope="session")
def plan_file(tmp_path_factory):
    """The small campaign's plan."""
    path = tmp_path_factory.mktemp("plan") / "plan.toml"
    path.write_text(PLAN)
    return path


@pytest.fixture(scope="session")
def finished(plan_file, tmp_path_factory):
    """Its store, computed by this machine's workers; for reading, or to be copied."""
    path = tmp_path_factory.mktemp("finished") / "store.zarr"
    told = []
    summary = campaign.run(
        campaign.read_plan(plan_file), path, progress=lambda *told_now: told.append(told_now)
    )
    assert (summary.done["lines"], summary.done["surfaces"]) == (180, 27)
    assert told[:2] == [("lines", 0, 0, 180), ("surfaces", 0, 0, 27)]
    assert ("lines", 180, 0, 180) in told
    assert ("surfaces", 27, 0, 27) in told
    return path


@pytest.fixture(scope="session")
def undisturbed(finished):
    """Every byte of that store."""
    return tree(finished)


@pytest.fixture(scope="session")
def few_plan_file(tmp_path_factory):
    """A plan of 30 cases."""
    path = tmp_path_factory.mktemp("few") / "plan.toml"
    path.write_text(FEW)
    return path


@pytest.fixture(scope="session")
def few_undisturbed(few_plan_file, tmp_path_factory):
    """Every byte of its store, computed by one worker."""
    path = tmp_path_factory.mktemp("few_undisturbed") / "store"
    campaign.run(campaign.read_plan(few_plan_file), path, workers=1)
    return tree(path)


@pytest.fixture
def dask_cluster(tmp_path):
    """A scheduler with two workers: its process and its address."""
    scheduler, address = start_scheduler(tmp_path)
    workers = [start_worker(address, "--nthreads", "1") for _ in range(2)]
    yield scheduler, address
    for process in (*workers, scheduler):
        process.kill()
        process.wait()


@pytest.fixture(scope="package")
def two_workers(tmp_path_factory):
    """Address of a scheduler with two workers, for campaigns whose own processes do not matter."""
    scheduler, address = start_scheduler(tmp_path_factory.mktemp("two_workers"))
    workers = [start_worker(address, "--nthreads", "1") for _ in range(2)]
    yield address
    for process in (*workers, scheduler):
        process.kill()
        process.wait()
