"""Files to bodies and back: instrument files through SurfaceTopography, our own as NetCDF."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np

from roughline.errors import InputError, StoreError, UnitError
from roughline.quantities import metres_per
from roughline.topography import MEASURED, Body, Line, Surface

_FORMAT = "roughline body 1"


def read(path: str | Path, unit: str | None = None) -> Body:
    """Read a surface or a line from a file, in metres.

    Our own NetCDF files and the formats of SurfaceTopography are understood. A measured line scan
    is returned as a Line of kind "profile"; one with uneven spacing is interpolated linearly to as
    many even points.

    Parameters
    ----------
    path : str or Path
        The file.
    unit : str, optional
        Unit of all lengths in a file that states none, such as "nm" or "um".

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
    path = Path(path)
    if not path.is_file():
        what = "is a folder" if path.is_dir() else "does not exist"
        raise InputError(f"{path} {what}; give a file with a topography")
    body = _read_own(path, unit) if path.suffix == ".nc" else None
    return body or _read_instrument(path, unit)


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


def levelled(body: Body) -> Body:
    """Return an instrument's topography without its tilt, anything else as it is."""
    return body.detrended() if body.settings.get("origin") == MEASURED else body


def _read_own(path: Path, unit: str | None) -> Body | None:
    """Read our own format; None if the file has another."""
    import xarray

    try:
        with xarray.open_dataset(path, engine="h5netcdf") as dataset:
            if dataset.attrs.get("format") != _FORMAT:
                return None
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
    if attrs["kind"] == "surface":
        return Surface(heights * factor, sizes, "m", settings)
    return Line(heights * factor, sizes[0], "m", settings, attrs["kind"])


def _read_instrument(path: Path, unit: str | None) -> Body:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ImportWarning)  # it says that MPI is absent; so be it
        from SurfaceTopography.Exceptions import ReadFileError  # here because it loads slowly
        from SurfaceTopography.IO import open_topography

    try:
        with open_topography(str(path)) as reader:
            channel = reader.default_channel
            stated = channel.unit[0] if isinstance(channel.unit, tuple) else channel.unit
            factor = _metres_per_file_unit(path, stated, unit)
            if channel.physical_sizes is None:
                raise InputError(
                    f"{path} states no sizes; read its heights with other tools and give them as "
                    "Surface(heights, sizes=(Lx, Ly))"
                )
            topography = reader.topography(**({} if stated else {"unit": "m"}))
            if stated:
                topography = topography.to_unit("m")
            return _body_of(topography, 1.0 if stated else factor, path, stated or str(unit))
    except InputError:
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


def _metres_per_file_unit(path: Path, stated: str | None, given: str | None) -> float:
    if stated and given:
        raise UnitError(f"{path.name} states its unit, {stated}; leave unit = {given} out")
    if not stated and not given:
        raise UnitError(
            f"{path.name} states no unit; say which its lengths have, such as unit = um "
            "(command line: --unit um)"
        )
    return metres_per(stated or str(given))


def _body_of(topography: Any, factor: float, path: Path, unit: str) -> Body:
    settings = {"origin": MEASURED, "file": path.name, "file_unit": unit}
    if topography.is_uniform and topography.has_undefined_data:
        missing = int(np.count_nonzero(np.ma.getmaskarray(topography.heights())))
        raise InputError(
            f"{path.name} has {missing} missing points of {np.prod(topography.nb_grid_pts)}; "
            "all heights must be known: fill or crop them with the instrument's software"
        )
    heights = np.asarray(topography.heights(), dtype=np.float64) * factor
    if topography.dim == 2:
        sizes = (factor * topography.physical_sizes[0], factor * topography.physical_sizes[1])
        return Surface(heights, sizes, "m", settings)
    length = float(topography.physical_sizes[0]) * factor
    if not topography.is_uniform:
        positions = np.asarray(topography.positions(), dtype=np.float64) * factor
        even = np.linspace(positions[0], positions[-1], positions.size)
        heights = np.interp(even, positions, heights)
        settings["resampled"] = "linear, to even spacing"
    return Line(heights, length, "m", settings, "profile")
