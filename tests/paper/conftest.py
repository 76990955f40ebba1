"""The paper's study in small, which several tests share."""

from dataclasses import replace

import pytest

from roughline import campaign
from roughline.paper.gallery import Gallery
from roughline.paper.page import write_page
from roughline.paper.plan import ENSEMBLE_FULL, ENSEMBLE_MATCHED, ENSEMBLE_REDUCED, paper_plan
from roughline.paper.results import results_of_store


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


@pytest.fixture(scope="session")
def small_gallery(small_plan):
    return replace(Gallery.of(small_plan, (2.0, 3.0)), n_line=128)


@pytest.fixture(scope="session")
def finished(small_plan, small_gallery, tmp_path_factory):
    path = tmp_path_factory.mktemp("finished") / "store"
    campaign.run(small_plan, path)
    small_gallery.draw(path)
    return path


@pytest.fixture(scope="session")
def results(finished):
    return results_of_store(campaign.Store(finished), name="in small", command="none")


@pytest.fixture(scope="session")
def report(results, tmp_path_factory):
    return write_page(results, tmp_path_factory.mktemp("report"))
