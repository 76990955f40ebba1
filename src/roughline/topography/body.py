"""Heights on a grid and their sizes: Surface and Line."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal, TypeVar

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.notebook import in_notebook
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, flag, is_whole, refuse, rising_pair
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.topography.borders import compare_borders, whole_or_piece
from roughline.topography.heights import (
    checked_heights,
    checked_length,
    checked_sides,
    checked_unit,
    rms,
    rms_deviation,
)
from roughline.topography.provenance import NOTHING_KNOWN, Provenance, facts_of_piece, with_facts
from roughline.topography.settings import NOTHING_RECORDED, Settings, read_only
from roughline.topography.trend import Trend, refuse_unknown_trend, without_trend
from roughline.units import in_words, metres_per


def _described(body: Body) -> str:
    """Describe a body in a line: its points, sizes, rms height, and whether it is a piece."""
    points = " × ".join(map(str, body.heights.shape))
    sizes = " × ".join(in_words(side, body.unit) for side in side_lengths(body))
    rms_height = in_words(body.rms_height, body.unit)
    name, kind = type(body).__name__, whole_or_piece(body)
    return f"<{name}: {points} points, {sizes}, rms height {rms_height}, {kind}>"


@public
@dataclass(frozen=True, eq=False, init=False)
class Surface:
    """Heights of a rough surface on a rectangle.

    Parameters
    ----------
    heights : array_like, shape (nx, ny)
        Heights, pointing towards the other body; the array is not copied. [length] Or a topography
        of SurfaceTopography, which has its own sizes; one that states its unit is converted to
        metres, as by :func:`roughline.read`.
    sizes : tuple of float
        Sides of the rectangle, (Lx, Ly); a cell is Lx / nx by Ly / ny. [length]
    unit : str, optional
        Unit of all lengths, where it is known, such as "m" or "um"; :func:`roughline.read` gives
        "m".
    settings : mapping, optional
        A record for people of where the heights come from; stored with every result. Nothing is
        decided by it.
    is_cut_out : bool, optional
        Whether the surface is a piece of a larger one, as measured and cropped surfaces are, or
        periodic. Default: the heights decide. They are a piece if opposite borders do not meet, and
        the settings record the step across.
    provenance : Provenance, optional
        How the heights were measured, and what was done to them: the instrument, the trend that was
        removed, the points that were filled. Default: nothing is known of that. It goes with a body
        that follows from this one, as ``dataclasses.replace(surface, heights=...)`` does, and not
        with its array.

    Raises
    ------
    InputError
        For heights that are not real, finite numbers, for a single height, for sizes that are not
        positive, and for a unit that is none of length.

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> x, y = np.meshgrid(np.linspace(-1, 1, 33), np.linspace(-1, 1, 33), indexing="ij")
    >>> sphere = rl.Surface(-(x**2 + y**2) / 2, sizes=(2.0, 2.0), is_cut_out=False)
    >>> print(sphere.shape, sphere.sizes)
    (33, 33) (2.0, 2.0)
    >>> curve = rl.press(sphere, E_star=1.0, depths=[0.1])
    >>> print(round(float(curve.force[0]), 3))  # Hertz: 4/3 d^(3/2) = 0.042
    0.041
    """

    heights: Real
    sizes: tuple[float, float]
    unit: str | None
    settings: Settings
    is_cut_out: bool
    provenance: Provenance

    __repr__ = _described
    _repr_html_ = in_notebook

    def __init__(
        self,
        heights: Any,
        sizes: tuple[float, float] | None = None,
        unit: str | None = None,
        settings: Settings = NOTHING_RECORDED,
        *,
        is_cut_out: bool | None = None,
        provenance: Provenance | None = None,
    ) -> None:
        if hasattr(heights, "physical_sizes"):
            is_cut_out = not heights.is_periodic if is_cut_out is None else is_cut_out
            heights, sizes, unit, settings = _topography_fields(heights, sizes, unit, settings)
        if sizes is None:
            raise InputError("no sizes are given; give the sides of the surface, (Lx, Ly)")
        heights = checked_heights(heights, dimensions=2)
        if heights.size < 2:
            raise InputError(
                f"the surface has {heights.shape[0]} x {heights.shape[1]} points; at least 1 x 2 "
                "are needed: give more points"
            )
        _set(self, heights=heights, sizes=checked_sides(sizes), settings=read_only(settings))
        _set_facts(self, unit, is_cut_out, provenance)

    @property
    def shape(self) -> tuple[int, int]:
        """Points of the grid, (nx, ny)."""
        nx, ny = self.heights.shape
        return nx, ny

    @property
    def removed_trend(self) -> Trend:
        """Trend that was removed, as by :meth:`detrended`; "none" if none was."""
        return self.provenance.detrended

    @property
    def spacing(self) -> tuple[float, float]:
        """Sides of a cell, (dx, dy). [length]"""
        return self.sizes[0] / self.shape[0], self.sizes[1] / self.shape[1]

    @property
    def area(self) -> float:
        """Nominal area A_0. [length²]"""
        return self.sizes[0] * self.sizes[1]

    @property
    def length(self) -> float:
        """sqrt(A_0), the length L of the paper's eqs. 1 and 2. [length]"""
        return float(np.sqrt(self.sizes[0]) * np.sqrt(self.sizes[1]))

    @cached_property
    def rms_height(self) -> float:
        """Root-mean-square deviation from the mean height. [length]"""
        return rms_deviation(self.heights)

    @property
    def rms_slope(self) -> float:
        """Root-mean-square gradient from forward differences inside the rectangle. [1]"""
        dx, dy = self.spacing
        along_x = rms(np.diff(self.heights, axis=0) / dx)
        along_y = rms(np.diff(self.heights, axis=1) / dy)
        return float(np.hypot(along_x, along_y))

    @property
    def rms_curvature(self) -> float:
        """Root-mean-square mean curvature, half the Laplacian, from central differences.

        NaN on fewer than 3 x 3 points. [1 / length]
        """
        if min(self.shape) < 3:
            return float("nan")
        dx, dy = self.spacing
        along_x = np.diff(self.heights, n=2, axis=0)[:, 1:-1] / dx**2
        along_y = np.diff(self.heights, n=2, axis=1)[1:-1, :] / dy**2
        return rms(along_x + along_y) / 2

    def cropped(self, x: tuple[int, int], y: tuple[int, int]) -> Surface:
        """Return a rectangle of the surface.

        Parameters
        ----------
        x, y : tuple of int
            Index of the first point along each side, and one more than that of the last.

        Raises
        ------
        InputError
            If they are not within the grid, or not in rising order.
        """
        for name, given, n in (("x", x, self.shape[0]), ("y", y, self.shape[1])):
            needed = f"give (first, end) with 0 <= first < end <= {n}, the points there"
            first, end = rising_pair(name, given, needed)
            if first < 0 or end > n or not all(map(is_whole, given)):
                refuse(name, given, needed)
        return piece(self, (slice(*x), slice(*y)))

    def coarsened(self) -> Surface:
        """Return the surface on half as many points a side, the means over two by two.

        Raises
        ------
        InputError
            If a side has an odd number of points.
        """
        nx, ny = self.shape
        if nx % 2 or ny % 2:
            raise InputError(f"the surface has {nx} x {ny} points; give even numbers: crop it")
        heights = self.heights.reshape(nx // 2, 2, ny // 2, 2).mean(axis=(1, 3))
        return with_heights(self, heights, coarsened=nx // 2)

    def detrended(self, trend: Trend = "tilt") -> Surface:
        """Return the surface without its least-squares mean, tilt, or curvature (2nd degree)."""
        return _detrended(self, trend)

    def scaled(self, factor: float) -> Surface:
        """Return the surface with heights times `factor`."""
        return _scaled(self, factor)


@public
@dataclass(frozen=True, eq=False, init=False)
class Line:
    """Heights of a rough line.

    Parameters
    ----------
    heights : array_like, shape (n,)
        Heights, pointing towards the other body; the array is not copied. [length]
    length : float
        Length of the line; a spring stands for length / n. [length]
    unit : str, optional
        Unit of all lengths, where it is known, such as "m" or "um".
    settings : mapping, optional
        A record for people of where the heights come from; stored with every result.
    kind : {"reduced", "profile"}, optional
        Whether this is the line of the reduction method (the paper's eq. 7), or a straight cut
        through a surface such as a stylus measures. A cut is not the reduced line of its surface
        and is not pressed as one.
    is_cut_out : bool, optional
        Whether the line is a piece of a longer one, or periodic; default: as for a
        :class:`Surface`.
    provenance : Provenance, optional
        How the heights were measured, and what was done to them, as for a :class:`Surface`.

    Raises
    ------
    InputError
        For heights that are not real, finite numbers, for fewer than 2 of them, for a length that
        is not positive, and for a unit that is none of length.

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> s = np.linspace(-1, 1, 1001)
    >>> line = rl.Line(-(s**2), length=2.0)  # of the reduction method, for a sphere of radius 1
    >>> curve = rl.press(line, E_star=1.0, depths=[0.1])
    >>> print(round(float(curve.force[0]), 3))  # Hertz: 4/3 d^(3/2) = 0.042
    0.042
    """

    heights: Real
    length: float
    unit: str | None
    settings: Settings
    kind: Literal["reduced", "profile"]
    is_cut_out: bool
    provenance: Provenance

    __repr__ = _described
    _repr_html_ = in_notebook

    def __init__(
        self,
        heights: Any,
        length: float,
        unit: str | None = None,
        settings: Settings = NOTHING_RECORDED,
        kind: Literal["reduced", "profile"] = "reduced",
        *,
        is_cut_out: bool | None = None,
        provenance: Provenance | None = None,
    ) -> None:
        heights = checked_heights(heights, dimensions=1)
        if heights.size < 2:
            raise InputError(f"the line has {heights.size} points; at least 2 are needed")
        allowed_choice("kind", kind, ("reduced", "profile"))
        _set(self, heights=heights, length=checked_length(length), kind=kind)
        _set(self, settings=read_only(settings))
        _set_facts(self, unit, is_cut_out, provenance)

    @property
    def removed_trend(self) -> Trend:
        """Trend that was removed, as by :meth:`detrended`; "none" if none was."""
        return self.provenance.detrended

    @property
    def spacing(self) -> float:
        """Length that one spring stands for. [length]"""
        return self.length / self.heights.size

    @cached_property
    def rms_height(self) -> float:
        """Root-mean-square deviation from the mean height. [length]"""
        return rms_deviation(self.heights)

    @property
    def rms_slope(self) -> float:
        """Root-mean-square slope from forward differences. [1]"""
        return rms(np.diff(self.heights) / self.spacing)

    @property
    def rms_curvature(self) -> float:
        """Root-mean-square second derivative; NaN on fewer than 3 points. [1 / length]"""
        if self.heights.size < 3:
            return float("nan")
        return rms(np.diff(self.heights, n=2) / self.spacing**2)

    def detrended(self, trend: Trend = "tilt") -> Line:
        """Return the line without its least-squares mean, tilt, or curvature (2nd degree)."""
        return _detrended(self, trend)

    def scaled(self, factor: float) -> Line:
        """Return the line with heights times `factor`."""
        return _scaled(self, factor)


Body = Surface | Line
BodyType = TypeVar("BodyType", Surface, Line)


def side_lengths(body: Body) -> tuple[float, ...]:
    """Lengths along each side: both of a surface, the one of a line. [length]"""
    return body.sizes if isinstance(body, Surface) else (body.length,)


def point_spacings(body: Body) -> tuple[float, ...]:
    """Distances of points along each side. [length]"""
    return body.spacing if isinstance(body, Surface) else (body.spacing,)


def with_heights(body: BodyType, heights: Real, **settings: Any) -> BodyType:
    """Return the body with other heights and further settings."""
    return replace(body, heights=heights, settings={**body.settings, **settings})


def after_step(body: BodyType, heights: Real, **facts: Any) -> BodyType:
    """Return the body with other heights and further facts of its provenance."""
    return replace(body, heights=heights, **with_facts(body, **facts))


def piece(body: BodyType, points: tuple[slice, ...]) -> BodyType:
    """Return the points of a body that are kept along each side, with a record of that."""
    return replace(within(body, points), **facts_of_piece(body, points, body.heights.shape))


def within(body: BodyType, points: tuple[slice, ...]) -> BodyType:
    """Return the points of a body that are kept along each side."""
    heights = body.heights[points]
    sizes = tuple(step * n for step, n in zip(point_spacings(body), heights.shape, strict=True))
    sides: dict[str, Any] = {"sizes": sizes} if len(sizes) == 2 else {"length": sizes[0]}
    return replace(
        body,
        heights=heights,
        is_cut_out=body.is_cut_out or heights.size < body.heights.size,
        **sides,
    )


def _scaled(body: BodyType, factor: float) -> BodyType:
    known = with_facts(body, tilt=body.provenance.tilt.scaled(factor))
    known["settings"]["height_factor"] = factor
    return replace(body, heights=body.heights * factor, **known)


def _detrended(body: BodyType, trend: Trend) -> BodyType:
    refuse_unknown_trend(trend)
    tilt = body.provenance.tilt.less_plane(body.heights, point_spacings(body), trend)
    known = with_facts(body, tilt=tilt, detrended=trend)
    known["settings"]["detrended"] = trend
    return replace(body, heights=without_trend(body.heights, trend), **known)


def _set(body: Body, **fields: Any) -> None:
    """Set fields at birth."""
    for name, value in fields.items():
        object.__setattr__(body, name, value)


def _set_facts(
    body: Body,
    unit: str | None,
    is_cut_out: bool | None,
    provenance: Provenance | None,
) -> None:
    """Set what is known of a body with heights, as given, or as its borders tell."""
    provenance = NOTHING_KNOWN if provenance is None else provenance
    if not isinstance(provenance, Provenance):
        refuse("provenance", provenance, "a Provenance is needed, as another body has")
    if is_cut_out is None:
        borders = compare_borders(body.heights)
        _set(body, provenance=provenance, is_cut_out=borders.jump)
        found = with_facts(body, borders=borders)
        _set(body, provenance=found["provenance"], settings=read_only(found["settings"]))
    else:
        _set(body, provenance=provenance, is_cut_out=flag("is_cut_out", is_cut_out))
    _set(body, unit=checked_unit(unit))


def _topography_fields(
    topography: Any, sizes: object, unit: str | None, settings: Settings
) -> tuple[Real, tuple[float, float], str | None, Settings]:
    """Fields of a Surface from a map of SurfaceTopography, in metres if it states its unit."""
    if topography.dim != 2:
        raise InputError("the topography is a line scan; a Surface needs a map: make a Line of it")
    if sizes is not None:
        raise InputError(f"the topography has its own sizes; leave {called('sizes')} out")
    origin = "periodic topography" if topography.is_periodic else "topography"
    factor, heights = 1.0, topography.heights()
    if topography.unit:
        if unit:
            raise InputError(
                f"the topography states its unit, {topography.unit}; "
                f"leave {called('unit', unit)} out"
            )
        factor, unit = metres_per(topography.unit), "m"
        settings = {"file_unit": topography.unit, **settings}
    x, y = (factor * float(size) for size in topography.physical_sizes)
    settings = {"origin": origin, **settings}
    return heights if factor == 1 else heights * factor, (x, y), unit, settings
