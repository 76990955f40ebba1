"""Surfaces and lines to files: our own NetCDF, and formats that the programs of the field read."""

from __future__ import annotations

from pathlib import Path

from roughline.errors import InputError, StoreError
from roughline.errors.public import public
from roughline.topography.body import Body
from roughline.topography.files.in_metres import checked_surface
from roughline.topography.files.netcdf import write_netcdf
from roughline.topography.files.write_gsf import write_gsf
from roughline.topography.files.write_x3p import write_x3p

_IN_METRES = {".x3p": write_x3p, ".gsf": write_gsf}


@public
def write(body: Body, path: str | Path) -> None:
    """Write a surface or a line to a file; the end of its name says of which format.

    NetCDF holds all of the body, its provenance and settings included, and :func:`roughline.read`
    gives the same body again. xarray and SurfaceTopography read its heights and sides. X3P (ISO
    5436-2) and GSF (Gwyddion's simple field) hold the heights and the sides of a surface alone, in
    metres, X3P in double and GSF in single precision. What is read from them counts as measured.

    Parameters
    ----------
    body : Surface or Line
        The body; for X3P and GSF, a surface that states its unit.
    path : str or Path
        Name of the file, ending in ".nc", ".x3p" or ".gsf"; an existing file is replaced.

    Raises
    ------
    InputError
        If the name has another end, if a line is to be written as X3P or GSF, or if the roughness
        needs more digits than GSF has.
    UnitError
        If a surface without a unit is to be written as X3P or GSF.
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
    >>> rl.write(surface, "map.x3p")
    >>> print((rl.read("map.x3p", trend="none").heights == surface.heights).all())
    True
    """
    path = checked_name(Path(path))
    try:
        if path.suffix in _IN_METRES:
            _IN_METRES[path.suffix](checked_surface(body, path), path)
        else:
            write_netcdf(body, path)
    except OSError as error:
        raise StoreError(f"cannot write {path} ({error}): choose another place") from error


def checked_name(path: Path) -> Path:
    """Return the name of a file that a body can be written to."""
    if path.suffix not in (".nc", *_IN_METRES):
        raise InputError(
            f'{path} does not end in ".nc", ".x3p" or ".gsf"; bodies are written as NetCDF, X3P or '
            "GSF: rename it"
        )
    return path
