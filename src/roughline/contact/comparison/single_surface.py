"""What a single surface shows of the difference between the means of both models."""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import Real

_LEAST_SCATTER = 0.01  # for saturated lines; surfaces scatter by 0.012 at F̄ = 4 and by 0.003 at 10
_STUDENT_95 = 1.97  # Student's t for 95 % on two sides, with the freedom of 200 lines


def scatter_of_surfaces(reduced: Real, at_half: Real) -> Real:
    """Estimate the scatter of single surfaces from lines with the same waves.

    Lines scatter as much as surfaces, or up to twice as much. Lines saturate at lower loads than
    surfaces, and saturated lines all have the same stiffness. The larger of their scatters at the
    load and at half the load is therefore taken, and 0.01 at least.

    It is the standard deviation of the logarithm of the stiffness; stiffnesses have the shape
    (lines, loads).
    """
    scatters = [np.log(stiffness).std(axis=0, ddof=1) for stiffness in (reduced, at_half)]
    return np.maximum(np.maximum(*scatters), _LEAST_SCATTER)


def difference_of_one(surface: Real, reduced: Real, scatter: Real) -> tuple[Real, Real, Real]:
    """Return the relative difference of one surface from lines, and the interval of all."""
    mean = reduced.mean(axis=0)
    error = reduced.std(axis=0, ddof=1) / mean / math.sqrt(len(reduced))
    difference = np.log(surface / mean)
    width = _STUDENT_95 * np.hypot(scatter, error)
    return np.expm1(difference), np.expm1(difference - width), np.expm1(difference + width)
