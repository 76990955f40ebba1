"""Sums over vectors on nodes, and what nodes that slip can follow; each by one thread.

Those of BLAS share long vectors out over threads, which takes longer here than the sums themselves.
"""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Floats, InGrid, Mask, Real
from roughline.computing.compiled import compiled, compiled_sums


@compiled_sums
def inner(a: Real, b: Real) -> float:
    """Return the inner product of vectors on nodes, shape (nodes, 2)."""
    total = 0.0
    for i in range(a.shape[0]):
        total += a[i, 0] * b[i, 0] + a[i, 1] * b[i, 1]
    return total


@compiled
def followed(vectors: Real, slips: Mask, rim: Real) -> Real:
    """Return vectors, and where nodes slip what of them lies along the rims alone."""
    kept = np.empty_like(vectors)
    for i in range(vectors.shape[0]):
        if slips[i]:
            along = rim[i, 0] * vectors[i, 0] + rim[i, 1] * vectors[i, 1]
            kept[i, 0], kept[i, 1] = along * rim[i, 0], along * rim[i, 1]
        else:
            kept[i, 0], kept[i, 1] = vectors[i, 0], vectors[i, 1]
    return kept


def within(vectors: Real, radius: Real) -> Real:
    """Project vectors of nodes onto discs."""
    size = np.hypot(vectors[:, 0], vectors[:, 1])
    over = size > radius
    inside = vectors.copy()
    inside[over] *= (radius[over] / size[over])[:, np.newaxis]
    return inside


@compiled
def largest_excess(shear: Real, change: Real, bound: Real) -> float:
    """Return by how much changed shear is beyond its bounds at most, or zero."""
    largest = 0.0
    for i in range(bound.size):
        x, y = shear[i, 0] + change[i, 0], shear[i, 1] + change[i, 1]
        largest = max(largest, np.sqrt(x * x + y * y) - bound[i])
    return largest


def on_nodes(nodes: InGrid, others: InGrid, values: Floats) -> Real:
    """Return values, given on other nodes, on nodes; zero where they are not given."""
    found = np.zeros((nodes.size, *values.shape[1:]))
    if others.size:
        places = np.minimum(np.searchsorted(others, nodes), others.size - 1)
        known = others[places] == nodes
        found[known] = values[places[known]]
    return found
