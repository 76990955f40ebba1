"""Where the elastic answers end: summits that yield, and materials that lack a value."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from roughline.engineering import formulas
from roughline.engineering.answer import Answer
from roughline.engineering.pair import MaterialPair
from roughline.units import decimal


def elastic_warnings(answers: Mapping[str, Answer], plasticity: float | None) -> list[str]:
    """Say where the elastic assumption breaks.

    Parameters
    ----------
    answers : mapping of str to Answer
        By their keys, of one curve.
    plasticity : float or None
        Greenwood and Williamson's index.
    """
    warnings = []
    over_hardness = answers.get("contact_pressure_over_hardness")
    if over_hardness is not None and np.isfinite(over_hardness.values).any():
        worst = float(np.nanmax(over_hardness.values))
        if worst > formulas.ELASTIC_UP_TO:
            warnings.append(
                f"the mean contact pressure reaches {decimal(worst, 2)} times the softer body's "
                f"hardness; beyond {formulas.ELASTIC_UP_TO:g} of it summits yield, so these "
                "elastic answers do not hold: leave out elastic=True, or an infinite hardness="
            )
    if plasticity is not None and plasticity > 1:
        warnings.append(
            f"the plasticity index is {decimal(plasticity, 2)}, over 1: summits yield at first "
            "touch; under repeated loads they deform elastically about their flattened shape"
        )
    return warnings


def left_out(pair: MaterialPair, frequency: float | None) -> list[str]:
    """Say which answers :func:`answers` leaves out because a material lacks a value.

    Parameters
    ----------
    pair : MaterialPair
        The materials.
    frequency : float or None
        Of an ultrasonic wave, if its reflection is wanted. [Hz]
    """
    needed = {
        "resistivity": "no constriction resistance",
        "conductivity": "no thermal conductance",
    }
    notes = []
    if frequency is not None and not all(each.carries_sound for each in (pair.first, pair.second)):
        notes.append("no reflection: a rigid or an incompressible body carries no such wave")
    elif frequency is not None:
        needed["density"] = "no reflection"
    if (lacking := pair.lacking("hardness")) and pair.hardness is None:
        softer = ""
        if len(lacking) == 1 and not any(map(math.isinf, (pair.first.E, pair.second.E))):
            softer = ", and it is the softer one, as its modulus is below the other's hardness"
        notes.append(
            f"the hardness of {' and of '.join(lacking)} is not known{softer}, so both bodies are "
            'taken as elastic, whatever the pressure; give it with the material, as "hardness=..."'
        )
    elif lacking:
        notes.append(
            f"the hardness of {lacking[0]} is not known; that of the other is taken as the softer's"
        )
    for quantity, answer in needed.items():
        if lacking := pair.lacking(quantity):
            notes.append(
                f"{answer}: the {quantity} of {' and of '.join(lacking)} is not known; give it "
                f'with the material, as "{quantity}=..."'
            )
    return notes
