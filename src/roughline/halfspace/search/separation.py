"""The distance of two bodies at first touch, computed from heights where it is needed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from roughline.computing.arrays import Indices, Real


@dataclass(frozen=True, eq=False)
class Separation:
    """Distance of an untouched rough body from a flat one; it takes no memory of its own.

    It answers as an array does, as far as the solver asks. Bodies that loads have indented, and
    parts of a grid, have a plain array in its place.

    Attributes
    ----------
    heights : ndarray, shape (nx, ny)
        Heights. [length]
    top : float
        The largest of them. [length]
    unit : float
        Unit of the distances. [length]
    """

    heights: Real
    top: float
    unit: float

    @property
    def shape(self) -> tuple[int, ...]:
        """Points of the grid."""
        return self.heights.shape

    @property
    def flat(self) -> FlatSeparation:
        """The same with flat indices."""
        return FlatSeparation(self)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Real:
        """Return the distances as a new array."""
        return self._of(self.heights)

    def __getitem__(self, rows: slice) -> Real:
        """Return the distances in some rows."""
        return self._of(self.heights[rows])

    def min(self) -> float:
        """Return the least distance."""
        return (self.top - float(self.heights.max())) / self.unit

    def mean(self) -> float:
        """Return the mean distance."""
        return float(self._of(self.heights).mean())

    def _of(self, heights: Real) -> Real:
        distances = np.subtract(self.top, heights, order="C")
        distances /= self.unit
        return distances


@dataclass(frozen=True, eq=False)
class FlatSeparation:
    """A separation with flat indices.

    Attributes
    ----------
    separation : Separation
        The separation.
    """

    separation: Separation

    def __getitem__(self, nodes: Indices) -> Real:
        """Return the distances at some nodes."""
        return self.separation._of(self.separation.heights.flat[nodes])
