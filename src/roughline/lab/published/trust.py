"""What a point of the trust map says, in one sentence."""

from __future__ import annotations

import numpy as np

from roughline.contact.comparison.trust import Difference, trust_map
from roughline.lab.frames import frame
from roughline.lab.published.ensembles import usable_state
from roughline.lab.published.state import PublishedState
from roughline.lab.server.tasks import Arguments, Progress
from roughline.paper.tables import three_digits


def point(arguments: Arguments, progress: Progress) -> bytes:
    """The sentence of a point, and its verdict."""
    state, settled = usable_state(arguments)
    roll_off = float(state.words["roll_off"])
    found = trust_map().at(state.numbers["map_D_f"], state.numbers["map_F"], roll_off)
    verdict = str(found.verdict(state.numbers["tolerance"]))
    return frame({**settled, "words": {"point": sentence(state, found)}, "verdict": verdict})


def sentence(state: PublishedState, found: Difference) -> str:
    """Say what the map holds at the point of a state."""
    tolerance, dimension, force = (state.numbers[x] for x in ("tolerance", "map_D_f", "map_F"))
    place = f"At D_f = {dimension:#.3g}, F̄ = {three_digits(force)}"
    place += f" and q_r/q_0 = {state.words['roll_off']}"
    if np.isnan(found.value):
        return f"{place} the two models were not compared."
    size = "stiffer" if found.value >= 0 else "softer"
    grid = ", though fewer than ten cells touch in some surface there, so that the grid decides"
    return (
        f"{place}, surfaces are {abs(found.value):.0%} {size} than lines in the mean (95 % "
        f"interval {found.low:+.0%} to {found.high:+.0%}), while single surfaces scatter by "
        f"{found.scatter:.0%}: that both models agree within {tolerance:.0%} is "
        f"{found.verdict(tolerance)}{'' if found.resolved else grid}."
    )
