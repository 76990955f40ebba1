"""The state of the view "Explore": what is generated, and how it is pressed, read and checked."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from typing import Any

import numpy as np

import roughline as rl
from roughline.errors.checks import shown
from roughline.lab.controls import (
    VERSION,
    ControlError,
    Texts,
    as_text,
    has_unit,
    is_number,
    refuse_strange,
    rounded,
    texts_of,
    usable,
)
from roughline.lab.explore.controls import CHOICES, NUMBERS
from roughline.lab.server.tasks import Arguments
from roughline.units import engineering, in_si, load_in_newtons

_HURST = re.compile(r"\s*H\s*=(?P<hurst>.*)")
_OF_THE_SURFACE = ("D_f", "roll_off", "cutoff", "rms", "h", "slope", "seed", "n")
_SIDES, _MODULI = (1e-12, 1e3), (1.0, 1e14)  # that are allowed [m], [Pa]


@dataclass(frozen=True)
class ExploreState:
    """What is generated and pressed, by the keys of the controls, which say what each means.

    Lengths are in sides of the surface.
    """

    D_f: float = NUMBERS["D_f"].default
    roll_off: float = NUMBERS["roll_off"].default
    cutoff: float = NUMBERS["cutoff"].default
    rms: str = CHOICES["rms"].default
    h: float = NUMBERS["h"].default
    slope: float = NUMBERS["slope"].default
    seed: int = int(NUMBERS["seed"].default)
    n: int = int(CHOICES["n"].default)
    boundary: str = CHOICES["boundary"].default
    hardness_bar: float | None = None  # None if both bodies are elastic
    F: float = NUMBERS["F"].default
    shown: str = CHOICES["shown"].default
    L: str = "1 mm"  # side of the surface
    E: str = "110 GPa"  # contact modulus
    theories: tuple[str, ...] = ()  # drawn beside the curve
    fluid: str = CHOICES["fluid"].default  # along which side it flows; empty without one
    w: float | None = None  # None if the bodies do not stick
    h0: float = NUMBERS["h0"].default

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
    def shortest(self) -> float:
        """Shortest wave that the grid carries, two spacings, in sides of the surface. [1]"""
        return 2 / self.n

    @property
    def cutoff_used(self) -> float:
        """Shortest wave of the surface, in its sides: the cutoff, or what the grid carries. [1]"""
        return max(self.cutoff, self.shortest)

    def spectrum(self, n: int) -> rl.SelfAffine:
        """The spectrum, with the waves that n points carry. [m]"""
        return self._spectrum(n, self.rms_height)

    def surface(self, n: int) -> rl.Surface:
        """The surface on n points along a side. [m]"""
        return _surface(self.spectrum(n), n, self.seed)

    @property
    def rms_height(self) -> float:
        """Rms height, given or from the rms slope on the grid. [m]"""
        if self.rms == "height":
            return self.h * self.length
        return self.slope / _surface(self._spectrum(self.n, 1.0), self.n, self.seed).rms_slope

    @property
    def rms_slope(self) -> float:
        """Rms slope on the grid. [1]"""
        return self.slope if self.rms == "slope" else self.surface(self.n).rms_slope

    @property
    def hardness(self) -> float | None:
        """Hardness, the same on every grid; None if both bodies are elastic. [Pa]"""
        if self.hardness_bar is None:
            return None
        return self.hardness_bar * self.E_star * self.rms_slope

    @property
    def law(self) -> rl.ContactLaw | None:
        """What pressures and gaps obey; None if the bodies are elastic and do not stick."""
        if self.w is not None:
            work = self.w * self.E_star * self.rms_height**2 / self.length
            return rl.Dugdale(work_of_adhesion=work, range=self.h0 * self.rms_height)
        return None if self.hardness is None else rl.Yielding(self.hardness)

    def zone(self, n: int) -> float:
        """Cells across the zone that pulls about a contact, with so many along a side. [1]"""
        return math.inf if self.w is None else n * self.h0**2 / (math.pi * self.w)

    def points(self, fewest: int) -> int:
        """The fewest points along a side, from so many on, that resolve the pull, if any do."""
        n = min(self.n, fewest)
        while n < self.n and self.zone(n) < rl.Dugdale.resolved_zone:
            n *= 2
        return n

    def force(self, force_bar: Any) -> Any:
        """Forces F = F̄ E* h L. [N]"""
        return force_bar * (self.E_star * self.rms_height * self.length)

    @property
    def most_force_bar(self) -> float:
        """Dimensionless force under which all of the area would yield. [1]"""
        borne = self.hardness
        return math.inf if borne is None else borne * self.length**2 / self.force(1.0)

    def texts(self) -> dict[str, str]:
        """All that is set, as texts by the keys of the controls."""
        return {each.name: _in_address(getattr(self, each.name)) for each in fields(self)}

    def address(self) -> dict[str, str]:
        """What the address says of this state: the version, and what is not the default."""
        default = ExploreState().texts()
        said = {
            key: text
            for key, text in self.texts().items()
            if text != default[key] or key in ("D_f", "F", "n", "seed")
        }
        return {"v": VERSION, **said}

    def _spectrum(self, n: int, height: float) -> rl.SelfAffine:
        q_low = 2 * math.pi / self.length
        return rl.SelfAffine(
            fractal_dimension=self.D_f,
            length=self.length,
            rms_height=height,
            q_roll=q_low / self.roll_off,
            q_high=q_low * min(1 / self.cutoff, n / 2),
        )


@lru_cache(maxsize=4)
def _surface(spectrum: rl.SelfAffine, n: int, seed: int) -> rl.Surface:
    return replace(spectrum.surface(n, seed), unit="m")


def _in_address(value: object) -> str:
    if isinstance(value, tuple):
        return ",".join(value)
    if value is None:
        return ""
    return as_text(value) if isinstance(value, float) else str(value)


def usable_state(arguments: Arguments) -> tuple[ExploreState, dict[str, str]]:
    """The state that a page asks about, and what of its texts is not used, by control."""
    most_points = arguments["session"]["max_points"]
    return usable(arguments, lambda texts: state_of(texts, most_points), ExploreState.texts)


def state_in(arguments: Arguments) -> ExploreState:
    """The state that a page asks about, all of whose texts can be used."""
    return state_of(texts_of(arguments), arguments["session"]["max_points"])


def state_of(said: Texts, most_points: int) -> ExploreState:
    """Read the parameters of an address, or the texts of the controls.

    Those that are missing have their defaults; so many points along a side are allowed here.

    Raises
    ------
    ControlError
        If the version is another, or a text cannot be used; it says at which control.
    """
    refuse_strange(said, {each.name for each in fields(ExploreState)} | {"H"})
    state = ExploreState(
        D_f=_dimension(said.get("D_f"), said.get("H")),
        rms=CHOICES["rms"].read_in(said),
        slope=NUMBERS["slope"].read_in(said),
        seed=int(NUMBERS["seed"].read_in(said)),
        n=_points(said.get("n"), most_points),
        boundary=CHOICES["boundary"].read_in(said),
        shown=CHOICES["shown"].read_in(said),
        L=_quantity(said.get("L", ExploreState.L), "m", "L", "side of the surface", _SIDES),
        E=_quantity(said.get("E", ExploreState.E), "Pa", "E", "contact modulus", _MODULI),
        theories=_theories(said.get("theories", "")),
        fluid=CHOICES["fluid"].read_in(said),
    )
    side = state.length
    state = replace(
        state,
        roll_off=_in_sides(said, "roll_off", side),
        cutoff=_in_sides(said, "cutoff", side),
        h=_in_sides(said, "h", side),
    )
    if not state.cutoff < state.roll_off:
        raise ControlError(
            f"the cutoff, {state.cutoff:.4g} sides, is not shorter than the roll-off, "
            f"{state.roll_off:.4g} sides: shorten it, or lengthen the roll-off",
            *("cutoff", "roll_off"),
        )
    if 2 / state.n >= state.roll_off:
        raise ControlError(
            f"{state.n} points carry no waves shorter than the roll-off, {state.roll_off:.4g} "
            "sides: take more points, or a longer roll-off",
            *("n", "roll_off"),
        )
    state = replace(state, hardness_bar=_hardness_bar(said.get("hardness_bar", ""), state))
    state = _sticking(said, state)
    state = replace(state, F=_force_bar(said.get("F", str(ExploreState.F)), state))
    most = state.most_force_bar
    if most <= state.F:
        raise ControlError(
            f"the surface bears less than its hardness everywhere, F̄ = {most:.3g}: give a smaller "
            "load, or a larger hardness",
            *("F", "hardness_bar", *_OF_THE_SURFACE),
        )
    return state


def _dimension(text: str | None, hurst: str | None) -> float:
    """The fractal dimension, or 3 less the Hurst exponent that is given instead."""
    typed = _HURST.fullmatch(text or "")
    if typed:
        hurst, text = typed["hurst"], None
    if hurst is None:
        return NUMBERS["D_f"].read(str(ExploreState.D_f) if text is None else text)
    value = float(hurst) if is_number(hurst) else -1.0
    if not 0 <= value <= 1:
        raise ControlError(f"H is {shown(hurst.strip())}; give a number from 0 to 1", "D_f", "H")
    return round(3 - value, 12)


def _points(text: str | None, most: int) -> int:
    """Points along a side; without a text the default, or as many as the lab allows."""
    points = CHOICES["n"]
    if text is None:
        return max(n for n in map(int, points.options) if n <= min(most, ExploreState.n))
    n = int(points.read(text))
    if n > most:
        raise ControlError(f"{n} points along a side are more than this lab allows, {most}", "n")
    return n


def _quantity(text: str, unit: str, key: str, name: str, ends: tuple[float, float]) -> str:
    """A quantity with its unit, as it was typed."""
    try:
        value = in_si(text, unit, name)
    except rl.UnitError as error:
        raise ControlError(str(error), key) from None
    if not ends[0] <= value <= ends[1]:
        low, high = (engineering(end, unit) for end in ends)
        raise ControlError(f"{name} is {shown(text)}; give one from {low} to {high}", key)
    return text.strip()


def _in_sides(said: Texts, key: str, side: float) -> float:
    """A length as a share of the side; one with a unit is divided by it."""
    return _in_scales(said.get(key, str(NUMBERS[key].default)), key, "m", side, "sides")


def _in_scales(text: str, key: str, unit: str, scale: float, called: str) -> float:
    """A quantity over a scale, which is called by its plural; one with a unit is divided by it."""
    control = NUMBERS[key]
    if not has_unit(text):
        return control.read(text)
    try:
        value = in_si(text, unit, control.name)
    except rl.UnitError as error:
        raise ControlError(str(error), key) from None
    try:
        return control.checked(rounded(value / scale))
    except ControlError:
        unit = unit.replace("**2", "²")
        low, high = (engineering(end * scale, unit, 3) for end in (control.low, control.high))
        raise ControlError(
            f"{control.name} is {shown(text.strip())}; give one from {low} to {high}, which is "
            f"{control.range} {called}",
            key,
        ) from None


def _hardness_bar(text: str, state: ExploreState) -> float | None:
    """The dimensionless hardness, none for no text; a pressure is divided by E* ∇h."""
    if not text.strip():
        return None
    return _in_scales(text, "hardness_bar", "Pa", state.E_star * state.rms_slope, "E* ∇h")


def _sticking(said: Texts, state: ExploreState) -> ExploreState:
    """The state with its work of adhesion, none for no text, and the range of the pull."""
    height = state.rms_height
    state = replace(state, h0=_in_scales(said.get("h0", as_text(state.h0)), "h0", "m", height, "h"))
    if not (text := said.get("w", "")).strip():
        return state
    scale = state.E_star * height**2 / state.length
    state = replace(state, w=_in_scales(text, "w", "J/m**2", scale, "E* h² / L"))
    if state.hardness_bar is not None:
        raise ControlError(
            "bodies that stick and yield have no law here: take the hardness away, or the adhesion",
            *("w", "hardness_bar"),
        )
    cell = state.length / state.n
    try:  # the grid is refused alike under a flat body of few cells, far away
        flat = rl.Surface(np.zeros((2, 2)), sizes=(2 * cell, 2 * cell))
        rl.press(flat, E_star=state.E_star, law=state.law, depths=[-4 * state.h0 * height])
    except rl.InputError as error:
        raise ControlError(str(error), "h0", "w", "n", *_OF_THE_SURFACE) from None
    return state


def _force_bar(text: str, state: ExploreState) -> float:
    """The dimensionless force; a force or a pressure is divided by E* h L."""
    control = NUMBERS["F"]
    if not has_unit(text):
        return control.read(text)
    try:
        force = load_in_newtons(text, state.length**2)
    except rl.UnitError as error:
        raise ControlError(str(error), "F") from None
    force_bar = force / state.force(1.0)
    try:
        return control.checked(rounded(force_bar))
    except ControlError:
        low, high = (engineering(state.force(end), "N", 3) for end in (control.low, control.high))
        raise ControlError(
            f"the load {shown(text.strip())} is F̄ = {force_bar:.3g}; give one from {low} to "
            f"{high}, which is F̄ {control.range}",
            "F",
        ) from None


def _theories(text: str) -> tuple[str, ...]:
    return tuple(CHOICES["theories"].read(name) for name in text.split(",") if name)
