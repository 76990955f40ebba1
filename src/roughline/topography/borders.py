"""Whether opposite borders of heights meet, as those of a periodic body do."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughline.computing.arrays import Real
from roughline.facts.fact import Fact
from roughline.topography.settings import Settings
from roughline.units import decimal

_JUMP = 1e-3  # chance below which a step across the borders is no ordinary one
_UNCLEAR = (1e-6, 1e-2)  # chances between which the heights leave it open
_FEWEST_POINTS = 8  # points along a side whose borders can be judged
_PLACES = 128  # along a side, at which ordinary steps are taken
_STEPS = 2**16  # ordinary steps that are taken at least, if there are as many
_HEIGHT_ROUNDING = (
    32 * np.finfo(np.float64).eps
)  # of the largest height, below which nothing is a step
_LEAST_VARIANCE = 1e-6  # least relative variance of ordinary steps


@dataclass(frozen=True)
class Borders:
    """The step of heights across opposite borders, compared with ordinary steps."""

    # across the borders over the ordinary one between neighbours, along the side where it is least
    # likely [1]
    step: float
    chance: float  # chance of such a step or a larger one, if the heights are periodic [1]

    @property
    def jump(self) -> bool:
        """Whether opposite borders do not meet, so that the heights are a piece."""
        return self.chance < _JUMP

    @property
    def are_unclear(self) -> bool:
        """Whether the step across is neither an ordinary one nor clearly none."""
        return _UNCLEAR[0] < self.chance < _UNCLEAR[1]

    @property
    def record(self) -> Settings:
        """What the settings of a body record."""
        return {"border_step": self.step, "border_chance": self.chance}

    def in_words(self, borders: str) -> str:
        """Say how the opposite borders of a surface, or the ends of a line, lie to each other."""
        how_far = (
            f"{decimal(self.step, 2)} ordinary steps" if math.isfinite(self.step) else "a step"
        )
        return f"{'unclear: ' if self.are_unclear else ''}{borders} are {how_far} apart"


def compare_borders(heights: Real) -> Borders:
    """Compare the step across opposite borders with ordinary steps.

    Heights that are repeated periodically have no border: the step across is a step as any other.
    The size of a step at one place is the mean of the roots of its differences of height along the
    border, to the fourth power, which spikes and scratches hardly move. Over the places along the
    side it has about a gamma distribution with the mean and the variance that are found within.
    The chance of the step across follows from it. A slope of the whole and a piece of a larger
    surface both raise the step across.
    """
    least = Borders(0.0, 1.0)
    rounding = _HEIGHT_ROUNDING * float(max(heights.max(), -heights.min()))
    for axis, n in enumerate(heights.shape):
        if n < _FEWEST_POINTS:
            continue
        found = _along(np.moveaxis(heights, axis, 0).reshape(n, -1), rounding)
        if found.chance <= least.chance:
            is_tie = found.chance == least.chance
            least = least if is_tie and least.step > found.step else found
    return least


class _StatedBorders(Protocol):
    """What is asked of the provenance of a body."""

    @property
    def borders(self) -> Borders | None: ...


class _BodyWithBorders(Protocol):
    """What is asked of a Surface or a Line."""

    @property
    def heights(self) -> Real: ...
    @property
    def is_cut_out(self) -> bool: ...
    @property
    def provenance(self) -> _StatedBorders: ...


def decided(body: _BodyWithBorders) -> Borders | None:
    """Return what was seen at the borders of a body; None if its heights did not decide."""
    borders = body.provenance.borders
    # a body of which its owner said otherwise since is as that says
    return borders if borders is not None and borders.jump == body.is_cut_out else None


def whole_or_piece(body: _BodyWithBorders) -> str:
    """Say whether a body is periodic or cut out, and why where its heights decided that."""
    name, borders = "cut out of a larger one" if body.is_cut_out else "periodic", decided(body)
    return name if borders is None else f"{name} ({borders.in_words(_borders_name(body))})"


def border_doubts(body: _BodyWithBorders) -> tuple[Fact, ...]:
    """Warn where the heights do not say clearly whether a body is a piece of a larger one."""
    borders = decided(body)
    if borders is None or not borders.are_unclear:
        return ()
    taken = {"is_map": body.heights.ndim == 2, "is_cut_out": body.is_cut_out}
    return (Fact("borders_unclear", steps=borders.step, **taken),)


def _borders_name(body: _BodyWithBorders) -> str:
    return "opposite borders" if body.heights.ndim == 2 else "its ends"


def _along(rows: Real, rounding: float) -> Borders:
    """Compare the step from the last row to the first with those between neighbouring rows."""
    n, across = rows.shape
    places = min(n - 1, max(_PLACES, _STEPS // across))
    at = np.linspace(0, n - 2, places).astype(np.intp)
    steps = np.abs(rows[at + 1] - rows[at])
    jump = np.abs(rows[0] - rows[-1])
    largest = float(max(steps.max(), jump.max()))
    if jump.max() <= rounding:
        return Borders(0.0, 1.0)
    if steps.max() <= rounding:
        return Borders(math.inf, 0.0)
    within = np.sqrt(steps / largest).mean(axis=1) ** 4
    over_borders = float(np.sqrt(jump / largest).mean() ** 4)
    from scipy import special  # here because it loads slowly

    mean = float(within.mean())
    variance = max(float(within.var(ddof=1)) / mean**2, _LEAST_VARIANCE)
    ratio = over_borders / mean
    chance = float(special.gammaincc(1 / variance, ratio / variance))
    return Borders(math.sqrt(ratio), chance)
