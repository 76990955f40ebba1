"""What rests on which assumption of a topography, and what is said where the data break one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

from roughline.assessment.assessment import Assessment
from roughline.assessment.kinds import is_map
from roughline.spectra.departures import FIT_RESTS_ON, Assumption, Departure, departures
from roughline.topography.body import Body

Prediction = Literal["line scan", "larger surface", "part", "theories", "grid", "fit"]
"""What is predicted from a topography beyond the numbers of its own heights."""

RESTS_ON: Mapping[Prediction, frozenset[Assumption]] = {
    # reduced lines of Gaussian surfaces with its spectrum, for a square as long as it
    "line scan": frozenset({"gaussian", "stationary", "measured"}),
    # k_i, h_c and reflection of one map, and all answers of a joint: its tiles have the heights and
    # the lay of the map, and speak for both
    "larger surface": frozenset({"stationary", "steady", "longer waves"}),
    # several maps show how places differ; what none of them shows are longer waves
    "part": frozenset({"longer waves"}),
    "theories": frozenset({"gaussian", "isotropic"}),
    # all intervals of a map: they are of its heights, whatever those are, if they are a surface's
    "grid": frozenset({"measured"}),
    "fit": FIT_RESTS_ON,
}
"""By what is predicted, the assumptions on whose breaking its interval is taken down."""


def broken(prediction: Prediction, body: Body) -> tuple[Departure, ...]:
    """Departures of a body on which a prediction rests, gravest first; empty where it holds."""
    return tuple(each for each in departures(body) if _takes_down(each, prediction, body))


def _takes_down(departure: Departure, prediction: Prediction, body: Body) -> bool:
    """Whether a departure of a body takes down the interval of a prediction.

    Places of a surface that is not Gaussian scatter more than those of a Gaussian one even if it is
    alike everywhere. Tiles of a map show by how much, unless the roughness drifts.
    """
    if departure.assumption not in RESTS_ON[prediction]:
        return False
    if prediction == "larger surface" and departure.assumption == "stationary":
        return all(each.assumption != "gaussian" for each in departures(body))
    return True


def departures_in_words(result: Assessment) -> list[str]:
    """Say how what was pressed departs from assumptions, gravest first, and what that takes down.

    Nothing is said of a departure on which no answer to the question rests. What a line scan
    shows is said where it is pressed.
    """
    said = []
    for departure in departures(result.body):
        down = [
            _without_interval(result, prediction)
            for prediction in _predictions(result)
            if _takes_down(departure, prediction, result.body)
        ]
        if down:
            said.append("; ".join([departure.text, *filter(None, dict.fromkeys(down))]))
    return said


def _predictions(result: Assessment) -> Sequence[Prediction]:
    """What is predicted beyond the body itself."""
    found: list[Prediction] = []
    if result.curve.stiffness_error is not None:
        found.append("grid")
    if is_map(result.body) and result.answers:
        found.append("larger surface")
    if result.theories:
        found.append("theories")
    return found


def _without_interval(result: Assessment, prediction: Prediction) -> str:
    """Say which answers come without an interval, as far as there are any."""
    if prediction == "theories":
        return "theories assume otherwise"
    if prediction == "grid":
        return "all values come without an interval"
    names = [
        each.symbol
        for each in result.answers.values()
        if (result.question.joint or each.rule.is_of_interface)
        and each.low is None
        and not each.rule.is_given
    ]
    if not names:
        return ""
    verb = "comes" if len(names) == 1 else "come"
    return f"{listed(names)} {verb} without an interval"


def listed(names: Sequence[str]) -> str:
    """Write names one after the other."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
