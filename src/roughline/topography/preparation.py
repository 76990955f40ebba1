"""Preparation of measured topographies: steps, each recorded in the settings of the body."""

from __future__ import annotations

import math
import warnings
from bisect import bisect_left
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.computing.memory import fits_into_memory, refuse_beyond_memory
from roughline.errors import InputError, PreparationWarning
from roughline.errors.checks import (
    allowed_choice,
    as_number,
    flag,
    is_whole,
    positive,
    refuse,
    several,
)
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.topography.body import (
    Body,
    BodyType,
    Surface,
    after_step,
    piece,
    side_lengths,
)
from roughline.topography.crop import Crop, points_in
from roughline.topography.effects import effects, with_effect
from roughline.topography.line_levels import LEVELLINGS, Levelling
from roughline.topography.low_pass import low_passed, refuse_long
from roughline.topography.missing import Filler
from roughline.topography.scan_lines import levelled, without_scars
from roughline.topography.trend import Trend, refuse_unknown_trend, without_trend

TILT_MATTERS = 0.05  # share of the rms height above which a tilt is told
_SPIKE = 5.0  # times the scatter of neighbours
_NEIGHBOURS = {1: (5, 25, 101), 2: (5,)}  # points along a side, of lines and of surfaces
_STEPS_NEED = {1: 14, 2: 9}  # heights at once for each, of lines and of surfaces, resampling aside
_MOST_POINTS = 10**9  # points along a side that are thought of


@public
@dataclass(frozen=True)
class Preparation:
    """Steps, in the order in which they are done; each is recorded in the settings of the body.

    Parameters
    ----------
    crop : tuple of float, optional
        (x0, x1, y0, y1) of a surface, y from the top of its picture; (x0, x1) of a line. Whole
        points are kept. [length]
    lines : {"median", "tilt", "differences"}, optional
        What is taken from each line of a map along x, as its level jumps from one to the next: its
        median, a straight line, or the median of its differences from the line before. It takes
        steps between lines, and tilt and waves across them, too.
    remove_scars : bool, optional
        Whether runs of points of a line that stand off both lines beside it are filled like missing
        points.
    remove_outliers : bool, optional
        Whether spikes are removed and filled like missing points. They are always counted.
    trend : {"tilt", "curvature", "mean", "none"}, optional
        Least-squares polynomial that is removed. Default: the one that was removed from the body
        before, for example by :func:`roughline.read`, is removed again after a crop or where lines,
        scars or spikes were removed; otherwise nothing is removed.
    low_pass : float, optional
        Cutoff wavelength of a Gaussian filter after ISO 16610-61 (half of the amplitude of a wave
        of that length passes). Half a cutoff is left out at each border of a piece; periodic bodies
        keep all points. [length]
    points : int or tuple of int, optional
        Points to resample to: (nx, ny), or one number for the longer side of a surface or a line.

    Raises
    ------
    InputError
        If a value makes no sense.
    """

    crop: Crop | None = None
    lines: Levelling | None = None
    remove_scars: bool = False
    remove_outliers: bool = False
    trend: Trend | None = None
    low_pass: float | None = None
    points: int | tuple[int, int] | None = None

    def __post_init__(self) -> None:
        flag("remove_outliers", self.remove_outliers)
        flag("remove_scars", self.remove_scars)
        if self.lines is not None:
            allowed_choice("lines", self.lines, LEVELLINGS)
        if self.trend is not None:
            refuse_unknown_trend(self.trend)
        if self.crop is not None:
            ends = [as_number(each) for each in several(self.crop)]
            if len(ends) not in (2, 4) or not all(e is not None and math.isfinite(e) for e in ends):
                refuse("crop", self.crop, "give from and to along each side, (x0, x1, y0, y1)")
        if self.low_pass is not None:
            positive("low_pass", self.low_pass, "a positive wavelength is needed")
        if self.points is not None:
            for n in several(self.points) or [self.points]:
                if not is_whole(n) or n < 2:
                    refuse("points", self.points, "whole numbers of at least 2 are needed")
            if of_each_side := several(self.points):
                object.__setattr__(self, "points", tuple(of_each_side))

    def applied(self, body: BodyType) -> BodyType:
        """Return the body, prepared; its settings record what each step did to the roughness.

        Raises
        ------
        InputError
            If a step does not suit the body, or memory cannot hold it.
        """
        if self.crop is not None:
            body = _cropped(body, self.crop)
        if self.low_pass is not None:
            refuse_long(body, self.low_pass)
        self._refuse_beyond_memory(body)
        if self.lines is not None:
            body = levelled(body, self.lines)
        if self.remove_scars:
            body = without_scars(body)
        spikes = outliers(body)
        count = int(np.count_nonzero(spikes))
        if self.remove_outliers:
            body = _without_spikes(body, spikes, count)
        elif count:
            body = after_step(body, body.heights, outliers_kept=count)
        body = self._without_trend(body, is_changed=bool(count) and self.remove_outliers)
        if self.low_pass is not None:
            body = low_passed(body, self.low_pass)
        if self.points is not None:
            body = with_effect(body, resampled(body, self.points), "resampled")
        return body

    def _without_trend(self, body: BodyType, *, is_changed: bool) -> BodyType:
        """Remove the trend that is asked for, or again the one of a body that changed."""
        is_changed |= self.crop is not None or self.lines is not None or self.remove_scars
        trend = self.trend or (body.removed_trend if is_changed else "none")
        if trend == "none":
            return body
        level = body.detrended(trend)
        is_roughness = self.trend is not None and trend != "mean"
        return with_effect(body, level, "detrended") if is_roughness else level

    def _refuse_beyond_memory(self, body: Body) -> None:
        """Refuse steps whose largest need of memory is more than is free."""
        shape = body.heights.shape
        needed, what = _STEPS_NEED[len(shape)] * math.prod(shape), _times(shape)
        advice = "crop to a smaller piece"
        if self.points is not None:
            wanted = _wanted(body, self.points)
            most = _resampling_needs(shape, wanted)
            if most > needed:
                advice = f"resample to fewer points{_allowed(body, max(wanted), needed)}"
                needed = most
                what += f" and resampling to {_times(wanted)}"
        refuse_beyond_memory(8 * needed, f"preparing {what} points", advice)


