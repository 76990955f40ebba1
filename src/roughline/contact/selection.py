"""A curve restricted to some of its loads, or extended to loads that were not solved."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.contact.curve import Curve
from roughline.contact.status import Status

_UNSOLVED = {"status": int(Status.INTERRUPTED)}  # of quantities that cannot be NaN; others are 0


def at_loads(curve: Curve, loads: Indices) -> Curve:
    """Return a curve at some of its loads, by their numbers; without its fields."""
    taken = {name: values[loads] for name, values in _over_loads(curve).items()}
    measured = {
        name: each.over(lambda values: values[loads]) for name, each in curve.measured.items()
    }
    return replace(curve, **taken, measured=measured, fields=(), dents=(), residual_of=())


def among_loads(curve: Curve, solved: Mask) -> Curve:
    """Extend a curve to all loads, of which only these were solved: NaN at the others."""
    spread: dict[str, Any] = {}
    for name, values in _over_loads(curve).items():
        if values.dtype.kind == "f":
            spread[name] = among(values, solved)
        else:
            spread[name] = np.full(solved.size, _UNSOLVED.get(name, 0), values.dtype)
            spread[name][solved] = values
    measured = {
        name: each.over(lambda values: among(values, solved))
        for name, each in curve.measured.items()
    }
    return replace(curve, **spread, measured=measured, fields=(), dents=(), residual_of=())


def among(values: Real, solved: Mask) -> Real:
    """Extend values to all loads, of which only these were solved: NaN at the others."""
    spread = np.full(solved.size, np.nan)
    spread[solved] = values
    return spread


def _over_loads(curve: Curve) -> dict[str, Any]:
    """Every quantity of a curve that has a value for each load, by its name."""
    values = {item.name: getattr(curve, item.name) for item in fields(Curve)}
    return {name: each for name, each in values.items() if isinstance(each, np.ndarray)}
