"""Fields of one load on the grid, and the indentation that the load leaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.computing.summary import summary


@dataclass(frozen=True, eq=False)
class Fields:
    """Fields of one load on the grid.

    Attributes
    ----------
    pressure : ndarray, shape (nx, ny)
        Contact pressure, compression positive. [pressure]
    displacement : ndarray, shape (nx, ny)
        Normal displacement of the half-space's surface. [length]
    gap : ndarray, shape (nx, ny)
        Distance of the two bodies. [length]
    contact : ndarray of bool, shape (nx, ny)
        Where they touch: where the pressure is above zero.
    plastic : ndarray of bool, shape (nx, ny)
        Where the pressure is at the hardness.
    indentation : ndarray, shape (nx, ny)
        Permanent indentation: how much lower the surface is than before any load. [length]
    sizes : tuple of float
        Sides of the surface, (Lx, Ly). [length]
    is_periodic : bool
        Whether the half-space is periodic, so that fields go on across the borders.
    """

    pressure: Real
    displacement: Real
    gap: Real
    contact: Mask
    plastic: Mask
    indentation: Real
    sizes: tuple[float, float]
    is_periodic: bool

    __repr__ = summary


@dataclass(frozen=True, eq=False)
class Indentation:
    """Where a surface is lower than before any load, and by how much.

    Attributes
    ----------
    nodes : ndarray of int
        Flat indices in the grid, ascending.
    depth : ndarray, shape (nodes,)
        How much lower it is there. [length]
    """

    nodes: Indices
    depth: Real

    def equals(self, other: Indentation) -> bool:
        """Return whether both are the same to the last bit."""
        return np.array_equal(self.nodes, other.nodes) and np.array_equal(self.depth, other.depth)
