"""What rests on which assumption of a topography, and what is said where the data break one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Literal

from roughline.measurement.departures import FIT_RESTS_ON, Assumption, Departure, departures
from roughline.topography.body import Body

Prediction = Literal["line scan", "larger surface", "part", "theories", "grid", "fit"]
"""What is predicted from a topography beyond the numbers of its own heights."""

_RESTS_ON: Mapping[Prediction, frozenset[Assumption]] = {
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
    return tuple(
        each for each in departures_behind([prediction], body) if takes_down(each, prediction, body)
    )


def departures_behind(predictions: Iterable[Prediction], body: Body) -> tuple[Departure, ...]:
    """Departures of a body from what some predictions rest on, gravest first."""
    return departures(body, frozenset().union(*(_RESTS_ON[each] for each in predictions)))


def takes_down(departure: Departure, prediction: Prediction, body: Body) -> bool:
    """Whether a departure of a body takes down the interval of a prediction.

    Places of a surface that is not Gaussian scatter more than those of a Gaussian one even if it is
    alike everywhere. Tiles of a map show by how much, unless the roughness drifts.
    """
    if departure.assumption not in _RESTS_ON[prediction]:
        return False
    if prediction == "larger surface" and departure.assumption == "stationary":
        return not departures(body, {"gaussian"})
    return True
