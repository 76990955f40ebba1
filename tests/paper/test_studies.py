"""What the lab shows of the studies: it is what the studies found, in words and pictures."""

import pytest

from roughline.paper.studies import study_summaries
from studies.area.study import STUDY as AREA
from studies.averaging.study import STUDY as AVERAGING
from studies.finite_size.study import STUDY as FINITE_SIZE
from studies.paper import shown
from studies.sealing.study import STUDY as SEALING

AGAIN = "what the lab shows is not what the study found any more: run make published"
STUDIES = {each.folder.name: each for each in (AREA, AVERAGING, FINITE_SIZE, SEALING)}


def told(summary):
    """Return all words and numbers of a summary."""
    table = [list(summary.header), *map(list, summary.rows)]
    pictures = [{**vars(each), "size": list(each.size)} for each in summary.pictures]
    return [summary.name, summary.title, summary.answer, table, pictures]


@pytest.mark.parametrize("name", STUDIES)
def test_summaries_are_those_of_the_studies(name):
    """The ends of all curves are among the words of their pictures."""
    assert told(study_summaries()[name]) == told(STUDIES[name].summary), AGAIN


def test_the_claims_and_the_words_of_the_bodies_are_those_of_the_paper(published_results):
    kept = study_summaries()["paper"]
    assert told(kept) == told(shown.summary(published_results)), AGAIN
    assert len(kept.pictures) == len(shown.drawings(published_results))


def test_every_study_is_there():
    assert {*study_summaries()} == {*STUDIES, "paper"}


@pytest.mark.parametrize("name", STUDIES)
def test_panels_hold_their_curves(name):
    for panel in STUDIES[name].panels():
        low, high = panel.y_range
        for curve in panel.curves:
            assert len(curve.x) == len(curve.y)
            assert len(curve.low) == len(curve.high)
            assert len(curve.low) in (0, len(curve.x))
            assert all(low <= y <= high for y in curve.y)
