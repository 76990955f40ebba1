"""Finished campaigns, and Dask clusters of which some may be disturbed."""

import pytest

from dask_processes import cluster_here, start_scheduler, start_worker, unhurried
from roughline import campaign
from roughline.computing import fft
from small_campaign import FEW, PLAN, tree


@pytest.fixture(scope="package", autouse=True)
def _unhurried():
    with unhurried():
        yield


@pytest.fixture(scope="session", params=["few", "many"])
def size(request):
    """Which campaign: one of 30 cases, or of 207 in many batches."""
    return request.param


@pytest.fixture(scope="session")
def few_plan_file(tmp_path_factory):
    """A plan of 30 cases."""
    return plan_in(tmp_path_factory.mktemp("few"), FEW)


@pytest.fixture(scope="session")
def many_plan_file(tmp_path_factory):
    """A plan of 207 cases."""
    return plan_in(tmp_path_factory.mktemp("many"), PLAN)


def plan_in(folder, text):
    (folder / "plan.toml").write_text(text)
    return folder / "plan.toml"


@pytest.fixture(scope="session")
def plan_file(size, request):
    """The small campaign's plan."""
    return request.getfixturevalue(f"{size}_plan_file")


@pytest.fixture(scope="session")
def few_finished(few_plan_file, tmp_path_factory):
    """The store of 30 cases, computed by this machine's workers; for reading, or to be copied."""
    return computed(few_plan_file, tmp_path_factory.mktemp("few_finished") / "store.zarr")


def computed(plan_file, path):
    plan, told = campaign.read_plan(plan_file), []
    summary = campaign.run(plan, path, progress=lambda *told_now: told.append(told_now))
    cases = {ensemble.name: ensemble.cases for ensemble in plan.ensembles}
    assert summary.done == cases
    assert told[:2] == [(name, 0, 0, count) for name, count in cases.items()]
    assert {(name, count, 0, count) for name, count in cases.items()} <= {*told}
    return path


@pytest.fixture(scope="session")
def finished(size, plan_file, request, tmp_path_factory):
    """The small campaign's store."""
    if size == "few":
        return request.getfixturevalue("few_finished")
    return computed(plan_file, tmp_path_factory.mktemp("many_finished") / "store.zarr")


@pytest.fixture(scope="session")
def undisturbed(finished):
    """Every byte of that store."""
    return tree(finished)


@pytest.fixture(scope="session")
def few_undisturbed(few_finished):
    """Every byte of the store of 30 cases."""
    return tree(few_finished)


@pytest.fixture
def dask_cluster(tmp_path):
    """A scheduler with a worker, as processes of their own: its process and its address."""
    scheduler, address = start_scheduler(tmp_path)
    worker = start_worker(address, "--nthreads", "1")
    yield scheduler, address
    for process in (worker, scheduler):
        process.kill()
        process.wait()


@pytest.fixture(scope="package")
def two_workers():
    """Address of a cluster in this process, for campaigns whose own processes do not matter."""
    with cluster_here(n_workers=2, threads_per_worker=1) as cluster:
        yield cluster.scheduler_address


@pytest.fixture
def cluster_without_workers():
    """Address of such a cluster in which nobody works."""
    with cluster_here(n_workers=0) as cluster:
        yield cluster.scheduler_address


@pytest.fixture(autouse=True)
def as_many_threads():
    """Compute with as many threads as before after a campaign in this process."""
    before = fft.threads()
    yield
    fft.set_threads(before)
