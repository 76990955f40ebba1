"""What may be asked of pressed bodies beside the contact itself: each a value of its own."""

from __future__ import annotations

import functools
import math
import re
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypeVar, get_args

from roughline.assessment.fields import FIELDS, asked_fields, beside
from roughline.assessment.given import Parsed, as_si, quantity, several
from roughline.engineering.attraction import Attraction
from roughline.engineering.fluids import Gas, Liquid, fluid_of
from roughline.engineering.sealing import SealShape
from roughline.errors import InputError
from roughline.errors.checks import flag, number, one_of, refuse
from roughline.errors.public import public
from roughline.errors.words import speaking

_MARKED = re.compile(
    r"(?P<pressure>.*(?:Pa|bar|psi|atm))\s*\(?(?P<mark>gauge|g|absolute|abs|a)\.?\)?\s*",
    re.IGNORECASE,
)
"""A pressure that says whether it is above that of the air, such as "6 barg", or "7 bar abs"."""

_MOST_FRICTION = 5.0  # that of rubber on dry glass is about 4
_Class = TypeVar("_Class", bound=type)


def _coefficient_of_friction(given: Any) -> float:
    """Return a coefficient of friction that two bodies may have."""
    needed = f"a number above 0 and up to {_MOST_FRICTION:g} is needed, such as 0.3"
    if not 0 < number("friction", given, needed) <= _MOST_FRICTION:
        refuse("friction", given, needed)
    return float(given)


def _absolute(name: str) -> Callable[[Any], float]:
    """A reader of an absolute pressure; that of vacuum is zero. [Pa]"""

    def read(given: Any) -> float:
        marked = _MARKED.fullmatch(given) if isinstance(given, str) else None
        if marked and marked["mark"].lower().startswith("g"):
            needed = "an absolute pressure is needed: add that of the air, 1.013 bar"
            refuse(name, given, needed)
        pressure = as_si(marked["pressure"] if marked else given, "Pa", name)
        if not 0 <= pressure < math.inf:
            refuse(name, given, "an absolute pressure is needed, which is zero in vacuum")
        return pressure

    return read


def _carries(given: Any) -> bool | None:
    """Whether a fluid carries load; None where that is left open."""
    return None if given is None else flag("fluid_carries", given)


def _fluid(given: Any) -> Liquid | Gas:
    """A fluid, from itself or from its description."""
    try:
        with speaking(None):  # a description calls its values the same for everyone
            return fluid_of(given)
    except InputError as error:
        raise type(error)(f"cannot be used: {error}", "fluid") from error


def _direction(given: Any) -> Literal["x", "y", "both"]:
    """A direction over the map."""
    directions: tuple[Literal["x", "y", "both"], ...] = ("both", "x", "y")
    return one_of("flow_along", given, directions)


@public
@dataclass(frozen=True)
class Adhesion:
    """Bodies that stick, asked for what it takes to draw them apart after their largest load.

    Parameters
    ----------
    attraction : str, float, Dugdale or Exponential
        The work of adhesion, the range and the law, such as "50 mJ/m^2 over 2 nm, exponential"; a
        number is the work. [J/m²] Or a name of the table of works of adhesion, such as "pdms".
        Without a range, it is the shortest that the grid resolves; without a law, it is Dugdale's.
    """

    attraction: Parsed[Attraction] = Parsed(Attraction.of)


@public
@dataclass(frozen=True)
class Friction:
    """Coulomb friction between the bodies, asked for partial slip at the largest load.

    Parameters
    ----------
    coefficient : float
        Coefficient of friction, above 0 and up to 5. [1]
    """

    coefficient: Parsed[float] = Parsed(_coefficient_of_friction)


@public
@dataclass(frozen=True)
class Ultrasound:
    """An ultrasonic wave, asked for its reflection by the interface.

    Parameters
    ----------
    frequency : float or str
        Such as "5 MHz". [Hz]
    """

    frequency: Parsed[float] = Parsed(
        quantity("Hz", "frequency", "a positive, finite one is needed")
    )


