"""The parameters of surface texture as a table, for pages, notebooks, the terminal and JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from roughline.topography.body import Surface
from roughline.units import MOST_DIGITS, decimal, in_words

if TYPE_CHECKING:
    from roughline.texture.iso import IsoParameters
    from roughline.texture.parameters import Parameter

_PER_MM = {"1/length": (1e-3, "/mm"), "1/length²": (1e-6, "/mm²")}  # of values in SI


def texture_table(found: IsoParameters) -> tuple[list[str], list[list[str]]]:
    """Return header and rows: each parameter with its value, its meaning and its clause."""
    rows = [
        [each.name, _written(found, each), each.meaning, each.clause] for each in found.parameters
    ]
    return ["", "value", "meaning", "clause"], rows


def texture_rows(found: IsoParameters) -> list[tuple[str, str]]:
    """Return names and what the terminal says of each: the value, and what it is."""
    rows = [
        (each.name, f"{_written(found, each)}: {found.undefined.get(each.name, each.meaning)}")
        for each in found.parameters
    ]
    return [("filters", filters_in_words(found)), *rows]


def texture_in_text(found: IsoParameters) -> str:
    """Return what the terminal says of the parameters, as text."""
    rows = [(standard_title(found), ""), *texture_rows(found)]
    indent = max(len(name) for name, _ in rows[1:]) + 2
    lines = [f"{name:{indent}}{text}".rstrip() for name, text in rows]
    return "\n".join([*lines, *(f"note: {each}" for each in found.remarks)])


def standard_title(found: IsoParameters) -> str:
    """The standard that the parameters are of."""
    return f"Parameters of {next(found.parameters).standard}"


def filters_in_words(found: IsoParameters) -> str:
    """Say which filters there were."""
    return ", ".join(f"{name}: {text}" for name, text in found.filters.items())


def causes_in_words(found: IsoParameters) -> list[str]:
    """Say why parameters are not defined, each cause once."""
    named: dict[str, list[str]] = {}
    for name, cause in found.undefined.items():
        named.setdefault(cause, []).append(name)
    return [f"no {', '.join(names)}: {cause}" for cause, names in named.items()]


def texture_json(found: IsoParameters) -> dict[str, Any]:
    """Parameters as JSON has them, in the unit of the body; undefined ones are null, with why."""
    return {
        "standard": next(found.parameters).standard,
        "kind": "surface" if isinstance(found.body, Surface) else "profile",
        "filters": dict(found.filters),
        "parameters": {
            each.name: {
                "value": found.values[each.name],
                "unit": each.unit_in(found.body.unit),
                "meaning": each.meaning,
                "clause": each.clause,
                "undefined": found.undefined.get(each.name),
            }
            for each in found.parameters
        },
        "remarks": list(found.remarks),
    }


def _written(found: IsoParameters, parameter: Parameter) -> str:
    """Write a value with its unit, densities and curvatures per millimetre where it is SI."""
    value, unit = found.values[parameter.name], found.body.unit
    if np.isnan(value):
        return "not defined"
    if parameter.dimension == "length":
        return in_words(value, unit)
    if parameter.dimension == "%":
        return f"{decimal(value, MOST_DIGITS)} %"
    if parameter.dimension == "°":
        return f"{decimal(value, MOST_DIGITS).replace('180', '0')}°"  # of directions, 180 is 0
    if parameter.dimension == "1":
        return decimal(value, MOST_DIGITS)
    if unit == "m":
        factor, sign = _PER_MM[parameter.dimension]
        return f"{decimal(factor * value, MOST_DIGITS)} {sign}"
    return f"{decimal(value, MOST_DIGITS)} {parameter.unit_in(unit) if unit else ''}".rstrip()
