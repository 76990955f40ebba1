"""Files to bodies and back: instrument files through SurfaceTopography, our own as NetCDF."""

from __future__ import annotations

import logging
import math
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.archives import refuse_bombs
from roughline.errors import InputError, RoughlineError, StoreError, UnitError
from roughline.memory import refuse_beyond_memory
from roughline.missing import Filling, Missing
from roughline.quantities import engineering, metres_per
from roughline.topography import MEASURED, Body, Line, Surface

_FORMAT = "roughline body 1"
_BYTES_PER_POINT = 24  # raw, scaled and masked
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
    path, filling = Path(path), Missing(missing, most_missing)
    if not path.is_file():
        what = "is a folder" if path.is_dir() else "does not exist"
        raise InputError(f"{path} {what}; give a file with a topography")
    if path.stat().st_size == 0:
        raise InputError(f"{path.name} is empty: export it again")
    own = _read_own(path, unit) if path.suffix == ".nc" else None
    if own is not None:
        if channel is not None or sizes is not None:
            raise InputError(f"{path.name} has one channel and states its sizes; leave both out")
        return own
    if path.suffix == ".npy":
        if channel is not None:
            raise InputError(f"{path.name} has one channel; leave it out")
        return _read_array(path, unit, sizes, filling)
    refuse_bombs(path)
    return _read_instrument(path, unit, channel, sizes, filling)


def write(body: Body, path: str | Path) -> None:
    """Write a surface or a line, settings included, to a NetCDF file that :func:`read` takes.

    Parameters
    ----------
    body : Surface or Line
        The body.
    path : str or Path
        Where to, ending in ".nc"; an existing file is replaced.

    Raises
    ------
    InputError
        If the name does not end in ".nc".
    StoreError
        If the file cannot be written.
    """
    import xarray  # here because it loads slowly

    path = Path(path)
    if path.suffix != ".nc":
        raise InputError(f'{path} does not end in ".nc"; bodies are written as NetCDF: rename it')
    sizes = body.sizes if isinstance(body, Surface) else (body.length,)
    attrs: dict[str, Any] = {
        "format": _FORMAT,
        "kind": "surface" if isinstance(body, Surface) else body.kind,
        "sizes": np.array(sizes),
        "unit": body.unit or "",
    }
    for name, value in body.settings.items():
        attrs[f"body_{name}"] = value
    dimensions = ("x", "y")[: body.heights.ndim]
    heights = (dimensions, body.heights, {"units": body.unit or "length", "long_name": "height"})
    try:
        xarray.Dataset({"heights": heights}, attrs=attrs).to_netcdf(path, engine="h5netcdf")
    except OSError as error:
        raise StoreError(f"cannot write {path} ({error}): choose another place") from error


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


def _read_own(path: Path, unit: str | None) -> Body | None:
    """Read our own format; None if the file has another."""
    import xarray

    try:
        with xarray.open_dataset(path, engine="h5netcdf") as dataset:
            if dataset.attrs.get("format") != _FORMAT:
                return None
            points = dataset["heights"].shape
            refuse_beyond_memory(
                2 * 8 * math.prod(points),
                f"reading the {' x '.join(map(str, points))} points of {path.name}",
                "take a smaller piece",
            )
            heights = dataset["heights"].values
            attrs = dataset.attrs
    except (OSError, ValueError, KeyError):
        return None
    factor = _metres_per_file_unit(path, attrs["unit"] or None, unit)
    settings = {
        name.removeprefix("body_"): getattr(value, "item", lambda value=value: value)()
        for name, value in attrs.items()
        if name.startswith("body_")
    }
    settings["file"] = path.name
    sizes = tuple(factor * size for size in np.atleast_1d(attrs["sizes"]))
    if factor != 1:
        heights *= factor
    if attrs["kind"] == "surface":
        return Surface(heights, sizes, "m", settings)
    return Line(heights, sizes[0], "m", settings, attrs["kind"])


def _read_instrument(
    path: Path,
    unit: str | None,
    channel: int | str | None,
    sizes: float | tuple[float, ...] | None,
    missing: Missing,
) -> Body:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ImportWarning)  # it says that MPI is absent; so be it
        from SurfaceTopography.Exceptions import ReadFileError  # here because it loads slowly
        from SurfaceTopography.IO import open_topography

    try:
        with _silence(), open_topography(str(path)) as reader:
            chosen = _channel_of(reader, channel, path)
            refuse_beyond_memory(
                _BYTES_PER_POINT * math.prod(chosen.nb_grid_pts),
                f"reading the {' x '.join(map(str, chosen.nb_grid_pts))} points of {path.name}",
                "crop it with the instrument's software",
            )
            stated = chosen.unit[0] if isinstance(chosen.unit, tuple) else chosen.unit
            factor = _metres_per_file_unit(path, stated, unit)
            extent = _sizes_in_file_units(chosen, sizes, factor, path)
            topography = reader.topography(
                channel_index=chosen.index,
                **({} if stated else {"unit": "m"}),
                **({"physical_sizes": extent} if chosen.physical_sizes is None else {}),
            )
            return _body_of(topography, factor, path, stated or str(unit), chosen.name, missing)
    except (RoughlineError, MemoryError):
        raise
    except ReadFileError as error:
        raise InputError(
            f"{path.name} is damaged or of a type that is not known ({type(error).__name__}): "
            "export it again, or to another format such as X3P, SDF, SUR or GWY"
        ) from error
    except Exception as error:  # the readers raise whatever a damaged file leads them to
        first_line = (str(error).strip() or "no reason given").splitlines()[0][:120]
        raise InputError(
            f"{path.name} cannot be read ({type(error).__name__}: {first_line}): export it again"
        ) from error


