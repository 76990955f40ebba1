"""The state of the view "Explore" is read from texts, and checked."""

from __future__ import annotations

import re
from dataclasses import fields, replace
from typing import Any

import roughline as rl
from roughline.errors.checks import shown
from roughline.lab.controls import (
    ControlError,
    Texts,
    has_unit,
    is_number,
    refuse_strange,
    rounded,
    sent_texts,
    usable,
)
from roughline.lab.explore import physics
from roughline.lab.explore.controls import CHOICES, NUMBERS, ScaledControl
from roughline.lab.explore.state import SURFACE_KEYS, ExploreState
from roughline.lab.server.tasks import Arguments
from roughline.units import engineering, in_si, load_in_newtons

_HURST = re.compile(r"\s*H\s*=(?P<hurst>.*)")
_SIDE_RANGE, _MODULUS_RANGE = (1e-12, 1e3), (1.0, 1e14)  # that are allowed [m], [Pa]


def usable_state(arguments: Arguments) -> tuple[ExploreState, dict[str, str]]:
    """The state that a page asks about, and what of its texts is not used, by control."""
    return usable(arguments, read_state, ExploreState.texts)


def state_in(arguments: Arguments) -> ExploreState:
    """The state that a page asks about, all of whose texts can be used."""
    return read_state(sent_texts(arguments))


def read_state(texts: Texts) -> ExploreState:
    """Read the parameters of an address, or the texts of the controls.

    Those that are missing have their defaults.

    Raises
    ------
    ControlError
        If the version is another, or a text cannot be used; it says at which control.
    """
    known = {each.name for each in fields(ExploreState)} - {"added", "typed_texts"}
    refuse_strange(
        texts, {*known, *(each.key for each in physics.PHYSICS), *physics.numbers(), "H"}
    )
    state = ExploreState(
        D_f=_dimension(texts.get("D_f"), texts.get("H")),
        rms=CHOICES["rms"].read_in(texts),
        slope=NUMBERS["slope"].read_in(texts),
        seed=int(NUMBERS["seed"].read_in(texts)),
        n=int(CHOICES["n"].read_in(texts)),
        boundary=CHOICES["boundary"].read_in(texts),
        shown=physics.second_map_choice().read_in(texts),
        L=_quantity(texts.get("L", ExploreState.L), "m", "L", "side of the surface", _SIDE_RANGE),
        E=_quantity(texts.get("E", ExploreState.E), "Pa", "E", "contact modulus", _MODULUS_RANGE),
        theories=_theories(texts.get("theories", "")),
    )
    lengths: dict[str, Any] = {
        control.key: control.read_over(texts.get(control.key, str(control.default)), state)
        for control in NUMBERS.values()
        if isinstance(control, ScaledControl)
    }
    state = replace(state, **lengths)
    _refuse_waves(state)
    added = (each for kind in physics.PHYSICS if (each := kind.read(texts, state)))
    state = replace(state, added=tuple(added))
    state = replace(state, F=_force_bar(texts.get("F", str(ExploreState.F)), state))
    _refuse_together(state)
    return replace(state, typed_texts=texts)


def _refuse_waves(state: ExploreState) -> None:
    """Refuse a cutoff or a grid that does not go with the roll-off."""
    if not state.cutoff < state.roll_off:
        raise ControlError(
            f"the cutoff, {state.cutoff:.4g} sides, is not shorter than the roll-off, "
            f"{state.roll_off:.4g} sides: shorten it, or lengthen the roll-off",
            "cutoff",
            "roll_off",
        )
    if 2 / state.n >= state.roll_off:
        raise ControlError(
            f"{state.n} points carry no waves shorter than the roll-off, {state.roll_off:.4g} "
            "sides: take more points, or a longer roll-off",
            "n",
            "roll_off",
        )


def _refuse_together(state: ExploreState) -> None:
    """Refuse physics that do not go with each other, with the grid or with the load."""
    keys = [each.key for each in state.added]
    for each in state.added:
        for other, why in each.excludes.items():
            if other in keys:
                raise ControlError(why, each.key, other)
        each.check(state)
    most = state.most_force_bar
    if most <= state.F:
        raise ControlError(
            f"the surface bears less than its hardness everywhere, F̄ = {most:.3g}: give a smaller "
            "load, or a larger hardness",
            "F",
            *(key for each in state.added for key in each.numbers),
            *SURFACE_KEYS,
        )


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