@public
@dataclass(frozen=True)
class Joint:
    """The joint that a surface is a map of, asked for its answers instead of the map's.

    The map is pressed at the joint's mean pressure, and forces act on the joint.

    Parameters
    ----------
    area : float or str
        Nominal area, such as "2 cm^2", not below that of the map and up to 1 km². [m²]
    """

    area: Parsed[float] = Parsed(
        quantity("m^2", "joint_area", "a positive, finite area is needed, up to 1 km²", 1e6)
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
            one_of("theories", name, known_theories())
        object.__setattr__(self, "names", names)


def known_theories() -> list[str]:
    """Names of the theories that can be asked."""
    from roughline.theories.theory import THEORIES  # here because it loads slowly

    return list(THEORIES)


@public
@dataclass(frozen=True)
class History:
    """Loads or depths applied in the order given, each to the surface as the last one left it."""


@public
@dataclass(frozen=True)
class Unloading:
    """The largest load taken off again, in steps down to zero."""


@public
@dataclass(frozen=True)
class WholeCurve:
    """Further loads, from a thousandth of the largest one up, solved too for figures."""


@public
@dataclass(frozen=True)
class Fluid:
    """A fluid in the gap, asked for what flows through, and for what a gas conducts.

    Parameters
    ----------
    fluid : str, Liquid or Gas
        Such as "water" or "helium", of the table of fluids.
    """

    fluid: Parsed[Liquid | Gas] = Parsed(_fluid)


@public
@dataclass(frozen=True)
class Inlet:
    """Absolute pressure of the fluid where it enters the seal.

    Parameters
    ----------
    pressure : float or str
        Such as "6 bar". [Pa]
    carries : bool, optional
        Whether the fluid carries its part of the load, so that the bodies press with the rest.
        Default: where that is a twentieth of the load or more.
    """

    pressure: Parsed[float] = Parsed(_absolute("inlet"))
    carries: Parsed[bool | None] = Parsed(_carries, default=None)


@public
@dataclass(frozen=True)
class Outlet:
    """Absolute pressure of the fluid where it leaves the seal; without it, that outside.

    Parameters
    ----------
    pressure : float or str
        Such as "1 bar", or zero for vacuum. [Pa]
    """

    pressure: Parsed[float] = Parsed(_absolute("outlet"))


@public
@dataclass(frozen=True)
class Seal:
    """The face that the fluid crosses, asked for its leak rate.

    Parameters
    ----------
    shape : str
        Length across the flow and width along it, such as "100 mm x 2 mm", or the inner and the
        outer radius of a ring, such as "20 mm .. 24 mm".
    """

    shape: Parsed[SealShape] = Parsed(SealShape.of)


@public
@dataclass(frozen=True)
class FlowAlong:
    """Direction over the map in which the fluid flows; without it, the leakier one of both.

    Parameters
    ----------
    direction : {"both", "x", "y"}
        Along x or y of the map.
    """

    direction: Parsed[Literal["x", "y", "both"]] = Parsed(_direction)


@public
@dataclass(frozen=True)
class Closure:
    """The mean pressure at which the last channel closes, and how far the load may be taken off."""


Asked = (
    Adhesion
    | Friction
    | Ultrasound
    | Joint
    | Theories
    | History
    | Unloading
    | WholeCurve
    | Fluid
    | Inlet
    | Outlet
    | Seal
    | FlowAlong
    | Closure
)
_EARLIER = (
    *("friction", "frequency", "joint_area", "theories", "history", "unload", "whole_curve"),
)
"""What version 0.2 was told by keywords of its own."""
_KINDS = {each.__name__: each for each in get_args(Asked)}


def asked_for(told: Mapping[str, Any]) -> tuple[Asked, ...]:
    """Return what is asked, from values by the names of fields; None and False ask nothing."""
    asked = []
    for each in asked_fields(told):
        value, kind = told[each.name], _KINDS[each.of]
        if each.is_switch:
            if not isinstance(value, bool):
                refuse(each.name, value, "True or False is needed")
            asked += [kind()] if value else []
        elif each.separator:
            asked += [kind(*several(value))] if several(value) else []
        else:
            asked.append(kind(value, **beside(each, told)))
    return tuple(asked)


def with_earlier_keywords(question: _Class) -> _Class:
    """A class that takes the keywords of version 0.2 beside `ask` too, for one release."""
    made: Callable[..., None] = question.__init__  # type: ignore[misc]

    @functools.wraps(made)
    def make(self: Any, *given: Any, **named: Any) -> None:
        earlier = [each for each in FIELDS if each.name in _EARLIER and each.name in named]
        if earlier:
            told = {each.name: named.pop(each.name) for each in earlier}
            named["ask"] = (*several(named.get("ask")), *asked_for(told))
            words = [each.in_python(told[each.name]) for each in earlier if told[each.name]]
            warnings.warn(
                f"{', '.join(f'{name}=' for name in told)} will be gone in the next release: write "
                f"ask=[{', '.join(words)}]",
                DeprecationWarning,
                stacklevel=2,
            )
        made(self, *given, **named)

    question.__init__ = make  # type: ignore[misc]
    return question
