"""Bodies that rub: how far they are displaced tangentially before they slide."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from roughline.computing.arrays import Real
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Rule, always
from roughline.engineering.symbols import Symbol, contact_modulus, tangential_modulus
from roughline.units import engineering


def _until_sliding(pressed: Pressed) -> Real | None:
    """Displacement at which all of the contact slips, at the largest load. [m]"""
    slip = pressed.sought.slip
    if slip is None:
        return None
    return np.where(pressed.curve.converged, slip.displacement[-1], np.nan)


def _slip_texts(pressed: Pressed) -> Mapping[str, str]:
    """With which coefficient of friction bodies slip, and under which force they slide."""
    slip = pressed.sought.slip
    if slip is None:
        return {}
    force = engineering(float(slip.force[-1]), "N")
    friction = f"coefficient of friction {slip.friction:g}, sliding from {force} on"
    return {"validity": f"{friction}; {_SLIP.validity}"}


def _symbols(pressed: Pressed) -> list[Symbol]:
    slip = pressed.sought.slip
    return [
        Symbol("mu", "coefficient of friction", "1", None if slip is None else slip.friction),
        contact_modulus(pressed),
        tangential_modulus(pressed),
    ]


_SLIP = Rule(
    key="slip_displacement",
    name="displacement before sliding",
    symbol="u_x",
    unit="m",
    group="friction",
    formula="mu (E*/G*) d, d the approach that unloading takes back",
    symbols=_symbols,
    validity="under the largest load, kept while the tangential force grows; normal and tangential "
    "problems uncoupled",
    source="Ciavarella 1998",
    value=_until_sliding,
    differing=_slip_texts,
    answers_question=always,
    is_given=True,
)
"""Tangential displacement up to which a part of the contact sticks."""

FRICTION = (_SLIP,)
"""Answers about friction."""
