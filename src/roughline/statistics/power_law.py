"""Power laws k̄ = zeta F̄^alpha (the paper's eq. 5): fits with intervals, and predictions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.statistics import bootstrap
from roughline.statistics.averages import Averaging

Value = TypeVar("Value", float, Real)


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

    def __call__(self, force_bar: Value) -> Value:
        """Evaluate the law."""
        return self.prefactor * force_bar**self.exponent


def fit_power_law(
    force_bar: ArrayLike,
    stiffness_bar: ArrayLike,
    window: tuple[float, float],
    confidence: float = 0.95,
    rng: int = 0,
    averaging: Averaging = "arithmetic",
) -> PowerLaw:
    """Fit a power law by least squares of the logarithms inside a window.

    Of several realisations the mean at fixed force is fitted, and the intervals come from
    resampling the realisations. Of a single curve they come from the scatter about the line,
    which says how straight the curve is rather than how far another surface would differ.

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
    """
    force = np.asarray(force_bar, dtype=np.float64)
    stiffness = np.atleast_2d(np.asarray(stiffness_bar, dtype=np.float64))
    if force.ndim != 1 or stiffness.ndim != 2 or stiffness.shape[1] != force.size:
        raise InputError(
            f"force_bar has shape {force.shape} and stiffness_bar {np.shape(stiffness_bar)}; "
            "(loads,) and (loads,) or (realisations, loads) are needed"
        )
    low, high = window
    if not 0 < low < high:
        raise InputError(f"window is {window}; two rising, positive force_bar are needed")
    if not 0 < confidence < 1:
        raise InputError(f"confidence is {confidence}; a level between 0 and 1 is needed")
    inside = inside_window(force, window)
    if np.count_nonzero(inside) < 3:
        raise InputError(
            f"the window {low:g} to {high:g} holds {np.count_nonzero(inside)} loads; at least 3 "
            f"are needed: widen it (the loads span {force.min():g} to {force.max():g})"
        )
    log_force, stiffness = np.log(force[inside]), stiffness[:, inside]
    bad = ~(np.isfinite(stiffness) & (stiffness > 0))
    if bad.any():
        raise InputError(
            f"{np.count_nonzero(bad)} values of stiffness_bar in the window are not positive, "
            "finite numbers (loads that did not converge are NaN): leave their loads or "
            "realisations out"
        )
    exponent, offset = line_weights(log_force)
    if stiffness.shape[0] > 1:
        found = [
            bootstrap.of_log_means(stiffness, weights, averaging == "geometric", rng)
            for weights in (exponent, offset)
        ]
        values = [float(each.value) for each in found]
        intervals = [each.interval(confidence) for each in found]
    else:
        logs = np.log(stiffness[0])
        values = [float(logs @ weights) for weights in (exponent, offset)]
        intervals = _regression_intervals(log_force, logs, values[0], values[1], confidence)
    ends = [(float(low), float(high)) for low, high in intervals]
    return PowerLaw(
        exponent=values[0],
        prefactor=math.exp(values[1]),
        exponent_interval=ends[0],
        prefactor_interval=(math.exp(ends[1][0]), math.exp(ends[1][1])),
        window=(float(low), float(high)),
        points=log_force.size,
        realisations=stiffness.shape[0],
        confidence=confidence,
        interval_from="resampled realisations" if stiffness.shape[0] > 1 else "regression",
        averaging=averaging,
    )


def find_window(
    force_bar: ArrayLike,
    stiffness_bar: ArrayLike,
    confidence: float = 0.95,
    averaging: Averaging = "arithmetic",
) -> tuple[float, float] | None:
    """Find the longest range of loads in which a power law is not rejected.

    In each range of at least five loads, polynomials of second and third degree, orthogonal to
    the line, are fitted to the logarithms of the mean; the power law is rejected where either
    coefficient differs from zero, by Student's t with its linearised standard error over the
    realisations. The larger the ensemble, the smaller the curvature that is noticed, and the
    shorter the range.

    Parameters
    ----------
    force_bar : array_like, shape (loads,)
        Rising dimensionless forces.
    stiffness_bar : array_like, shape (realisations, loads)
        Dimensionless stiffness, positive and finite, of at least two realisations.
    confidence, averaging
        As for :func:`fit_power_law`; the two tests share the level.

    Returns
    -------
    tuple of float or None
        Smallest and largest load; None if no range of five loads passes.

    Raises
    ------
    InputError
        If the shapes do not fit, or a value is not positive and finite.
    """
    force = np.asarray(force_bar, dtype=np.float64)
    stiffness = np.asarray(stiffness_bar, dtype=np.float64)
    if stiffness.ndim != 2 or stiffness.shape[0] < 2 or stiffness.shape[1:] != force.shape:
        raise InputError(
            f"force_bar has shape {force.shape} and stiffness_bar {stiffness.shape}; (loads,) and "
            "(realisations, loads) with two realisations or more are needed"
        )
    if not (np.isfinite(stiffness) & (stiffness > 0)).all():
        raise InputError("stiffness_bar must be positive and finite: leave other loads out")
    from scipy.special import stdtrit  # here because it loads slowly

    log_force, count = np.log(force), len(stiffness)
    log_mean, moves = _log_mean(stiffness, averaging)
    each = 1 - (1 - confidence) / 4  # Bonferroni: two tests, each of two tails
    largest = stdtrit(count - 1, each) / math.sqrt(count * (count - 1))
    for points in range(force.size, 4, -1):
        lengths = log_force[points - 1 :] - log_force[: force.size - points + 1]
        for first in np.argsort(-lengths, kind="stable"):
            inside = slice(first, first + points)
            bends = _bends(log_force[inside])
            errors = np.sqrt(((moves[:, inside] @ bends) ** 2).sum(axis=0))
            if (np.abs(log_mean[inside] @ bends) <= largest * errors).all():
                return float(force[first]), float(force[first + points - 1])
    return None


def inside_window(force_bar: Real, window: tuple[float, float]) -> NDArray[np.bool_]:
    """Return which loads are in a window; one on its edge belongs to it, rounding or not."""
    return (force_bar >= window[0] * (1 - 1e-9)) & (force_bar <= window[1] * (1 + 1e-9))


def line_weights(x: Real) -> tuple[Real, Real]:
    """Weights of y(x) whose sums are slope and offset of the least-squares line."""
    centred = x - x.mean()
    slope = centred / (centred**2).sum()
    return slope, 1 / x.size - slope * x.mean()


def exponent_weights(force_bar: Real, window: tuple[float, float]) -> Real:
    """Weights of the logarithms at all loads whose sum is the exponent in a window.

    Zero outside the window; NaN if it holds fewer than three loads.
    """
    inside = inside_window(force_bar, window)
    if np.count_nonzero(inside) < 3:
        return np.full(force_bar.size, np.nan)
    weights = np.zeros(force_bar.size)
    weights[inside] = line_weights(np.log(force_bar[inside]))[0]
    return weights


def _bends(x: Real) -> Real:
    """Orthonormal polynomials of second and third degree over x, as columns."""
    scaled = 2 * (x - x[0]) / (x[-1] - x[0]) - 1
    basis, _ = np.linalg.qr(np.vander(scaled, 4, increasing=True))
    return basis[:, 2:]


def _log_mean(stiffness: Real, averaging: Averaging) -> tuple[Real, Real]:
    """Logarithm of the mean, and how far each realisation moves it, times their count."""
    if averaging == "geometric":
        logs = np.log(stiffness)
        mean = logs.mean(axis=0)
        return mean, logs - mean
    mean = stiffness.mean(axis=0)
    return np.log(mean), stiffness / mean - 1


def scaling_exponent(fractal_dimension: Value) -> Value:
    """Exponent from the scaling argument, alpha = 1 / (H + 1) = 1 / (4 - D_f), eq. 14."""
    return 1 / (4 - fractal_dimension)


def linear_exponent(fractal_dimension: Value) -> Value:
    """Exponent that the paper reads off its 3D results, alpha = 0.2567 D_f."""
    return 0.2567 * fractal_dimension


def _regression_intervals(
    x: Real, y: Real, slope: float, offset: float, confidence: float
) -> list[Real]:
    from scipy.special import stdtrit  # here because it loads slowly

    freedom = x.size - 2
    variance = float(((y - offset - slope * x) ** 2).sum()) / freedom
    spread = ((x - x.mean()) ** 2).sum()
    width = stdtrit(freedom, (1 + confidence) / 2) * np.sqrt(variance / spread)
    offset_width = width * np.sqrt(np.mean(x**2))
    sides = np.array([-1.0, 1.0])
    return [slope + sides * width, offset + sides * offset_width]
