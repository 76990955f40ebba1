"""Surfaces in metres, for formats of files that know no other unit."""

from __future__ import annotations

from pathlib import Path

from roughline.computing.arrays import Real
from roughline.errors import InputError, UnitError
from roughline.topography.body import Body, Surface
from roughline.units import metres_per


def checked_surface(body: Body, path: Path) -> Surface:
    """Return a surface that states its unit; refuse a line, and a surface without a unit."""
    if not isinstance(body, Surface):
        raise InputError(f'{path}: a line is written as NetCDF; give a name that ends in ".nc"')
    if body.unit is None:
        raise UnitError(
            f"{path}: such files hold metres, and the surface states no unit; give it one, such as "
            'dataclasses.replace(surface, unit="um"), or write it as ".nc"'
        )
    return body


def sides_in_metres(surface: Surface) -> tuple[float, float]:
    """Return both sides. [m]"""
    factor = _metres(surface)
    return factor * surface.sizes[0], factor * surface.sizes[1]


def heights_in_metres(surface: Surface) -> Real:
    """Return the heights. [m]"""
    factor = _metres(surface)
    return surface.heights if factor == 1 else surface.heights * factor


def _metres(surface: Surface) -> float:
    return metres_per(surface.unit or "m")
