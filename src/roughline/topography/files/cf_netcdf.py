"""NetCDF that other programs wrote, read by the conventions for climate and forecast data (CF).

SurfaceTopography and early versions of GMT have layouts of their own, which are known.
"""

from __future__ import annotations

import re
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError, RoughlineError
from roughline.errors.checks import shortened
from roughline.errors.words import called
from roughline.topography.files.archives import refuse_empty_datasets, refuse_points
from roughline.topography.files.cf_variables import (
    candidates,
    decoded,
    is_length,
    likeness,
    stated_unit,
)
from roughline.topography.files.channels import Channel, find_channel, listed, numbered
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.positions import Positions
from roughline.topography.settings import MEASURED
from roughline.units import metres_per

_HDF5 = b"\x89HDF\r\n\x1a\n"
_SUFFIXES = (".nc", ".nc4", ".cdf", ".grd")  # of NetCDF; other files of HDF5 have many formats
_ALONG = {
    "x": re.compile(r"x(?:[_\d].*)?|.*_x|nx|dimx|lon(?:gitude)?|col(?:umn)?s?", re.IGNORECASE),
    "y": re.compile(r"y(?:[_\d].*)?|.*_y|ny|dimy|lat(?:itude)?|rows?", re.IGNORECASE),
}
_SIDE_TOLERANCE = 1e-3  # of a side, within which its length and its positions agree


def read_netcdf(path: Path, channel: int | str | None, name: str) -> Measurement | None:
    """Read heights from NetCDF of another program; None if the file has another format."""
    engine = _find_engine(path, name)
    if engine is None:
        return None
    import xarray  # here because it loads slowly

    how: dict[str, Any] = {"phony_dims": "sort"} if engine == "h5netcdf" else {}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what is refused is let go after its file is closed
            with xarray.open_dataset(path, engine=engine, decode_cf=False, **how) as data:
                _refuse_gxsm(data, name)
                if {"x_range", "y_range", "dimension", "z"} <= set(data.variables):
                    return _read_early_gmt(data, path, name)
                return _read_measurement(data, path, channel, name)
    except (RoughlineError, MemoryError):
        raise
    except Exception as error:  # of a damaged file the readers raise errors of any type
        first_line = shortened((str(error).strip() or "no reason given").splitlines()[0])
        raise InputError(
            f"{name} is damaged NetCDF ({type(error).__name__}: {first_line}): export it again"
        ) from error


def _find_engine(path: Path, name: str) -> Literal["scipy", "h5netcdf"] | None:
    """What reads the file; None if it is no NetCDF."""
    with path.open("rb") as file:
        start = file.read(len(_HDF5))
    if start.startswith(b"CDF\x05"):
        raise InputError(
            f"{name} is NetCDF of the kind CDF-5, which is not read: convert it, such as by "
            "`nccopy -k nc4`"
        )
    if start.startswith(b"CDF"):
        return "scipy"
    if start != _HDF5:
        return None
    refuse_empty_datasets(path, name)
    is_netcdf = path.suffix.lower() in _SUFFIXES or _names_netcdf(path)
    return "h5netcdf" if is_netcdf else None


def _names_netcdf(path: Path) -> bool:
    """Whether a file of HDF5 says that a library of NetCDF wrote it."""
    import h5py  # here because it loads slowly

    with h5py.File(path, "r") as file:
        return "_NCProperties" in file.attrs


def _refuse_gxsm(data: Any, name: str) -> None:
    """Refuse a scan of GXSM, which does not follow CF."""
    if {"rangex", "rangey"} <= set(data.variables):
        raise InputError(
            f"{name} is NetCDF of GXSM, whose layout is not read: export it from Gwyddion as GSF, "
            "GWY or X3P"
        )


