"""How a surface of the view "Explore" is pressed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.lab.explore.state import ExploreState
from roughline.lab.server.tasks import Progress

CURVE_POINTS = 256
"""Points along a side of the surface whose whole curve is computed."""
_LARGEST_FORCE_SHARE = 0.9  # of the force that all of the area bears, where curves end


def bearable_forces(state: ExploreState, force_bar: NDArray[np.float64]) -> NDArray[np.float64]:
    """Those of dimensionless forces that the surface bears. [1]"""
    return force_bar[force_bar < _LARGEST_FORCE_SHARE * state.most_force_bar]


def pressed_under(
    state: ExploreState,
    surface: rl.Surface,
    force_bar: NDArray[Any] | None,
    progress: Progress,
    **others: Any,
) -> rl.SurfaceCurve:
    """Press a surface of the state under dimensionless forces, or under what others say."""
    return rl.press(
        surface,
        half_space=state.half_space,
        law=state.law,
        forces=None if force_bar is None else state.force(force_bar),
        throw=False,
        progress=progress,
        **others,
    )
