"""What a file with a topography holds, before anything is done to it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from roughline.errors import InputError
from roughline.topography.body import Body, Line, Surface
from roughline.topography.missing import Missing
from roughline.topography.trend import Trend, remove_trend
from roughline.units import (
    Sizes,
    given_sizes,
    metres_per_file_unit,
    sizes_needed,
    unit_needed,
)


@dataclass(frozen=True, eq=False)
class Measurement:
    """Heights as a file has them, and what it says of them.

    Attributes
    ----------
    file : str
        Name of the file, for messages.
    heights : array or masked array, shape (nx, ny) or (n,)
        Heights; unknown ones are masked or not finite. [unit of the file]
    unit : str or None
        What the file says that its lengths are in; None if it does not.
    sizes : tuple of float or None
        Sides of the map, or length of the line; None if the file states none. [unit of the file]
    kind : {"surface", "profile", "reduced"}
        A map, a line scan, or a line made for the reduced model.
    is_own : bool
        Whether roughline wrote it; its heights are kept as they were written.
    channel : str
        Name of the channel; empty where the file has no names.
    channels : tuple of str
        All channels of the file, with their numbers.
    positions : ndarray, shape (n,), or None
        Of the points of a line that is not even. [unit of the file]
    settings : mapping
        Where the heights come from.
    """

    file: str
    heights: Any
    unit: str | None
    sizes: tuple[float, ...] | None
    kind: Literal["surface", "profile", "reduced"]
    is_own: bool = False
    channel: str = ""
    channels: tuple[str, ...] = ()
    positions: NDArray[np.float64] | None = None
    settings: Mapping[str, str | int | float] = field(default_factory=dict)

    @property
    def unknown(self) -> NDArray[np.bool_]:
        """Which points are missing."""
        return np.ma.getmaskarray(self.heights) | ~np.isfinite(np.ma.getdata(self.heights))

    def obstacles(
        self, unit: str | None, sizes: Sizes | None, missing: Missing
    ) -> list[InputError]:
        """List what is still needed before there is a body: a unit, sizes, more known points.

        Parameters
        ----------
        unit, sizes, missing
            What the caller says, as for :meth:`body`.

        Raises
        ------
        InputError
            If what the caller says is said by the file too, or cannot be.
        """
        found: list[InputError] = []
        if not self.unit and not unit:
            found.append(unit_needed(self.file))
        else:
            metres_per_file_unit(self.file, self.unit, unit)
        if self.sizes is not None and sizes is not None:
            raise InputError(f"{self.file} states its sizes; leave them out")
        if self.sizes is None and sizes is None:
            found.append(sizes_needed(self.file, self.heights.shape))
        too_many = missing.too_many(self.unknown, self.file)
        return [*found, too_many] if too_many else found

    def body(self, unit: str | None, sizes: Sizes | None, missing: Missing, trend: Trend) -> Body:
        """Return the body, in metres; the heights are changed in place where they can be.

        Parameters
        ----------
        unit : str or None
            Unit of all lengths, if the file states none.
        sizes : float, str, sequence of them, or None
            Sides, if the file states none; numbers are in `unit`, or else in metres.
        missing : Missing
            How missing points are filled.
        trend : {"none", "mean", "tilt", "curvature"}
            What is removed from the heights of an instrument's file.

        Raises
        ------
        InputError
            If something is needed, or said twice.
        """
        for obstacle in self.obstacles(unit, sizes, missing):
            raise obstacle
        factor = metres_per_file_unit(self.file, self.unit, unit)
        if self.sizes is None:
            extent = given_sizes(self.file, self.heights.shape, sizes, unit)
        else:
            extent = tuple(factor * float(size) for size in self.sizes)
        heights, filled = missing.completed(self.heights, self.file)
        settings = {**self.settings, **filled}
        if not self.is_own:
            settings["file_unit"] = str(self.unit or unit)
        removed = "none" if self.is_own else trend
        if not heights.flags.writeable and (factor != 1 or removed != "none"):
            heights = heights.copy()
        if factor != 1:
            heights *= factor
        if self.positions is not None:
            heights, settings["resampled"] = _even(self.positions * factor, heights)
        if removed != "none":
            remove_trend(heights, removed)
            settings["detrended"] = removed
        if self.kind == "surface":
            return Surface(heights, (extent[0], extent[1]), "m", settings)
        return Line(heights, extent[0], "m", settings, self.kind)


def _even(
    positions: NDArray[np.float64], heights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], str]:
    """Heights between those of uneven points, and what is to be said of it."""
    steps = np.diff(positions)
    even = np.linspace(positions[0], positions[-1], positions.size)
    said = f"linear, to even spacing; it was {steps.min():.3g} to {steps.max():.3g} m"
    return np.interp(even, positions, heights), said
