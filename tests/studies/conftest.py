"""A Dask cluster that several tests of studies share."""

import pytest

from dask_processes import cluster_here


@pytest.fixture(scope="package")
def two_workers():
    """Address of a cluster in this process: what studies keep does not depend on processes."""
    with cluster_here(n_workers=2, threads_per_worker=1) as cluster:
        yield cluster.scheduler_address
