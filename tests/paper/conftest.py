"""The paper's study in small, which several tests share."""

from contextlib import contextmanager
from dataclasses import replace

import pytest

from blank_figures import blank_but
from dask_processes import cluster_here, unhurried
from roughline import campaign
from roughline.computing import fft
from roughline.paper import page
from roughline.paper.gallery import Gallery
from roughline.paper.page import write_page
from roughline.paper.plan import ENSEMBLE_FULL, ENSEMBLE_MATCHED, ENSEMBLE_REDUCED, paper_plan
from roughline.paper.results import results_of_store
from roughline.statistics import bootstrap


@pytest.fixture(scope="session")
def small_plan():
    """Return the paper's plan on small grids, with its loads."""
    plan = paper_plan("quick", seed=5)
    sizes = {ENSEMBLE_REDUCED: (2**14, 6), ENSEMBLE_MATCHED: (2**12, 6), ENSEMBLE_FULL: (24, 4)}
    ensembles = tuple(
        replace(
            ensemble,
            fractal_dimensions=(2.0, 2.4, 3.0),
            n=sizes[ensemble.name][0],
            realisations=sizes[ensemble.name][1],
            cutoff_ratio=12 if ensemble.name == ENSEMBLE_MATCHED else None,
        )
        for ensemble in plan.ensembles
    )
    return replace(plan, ensembles=ensembles)


@pytest.fixture(scope="package")
def small_gallery(small_plan):
    return replace(Gallery.of(small_plan, (2.0, 3.0)), n_line=128)


@pytest.fixture(scope="package")
def two_workers():
    """Address of a cluster in this process."""
    before = fft.threads()
    with unhurried(), cluster_here(n_workers=2, threads_per_worker=1) as cluster:
        yield cluster.scheduler_address
    fft.set_threads(before)


@pytest.fixture(scope="package")
def finished(small_plan, small_gallery, two_workers, tmp_path_factory):
    path = tmp_path_factory.mktemp("finished") / "store"
    campaign.run(small_plan, path, scheduler=two_workers)
    small_gallery.draw(path)
    return path


@pytest.fixture(scope="package")
def results(finished):
    return results_of_store(campaign.Store(finished), name="in small", command="none")


@pytest.fixture(scope="package", params=["one figure", "all figures"])
def report(request, results, tmp_path_factory):
    """Return the page of the study in small; with one figure alone, of few resamples, too."""
    with pytest.MonkeyPatch.context() as patch:
        out = tmp_path_factory.mktemp("report")
        if request.param == "all figures":
            return write_page(results, out)[0]
        blank_but(patch, "figure_2")
        with of_few_resamples():
            return write_page(results, out)[0]


@pytest.fixture
def few_resamples():
    """Let intervals follow from a tenth of the resamples."""
    with of_few_resamples():
        yield


@contextmanager
def of_few_resamples():
    """The full study, whose laws are kept for all tests, does not stand behind these."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(page, "larger_study", lambda results: None)
        patch.setattr(bootstrap, "ROUNDS", 199)
        bootstrap._weights.cache_clear()
        yield
    bootstrap._weights.cache_clear()
