"""Heights on a grid and their sizes: Surface and Line."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from roughline.errors import InputError
from roughline.topography.trend import Trend, without_trend

Settings = Mapping[str, str | int | float]

MEASURED = "instrument file"
"""Origin, in the settings, of what an instrument measured."""

PIECE = "topography"
"""Origin of a topography of SurfaceTopography that is not periodic, so a piece of a larger one."""

_NOT_GIVEN = (math.nan, math.nan)  # sizes

# Beyond this, squares of lengths leave the range of double precision.
_LARGEST = 1e150
_BLOCK = 2**16  # heights looked at together


@dataclass(frozen=True, eq=False)
class Surface:
    """Heights of a rough surface on a rectangle.

    Parameters
    ----------
    heights : array_like, shape (nx, ny)
        Heights, pointing towards the other body; the array is not copied. [length] Or a topography
        of SurfaceTopography, which brings its sizes along; one that states its unit is converted
        to metres, as by :func:`roughline.read`.
    sizes : tuple of float
        Sides of the rectangle, (Lx, Ly); a cell is Lx / nx by Ly / ny. [length]
    unit : str, optional
        Unit of all lengths, where it is known; :func:`roughline.read` gives "m".
    settings : mapping, optional
        Where the heights come from; travels with every result.

    Raises
    ------
    InputError
        For heights that are not real, finite numbers or a single one, and for sizes that are not
        positive.
    """

    heights: NDArray[np.float64]
    sizes: tuple[float, float] = _NOT_GIVEN
    unit: str | None = None
    settings: Settings = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        if hasattr(self.heights, "physical_sizes"):
            self._take_over(self.heights)
        if self.sizes is _NOT_GIVEN:
            raise InputError("no sizes are given; give the sides of the surface, (Lx, Ly)")
        heights = _checked_heights(self.heights, dimensions=2)
        if heights.size < 2:
            raise InputError(
                f"the surface has {heights.shape[0]} x {heights.shape[1]} points; at least 1 x 2 "
                "are needed: give more points"
            )
        _freeze(self, heights=heights, sizes=_checked_sizes("sizes", self.sizes))

    def _take_over(self, topography: Any) -> None:
        """Set heights, sizes and unit to those of a topography of SurfaceTopography."""
        from roughline.units import metres_per

        if topography.dim != 2:
            raise InputError("the topography is a line scan; a Surface takes a map: give a Line")
        if self.sizes is not _NOT_GIVEN:
            raise InputError("the topography has its own sizes; leave sizes out")
        if topography.unit and self.unit:
            raise InputError(f"the topography states its unit, {topography.unit}; leave unit out")
        factor = metres_per(topography.unit) if topography.unit else 1.0
        heights = topography.heights()
        _set(
            self,
            heights=heights if factor == 1 else heights * factor,
            sizes=tuple(factor * float(size) for size in topography.physical_sizes),
            unit="m" if topography.unit else self.unit,
            settings={
                "origin": "periodic topography" if topography.is_periodic else PIECE,
                **({"file_unit": topography.unit} if topography.unit else {}),
                **self.settings,
            },
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Points of the grid, (nx, ny)."""
        nx, ny = self.heights.shape
        return nx, ny

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

    @property
    def rms_height(self) -> float:
        """Root-mean-square deviation from the mean height. [length]"""
        return _rms_deviation(self.heights)

    @property
    def rms_slope(self) -> float:
        """Root-mean-square gradient from forward differences inside the rectangle. [1]"""
        dx, dy = self.spacing
        along_x = _rms(np.diff(self.heights, axis=0) / dx)
        along_y = _rms(np.diff(self.heights, axis=1) / dy)
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
        return _rms(along_x + along_y) / 2

    @property
    def is_cut_out(self) -> bool:
        """Whether a larger surface goes on beyond the border: a measured or a cropped one."""
        return "cropped" in self.settings or self.settings.get("origin") in (MEASURED, PIECE)

    def cropped(self, x: tuple[int, int], y: tuple[int, int]) -> Surface:
        """Return a rectangle of the surface.

        Parameters
        ----------
        x, y : tuple of int
            First point along each side, and the one after the last.

        Raises
        ------
        InputError
            If they are not within the grid, in rising order.
        """
        for name, (first, end), n in (("x", x, self.shape[0]), ("y", y, self.shape[1])):
            if not 0 <= first < end <= n:
                raise InputError(
                    f"{name} is ({first}, {end}); give 0 <= first < end <= {n}, the points there"
                )
        (dx, dy), heights = self.spacing, self.heights[slice(*x), slice(*y)]
        settings = {**self.settings, "cropped": f"x {x[0]}:{x[1]}, y {y[0]}:{y[1]}"}
        sizes = (dx * heights.shape[0], dy * heights.shape[1])
        return Surface(heights, sizes, self.unit, settings)

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

    def settings_as_body(self) -> Settings:
        """Return the settings with names that say that they are the body's."""
        return _as_body(self.settings)

    def detrended(self, trend: Trend = "tilt") -> Surface:
        """Return the surface without its least-squares mean, tilt, or curvature (2nd degree)."""
        return with_heights(self, without_trend(self.heights, trend), detrended=trend)

    def scaled(self, factor: float) -> Surface:
        """Return the surface with heights times `factor`."""
        return with_heights(self, self.heights * factor, height_factor=factor)