@contextmanager
def _silence() -> Iterator[None]:
    """Keep off the terminal what readers say of damaged files; some print them whole."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings(), redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(before)


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
    factor = _metres_per_file_unit(path, None, unit)
    extent = _given_sizes(stored.shape, sizes, path)
    heights, settings = _filled(np.array(stored, dtype=np.float64), path, missing)
    heights *= factor
    settings = {"origin": MEASURED, "file": path.name, "file_unit": str(unit), **settings}
    if heights.ndim == 2:
        return Surface(heights, (extent[0], extent[1]), "m", settings)
    return Line(heights, extent[0], "m", settings, "profile")


def _channel_of(reader: Any, wanted: int | str | None, path: Path) -> Any:
    """Find a channel of heights by number or name."""
    channels = reader.channels
    listed = ", ".join(f"{i} {each.name!r}" for i, each in enumerate(channels))
    if wanted is None:
        return reader.default_channel
    text = str(wanted)
    if text.isdigit() and int(text) < len(channels):
        chosen = channels[int(text)]
    else:
        named = [each for each in channels if each.name.lower() == text.lower()]
        if not named:
            raise InputError(f"{path.name} has no channel {text!r}; it has {listed}")
        if len(named) > 1:
            raise InputError(
                f"{path.name} has {len(named)} channels {text!r}: choose by number, of {listed}"
            )
        chosen = named[0]
    if not chosen.is_height_channel or (isinstance(chosen.unit, tuple) and not chosen.unit[1]):
        raise InputError(f"channel {text!r} of {path.name} holds no heights; it has {listed}")
    return chosen


def _sizes_in_file_units(
    channel: Any, given: float | tuple[float, ...] | None, factor: float, path: Path
) -> tuple[float, ...] | None:
    if channel.physical_sizes is not None:
        if given is not None:
            raise InputError(f"{path.name} states its sizes; leave them out")
        return None
    return tuple(size / factor for size in _given_sizes(channel.nb_grid_pts, given, path))


def _given_sizes(
    points: tuple[int, ...], given: float | tuple[float, ...] | None, path: Path
) -> tuple[float, ...]:
    """Sides of a file that states none. [m]"""
    if given is None:
        raise InputError(
            f"{path.name} states no sizes for its {' x '.join(map(str, points))} points; give "
            "them, such as sizes = (1e-3, 1e-3) (command line: --size 1mm,1mm)"
        )
    sizes = tuple(np.atleast_1d(np.asarray(given, dtype=float)).tolist())
    if len(sizes) == 1 and len(set(points)) == 1:
        sizes *= len(points)
    if len(sizes) != len(points) or not all(0 < size < math.inf for size in sizes):
        raise InputError(
            f"sizes is {given!r}; {path.name} has {' x '.join(map(str, points))} points: give "
            f"{len(points)} positive length{'s' if len(points) > 1 else ''}"
        )
    return sizes


def _metres_per_file_unit(path: Path, stated: str | None, given: str | None) -> float:
    if stated and given:
        raise UnitError(f"{path.name} states its unit, {stated}; leave unit = {given} out")
    if not stated and not given:
        raise UnitError(
            f"{path.name} states no unit; say which its lengths have, such as unit = um "
            "(command line: --unit um)"
        )
    return metres_per(stated or str(given))


def _body_of(
    topography: Any, factor: float, path: Path, unit: str, channel: str, missing: Missing
) -> Body:
    settings: dict[str, str | int | float] = {
        "origin": MEASURED,
        "file": path.name,
        "file_unit": unit,
        "channel": channel,
    }
    heights, found = _filled(topography.heights(), path, missing)
    settings |= found
    if factor != 1:
        heights = np.multiply(heights, factor, out=heights if heights.flags.writeable else None)
    sizes = tuple(factor * float(size) for size in topography.physical_sizes)
    if topography.dim == 2:
        return Surface(heights, (sizes[0], sizes[1]), "m", settings)
    if not topography.is_uniform:
        positions = np.asarray(topography.positions(), dtype=np.float64) * factor
        steps = np.diff(positions)
        even = np.linspace(positions[0], positions[-1], positions.size)
        heights = np.interp(even, positions, heights)
        settings["resampled"] = (
            f"linear, to even spacing; it was {steps.min():.3g} to {steps.max():.3g} m"
        )
    return Line(heights, sizes[0], "m", settings, "profile")


def _filled(
    heights: Any, path: Path, missing: Missing
) -> tuple[NDArray[np.float64], dict[str, str | int | float]]:
    """Heights without missing points, and how many there were."""
    unknown = int(np.count_nonzero(np.ma.getmaskarray(heights)))
    if not unknown and not np.isfinite(np.ma.getdata(heights)).all():
        heights = np.ma.masked_invalid(heights, copy=False)
        unknown = int(np.count_nonzero(np.ma.getmaskarray(heights)))
    settings: dict[str, str | int | float] = {}
    if unknown:
        heights = missing.filled(heights, path.name)
        settings = {
            "missing_points": unknown,
            "missing_share": unknown / heights.size,
            "filled": missing.method,
        }
    return np.array(heights, dtype=np.float64, copy=None), settings
