"""Ultrasound at the interface."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from roughline.computing.arrays import Real
from roughline.engineering.formulas import reflection
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Limits, Rule, always
from roughline.engineering.symbols import Symbol, both_bodies, nominal_area
from roughline.facts.fact import Fact


def _lacking(pair: MaterialPair, frequency: float | None) -> Fact | None:
    if frequency is None:
        return None
    if pair.coated:
        return Fact("no_reflection_of_layers")
    if not (pair.first.surface.carries_sound and pair.second.surface.carries_sound):
        return Fact("no_reflection_without_sound")
    return pair.lacks("density", "reflection")


def _reflection(pressed: Pressed) -> Real | None:
    impedances = pressed.pair.both("impedance")
    if pressed.frequency is None or impedances is None:
        return None
    per_area = pressed.interface_stiffness / pressed.nominal_area
    return reflection(per_area, pressed.frequency, impedances)


def _wave_texts(pressed: Pressed) -> Mapping[str, str]:
    if pressed.frequency is None:
        return {}
    return {
        "name": f"{_REFLECTION.name} at {pressed.frequency / 1e6:g} MHz",
        "validity": _REFLECTION.validity + pressed.interface_note,
    }


def _limits(pressed: Pressed) -> Limits:
    """Welded bodies reflect the least."""
    impedances = pressed.pair.both("impedance")
    if impedances is None:
        return 0.0, np.inf
    first, second = impedances
    return abs(first - second) / (first + second), 1.0


def _symbols(pressed: Pressed) -> list[Symbol]:
    return [
        *both_bodies("z", "acoustic impedance", "Pa s/m", pressed.pair.both("impedance")),
        Symbol("i", "imaginary unit"),
        Symbol("omega", "angular frequency of the wave", "1/s"),
        Symbol("K", "stiffness per area of the interface", "N/m³"),
        nominal_area(pressed),
    ]


_REFLECTION = Rule(
    key="reflection",
    name="reflection",
    symbol="|r|",
    unit="1",
    group="acoustic",
    answers_question=always,
    formula="|z1 - z2 + i omega z1 z2 / K| / |z1 + z2 + i omega z1 z2 / K|, K = k_i / A_0",
    symbols=_symbols,
    validity="longitudinal plane waves much longer than the distances between contact spots; k_u, "
    "as their amplitude is small, so that all of the contact springs back",
    source="Tattersall 1973",
    value=_reflection,
    differing=_wave_texts,
    lacking=_lacking,
    limits=_limits,
)
"""Share of an ultrasonic wave that the interface reflects."""

ACOUSTIC = (_REFLECTION,)
"""Answers about sound."""
