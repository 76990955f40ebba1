"""Heat through the solid contact."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from roughline.computing.arrays import Real
from roughline.engineering.conduction import (
    contact_conduction,
    interface_conduction,
    spreading,
    through_layers,
)
from roughline.engineering.formulas import (
    harmonic_conductivity,
    mikic_conductance,
    thermal_conductance,
    yovanovich_conductance,
)
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

_rule = partial(Rule, group="thermal")

_IN_VACUUM = "solid spots alone, as in vacuum: gas in the gap adds to it"
_INTERFACE_VALIDITY = f"{_IN_VACUUM}. Without the bodies' constriction to A_0, like k_i"


def _lacking(pair: MaterialPair, _frequency: float | None) -> Fact | None:
    return pair.lacks("conductivity", "thermal conductance")


def _conductance(stiffness: Real | None, pressed: Pressed) -> Real | None:
    conductivities = pressed.pair.at_surfaces("conductivity")
    if conductivities is None or stiffness is None:
        return None
    return thermal_conductance(stiffness, pressed.pair.E_star, conductivities)


def conductance_of_interface(pressed: Pressed) -> Real | None:
    """Conductance per area of the solid spots, in rows. [W / (m² K)]"""
    stiffness = interface_conduction(pressed, "conductivity")
    return None if stiffness is None else _conductance(stiffness / pressed.nominal_area, pressed)


def _which_interface(pressed: Pressed) -> Mapping[str, str]:
    validity = f"{_INTERFACE_VALIDITY}{pressed.interface_note}"
    return through_layers(validity, pressed) or {"validity": validity}


def _estimated(pair: MaterialPair, _frequency: float | None) -> Fact | None:
    return Fact("no_estimates_of_layers") if pair.coated else None


def _without_gas(pressed: Pressed) -> Fact | None:
    """Say what is left out, unless a gas of known conductivity is asked for."""
    sealing = pressed.sealing
    return None if sealing is not None and sealing.conductivity else Fact("as_in_vacuum")


def _shape(pressed: Pressed) -> tuple[float, float, tuple[float, float]] | None:
    """Rms height, rms slope and conductivities, where estimates of the literature have all."""
    conductivities = pressed.pair.both("conductivity")
    if conductivities is None or not pressed.rms_height or not pressed.rms_slope:
        return None
    return pressed.rms_height, pressed.rms_slope, conductivities


def _mikic(pressed: Pressed) -> Real | None:
    if (shape := _shape(pressed)) is None:
        return None
    return mikic_conductance(pressed.pressure, pressed.pair.E_star, *shape)


def _plastic(pressed: Pressed) -> Real | None:
    shape, hardness = _shape(pressed), pressed.pair.hardness
    if shape is None or hardness is None:
        return None
    found = yovanovich_conductance(pressed.pressure, hardness, *shape)
    return pressed.by_hardness_alone(found)


def _conductivities(pressed: Pressed) -> list[Symbol]:
    values = pressed.pair.at_surfaces("conductivity")
    mean = values and harmonic_conductivity(values)
    return [
        Symbol("kappa_s", "harmonic mean of both thermal conductivities", "W/(m K)", mean),
        *both_bodies("kappa", "thermal conductivity", "W/(m K)", values),
    ]


def _heights(pressed: Pressed) -> list[Symbol]:
    return [
        Symbol("m", "mean slope of a profile, the rms slope over sqrt(pi)"),
        Symbol("sigma", "rms height", "m", pressed.rms_height),
    ]


THERMAL = (
    _rule(
        key="thermal_conductance",
        name="thermal conductance in vacuum",
        symbol="G",
        unit="W/K",
        is_shown_at_many_loads=True,
        formula="kappa_s k_u / E*, kappa_s = 2 kappa1 kappa2 / (kappa1 + kappa2)",
        symbols=lambda pressed: [*_conductivities(pressed), contact_modulus(pressed)],
        validity=f"{_IN_VACUUM}. k_u, as heat spreads from the contact spots however they were "
        "formed",
        source="Barber 2003",
        value=lambda pressed: _conductance(contact_conduction(pressed, "conductivity"), pressed),
        differing=partial(through_layers, _IN_VACUUM),
        lacking=_lacking,
        measures=lambda pair, _fluid: spreading(pair, "conductivity"),
        is_extensive=True,
        may_be_infinite=True,
    ),
    _rule(
        key="thermal_conductance_per_area",
        name="thermal conductance per area in vacuum",
        symbol="h_c",
        unit="W/(m² K)",
        formula="kappa_s k_i / (E* A_0)",
        symbols=lambda pressed: [
            *_conductivities(pressed),
            contact_modulus(pressed),
            nominal_area(pressed),
        ],
        validity=_INTERFACE_VALIDITY,
        source="Barber 2003",
        value=conductance_of_interface,
        differing=_which_interface,
        lacking=_lacking,
        facts=_without_gas,
        leads=always,
        may_be_infinite=True,
    ),
    _rule(
        key="mikic_conductance",
        name="Mikic's elastic estimate",
        symbol="h_Mikic",
        unit="W/(m² K)",
        formula="1.55 kappa_s m/sigma (sqrt(2) p/(E* m))^0.94",
        symbols=lambda pressed: [
            *_conductivities(pressed),
            *_heights(pressed),
            contact_modulus(pressed),
        ],
        validity=f"{_IN_VACUUM}. Gaussian heights, light loads, no large waves",
        source="Mikic 1974",
        value=_mikic,
        lacking=_estimated,
    ),
    _rule(
        key="plastic_conductance",
        name="plastic estimate",
        symbol="h_CMY",
        unit="W/(m² K)",
        formula="1.25 kappa_s m/sigma (p/H)^0.95",
        symbols=lambda pressed: [
            *_conductivities(pressed),
            *_heights(pressed),
            hardness(pressed),
        ],
        validity=f"{_IN_VACUUM}. Gaussian heights, all contact plastic",
        source="Yovanovich 2005",
        value=_plastic,
        lacking=_estimated,
    ),
)
"""Answers about heat, in their order."""
