"""Heights as a file holds them, before any processing, and their scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np

from roughline._version import __version__
from roughline.computing.arrays import Mask, Real
from roughline.errors import InputError, UnitError
from roughline.errors.checks import shown
from roughline.errors.words import called
from roughline.topography.body import Body, Line, Surface
from roughline.topography.crop import Crop, points_between, points_in
from roughline.topography.effects import effect_of_trend
from roughline.topography.heights import rms_deviation
from roughline.topography.missing import Filler, MaskUse, Missing
from roughline.topography.provenance import (
    NOTHING_KNOWN,
    Instrument,
    Masked,
    Provenance,
    facts_of_piece,
    with_facts,
)
from roughline.topography.settings import Settings
from roughline.topography.trend import Trend, remove_trend
from roughline.units import in_si, metres_per, refuse_decimal_comma

Sizes = float | str | Sequence[float | str]
"""Sides of a file as a caller gives them: one length makes a square; texts have their own units."""


@dataclass(frozen=True, eq=False)
class Measurement:
    """Heights as a file holds them, and what the file states about them."""

    file: str  # its name, for messages
    heights: Any  # shape (nx, ny) or (n,); unknown ones are masked or not finite [unit of the file]
    unit: str | None  # of all lengths, or of heights; None if the file states none
    sizes: tuple[float, ...] | None  # of the sides, if the file states them [unit of the file]
    kind: Literal["surface", "profile", "reduced"]
    by_roughline: bool = False  # if it wrote the file; heights are kept as they were written
    channel: str = ""  # its name, where the file has names
    channels: tuple[str, ...] = ()  # all channels of the file, with their numbers
    positions: Real | None = None  # of the points of an uneven line [unit of the file]
    settings: Settings = field(default_factory=dict)  # where the heights come from
    # as of a body, as far as the file states it; what others wrote is a piece if it says nothing
    provenance: Provenance = NOTHING_KNOWN
    is_cut_out: bool | None = None
    unit_of_sides: str | None = None  # of sizes and positions, where that of heights is not stated
    is_piece: bool = False  # whether it is a piece of what the file holds
    format: str = ""  # its name, one of `formats.FORMATS`
    reader: str = ""  # who read it, and which version; empty if roughline did
    corrected: tuple[str, ...] = ()  # what that reader gets wrong and is right here, in sentences
    doubts: tuple[str, ...] = ()  # what in the file itself is wrong or unusual, in sentences
    masked: Mask | None = None  # shape of the heights: points that its mask selects
    mask_of: str = ""  # the program that made the mask

    @property
    def unknown(self) -> Mask:
        """Which points are missing."""
        return np.ma.getmaskarray(self.heights) | ~np.isfinite(np.ma.getdata(self.heights))

    @property
    def read_by(self) -> str:
        """The program that read the file, and its version."""
        return self.reader or f"roughline {__version__}"

    def with_mask(self, use: MaskUse) -> Measurement:
        """Return the measurement with the points that the file's mask selects, or without them.

        Such a mask marks grains or spikes; its points were measured.
        """
        if use == "use":
            return self
        if self.masked is None:
            raise InputError(
                f'is "{use}"; {self.file} has no mask that selects points: leave it out', "mask"
            )
        return replace(self, heights=np.ma.array(self.heights, mask=self.unknown | self.masked))

    def with_instrument(
        self, instrument: Instrument, *, is_tilt_of_mounting: bool = False
    ) -> Measurement:
        """Return the measurement with what is known of its instrument and its tilt besides."""
        known = self.provenance
        facts: dict[str, Any] = {"instrument": known.instrument.updated_by(instrument)}
        if is_tilt_of_mounting:
            facts["tilt"] = replace(known.tilt, is_of_mounting=True)
        return replace(self, **with_facts(self, **facts))

    def piece(self, crop: Crop, unit: str | None, sizes: Sizes | None) -> Measurement:
        """Return a piece, with its own sizes, in which missing points are still missing.

        What is missing elsewhere does not count, and the heights elsewhere fill nothing in it.
        """
        scale = _UnitAndSides(self, unit, sizes)
        for obstacle in scale.obstacles():
            raise obstacle
        if self.positions is None:
            points, positions = points_in(crop, scale.sides, self.heights.shape, "m"), None
            lengths = [
                side * (each.stop - each.start) / n
                for side, each, n in zip(scale.sides, points, self.heights.shape, strict=True)
            ]
        else:
            points = points_between(crop, scale.metres_aside * (self.positions - self.positions[0]))
            positions = self.positions[points]
            lengths = [scale.metres_aside * (positions[-1] - positions[0])]
        is_whole = self.heights[points].size == self.heights.size
        return replace(
            self,
            heights=self.heights[points].copy(order="K"),  # so that the whole can go
            sizes=tuple(length / scale.metres_aside for length in lengths),
            positions=positions,
            masked=None if self.masked is None else self.masked[points],
            **facts_of_piece(self, points, self.heights.shape),
            is_cut_out=self.is_cut_out if is_whole else True,
            is_piece=True,
        )

    def obstacles(
        self, unit: str | None, sizes: Sizes | None, missing: Missing
    ) -> list[InputError]:
        """List what is still needed before there is a body: a unit, sizes, more known points."""
        name = f"the piece of {self.file}" if self.is_piece else self.file
        too_many = missing.too_many(self.unknown, name)
        return [*self.scale_obstacles(unit, sizes), *([too_many] if too_many else [])]

    def scale_obstacles(self, unit: str | None, sizes: Sizes | None) -> list[InputError]:
        """List what is still needed of the scale; arguments and errors as :meth:`obstacles`."""
        return _UnitAndSides(self, unit, sizes).obstacles()

    def body(
        self,
        unit: str | None,
        sizes: Sizes | None,
        filler: Filler,
        trend: Trend,
        *,
        in_place: bool = False,
    ) -> Body:
        """Return the body, in metres.

        The measurement is not changed, so that another body with another filling can follow from
        it; `in_place` gives that up.
        """
        for obstacle in self.obstacles(unit, sizes, filler.missing):
            raise obstacle
        scale = _UnitAndSides(self, unit, sizes)
        sides = scale.sides
        heights, filled = filler.completed(self.heights, self.file)
        facts: dict[str, Any] = self._facts_of_file()
        if filled:
            facts["filled"] = filled
            if filler.lines:
                facts["filled_over_lines"] = filler.lines
        record: dict[str, str] = {}
        removed = self._trend_to_remove(trend)
        if not self.by_roughline:
            record = {"reader": self.read_by, "file_unit": str(self.unit or unit)}
        if scale.metres != 1 or removed != "none":
            heights = _changeable(heights, in_place or filled is not None)
            if scale.metres != 1:
                heights *= scale.metres
        if self.positions is not None:
            heights, record["resampled"] = _on_even_points(
                self.positions * scale.metres_aside, heights
            )
        if removed != "none":
            before = rms_deviation(heights)
            spacings = [side / n for side, n in zip(sides, heights.shape, strict=True)]
            facts["tilt"] = self.provenance.tilt.less_plane(heights, spacings, removed)
            remove_trend(heights, removed)
            facts["detrended"] = removed
            if left := effect_of_trend(before, rms_deviation(heights)):
                facts["left"] = self.provenance.also_left(left)
        known = with_facts(self, **facts)
        known["settings"] |= record
        is_piece = True if self.is_cut_out is None and not self.by_roughline else self.is_cut_out
        if self.kind == "surface":
            return Surface(heights, (sides[0], sides[1]), "m", is_cut_out=is_piece, **known)
        return Line(heights, sides[0], "m", kind=self.kind, is_cut_out=is_piece, **known)

    def _facts_of_file(self) -> dict[str, Any]:
        """What a file of others states of itself, for the provenance of the body."""
        if self.by_roughline:
            return {}
        masked = None
        if self.masked is not None and self.masked.any():
            are_used = bool((self.masked & ~self.unknown).any())
            masked = Masked(float(self.masked.mean()), self.mask_of, are_used)
        return {
            "format": self.format,
            "corrected": "; ".join(self.corrected),
            "doubts_of_file": "; ".join(self.doubts),
            "masked": masked,
        }

    def _trend_to_remove(self, wanted: Trend) -> Trend:
        """The trend of what an instrument measured; from a piece of ours, what the whole lacks.

        What repeats has no tilt: without a plane it would have steps at its borders.
        """
        if not self.by_roughline or wanted == "none":
            is_repeated = self.is_cut_out is False and wanted in ("tilt", "curvature")
            return "mean" if is_repeated else wanted
        return self.provenance.detrended if self.is_piece else "none"


@dataclass(frozen=True, eq=False)
class _UnitAndSides:
    """Unit and sides of a measurement; each is stated by its file or given by the caller."""

    of: Measurement
    unit: str | None  # given, of all lengths
    sizes: Sizes | None  # given; numbers are in the given unit, and in metres without one

    def obstacles(self) -> list[InputError]:
        """List what neither the file nor the caller states: the unit, the sizes."""
        obstacles: list[InputError] = []
        if self.of.unit or self.unit:
            _ = self.metres
        else:
            obstacles.append(self._unit_needed())
        if self.of.sizes is not None and self.sizes is not None:
            raise InputError(f"{self.of.file} states its sizes; leave {called('sizes')} out")
        if self.of.sizes is None and self.sizes is None:
            obstacles.append(self._sizes_needed())
        return obstacles

    @cached_property
    def metres(self) -> float:
        """Metres in the unit of the file's heights."""
        if self.of.unit and self.unit:
            raise UnitError(
                f"{self.of.file} states its unit, {self.of.unit}; "
                f"leave {called('unit', self.unit)} out"
            )
        unit = self.of.unit or self.unit
        if not unit:
            raise self._unit_needed()
        return metres_per(unit)

    @property
    def metres_aside(self) -> float:
        """Metres in the unit of the file's sizes and positions."""
        return metres_per(self.of.unit_of_sides) if self.of.unit_of_sides else self.metres

    @property
    def sides(self) -> tuple[float, ...]:
        """Sides of the map, or length of the line. [m]"""
        if self.of.sizes is not None:
            return tuple(self.metres_aside * float(size) for size in self.of.sizes)
        given = self.sizes
        if given is None:
            raise self._sizes_needed()
        if isinstance(given, str):
            refuse_decimal_comma(given, "sizes")
            given = given.split(",")
        lengths = np.atleast_1d(np.array(given, object))
        factor = self.metres if self.unit else 1.0
        try:
            sides = tuple(
                in_si(length, "m", "sizes") if isinstance(length, str) else factor * float(length)
                for length in lengths
            )
        except TypeError:
            sides = ()
        points = self.of.heights.shape
        if len(sides) == 1 and len(set(points)) == 1:
            sides *= len(points)
        if len(sides) != len(points) or not all(0 < side < math.inf for side in sides):
            raise self._sizes_refused()
        return sides

    @property
    def _points_and_example(self) -> tuple[str, str]:
        points = self.of.heights.shape
        return " x ".join(map(str, points)), "1 mm, 0.5 mm" if len(points) == 2 else "1 mm"

    def _unit_needed(self) -> UnitError:
        if self.of.unit_of_sides:
            return UnitError(
                f"{self.of.file} states its sizes in {self.of.unit_of_sides} and no unit of its "
                f"heights; give that, such as {called('unit', 'um')}"
            )
        return UnitError(
            f"{self.of.file} states no unit; give the unit of its lengths, such as "
            f"{called('unit', 'um')}"
        )

    def _sizes_needed(self) -> InputError:
        points, example = self._points_and_example
        return InputError(
            f"{self.of.file} states no sizes for its {points} points; give them, such as "
            f"{called('sizes', example)}"
        )

    def _sizes_refused(self) -> InputError:
        points, example = self._points_and_example
        axes = self.of.heights.ndim
        lengths = "a positive length" if axes == 1 else f"{axes} positive lengths"
        return InputError(
            f"is {shown(self.sizes)}; {self.of.file} has {points} points: give {lengths}, such "
            f'as "{example}"; numbers without a unit are in {self.unit or "m"}',
            "sizes",
        )


def in_stated_units(
    heights: Real, sides: tuple[float, ...], unit: str, unit_of_sides: str
) -> dict[str, Any]:
    """Heights, sides and units as a measurement takes them; a unit that is not stated is empty."""
    if unit and unit_of_sides and unit != unit_of_sides:
        heights = heights * (metres_per(unit) / metres_per(unit_of_sides))
    return {
        "heights": heights,
        "sizes": None if unit and not unit_of_sides else sides,
        "unit": (unit_of_sides or unit) if unit else None,
        "unit_of_sides": None if unit else unit_of_sides or None,
    }


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
