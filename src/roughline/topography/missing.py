"""Heights that an instrument could not measure: counted, refused if too many, and filled."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np
from attrs import field, frozen

from roughline.computing.arrays import Mask, Real
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, number, refuse
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.topography.line_levels import Levelling, line_levels
from roughline.topography.settings import Settings
from roughline.topography.trend import Trend, trend_of_known

Filling = Literal["harmonic", "nearest"]
MaskUse = Literal["use", "leave-out"]

_MOSTLY = 0.9  # share of the missing points that counts as most of them
_COLUMNS, _ROWS = 48, 16  # of a coarse map, at most


@dataclass(frozen=True)
class Filled:
    """Missing points that were filled."""

    points: int  # how many
    share: float  # of all points [1]
    method: Filling

    @property
    def record(self) -> Settings:
        """What the settings of a body record."""
        counts = {"missing_points": self.points, "missing_share": self.share}
        return {**counts, "filled": self.method}


def _method(given: Filling) -> Filling:
    """A method by which missing points are filled."""
    allowed_choice("missing", given, get_args(Filling))
    return given


def _share(given: float) -> float:
    """A share of points that may be missing. [1]"""
    needed = "a share from 0 to below 1 is needed"
    share = number("most_missing", given, needed)
    if not 0 <= share < 1:
        refuse("most_missing", given, needed)
    return share


def _mask_use(given: MaskUse) -> MaskUse:
    """What becomes of masked points."""
    allowed_choice("mask", given, get_args(MaskUse))
    return given


@public
@frozen
class Missing:
    """What is done about points of a file that are missing.

    Parameters
    ----------
    method : {"harmonic", "nearest"}, optional
        How missing points are filled: by the smoothest surface through their neighbours, or by
        the nearest known height; both of what the known points depart from their own trend.
    most : float, optional
        Share of missing points above which a file is refused. [1]
    mask : {"use", "leave-out"}, optional
        What becomes of points that a mask in the file selects, such as grains marked in Gwyddion:
        their heights are used, or they are left out and filled like missing ones.

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> heights = np.add.outer(np.arange(9.0), np.arange(9.0))
    >>> heights[2:6, 2:6] = np.nan  # a fifth of the points
    >>> np.save("map.npy", heights)
    >>> missing = rl.Missing("nearest", most=0.3)
    >>> rl.read("map.npy", unit="um", sizes="1 mm", missing=missing).shape
    (9, 9)
    """

    method: Filling = field(default="harmonic", converter=_method)
    most: float = field(default=0.1, converter=_share)
    mask: MaskUse = field(default="use", converter=_mask_use)

    @property
    def other(self) -> Filling:
        """The other method, to compare both."""
        return "nearest" if self.method == "harmonic" else "harmonic"

    def too_many(self, mask: Mask, name: str) -> InputError | None:
        """Return the error for more missing points than are filled; None if there are fewer."""
        unknown = int(np.count_nonzero(mask))
        if unknown <= self.most * mask.size and unknown < mask.size:
            return None
        more = called("most_missing", in_python="missing=rl.Missing(most=...)")
        return InputError(
            f"{name} has {unknown} missing points of {mask.size} ({unknown / mask.size:.0%}); "
            f"up to {self.most:.0%} are filled: crop it to where points are known "
            f"({called('crop')}), or allow more ({more})"
        )


USUALLY_FILLED = Missing()


@dataclass(frozen=True)
class Filler:
    """How missing points are filled about what is removed from the heights afterwards.

    Departures from the trend of the known points are filled, as neither method goes on with a slope
    where points are missing at a border.
    """

    missing: Missing = USUALLY_FILLED
    # the trend that will be removed; points are filled about a plane at least
    removed: Trend = "tilt"
    # how lines will be levelled; their departures from their levels are filled then
    lines: Levelling | None = None

    def completed(self, heights: Any, name: str) -> tuple[Real, Filled | None]:
        """Return the heights with all points known, and what was filled; None if nothing was."""
        if not np.isfinite(np.ma.getdata(heights)).all():
            heights = np.ma.masked_invalid(heights, copy=False)
        unknown = int(np.count_nonzero(np.ma.getmaskarray(heights)))
        filled = None
        if unknown:
            heights = self.filled(heights, name)
            filled = Filled(unknown, unknown / heights.size, self.missing.method)
        return np.array(heights, dtype=np.float64, copy=None), filled

    def filled(self, heights: np.ma.MaskedArray[Any, Any], name: str) -> Real:
        """Return masked heights with all points known, as :meth:`completed` does."""
        mask = np.ma.getmaskarray(heights)
        too_many = self.missing.too_many(mask, name)
        if too_many is not None:
            raise too_many
        trend = trend_of_known(heights, "curvature" if self.removed == "curvature" else "tilt")
        if self.lines is not None and heights.ndim == 2:
            trend = trend + line_levels(heights - trend, self.lines)
        rough = heights - trend
        if heights.ndim == 1:
            points = np.arange(mask.size)
            filled = np.interp(points, points[~mask], np.ma.getdata(rough)[~mask])
        else:
            is_nearest = self.missing.method == "nearest"
            filled = _nearest(rough, mask) if is_nearest else _harmonic(rough)
        return np.where(mask, filled + trend, np.ma.getdata(heights))


@dataclass(frozen=True, eq=False)
class MissingPattern:
    """Where points of a topography are missing."""

    count: int  # of missing points
    share: float  # of them among all points [1]
    regions: int  # groups of neighbouring missing points
    largest: int  # points of the largest group
    at_border: int  # missing points in groups that reach the border
    cells: Real  # their share in equal pieces, shape (columns, rows) or (columns,) [1]

    def __str__(self) -> str:
        if not self.count:
            return "none"
        if self.regions == 1:
            grouped = "one region"
        elif self.largest >= _MOSTLY * self.count:
            grouped = "mostly one region"
        elif self.largest <= (1 - _MOSTLY) * self.count:
            grouped = f"scattered in {self.regions} places"
        else:
            grouped = f"{self.regions} regions"
        if self.at_border >= _MOSTLY * self.count:
            return f"{grouped}, at the border"
        if self.at_border <= (1 - _MOSTLY) * self.count:
            return f"{grouped}, inside"
        return f"{grouped}, at the border and inside"


def missing_pattern(unknown: Mask, sides: tuple[float, ...] | None = None) -> MissingPattern:
    """Describe where points are missing.

    With its sides the map in characters keeps their ratio.
    """
    from scipy import ndimage  # here because it loads slowly

    groups, regions = ndimage.label(unknown, np.ones((3,) * unknown.ndim))
    points = np.bincount(groups.ravel(), minlength=1)
    points[0] = 0  # the known points
    ends = [np.take(groups, [0, -1], axis=axis).ravel() for axis in range(unknown.ndim)]
    pieces = _pieces(unknown.shape, sides or unknown.shape)
    cells = unknown.astype(np.float64)
    for axis, count in enumerate(pieces):
        starts = np.arange(count) * unknown.shape[axis] // count
        sums = np.add.reduceat(cells, starts, axis=axis)
        widths = np.diff([*starts, unknown.shape[axis]])
        cells = sums / widths.reshape([-1 if i == axis else 1 for i in range(unknown.ndim)])
    return MissingPattern(
        count=int(points.sum()),
        share=float(points.sum() / unknown.size),
        regions=int(regions),
        largest=int(points.max()),
        at_border=int(points[np.unique(np.concatenate(ends))].sum()),
        cells=cells,
    )


def _pieces(points: tuple[int, ...], sides: tuple[float, ...]) -> tuple[int, ...]:
    """Columns and rows of a coarse map; a character is about twice as high as it is wide."""
    if len(points) == 1:
        return (min(_COLUMNS, points[0]),)
    columns, rows = float(_COLUMNS), _COLUMNS * sides[1] / sides[0] / 2
    shrink = max(1.0, rows / _ROWS)
    columns, rows = (max(1, round(count / shrink)) for count in (columns, rows))
    return min(columns, points[0]), min(rows, points[1])


def _nearest(heights: Any, mask: Mask) -> Real:
    from scipy import ndimage

    indices = ndimage.distance_transform_edt(mask, return_distances=False, return_indices=True)
    return np.asarray(np.ma.getdata(heights)[tuple(indices)], dtype=np.float64)


def _harmonic(heights: Any) -> Real:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ImportWarning)
        from SurfaceTopography import Topography

    surface = Topography(heights, heights.shape)  # sizes do not matter
    return np.asarray(surface.interpolate_undefined_data_with_harmonic_function().heights())
