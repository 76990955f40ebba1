"""Gauss's rule on panels between edges."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Real

_GAUSS_PANEL = np.polynomial.legendre.leggauss(16)


def on_panels(edges: Real) -> tuple[Real, Real]:
    """Return the points and weights of an integral over panels, 16 in each."""
    nodes, weights = _GAUSS_PANEL
    half, middle = np.diff(edges) / 2, (edges[1:] + edges[:-1]) / 2
    points = middle[:, np.newaxis] + half[:, np.newaxis] * nodes
    return points.ravel(), (half[:, np.newaxis] * weights).ravel()
