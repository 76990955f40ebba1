"""What is read off the samples: exponents in windows, the linear law's range, other models."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np

from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.statistics import bootstrap
from roughline.statistics.averages import average, relative_difference
from roughline.statistics.bootstrap import NO_ESTIMATE, IntervalEstimate
from roughline.statistics.power_law import exponent_weights
from studies.finite_size.crossover import LINEAR, CrossOver, cross_over, local_exponents
from studies.finite_size.samples import BAND, HURSTS, SIZES, Geometry, Sample, persson, sample

SEVERAL = tuple(size for size in SIZES[BAND] if size >= 4)
"""Roll-off waves along a side from which on the size hardly matters where the exponent nears 1."""


@cache
def crossing(
    geometry: Geometry, band: int, size: int, hurst: float, confidence: float = 0.95
) -> CrossOver:
    """Return where the laws of one sample end and begin."""
    one = sample(geometry, band, size, hurst)
    return cross_over(one.force, one.stiffness, hurst, confidence)


def exponent_in(
    one: Sample, window: tuple[float, float], confidence: float = 0.95
) -> IntervalEstimate:
    """Return the exponent of a sample in a window of F / (E* h lambda_r).

    NaN where the loads do not cover the window, or where it reaches beyond the load of gamma.
    """
    weights = exponent_weights(one.force, window)
    beyond = window[1] > crossing(one.geometry, one.band, one.size, one.hurst).gamma_force
    if beyond or not np.isfinite(weights).all():
        return NO_ESTIMATE
    return bootstrap.sum_of_log_means(one.stiffness, weights).interval_estimate(confidence)


def decades_of_linear_law(one: Sample, confidence: float = 0.95) -> tuple[float, float]:
    """Return over how many decades of the load the exponent surely, and perhaps, is 1 within 0.05.

    Surely: the whole interval lies within. Perhaps: a part of it does.
    """
    local = local_exponents(one.force, one.stiffness, confidence)
    low, high = LINEAR - EXPONENT_TOLERANCE, LINEAR + EXPONENT_TOLERANCE
    step = math.log10(local.force[1] / local.force[0])
    sure = np.count_nonzero((local.low >= low) & (local.high <= high))
    perhaps = np.count_nonzero((local.high >= low) & (local.low <= high))
    return sure * step, perhaps * step


def pressures_near_one(band: int, sizes: Sequence[int], hurst: float | None = None) -> list[float]:
    """Return P lambda_r / (E* h) from which on the exponent of periodic surfaces is near 1.

    Of one Hurst exponent, or of all. Surfaces whose loads do not show it are left out.
    """
    found = [
        crossing("periodic", band, size, each).reaches.force.value / size**2
        for size in sizes
        for each in (HURSTS if hurst is None else (hurst,))
    ]
    return [each for each in found if not math.isnan(each)]


def most_by_size() -> float:
    """Return by how much those pressures differ at most between sizes of several waves."""
    by_hurst = [pressures_near_one(BAND, SEVERAL, hurst) for hurst in HURSTS]
    return max(max(each) / min(each) - 1 for each in by_hurst)


def exponents_beside_gamma() -> list[tuple[float, float]]:
    """Return the exponents of periodic surfaces one load before that of gamma, and one after it.

    Cases whose loads do not go on that far are left out.
    """
    found = []
    for size in SIZES[BAND]:
        for hurst in HURSTS:
            one = sample("periodic", BAND, size, hurst)
            local = local_exponents(one.force, one.stiffness)
            top = int(np.argmax(one.gamma)) - 1  # local exponents begin at the second load
            if top + 1 < local.value.size:
                found.append((float(local.value[top - 1]), float(local.value[top + 1])))
    return found


def over_persson(one: Sample, decades_below: float, confidence: float = 0.95) -> IntervalEstimate:
    """Return k over that of Persson's theory, some decades below the load of gamma."""
    top = crossing(one.geometry, one.band, one.size, one.hurst).gamma_force
    place = int(np.argmin(np.abs(np.log(one.force / (top / 10**decades_below)))))
    mean = average(one.stiffness[:, place : place + 1], confidence=confidence)
    ends = (float(each[0]) for each in (mean.mean, mean.low, mean.high))
    return IntervalEstimate(*ends).over(float(persson(one)[place]))


def reduced_over_full(
    size: int, hurst: float, force: float, confidence: float = 0.95
) -> IntervalEstimate:
    """Return the stiffness of the reduced model over that of the free surface, less 1.

    The surface as it is pressed, punch and interface. At the load nearest to F / (E* h lambda_r) =
    `force`; NaN where one of them has none.
    """
    lines, surfaces = (sample(each, BAND, size, hurst) for each in ("lines", "free"))
    shared = np.intersect1d(lines.force, surfaces.force)
    nearest = shared[np.argmin(np.abs(np.log(shared / force)))]
    values = [one.whole[:, one.force == nearest] for one in (lines, surfaces)]
    ends = relative_difference(*values, paired=False, confidence=confidence)
    return IntervalEstimate(*(float(each[0]) for each in ends))


def grid_shift(size: int, hurst: float, force: float | None) -> IntervalEstimate:
    """Return by how much the stiffness is higher with eight cells a wave than with four.

    The wave is the shortest. The same periodic surfaces are compared, at the load nearest to
    F / (E* h lambda_r) = `force`, or at that of gamma if `force` is None.
    """
    fine, coarse = (sample("periodic", BAND, size, hurst, fine=each) for each in (True, False))
    wanted = crossing("periodic", BAND, size, hurst).gamma_force if force is None else force
    shared = np.intersect1d(fine.force, coarse.force)
    nearest = shared[np.argmin(np.abs(np.log(shared / wanted)))]
    values = [
        one.stiffness[: fine.count, one.force == nearest]
        for one in (fine, coarse.first(fine.count))
    ]
    ends = relative_difference(*values, paired=True)
    return IntervalEstimate(*(float(each[0]) for each in ends))
