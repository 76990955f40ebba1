"""Variables of NetCDF by the conventions for climate and forecast data (CF): values and units."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.errors import UnitError
from roughline.units import metres_per

_STANDARD_NAMES = re.compile(r"(?:\w+_)?(?:height|altitude)(?:_above_\w+)?")
_NAMES = re.compile(r"z|h|heights?|height_?map|topo|topography|elevations?|z_?data", re.IGNORECASE)
_REFERRING = ("coordinates", "bounds", "ancillary_variables", "grid_mapping")
"""Attributes that name variables which belong to another one."""

_LONGEST_SIGN = 3  # letters; longer units are words, however they are capitalised
_NOT_WRITTEN = {
    **dict.fromkeys(("float32", "float64"), 9.969209968386869e36),
    **{"int16": -32767, "uint16": 65535, "int32": -2147483647, "uint32": 4294967295},
    **{"int64": -9223372036854775806, "uint64": 18446744073709551614},
}
"""What the library of NetCDF fills points with that were never written, where no file says so."""


def candidates(data: Any) -> list[str]:
    """Names of variables of real numbers over two sides or, where there are none, over one."""
    aside = {*data.dims, "mask"}
    for variable in (data, *data.variables.values()):
        for key in _REFERRING:
            aside.update(re.findall(r"\w+", str(variable.attrs.get(key, ""))))
    sides = {
        name: sum(n > 1 for n in variable.shape)
        for name, variable in data.variables.items()
        if name not in aside and variable.dtype.kind in "iuf"
    }
    most = 2 if 2 in sides.values() else 1
    return [str(name) for name, count in sides.items() if count == most]


def likeness(variable: Any, name: str) -> tuple[bool, bool, bool]:
    """What says that a variable is one of heights: its standard name, its name, its unit."""
    names = (name, str(variable.attrs.get("long_name", "")).strip())
    return (
        bool(_STANDARD_NAMES.fullmatch(str(variable.attrs.get("standard_name", "")))),
        any(map(_NAMES.fullmatch, names)),
        stated_unit(variable) is not None,
    )


def stated_unit(variable: Any) -> str | None:
    """The unit that a variable states; None if it states none."""
    attrs = variable.attrs
    stated = str(attrs.get("units", attrs.get("unit", ""))).strip()
    if not stated or stated.startswith("user_"):  # what GMT writes in the place of one
        return None
    return stated.lower() if len(stated) > _LONGEST_SIGN else stated


def is_length(unit: str) -> bool:
    """Whether a unit is one of length."""
    try:
        return metres_per(unit) > 0
    except UnitError:
        return False


def decoded(variable: Any) -> Real:
    """Values of a variable: counts are scaled, and NaN stands for what is missing."""
    raw, attrs = np.asarray(variable.values), variable.attrs
    if raw.dtype.kind == "i" and str(attrs.get("_Unsigned", "")).lower() == "true":
        raw = raw.view(f"{raw.dtype.byteorder}u{raw.dtype.itemsize}")
    values = raw.astype(np.float64)
    missing = _missing(raw, attrs)
    if "scale_factor" in attrs:
        values *= float(attrs["scale_factor"])
    if "add_offset" in attrs:
        values += float(attrs["add_offset"])
    values[missing] = np.nan
    return values


def _missing(raw: Any, attrs: dict[str, Any]) -> Mask:
    """Which points are missing: those that are marked, and those outside the range of valid ones.

    Marks and range are of the numbers as they are stored.
    """
    missing = np.zeros(raw.shape, dtype=bool)
    marks = [attrs[key] for key in ("_FillValue", "missing_value") if key in attrs]
    if "_FillValue" not in attrs:
        marks += [_NOT_WRITTEN[raw.dtype.name]] if raw.dtype.name in _NOT_WRITTEN else []
    for each in marks:
        for mark in _as_stored(each, raw.dtype):
            missing |= raw == mark
    least, largest = attrs.get("valid_range", (None, None))
    least, largest = attrs.get("valid_min", least), attrs.get("valid_max", largest)
    if least is not None:
        missing |= raw < _as_stored(least, raw.dtype)[0]
    if largest is not None:
        missing |= raw > _as_stored(largest, raw.dtype)[0]
    return missing


def _as_stored(values: Any, dtype: np.dtype[Any]) -> Any:
    """Values of an attribute, to be compared with numbers of the type of its variable."""
    given = np.atleast_1d(np.asarray(values))
    if dtype.kind == "f":
        return given.astype(dtype)
    if dtype.kind == "u" and given.dtype.kind == "i":  # such as -1 for 255
        return given.astype(dtype)
    return given
