"""A curve restricted to some of its loads, or extended to loads that were not solved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from functools import partial
from typing import Any

import numpy as np

from roughline.computing.arrays import Indices, Mask
from roughline.contact.curve import Curve
from roughline.contact.fields import Fields
from roughline.contact.status import Status

_UNSOLVED = {"status": int(Status.INTERRUPTED)}  # of quantities that cannot be NaN; others are 0


def at_loads(curve: Curve, loads: Indices) -> Curve:
    """Return a curve at some of its loads, by their numbers; without its fields."""
    return _at_others(curve, lambda _name, values: values[loads])


def among_loads(curve: Curve, solved: Mask) -> Curve:
    """Extend a curve to all loads, of which only these were solved: NaN at the others."""
    kept: list[Fields | None] = [None] * solved.size
    for load, fields_of_load in zip(np.flatnonzero(solved), curve.fields, strict=False):
        kept[load] = fields_of_load

    def spread(name: str, values: Any) -> Any:
        unknown = np.nan if values.dtype.kind == "f" else _UNSOLVED.get(name, 0)
        found = np.full(solved.size, unknown, values.dtype)
        found[solved] = values
        return found

    return replace(_at_others(curve, spread), fields=tuple(kept) if curve.fields else ())


def _at_others(curve: Curve, taken: Callable[[str, Any], Any]) -> Curve:
    """A curve at other loads, to which a function takes each quantity by its name and values."""
    quantities = {item.name: getattr(curve, item.name) for item in fields(Curve)}
    changed: dict[str, Any] = {
        name: taken(name, each) for name, each in quantities.items() if isinstance(each, np.ndarray)
    }
    changed["measured"] = {
        name: each.over(partial(taken, name)) for name, each in curve.measured.items()
    }
    return replace(curve, **changed, fields=(), dents=(), residual_of=())
