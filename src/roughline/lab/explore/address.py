"""The address of the view "Explore", or the texts of its controls, read and checked."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import fields, replace

import roughline as rl
from roughline.lab.controls import Control, ControlError, refuse_strange
from roughline.lab.explore import controls as c
from roughline.lab.explore.bodies import most_force_bar, rms_height, rms_slope
from roughline.lab.explore.state import ExploreState
from roughline.units import engineering, in_si, load_in_newtons

_MOST = 1e30  # of a side and a modulus, in SI units; the reciprocal of the least
_HURST = re.compile(r"\s*H\s*=(?P<hurst>.*)")
_HAS_UNIT = re.compile(r"[-+.\d]+(e[-+]?\d+)?\s*[^\W\d]", re.IGNORECASE)


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
    refuse_strange(said, {each.name for each in fields(ExploreState)} | {"H"})
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
    state = replace(state, hardness_bar=_hardness_bar(said.get("hardness_bar", ""), state))
    state = replace(state, F=_force_bar(said.get("F", str(c.FORCE.default)), state))
    most = most_force_bar(state)
    if most <= state.F:
        raise ControlError(
            f"the surface bears less than its hardness everywhere, F̄ = {most:.3g}: give a smaller "
            "load, or a larger hardness",
            c.FORCE.key,
        )
    return state


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
    except rl.UnitError as error:
        raise ControlError(str(error), key) from None
    if not 1 / _MOST <= value <= _MOST:
        raise ControlError(
            f"{name} is {text.strip()[:40]}; give one from {1 / _MOST:g} to {_MOST:g} {unit}",
            key,
        )
    return text.strip()


def _in_sides(said: Mapping[str, str], control: Control, side: float) -> float:
    """A length as a share of the side; one with a unit is divided by it."""
    text = said.get(control.key, str(control.default))
    return _in_scales(text, control, "m", side, "sides")


def _in_scales(text: str, control: Control, unit: str, scale: float, called: str) -> float:
    """A quantity over a scale, which is called by its plural; one with a unit is divided by it."""
    if not _HAS_UNIT.match(text):
        return control.read(text)
    try:
        value = in_si(text, unit, control.name)
    except rl.UnitError as error:
        raise ControlError(str(error), control.key) from None
    try:
        return control.checked(value / scale)
    except ControlError:
        low, high = (engineering(end * scale, unit, 3) for end in (control.low, control.high))
        raise ControlError(
            f"{control.name} is {text.strip()[:40]}; give one from {low} to {high}, which is "
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
    if not _HAS_UNIT.match(text):
        return c.FORCE.read(text)
    try:
        force = load_in_newtons(text, state.length**2)
    except rl.UnitError as error:
        raise ControlError(str(error), c.FORCE.key) from None
    scale = state.E_star * rms_height(state) * state.length
    try:
        return c.FORCE.checked(force / scale)
    except ControlError:
        low, high = (engineering(end * scale, "N", 3) for end in (c.FORCE.low, c.FORCE.high))
        raise ControlError(
            f"the load {text.strip()[:40]} is F̄ = {force / scale:.3g}; give one from {low} to "
            f"{high}, which is F̄ {c.FORCE.range}",
            c.FORCE.key,
        ) from None


def _theories(text: str) -> tuple[str, ...]:
    names = tuple(name for name in text.split(",") if name)
    return tuple(c.THEORIES.read(name) for name in names)