def _read_measurement(data: Any, path: Path, channel: int | str | None, name: str) -> Measurement:
    """Heights over positions that rise along x and y."""
    names = candidates(data)
    key = names[_chosen(data, names, channel, name)]
    variable = data.variables[key].squeeze()
    _refuse_points_in_a_list(data, variable, name)
    dims = tuple(map(str, variable.dims))
    is_transposed = len(dims) == 2 and not _x_is_first(data, dims)
    if is_transposed:
        dims = dims[::-1]
    refuse_points(tuple(data.sizes[each] for each in dims), path, name)
    sides = [
        _positions(data, key, each, axis, name) for each, axis in zip(dims, "xy", strict=False)
    ]
    heights = decoded(variable)
    if _is_of_surface_topography(data) and "mask" in data.variables:
        heights[data.variables["mask"].values.reshape(heights.shape) != 0] = np.nan
    heights = _over_rising(heights.T if is_transposed else heights, sides, name)
    unit = stated_unit(data.variables[key])
    if unit is None and _is_of_surface_topography(data) and sides[0] is not None:
        unit = sides[0].unit  # its lines state that of their positions alone, for both
    measured = Measurement(
        file=name,
        heights=heights,
        unit=unit,
        sizes=None,
        kind="surface" if len(dims) == 2 else "profile",
        channel=key,
        channels=listed(_channels(data, names)),
        settings={"origin": MEASURED, "file": name, "channel": key},
        is_cut_out=_is_cut_out(data, dims),
        format="NetCDF",
    )
    known = [side for side in sides if side is not None]
    return _with_sides(measured, known) if len(known) == len(dims) else measured


def _over_rising(heights: Real, sides: list[Positions | None], name: str) -> Real:
    """Heights in the order of rising positions; uneven ones of a map are refused."""
    for i, side in enumerate(sides):
        if side is not None and side.fall:
            heights = np.flip(heights, i)
        if side is not None and not side.are_even and heights.ndim == 2:
            raise InputError(
                f"{name} has uneven positions along {side.name}: bring the map to an even grid, "
                "such as by xarray's interp"
            )
    return heights


def _refuse_points_in_a_list(data: Any, variable: Any, name: str) -> None:
    """Refuse points, each with its x and y, on no grid."""
    together = [data.variables[each].dims for each in ("x", "y") if each in data.variables]
    if variable.ndim == 1 and together == [variable.dims, variable.dims]:
        raise InputError(
            f"{name} lists points with an x and a y each: bring them to an even grid, or write "
            "them as text, x y z in each line"
        )


def _chosen(data: Any, names: list[str], channel: int | str | None, file: str) -> int:
    """The number of the variable of heights that is asked for, or that says that it is one."""
    if not names:
        groups = " or it lies in a group" if not data.variables else ""
        raise InputError(
            f"{file} is NetCDF without numbers over one or two sides{groups}: write the heights "
            "over (y, x) at its top"
        )
    channels = _channels(data, names)
    possible = [i for i, each in enumerate(channels) if not each.why_none]
    if channel is not None or not possible:
        return find_channel(channels, channel, file)
    likely = {i: likeness(data.variables[names[i]], names[i]) for i in possible}
    best = max(likely.values())
    found = [i for i in possible if likely[i] == best]
    if any(best) and len(found) == 1:
        return found[0]
    cause = "several of them may be heights" if any(best) else "nothing says that it is heights"
    asked = called("channel", names[found[0]])
    raise InputError(
        f"{file} is NetCDF with {numbered(channels)}, and {cause}: choose one, such as {asked}"
    )


def _channels(data: Any, names: list[str]) -> list[Channel]:
    """The variables over one or two sides, and why some of them hold no heights."""
    units = [stated_unit(data.variables[name]) for name in names]
    return [
        Channel(name, "" if unit is None or is_length(unit) else f"its unit is {unit}")
        for name, unit in zip(names, units, strict=True)
    ]


def _x_is_first(data: Any, dims: tuple[str, ...]) -> bool:
    """Whether x is the first of two dimensions; where nothing says so, they are row and column."""
    along = tuple(_along(data, each) for each in dims)
    return along in (("x", "y"), ("x", None), (None, "y"))


def _along(data: Any, dim: str) -> str | None:
    """The axis that a dimension is along, as its coordinate or its name says."""
    attrs = data.variables[dim].attrs if dim in data.variables else {}
    standard = str(attrs.get("standard_name", ""))
    for axis, of_sphere in (("x", "longitude"), ("y", "latitude")):
        if str(attrs.get("axis", "")).lower() == axis or of_sphere in standard:
            return axis
        if f"_{axis}_" in standard or _ALONG[axis].fullmatch(dim):
            return axis
    return None


