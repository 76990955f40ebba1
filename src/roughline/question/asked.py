"""What may be asked of pressed bodies beside the contact itself: each a value of its own."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, get_args

from attrs import field, frozen

from roughline.engineering.attraction import Attraction
from roughline.engineering.coated import Coated
from roughline.engineering.sealing import Fluid
from roughline.errors import InputError, UnitError
from roughline.errors.checks import allowed_choice, as_number, refuse, whole_number
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.laws.dugdale import Dugdale
from roughline.halfspace.laws.exponential import Exponential
from roughline.question.arguments import quantity, several
from roughline.question.fields import asked_in
from roughline.units import engineering, load_in_newtons, refuse_decimal_comma

_LARGEST_JOINT = 1e6  # [m²]
_AREA_ROUNDING = 1e-9  # of the area of a map, which is a product of its sides
_MOST_SHARE = 1 - 1e-9  # of what friction bears, that can be held


def _attraction(given: float | str | Dugdale | Exponential | Attraction) -> Attraction:
    """How bodies attract each other."""
    return Attraction.of(given)


def _frequency(given: float | str) -> float:
    """A frequency. [Hz]"""
    return quantity(given, "Hz", "frequency", "a positive, finite one is needed")


def _area(given: float | str) -> float:
    """Area of a joint. [m²]"""
    needed = "a positive, finite area is needed, up to 1 km²"
    return quantity(given, "m^2", "joint_area", needed, _LARGEST_JOINT)


@public
@frozen
class Adhesion:
    """Bodies that stick, asked for what it takes to draw them apart after their largest load.

    Parameters
    ----------
    attraction : str, float, Dugdale or Exponential
        The work of adhesion, the range and the law, such as "50 mJ/m^2 over 2 nm, exponential"; a
        number is the work. [J/m²] Or a name of the table of works of adhesion, such as "pdms".
        Without a range, it is the shortest that the grid resolves; without a law, it is Dugdale's.
    """

    attraction: Attraction = field(converter=_attraction)

    def refuse_beside(self, others: Iterable[Asked], *, yields: bool) -> None:
        """Refuse what is not known of bodies that stick."""
        adhesion = called("rl.Adhesion")
        if yields:
            raise InputError(
                f"bodies that stick ({adhesion}) and also yield are not solved: take them as "
                f"elastic ({called('elastic', True)}), or leave {adhesion} out",
                None,
                "adhesion",
                "elastic",
            )
        if any(isinstance(each, Friction) for each in others):
            raise InputError(
                f"partial slip ({called('rl.Friction')}) of bodies that stick ({adhesion}) is not "
                "known: leave one of them out",
                None,
                "adhesion",
                "friction",
            )
        if any(isinstance(each, Fluid) and each.closure for each in others):
            raise InputError(
                f"{called('closure', True)} bisects loads, and bodies that stick ({adhesion}) "
                "depend on those before: leave one of them out",
                None,
                "adhesion",
                "closure",
            )


@public
@frozen
class Ultrasound:
    """An ultrasonic wave, asked for its reflection by the interface.

    Parameters
    ----------
    frequency : float or str
        Such as "5 MHz". [Hz]
    """

    frequency: float = field(converter=_frequency)


def _shear_force(given: float | str | None) -> float | str | None:
    """A shear force, or one over the nominal area, as it was typed."""
    needed = 'a positive, finite force such as "20 N" is needed, or one over the area, "2 MPa"'
    value = as_number(given) if not isinstance(given, str) else _in_newtons(given, 1.0)
    if given is not None and (value is None or not 0 < value < math.inf):
        refuse("shear", given, needed)
    return given


def _in_newtons(text: str, area: float) -> float:
    """Read a shear force, or one over a nominal area [m²]. [N]"""
    refuse_decimal_comma(text, "shear")
    try:
        return load_in_newtons(text, area)
    except UnitError as error:
        raise UnitError(error.statement, "shear") from None


def _cycles(given: int | None) -> int | None:
    """How often a shear force goes to and fro."""
    return None if given is None else whole_number("cycles", given, 1, "at least 1 is needed")


@public
@frozen
class Shear:
    """A shear force on the pressed bodies that goes to and fro, asked for stick, slip and loop.

    It is beside :class:`~roughline.Friction`, and under one load, which stays. The first body is
    pushed along x, up to the force, down to as much the other way, and so on.

    Parameters
    ----------
    force : float or str
        Its size [N], such as "20 N", or over the nominal area, such as "2 MPa".
    cycles : int, optional
        How often it goes to and fro. Default: once; of bodies that pressure displaces along each
        other, as of two materials, three times, until a cycle is as the one before.
    """

    force: float | str | None = field(default=None, converter=_shear_force)
    cycles: int | None = field(default=None, converter=_cycles)

    def newtons(self, area: float) -> float:
        """Return the force on bodies of a nominal area [m²]. [N]"""
        if isinstance(self.force, str):
            return _in_newtons(self.force, area)
        assert self.force is not None
        return self.force

    def refuse_beside(self, others: Iterable[Asked]) -> None:
        """Refuse what is not known of bodies that are sheared, and a shear that is none."""
        shear, cycles = called("rl.Shear"), called("cycles")
        if self.force is None:
            raise InputError(
                f"{cycles} is given without a shear force: give it too ({called('shear', '20 N')})",
                None,
                "cycles",
                "shear",
            )
        if not any(isinstance(each, Friction) for each in others):
            raise InputError(
                f"a shear force ({shear}) needs friction that bears it: give its coefficient too "
                f"({called('rl.Friction')})",
                None,
                "shear",
                "friction",
            )
        if any(isinstance(each, Adhesion) for each in others):
            raise InputError(
                f"bodies that stick ({called('rl.Adhesion')}) and are sheared ({shear}) are not "
                "solved: leave one of them out",
                None,
                "shear",
                "adhesion",
            )

    def refuse_beyond(self, force: float, pressing: float, friction: float) -> None:
        """Refuse a shear force [N] that friction does not bear under the force that presses [N]."""
        limit = friction * pressing
        if not force < _MOST_SHARE * limit:
            by = f" by {engineering(force - limit, 'N')}" if force > limit else ""
            raise InputError(
                f"is {engineering(force, 'N')}, and friction bears less than mu F = {friction:g} x "
                f"{engineering(pressing, 'N')} = {engineering(limit, 'N')}: it is too large"
                f"{by}, and the bodies slide; give less",
                "shear",
            )


@public
@frozen
class Joint:
    """The joint that a surface is a map of, asked for its answers instead of the map's.

    The map is pressed at the joint's mean pressure, and forces act on the joint.

    Parameters
    ----------
    area : float or str
        Nominal area, such as "2 cm^2", not below that of the map and up to 1 km². [m²]
    """

    area: float = field(converter=_area)

    def refuse_map(self, area: float) -> None:
        """Refuse a map with a larger area [m²] than the joint that it is a part of."""
        if area > self.area * (1 + _AREA_ROUNDING):
            raise InputError(
                f"the joint has an area of {engineering(self.area, 'm²')}, less than the map, "
                f"which has {engineering(area, 'm²')}: crop the map, or leave "
                f"{called('rl.Joint')} out"
            )


@public
@dataclass(frozen=True, init=False)
class Theories:
    """Theories of rough contact, asked beside the curve.

    Parameters
    ----------
    *names : str
        As for :func:`roughline.theory`.
    """

    names: tuple[str, ...]

    def __init__(self, *names: str) -> None:
        for name in names:
            allowed_choice("theories", name, known_theories())
        object.__setattr__(self, "names", names)


def known_theories() -> list[str]:
    """Names of the theories that can be asked."""
    from roughline.theories.theory import THEORIES  # here because it loads slowly

    return list(THEORIES)


Asked = Adhesion | Friction | Shear | Ultrasound | Joint | Theories | Fluid
KINDS: Mapping[str, type[Asked]] = {each.__name__: each for each in get_args(Asked)}
"""Classes of what is asked, by their names."""

_NEEDING_MATERIALS = {
    Friction: "friction",
    Shear: "shear",
    Ultrasound: "frequency",
    Joint: "joint_area",
    Fluid: "fluid",
}
"""What is answered of two materials alone, free or repeated both ways, and its first field."""

_NOT_OF_LINES = {
    Adhesion: "springs of a line stick as bodies of revolution do, which touch in one disc, and a "
    "rough line in many; leave it out, or press a map",
    Fluid: "along a line, in one dimension, any contact stops the flow; leave it out, or press a "
    "map",
    Shear: "answers of stick and slip are those of maps; leave it out, or press a map",
    Joint: "a line stands for the square of its length alone, and what lies beyond is not known; "
    "leave it out",
}
"""What belongs to a surface, and why."""


def asked(given: Asked | Iterable[Asked] | None) -> tuple[Asked, ...]:
    """Return what is asked, each of a kind of its own."""
    found = several(given)
    for each in found:
        if not isinstance(each, get_args(Asked)):
            refuse(
                "ask", each, 'give what is asked, such as rl.Friction(0.3) or rl.Joint("2 cm^2")'
            )
    kinds = [type(each).__name__ for each in found]
    for kind in kinds:
        if kinds.count(kind) > 1:
            raise InputError(f"holds several rl.{kind}; give one", "ask")
    return found


def asked_for(values: Mapping[str, Any]) -> tuple[Asked, ...]:
    """Return what is asked, from values by the names of fields; None and False ask nothing."""
    return tuple(KINDS[of](*by_place, **by_name) for of, by_place, by_name in asked_in(values))


def _field_names(each: Asked) -> dict[str, str]:
    """Fields by which something is asked, and what they are called."""
    if not isinstance(each, Fluid):
        name = f"rl.{type(each).__name__}"
        return {_NEEDING_MATERIALS.get(type(each), "ask"): called(name)}
    fluid = {} if each.fluid is None else {"fluid": called("rl.Fluid")}
    return fluid | ({"closure": called("closure", True)} if each.closure else {})


def refuse_uneven_friction(friction: Friction, coated: Sequence[Coated]) -> None:
    """Refuse partial slip of coated bodies, and of a friction that is no single coefficient."""
    name = called("rl.Friction")
    if not friction.is_even:
        raise InputError(
            f"{name} has a strength or a field, and partial slip follows from one coefficient: "
            "give a number such as 0.3, or press with rl.press",
            None,
            "friction",
        )
    for each in coated:
        raise InputError(
            f"partial slip ({name}) follows from the ratio of tangential and normal stiffness of "
            f"bodies of one material each, and {each.name} is coated: leave {name} out, or give a "
            f"shear force ({called('rl.Shear')}) under which it is solved",
            None,
            "friction",
            "materials",
        )


def refuse_without_materials(ask: Iterable[Asked]) -> None:
    """Refuse what is answered of two materials alone."""
    for each in ask:
        if type(each) in _NEEDING_MATERIALS:
            argument, name = next(iter(_field_names(each).items()))
            text = f"{name} needs two materials ({called('materials')})"
            raise InputError(text, None, argument)


def refuse_on_strip(ask: Iterable[Asked], along: str, *, has_materials: bool) -> None:
    """Refuse answers of a body that is repeated along one side alone, all of them at once."""
    fields = [_field_names(each) for each in ask if type(each) in _NEEDING_MATERIALS]
    names = [name for each in fields for name in each.values()]
    materials, take = called("materials"), []
    if has_materials:
        take.append(f"give a contact modulus ({called('E_star')}) in place of {materials}")
    if names:
        take.append(f"leave {' and '.join(names)} out")
    if take:
        raise InputError(
            "answers are known of bodies that are free or repeated both ways, not of one that is "
            f"repeated along {along} alone; for its curve, {' and '.join(take)}",
            None,
            "periodic",
            "materials",
        )


def refuse_on_line(ask: Iterable[Asked]) -> None:
    """Refuse what is asked of a line and belongs to a surface."""
    for each in ask:
        if (why := _NOT_OF_LINES.get(type(each))) is not None:
            name = next(iter(_field_names(each).values()))
            raise InputError(f"{name} belongs to a surface: {why}")
