"""Provenance of a body: how its heights were measured, and what was done to them since.

These are typed facts, and they decide what is inferred and warned of. The settings of the body
record the same for people; nothing is decided by them.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Literal, Protocol, get_args

from roughline.computing.arrays import Real
from roughline.errors.checks import allowed_choice, between, positive
from roughline.topography.borders import Borders
from roughline.topography.crop import ranges_in_words
from roughline.topography.line_levels import Levelling
from roughline.topography.missing import Filled
from roughline.topography.settings import Settings
from roughline.topography.trend import Trend, refuse_unknown_trend, slopes_of_plane

Pixels = Literal["means", "points"]
Step = Literal["levelled", "scars", "outliers", "detrended", "low_pass", "resampled"]

TILT_REMOVED = ("tilt_removed_x", "tilt_removed_y")
TILT, MOUNTING = "tilt", "mounting"
"""Names and values in the settings of what is known of a tilt."""

_WHOLE_BODY_SETTINGS = (
    *("missing_points", "missing_share", "filled", "outliers_kept"),
    *("mask", "mask_of", "masked_share"),
    *("border_step", "border_chance", "low_pass_kept"),
)
"""Names in the settings of what is said of all points of a body, or of its borders."""


@dataclass(frozen=True)
class Instrument:
    """What is known of the instrument that measured heights; None where it is not known."""

    pixels: Pixels | None = None  # whether heights are means over pixels or those of points
    blur: float | None = None  # standard deviation of its Gaussian blur, beside the pixels [length]
    tip_radius: float | None = None  # radius of the tip that traced the surface [length]

    def __post_init__(self) -> None:
        if self.pixels is not None:
            allowed_choice("pixels", self.pixels, get_args(Pixels))
        if self.blur is not None:
            between("blur", self.blur, 0.0, sys.float_info.max, "a length from 0 on is needed")
        if self.tip_radius is not None:
            positive("tip_radius", self.tip_radius)

    @property
    def record(self) -> Settings:
        """What the settings of a body record."""
        known = {"pixels": self.pixels, "blur": self.blur, "tip_radius": self.tip_radius}
        return {name: value for name, value in known.items() if value is not None}

    def updated_by(self, other: Instrument) -> Instrument:
        """Return what is known of this instrument, and by another account, which counts first."""
        return Instrument(
            other.pixels or self.pixels,
            self.blur if other.blur is None else other.blur,
            other.tip_radius or self.tip_radius,
        )

    def in_units(self, length: float) -> Instrument:
        """Return the same instrument with its lengths divided by a new unit."""
        blur, radius = (
            None if each is None else each / length for each in (self.blur, self.tip_radius)
        )
        return replace(self, blur=blur, tip_radius=radius)


UNKNOWN = Instrument()  # an instrument of which nothing is known


@dataclass(frozen=True)
class Tilt:
    """What is known of the tilt of a body."""

    removed: tuple[float, ...] = ()  # slopes of the planes that were removed, along each side [1]
    is_of_mounting: bool = False  # whether it is that of the mounting alone, as of a stage

    @property
    def record(self) -> Settings:
        """What the settings of a body record."""
        slopes = zip(TILT_REMOVED, self.removed, strict=False)
        return {**({TILT: MOUNTING} if self.is_of_mounting else {}), **dict(slopes)}

    def less_plane(self, heights: Real, spacings: Sequence[float], trend: Trend) -> Tilt:
        """Return what is known after a trend is removed from heights, whose plane goes with it."""
        if trend not in ("tilt", "curvature"):
            return self
        slopes = slopes_of_plane(heights, spacings)
        before = self.removed or (0.0,) * len(slopes)
        both = zip(slopes, before, strict=True)
        return replace(self, removed=tuple(slope + earlier for slope, earlier in both))

    def scaled(self, factor: float) -> Tilt:
        """Return the tilt of heights times a factor."""
        return replace(self, removed=tuple(slope * factor for slope in self.removed))


@dataclass(frozen=True)
class Masked:
    """Points that a mask in the file selects."""

    share: float  # of all points [1]
    by: str  # the program that made the mask
    are_used: bool  # whether their heights are; else they were filled like missing points

    @property
    def record(self) -> Settings:
        """What the settings of a body record."""
        use = "used" if self.are_used else "left out"
        return {"mask": use, "mask_of": self.by, "masked_share": self.share}


@dataclass(frozen=True)
class Left:
    """What a step of a preparation left of the roughness."""

    step: Step
    height: float  # rms height after the step over that before [1]
    slope: float | None = None  # the same of the rms slope; None where it was not looked at [1]

    @property
    def record(self) -> Settings:
        """What the settings of a body record."""
        shares = {"height": self.height, "slope": self.slope}
        return {
            f"{self.step}_left_of_rms_{of}": share
            for of, share in shares.items()
            if share is not None
        }


@dataclass(frozen=True)
class Facing:
    """Two surfaces whose heights were added, as they face each other."""

    first: Provenance
    second: Provenance
    cropped: tuple[bool, bool] = (False, False)  # whether either was, to what both have in common
    is_resampled: bool = False  # whether the second was, to the grid of the first


@dataclass(frozen=True)
class Provenance:
    """How heights were measured, and what was done to them since.

    Of heights that are given as an array nothing is known. Each fact has the name that it has in
    the settings, where they record it in one number or text.
    """

    instrument: Instrument = UNKNOWN
    tilt: Tilt = Tilt()
    # what was seen at the borders, where the heights decided whether the body is a piece
    borders: Borders | None = None
    format: str = ""  # of the file, one of `formats.FORMATS`
    corrected: str = ""  # what another reader of the file gets wrong and is right here
    doubts_of_file: str = ""  # what in the file itself is wrong or unusual
    masked: Masked | None = None
    filled: Filled | None = None  # points that were missing
    filled_before_crop: int = 0  # those of the larger piece that this one was cropped from
    filled_over_lines: Levelling | None = None  # whether between lines levelled so, and how
    filled_between_levels: int = 0  # points that were filled before lines were levelled
    cropped_share: float | None = None  # share of the points that the last crop kept [1]
    lines_levelled: Levelling | None = None  # how
    scars_removed: int | None = None  # points of scars; None where none were looked for
    outliers_kept: int = 0  # spikes
    outliers_removed: int | None = None  # spikes; None where they were not to be removed
    low_pass: float | None = None  # cutoff wavelength [length]
    low_pass_kept: str = ""  # points that a low pass kept, where it left some out at borders
    resampled_to: str = ""  # points along each side
    left: tuple[Left, ...] = ()  # of the roughness, by the last step of each kind
    detrended: Trend = "none"  # the trend that was removed last
    facing: Facing | None = None

    def __post_init__(self) -> None:
        refuse_unknown_trend(self.detrended)

    def __repr__(self) -> str:
        known = (
            f"{each.name}={value!r}"
            for each in fields(self)
            if (value := getattr(self, each.name)) != each.default
        )
        return f"Provenance({', '.join(known)})"

    @property
    def record(self) -> Settings:
        """What the settings of a body record; of two bodies, they hold both records besides."""
        found: dict[str, str | int | float] = {}
        for each in fields(self):
            value = getattr(self, each.name)
            if value == each.default or isinstance(value, Facing):
                continue
            if isinstance(value, str | int | float):
                found[each.name] = value
            else:
                for part in value if isinstance(value, tuple) else (value,):
                    found.update(part.record)
        return found

    @property
    def missing_share(self) -> float:
        """Share of the points that were missing; of two bodies, of the one that lacks more. [1]"""
        own = 0.0 if self.filled is None else self.filled.share
        return max([own, *(each.missing_share for each in self._both_bodies)])

    @property
    def is_levelled_by_lines(self) -> bool:
        """Whether lines were levelled; of two bodies, those of either."""
        return self.lines_levelled is not None or any(
            each.is_levelled_by_lines for each in self._both_bodies
        )

    @property
    def _both_bodies(self) -> tuple[Provenance, ...]:
        """Those of two bodies whose heights were added."""
        return () if self.facing is None else (self.facing.first, self.facing.second)

    def left_by(self, step: Step) -> Left | None:
        """Return what a step left of the roughness; None if it was not done."""
        return next((each for each in self.left if each.step == step), None)

    def also_left(self, left: Left) -> tuple[Left, ...]:
        """Return what all steps left of the roughness, with a further one."""
        return (*(each for each in self.left if each.step != left.step), left)


NOTHING_KNOWN = Provenance()


class _Known(Protocol):
    """What has a provenance, and settings that record it: a body, or what a file holds."""

    @property
    def provenance(self) -> Provenance: ...
    @property
    def settings(self) -> Settings: ...


def with_facts(of: _Known, **facts: Any) -> dict[str, Any]:
    """Return provenance and settings with further facts, to be replaced in what they are of."""
    return {
        "provenance": replace(of.provenance, **facts),
        "settings": {**of.settings, **Provenance(**facts).record},
    }


def facts_of_piece(of: _Known, points: tuple[slice, ...], shape: tuple[int, ...]) -> dict[str, Any]:
    """Return provenance and settings of a piece: its crop, and nothing that is said of the whole.

    How many of the points that had been filled lie in it is not known.
    """
    before = of.provenance
    facts: dict[str, Any] = {
        "filled_before_crop": before.filled.points if before.filled else before.filled_before_crop,
        "cropped_share": math.prod(each.stop - each.start for each in points) / math.prod(shape),
    }
    of_piece = replace(
        before, **facts, filled=None, outliers_kept=0, masked=None, borders=None, low_pass_kept=""
    )
    left = {key: value for key, value in of.settings.items() if key not in _WHOLE_BODY_SETTINGS}
    left["cropped"] = ranges_in_words(points)
    return {"provenance": of_piece, "settings": {**left, **Provenance(**facts).record}}
