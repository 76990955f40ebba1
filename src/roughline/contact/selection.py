"""A curve restricted to some of its loads, or extended to loads that were not solved."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any, TypeVar

import numpy as np

from roughline.computing.arrays import Indices, Mask
from roughline.contact.curve import Curve
from roughline.contact.status import Status

_Kept = TypeVar("_Kept")


def at_loads(curve: Curve, loads: Indices) -> Curve:
    """Return a curve at some of its loads, by their numbers; without its fields."""
    return _at_others(curve, lambda _name, values: values[loads])


def among_loads(curve: Curve, solved: Mask, others: Status = Status.INTERRUPTED) -> Curve:
    """Extend a curve to all loads, of which only these were solved: NaN at the others."""

    def spread(name: str, values: Any) -> Any:
        unknown = np.nan if values.dtype.kind == "f" else 0  # of what cannot be NaN
        found = np.full(solved.size, others if name == "status" else unknown, values.dtype)
        found[solved] = values
        return found

    return replace(
        _at_others(curve, spread),
        fields=_spread(curve.fields, solved, None),
        dents=_spread(curve.dents, solved, None),
        residual_of=_spread(curve.residual_of, solved, ""),
    )


def _spread(kept: Sequence[_Kept], solved: Mask, other: _Kept) -> tuple[_Kept, ...]:
    """What is kept of each load that was solved, among all loads; nothing where nothing is kept."""
    if not kept:
        return ()
    found = [other] * solved.size
    for load, each in zip(np.flatnonzero(solved), kept, strict=False):
        found[load] = each
    return tuple(found)


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
