"""How a curve shows itself: in a line at a prompt, as a table of loads in a notebook."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughline.contact.quantity import unit_of
from roughline.contact.status import Status
from roughline.topography.notebook import digits_known, html, in_words

if TYPE_CHECKING:
    from roughline.computing.arrays import Real
    from roughline.contact.curve import Curve

_Column = tuple[str, "Real", "Real | None", "str | None"]
"""Name, values, errors and unit."""

_FIRST, _LAST = 12, 4  # loads of a long curve that are shown


def described(curve: Curve) -> str:
    """Describe a curve in a line: its loads, its forces, and how many were solved."""
    count, solved = curve.status.size, curve.converged
    loads = f"{count} load{'' if count == 1 else 's'}"
    if not solved.any():
        return f"<Curve: {loads}, none solved>"
    unit = unit_of("force", "m") if curve.unit == "m" else None
    low, high = (in_words(float(end(curve.force[solved])), unit) for end in (np.min, np.max))
    missing = "" if solved.all() else f", {count - int(solved.sum())} of them not solved"
    return f"<Curve: {loads}, force {low} to {high}{missing}>"


def html_of_curve(curve: Curve) -> str:
    """Return what a notebook shows of a curve: a table of its loads."""
    units = {name: _unit(name, curve) for name in ("length", "force", "force/length", "pressure")}
    columns: list[_Column] = [
        ("depth d", curve.depth, None, units["length"]),
        ("force F", curve.force, None, units["force"]),
        ("stiffness k", curve.stiffness, curve.stiffness_error, units["force/length"]),
    ]
    if curve.hardness is not None and curve.unloading_stiffness is not None:
        k_u, error = curve.unloading_stiffness, curve.unloading_stiffness_error
        columns.append(("unloading stiffness", k_u, error, units["force/length"]))
    if curve.area_fraction is not None:
        columns.append(("raw area", curve.area_fraction, None, None))
    if curve.area_fraction_corrected is not None:
        area, error = curve.area_fraction_corrected, curve.area_fraction_error
        columns.append(("corrected area A/A_0", area, error, None))
    header = ["load", *(name for name, *_ in columns), "remark"]
    reached = np.flatnonzero(curve.status != Status.INTERRUPTED)
    rows = [
        [
            str(i),
            *(_cell(i, values, errors, unit) for _, values, errors, unit in columns),
            _remark(curve, i),
        ]
        for i in reached[_shown(reached.size)].tolist()
    ]
    if len(rows) < reached.size:
        rows.insert(_FIRST, ["…"] * len(header))
    if left := curve.status.size - reached.size:  # told once
        missing = ["–"] * len(columns)
        rows.append([f"{left} of {curve.status.size}", *missing, Status.INTERRUPTED.reason])
    model = "reduced model" if curve.area_fraction is None else "full model"
    boundary = curve.settings.get("boundary")
    place = f", {boundary} half-space" if boundary else ""
    modulus = in_words(curve.E_star, units["pressure"])
    return html(f"Curve of the {model}{place}, E* = {modulus}", header, rows)


def _unit(dimension: str, curve: Curve) -> str | None:
    return unit_of(dimension, "m") if curve.unit == "m" else None


def _cell(load: int, values: Real, errors: Real | None, unit: str | None) -> str:
    """Write a value with the digits that its error supports."""
    value = float(values[load])
    if not np.isfinite(value):
        return "infinite" if np.isinf(value) else "–"
    return in_words(
        value, unit, digits_known(value, None if errors is None else float(errors[load]))
    )


def _remark(curve: Curve, load: int) -> str:
    if not curve.converged[load]:
        return Status(curve.status[load]).reason
    return "" if curve.resolved[load] or curve.force[load] == 0 else "the grid decides"


def _shown(count: int) -> list[int]:
    """Return which loads are shown: the first and the last of many."""
    if count <= _FIRST + _LAST:
        return list(range(count))
    return [*range(_FIRST), *range(count - _LAST, count)]
