"""Settings of a body: the record of where its heights come from and of what was done to them.

The record is stored with every result. Typed fields of the body decide how it is treated; they
follow from the record where they are not given at birth.
"""

from __future__ import annotations

import copyreg
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, get_args

from roughline.computing.arrays import Real
from roughline.errors.checks import flag, one_of, refuse
from roughline.topography.trend import Trend, slopes_of_plane

Settings = Mapping[str, str | int | float]


NOTHING_RECORDED: Settings = MappingProxyType({})


def read_only(settings: Any) -> MappingProxyType[str, str | int | float]:
    """Return a copy of settings that cannot be changed."""
    if not isinstance(settings, Mapping):
        refuse("settings", settings, "a mapping of names to texts and numbers is needed")
    return MappingProxyType(dict(settings))


# so that bodies, and curves with them, travel between processes
copyreg.pickle(MappingProxyType, lambda settings: (read_only, (dict(settings),)))

MEASURED = "instrument file"  # origin of what an instrument measured
PIECE = "topography"
"""Origin of a topography of SurfaceTopography that is not periodic, so a piece of a larger one."""

PERIODIC = "periodic topography"  # origin of a topography of SurfaceTopography that is periodic
TILT_REMOVED = ("tilt_removed_x", "tilt_removed_y")
"""Slopes of the planes that were removed from a body, along each side. [1]"""

TILT, MOUNTING = "tilt", "mounting"
"""Name and value of the setting that says that the tilt of a body is that of its mounting."""

_GENERATED = "self-affine"  # first word of the origin of what was generated with a spectrum


def checked_cut_out(given: object, settings: Settings) -> bool | None:
    """Say whether a body is cut out of a larger one; None where neither caller nor record tells."""
    if given is None:
        origin = str(settings.get("origin"))
        if "cropped" in settings or origin in (MEASURED, PIECE):
            return True
        return False if origin == PERIODIC or origin.startswith(_GENERATED) else None
    return flag("is_cut_out", given)


def checked_trend(given: Trend | None, settings: Settings) -> Trend:
    """Return the trend that was removed from a body."""
    if given is None:
        names: tuple[Trend, ...] = get_args(Trend)
        return next((name for name in names if name == settings.get("detrended")), "none")
    return one_of("removed_trend", given, get_args(Trend))


def record_of_tilt(
    heights: Real, spacings: Sequence[float], trend: Trend, before: Settings
) -> Settings:
    """Return the record of the plane that is removed with a trend, and of those removed before."""
    if trend not in ("tilt", "curvature"):
        return {}
    slopes = slopes_of_plane(heights, spacings)
    return {
        name: slope + float(before.get(name, 0.0))
        for name, slope in zip(TILT_REMOVED, slopes, strict=False)
    }


def as_body(settings: Settings) -> Settings:
    """Return settings with names that say that they are a body's, for the settings of a result."""
    return {f"body_{name}": value for name, value in settings.items()}
