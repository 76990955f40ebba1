"""A ball that is pressed against a flat, in numbers that people ask for."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import NoReturn

import numpy as np
from attrs import field, frozen

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.contact.strain import LARGE_STRAIN
from roughline.engineering.attraction import Attraction
from roughline.engineering.coated import Solid
from roughline.engineering.formulas import ELASTIC_UP_TO, largest_pressure_under_ball
from roughline.engineering.pair import MaterialPair
from roughline.errors import InputError, UnitWarning
from roughline.errors.checks import refuse, shown
from roughline.errors.words import called
from roughline.facts.fact import Fact, WithFacts
from roughline.halfspace.laws.jkr import JKR
from roughline.question.arguments import (
    called_by,
    given_pair,
    modulus,
    quantities,
    quantity,
    read_pair,
    refuse_unless_one_load,
    refuse_unless_one_modulus,
)
from roughline.topography.profile import Profile
from roughline.units import as_si

_RADIUS = 1e-12, 1e6  # of balls [m]
_RADII = 800  # of a profile: a sphere's force is right to 1e-5 where nine tenths of it touch
_FINEST = 1e-6  # least radius of a profile over that of the ball, without its zero
_ALL_PRESSED_IN = 10.0  # radii of depth, or E* R² of force, that surely press in all of the ball
_YIELDS_FROM = 1.5 * ELASTIC_UP_TO  # largest pressure over hardness; Hertz's mean is 2/3 of it
_SHORT_RANGE = 5.0  # Tabor's parameter, from which on the pull is as good as without a range


def _radius(given: float | str) -> float:
    """Radius of a ball. [m]"""
    radius = as_si(given, "m", "radius")
    if not _RADIUS[0] <= radius <= _RADIUS[1]:
        refuse("radius", given, "a length from 1 pm to 1000 km is needed")
    return radius


def _hardness(given: float | str | None) -> float | None:
    """A hardness, if one is given. [Pa]"""
    if given is None:
        return None
    return quantity(given, "Pa", "hardness", "a positive, finite pressure is needed")


def _adhesion(given: float | str | Attraction | None) -> Attraction | None:
    """How the ball sticks, if it does."""
    return None if given is None else Attraction.of(given)


@frozen
class BallQuestion:
    """What is asked of a ball against a flat, or of two materials in either order.

    Everything is in SI units; a quantity is a number, or a text with its unit.

    Parameters
    ----------
    radius : float or str
        Radius of curvature. [m]
    materials : pair of Material or str, or str, optional
        Of both bodies.
    E_star : float or str, optional
        Contact modulus instead of materials. [Pa]
    hardness : float or str, optional
        Hardness of the softer body; default: that of the materials, if it is known. [Pa]
    adhesion : float or str, optional
        Work of adhesion; the ball then sticks as JKR have it. [J / m²]
    loads, depths : float or str, or sequence of them, optional
        Forces [N] or depths since first touch [m], one of the two, in the order in which they are
        applied. Of bodies that stick they may be negative.
    is_sphere : bool, optional
        Whether the ball is a sphere, and not the parabola that Hertz takes for it.

    Raises
    ------
    InputError
        If the question does not fit together.
    UnitError
        If a text has no unit, or a wrong one.
    """

    radius: float = field(converter=_radius)
    materials: tuple[Solid, Solid] | None = field(default=None, converter=read_pair)
    E_star: float | None = field(default=None, converter=modulus)
    hardness: float | None = field(default=None, converter=_hardness)
    adhesion: Attraction | None = field(default=None, converter=_adhesion)
    loads: tuple[float | str, ...] = field(default=(), converter=quantities)
    depths: tuple[float | str, ...] = field(default=(), converter=quantities)
    is_sphere: bool = False

    def __attrs_post_init__(self) -> None:
        refuse_unless_one_modulus(self.E_star, self.materials)
        refuse_unless_one_load(self.loads, self.depths)
        pair = self.pair
        if pair is not None and pair.coated:
            refuse(
                "materials",
                pair.coated[0].name,
                "a ball is pressed into a body of one material: leave the layers out",
            )
        if self.adhesion is not None:
            self._check_adhesion(self.adhesion)
        self.values  # noqa: B018 - refuses what cannot be

    def _check_adhesion(self, adhesion: Attraction) -> None:
        """Refuse a range, and a pull that draws all of the ball into contact under no load."""
        if adhesion.range is not None:
            refuse(
                "adhesion",
                adhesion.words,
                "a ball sticks as Johnson, Kendall and Roberts have it, by a pull without a range: "
                'give the work of adhesion alone, such as "50 mJ/m^2"',
            )
        if adhesion.work >= 2 * self.modulus * self.radius / (9 * math.pi):  # a = R at F = 0
            refuse(
                "adhesion",
                adhesion.words,
                "so large a work of adhesion draws all of the ball into contact: give a smaller "
                "one, or check the modulus",
            )

    @property
    def pair(self) -> MaterialPair | None:
        """Both materials, with the hardness that is given; None without materials."""
        return given_pair(self.materials, self.hardness)

    @property
    def modulus(self) -> float:
        """Contact modulus, given or of both materials. [Pa]"""
        pair = self.pair
        return (self.E_star or math.nan) if pair is None else pair.E_star

    @property
    def softer_hardness(self) -> float | None:
        """Hardness of the softer body; None if it is not known. [Pa]"""
        return self.hardness if self.pair is None else self.pair.hardness

    @property
    def values(self) -> list[float]:
        """Forces [N] or depths [m], in their order."""
        name, unit, given = "loads", "N", self.loads
        largest = _ALL_PRESSED_IN * self.modulus * self.radius**2
        if self.depths:
            name, unit, given, largest = "depths", "m", self.depths, _ALL_PRESSED_IN * self.radius
        values = [as_si(each, unit, name) for each in given]
        for i, (each, value) in enumerate(zip(given, values, strict=True)):
            if not math.isfinite(value):
                refuse(name, each, "a finite number is needed")
            if value > largest:
                _refuse_all_of_it(name, each)
            if self.adhesion is None and not (value > 0 or (value == 0 and i)):
                refuse(
                    name,
                    each,
                    "a positive one is needed, and zero only after others; bodies that stick can "
                    f"be pulled ({called('adhesion', '50 mJ/m^2')})",
                )
        return values

    @property
    def headings(self) -> list[str]:
        """What each load or depth is called: as it was typed, or with its unit."""
        unit, given = ("N", self.loads) if self.loads else ("m", self.depths)
        return called_by(given, unit)

    @property
    def profile(self) -> Profile:
        """The ball over its radius. [m]"""
        r = np.append(0.0, self.radius * np.geomspace(_FINEST, 1.0, _RADII))
        r[-1] = self.radius
        root = np.sqrt(self.radius**2 - r**2) if self.is_sphere else self.radius
        return Profile(r, -(r**2) / (self.radius + root), unit="m")


@dataclass(frozen=True, eq=False)
class PressedBall(WithFacts):
    """A pressed ball: its curve, and what follows from the contact's being a disc."""

    question: BallQuestion
    curve: Curve
    pull_off: float | None = None  # largest pull under a falling force; None unless it sticks [N]

    @property
    def contact_radius(self) -> Real:
        """Radius a of the contact, as k = 2 E* a. [m]"""
        return self.curve.stiffness / (2 * self.curve.E_star)

    @property
    def contact_area(self) -> Real:
        """Area pi a² of the contact. [m²]"""
        return np.pi * self.contact_radius**2

    @property
    def mean_pressure(self) -> Real:
        """Force over the contact area; NaN where nothing touches. [Pa]"""
        with np.errstate(invalid="ignore", divide="ignore"):
            return self.curve.force / self.contact_area

    @property
    def largest_pressure(self) -> Real:
        """Pressure in the middle of the contact; NaN where nothing touches. [Pa]"""
        question = self.question
        return largest_pressure_under_ball(
            self.contact_radius,
            question.radius,
            self.curve.E_star,
            question.adhesion.work if question.adhesion else 0.0,
            is_sphere=question.is_sphere,
        )

    @property
    def facts(self) -> list[Fact]:
        """Where what is assumed breaks, and whether it is known where yield begins."""
        found, question, E_star = [], self.question, self.curve.E_star
        hardness = question.softer_hardness
        largest = float(np.nanmax(self.largest_pressure, initial=0.0))
        if hardness is not None and largest > _YIELDS_FROM * hardness:
            bears = {"ratio": largest / hardness, "hardness": hardness, "limit": _YIELDS_FROM}
            found.append(Fact("ball_yields", **bears))
        strain = float(np.nanmax(self.mean_pressure, initial=0.0)) / E_star
        if strain > LARGE_STRAIN:
            found.append(Fact("ball_is_strained", ratio=strain))
        if question.adhesion is not None:
            reach = (question.radius * question.adhesion.work**2 / E_star**2) ** (1 / 3)
            found.append(Fact("pull_without_range", reach=reach / _SHORT_RANGE, limit=_SHORT_RANGE))
        if hardness is None:
            found.append(Fact("hardness_of_ball_unknown"))
        return found