def _allowed(body: Body, too_many: int, needed: int) -> str:
    """Say to how many points a body may be resampled, if its other steps fit into memory."""

    def fits(points: int) -> bool:
        resampling = _resampling_needs(body.heights.shape, _wanted(body, points))
        return fits_into_memory(8 * max(needed, resampling))

    thought_of = range(2, min(too_many, _MOST_POINTS))
    most = bisect_left(thought_of, True, key=lambda points: not fits(points)) + 1
    return f", up to {most} along the longer side" if most > 1 else ""


@public
def prepared(body: Body, preparation: Preparation | None = None) -> Body:
    """Return a body prepared.

    It warns (:class:`roughline.PreparationWarning`) of steps that change nothing, of those that
    take most of the rms height, and of points that were filled before lines were levelled. The
    settings of the body record what each step did.

    Parameters
    ----------
    body : Surface or Line
        Any body.
    preparation : Preparation, optional
        Default: spikes are counted, and nothing is changed.

    Raises
    ------
    InputError
        If a step does not suit the body, or memory cannot hold it.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, rng=7)
    >>> piece = rl.prepared(surface, rl.Preparation(crop=(0, 5e-4, 0, 5e-4), trend="tilt"))
    >>> print(piece.shape, piece.is_cut_out)
    (32, 32) True
    """
    found = as_prepared(body, preparation)
    count = found.provenance.filled_between_levels
    if preparation and preparation.lines and count:
        fact = Fact("filled_between_levels", points=count)
        warnings.warn(str(fact), PreparationWarning, stacklevel=2)
    for effect in effects(found) if preparation else ():
        if effect.fact.is_grave or effect.is_idle:
            warnings.warn(str(effect.fact), PreparationWarning, stacklevel=2)
    return found


def as_prepared(body: Body, preparation: Preparation | None) -> Body:
    """Return a body prepared, for those who say themselves what the steps did."""
    preparation = preparation or Preparation()
    if isinstance(body, Surface):
        return preparation.applied(body)
    return preparation.applied(body)  # one call for each type of body


def tilt_warnings(surface: Surface) -> tuple[Fact, ...]:
    """Warn of a piece of a larger surface whose mean plane is much of its height.

    Such a plane is mostly the tilt of the stage, or part of a wave longer than the piece. The side
    that it lifts carries the load.
    """
    if not surface.is_cut_out:
        return ()
    lower = 1 - math.sqrt(1 - _tilt_share(surface.heights, surface.rms_height))
    if lower <= TILT_MATTERS:
        return ()
    return (Fact("surface_is_tilted", lower=lower),)


def _tilt_share(heights: Real, rms_height: float) -> float:
    """Share of the mean square height that lies in the least-squares plane. [1]"""
    if rms_height == 0:
        return 0.0
    mean, share = heights.mean(), 0.0
    for axis, n in enumerate(heights.shape):
        x = np.linspace(-1.0, 1.0, n)
        across = (heights.mean(axis=1 - axis) - mean) / rms_height
        share += float(x @ across) ** 2 / float(x @ x) / n
    return min(share, 1.0)