def _positions(data: Any, key: str, dim: str, axis: str, file: str) -> Positions | None:
    """The positions along a dimension; None if the file has none."""
    listed_ones = re.findall(r"\w+", str(data.variables[key].attrs.get("coordinates", "")))
    found = [
        data.variables[each]
        for each in (dim, *listed_ones, axis)
        if each in data.variables and data.variables[each].dims == (dim,) and each != key
    ]
    if not found or found[0].dtype.kind not in "iuf":
        return None
    positions = Positions(decoded(found[0]), stated_unit(found[0]), axis, file)
    length = found[0].attrs.get("length")
    if length is None or not positions.are_even:
        return positions
    if not abs(float(length) - positions.side) <= _SIDE_TOLERANCE * positions.side:
        raise InputError(
            f"{file} states a length of {float(length):g} along {axis}, and its positions make "
            f"{positions.side:g}: export it again"
        )
    return positions


def _is_of_surface_topography(data: Any) -> bool:
    """Whether SurfaceTopography wrote the file: CF knows no `periodic` and no `unit`."""
    return "heights" in data.variables and any(
        key in variable.attrs
        for variable in data.variables.values()
        for key in ("periodic", "unit")
    )


def _is_cut_out(data: Any, dims: tuple[str, ...]) -> bool | None:
    """Whether the heights are a piece of a larger surface; None where the file does not tell."""
    periodic = [
        bool(data.variables[each].attrs["periodic"])
        for each in dims
        if each in data.variables and "periodic" in data.variables[each].attrs
    ]
    return not all(periodic) if len(periodic) == len(dims) else None


def _with_sides(measured: Measurement, sides: list[Positions]) -> Measurement:
    """The measurement with its sides, in the unit of the heights if that is known.

    Where the heights alone state a unit, that of the sides is not known, and so are they not.
    """
    stated = [side.unit for side in sides]
    for side in sides:
        if side.unit is None and any(stated):
            raise InputError(
                f"{measured.file} states the unit of its positions along one side, and none along "
                f"{side.name}: state both, or leave positions out and give the sizes"
            )
        if side.unit is not None and not is_length(side.unit):
            raise InputError(
                f"{measured.file} has positions along {side.name} in {shortened(side.unit)}, no "
                "unit of length: bring it to lengths, or leave them out and give the sizes"
            )
    unit = measured.unit or stated[0]
    if measured.unit and not stated[0]:
        return measured
    factors = [
        metres_per(side.unit) / metres_per(unit) if side.unit and unit else 1.0 for side in sides
    ]
    lengths = tuple(factor * side.side for factor, side in zip(factors, sides, strict=True))
    is_uneven = len(sides) == 1 and not sides[0].are_even
    return replace(
        measured,
        unit_of_sides=None if measured.unit else stated[0],
        sizes=lengths,
        positions=factors[0] * sides[0].rising if is_uneven else None,
    )


def _read_early_gmt(data: Any, path: Path, name: str) -> Measurement:
    """A grid of GMT before 4.1: rows from the top, one after the other, and the range of sides."""
    nx, ny = (int(n) for n in data.variables["dimension"].values)
    refuse_points((nx, ny), path, name)
    z = data.variables["z"]
    is_between = int(z.attrs.get("node_offset", data.attrs.get("node_offset", 0)))  # of pixels
    sides = []
    for axis, n in (("x", nx), ("y", ny)):
        ends = data.variables[f"{axis}_range"]
        first, last = (float(end) for end in ends.values)
        half = (last - first) / n / 2 if is_between else 0.0
        sides.append(
            Positions(np.linspace(first + half, last - half, n), stated_unit(ends), axis, name)
        )
    units = data.variables.get("z_range", z)
    measured = Measurement(
        file=name,
        heights=decoded(z).reshape(ny, nx)[::-1].T,
        unit=stated_unit(units),
        sizes=None,
        kind="surface",
        settings={"origin": MEASURED, "file": name},
        format="NetCDF",
    )
    return _with_sides(measured, sides)
