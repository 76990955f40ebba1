"""How a surface of the view "Explore" is pressed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.lab.explore.state import ExploreState
from roughline.lab.server.tasks import Progress

_MOST_OF_HARDNESS = 0.9  # of the force under which all yields, where curves end


def borne(state: ExploreState, force_bar: NDArray[np.float64]) -> NDArray[np.float64]:
    """Those of dimensionless forces that the surface bears. [1]"""
    return force_bar[force_bar < _MOST_OF_HARDNESS * state.most_force_bar]


def pressed_under(
    state: ExploreState,
    surface: rl.Surface,
    force_bar: NDArray[Any],
    progress: Progress,
    *,
    fields: bool | Sequence[int] = False,
    grid_error: bool = False,
    measures: Sequence[rl.Measure] = (),
) -> rl.Curve:
    """Press a surface of the state under dimensionless forces."""
    return rl.press(
        surface,
        E_star=state.E_star,
        law=state.law,
        forces=state.force(force_bar),
        periodic=state.periodic,
        fields=fields,
        grid_error=grid_error,
        measures=measures,
        throw=False,
        progress=progress,
    )
