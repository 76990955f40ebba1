"""What the lab shows of the studies: it is what the studies found, and every panel can be drawn."""

import pytest

from roughline.paper.studies import StudySummary, study_summaries
from studies.area.study import STUDY as AREA
from studies.averaging.study import STUDY as AVERAGING
from studies.finite_size.study import STUDY as FINITE_SIZE
from studies.sealing.study import STUDY as SEALING

AGAIN = "what the lab shows is not what the study found any more: run make published"
STUDIES = {each.folder.name: each for each in (AREA, AVERAGING, FINITE_SIZE, SEALING)}


@pytest.mark.parametrize("name", STUDIES)
def test_summaries_are_those_of_the_studies(name):
    kept = next(each for each in study_summaries() if each.name == name)
    found = STUDIES[name].summary
    for part in ("title", "answer", "header", "rows"):
        assert [*getattr(kept, part)] == [
            [*each] if part == "rows" else each for each in getattr(found, part)
        ], AGAIN
    for one, other in zip(kept.panels, found.panels, strict=True):
        for drawn, curve in zip(one.curves, other.curves, strict=True):
            assert drawn.name == curve.name, AGAIN
            assert drawn.y == pytest.approx(list(curve.y), rel=1e-4), AGAIN


def test_every_study_is_there():
    assert {each.name for each in study_summaries()} == set(STUDIES)


def test_panels_hold_their_curves():
    for study in study_summaries():
        assert isinstance(study, StudySummary)
        for panel in study.panels:
            low, high = panel.y_range
            for curve in panel.curves:
                assert len(curve.x) == len(curve.y)
                assert len(curve.low) == len(curve.high)
                assert len(curve.low) in (0, len(curve.x))
                assert all(low <= y <= high for y in curve.y)
