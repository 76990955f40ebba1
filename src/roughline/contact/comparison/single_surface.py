"""What a single surface shows of the difference between the means of both models."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from roughline.computing.arrays import Real

_LEAST_SCATTER = 0.01  # for saturated lines; surfaces scatter by 0.012 at F̄ = 4 and by 0.003 at 10
_STUDENT_95 = 1.97  # Student's t for 95 % on two sides, with the freedom of 200 lines


def scatter_of_surfaces(reduced: Real, at_half: Real) -> Real:
    """Estimate the scatter of single surfaces from lines with the same waves.

    Lines scatter as much as surfaces, or up to twice as much. Lines saturate at lower loads than
    surfaces, and saturated lines all have the same stiffness. The larger of their scatters at the
    load and at half the load is therefore taken, and 0.01 at least.

    Parameters
    ----------
    reduced, at_half : ndarray, shape (lines, loads)
        Stiffness of lines at the loads, and at half of each.

    Returns
    -------
    ndarray, shape (loads,)
        Standard deviation of the logarithm of the stiffness. [1]
    """
    scatters = [np.log(stiffness).std(axis=0, ddof=1) for stiffness in (reduced, at_half)]
    return np.maximum(np.maximum(*scatters), _LEAST_SCATTER)


def difference_of_one(surface: Real, reduced: Real, scatter: Real) -> tuple[Real, Real, Real]:
    """Return the relative difference of one surface from lines, with the interval of all surfaces.

    Parameters
    ----------
    surface : ndarray, shape (loads,)
        Stiffness of the surface.
    reduced : ndarray, shape (lines, loads)
        Stiffness of the lines.
    scatter : ndarray, shape (loads,)
        Standard deviation of the logarithm of the stiffness of single surfaces. [1]

    Returns
    -------
    difference, low, high : ndarray, shape (loads,)
        The difference of this surface, and the ends of the 95 % interval of the difference
        between the means over all surfaces and all lines. [1]
    """
    mean = reduced.mean(axis=0)
    error = reduced.std(axis=0, ddof=1) / mean / math.sqrt(len(reduced))
    difference = np.log(surface / mean)
    width = _STUDENT_95 * np.hypot(scatter, error)
    return np.expm1(difference), np.expm1(difference - width), np.expm1(difference + width)
