"""What several tests of studies share: a Dask cluster, and the resamples of their bootstraps."""

from functools import cache

import pytest

from dask_processes import cluster_here
from roughline.statistics import bootstrap


@pytest.fixture(scope="package")
def two_workers():
    """Address of a cluster in this process: what studies keep does not depend on processes."""
    with cluster_here(n_workers=2, threads_per_worker=1) as cluster:
        yield cluster.scheduler_address


@pytest.fixture(scope="module", autouse=True)
def drawn_once():
    """Draw the resamples of so many realisations once for all: a page needs them many times."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bootstrap, "_weights", cache(bootstrap._weights.__wrapped__))
        yield
