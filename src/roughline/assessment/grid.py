"""Whether the grid's error is estimated, and what is said where it is not."""

from __future__ import annotations

from roughline.assessment.loads import LoadCase
from roughline.assessment.question import Question
from roughline.errors.words import called
from roughline.topography.body import Body, Line, Surface

_COARSENED_FROM = 64  # points a side from which on the grid's error is estimated unasked
_CHEAP = 2**24  # points times loads up to which that takes a few seconds


def grid_error_is_estimated(question: Question, body: Body, case: LoadCase) -> bool:
    """Whether the grid's error is estimated: as the question says, or else where that is cheap."""
    if question.grid_error is not None or isinstance(body, Line):
        return bool(question.grid_error)
    cheap = question.whole_curve or body.heights.size * case.count <= _CHEAP
    return cheap and min(body.shape) >= _COARSENED_FROM


def why_without_grid_error(question: Question, body: Surface, tried: bool) -> str:
    """Say that values come without an interval, and why; `tried` if Ctrl-C stopped the estimate."""
    if tried:
        why = "interrupted before"
    elif question.grid_error is not None:
        why = "switched off"
    elif min(body.shape) < _COARSENED_FROM:
        why = (
            f"fewer than {_COARSENED_FROM} points a side; with {called('grid_error', True)} it "
            "is estimated nevertheless"
        )
    else:
        asked = called("grid_error", True)
        why = f"that takes about twice as long; with {asked} it is estimated"
    return f"grid error not estimated, so values come without intervals ({why})"
