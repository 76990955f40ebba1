"""What a point of the trust map says, in one sentence."""

from __future__ import annotations

from roughline.comparison.trust import trust_map
from roughline.lab.frames import frame
from roughline.lab.published.ensembles import usable_state
from roughline.lab.server.tasks import Arguments, Progress
from roughline.paper.tables import three_digits


def point(arguments: Arguments, progress: Progress) -> bytes:
    """The sentence of a point, and its verdict."""
    state, settled = usable_state(arguments)
    dimension, force, tolerance = (state[x] for x in ("map_D_f", "map_F", "tolerance"))
    roll_off = state["roll_off"]
    found = trust_map().at(dimension, force, float(roll_off))
    verdict = found.verdict(tolerance)
    # no interval ends at -0%
    ends = " to ".join(f"{round(end, 2) + 0.0:+.0%}" for end in (found.low, found.high))
    size = "stiffer" if found.value >= 0 else "softer"
    grid = ", though fewer than ten cells touch in some surface there, so that the grid decides"
    sentence = (
        f"At D_f = {dimension:#.3g}, F̄ = {three_digits(force)} and q_r/q_0 = {roll_off}, surfaces "
        f"are {abs(found.value):.0%} {size} than lines in the mean (95 % interval {ends}), while "
        f"single surfaces scatter by {found.scatter:.0%}: that both models agree within "
        f"{tolerance:.0%} is {verdict}{'' if found.resolved else grid}."
    )
    return frame({**settled, "words": {"point": sentence}, "verdict": str(verdict)})