def outliers(body: Body) -> Mask:
    """Mark spikes: points that stick out far from their neighbours.

    A point is marked if its distance from the median of its neighbours is more than five times the
    scatter of neighbours, which is a median over the whole body. Neighbours are 5 x 5 points of a
    surface, and 5, 25 and 101 of a line, whose points are often closer than its stylus is wide.
    Groups wider than half of the neighbours are steps, scratches or particles, and are not marked.
    """
    from scipy import ndimage  # here because it loads slowly

    heights = without_trend(body.heights, "tilt")
    marked = np.zeros(heights.shape, dtype=bool)
    for size in _NEIGHBOURS[heights.ndim]:
        mean, square = (
            ndimage.uniform_filter(values, size, mode="nearest") for values in (heights, heights**2)
        )
        scatter = math.sqrt(max(0.0, float(np.median(square - mean**2))))
        distance = np.abs(heights - ndimage.median_filter(heights, size=size, mode="nearest"))
        spots, _ = ndimage.label(distance > _SPIKE * scatter)
        sizes = np.bincount(spots.ravel())
        narrow = sizes <= (size // 2 + 1) ** heights.ndim
        narrow[0] = False  # the points outside all spots
        if scatter > 0:
            marked |= narrow[spots]
    return marked


def _cropped(body: BodyType, crop: Crop) -> BodyType:
    return piece(body, points_in(crop, side_lengths(body), body.heights.shape, body.unit))


def _without_spikes(body: BodyType, spikes: Mask, count: int) -> BodyType:
    """Return a body with its spikes filled; without any, the settings record that."""
    if not count:
        return after_step(body, body.heights, outliers_removed=0)
    known = np.ma.MaskedArray(body.heights, spikes)
    filled = Filler().filled(known, "the topography, without its outliers,")
    return with_effect(body, after_step(body, filled, outliers_removed=count), "outliers")


def resampled(body: BodyType, points: int | tuple[int, ...]) -> BodyType:
    """Return the body on another grid over the same sides.

    Means over cells where the new grid is coarser, cubic splines where it is finer.
    """
    from scipy import ndimage

    heights, shape = body.heights, body.heights.shape
    wanted = _wanted(body, points)
    for axis, n in enumerate(wanted):
        if n < shape[axis]:
            heights = _means(heights, axis, n)
        elif n > shape[axis]:
            zoom = [1.0] * len(shape)
            zoom[axis] = n / shape[axis]
            heights = ndimage.zoom(heights, zoom, order=3, mode="nearest", grid_mode=True)
    return after_step(body, heights, resampled_to=_times(wanted))


def _wanted(body: Body, points: int | tuple[int, ...]) -> tuple[int, ...]:
    """Points along each side of the new grid; a body that is one point wide stays so."""
    shape = body.heights.shape
    if isinstance(points, tuple):
        wanted = points
    elif isinstance(body, Surface):
        wanted = tuple(max(min(2, n), _rounded_ratio(points * n, max(shape))) for n in shape)
    else:
        wanted = (points,)
    if len(wanted) != len(shape):
        raise InputError(f"points is {points}; give {len(shape)} of them")
    return wanted


def _rounded_ratio(numerator: int, denominator: int) -> int:
    """Ratio of whole numbers of any size, rounded."""
    return (2 * numerator + denominator) // (2 * denominator)


def _resampling_needs(shape: tuple[int, ...], wanted: tuple[int, ...]) -> int:
    """Most heights, of 8 bytes each, that resampling holds at once."""
    held = before = math.prod(shape)
    for axis, n in enumerate(wanted):
        after = before // shape[axis] * n
        held = max(held, 3 * before + (4 if n < shape[axis] else 1) * after)
        before = after
    return max(held, math.prod(shape) + 3 * before)  # the last for what it did to the slope


def _times(shape: tuple[int, ...]) -> str:
    return " x ".join(map(str, shape))


def _means(heights: Real, axis: int, n: int) -> Real:
    """Means over n equal pieces along an axis; a cell counts by its part within the piece."""
    cells = heights.shape[axis]
    moved = np.moveaxis(heights, axis, 0)
    sums = np.concatenate([np.zeros((1, *moved.shape[1:])), np.cumsum(moved, axis=0)])
    edges = np.arange(n + 1) * (cells / n)
    below = np.minimum(edges.astype(np.intp), cells - 1)
    part = (edges - below).reshape(-1, *[1] * (moved.ndim - 1))
    at_edges = sums[below] + part * (sums[below + 1] - sums[below])
    return np.moveaxis(np.diff(at_edges, axis=0) * (n / cells), 0, axis)
