"""A curve restricted to some of its loads, or extended to loads that were not solved."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any, TypeVar

import numpy as np

from roughline.computing.arrays import Indices, Mask
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.status import Status

_Stored = TypeVar("_Stored")
_CurveType = TypeVar("_CurveType", bound=Curve)


def at_loads(curve: _CurveType, loads: Indices) -> _CurveType:
    """Return a curve at some of its loads, by their numbers; without its fields."""
    return _at_others(curve, lambda _name, values: values[loads])


def among_loads(curve: _CurveType, solved: Mask, others: Status = Status.INTERRUPTED) -> _CurveType:
    """Extend a curve to all loads, of which only these were solved: NaN at the others."""

    def spread(name: str, values: Any) -> Any:
        unknown = np.nan if values.dtype.kind == "f" else 0  # of what cannot be NaN
        found = np.full(
            (solved.size, *values.shape[1:]), others if name == "status" else unknown, values.dtype
        )
        found[solved] = values
        return found

    stored: dict[str, Any] = {}
    if isinstance(curve, SurfaceCurve):
        stored["fields"] = _spread(curve.fields, solved, None)
        stored["dents"] = _spread(curve.dents, solved, None)
        stored["residual_of"] = _spread(curve.residual_of, solved, "")
    return replace(_at_others(curve, spread), **stored)


def first_fields(curve: Curve) -> Fields | None:
    """Return the fields of the first load whose fields were kept; None where none were."""
    stored = loads_with_fields(curve)
    return stored[0][1] if stored else None


def loads_with_fields(curve: Curve) -> list[tuple[int, Fields]]:
    """Return the numbers of the loads whose fields were kept, each with these; none of a line."""
    fields = curve.fields if isinstance(curve, SurfaceCurve) else ()
    return [(load, each) for load, each in enumerate(fields) if each is not None]


def without_fields(curve: _CurveType) -> _CurveType:
    """Return a curve without the fields of its loads."""
    return replace(curve, fields=()) if isinstance(curve, SurfaceCurve) else curve


def _spread(stored: Sequence[_Stored], solved: Mask, other: _Stored) -> tuple[_Stored, ...]:
    """What is kept of each load that was solved, among all loads; nothing where nothing is kept."""
    if not stored:
        return ()
    found = [other] * solved.size
    for load, each in zip(np.flatnonzero(solved), stored, strict=False):
        found[load] = each
    return tuple(found)


def _at_others(curve: _CurveType, taken: Callable[[str, Any], Any]) -> _CurveType:
    """A curve at other loads, to which a function takes each quantity by its name and values."""
    quantities = {item.name: getattr(curve, item.name) for item in fields(curve)}
    changed: dict[str, Any] = {
        name: taken(name, each) for name, each in quantities.items() if isinstance(each, np.ndarray)
    }
    if isinstance(curve, SurfaceCurve):
        changed |= {"fields": (), "dents": (), "residual_of": ()}
        changed["measured"] = {
            name: each.over(partial(taken, name)) for name, each in curve.measured.items()
        }
    return replace(curve, **changed)
