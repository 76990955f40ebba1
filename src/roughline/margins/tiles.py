"""What the tiles of a map say of the larger surface that the map is itself a tile of."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import SurfaceCurve
from roughline.engineering.intervals import Ends
from roughline.fluid.measures import names_at_border
from roughline.margins.spread import FLOOR, logit
from roughline.question.extrapolation import Extrapolation
from roughline.statistics.student import student
from roughline.topography.body import Surface

FEWEST_POINTS = 32
"""Points along the shorter side of a map, from which on it has tiles."""

POINTS_OF_TILES = 2**16
"""Points of a map whose tiles are pressed; a finer one is coarsened before."""

POINTS_OF_BORDER = 2**14
"""Points of a map whose border is judged: on four times as many, it does about an eighth less."""

_DECAY = 0.5  # of a step, from one doubling of the side to the next: that of a border's share


@dataclass(frozen=True, eq=False)
class Tiles:
    """A quantity of a map and of its tiles under one mean pressure, all of them periodic.

    It is on a scale on which it scatters evenly, such as a logarithm: infinite in full contact, NaN
    where it is not known.
    """

    of_map: Real  # (loads,)
    halves: Real  # of tiles half as long as the map, (2, 2, loads)
    quarters: Real  # (4, 4, loads)
    either_way: bool = False
    """Whether steps may go on to either side where there is no roll-off: longer waves open a gap,
    and the border of a map, whose opposite sides do not fit, keeps it open too."""

    def steps(self, extrapolation: Extrapolation) -> Ends:
        """Both ends of the mean difference between the larger surface and maps of this size.

        It is due to waves that a map does not hold, and to its border. The steps from quarters to
        halves and from halves to the map show how it goes on. Where there is a roll-off, each
        further step is half the one before, so that all of them together are as large as the last
        one. Without a roll-off each further step may be as large as the larger of these two, and
        `either_way` on the other side as well.
        """
        first, last = self._first_and_last()
        if extrapolation.roll_offs is None:
            further = [extrapolation.doublings * first, extrapolation.doublings * last]
            if self.either_way:
                further += [-each for each in further]
        else:
            further = [last, _DECAY * first]
        none = np.zeros_like(first)
        return np.minimum.reduce([none, *further]), np.maximum.reduce([none, *further])

    def _first_and_last(self) -> Ends:
        """Steps from quarters to halves, and from halves to the map."""
        with np.errstate(invalid="ignore"):
            first = _mean(self.halves) - _mean(self.quarters)
            last = np.where(np.isfinite(self.of_map), self.of_map, np.nan) - _mean(self.halves)
            return first, last

    def scatter(self, extrapolation: Extrapolation) -> Real:
        """Half width of the scatter of maps about their mean, from that of tiles.

        A map is the mean of its four halves and of its sixteen quarters, and scatters as the one or
        the other says, whichever is more. Tiles that hold a roll-off wavelength are independent. Of
        quarters that hold less there are only as many independent ones as wavelengths. Without a
        roll-off a map scatters as its halves and as its quarters do, and again in each two
        doublings of its side.
        """
        halves = _variance(self.halves)
        quarters = np.maximum(_variance(self.quarters), _variance_across(self.quarters))
        certain = student(math.prod(self.quarters.shape[:2]) - 1)
        if extrapolation.roll_offs is not None:
            waves = min(4.0, max(1.0, extrapolation.roll_offs))
            return certain * np.sqrt(np.maximum(halves / 4, quarters / waves**2))
        return certain * np.sqrt(extrapolation.doublings / 2 * (halves + quarters) / 2)

    def extrapolated(self, extrapolation: Extrapolation, *, mean: bool = False) -> Ends:
        """Both ends of the difference between the larger surface and the map.

        Where the map is above its quarters by more than it scatters, as a map of a plateau is that
        its own plane tilts, the map is not large yet under this load, and its roll-off does not
        count. What chance explains is no such sign: a larger scatter may leave less open there.
        `mean` says that the map stands for the mean of many, in which chance cancels.
        """
        low, high = self._extrapolated(extrapolation, mean=mean)
        if extrapolation.roll_offs is not None:
            unlike = self.of_map - _mean(self.quarters) > self.scatter(extrapolation)
            ends = self._extrapolated(Extrapolation(None), mean=mean)
            low = np.where(unlike, np.fmin(low, ends[0]), low)
            high = np.where(unlike, np.fmax(high, ends[1]), high)
        if mean:  # of one map, chance hides that steps grow and do not say where they end
            first, last = self._first_and_last()
            grow = (last > first) & (last + first > 0) & (last > self.scatter(extrapolation) / 2)
            high = np.where(grow, np.inf, high)
        full = np.isinf(self.of_map) | np.isinf(self.quarters).any(axis=(0, 1))
        return np.where(np.isnan(low), -np.inf, low), np.where(full | np.isnan(high), np.inf, high)

    def _extrapolated(self, extrapolation: Extrapolation, *, mean: bool) -> Ends:
        low, high = self.steps(extrapolation)
        scatter = 0.0 if mean else self.scatter(extrapolation)
        return low - scatter, high + scatter

    @classmethod
    def mean(cls, tiles: Sequence[Tiles]) -> Tiles:
        """Mean over maps of the same size."""

        def over(values: Sequence[Real]) -> Real:
            return np.mean(values, axis=0)

        return cls(
            over([each.of_map for each in tiles]),
            over([each.halves for each in tiles]),
            over([each.quarters for each in tiles]),
            all(each.either_way for each in tiles),
        )


@dataclass(frozen=True, eq=False)
class TiledCurves:
    """Curves of a map and of its tiles under the same mean pressures, all of them periodic."""

    of_map: SurfaceCurve
    halves: Sequence[SurfaceCurve]  # 4, row by row
    quarters: Sequence[SurfaceCurve]  # 16
    points: int  # of the whole map
    border: SurfaceCurve | None = None
    """Of the whole map on few points, with measures that tell what its border does."""

    def stiffness_and_contact(self) -> tuple[Tiles, Tiles]:
        """Logarithms of the stiffness, and logits of the contact."""
        return self._tiles(_stiffness), self._tiles(_contact)

    def measure(self, name: str) -> tuple[Tiles, Real]:
        """Logarithms of a measure and a floor that is added to it, and the floor, (loads,).

        The floor is a share of the measure's mean, so that what is sealed has a logarithm. Near
        sealing places scatter evenly in the aperture itself, and elsewhere in its logarithm. It is
        zero where all is sealed, even with the pressure held along the border.
        """
        values = self._tiles(lambda curve, _points: curve.measured[name].values)
        means = [values.of_map, _mean(values.halves), _mean(values.quarters)]
        largest = np.fmax.reduce(means)
        if (border := self._at_border(name)) is not None:
            largest = np.where(largest == 0, np.nan_to_num(border.max(axis=0)), largest)
        floor = FLOOR * largest
        with np.errstate(divide="ignore"):
            of_map, halves, quarters = (
                np.log(each + floor) for each in (values.of_map, values.halves, values.quarters)
            )
        return Tiles(of_map, halves, quarters, either_way=True), floor

    def border_differences(self, name: str, floor: Real) -> tuple[Real, Real] | None:
        """By how much the logarithm of a measure and the floor differs as the border is held.

        That is with the flow given along it, and with the pressure; None if that was not measured.
        """
        values = self._at_border(name)
        if values is None:
            return None
        with np.errstate(divide="ignore", invalid="ignore"):
            of_map, with_flow, with_pressure = np.log(values + floor)
            return with_flow - of_map, with_pressure - of_map

    def _at_border(self, name: str) -> Real | None:
        """A measure of the map as it repeats, with the flow given, and the pressure, (3, loads)."""
        names = (name, *names_at_border(name))
        if self.border is None or any(each not in self.border.measured for each in names):
            return None
        return np.stack([self.border.measured[each].values for each in names])

    def _tiles(self, of: Callable[[SurfaceCurve, int], Real]) -> Tiles:
        halves, quarters = (
            np.stack([of(each, self.points // count**2) for each in curves]).reshape(
                count, count, -1
            )
            for count, curves in ((2, self.halves), (4, self.quarters))
        )
        return Tiles(of(self.of_map, self.points), halves, quarters)


def _stiffness(curve: SurfaceCurve, points: int) -> Real:
    """Logarithm of the stiffness on unloading per area."""
    with np.errstate(divide="ignore"):
        return np.log(curve.unloading_stiffness / curve.length**2)


def _contact(curve: SurfaceCurve, points: int) -> Real:
    """Logit of the contact area fraction; half a cell is left where all or none touch."""
    return logit(np.clip(curve.area_fraction_corrected, 0.5 / points, 1 - 0.5 / points))


def coarse_shape(shape: tuple[int, int], points: int = POINTS_OF_TILES) -> tuple[int, int]:
    """Points along the sides of a map whose tiles are pressed, or one of fewer points."""
    while shape[0] * shape[1] > points and min(shape) >= 4 * FEWEST_POINTS:
        shape = shape[0] // 2, shape[1] // 2
    return shape


def has_few_points(shape: tuple[int, int]) -> bool:
    """Whether the border of a map is judged on its own points."""
    return coarse_shape(shape, POINTS_OF_BORDER) == shape


def coarsened(piece: Surface, points: int = POINTS_OF_TILES) -> Surface:
    """Return a map of many points on fewer, where its tiles keep enough."""
    shape = coarse_shape(piece.shape, points)
    while piece.shape != shape:
        piece = piece.cropped(*((0, n - n % 2) for n in piece.shape)).coarsened()
    return piece


def _mean(tiles: Real) -> Real:
    """Mean over the tiles that are known, and not in full contact; NaN if most are not."""
    known = np.isfinite(tiles)
    count = known.sum(axis=(0, 1))
    total = np.where(known, tiles, 0.0).sum(axis=(0, 1))
    return np.where(2 * count >= tiles.shape[0] ** 2, total / np.maximum(count, 1), np.nan)


def _off(tiles: Real) -> Real:
    """Deviations from the mean; none of tiles that are not known."""
    with np.errstate(invalid="ignore"):
        return np.where(np.isfinite(tiles), tiles - _mean(tiles), 0.0)


def _variance(tiles: Real) -> Real:
    """Variance of the tiles."""
    count = np.isfinite(tiles).sum(axis=(0, 1))
    return (_off(tiles) ** 2).sum(axis=(0, 1)) / np.maximum(count - 1, 1)


def _variance_across(tiles: Real) -> Real:
    """Variance of the tiles' mean times their number, where rows or columns scatter as a whole.

    Tiles along a lay are not independent. It is that of an analysis of variance in two ways.
    """
    side, off = tiles.shape[0], _off(tiles)
    rows, columns = off.mean(axis=1, keepdims=True), off.mean(axis=0, keepdims=True)
    of_rows, of_columns = (side * (each**2).sum(axis=(0, 1)) for each in (rows, columns))
    rest = ((off - rows - columns) ** 2).sum(axis=(0, 1)) / (side - 1) ** 2
    return (of_rows + of_columns) / (side - 1) - rest
