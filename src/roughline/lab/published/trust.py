"""The trust map: where the reduced model may be trusted, and the numbers at a point of it."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.contact.comparison.trust import Difference, TrustMap, trust_map
from roughline.lab.frames import frame
from roughline.lab.published.ensembles import usable_state
from roughline.lab.published.state import PublishedState
from roughline.lab.server.tasks import Arguments, Progress
from roughline.paper.tables import trust_cell
from roughline.units import decimal

_DIGITS = 3


def trust(arguments: Arguments, progress: Progress) -> bytes:
    """The map, a panel for each roll-off ratio, in the colours of the published figure."""
    from matplotlib.colors import to_hex  # here because it loads slowly

    from roughline.plot.models import TRUST_LEVELS, trust_colours

    whole = trust_map()
    colours = [to_hex(colour) for colour in trust_colours()]
    return frame(
        {
            "panels": [
                _panel(whole, i, np.array(TRUST_LEVELS), colours)
                for i in range(whole.roll_off_ratios.size)
            ],
            "legend": [
                {"colour": colour, "text": text}
                for colour, text in zip(colours, _level_texts(TRUST_LEVELS), strict=True)
            ],
        }
    )


def point(arguments: Arguments, progress: Progress) -> bytes:
    """What a point of the map says, in one sentence."""
    state, settled = usable_state(arguments)
    difference = trust_map().at(state.map_D_f, state.map_F, state.roll_off)
    return frame(
        {
            **settled,
            "sentence": sentence(state, difference),
            "verdict": str(difference.verdict(state.tolerance)),
            "difference": vars(difference),
        }
    )


def sentence(state: PublishedState, difference: Difference) -> str:
    """Say what the map holds at the point of a state."""
    place = (
        f"At D_f = {state.map_D_f:g}, F̄ = {decimal(state.map_F, _DIGITS)} and "
        f"q_r/q_0 = {state.roll_off:g}"
    )
    if np.isnan(difference.value):
        return f"{place} the two models were not compared."
    size = "stiffer" if difference.value >= 0 else "softer"
    grid = (
        ""
        if difference.resolved
        else ", though fewer than ten cells touch in some surface there, so that the grid decides"
    )
    return (
        f"{place}, surfaces are {abs(difference.value):.0%} {size} than lines in the mean (95 % "
        f"interval {difference.low:+.0%} to {difference.high:+.0%}), while single surfaces "
        f"scatter by {difference.scatter:.0%}: that both models agree within "
        f"{state.tolerance:.0%} is {difference.verdict(state.tolerance)}{grid}."
    )


def _panel(
    whole: TrustMap, i: int, levels: NDArray[np.float64], colours: list[str]
) -> dict[str, Any]:
    """The cells of one panel, each around its point, and the panel as a table."""
    dimensions, forces = whole.fractal_dimensions, whole.force_bars
    across, up = np.exp(_edges(np.log(forces))), _edges(dimensions)
    shape = dimensions.size, forces.size
    shown = np.digitize(whole.difference[i], levels)
    return {
        "roll_off": f"{whole.roll_off_ratios[i]:g}",
        "left": np.broadcast_to(across[:-1], shape).ravel(),
        "right": np.broadcast_to(across[1:], shape).ravel(),
        "bottom": np.repeat(up[:-1], forces.size),
        "top": np.repeat(up[1:], forces.size),
        "colour": [colours[j] for j in shown.ravel()],
        "resolved": whole.resolved[i].ravel(),
        "header": ["D_f", *(f"F̄ = {decimal(float(force), _DIGITS)}" for force in forces)],
        "rows": [
            [
                f"{dimension:.1f}",
                *(trust_cell(_difference(whole, (i, j, k))) for k in range(forces.size)),
            ]
            for j, dimension in enumerate(dimensions)
        ],
    }


def _difference(whole: TrustMap, at: tuple[int, int, int]) -> Difference:
    """The difference at a point of the grid of the map."""
    return Difference(
        value=float(whole.difference[at]),
        low=float(whole.low[at]),
        high=float(whole.high[at]),
        scatter=float(whole.scatter[at]),
        resolved=bool(whole.resolved[at]),
    )


def _edges(middles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Edges of the cells around evenly spaced points."""
    half = (middles[1] - middles[0]) / 2
    return np.append(middles - half, middles[-1] + half)


def _level_texts(levels: tuple[float, ...]) -> list[str]:
    """What the colours stand for, from the lowest."""
    between = [f"{low:+.0%} to {high:+.0%}" for low, high in pairwise(levels)]
    return [f"below {levels[0]:+.0%}", *between, f"above {levels[-1]:+.0%}"]
