"""The state of the view "Explore": what its address says, read and checked."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

from roughline.errors import UnitError
from roughline.lab.controls import Control, ControlError
from roughline.lab.explore import controls as c
from roughline.theories.theory import THEORIES
from roughline.units import decimal, in_si, load_in_newtons

VERSION = "1"
"""Of the address; one of another version is refused."""

_HURST = re.compile(r"\s*H\s*=(?P<hurst>.*)")
_HAS_UNIT = re.compile(r"[-+.\d]+(e[-+]?\d+)?\s*[^\W\d]", re.IGNORECASE)
_OF_THE_PAGE = ("view", "theme")  # parameters of an address that are no part of this state


@dataclass(frozen=True)
class ExploreState:
    """What is generated and pressed.

    Attributes
    ----------
    D_f : float
        Fractal dimension. [1]
    roll_off, cutoff : float
        Wavelengths, in sides of the surface. [1]
    rms : {"height", "slope"}
        Which of `h` and `slope` counts.
    h, slope : float
        Rms height in sides of the surface, and rms slope. [1]
    seed : int
        Of the phases.
    n : int
        Points along a side.
    boundary : {"free", "periodic"}
        Of the half-space.
    F : float
        Dimensionless force F / (E* h L). [1]
    shown : str
        What the second map shows.
    L, E : str
        Side of the surface and contact modulus, with units: what lengths and forces are told in.
    theories : tuple of str
        Drawn beside the curve.
    """

    D_f: float = c.D_F.default
    roll_off: float = c.ROLL_OFF.default
    cutoff: float = c.CUTOFF.default
    rms: str = c.ROUGHNESS.default
    h: float = c.HEIGHT.default
    slope: float = c.SLOPE.default
    seed: int = int(c.SEED.default)
    n: int = int(c.POINTS.default)
    boundary: str = c.BOUNDARY.default
    F: float = c.FORCE.default
    shown: str = c.SHOWN.default
    L: str = "1 mm"
    E: str = "110 GPa"
    theories: tuple[str, ...] = ()

    @property
    def length(self) -> float:
        """Side of the surface. [m]"""
        return in_si(self.L, "m", "side of the surface")

    @property
    def E_star(self) -> float:
        """Contact modulus. [Pa]"""
        return in_si(self.E, "Pa", "contact modulus")

    @property
    def periodic(self) -> bool:
        """Whether the surface is repeated."""
        return self.boundary == "periodic"

    @property
    def hurst(self) -> float:
        """H = 3 - D_f. [1]"""
        return round(3 - self.D_f, 12)

    def address(self) -> dict[str, str]:
        """What the address says of this state: the version, and what is not the default."""
        default = ExploreState()
        said = {"v": VERSION}
        for each in fields(self):
            value = getattr(self, each.name)
            if value != getattr(default, each.name) or each.name in ("D_f", "F", "n", "seed"):
                said[each.name] = _in_address(value)
        return said


def state_of(said: Mapping[str, str], most_points: int) -> ExploreState:
    """Read the parameters of an address, or the texts of the controls.

    Parameters
    ----------
    said : mapping of str to str
        Texts by the keys of the controls; those that are missing have their defaults.
    most_points : int
        Most points along a side that are allowed here.

    Raises
    ------
    ControlError
        If the version is another, or a text cannot be used; it says at which control.
    """
    _refuse_strange(said)
    state = ExploreState(
        D_f=_dimension(said.get("D_f"), said.get("H")),
        rms=c.ROUGHNESS.read(said.get("rms", c.ROUGHNESS.default)),
        slope=c.SLOPE.read(said.get("slope", str(c.SLOPE.default))),
        seed=int(c.SEED.read(said.get("seed", str(c.SEED.default)))),
        n=_points(said.get("n", c.POINTS.default), most_points),
        boundary=c.BOUNDARY.read(said.get("boundary", c.BOUNDARY.default)),
        shown=c.SHOWN.read(said.get("shown", c.SHOWN.default)),
        L=_quantity(said.get("L", ExploreState.L), "m", "L", "side of the surface"),
        E=_quantity(said.get("E", ExploreState.E), "Pa", "E", "contact modulus"),
        theories=_theories(said.get("theories", "")),
    )
    side = state.length
    state = replace(
        state,
        roll_off=_in_sides(said, c.ROLL_OFF, side),
        cutoff=_in_sides(said, c.CUTOFF, side),
        h=_in_sides(said, c.HEIGHT, side),
    )
    if not state.cutoff < state.roll_off:
        raise ControlError(
            f"the cutoff, {state.cutoff:.4g} sides, is not shorter than the roll-off, "
            f"{state.roll_off:.4g} sides: shorten it, or lengthen the roll-off",
            c.CUTOFF.key,
        )
    if 2 / state.n >= state.roll_off:
        raise ControlError(
            f"{state.n} points carry no waves shorter than the roll-off, {state.roll_off:.4g} "
            "sides: take more points, or a longer roll-off",
            c.POINTS.key,
        )
    return replace(state, F=_force_bar(said.get("F", str(c.FORCE.default)), state))


def _refuse_strange(said: Mapping[str, str]) -> None:
    """Refuse an address of another version, and parameters that are none."""
    if said.get("v", VERSION) != VERSION:
        raise ControlError(
            f'this link is of version "{said["v"][:20]}" of the lab\'s addresses, and this lab '
            f"reads version {VERSION}: set the controls by hand"
        )
    known = {each.name for each in fields(ExploreState)} | {"v", "H", *_OF_THE_PAGE}
    strange = [name[:40] for name in said if name not in known]
    if strange:
        raise ControlError(
            f'the link sets "{strange[0]}", which this lab does not know: it may be of another '
            "version; set the controls by hand"
        )


def _dimension(text: str | None, hurst: str | None) -> float:
    """The fractal dimension, or 3 less the Hurst exponent that is given instead."""
    typed = _HURST.fullmatch(text or "")
    if typed:
        hurst, text = typed["hurst"], None
    if hurst is None:
        return c.D_F.read(str(c.D_F.default) if text is None else text)
    try:
        value = float(hurst)
    except ValueError:
        value = -1.0
    if not 0 <= value <= 1:
        raise ControlError(f"H is {hurst.strip()[:40]}; give a number from 0 to 1", c.D_F.key)
    return round(3 - value, 12)


def _points(text: str, most: int) -> int:
    n = int(c.POINTS.read(text))
    if n > most:
        raise ControlError(f"{n} points along a side are more than this lab allows, {most}", "n")
    return n


def _quantity(text: str, unit: str, key: str, name: str) -> str:
    """A positive quantity with its unit, as it was typed."""
    try:
        value = in_si(text, unit, name)
    except UnitError as error:
        raise ControlError(str(error), key) from None
    if not 0 < value < 1e30:
        raise ControlError(f"{name} is {text}; a positive one is needed", key)
    return text.strip()


def _in_sides(said: Mapping[str, str], control: Control, side: float) -> float:
    """A length as a share of the side; one with a unit is divided by it."""
    text = said.get(control.key, str(control.default))
    if not _HAS_UNIT.match(text):
        return control.read(text)
    try:
        return control.checked(in_si(text, "m", control.name) / side)
    except UnitError as error:
        raise ControlError(str(error), control.key) from None
    except ControlError as error:
        raise ControlError(f"{error} sides of {decimal(side * 1e3, 4)} mm", control.key) from None


def _force_bar(text: str, state: ExploreState) -> float:
    """The dimensionless force; a force or a pressure is divided by E* h L."""
    if not _HAS_UNIT.match(text):
        return c.FORCE.read(text)
    from roughline.lab.explore.bodies import rms_height  # here because it may generate a surface

    try:
        force = load_in_newtons(text, state.length**2)
    except UnitError as error:
        raise ControlError(str(error), c.FORCE.key) from None
    return c.FORCE.checked(force / (state.E_star * rms_height(state) * state.length))


def _theories(text: str) -> tuple[str, ...]:
    names = tuple(name for name in text.split(",") if name)
    for name in names:
        if name not in THEORIES:
            allowed = ", ".join(THEORIES)
            raise ControlError(f'there is no theory "{name[:40]}"; there are {allowed}', "theories")
    return names


def _in_address(value: object) -> str:
    if isinstance(value, tuple):
        return ",".join(value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)
