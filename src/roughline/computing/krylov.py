"""Equations that are not symmetric, by the least residual in a Krylov space.

References
----------
.. [1] Y. Saad and M. H. Schultz, "GMRES: a generalized minimal residual algorithm for solving
   nonsymmetric linear systems", SIAM J. Sci. Stat. Comput. 7, 856-869 (1986).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from roughline.computing.arrays import Real

_MOST_STEPS = 120


def least_residual(
    operator: Callable[[Real], Real], inverse: Callable[[Real], Real], target: Real, rtol: float
) -> tuple[Real, float]:
    """Solve with an approximate inverse on the right; return the solution and what is left.

    What is left is a part of the target. Sums are not those of BLAS, whose threads take longer than
    they gain on vectors of contact nodes.
    """
    size = math.sqrt(_along(target, target))
    if size == 0:
        return np.zeros_like(target), 0.0
    basis = [target / size]
    led: list[Real] = []
    upper: list[list[float]] = []
    rotations: list[tuple[float, float]] = []
    left = [size]
    while left[-1] != 0 and abs(left[-1]) > rtol * size and len(led) < _MOST_STEPS:
        led.append(inverse(basis[-1]))
        vector = operator(led[-1])
        column = []
        for each in basis:
            column.append(_along(each, vector))
            vector = vector - column[-1] * each
        length = math.sqrt(_along(vector, vector))
        for k, (cosine, sine) in enumerate(rotations):
            first, second = column[k], column[k + 1]
            column[k] = cosine * first + sine * second
            column[k + 1] = cosine * second - sine * first
        radius = math.hypot(column[-1], length)
        if radius == 0:
            led.pop()
            break
        rotations.append((column[-1] / radius, length / radius))
        column[-1] = radius
        upper.append(column)
        cosine, sine = rotations[-1]
        left.append(-sine * left[-1])
        left[-2] *= cosine
        basis.append(vector / length if length else vector)
    weights = np.zeros(len(led))
    for k in range(len(led) - 1, -1, -1):
        known = sum(upper[j][k] * weights[j] for j in range(k + 1, len(led)))
        weights[k] = (left[k] - known) / upper[k][k]
    found = np.zeros_like(target)
    for weight, each in zip(weights, led, strict=True):
        found += weight * each
    return found, abs(left[-1]) / size


def _along(a: Real, b: Real) -> float:
    return float(np.einsum("i,i->", a, b))
