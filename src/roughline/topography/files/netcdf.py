"""Surfaces and lines in the NetCDF files that roughline writes."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.disk import write_dataset
from roughline.errors import InputError, RoughlineError
from roughline.topography.body import Body, Surface, point_spacings, side_lengths
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.recorded import (
    as_record,
    is_piece_in_earlier,
    provenance_in,
    provenance_of_earlier,
    trend_in,
)
from roughline.topography.provenance import Provenance
from roughline.topography.trend import Trend

_FORMATS = ("roughline body 2", "roughline body 1")
"""Of what is written, and of what earlier versions wrote, which had settings as attributes."""

_CLASSIC = b"CDF"  # the first bytes of a file of NetCDF 3; others are HDF5
_LARGEST_ARRAY = 2**31 - 4  # array that SciPy writes to NetCDF 3 [bytes]


def write_netcdf(body: Body, path: Path) -> None:
    """Write a body with all that is known of it.

    It is NetCDF 3, since SurfaceTopography reads no other, in the layout that it knows: heights
    over (x, y), and `unit`, `length` and `periodic` of both. CF has `units` and positions for the
    same. A map too large for NetCDF 3 is written as NetCDF 4.
    """
    import xarray  # here because it loads slowly

    unit = {"units": body.unit, "unit": body.unit} if body.unit else {}
    dimensions = ("x", "y")[: body.heights.ndim]
    coordinates = {
        name: (
            name,
            np.arange(n) * step,
            {"length": side, "periodic": int(not body.is_cut_out), **unit},
        )
        for name, n, step, side in zip(
            dimensions, body.heights.shape, point_spacings(body), side_lengths(body), strict=True
        )
    }
    attrs: dict[str, Any] = {
        "format": _FORMATS[0],
        "kind": "surface" if isinstance(body, Surface) else body.kind,
        "sizes": np.array(side_lengths(body)),
        "unit": body.unit or "",
        "removed_trend": body.removed_trend,
        "is_cut_out": int(body.is_cut_out),
        "settings": json.dumps({key: _plain(value) for key, value in body.settings.items()}),
        "provenance": json.dumps(as_record(body.provenance)),
    }
    heights = (dimensions, body.heights, {**unit, "long_name": "height"})
    data = xarray.Dataset({"heights": heights}, coordinates, attrs)
    write_dataset(data, path, "scipy" if body.heights.nbytes < _LARGEST_ARRAY else "h5netcdf")


def _plain(value: Any) -> Any:
    """A setting as one of Python's own numbers or texts."""
    return value.item() if isinstance(value, np.generic) else value


def read_body_file(path: Path, name: str) -> Measurement | None:
    """Read a file that roughline wrote; None if it has another format."""
    with path.open("rb") as file:
        opened = _read_netcdf_3 if file.read(len(_CLASSIC)) == _CLASSIC else _read_netcdf_4
    try:
        found = opened(path, name)
    except RoughlineError:
        raise
    except Exception:
        return None
    if found is None:
        return None
    attrs, heights = found
    settings = _settings_in(attrs, name)
    _refuse_damaged(attrs, heights, name)
    # files of earlier versions state this in their settings alone
    is_cut_out = is_piece_in_earlier(settings)
    return Measurement(
        file=name,
        heights=heights,
        unit=attrs["unit"] or None,
        sizes=tuple(np.atleast_1d(attrs["sizes"]).tolist()),
        kind=attrs["kind"],
        by_roughline=True,
        settings={**settings, "file": name},
        provenance=_provenance_in(attrs, settings, name),
        is_cut_out=bool(attrs["is_cut_out"]) if "is_cut_out" in attrs else is_cut_out,
        format="NetCDF",
    )


def _read_netcdf_4(path: Path, name: str) -> tuple[dict[str, Any], Real] | None:
    """Attributes and heights of a file of NetCDF 4; None if roughline did not write it."""
    import h5netcdf  # here because it loads slowly; xarray loads even more slowly

    with h5netcdf.File(path, "r", phony_dims="sort") as file:
        if file.attrs.get("format") not in _FORMATS:
            return None
        return dict(file.attrs), _heights_in(file.variables, path, name, lambda found: found[:])


def _read_netcdf_3(path: Path, name: str) -> tuple[dict[str, Any], Real] | None:
    """Attributes and heights of a file of NetCDF 3; None if roughline did not write it."""
    from scipy.io import netcdf_file  # here because it loads slowly

    with warnings.catch_warnings(), netcdf_file(path, "r") as file:
        warnings.simplefilter("ignore")  # what is refused is let go after its file is closed
        attrs = {
            key: value.decode() if isinstance(value, bytes) else value
            for key, value in file._attributes.items()
        }
        if attrs.get("format") not in _FORMATS:
            return None

        def native(found: Any) -> Real:  # a copy, so that the file can be closed
            return np.array(found.data, dtype=found.data.dtype.newbyteorder("="))

        return attrs, _heights_in(file.variables, path, name, native)


def _heights_in(variables: Any, path: Path, name: str, values: Callable[[Any], Real]) -> Real:
    """The heights of a file that roughline wrote, unless it or memory is too small for them."""
    if "heights" not in variables:
        raise InputError(
            f"{name} is a damaged file of roughline: it holds no heights; write it again"
        )
    refuse_points(variables["heights"].shape, path, name)
    return values(variables["heights"])


def _settings_in(attrs: dict[str, Any], name: str) -> dict[str, Any]:
    """The settings of a body that roughline wrote."""
    before = {
        key.removeprefix("body_"): _plain(value)
        for key, value in attrs.items()
        if key.startswith("body_")
    }
    try:
        settings = json.loads(attrs.get("settings", "{}"))
        if not isinstance(settings, dict):
            raise TypeError(type(settings))
    except (ValueError, TypeError, RecursionError) as error:
        raise InputError(
            f"{name} is a damaged file of roughline (wrong: settings): write it again"
        ) from error
    return {**before, **settings}


def _provenance_in(attrs: dict[str, Any], settings: dict[str, Any], name: str) -> Provenance:
    """The provenance of a body that roughline wrote; earlier versions recorded it in settings."""
    is_stated = "provenance" in attrs
    try:
        if is_stated:
            found = provenance_in(json.loads(attrs["provenance"]))
        else:
            found = provenance_of_earlier(settings)
        return replace(found, detrended=attrs.get("removed_trend", trend_in(settings)))
    except (InputError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        wrong = "provenance" if is_stated else "settings"
        raise InputError(
            f"{name} is a damaged file of roughline (wrong: {wrong}): write it again"
        ) from error


def _refuse_damaged(attrs: dict[str, Any], heights: Any, name: str) -> None:
    """Refuse a file of our own that lacks what we write, or has something else in its place."""
    kinds = {"surface": 2, "reduced": 1, "profile": 1}
    sizes = np.atleast_1d(attrs.get("sizes", np.nan))
    wrong = {
        "kind": kinds.get(str(attrs.get("kind"))) != heights.ndim,
        "sizes": sizes.shape != (heights.ndim,) or sizes.dtype.kind not in "if",
        "unit": not isinstance(attrs.get("unit"), str),
        "removed_trend": str(attrs.get("removed_trend", "none")) not in get_args(Trend),
        "heights": heights.dtype.kind not in "if",
    }
    if not wrong["sizes"]:
        wrong["sizes"] = not (np.isfinite(sizes) & (sizes > 0)).all()
    if any(wrong.values()):
        names = ", ".join(key for key, is_wrong in wrong.items() if is_wrong)
        raise InputError(f"{name} is a damaged file of roughline (wrong: {names}): write it again")
