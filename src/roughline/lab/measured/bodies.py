"""What two materials and loads mean, before anything is pressed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from roughline.assessment.notes import meaning_of_loads
from roughline.assessment.question import DEFAULT_LOADS, Question
from roughline.engineering.limits import left_out
from roughline.engineering.pair import MaterialPair
from roughline.lab.controls import ControlError
from roughline.lab.frames import frame
from roughline.lab.measured.state import Arguments, at, bodies_of, loads_of, said_of
from roughline.report.contact_tables import material_in_words
from roughline.server.tasks import Progress
from roughline.topography.body import Body, Line, Surface
from roughline.units import engineering, in_si


def bodies(arguments: Arguments, progress: Progress) -> bytes:
    """E* of the bodies, and what each load is in all on the `sides` of the prepared body. [m]"""
    said = said_of(arguments)
    given = bodies_of(said)
    rows, notes = [], []
    if "materials" in given:
        pair = MaterialPair(*given["materials"])
        modulus = pair.E_star
        rows = [
            ["rough body", material_in_words(pair.first)],
            ["smooth body", material_in_words(pair.second)],
        ]
        with at("frequency"):
            frequency = in_si(said["frequency"], "Hz", "frequency") if "frequency" in said else None
        notes = left_out(pair, frequency)
    else:
        modulus = given["E_star"]
        notes = ["a contact modulus alone gives the curve, and no answers for materials"]
    loads = loads_of(said)
    if not loads:
        notes.append(
            f"no load is given: {DEFAULT_LOADS} loads from first touch to saturation are taken"
        )
    body = _flat(arguments.get("sides"))
    meanings = []
    if body is not None and loads:
        meanings = meaning_of_loads(Question(body, E_star=modulus, loads=loads), body)
    contact_modulus = ["contact modulus E*", engineering(modulus, "Pa")]
    return frame({"rows": [contact_modulus, *rows], "loads": meanings, "notes": notes})


def _flat(sides: Any) -> Body | None:
    """A flat body with the sides that the page was told; None before there is one."""
    if sides is None:
        return None
    if (
        not isinstance(sides, list)
        or len(sides) not in (1, 2)
        or not all(isinstance(side, float | int) and 0 < side < math.inf for side in sides)
    ):
        raise ControlError("this question is none of the lab's: reload the page")
    if len(sides) == 1:
        return Line(np.zeros(2), sides[0], "m", kind="profile")
    return Surface(np.zeros((2, 2)), (sides[0], sides[1]), "m")
