"""Verdicts on the correlations: simultaneous intervals, the grid's error, and how many would do."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from roughline.computing.arrays import Real
from roughline.statistics.averages import average, relative_difference
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Verdict, joint_verdict, verdict
from studies.correlations.conductance import ELASTIC, FINE_HARDNESSES, Sample, sample
from studies.judged import Judgement, WidenedInterval, growth_to_decide

Ratio = Callable[[Sample], Real]

TOLERANCES = (0.1, 0.2)
LEVEL = 0.95
_HALVES = 2.0  # an error that halves with the spacing is twice the difference of two grids


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
        growth_to_decide(each, 1 - tolerance, 1 + tolerance)
        for each, found in zip(simultaneous, verdicts, strict=True)
        if found is Verdict.UNDECIDED
    ]
    refuting = [growth for growth, refutes in open_ones if refutes]
    growth = min(refuting) if refuting else max(growth for growth, _ in open_ones)
    return Judgement(whole, one.count * growth)


def simultaneous_intervals(one: Sample, ratio: Ratio) -> list[WidenedInterval]:
    """Return the intervals of a ratio that hold at all pressures of the window together.

    They have Bonferroni's level, and are widened on one side by the error of the grid.
    """
    inside = one.in_window
    count = int(np.count_nonzero(inside))
    mean = average(ratio(one)[:, inside], confidence=1 - (1 - LEVEL) / count)
    grid = _HALVES * np.array([shift.value for shift in grid_shift(one, ratio)])[inside]
    down, up = 1 + np.minimum(grid, 0), 1 + np.maximum(grid, 0)
    ends = (mean.low * down, mean.mean * down, mean.mean * up, mean.high * up)
    return [WidenedInterval(*map(float, each)) for each in zip(*ends, strict=True)]