@dataclass(frozen=True, eq=False)
class Line:
    """Heights of a rough line.

    Parameters
    ----------
    heights : array_like, shape (n,)
        Heights, pointing towards the other body; the array is not copied. [length]
    length : float
        Length of the line; a spring stands for length / n. [length]
    unit : str, optional
        Unit of all lengths, where it is known.
    settings : mapping, optional
        Where the heights come from; travels with every result.
    kind : {"reduced", "profile"}, optional
        Whether this is the line of the reduction method (the paper's eq. 7), or a straight cut
        through a surface such as a stylus measures. A cut is not the reduced line of its surface
        and is not pressed as one.

    Raises
    ------
    InputError
        For heights that are not real, finite numbers or fewer than 2, and for a length that is
        not positive.
    """

    heights: NDArray[np.float64]
    length: float
    unit: str | None = None
    settings: Settings = field(default_factory=dict, repr=False)
    kind: Literal["reduced", "profile"] = "reduced"

    def __post_init__(self) -> None:
        heights = _checked_heights(self.heights, dimensions=1)
        if heights.size < 2:
            raise InputError(f"the line has {heights.size} points; at least 2 are needed")
        if self.kind not in ("reduced", "profile"):
            raise InputError(f'kind is {self.kind!r}; a line is "reduced" or a "profile"')
        _freeze(self, heights=heights, length=_checked_sizes("length", [self.length])[0])

    @property
    def spacing(self) -> float:
        """Length that one spring stands for. [length]"""
        return self.length / self.heights.size

    @property
    def rms_height(self) -> float:
        """Root-mean-square deviation from the mean height. [length]"""
        return _rms_deviation(self.heights)

    @property
    def rms_slope(self) -> float:
        """Root-mean-square slope from forward differences. [1]"""
        return _rms(np.diff(self.heights) / self.spacing)

    @property
    def rms_curvature(self) -> float:
        """Root-mean-square second derivative; NaN on fewer than 3 points. [1 / length]"""
        if self.heights.size < 3:
            return float("nan")
        return _rms(np.diff(self.heights, n=2) / self.spacing**2)

    def settings_as_body(self) -> Settings:
        """Return the settings with names that say that they are the body's."""
        return _as_body(self.settings)

    def detrended(self, trend: Trend = "tilt") -> Line:
        """Return the line without its least-squares mean, tilt, or curvature (2nd degree)."""
        return with_heights(self, without_trend(self.heights, trend), detrended=trend)

    def scaled(self, factor: float) -> Line:
        """Return the line with heights times `factor`."""
        return with_heights(self, self.heights * factor, height_factor=factor)


