"""What callers give to a press, checked before anything is computed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from roughline.errors import InputError
from roughline.errors.checks import as_plain, between, is_whole, refuse, several
from roughline.errors.words import called
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic, given_periodic
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.laws.adhesive import Adhesive
from roughline.halfspace.laws.dugdale import Dugdale
from roughline.halfspace.laws.exponential import Exponential
from roughline.halfspace.laws.jkr import JKR
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.halfspace.laws.yielding import Yielding
from roughline.topography.body import Line
from roughline.topography.profile import Profile

LARGEST_NUMBER = 1e150  # beyond it, squares leave the range of double precision
_MODULUS_NEEDED = "a positive, finite contact modulus from 1e-150 to 1e150 is needed"
_MOST_COUNT = 10**9  # loads, points along a side, or iterations


STICKING: Mapping[str, type[Adhesive]] = {"dugdale": Dugdale, "exponential": Exponential}
"""Laws of bodies that stick, by their names."""


def given_half_space(
    half_space: HalfSpace | None, E_star: float | None, periodic: Periodic | None
) -> HalfSpace:
    """Return the half-space that is given, as it is or by the short forms."""
    if half_space is None:
        if E_star is None:
            raise InputError(
                f"pressing needs {called('E_star')}, the contact modulus, which "
                "rl.contact_modulus(first, second) "
                "gives of two materials; give it, or half_space="
            )
        E_star = between("E_star", E_star, 1 / LARGEST_NUMBER, LARGEST_NUMBER, _MODULUS_NEEDED)
        return Homogeneous(E_star, False if periodic is None else periodic)
    if E_star is not None or periodic is not None:
        short = "periodic" if E_star is None else "E_star"
        raise InputError(
            f"half_space and {short} are given; the half-space has a modulus and a boundary of its "
            f"own: leave {short} out"
        )
    return checked_half_space(half_space)


def checked_half_space(half_space: HalfSpace) -> HalfSpace:
    """Return a half-space; refuse what is none, or has no modulus."""
    if not isinstance(half_space, HalfSpace):
        refuse(
            "half_space",
            half_space,
            "an rl.HalfSpace is needed, such as rl.Homogeneous(E_star=1.0, periodic=True)",
        )
    smallest, largest = 1 / LARGEST_NUMBER, LARGEST_NUMBER
    between("half_space.E_star", half_space.E_star, smallest, largest, _MODULUS_NEEDED)
    given_periodic("half_space.periodic", half_space.periodic)
    return half_space


def given_law(law: ContactLaw | None, hardness: float | None) -> ContactLaw:
    """Return the law that a surface obeys; a hardness is short for one, unless it is infinite."""
    hardness = _given_hardness(hardness)
    if law is None:
        return yielding_law(hardness)
    _refuse_no_law(law)
    if hardness is not None:
        raise InputError(
            "law and hardness given together: hardness is short for law=rl.Yielding(hardness); "
            "give one of the two"
        )
    return law


def given_stickiness(
    law: ContactLaw | None, hardness: float | None, body: Line | Profile
) -> JKR | None:
    """Return how springs stick; None if they do not, as those of a line."""
    if _given_hardness(hardness) is not None:
        name = type(body).__name__
        raise InputError(
            f"hardness belongs to the full model; the reduced model of a {name} has no yield: "
            f"leave it out, and trust the {name.lower()} only while mean contact pressures stay "
            "below about 0.4 of the hardness (rms slopes below 0.8 H / E*), or press a Surface"
        )
    if law is None:
        return None
    if isinstance(body, Line):
        _refuse_no_law(law)
        reason = (
            "the springs of a Line only push"
            if law.only_pushes
            else "springs stick as bodies of revolution do, whose contact is one disc, and a rough "
            "line has many contacts, whose sizes are not those of the surface"
        )
        raise InputError(
            f"law belongs to the full model; {reason}: leave it out, or press a Surface"
        )
    if isinstance(law, Unilateral):
        return None
    if not isinstance(law, JKR):
        refuse(
            "law",
            law,
            "the reduction method of a Profile has no yield, and no range of a pull: give "
            "law=rl.JKR(work_of_adhesion), or press a Surface",
        )
    return law


def _refuse_no_law(law: object) -> None:
    """Refuse what is no contact law."""
    if not isinstance(law, ContactLaw):
        refuse(
            "law",
            law,
            "a contact law is needed, such as rl.Unilateral(), rl.Yielding(hardness) or another "
            "rl.ContactLaw",
        )


def _given_hardness(hardness: float | None) -> float | None:
    """Return the hardness of bodies; None where they are elastic."""
    if hardness is None:
        return None
    needed = "a positive pressure, or none for elastic bodies, is needed"
    hardness = between("hardness", hardness, math.ulp(0), math.inf, needed)
    return None if hardness == math.inf else hardness


def sticking_law(name: str, work_of_adhesion: float, reach: float) -> ContactLaw:
    """Return a law of bodies that stick by its name."""
    return STICKING[name](work_of_adhesion, reach)


def checked_count(name: str, value: Any, least: int = -_MOST_COUNT) -> int:
    """Return a whole number; refuse what is none, too small, or beyond all that is countable."""
    plain = as_plain(value)
    is_integer = is_whole(plain) or (isinstance(plain, float) and plain.is_integer())
    if not is_integer or not least <= plain <= _MOST_COUNT:
        bound = "" if least == -_MOST_COUNT else f" of at least {least}"
        at_most = f" and at most {_MOST_COUNT:.0e}" if is_integer and plain > _MOST_COUNT else ""
        refuse(name, value, f"a whole number{bound}{at_most} is needed")
    return int(plain)


def yielding_law(hardness: float | None) -> ContactLaw:
    """Return the law of bodies of a hardness; None: of elastic ones."""
    return Unilateral() if hardness is None else Yielding(hardness)


def checked_shape(shape: Any) -> tuple[int, int]:
    """Return the points of a surface along x and y."""
    sides = several(shape)
    if len(sides) != 2 or not all(is_whole(side) and 1 <= side <= _MOST_COUNT for side in sides):
        refuse(
            "shape",
            shape,
            "the points of the surface along x and y are needed, two positive whole numbers such "
            "as shape=(1024, 1024)",
        )
    return int(sides[0]), int(sides[1])


def kept_loads(fields: Any, count: int) -> frozenset[int]:
    """Return the numbers of the loads whose fields are kept."""
    plain = as_plain(fields)
    if isinstance(plain, bool):
        return frozenset(range(count)) if plain else frozenset()
    numbers = list(plain) if isinstance(plain, Iterable) and not isinstance(plain, str) else None
    if numbers is None or not all(_is_load(each, count) for each in numbers):
        refuse(
            "fields",
            fields,
            f"give True, False, or numbers of loads, 0 to {count - 1}, such as fields=[0]",
        )
    return frozenset(int(each) for each in numbers)


def _is_load(number: Any, count: int) -> bool:
    return is_whole(number) and 0 <= int(number) < count
