"""What a question is given: bodies, materials and quantities, read and checked."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np

from roughline.engineering.materials import Material, material
from roughline.errors import InputError
from roughline.topography.body import Body, Line, Surface
from roughline.units import in_si, load_in_newtons, refuse_decimal_comma

MOST_FRICTION = 5.0
"""Largest coefficient of friction; that of rubber on dry glass is about 4."""


def several(given: Any) -> tuple[Any, ...]:
    """One value or several as a tuple."""
    return (given,) if np.ndim(given) == 0 else tuple(given)


def as_si(given: float | str, unit: str, name: str) -> float:
    """A number in an SI unit, or a text with a unit of its own, as a number in the SI unit."""
    return in_si(given, unit, name) if isinstance(given, str) else float(given)


def checked_friction(given: Any) -> float:
    """Return a coefficient of friction.

    Raises
    ------
    InputError
        If it is no number, or none that two bodies have.
    """
    is_number = isinstance(given, Real) and not isinstance(given, bool)
    if not is_number or not 0 < given <= MOST_FRICTION:
        raise InputError(
            f"the coefficient of friction (friction=) is {given!r}; a number above 0 and up to "
            f"{MOST_FRICTION:g} is needed, such as 0.3"
        )
    return float(given)


def has_forces(loads: Any) -> bool:
    """Whether a load is a force, which acts on the body as a whole, and no mean pressure."""
    return any(
        not isinstance(load, str) or load_in_newtons(load, 1.0) == load_in_newtons(load, 2.0)
        for load in several(loads)
    )


def body_or_path(given: Any, name: str) -> Body | Path:
    """A body in metres, or the path of a file."""
    if isinstance(given, str | Path):
        return Path(given)
    if not isinstance(given, Surface | Line):
        raise InputError(
            f"{name} is a {type(given).__name__}; give a Surface or a Line in metres, or a file"
        )
    if given.unit not in (None, "m"):
        raise InputError(f'{name} is in "{given.unit}"; give it in metres, as rl.read does')
    return replace(given, unit="m")


def bodies_or_paths(given: Any, name: str) -> Body | Path | tuple[Body | Path, ...]:
    """One body or path, or several of them; a file may not be named twice."""
    if isinstance(given, str | Path | np.ndarray) or not isinstance(given, Iterable):
        return body_or_path(given, name)
    found = tuple(body_or_path(each, name) for each in given)
    if not found:
        raise InputError(f"{name} holds no map; give at least one, better five")
    paths = [each.resolve() for each in found if isinstance(each, Path)]
    for i, path in enumerate(paths):
        if path in paths[:i]:
            raise InputError(f"{path.name} is given twice; give maps of different places")
    return found


def pair_of(given: Any) -> tuple[Material, Material]:
    """Two materials, from themselves, their descriptions, or one text with a comma between."""
    parts = given
    if isinstance(given, str):
        refuse_decimal_comma(given, "materials")
        parts = [part.strip() for part in given.split(",")]
    if len(parts) != 2:
        raise InputError(
            f'materials is "{given}"; give two with a comma between, such as "steel,copper", or '
            '"steel,rigid"'
        )
    first, second = (each if isinstance(each, Material) else material(each) for each in parts)
    return first, second
