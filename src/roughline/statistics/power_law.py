"""Power laws k̄ = zeta F̄^alpha (the paper's eq. 5): fits with intervals, and predictions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.checks import refuse, rising_pair
from roughline.errors.public import public
from roughline.statistics import bootstrap
from roughline.statistics.averages import Averaging, refuse_other_settings
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.student import student
from roughline.statistics.window import inside_window

_Value = TypeVar("_Value", float, Real)


@public
@dataclass(frozen=True)
class PowerLaw:
    """A fitted power law ``stiffness_bar = prefactor * force_bar**exponent``.

    Attributes
    ----------
    exponent, prefactor : float
        The paper's alpha and zeta, by log least squares.
    exponent_interval, prefactor_interval : tuple of float
        Intervals at the stated confidence.
    window : tuple of float
        Range of force_bar that was fitted.
    points : int
        Loads inside the window.
    realisations : int
        Realisations whose mean was fitted; 1 for a single curve.
    confidence : float
        Level of the intervals, such as 0.95.
    interval_from : str
        "resampled realisations" (studentised bootstrap), or "regression" (Student's t) for a
        single curve.
    averaging : {"arithmetic", "geometric"}
        Mean over realisations that was fitted.
    """

    exponent: float
    prefactor: float
    exponent_interval: tuple[float, float]
    prefactor_interval: tuple[float, float]
    window: tuple[float, float]
    points: int
    realisations: int
    confidence: float
    interval_from: str
    averaging: Averaging = "arithmetic"

    def __call__(self, force_bar: _Value) -> _Value:
        """Evaluate the law."""
        return self.prefactor * force_bar**self.exponent


@public
def fit_power_law(
    force_bar: ArrayLike,
    stiffness_bar: ArrayLike,
    window: tuple[float, float],
    confidence: float = 0.95,
    rng: int = 0,
    averaging: Averaging = "arithmetic",
) -> PowerLaw:
    """Fit a power law by least squares of the logarithms inside a window.

    For several realisations the mean at fixed force is fitted, and the intervals come from
    resampling the realisations. For a single curve the intervals come from the scatter about the
    line: they show how straight the curve is, and not how far another surface would differ.

    Parameters
    ----------
    force_bar : array_like, shape (loads,)
        Dimensionless forces.
    stiffness_bar : array_like, shape (loads,) or (realisations, loads)
        Dimensionless stiffness at these forces.
    window : tuple of float
        Smallest and largest force_bar to use, both included.
    confidence : float, optional
        Level of the intervals.
    rng : int, optional
        Seed of the resampling.
    averaging : {"arithmetic", "geometric"}, optional
        Which mean over realisations is fitted.

    Raises
    ------
    InputError
        If the window holds fewer than three loads, or values that are not positive and finite
        (loads that did not converge are NaN: leave them out knowingly).

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> spectrum, forces = rl.SelfAffine(hurst=0.8, rms_height=1.0), np.geomspace(1e-3, 1e-1, 9)
    >>> lines = [spectrum.line(2**12, rng=seed) for seed in range(20)]
    >>> stiffness = [rl.press(line, E_star=1.0, forces=forces).stiffness_bar for line in lines]
    >>> law = rl.fit_power_law(forces, stiffness, window=(1e-3, 1e-1))
    >>> print(round(law.exponent, 2))
    0.51
    >>> low, high = law.exponent_interval
    >>> print(round(low, 2), round(high, 2))
    0.49 0.54
    """
    refuse_other_settings(averaging, confidence, rng)
    force, stiffness = _loads_in_window(force_bar, stiffness_bar, window)
    several = stiffness.shape[0] > 1
    slope, offset = (
        _resampled_line(force, stiffness, confidence, rng, averaging)
        if several
        else _regression_line(np.log(force), np.log(stiffness[0]), confidence)
    )
    return PowerLaw(
        exponent=slope.value,
        prefactor=math.exp(offset.value),
        exponent_interval=(slope.low, slope.high),
        prefactor_interval=(math.exp(offset.low), math.exp(offset.high)),
        window=(float(window[0]), float(window[1])),
        points=force.size,
        realisations=stiffness.shape[0],
        confidence=confidence,
        interval_from="resampled realisations" if several else "regression",
        averaging=averaging,
    )


def line_weights(x: Real) -> tuple[Real, Real]:
    """Return weights of y whose sums are slope and offset of the least-squares line over x."""
    centred = x - x.mean()
    slope = centred / (centred**2).sum()
    return slope, 1 / x.size - slope * x.mean()


def exponent_weights(force_bar: Real, window: tuple[float, float]) -> Real:
    """Return weights of the logarithms at all loads whose sum is the exponent in a window.

    The weights are zero outside the window, and NaN if it holds fewer than three loads.
    """
    inside = inside_window(force_bar, window)
    if np.count_nonzero(inside) < 3:
        return np.full(force_bar.size, np.nan)
    weights = np.zeros(force_bar.size)
    weights[inside] = line_weights(np.log(force_bar[inside]))[0]
    return weights


def scaling_exponent(fractal_dimension: _Value) -> _Value:
    """Exponent from the scaling argument, alpha = 1 / (H + 1) = 1 / (4 - D_f), eq. 14."""
    return 1 / (4 - fractal_dimension)


def linear_exponent(fractal_dimension: _Value) -> _Value:
    """Exponent that the paper reads off its 3D results, alpha = 0.2567 D_f."""
    return 0.2567 * fractal_dimension


def _loads_in_window(
    force_bar: ArrayLike, stiffness_bar: ArrayLike, window: tuple[float, float]
) -> tuple[Real, Real]:
    """Forces and stiffness, shape (realisations, loads), inside the window."""
    force = np.asarray(force_bar, dtype=np.float64)
    stiffness = np.atleast_2d(np.asarray(stiffness_bar, dtype=np.float64))
    if force.ndim != 1 or stiffness.ndim != 2 or stiffness.shape[1] != force.size:
        raise InputError(
            f"force_bar has shape {force.shape} and stiffness_bar {np.shape(stiffness_bar)}; "
            "(loads,) and (loads,) or (realisations, loads) are needed"
        )
    needed = "two rising, positive force_bar are needed"
    low, high = rising_pair("window", window, needed)
    if not low > 0:
        refuse("window", window, needed)
    inside = inside_window(force, window)
    if np.count_nonzero(inside) < 3:
        raise InputError(
            f"the window {low:g} to {high:g} holds too few loads, {np.count_nonzero(inside)}; at "
            f"least 3 are needed: widen it (the loads span {force.min():g} to {force.max():g})"
        )
    stiffness = stiffness[:, inside]
    bad = ~(np.isfinite(stiffness) & (stiffness > 0))
    if bad.any():
        raise InputError(
            f"{np.count_nonzero(bad)} values of stiffness_bar in the window are not positive, "
            "finite numbers (loads that did not converge are NaN): leave their loads or "
            "realisations out"
        )
    return force[inside], stiffness


def _resampled_line(
    force: Real, stiffness: Real, confidence: float, rng: int, averaging: Averaging
) -> list[IntervalEstimate]:
    """Slope and offset of the logarithm of the mean, from resampled realisations."""
    geometric = averaging == "geometric"
    resampled = (
        bootstrap.sum_of_log_means(stiffness, weights, geometric, rng)
        for weights in line_weights(np.log(force))
    )
    return [each.interval_estimate(confidence) for each in resampled]


def _regression_line(x: Real, y: Real, confidence: float) -> list[IntervalEstimate]:
    """Slope and offset of a line, with Student's t of the scatter about it."""
    slope, offset = (float(y @ weights) for weights in line_weights(x))
    freedom = x.size - 2
    variance = float(((y - offset - slope * x) ** 2).sum()) / freedom
    spread = ((x - x.mean()) ** 2).sum()
    width = student(freedom, (1 + confidence) / 2) * np.sqrt(variance / spread)
    offset_width = width * np.sqrt(np.mean(x**2))
    return [
        IntervalEstimate(value, float(value - half), float(value + half))
        for value, half in ((slope, width), (offset, offset_width))
    ]
