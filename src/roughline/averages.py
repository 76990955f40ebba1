"""Averages of an ensemble at fixed force or fixed level, with intervals over realisations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline import bootstrap
from roughline.errors import InputError

Real = NDArray[np.float64]
Averaging = Literal["arithmetic", "geometric"]


@dataclass(frozen=True, eq=False)
class Average:
    """Mean of a quantity over realisations, at each load.

    Attributes
    ----------
    mean : ndarray, shape (loads,)
        Arithmetic or geometric mean.
    low, high : ndarray, shape (loads,)
        Ends of its interval, from resampled realisations.
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
    finite = np.isfinite(table)
    count = np.count_nonzero(finite, axis=0)
    shown = np.log(table) if averaging == "geometric" else table
    some = np.maximum(count, 1)
    mean = np.where(count, np.where(finite, shown, 0.0).sum(axis=0) / some, np.nan)
    squares = np.where(finite, (shown - mean) ** 2, 0.0).sum(axis=0)
    scatter = np.where(count > 1, np.sqrt(squares / np.maximum(count - 1, 1)), np.nan)
    low, high = np.full_like(mean, np.nan), np.full_like(mean, np.nan)
    several = count > 1
    if several.any():
        resamples = bootstrap.resampled_means(shown[:, several], rng)
        low[several], high[several] = bootstrap.percentile_interval(resamples, confidence)
    if averaging == "geometric":
        mean, low, high = np.exp(mean), np.exp(low), np.exp(high)
    return Average(mean, low, high, scatter, scatter / np.sqrt(some), count, averaging, confidence)


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
        The two ensembles at the same loads.
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
        If the shapes do not fit.
    """
    first = _checked(values, "arithmetic", confidence)
    second = _checked(reference, "arithmetic", confidence)
    if first.shape[1] != second.shape[1] or (paired and first.shape != second.shape):
        raise InputError(
            f"values have shape {first.shape}, the reference {second.shape}; the same loads are "
            "needed, and for pairs the same realisations"
        )
    if paired:
        both = np.isfinite(first) & np.isfinite(second)
        first, second = np.where(both, first, np.nan), np.where(both, second, np.nan)
    ratios = bootstrap.resampled_means(first, rng) / bootstrap.resampled_means(
        second, rng if paired else rng + 1
    )
    difference = np.nanmean(first, axis=0) / np.nanmean(second, axis=0) - 1
    low, high = bootstrap.percentile_interval(ratios, confidence) - 1
    return difference, low, high


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
