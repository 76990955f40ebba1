"""Windows: the ranges of loads in which a power law is fitted, and the search for the longest."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Mask, Real
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.statistics.averages import Averaging, refuse_other_settings
from roughline.statistics.student import student


def inside_window(force_bar: Real, window: tuple[float, float]) -> Mask:
    """Return which loads are in a window; its edges belong to it, whatever their rounding."""
    return (force_bar >= window[0] * (1 - 1e-9)) & (force_bar <= window[1] * (1 + 1e-9))


@public
def find_window(
    force_bar: ArrayLike,
    stiffness_bar: ArrayLike,
    confidence: float = 0.95,
    averaging: Averaging = "arithmetic",
) -> tuple[float, float] | None:
    """Find the longest range of loads in which a power law is not rejected.

    In each range of at least five loads, polynomials of second and third degree, orthogonal to
    the line, are fitted to the logarithms of the mean. The power law is rejected where one of the
    two coefficients differs from zero by Student's t, with its linearised standard error over the
    realisations. A larger ensemble shows a smaller curvature, and so gives a shorter range.

    Parameters
    ----------
    force_bar : array_like, shape (loads,)
        Rising dimensionless forces.
    stiffness_bar : array_like, shape (realisations, loads)
        Dimensionless stiffness, positive and finite, of at least two realisations.
    confidence, averaging
        As for :func:`roughline.fit_power_law`; the level is that of both tests together.

    Returns
    -------
    tuple of float or None
        Smallest and largest load; None if no range of five loads passes.

    Raises
    ------
    InputError
        If the shapes do not fit, or a value is not positive and finite.
    """
    refuse_other_settings(averaging, confidence)
    force = np.asarray(force_bar, dtype=np.float64)
    stiffness = np.asarray(stiffness_bar, dtype=np.float64)
    if stiffness.ndim != 2 or stiffness.shape[0] < 2 or stiffness.shape[1:] != force.shape:
        raise InputError(
            f"force_bar has shape {force.shape} and stiffness_bar {stiffness.shape}; (loads,) and "
            "(realisations, loads) with two realisations or more are needed"
        )
    if not ((force > 0).all() and (np.diff(force) > 0).all() and np.isfinite(force).all()):
        raise InputError("must be positive, finite and rising: sort the loads", "force_bar")
    if not (np.isfinite(stiffness) & (stiffness > 0)).all():
        raise InputError("stiffness_bar must be positive and finite: leave other loads out")
    log_force, count = np.log(force), len(stiffness)
    log_mean, moves = _log_mean(stiffness, averaging)
    tail = 1 - (1 - confidence) / 4  # Bonferroni: two tests, each of two tails
    largest = student(count - 1, tail) / math.sqrt(count * (count - 1))
    for points in range(force.size, 4, -1):
        lengths = log_force[points - 1 :] - log_force[: force.size - points + 1]
        for first in np.argsort(-lengths, kind="stable"):
            inside = slice(first, first + points)
            curvature = _curvature_weights(log_force[inside])
            errors = np.sqrt(((moves[:, inside] @ curvature) ** 2).sum(axis=0))
            if (np.abs(log_mean[inside] @ curvature) <= largest * errors).all():
                return float(force[first]), float(force[first + points - 1])
    return None


def _curvature_weights(x: Real) -> Real:
    """Orthonormal polynomials of second and third degree over x, as columns."""
    scaled = 2 * (x - x[0]) / (x[-1] - x[0]) - 1
    basis, _ = np.linalg.qr(np.vander(scaled, 4, increasing=True))
    return basis[:, 2:]


def _log_mean(stiffness: Real, averaging: Averaging) -> tuple[Real, Real]:
    """Logarithm of the mean, and how far each realisation moves it, times their number."""
    if averaging == "geometric":
        logs = np.log(stiffness)
        mean = logs.mean(axis=0)
        return mean, logs - mean
    mean = stiffness.mean(axis=0)
    return np.log(mean), stiffness / mean - 1
