"""Real contact area, the pressure on it, what of it yields, and the gap beside it."""

from __future__ import annotations

from functools import partial

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.measures import MEAN_GAP
from roughline.engineering.coated import Coated
from roughline.engineering.formulas import ELASTIC_UP_TO
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Limits, Rule, always
from roughline.engineering.symbols import hardness, nominal_area
from roughline.facts.fact import Fact

_rule = partial(Rule, group="contact")

_PRESSED = 0.25  # mean contact pressure over the softest modulus, as on slopes of twice as much


def _least_fraction(pressed: Pressed) -> Real | float:
    """No point bears more than the hardness; under a depth, the force itself depends on it."""
    if pressed.hardest is None or pressed.has_depths:
        return 0.0
    return pressed.pressure / pressed.hardest


def _area(pressed: Pressed) -> Real | None:
    share = pressed.area_fraction
    return None if share is None else share * pressed.nominal_area


def _pressure(pressed: Pressed) -> Real | None:
    """Mean pressure on the real contact area, in rows. [Pa]"""
    area = _area(pressed)
    if area is None:
        return None
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(pressed.force == 0, 0.0, pressed.force / area)


def _pressure_limits(pressed: Pressed) -> Limits:
    """Under forces, no less than where all of the area is in contact."""
    if pressed.hardest is None:
        return 0.0, np.inf
    return (0.0 if pressed.has_depths else pressed.pressure), pressed.hardest


def _over_hardness(pressed: Pressed) -> Real | None:
    pressure = _pressure(pressed)
    if pressure is None or pressed.hardness is None:
        return None
    return pressure / pressed.hardness


def _elastic_limit(pressed: Pressed) -> Fact | None:
    """Say where the elastic assumption breaks."""
    ratio = _over_hardness(pressed)
    if pressed.may_yield or ratio is None or not np.isfinite(ratio[0]).any():
        return None
    worst, limit = float(np.nanmax(ratio[0])), ELASTIC_UP_TO
    return Fact("beyond_elastic", ratio=worst, limit=limit) if worst > limit else None


def _strained_layers(pressed: Pressed) -> Fact | None:
    """Say how far spots strain soft layers beyond what is linear elastic."""
    pressure = _pressure(pressed)
    if pressure is None or not pressed.pair.coated:
        return None
    ratio = float(np.nanmax(pressure[0], initial=0.0)) / pressed.curve.half_space.softest
    return Fact("layers_are_strained", ratio=ratio) if ratio > _PRESSED else None


def _through_the_layer(pressed: Pressed) -> Fact | None:
    """Say where a layer is indented deeper than it is thick."""
    softer, yielded = pressed.pair.softer, pressed.yielded
    if yielded is None or not isinstance(softer, Coated):
        return None
    (top, thickness), *_ = softer.layers
    deepest = float(np.nanmax(yielded.indentation, initial=0.0))
    if not deepest > thickness:
        return None
    return Fact("through_the_layer", material=top.name, thickness=thickness, deepest=deepest)


CONTACT = (
    _rule(
        key="contact_area",
        name="real contact area",
        symbol="A",
        unit="m²",
        formula="cells in contact, corrected for the outline's steps",
        validity="falls with every finer wave; the shortest wave of the grid is the finest here",
        source="Yastrebov, Anciaux and Molinari 2017",
        value=_area,
        limits=lambda pressed: (
            _least_fraction(pressed) * pressed.nominal_area,
            pressed.nominal_area,
        ),
        is_extensive=True,
    ),
    _rule(
        key="contact_area_fraction",
        name="contact area fraction",
        symbol="A/A_0",
        unit="1",
        formula="A / A_0",
        symbols=lambda pressed: [nominal_area(pressed)],
        value=lambda pressed: pressed.area_fraction,
        limits=lambda pressed: (_least_fraction(pressed), 1.0),
        leads=always,
        in_per_cent=True,
    ),
    _rule(
        key="contact_pressure",
        name="mean contact pressure",
        symbol="p_c",
        unit="Pa",
        formula="F / A",
        validity="at most the hardness of the softer body",
        value=_pressure,
        limits=_pressure_limits,
        facts=_strained_layers,
    ),
    _rule(
        key="contact_pressure_over_hardness",
        name="contact pressure over hardness",
        symbol="p_c/H",
        unit="1",
        formula="F / (A H), H of the softer body",
        symbols=lambda pressed: [hardness(pressed)],
        validity=f"elastic below {ELASTIC_UP_TO:g}, all of the contact yields at 1",
        value=_over_hardness,
        facts=_elastic_limit,
        limits=lambda pressed: (0.0, np.inf if pressed.hardest is None else 1.0),
    ),
    _rule(
        key="plastic_fraction",
        name="yielded share of the contact",
        symbol="A_p/A",
        unit="1",
        formula="cells at the hardness over cells in contact",
        validity="elastic, perfectly plastic: no hardening, no pile-up",
        source="Almqvist et al. 2007",
        value=lambda pressed: pressed.yielded.plastic_fraction if pressed.yielded else None,
        limits=lambda _pressed: (0.0, 1.0),
    ),
    _rule(
        key="indentation",
        name="largest permanent indentation",
        symbol="w",
        unit="m",
        formula="overlap at points at the hardness, which lowers the surface permanently",
        validity="at one point; the finest summits on the grid decide it",
        source="Almqvist et al. 2007",
        value=lambda pressed: pressed.yielded.indentation if pressed.yielded else None,
        facts=_through_the_layer,
    ),
    _rule(
        key="mean_gap",
        name="mean gap",
        symbol="u_m",
        unit="m",
        formula="volume between the bodies over A_0",
        symbols=lambda pressed: [nominal_area(pressed)],
        validity="of the map in a periodic half-space; waves longer than the map open it further",
        differing=lambda pressed: {"validity": str(pressed.place)} if pressed.place else {},
        value=lambda pressed: pressed.measure(MEAN_GAP.name),
        measures=[MEAN_GAP],
    ),
)
"""Answers about the contact itself, in their order."""
