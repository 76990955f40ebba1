"""What a question is given: bodies, materials and quantities, read and checked."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np

from roughline.engineering.coated import Coated, Solid
from roughline.engineering.material import Material
from roughline.engineering.materials import material
from roughline.errors import InputError
from roughline.errors.checks import number, refuse, shown
from roughline.errors.words import called, speaking
from roughline.topography.body import Body, Line, Surface
from roughline.units import example_of, in_si, load_in_newtons, refuse_decimal_comma

_Value = TypeVar("_Value")


class Parsed(Generic[_Value]):
    """An attribute of a frozen dataclass that is read, and checked, when it is given.

    The default is what holds where nothing is given; without one, something has to be. A default of
    None may be given as well.
    """

    def __init__(self, read: Callable[[Any], _Value], **default: Any) -> None:
        self.read = read
        self._default = default

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: object | None, owner: type) -> _Value:
        # of the class, it is what the dataclass takes as the default
        if instance is not None:
            return instance.__dict__[self._name]
        if not self._default:
            raise AttributeError(self._name)
        return self._default["default"]

    def __set__(self, instance: object, given: Any) -> None:
        is_none = given is None and self._default == {"default": None}
        instance.__dict__[self._name] = None if is_none else self.read(given)


def several(given: Any) -> tuple[Any, ...]:
    """One value or several as a tuple; None is none."""
    if given is None:
        return ()
    return (given,) if np.ndim(given) == 0 else tuple(given)


def as_si(given: float | str, unit: str, name: str) -> float:
    """A number in an SI unit, or a text with a unit of its own, as a number in the SI unit."""
    if isinstance(given, str):
        return in_si(given, unit, name)
    example = example_of(unit, name)
    needed = f'a number in {unit}, or a text such as "{example}", is needed'
    return number(name, given, needed)


def quantity(
    unit: str, name: str, needed: str, most: float = sys.float_info.max
) -> Callable[[Any], float]:
    """A reader of a positive, finite quantity in an SI unit, up to the largest."""

    def read(given: Any) -> float:
        value = as_si(given, unit, name)
        if not 0 < value <= most:
            refuse(name, given, needed)
        return value

    return read


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
        refuse(name, given, "give a Surface or a Line in metres, or a file")
    if given.unit not in (None, "m"):
        raise InputError(f'is in "{given.unit}"; give it in metres, as rl.read does', name)
    return replace(given, unit="m")


def bodies_or_paths(given: Any) -> Body | Path | tuple[Body | Path, ...]:
    """One body or path, or several of them; a file may not be named twice."""
    if isinstance(given, str | Path | np.ndarray) or not isinstance(given, Iterable):
        return body_or_path(given, "body")
    found = tuple(body_or_path(each, "body") for each in given)
    if not found:
        raise InputError("holds no map; give at least one, better five", "body")
    paths = [each.resolve() for each in found if isinstance(each, Path)]
    for i, path in enumerate(paths):
        if path in paths[:i]:
            raise InputError(f"{path.name} is given twice; give maps of different places")
    return found


def refuse_unless_one_modulus(E_star: Any, materials: Any) -> None:
    """Refuse a contact modulus beside two materials, and neither of them."""
    if (E_star is None) == (materials is None):
        raise InputError(
            f"give either a contact modulus ({called('E_star')}) or two materials "
            f"({called('materials')})"
        )


def pair_of(given: Any) -> tuple[Solid, Solid]:
    """Two materials, from themselves, their descriptions, or one text with a comma between."""
    parts = given
    if isinstance(given, str):
        refuse_decimal_comma(given, "materials")
        parts = [part.strip() for part in given.split(",")]
    if not isinstance(parts, Sequence) or len(parts) != 2:
        refuse(
            "materials",
            given,
            'give two with a comma between, such as "steel,copper" or "rubber 2 mm on steel,rigid"',
        )
    first, second = (_material_of(each) for each in parts)
    return first, second


def _material_of(given: Any) -> Solid:
    """A material, from itself or from its description."""
    if isinstance(given, Material | Coated):
        return given
    if not isinstance(given, str):
        refuse("materials", given, 'a Material or a text such as "steel" is needed for each body')
    try:
        with speaking(None):  # a description calls its values the same for everyone
            return material(given)
    except InputError as error:
        raise type(error)(f"{shown(given)} cannot be used: {error}", "materials") from error
