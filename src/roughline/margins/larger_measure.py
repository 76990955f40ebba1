"""A measure of a map, and what its tiles and its border tell of that of a larger surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.engineering.intervals import Ends
from roughline.margins.spread import with_floor
from roughline.margins.tiles import TiledCurves, Tiles
from roughline.question.extrapolation import Extrapolation

UNBOUNDED: Ends = (np.array(-np.inf), np.array(np.inf))
"""Ends of a difference from a larger surface that a map does not tell of."""


@dataclass(frozen=True, eq=False)
class LargerMeasure:
    """A measure of a map, and what its tiles tell of that of a larger surface."""

    values: Real  # of the map, (loads,)
    tiles: Tiles  # logarithms of the measure and the floor
    floor: Real  # added to the measure, (loads,); zero where the map and all its tiles are sealed
    at_border: tuple[Real, Real] | None = None
    """Differences of the same logarithm with the flow given along the border, and the pressure."""

    @classmethod
    def of(cls, values: Real, name: str, curves: TiledCurves) -> LargerMeasure:
        """A measure by its name, with the tiles of its map."""
        tiles, floor = curves.measure(name)
        return cls(values, tiles, floor, curves.border_differences(name, floor))

    @property
    def border(self) -> Ends:
        """Ends of the same difference that the border leaves open, where the map was cut.

        The map as it repeats is within them.
        """
        if self.at_border is None:
            return np.zeros_like(self.floor), np.zeros_like(self.floor)
        ends = np.minimum.reduce(self.at_border), np.maximum.reduce(self.at_border)
        unknown = np.isnan(ends[0])
        low, high = np.minimum(ends[0], 0.0), np.maximum(ends[1], 0.0)
        return np.where(unknown, UNBOUNDED[0], low), np.where(unknown, UNBOUNDED[1], high)

    @property
    def values_at_border(self) -> tuple[Real, Real] | None:
        """The measure with the flow given along the border, and with the pressure held."""
        if self.at_border is None:
            return None
        with_flow, with_pressure = (np.maximum(each, 0.0) for each in self.moved(self.at_border))
        return with_flow, with_pressure

    def ends(self, extrapolation: Extrapolation) -> Ends:
        """Both ends of the measure that the size of the map leaves open.

        What the border leaves open is within them. Tiles have borders, too, so that both are not
        independent.
        """
        return self.moved(beside_border(self.tiles.extrapolated(extrapolation), self.border))

    def moved(self, differences: Ends) -> Ends:
        """The measure whose logarithm, with the floor, differs from that of the map."""
        is_known = self.floor > 0
        floor = np.where(is_known, self.floor, 1.0)
        low, high = with_floor(floor).moved(self.values, differences)
        return np.where(is_known, low, self.values), np.where(is_known, high, self.values)


def beside_border(of_tiles: Ends, of_border: Ends) -> Ends:
    """Both ends of what tiles or the border leave open, whichever is more."""
    return np.minimum(of_tiles[0], of_border[0]), np.maximum(of_tiles[1], of_border[1])
