"""Forces, depths and stiffnesses."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.effective_modulus import effective_modulus
from roughline.contact.measures import Measure
from roughline.engineering.formulas import electrical_resistance
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Rule
from roughline.engineering.symbols import (
    Symbol,
    both_bodies,
    contact_modulus,
    nominal_area,
    tangential_modulus,
)
from roughline.facts.fact import Fact
from roughline.units import engineering

_rule = partial(Rule, group="mechanics")

_IN_SERIES_MATTERS = 0.1  # of the interface's stiffness over that of what lies in series with it


def _joint_texts(**texts: str) -> Callable[[Pressed], Mapping[str, str]]:
    """Texts that differ where answers are those of a joint."""
    return lambda pressed: {} if pressed.joint is None else texts


def _contact_stiffness(pressed: Pressed) -> Real | None:
    """A joint has no outline of its own; what metals that yield give on loading is told as well."""
    return pressed.loading if pressed.joint is None or pressed.tells_unloading else None


def _map_formula(slope: str) -> str:
    return (
        f"{slope} of the map in a periodic half-space at the same mean pressure, times A_0 over "
        "the area of the map"
    )


def _under_unloading(pressed: Pressed) -> tuple[str, float]:
    """Points at the hardness bear no more on loading, and spring back like all others."""
    return ("unloading_stiffness" if pressed.joint is None else "interface_stiffness"), 1.0


def _per_area(pressed: Pressed) -> Real:
    """Of a joint, which is all interface, on unloading."""
    k = pressed.loading if pressed.joint is None else pressed.interface_stiffness
    return k / pressed.nominal_area


def _unloading(pressed: Pressed) -> Real | None:
    return pressed.unloading if pressed.tells_unloading and pressed.joint is None else None


def _which_interface(pressed: Pressed) -> Mapping[str, str]:
    """Where metals yield, that of a joint is the one on unloading, and says so."""
    if pressed.interface is None:
        return {}
    texts = {"validity": str(pressed.interface.place), "formula": pressed.interface.formula}
    if pressed.joint is not None:
        texts["formula"] = _map_formula("dF/dd on unloading")
        if pressed.tells_unloading:
            texts["name"] = f"{INTERFACE_STIFFNESS.name} on unloading"
    return texts


def _which_surface(pressed: Pressed) -> Fact | None:
    """Say which surface k_i belongs to, unless it is so near k_u that this does not matter."""
    if pressed.interface is None:
        return None
    with np.errstate(divide="ignore", invalid="ignore"):  # bodies apart, and full contact
        left = 1 - pressed.unloading[0] / pressed.interface_stiffness[0]
    if np.nanmax(left, initial=0.0) < pressed.interface.warned_from:
        return None
    place = pressed.interface.place
    return Fact("which_interface", fact=place).as_(place.weight)


def _meaning_of_joint(pressed: Pressed) -> Fact | None:
    """Say what a joint is taken to be, and what is left out of it; a warning where that matters."""
    if pressed.joint is None:
        return None
    disc = float(pressed.curve.half_space.disc_stiffness(math.sqrt(pressed.joint / math.pi)))
    share = float(np.nanmax(pressed.interface_stiffness[0], initial=0.0)) / disc
    resistivities = pressed.pair.both("resistivity")
    resistance = None
    if resistivities is not None:
        resistance = float(electrical_resistance(disc, pressed.curve.E_star, resistivities))
    matters = share > _IN_SERIES_MATTERS
    added = {"stiffness": disc, "resistance": resistance, "is_about": bool(pressed.pair.coated)}
    found = Fact("joint_alone", **added, share=share if matters else None)
    return found.as_("warning" if matters else "note")


def _layer_stiffness(pressed: Pressed) -> Real | None:
    """Stiffness of the layers of both bodies under even pressure; a piece alone holds it. [N/m]"""
    compliance = pressed.pair.layers_compliance
    if not pressed.is_repeated or not pressed.pair.coated:
        return None
    stiffness = pressed.nominal_area / compliance if compliance else np.inf
    return np.where(pressed.curve.converged, stiffness, np.nan)


def _beside_layers(pressed: Pressed) -> Fact | None:
    """Say that the interface does not hold what layers give way as a whole."""
    of_layers = _layer_stiffness(pressed)
    if of_layers is None:
        return None
    share = pressed.interface_stiffness[0] / of_layers
    matters = bool(np.nanmax(share, initial=0.0) > _IN_SERIES_MATTERS)
    if np.isinf(of_layers).any():
        found = Fact("layers_keep_their_volume")
    else:
        pressure = float(np.nanmax(pressed.load_pressure))  # a fluid compresses them as well
        spring = {"k_i": pressed.symbols["k_i"], "stiffness": float(np.nanmax(of_layers))}
        compressed = pressure * pressed.pair.layers_compliance
        found = Fact("layers_in_series", **spring, compressed=compressed, pressure=pressure)
    return found.as_("warning" if matters else "note")


def _energy_measures(pair: MaterialPair) -> Sequence[Measure]:
    """What is measured of coated bodies: which contact modulus their contact feels."""
    return [_effective_modulus(pair.E_star)] if pair.coated else []


@functools.cache
def _effective_modulus(E_star: float) -> Measure:
    meaning = "contact modulus of one material that stores as much energy"
    value = partial(effective_modulus, E_star=E_star)
    return Measure("effective_modulus", "E^*_e", "pressure", meaning, value)


def _between_moduli(pressed: Pressed) -> Mapping[str, str]:
    """From which modulus to which the effective one goes, and of which contact it is."""
    if not pressed.pair.coated:
        return {}
    top = engineering(pressed.pair.E_star, "Pa")
    base_modulus = pressed.pair.base_modulus
    base = engineering(base_modulus, "Pa") if np.isfinite(base_modulus) else "infinity"
    of_map = pressed.is_repeated and pressed.interface is not None
    place = "; of the map in a periodic half-space" if of_map else ""
    return {
        "validity": f"from {top}, that of what lies at the surfaces, in light contacts to {base}, "
        f"that of the bases, in contacts that are wide beside the layers{place}"
    }


def _contact_texts(pressed: Pressed) -> Mapping[str, str]:
    """What the contact is taken to be, and what k is called of a joint."""
    validity = f"without friction; bodies are {pressed.curve.assumption}"
    if pressed.joint is None:
        return {"validity": validity}
    return {
        "name": "interface stiffness on further loading",
        "symbol": "k_load",  # k is a free body's
        "formula": _map_formula("dF/dd on further loading"),
        "validity": f"of the interface alone; {validity}",
    }


_PUNCH_STIFFNESS = Symbol("k_s", "stiffness of a flat punch of the same outline", "N/m")


CONTACT_STIFFNESS = _rule(
    key="contact_stiffness",
    name="contact stiffness",
    symbol="k",
    unit="N/m",
    formula="dF/dd at frozen contact on further loading, exact",
    validity="without friction; what bodies are taken to be, their law says",
    value=_contact_stiffness,
    differing=_contact_texts,
    under=_under_unloading,
    leads=lambda pressed: pressed.joint is None,
    is_extensive=True,
    may_be_infinite=True,
)

UNLOADING_STIFFNESS = _rule(
    key="unloading_stiffness",
    name="unloading stiffness",
    symbol="k_u",
    unit="N/m",
    formula="dF/dd at frozen contact on unloading, exact",
    validity="all of the contact springs back; this stiffness governs vibration, ultrasound "
    "and currents",
    source="Almqvist et al. 2007",
    value=_unloading,
    leads=lambda pressed: pressed.yields,
    is_extensive=True,
    may_be_infinite=True,
)

INTERFACE_STIFFNESS = _rule(
    key="interface_stiffness",
    name="interface stiffness",
    symbol="k_i",
    unit="N/m",
    formula="1/k_i = 1/k_u - 1/k_s, on unloading; k_s of the flat punch",
    symbols=lambda _pressed: [_PUNCH_STIFFNESS],
    value=lambda pressed: None if pressed.interface is None else pressed.interface_stiffness,
    differing=_which_interface,
    facts=_which_surface,
    leads=lambda pressed: pressed.joint is not None,
    is_extensive=True,
    may_be_infinite=True,
)

MECHANICAL = (
    _rule(
        key="normal_force",
        name="normal force",
        symbol="F",
        unit="N",
        formula="given, or F(d)",
        value=lambda pressed: pressed.load,
        is_extensive=True,
        is_given=True,
    ),
    _rule(
        key="mean_pressure",
        name="mean pressure",
        symbol="p",
        unit="Pa",
        formula="F / A_0, A_0 the nominal area",
        symbols=lambda pressed: [nominal_area(pressed)],
        value=lambda pressed: pressed.load_pressure,
        differing=_joint_texts(formula="F / A_0, A_0 the nominal area of the joint"),
        is_given=True,
    ),
    _rule(
        key="depth",
        name="approach since touch",
        symbol="d",
        unit="m",
        formula="of remote points",
        value=lambda pressed: pressed.curve.depth,
        differing=_joint_texts(
            validity="of the map, from the touch of its highest point; the joint has higher points"
        ),
        is_given=True,
    ),
    INTERFACE_STIFFNESS,
    CONTACT_STIFFNESS,
    UNLOADING_STIFFNESS,
    _rule(
        key="effective_modulus",
        name="contact modulus that is felt",
        symbol="E*_e",
        unit="Pa",
        formula="E* U_t/U",
        symbols=lambda pressed: [
            contact_modulus(pressed),
            Symbol("U", "elastic energy under the pressures of the contact", "J"),
            Symbol("U_t", "that of the same pressures on the materials at the surfaces", "J"),
        ],
        value=lambda pressed: pressed.measure("effective_modulus"),
        differing=_between_moduli,
        leads=lambda pressed: bool(pressed.pair.coated),
        measures=lambda pair, _fluid: _energy_measures(pair),
    ),
    _rule(
        key="layer_stiffness",
        name="stiffness of the layers",
        symbol="k_l",
        unit="N/m",
        formula="A_0 / sum(t / E_c) over the layers",
        symbols=lambda pressed: [
            nominal_area(pressed),
            Symbol("t", "thickness of a layer", "m"),
            Symbol(
                "E_c", "E (1 - nu) / ((1 + nu) (1 - 2 nu)) of a layer, which cannot widen", "Pa"
            ),
        ],
        validity="in series with k_i: 1/k_i + 1/k_l is the compliance of both. Of layers much "
        "wider than they are thick, under even pressure; the constriction of bodies to a joint, "
        "where that is added, holds it already",
        source="Johnson 1985",
        value=_layer_stiffness,
        facts=_beside_layers,
        is_extensive=True,
        is_given=True,
        may_be_infinite=True,
    ),
    _rule(
        key="stiffness_per_area",
        name="stiffness per area",
        symbol="k/A_0",
        unit="N/m³",
        formula="k / A_0",
        symbols=lambda pressed: [nominal_area(pressed)],
        value=_per_area,
        differing=_joint_texts(symbol="k_i/A_0", formula="k_i / A_0"),
        under=lambda pressed: (_under_unloading(pressed)[0], 1 / pressed.nominal_area),
        facts=_meaning_of_joint,
        may_be_infinite=True,
    ),
    _rule(
        key="tangential_stiffness",
        name="tangential stiffness",
        symbol="k_t",
        unit="N/m",
        is_shown_at_many_loads=True,
        formula="k_u G*/E*, 1/G* = (2 - nu1)/(4 G1) + (2 - nu2)/(4 G2)",
        symbols=lambda pressed: [
            tangential_modulus(pressed),
            contact_modulus(pressed),
            *both_bodies("nu", "Poisson's ratio", "1", pressed.pair.both("nu")),
            *both_bodies("G", "shear modulus", "Pa", pressed.pair.both("shear_modulus")),
        ],
        validity="before any slip; normal and tangential problems uncoupled; k_u, as a small shear "
        "causes no yield",
        source="Popov 2017, ch. 8",
        value=lambda pressed: pressed.pair.G_star / pressed.pair.E_star * pressed.unloading,
        lacking=lambda pair, _frequency: Fact("no_ratio_of_layers") if pair.coated else None,
        is_extensive=True,
        may_be_infinite=True,
    ),
)
"""Answers about forces, depths and stiffnesses, in their order."""
