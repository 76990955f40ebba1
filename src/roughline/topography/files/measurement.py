"""Heights as a file holds them, before any processing."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.errors import InputError
from roughline.topography.body import Body, Line, Surface
from roughline.topography.crop import Crop, points_between, points_in, settings_of_piece
from roughline.topography.effects import effect_of_trend
from roughline.topography.files.scale import Scale, Sizes
from roughline.topography.heights import rms_deviation
from roughline.topography.missing import Missing
from roughline.topography.settings import AS_RECORDED, Settings, checked_trend, record_of_tilt
from roughline.topography.trend import Trend, remove_trend


@dataclass(frozen=True, eq=False)
class Measurement:
    """Heights as a file holds them, and what the file states about them.

    Attributes
    ----------
    file : str
        Name of the file, for messages.
    heights : array or masked array, shape (nx, ny) or (n,)
        Heights; unknown ones are masked or not finite. [unit of the file]
    unit : str or None
        Unit of all lengths; None if the file states none.
    sizes : tuple of float or None
        Sides of the map, or length of the line; None if the file states none. [unit of the file]
    kind : {"surface", "profile", "reduced"}
        A map, a line scan, or a line made for the reduced model.
    by_roughline : bool
        Whether roughline wrote the file; its heights are kept as they were written.
    channel : str
        Name of the channel; empty where the file has no names.
    channels : tuple of str
        All channels of the file, with their numbers.
    positions : ndarray, shape (n,), or None
        Positions of the points of a line whose spacing is not even. [unit of the file]
    settings : mapping
        Where the heights come from.
    is_cut_out, removed_trend
        As for :class:`roughline.Surface`, where the file states them.
    is_piece : bool
        Whether it is a piece of what the file holds.
    """

    file: str
    heights: Any
    unit: str | None
    sizes: tuple[float, ...] | None
    kind: Literal["surface", "profile", "reduced"]
    by_roughline: bool = False
    channel: str = ""
    channels: tuple[str, ...] = ()
    positions: Real | None = None
    settings: Settings = field(default_factory=dict)
    is_cut_out: bool = AS_RECORDED
    removed_trend: Trend = AS_RECORDED
    is_piece: bool = False

    @property
    def unknown(self) -> Mask:
        """Which points are missing."""
        return np.ma.getmaskarray(self.heights) | ~np.isfinite(np.ma.getdata(self.heights))

    def piece(self, crop: Crop, unit: str | None, sizes: Sizes | None) -> Measurement:
        """Return a piece, with its own sizes, in which missing points are still missing.

        What is missing elsewhere does not count, and the heights elsewhere fill nothing in it.
        """
        scale = self._scale(unit, sizes)
        for obstacle in scale.obstacles():
            raise obstacle
        if self.positions is None:
            kept = points_in(crop, scale.sides, self.heights.shape, "m")
        else:
            kept = points_between(crop, scale.metres * (self.positions - self.positions[0]))
        positions = None if self.positions is None else self.positions[kept]
        lengths = (
            [
                side * (each.stop - each.start) / n
                for side, each, n in zip(scale.sides, kept, self.heights.shape, strict=True)
            ]
            if positions is None
            else [scale.metres * (positions[-1] - positions[0])]
        )
        is_whole = self.heights[kept].size == self.heights.size
        return replace(
            self,
            heights=self.heights[kept].copy(order="K"),  # so that the whole can go
            sizes=tuple(length / scale.metres for length in lengths),
            positions=positions,
            settings=settings_of_piece(self.settings, kept, self.heights.shape),
            is_cut_out=self.is_cut_out if is_whole else True,
            is_piece=True,
        )

    def obstacles(
        self, unit: str | None, sizes: Sizes | None, missing: Missing
    ) -> list[InputError]:
        """List what is still needed before there is a body: a unit, sizes, more known points."""
        return self._obstacles(self._scale(unit, sizes), missing)

    def scale_obstacles(self, unit: str | None, sizes: Sizes | None) -> list[InputError]:
        """List what is still needed of the scale; arguments and errors as :meth:`obstacles`."""
        return self._scale(unit, sizes).obstacles()

    def body(
        self,
        unit: str | None,
        sizes: Sizes | None,
        missing: Missing,
        trend: Trend,
        *,
        in_place: bool = False,
    ) -> Body:
        """Return the body, in metres.

        The measurement is not changed, so that another body with another filling can follow from
        it; `in_place` gives that up.
        """
        scale = self._scale(unit, sizes)
        for obstacle in self._obstacles(scale, missing):
            raise obstacle
        sides = scale.sides
        heights, filling = missing.completed(self.heights, self.file)
        settings = {**self.settings, **filling}
        removed = self._trend_to_remove(trend)
        if not self.by_roughline:
            settings["file_unit"] = str(self.unit or unit)
        if scale.metres != 1 or removed != "none":
            heights = _changeable(heights, in_place or bool(filling))
            if scale.metres != 1:
                heights *= scale.metres
        if self.positions is not None:
            heights, settings["resampled"] = _on_even_points(self.positions * scale.metres, heights)
        if removed != "none":
            before = rms_deviation(heights)
            spacings = [side / n for side, n in zip(sides, heights.shape, strict=True)]
            settings |= record_of_tilt(heights, spacings, removed, settings)
            remove_trend(heights, removed)
            settings["detrended"] = removed
            settings |= effect_of_trend(before, rms_deviation(heights))
        return self._body(heights, sides, settings, removed)

    def _trend_to_remove(self, wanted: Trend) -> Trend:
        """The trend of what an instrument measured; from a piece of ours, what the whole lacks."""
        if not self.by_roughline or wanted == "none":
            return wanted
        return checked_trend(self.removed_trend, self.settings) if self.is_piece else "none"

    def _body(
        self,
        heights: Real,
        sides: tuple[float, ...],
        settings: Settings,
        removed: Trend,
    ) -> Body:
        removed_trend = self.removed_trend if self.by_roughline else removed
        if self.kind == "surface":
            return Surface(
                heights,
                (sides[0], sides[1]),
                "m",
                settings,
                is_cut_out=self.is_cut_out,
                removed_trend=removed_trend,
            )
        return Line(
            heights,
            sides[0],
            "m",
            settings,
            self.kind,
            is_cut_out=self.is_cut_out,
            removed_trend=removed_trend,
        )

    def _scale(self, unit: str | None, sizes: Sizes | None) -> Scale:
        return Scale(self.file, self.heights.shape, self.unit, unit, self.sizes, sizes)

    def _obstacles(self, scale: Scale, missing: Missing) -> list[InputError]:
        obstacles = scale.obstacles()
        name = f"the piece of {self.file}" if self.is_piece else self.file
        too_many = missing.too_many(self.unknown, name)
        return [*obstacles, too_many] if too_many else obstacles


def _changeable(heights: Real, is_free: bool) -> Real:
    """Heights that may be changed: a copy, unless nobody else needs the array."""
    if not heights.flags.writeable:
        return heights.copy()
    return heights if is_free else heights.copy(order="K")  # sums depend on the order in memory


def _on_even_points(positions: Real, heights: Real) -> tuple[Real, str]:
    """Heights interpolated linearly to as many even points, and the words that record it."""
    steps = np.diff(positions)
    even = np.linspace(positions[0], positions[-1], positions.size)
    record = f"linear, to even spacing; it was {steps.min():.3g} to {steps.max():.3g} m"
    return np.interp(even, positions, heights), record
