"""Files to bodies in metres: instruments' files, arrays and our own."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from roughline.archives import refuse_bombs
from roughline.body_file import read_body_file
from roughline.errors import InputError
from roughline.instrument import read_instrument
from roughline.missing import Filling, Marking, Missing
from roughline.quantities import engineering, given_sizes, metres_per_file_unit
from roughline.topography import MEASURED, Body, Line, Surface

_RMS_RANGE = (1e-12, 1e-3)  # of roughness [m]


def read(
    path: str | Path,
    unit: str | None = None,
    *,
    channel: int | str | None = None,
    sizes: float | tuple[float, ...] | None = None,
    missing: Filling = "harmonic",
    most_missing: float = 0.1,
) -> Body:
    """Read a surface or a line from a file, in metres.

    Our own NetCDF files and the formats of SurfaceTopography are understood, plain arrays (NPY,
    text) included. A measured line scan is returned as a Line of kind "profile"; one with uneven
    spacing is interpolated linearly to as many even points. Points that the instrument could not
    measure are filled; how many there were stands in the settings of the result.

    Parameters
    ----------
    path : str or Path
        The file.
    unit : str, optional
        Unit of all lengths in a file that states none, such as "nm" or "um".
    channel : int or str, optional
        Number, from 0, or name of the channel; default: the file's first one of heights.
    sizes : float or tuple of float, optional
        Length of a line, or (Lx, Ly), for a file that states no sizes; one number makes a square
        of a square array. [m]
    missing : {"harmonic", "nearest"}, optional
        How missing points are filled: by the smoothest surface through their neighbours, or by
        the nearest known height.
    most_missing : float, optional
        Share of missing points above which the file is refused.

    Returns
    -------
    Surface or Line
        In metres.

    Raises
    ------
    UnitError
        If the file states no unit and `unit` is not given, or both are.
    InputError
        If the file does not exist, has no format known, is damaged or lacks points or sizes.
    """
    return _read(Path(path), unit, channel, sizes, Missing(missing, most_missing))


def missing_points(
    path: str | Path,
    unit: str | None = None,
    *,
    channel: int | str | None = None,
    sizes: float | tuple[float, ...] | None = None,
) -> Body | None:
    """Read which points of a file the instrument could not measure.

    Parameters
    ----------
    path, unit, channel, sizes
        As for :func:`read`.

    Returns
    -------
    Surface, Line or None
        As high as 1 where a point is missing, and 0 elsewhere. None for our own files, whose points
        were filled before they were written.

    Raises
    ------
    UnitError, InputError
        As for :func:`read`.
    """
    body = _read(Path(path), unit, channel, sizes, Marking())
    return replace(body, heights=np.sign(body.heights)) if "marked" in body.settings else None


def _read(
    path: Path,
    unit: str | None,
    channel: int | str | None,
    sizes: float | tuple[float, ...] | None,
    filling: Missing,
) -> Body:
    if not path.is_file():
        what = "is a folder" if path.is_dir() else "does not exist"
        raise InputError(f"{path} {what}; give a file with a topography")
    if path.stat().st_size == 0:
        raise InputError(f"{path.name} is empty: export it again")
    own = read_body_file(path, unit) if path.suffix == ".nc" else None
    if own is not None:
        if channel is not None or sizes is not None:
            raise InputError(f"{path.name} has one channel and states its sizes; leave both out")
        return own
    if path.suffix == ".npy":
        if channel is not None:
            raise InputError(f"{path.name} has one channel; leave it out")
        return _read_array(path, unit, sizes, filling)
    refuse_bombs(path)
    return read_instrument(path, unit, channel, sizes, filling)


def _read_array(
    path: Path, unit: str | None, sizes: float | tuple[float, ...] | None, missing: Missing
) -> Body:
    """Read an array in NumPy's format, x along the first axis."""
    try:
        stored = np.load(path, mmap_mode="r", allow_pickle=False)
        if stored.ndim not in (1, 2) or not np.can_cast(stored.dtype, np.float64, "same_kind"):
            raise ValueError(f"{stored.ndim} dimensions of type {stored.dtype}")
    except (ValueError, OSError, EOFError) as error:
        reason = str(error).splitlines()[0][:120] if str(error) else type(error).__name__
        raise InputError(
            f"{path.name} holds no array of real heights ({reason}): save one or two dimensions"
        ) from error
    factor = metres_per_file_unit(path.name, None, unit)
    extent = given_sizes(path.name, stored.shape, sizes)
    heights, settings = missing.completed(np.array(stored, dtype=np.float64), path.name)
    heights *= factor
    settings = {"origin": MEASURED, "file": path.name, "file_unit": str(unit), **settings}
    if heights.ndim == 2:
        return Surface(heights, (extent[0], extent[1]), "m", settings)
    return Line(heights, extent[0], "m", settings, "profile")


def suspicions(body: Body) -> list[str]:
    """List what about the scales of a measured body suggests a wrong unit or a wrong file.

    Parameters
    ----------
    body : Surface or Line
        In metres.
    """
    found = []
    rms, slope = body.rms_height, body.rms_slope
    if rms > _RMS_RANGE[1] or 0 < rms < _RMS_RANGE[0]:
        found.append(
            f"the rms height is {engineering(rms, 'm')}; roughness is mostly between 1 pm and "
            "1 mm: check the unit, the tilt, and whether heights share the unit of the sides"
        )
    if rms == 0:
        found.append("all heights are equal: this is a flat punch, or an empty channel")
    if slope > 1:
        found.append(
            f"the rms slope is {slope:.3g}; theories and instruments end before 1: check the unit, "
            "and outliers"
        )
    if isinstance(body, Surface):
        dx, dy = body.spacing
        if max(dx, dy) > 2 * min(dx, dy):
            found.append(
                f"pixels are {engineering(dx, 'm')} x {engineering(dy, 'm')}: check the sizes"
            )
    return found
