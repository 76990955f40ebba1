"""How a curve shows itself: in a line at a prompt, as a table of loads in a notebook."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Mask, Real
from roughline.contact.quantities import unit_of
from roughline.contact.status import Status
from roughline.topography.notebook import html
from roughline.units import digits_known, in_words

Column: TypeAlias = "tuple[str, Real, Real | None, str | None]"
"""Name, values over the loads, their errors, and their dimension; None for numbers."""

_FIRST, _LAST = 12, 4  # loads of a long curve that are shown


def described(force: Real, status: NDArray[np.int8], unit: str | None) -> str:
    """Describe a curve in a line: its loads, its forces, and how many were solved."""
    count, solved = status.size, status == Status.CONVERGED
    loads = f"{count} load{'' if count == 1 else 's'}"
    if not solved.any():
        return f"<Curve: {loads}, none solved>"
    low, high = (with_unit(float(end(force[solved])), "force", unit) for end in (np.min, np.max))
    missing = "" if solved.all() else f", {count - int(solved.sum())} of them not solved"
    return f"<Curve: {loads}, force {low} to {high}{missing}>"


def html_of_loads(
    title: str,
    columns: Sequence[Column],
    status: NDArray[np.int8],
    grid_decides: Mask,
    unit: str | None,
) -> str:
    """Return what a notebook shows of a curve: a table of its loads."""
    header = ["load", *(name for name, *_ in columns), "remark"]
    reached = np.flatnonzero(status != Status.INTERRUPTED)
    rows = [
        [
            str(i),
            *(_cell(i, values, errors, kind, unit) for _, values, errors, kind in columns),
            _remark(Status(status[i]), grid_decides=bool(grid_decides[i])),
        ]
        for i in reached[_shown(reached.size)].tolist()
    ]
    if len(rows) < reached.size:
        rows.insert(_FIRST, ["…"] * len(header))
    if left := status.size - reached.size:  # told once
        missing = ["–"] * len(columns)
        rows.append([f"{left} of {status.size}", *missing, Status.INTERRUPTED.reason])
    return html(title, header, rows)


def with_unit(
    value: float, dimension: str | None, unit: str | None, error: float | None = None
) -> str:
    """Write a value with the digits that its error supports, in SI where lengths are in metres."""
    named = unit_of(dimension, "m") if dimension and unit == "m" else None
    return in_words(value, named, digits_known(value, error))


def _cell(
    load: int, values: Real, errors: Real | None, dimension: str | None, unit: str | None
) -> str:
    value = float(values[load])
    if not np.isfinite(value):
        return "infinite" if np.isinf(value) else "–"
    return with_unit(value, dimension, unit, None if errors is None else float(errors[load]))


def _remark(status: Status, *, grid_decides: bool) -> str:
    if status != Status.CONVERGED:
        return status.reason
    return "the grid decides" if grid_decides else ""


def _shown(count: int) -> list[int]:
    """Return which loads are shown: the first and the last of many."""
    if count <= _FIRST + _LAST:
        return list(range(count))
    return [*range(_FIRST), *range(count - _LAST, count)]
