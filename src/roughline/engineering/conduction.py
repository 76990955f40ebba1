"""Electricity and heat through coated bodies, by the points that touch.

Of bodies of one material each, Barber's identity gives what they conduct from their stiffness.
Through layers a current spreads otherwise than a displacement does, and is solved on its own.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.conduction import Resistances, conductance
from roughline.contact.fields import Fields
from roughline.contact.measures import Measure
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import Pressed
from roughline.facts.fact import Fact

_NAMES = {"resistivity": "electrical_spreading", "conductivity": "thermal_spreading"}


def spreading(pair: MaterialPair, quantity: str) -> Sequence[Measure]:
    """What is measured of coated bodies of known resistivities or conductivities; else nothing.

    It is the conductance times the mean of both resistivities at the surfaces, a length, as k / E*
    is of bodies of one material.
    """
    layers = pair.resistances(quantity)
    return () if layers is None or not pair.coated else (_measure(_NAMES[quantity], layers),)


@functools.cache  # several answers ask for it
def _measure(name: str, layers: Resistances) -> Measure:
    meaning = "conductance of the touching points times the mean resistivity at the surfaces"
    return Measure(name, "", "length", meaning, partial(_spreading, layers))


def _spreading(layers: Resistances, fields: Fields) -> float:
    of_surfaces = sum(resistivity[0] for resistivity, _ in layers) / 2
    found = conductance(fields.contact, fields.sizes, layers, fields.is_periodic)
    return of_surfaces * found


def contact_conduction(pressed: Pressed, quantity: str) -> Real | None:
    """k_u, or the stiffness with which Barber's identity holds through layers, in rows. [N / m]

    Of a map that is pressed freely it is not known: through layers, the map repeated is measured.
    """
    if not pressed.pair.coated:
        return pressed.unloading
    is_of_map = pressed.is_repeated and pressed.interface is not None and pressed.joint is None
    return None if is_of_map else _measured(pressed, quantity, pressed.unloading)


def interface_conduction(pressed: Pressed, quantity: str) -> Real | None:
    """k_i, or the stiffness with which Barber's identity holds through layers, in rows. [N / m]

    Of a free piece it is not known through layers.
    """
    if not pressed.pair.coated:
        return pressed.interface_stiffness
    return (
        _measured(pressed, quantity, pressed.interface_stiffness) if pressed.is_repeated else None
    )


def _measured(pressed: Pressed, quantity: str, stiffness: Real) -> Real | None:
    """What was measured, as uncertain as a stiffness is: both are of the same points."""
    rows = pressed.measure(_NAMES[quantity])
    if rows is None:
        return None
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = stiffness / stiffness[0]
        return pressed.pair.E_star * pressed.scale * rows[0] * np.where(ratios > 0, ratios, 1.0)


def facts_on_currents(
    pair: MaterialPair, *, is_repeated: bool, is_piece: bool, is_joint: bool
) -> list[Fact]:
    """Say what is not known of currents through coated bodies, and what layers add to them.

    The body repeats or not; it is a piece that stands for no larger surface, or else the map of a
    larger one, maybe a joint.
    """
    flows = (("resistivity", "electricity", "Ω m²"), ("conductivity", "heat", "m² K/W"))
    added = tuple(
        Fact("added_by_layers", value=value, unit=unit, what=what)
        for quantity, what, unit in flows
        if (layers := pair.resistances(quantity))
        for value in [sum(rho * h for each in layers for rho, h in zip(*each, strict=False))]
    )
    found = []
    if added and not is_repeated:
        of_map = not (is_piece or is_joint)
        found.append(Fact("currents_of_map_repeated" if of_map else "currents_of_the_piece"))
    if added and (is_repeated or not is_piece):
        found.append(Fact("resistance_of_layers", added=added))
    return found


def through_layers(validity: str, pressed: Pressed) -> Mapping[str, str]:
    """Texts that differ where something flows through layers."""
    if not pressed.pair.coated:
        return {}
    formula = "currents from points at one potential, solved through the layers"
    return {"formula": formula, "validity": validity, "source": "Yovanovich et al. 1998"}
