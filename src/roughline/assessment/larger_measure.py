"""A measure of a map, and of the larger surface that the map was cut out of."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughline.assessment.tiles import Extrapolation, TiledCurves, Tiles
from roughline.assessment.uncertainty import widened
from roughline.computing.arrays import Real
from roughline.contact.measures import Measured
from roughline.engineering.intervals import Ends

UNBOUNDED: Ends = (np.array(-np.inf), np.array(np.inf))
"""Ends of a difference from a larger surface that a map does not tell of."""


@dataclass(frozen=True, eq=False)
class LargerMeasure:
    """A measure of a map, and what its tiles tell of that of a larger surface."""

    of_map: Measured  # with what its grid and filled points leave open
    tiles: Tiles  # logarithms of the measure and the floor
    floor: Real  # added to the measure, (loads,); zero where the map and all its tiles are sealed
    at_border: tuple[Real, Real] | None = None
    """Differences of the same logarithm with the flow given along the border, and the pressure."""

    @classmethod
    def of(cls, of_map: Measured, curves: TiledCurves) -> LargerMeasure:
        """A measure with the tiles of its map."""
        name = of_map.quantity.name
        tiles, floor = curves.measure(name)
        return cls(of_map, tiles, floor, curves.border_differences(name, floor))

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
        with_flow, with_pressure = (self._moved(each) for each in self.at_border)
        return with_flow, with_pressure

    def _moved(self, difference: Real) -> Real:
        """The measure whose logarithm, with the floor, differs from that of the map."""
        with np.errstate(invalid="ignore"):  # without a floor, nothing times what is not known
            moved = (self.of_map.values + self.floor) * np.exp(difference) - self.floor
        return np.where(self.floor > 0, np.maximum(moved, 0.0), self.of_map.values)

    def with_larger_surface(self, extrapolation: Extrapolation | None) -> Measured:
        """The measure with an interval that holds a larger surface; none if the map tells of none.

        What the border leaves open lies within it. Tiles have borders, too, so that both are not
        independent.
        """
        if extrapolation is None or not extrapolation.is_supported:
            return replace(self.of_map, low=None, high=None)
        found = self.widened(self.tiles.extrapolated(extrapolation), with_grid=True)
        least, most = (self._moved(end) for end in self.border)
        _, low, high = found.rows
        return replace(found, low=np.minimum(low, least), high=np.maximum(high, most))

    def widened(self, further: Ends, *, with_grid: bool) -> Measured:
        """The measure with an interval that its logarithm may differ by.

        With the grid, they are combined with what that leaves open, as independent.
        """
        values, floor = self.of_map.values, self.floor
        low, high = (
            self.of_map.rows[1:] if with_grid and self.of_map.low is not None else (values,) * 2
        )
        ends = widened(values + floor, (low + floor, high + floor), further)
        is_known = floor > 0
        low = np.where(is_known, np.maximum(ends[0] - floor, 0.0), low)
        return replace(self.of_map, low=low, high=np.where(is_known, ends[1] - floor, high))
