"""Resistance of the contact to an electric current."""

from __future__ import annotations

from functools import partial

import numpy as np

from roughline.computing.arrays import Real
from roughline.engineering.conduction import contact_conduction, spreading, through_layers
from roughline.engineering.formulas import electrical_resistance, holm_resistance
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Rule, always
from roughline.engineering.symbols import (
    Symbol,
    both_bodies,
    contact_modulus,
    hardness,
    nominal_area,
)
from roughline.facts.fact import Fact

_rule = partial(Rule, group="electrical")


def _lacking(pair: MaterialPair, _frequency: float | None) -> Fact | None:
    return pair.lacks("resistivity", "constriction resistance")


def _resistance(pressed: Pressed) -> Real | None:
    resistivities = pressed.pair.at_surfaces("resistivity")
    stiffness = contact_conduction(pressed, "resistivity")
    if resistivities is None or stiffness is None:
        return None
    with np.errstate(divide="ignore"):
        return electrical_resistance(stiffness, pressed.pair.E_star, resistivities)


def _specific_resistance(pressed: Pressed) -> Real | None:
    resistance = _resistance(pressed)
    return None if resistance is None or pressed.joint is None else resistance * pressed.joint


def _single_spot(pressed: Pressed) -> Real | None:
    resistivities, hardness = pressed.pair.both("resistivity"), pressed.pair.hardness
    if resistivities is None or hardness is None:
        return None
    with np.errstate(divide="ignore"):
        found = holm_resistance(pressed.force, hardness, resistivities)
    return pressed.by_hardness_alone(found)


def _resistivities(pressed: Pressed) -> list[Symbol]:
    values = pressed.pair.at_surfaces("resistivity")
    return both_bodies("rho", "electrical resistivity", "Ω m", values)


ELECTRICAL = (
    _rule(
        key="constriction_resistance",
        name="constriction resistance",
        symbol="R",
        unit="ohm",
        formula="E* (rho1 + rho2) / (2 k_u)",
        symbols=lambda pressed: [contact_modulus(pressed), *_resistivities(pressed)],
        validity="clean metal; films add to it. k_u, as current spreads from the contact spots "
        "like the displacement on unloading, however the spots were formed",
        source="Barber 2003",
        value=_resistance,
        differing=partial(through_layers, "clean metal; films add to it"),
        lacking=_lacking,
        measures=lambda pair, _fluid: spreading(pair, "resistivity"),
        leads=always,
        is_extensive=True,
        may_be_infinite=True,
    ),
    _rule(
        key="specific_contact_resistance",
        name="specific contact resistance",
        symbol="rho_c",
        unit="ohm m²",
        formula="R A_0, A_0 the nominal area of the joint",
        symbols=lambda pressed: [nominal_area(pressed)],
        validity="of the interface alone; clean metal",
        source="Barber 2003",
        value=_specific_resistance,
        leads=always,
        may_be_infinite=True,
    ),
    _rule(
        key="holm_resistance",
        name="Holm's single-spot estimate",
        symbol="R_Holm",
        unit="ohm",
        formula="(rho1 + rho2) / (4 a_H), pi a_H² = F / H",
        symbols=lambda pressed: [
            *_resistivities(pressed),
            Symbol("a_H", "radius of Holm's single spot", "m"),
            hardness(pressed),
        ],
        validity="for comparison: all of the load on one plastic spot; separate spots have less "
        "resistance, and elastic spots, which are smaller, have more",
        source="Holm 1967",
        value=_single_spot,
        lacking=lambda pair, _frequency: Fact("no_estimates_of_layers") if pair.coated else None,
        is_extensive=True,
        may_be_infinite=True,
    ),
)
"""Answers about currents, in their order."""
