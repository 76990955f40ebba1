"""What a question is given: bodies, materials and quantities, read and checked."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from roughline.contact.arguments import LARGEST_NUMBER
from roughline.engineering.coated import Coated, Solid
from roughline.engineering.material import Material
from roughline.engineering.materials import material
from roughline.engineering.pair import MaterialPair, contact_modulus
from roughline.errors import InputError
from roughline.errors.checks import refuse, shown
from roughline.errors.words import called, speaking
from roughline.topography.body import Body, Line, Surface
from roughline.units import MOST_DIGITS, as_si, engineering, load_in_newtons, refuse_decimal_comma


def several(given: Any) -> tuple[Any, ...]:
    """One value or several as a tuple; None is none."""
    if given is None:
        return ()
    return (given,) if np.ndim(given) == 0 else tuple(given)


def quantities(given: float | str | Iterable[float | str] | None) -> tuple[float | str, ...]:
    """Numbers, or texts with units, as they were typed."""
    return several(given)


def quantity(
    given: float | str, unit: str, name: str, needed: str, most: float = sys.float_info.max
) -> float:
    """A positive, finite quantity in an SI unit, up to the largest."""
    value = as_si(given, unit, name)
    if not 0 < value <= most:
        refuse(name, given, needed)
    return value


def modulus(given: float | str | None) -> float | None:
    """A contact modulus, if one is given. [Pa]"""
    if given is None:
        return None
    return quantity(
        given, "Pa", "E_star", "a positive, finite contact modulus is needed", LARGEST_NUMBER
    )


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


def one_body(given: Body | str | Path) -> Body | Path:
    """One body, or the path of a file."""
    return body_or_path(given, "body")


def opposite(given: Body | str | Path | None) -> Body | Path | None:
    """The second body, or the path of its file, if it is rough."""
    return None if given is None else body_or_path(given, "against")


def bodies(
    given: Body | str | Path | Iterable[Body | str | Path],
) -> Body | Path | tuple[Body | Path, ...]:
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


def refuse_unless_one_load(loads: Any, depths: Any) -> None:
    """Refuse forces beside depths, and neither of them."""
    if bool(loads) == bool(depths):
        raise InputError(
            f"give forces, {called('loads', '10 N')}, or depths, {called('depths', '1 um')}, one "
            "of the two"
        )


def given_pair(
    materials: tuple[Solid, Solid] | None, hardness: float | None
) -> MaterialPair | None:
    """Both materials with the hardness that is given, unless that is infinite; None without."""
    if materials is None:
        return None
    pair = MaterialPair(*materials)
    return pair if hardness in (None, math.inf) else pair.with_hardness(hardness)


def called_by(given: Iterable[float | str], unit: str, digits: int = MOST_DIGITS) -> list[str]:
    """What quantities are called: as they were typed, or with their SI unit."""
    return [each if isinstance(each, str) else engineering(each, unit, digits) for each in given]


def read_pair(given: str | Sequence[Solid | str] | None) -> tuple[Solid, Solid] | None:
    """Two materials, from themselves, their descriptions, or one text with a comma between.

    One of them gives way.
    """
    if given is None:
        return None
    parts: Any = given
    if isinstance(given, str):
        refuse_decimal_comma(given, "materials")
        parts = [part.strip() for part in given.split(",")]
    if not isinstance(parts, Sequence) or len(parts) != 2:
        refuse(
            "materials",
            given,
            'give two with a comma between, such as "steel,copper" or "rubber 2 mm on steel,rigid"',
        )
    first, second = (_read_material(each) for each in parts)
    contact_modulus(first.surface, second.surface)  # refuses two rigid ones
    return first, second


def _read_material(given: Any) -> Solid:
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
