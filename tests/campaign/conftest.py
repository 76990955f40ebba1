"""A Dask cluster for the tests of campaigns."""

import pytest

from dask_processes import start_scheduler, start_worker


@pytest.fixture
def dask_cluster(tmp_path):
    """A scheduler with two workers: its process and its address."""
    scheduler, address = start_scheduler(tmp_path)
    workers = [start_worker(address, "--nthreads", "1") for _ in range(2)]
    yield scheduler, address
    for process in (*workers, scheduler):
        process.kill()
        process.wait()
