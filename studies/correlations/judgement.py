"""Verdicts on the correlations: simultaneous intervals, the grid's error, and how many would do."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from conductance import ELASTIC, FINE_HARDNESSES, Sample, sample

from roughline.computing.arrays import Real
from roughline.statistics.averages import average, relative_difference
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Verdict, joint_verdict, verdict

Ratio = Callable[[Sample], Real]

TOLERANCES = (0.1, 0.2)
LEVEL = 0.95
_HALVES = 2.0  # an error that halves with the spacing is twice the difference of two grids


@dataclass(frozen=True)
class RatioInterval:
    """Interval of the mean of a ratio at one pressure.

    Attributes
    ----------
    low, high : float
        Its ends.
    least, most : float
        What the grid alone leaves open of the mean, within them.
    """

    low: float
    least: float
    most: float
    high: float


@dataclass(frozen=True)
class Judgement:
    """What a sample says of a correlation.

    Attributes
    ----------
    verdict : Verdict
        On the correlation at all loads of the window.
    enough : float
        Realisations that would decide where this sample does not, by its scatter; infinite where
        the grid's error leaves it open, NaN where the sample decides.
    """

    verdict: Verdict
    enough: float

    @property
    def what_would_decide(self) -> str:
        """How many realisations would decide; empty where the sample does."""
        if math.isnan(self.enough):
            return ""
        if math.isinf(self.enough):
            return "finer grids would decide"
        digits = 1 - math.floor(math.log10(self.enough))  # it is known no better
        return f"some {math.ceil(round(self.enough, digits)):,} surfaces would decide"


def grid_shift(one: Sample, ratio: Ratio) -> list[IntervalEstimate]:
    """Return by how much a ratio is higher on twice the points, at each pressure.

    The same surfaces are compared, at every other load. Of a hardness that was not pressed on the
    finer grid, the next one is taken.
    """
    hardness = ELASTIC
    if not one.elastic:
        hardness = min(FINE_HARDNESSES, key=lambda each: abs(math.log(each / one.hardness_bar)))
    fine = sample("fine", hardness, one.fractal_dimension)
    coarse = sample("main", hardness, one.fractal_dimension, every=2)
    ends = relative_difference(ratio(fine), ratio(coarse)[: fine.count], paired=True)
    return [IntervalEstimate(*map(float, each)) for each in zip(*ends, strict=True)]


def judge(one: Sample, ratio: Ratio, tolerance: float) -> Judgement:
    """Judge a prediction at all pressures of the window.

    One pressure that refutes it is enough.

    Parameters
    ----------
    one : Sample
        The surfaces.
    ratio : callable
        Returns what they have over what is predicted, shape (realisations, pressures).
    tolerance : float
        How far from 1 the ratio may be.
    """
    simultaneous = simultaneous_intervals(one, ratio)
    verdicts = [verdict(each.low, each.high, 1 - tolerance, 1 + tolerance) for each in simultaneous]
    whole = joint_verdict(verdicts)
    if whole is not Verdict.UNDECIDED:
        return Judgement(whole, math.nan)
    open_ones = [
        _growth_to_decide(each, tolerance)
        for each, found in zip(simultaneous, verdicts, strict=True)
        if found is Verdict.UNDECIDED
    ]
    refuting = [growth for growth, refutes in open_ones if refutes]
    growth = min(refuting) if refuting else max(growth for growth, _ in open_ones)
    return Judgement(whole, one.count * growth)


def simultaneous_intervals(one: Sample, ratio: Ratio) -> list[RatioInterval]:
    """Return the intervals of a ratio that hold at all pressures of the window together.

    They have Bonferroni's level, and are widened on one side by the error of the grid.
    """
    inside = one.in_window
    count = int(np.count_nonzero(inside))
    mean = average(ratio(one)[:, inside], confidence=1 - (1 - LEVEL) / count)
    grid = _HALVES * np.array([shift.value for shift in grid_shift(one, ratio)])[inside]
    down, up = 1 + np.minimum(grid, 0), 1 + np.maximum(grid, 0)
    ends = (mean.low * down, mean.mean * down, mean.mean * up, mean.high * up)
    return [RatioInterval(*map(float, each)) for each in zip(*ends, strict=True)]


def _growth_to_decide(interval: RatioInterval, tolerance: float) -> tuple[float, bool]:
    """By what factor an ensemble has to grow to decide at one pressure, and whether to refute.

    Intervals shrink as the square root of the realisations; what the grid leaves open stays.
    """
    low, least, most, high = interval.low, interval.least, interval.most, interval.high
    bottom, top = 1 - tolerance, 1 + tolerance
    if most < bottom:
        return ((high - most) / (bottom - most)) ** 2, True
    if least > top:
        return ((least - low) / (least - top)) ** 2, True
    if least <= bottom or most >= top:
        return math.inf, False
    widths = ((least - low) / (least - bottom), (high - most) / (top - most))
    return max(widths) ** 2, False