def press_ball(question: BallQuestion) -> PressedBall:
    """Press a ball against a flat by the reduction method, which is exact for it.

    Raises
    ------
    InputError
        If a load presses in all of the ball.
    """
    profile, values = question.profile, question.values
    law = None if question.adhesion is None else JKR(question.adhesion.work)
    forces, depths = (values, None) if question.loads else (None, values)
    E_star = question.modulus
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnitWarning)  # such loads are refused below
        curve = press(profile, E_star=E_star, law=law, forces=forces, depths=depths, throw=False)
    touching = curve.stiffness / (2 * E_star)
    for given, a in zip(question.loads or question.depths, touching, strict=True):
        if a >= question.radius * (1 - 1e-9):
            _refuse_all_of_it("loads" if question.loads else "depths", given)
    if law is None:
        return PressedBall(question, curve)
    unbearable = -_ALL_PRESSED_IN * math.sqrt(
        8 * np.pi * question.radius**3 * E_star * law.work_of_adhesion
    )
    pulled = press(profile, E_star=E_star, law=law, forces=[0.0, unbearable], throw=False)
    return PressedBall(question, curve, pulled.pull_off_force)


def _refuse_all_of_it(name: str, given: float | str) -> NoReturn:
    """Refuse a load under which all of the ball touches."""
    raise InputError(
        f"is {shown(given)}: so much presses in all of the ball, and half-spaces are linear "
        "elastic far below that only; give less, or check the units",
        name,
    )