Body = Surface | Line
BodyType = TypeVar("BodyType", Surface, Line)


def with_heights(body: BodyType, heights: NDArray[np.float64], **settings: Any) -> BodyType:
    """Return the body with other heights and further settings."""
    return replace(body, heights=heights, settings={**body.settings, **settings})


def _as_body(settings: Settings) -> Settings:
    return {f"body_{name}": value for name, value in settings.items()}


def _set(body: Body, **fields: Any) -> None:
    """Set fields at birth."""
    for name, value in fields.items():
        object.__setattr__(body, name, value)


def _freeze(body: Body, **fields: Any) -> None:
    """Set checked fields at birth; the settings become read-only."""
    _set(body, **fields, settings=MappingProxyType(dict(body.settings)))


def _checked_heights(heights: Any, dimensions: int) -> NDArray[np.float64]:
    name = {1: "a Line", 2: "a Surface"}[dimensions]
    if isinstance(heights, np.ma.MaskedArray):
        missing = int(np.count_nonzero(np.ma.getmaskarray(heights)))
        if missing:
            raise InputError(
                f"{missing} of {heights.size} heights are masked; all must be known: fill them "
                "or crop to where they are"
            )
        heights = heights.data
    try:
        array = np.asarray(heights)
        if np.iscomplexobj(array):
            raise TypeError("complex")
        array = np.asarray(array, dtype=np.float64)
        if not array.flags.f_contiguous:  # instruments' maps often run along y first; left so
            array = np.ascontiguousarray(array)
        array = array.view()
    except (TypeError, ValueError) as error:
        raise InputError(f"the heights are not an array of real numbers ({error})") from error
    if array.ndim != dimensions:
        raise InputError(
            f"the heights have {array.ndim} dimensions; {name} takes {dimensions}: reshape them"
        )
    largest = max(array.max(), -array.min()) if array.size else 0.0  # NaN if any height is
    if not np.isfinite(largest):
        bad = array.size - int(np.count_nonzero(np.isfinite(array)))
        raise InputError(
            f"{bad} of {array.size} heights are NaN or infinite; all must be finite: fill or crop "
            "them first"
        )
    if largest > _LARGEST:
        raise InputError(f"heights reach {largest:.3g}; at most {_LARGEST:g}: rescale")
    array.flags.writeable = False
    return array


def _checked_sizes(name: str, sizes: Any) -> tuple[float, ...]:
    expected = {"sizes": 2, "length": 1}[name]
    try:
        values = tuple(float(size) for size in sizes)
    except (TypeError, ValueError):
        values = ()
    if len(values) != expected or not all(1 / _LARGEST < value < _LARGEST for value in values):
        allowed = {"sizes": "two positive, finite numbers (Lx, Ly)", "length": "a positive number"}
        shown = sizes if expected == 2 else sizes[0]
        raise InputError(f"{name} is {shown!r}; give {allowed[name]}")
    return values


def _rms_deviation(heights: NDArray[np.float64]) -> float:
    lowest, highest = float(heights.min()), float(heights.max())
    if lowest == highest:
        return 0.0  # rounding of the mean is no roughness
    mean = float(heights.mean())
    return _rms(heights, mean, max(highest - mean, mean - lowest))


def _rms(values: NDArray[np.float64], mean: float = 0.0, largest: float | None = None) -> float:
    """Root of the mean square deviation, neither overflowing nor underflowing on the way.

    A block at a time, so that large arrays need no room of their own size.
    """
    if largest is None:
        largest = float(np.abs(values).max(initial=0.0))
    if largest == 0.0:
        return 0.0
    flat, total = values.ravel(order="K"), 0.0
    for start in range(0, flat.size, _BLOCK):
        deviations = (flat[start : start + _BLOCK] - mean) / largest
        total += float(np.einsum("i,i->", deviations, deviations))
    return float(np.sqrt(total / flat.size)) * largest
