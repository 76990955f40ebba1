"""A physics that is not of the lab: a body that is softer."""

from dataclasses import dataclass

import roughline as rl
from roughline.lab.controls import Number
from roughline.lab.explore.state import Physics, StripFigure


@dataclass(frozen=True)
class Softer(Physics):
    """A body that is so many times softer."""

    times: float

    key = "times"
    tick = "the body is softer"
    meaning = "The body gives way so many times as far."
    controls = (
        Number(
            key="times",
            symbol="s",
            name="softness",
            low=1.0,
            high=10.0,
            default=2.0,
            meaning="Of the body.",
        ),
    )
    unlike = "on the harder body"
    strip = (StripFigure("times", "s", "How many times the body is softer.", after="area"),)

    def half_space(self, state):
        return rl.Homogeneous(state.E_star / self.times, periodic=state.periodic)

    def words(self, pressed, fields, state):
        yield self.strip[0].in_words(f"{self.times:g}")
