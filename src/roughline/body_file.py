"""Surfaces and lines in NetCDF files of our own."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from roughline.errors import InputError, StoreError
from roughline.memory import refuse_beyond_memory
from roughline.quantities import metres_per_file_unit
from roughline.topography import Body, Line, Surface

_FORMAT = "roughline body 1"


def write(body: Body, path: str | Path) -> None:
    """Write a surface or a line, settings included, to NetCDF; :func:`roughline.read` takes it.

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


def read_body_file(path: Path, unit: str | None) -> Body | None:
    """Read a body from our own format, in metres; None if the file has another.

    Parameters
    ----------
    path : Path
        The file.
    unit : str or None
        Of its lengths, if it states none.

    Raises
    ------
    UnitError
        If the unit is missing or there are two.
    InputError
        If memory cannot hold it.
    """
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
    factor = metres_per_file_unit(path.name, attrs["unit"] or None, unit)
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
