"""Intervals of a curve: the uncertainty of its two stiffnesses and of its contact area."""

from __future__ import annotations

from dataclasses import dataclass

from roughline.computing.arrays import Indices, Real

Ends = tuple[Real, Real]
"""Both ends of an interval, each of shape (loads,)."""


@dataclass(frozen=True, eq=False)
class Intervals:
    """Both ends of the intervals of a curve, over its loads.

    Attributes
    ----------
    stiffness : tuple of ndarray
        Of the stiffness on further loading. [N / m]
    unloading : tuple of ndarray
        Of the stiffness on unloading; without yield it is the same. [N / m]
    area : tuple of ndarray, or None
        Of the corrected area fraction; None where the model has no area. [1]
    """

    stiffness: Ends
    unloading: Ends
    area: Ends | None = None

    def at(self, loads: Indices) -> Intervals:
        """The same at some of the loads, by their numbers."""
        return Intervals(
            ends_at(self.stiffness, loads),
            ends_at(self.unloading, loads),
            None if self.area is None else ends_at(self.area, loads),
        )


def ends_at(ends: Ends, loads: Indices) -> Ends:
    """Both ends of an interval at some of the loads, by their numbers."""
    return ends[0][loads], ends[1][loads]
