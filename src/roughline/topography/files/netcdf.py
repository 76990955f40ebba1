"""Surfaces and lines in the NetCDF files that roughline writes."""

from __future__ import annotations

from pathlib import Path
from typing import Any, get_args

import numpy as np

from roughline.computing.disk import write_dataset
from roughline.errors import InputError, RoughlineError, StoreError
from roughline.errors.public import public
from roughline.topography.body import Body, Surface, sides_of
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.measurement import Measurement
from roughline.topography.trend import Trend

_FORMAT = "roughline body 1"


@public
def write(body: Body, path: str | Path) -> None:
    """Write a surface or a line, settings included, to NetCDF; :func:`roughline.read` takes it.

    Parameters
    ----------
    body : Surface or Line
        The body.
    path : str or Path
        Name of the file, ending in ".nc"; an existing file is replaced.

    Raises
    ------
    InputError
        If the name does not end in ".nc".
    StoreError
        If the file cannot be written.

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> heights = 1e-6 * np.random.default_rng(7).standard_normal((32, 32))
    >>> surface = rl.Surface(heights, sizes=(1e-3, 1e-3), unit="m", is_cut_out=True)
    >>> rl.write(surface, "map.nc")
    >>> print((rl.read("map.nc").heights == surface.heights).all())
    True
    """
    import xarray  # here because it loads slowly

    path = Path(path)
    if path.suffix != ".nc":
        raise InputError(f'{path} does not end in ".nc"; bodies are written as NetCDF: rename it')
    attrs: dict[str, Any] = {
        "format": _FORMAT,
        "kind": "surface" if isinstance(body, Surface) else body.kind,
        "sizes": np.array(sides_of(body)),
        "unit": body.unit or "",
        "removed_trend": body.removed_trend,
        "is_cut_out": int(body.is_cut_out),
    }
    for name, value in body.settings.items():
        attrs[f"body_{name}"] = value
    dimensions = ("x", "y")[: body.heights.ndim]
    heights = (dimensions, body.heights, {"units": body.unit or "length", "long_name": "height"})
    try:
        write_dataset(xarray.Dataset({"heights": heights}, attrs=attrs), path)
    except OSError as error:
        raise StoreError(f"cannot write {path} ({error}): choose another place") from error


def read_body_file(path: Path, name: str) -> Measurement | None:
    """Read a file that roughline wrote; None if it has another format."""
    import h5netcdf  # here because it loads slowly; xarray loads even more slowly

    try:
        with h5netcdf.File(path, "r", phony_dims="sort") as file:
            if file.attrs.get("format") != _FORMAT:
                return None
            attrs = dict(file.attrs)
            heights = _heights_in(file, path, name)
    except RoughlineError:
        raise
    except (OSError, ValueError, KeyError, AttributeError):  # the last of h5netcdf before 1.7
        return None
    _refuse_damaged(attrs, heights, name)
    settings = {
        name.removeprefix("body_"): getattr(value, "item", lambda value=value: value)()
        for name, value in attrs.items()
        if name.startswith("body_")
    }
    return Measurement(
        file=name,
        heights=heights,
        unit=attrs["unit"] or None,
        sizes=tuple(np.atleast_1d(attrs["sizes"]).tolist()),
        kind=attrs["kind"],
        by_roughline=True,
        settings={**settings, "file": name},
        # files of earlier versions state both in their settings alone
        is_cut_out=bool(attrs["is_cut_out"]) if "is_cut_out" in attrs else None,
        removed_trend=attrs.get("removed_trend"),
    )


def _heights_in(file: Any, path: Path, name: str) -> Any:
    """The heights of a file that roughline wrote, unless it or memory is too small for them."""
    if "heights" not in file.variables:
        raise InputError(
            f"{name} is a damaged file of roughline: it holds no heights; write it again"
        )
    refuse_points(file["heights"].shape, path, name)
    return file["heights"][:]


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
