"""The address of the view "Explore", or the texts of its controls, read and checked."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import roughline as rl
from roughline.errors.checks import shown
from roughline.lab.controls import (
    Control,
    ControlError,
    Texts,
    has_unit,
    is_number,
    refuse_strange,
    rounded,
    usable,
)
from roughline.lab.explore import controls as c
from roughline.lab.explore.bodies import most_force_bar, rms_height, rms_slope
from roughline.lab.explore.state import ExploreState
from roughline.units import engineering, in_si, load_in_newtons

_HURST = re.compile(r"\s*H\s*=(?P<hurst>.*)")
_OF_THE_SURFACE = ("D_f", "roll_off", "cutoff", "rms", "h", "slope", "seed", "n")
_SIDES, _MODULI = (1e-12, 1e3), (1.0, 1e14)  # that are allowed [m], [Pa]


def usable_state(arguments: Mapping[str, Any]) -> tuple[ExploreState, dict[str, str]]:
    """The state that a page asks about, and what of its texts is not used, by control."""
    most_points = arguments["session"]["max_points"]
    return usable(arguments, lambda texts: state_of(texts, most_points), ExploreState.texts)


def state_of(said: Texts, most_points: int) -> ExploreState:
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
    refuse_strange(said, {each.name for each in fields(ExploreState)} | {"H"})
    state = ExploreState(
        D_f=_dimension(said.get("D_f"), said.get("H")),
        rms=c.ROUGHNESS.read(said.get("rms", c.ROUGHNESS.default)),
        slope=c.SLOPE.read(said.get("slope", str(c.SLOPE.default))),
        seed=int(c.SEED.read(said.get("seed", str(c.SEED.default)))),
        n=_points(said.get("n"), most_points),
        boundary=c.BOUNDARY.read(said.get("boundary", c.BOUNDARY.default)),
        shown=c.SHOWN.read(said.get("shown", c.SHOWN.default)),
        L=_quantity(said.get("L", ExploreState.L), "m", "L", "side of the surface", _SIDES),
        E=_quantity(said.get("E", ExploreState.E), "Pa", "E", "contact modulus", _MODULI),
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
            *(c.CUTOFF.key, c.ROLL_OFF.key),
        )
    if 2 / state.n >= state.roll_off:
        raise ControlError(
            f"{state.n} points carry no waves shorter than the roll-off, {state.roll_off:.4g} "
            "sides: take more points, or a longer roll-off",
            *(c.POINTS.key, c.ROLL_OFF.key),
        )
    state = replace(state, hardness_bar=_hardness_bar(said.get("hardness_bar", ""), state))
    state = replace(state, F=_force_bar(said.get("F", str(c.FORCE.default)), state))
    most = most_force_bar(state)
    if most <= state.F:
        raise ControlError(
            f"the surface bears less than its hardness everywhere, F̄ = {most:.3g}: give a smaller "
            "load, or a larger hardness",
            *(c.FORCE.key, c.HARDNESS.key, *_OF_THE_SURFACE),
        )
    return state


def _dimension(text: str | None, hurst: str | None) -> float:
    """The fractal dimension, or 3 less the Hurst exponent that is given instead."""
    typed = _HURST.fullmatch(text or "")
    if typed:
        hurst, text = typed["hurst"], None
    if hurst is None:
        return c.D_F.read(str(c.D_F.default) if text is None else text)
    value = float(hurst) if is_number(hurst) else -1.0
    if not 0 <= value <= 1:
        raise ControlError(
            f"H is {shown(hurst.strip())}; give a number from 0 to 1", *(c.D_F.key, "H")
        )
    return round(3 - value, 12)


def _points(text: str | None, most: int) -> int:
    """Points along a side; without a text the default, or as many as the lab allows."""
    if text is None:
        return max(n for n in map(int, c.POINTS.options) if n <= min(most, int(c.POINTS.default)))
    n = int(c.POINTS.read(text))
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


def _in_sides(said: Texts, control: Control, side: float) -> float:
    """A length as a share of the side; one with a unit is divided by it."""
    text = said.get(control.key, str(control.default))
    return _in_scales(text, control, "m", side, "sides")


def _in_scales(text: str, control: Control, unit: str, scale: float, called: str) -> float:
    """A quantity over a scale, which is called by its plural; one with a unit is divided by it."""
    if not has_unit(text):
        return control.read(text)
    try:
        value = in_si(text, unit, control.name)
    except rl.UnitError as error:
        raise ControlError(str(error), control.key) from None
    try:
        return control.checked(rounded(value / scale))
    except ControlError:
        low, high = (engineering(end * scale, unit, 3) for end in (control.low, control.high))
        raise ControlError(
            f"{control.name} is {shown(text.strip())}; give one from {low} to {high}, which is "
            f"{control.range} {called}",
            control.key,
        ) from None


def _hardness_bar(text: str, state: ExploreState) -> float | None:
    """The dimensionless hardness, none for no text; a pressure is divided by E* ∇h."""
    if not text.strip():
        return None
    return _in_scales(text, c.HARDNESS, "Pa", state.E_star * rms_slope(state), "E* ∇h")


def _force_bar(text: str, state: ExploreState) -> float:
    """The dimensionless force; a force or a pressure is divided by E* h L."""
    if not has_unit(text):
        return c.FORCE.read(text)
    try:
        force = load_in_newtons(text, state.length**2)
    except rl.UnitError as error:
        raise ControlError(str(error), c.FORCE.key) from None
    scale = state.E_star * rms_height(state) * state.length
    try:
        return c.FORCE.checked(rounded(force / scale))
    except ControlError:
        low, high = (engineering(end * scale, "N", 3) for end in (c.FORCE.low, c.FORCE.high))
        raise ControlError(
            f"the load {shown(text.strip())} is F̄ = {force / scale:.3g}; give one from {low} to "
            f"{high}, which is F̄ {c.FORCE.range}",
            c.FORCE.key,
        ) from None


def _theories(text: str) -> tuple[str, ...]:
    names = tuple(name for name in text.split(",") if name)
    return tuple(c.THEORIES.read(name) for name in names)
