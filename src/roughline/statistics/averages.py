"""Averages of an ensemble at fixed force or fixed level, with intervals over realisations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import Resampled

Averaging = Literal["arithmetic", "geometric"]


@dataclass(frozen=True, eq=False)
class Average:
    """Mean of a quantity over realisations, at each load.

    Attributes
    ----------
    mean : ndarray, shape (loads,)
        Arithmetic or geometric mean.
    low, high : ndarray, shape (loads,)
        Ends of its studentised interval, from resampled realisations.
    scatter : ndarray, shape (loads,)
        Standard deviation of the realisations; of the logarithm if the mean is geometric.
    standard_error : ndarray, shape (loads,)
        Scatter over the square root of the count.
    count : ndarray of int, shape (loads,)
        Realisations that the mean is of; those that are not finite are left out.
    averaging : {"arithmetic", "geometric"}
        Which mean.
    confidence : float
        Level of the interval.
    """

    mean: Real
    low: Real
    high: Real
    scatter: Real
    standard_error: Real
    count: NDArray[np.intp]
    averaging: Averaging
    confidence: float


def average(
    values: ArrayLike,
    averaging: Averaging = "arithmetic",
    confidence: float = 0.95,
    rng: int = 0,
) -> Average:
    """Average a quantity over realisations, at each load.

    Parameters
    ----------
    values : array_like, shape (realisations, loads)
        Stiffness, area or any other quantity at fixed loads; NaN where a load did not converge.
    averaging : {"arithmetic", "geometric"}, optional
        Which mean.
    confidence : float, optional
        Level of the interval.
    rng : int, optional
        Seed of the resampling.

    Raises
    ------
    InputError
        If the shape is another, or the mean is geometric and a value is not positive.
    """
    table = _checked(values, averaging, confidence)
    shown = np.log(table) if averaging == "geometric" else table
    count = np.count_nonzero(np.isfinite(table), axis=0)
    found = bootstrap.means(shown, rng)
    ends = np.array([found.value, *found.interval(confidence)])
    mean, low, high = np.exp(ends) if averaging == "geometric" else ends
    scatter = found.error * np.sqrt(count)
    return Average(mean, low, high, scatter, found.error, count, averaging, confidence)


def relative_difference(
    values: ArrayLike,
    reference: ArrayLike,
    *,
    paired: bool,
    confidence: float = 0.95,
    rng: int = 0,
) -> tuple[Real, Real, Real]:
    """Relative difference of two ensemble means, ``mean(values) / mean(reference) - 1``.

    Parameters
    ----------
    values, reference : array_like, shape (realisations, loads)
        The two ensembles at the same loads; positive, or NaN where a load did not converge.
    paired : bool
        Whether realisation i of both belongs together (same seed, same phases): they are then
        resampled together, and what is not finite in one is left out of both.
    confidence : float, optional
        Level of the interval.
    rng : int, optional
        Seed of the resampling.

    Returns
    -------
    difference, low, high : ndarray, shape (loads,)
        The difference and the ends of its interval. [1]

    Raises
    ------
    InputError
        If the shapes do not fit, or a value is not positive.
    """
    first = _checked(values, "arithmetic", confidence)
    second = _checked(reference, "arithmetic", confidence)
    if first.shape[1] != second.shape[1] or (paired and first.shape != second.shape):
        raise InputError(
            f"values have shape {first.shape}, the reference {second.shape}; the same loads are "
            "needed, and for pairs the same realisations"
        )
    if (first <= 0).any() or (second <= 0).any():
        raise InputError("a relative difference needs positive values; some are zero or negative")
    if paired:
        both = np.isfinite(first) & np.isfinite(second)
        found = [_paired(*pair, rng) for pair in zip(first.T, second.T, both.T, strict=True)]
        ends = [(each.value, *each.interval(confidence)) for each in found]
        difference, low, high = np.expm1(np.reshape(ends, (-1, 3)).T)
    else:
        apart = bootstrap.means(first, rng).log() - bootstrap.means(second, rng + 1).log()
        difference, (low, high) = np.expm1(apart.value), np.expm1(apart.interval(confidence))
    return difference, low, high


def _paired(values: Real, reference: Real, both: NDArray[np.bool_], rng: int) -> Resampled:
    """Difference of the logarithms of two means over the same realisations."""
    pairs = np.column_stack([values[both], reference[both]])
    return bootstrap.of_log_means(pairs, np.array([1.0, -1.0]), rng=rng)


def at_levels(
    force_bar: ArrayLike, depth: ArrayLike, stiffness: ArrayLike, highest: ArrayLike, levels: int
) -> tuple[Real, Real]:
    """Force and stiffness of every realisation at common levels of the rigid plane.

    The level is the height of the plane above the mean of the heights; a realisation whose
    highest point lies below it bears nothing. Averaged at fixed level, an ensemble shows other
    exponents than at fixed force, because its highest realisations dominate.

    Parameters
    ----------
    force_bar : array_like, shape (loads,)
        Rising dimensionless forces.
    depth, stiffness : array_like, shape (realisations, loads)
        Depth since touch, over h, and stiffness under these forces.
    highest : array_like, shape (realisations,)
        Highest point of each, above the mean, over h.
    levels : int
        Number of levels, evenly spaced over those that all realisations reach.

    Returns
    -------
    force, stiffness : ndarray, shape (realisations, levels)
        Zero where a realisation does not touch, or less than under the smallest load; from the
        highest level to the lowest.
    """
    log_force = np.log(np.asarray(force_bar, dtype=np.float64))
    depths, stiffnesses = np.asarray(depth, float), np.asarray(stiffness, float)
    plane = np.asarray(highest, float)[:, np.newaxis] - depths
    common = np.linspace(plane[:, 0].max(), plane[:, -1].max(), levels)
    forces, at = np.zeros((len(depths), levels)), np.zeros((len(depths), levels))
    for i, (row, stiff) in enumerate(zip(plane, stiffnesses, strict=True)):
        touches = common <= row[0]
        forces[i, touches] = np.exp(np.interp(-common[touches], -row, log_force))
        at[i, touches] = np.exp(np.interp(-common[touches], -row, np.log(stiff)))
    return forces, at


def _checked(values: ArrayLike, averaging: str, confidence: float) -> Real:
    table = np.asarray(values, dtype=np.float64)
    if table.ndim != 2 or not table.size:
        raise InputError(f"values have shape {table.shape}; (realisations, loads) is needed")
    if averaging not in ("arithmetic", "geometric"):
        raise InputError(f'averaging is {averaging!r}; allowed are "arithmetic" and "geometric"')
    if not 0 < confidence < 1:
        raise InputError(f"confidence is {confidence}; a level between 0 and 1 is needed")
    if averaging == "geometric" and (table <= 0).any():
        raise InputError("a geometric mean needs positive values; some are zero or negative")
    return table
