"""From a power law to proportionality: local exponents, the loads that they pass, and gamma."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import isotonic_regression

from roughline.computing.arrays import Real
from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.statistics import bootstrap
from roughline.statistics.averages import average
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.power_law import line_weights

LINEAR = 1.0
"""Exponent of the linear law."""
BETWEEN_THEM = 0.9
"""Exponent beyond the power law, as it is found on surfaces of many waves."""


@dataclass(frozen=True, eq=False)
class LocalExponents:
    """The exponent d ln k / d ln F of the mean stiffness, over the load."""

    force: Real  # shape (loads,): loads, without the first and the last
    # slope by least squares of the logarithms over three neighbouring loads, and its interval
    value: Real
    low: Real
    high: Real

    def up_to(self, force: float) -> LocalExponents:
        """Return those at loads up to a force."""
        kept = self.force <= force * (1 + 1e-9)
        return LocalExponents(
            *(each[kept] for each in (self.force, self.value, self.low, self.high))
        )


@dataclass(frozen=True)
class Passing:
    """The load at which the local exponent passes a value for good, with its interval."""

    # NaN where the exponent does not pass within the loads; an end is NaN where they do not tell it
    force: IntervalEstimate
    always: bool  # whether the exponent is above that value at all loads
    never: bool  # or at none


def scaling_exponent_of(hurst: float) -> float:
    """Exponent 1 / (1 + H) of the power law."""
    return 1 / (1 + hurst)


def local_exponents(force: Real, stiffness: Real, confidence: float = 0.95) -> LocalExponents:
    """Return the local exponents of the mean stiffness of realisations under rising forces."""
    found = []
    for i in range(1, force.size - 1):
        three = slice(i - 1, i + 2)
        slope, _ = line_weights(np.log(force[three]))
        exponent = bootstrap.sum_of_log_means(stiffness[:, three], slope)
        found.append(exponent.interval_estimate(confidence))
    value, low, high = np.array([(each.value, each.low, each.high) for each in found]).T
    return LocalExponents(force[1:-1], value, low, high)


def passing(exponents: LocalExponents, threshold: float) -> Passing:
    """Return the load at which the exponent passes a threshold upwards, for good.

    The exponent is made monotone by isotonic regression, with the squares of its intervals' widths
    as inverse weights; between two loads it is linear in ln F. The interval reaches from the last
    load whose interval lies below the threshold to the first from which on all lie above.
    """
    x = np.log(exponents.force)
    weights = 1 / (exponents.high - exponents.low) ** 2
    monotone = isotonic_regression(exponents.value, weights=weights).x
    below, above = exponents.high < threshold, exponents.low > threshold
    first = int(np.flatnonzero(below)[-1]) if below.any() else -1
    last = below.size - int(np.argmin(above[::-1])) if not above.all() else 0
    low = math.exp(x[first]) if first >= 0 else math.nan
    high = math.exp(x[last]) if last < x.size else math.nan
    always, never = bool(monotone[0] >= threshold), bool(monotone[-1] < threshold)
    if always or never:
        return Passing(IntervalEstimate(math.nan, low, high), always, never)
    i = int(np.argmax(monotone >= threshold))
    part = (threshold - monotone[i - 1]) / (monotone[i] - monotone[i - 1])
    return Passing(
        IntervalEstimate(math.exp(x[i - 1] + part * (x[i] - x[i - 1])), low, high), False, False
    )


@dataclass(frozen=True)
class CrossOver:
    """What a sample says of the way from the power law to an exponent of 1."""

    leaves: Passing  # the load from which on the exponent is more than 0.05 above 1 / (1 + H)
    halfway: Passing  # the load from which on it is above the middle of 1 / (1 + H) and 0.9
    reaches: Passing  # the load from which on it is less than 0.05 below 1
    # F / (k h) where it is largest, which is where the exponent is 1. Where it is largest under the
    # heaviest load heavier ones may show more: it is NaN there, and so is its upper end
    gamma: IntervalEstimate
    gamma_force: float  # the load there


def cross_over(force: Real, stiffness: Real, hurst: float, confidence: float = 0.95) -> CrossOver:
    """Return where the power law ends, where the exponent nears 1, and gamma.

    Loads beyond that of the largest F / k are not used for these places: there the surface nears
    full contact, and the exponent exceeds 1.
    """
    compliance = force / stiffness.mean(axis=0)
    top = int(np.argmax(compliance))
    there = average(stiffness[:, top : top + 1], confidence=confidence)
    low, high = float(force[top] / there.high[0]), float(force[top] / there.low[0])
    is_inside = top < force.size - 1
    gamma = (
        IntervalEstimate(float(compliance[top]), low, high)
        if is_inside
        else IntervalEstimate(math.nan, low, math.nan)
    )
    rising = local_exponents(force, stiffness, confidence).up_to(force[top])
    scaling = scaling_exponent_of(hurst)
    return CrossOver(
        leaves=passing(rising, scaling + EXPONENT_TOLERANCE),
        halfway=passing(rising, (scaling + BETWEEN_THEM) / 2),
        reaches=passing(rising, LINEAR - EXPONENT_TOLERANCE),
        gamma=gamma,
        gamma_force=float(force[top]),
    )
