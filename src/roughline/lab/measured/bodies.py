"""What two materials and loads mean, before anything is pressed."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from roughline.assessment.loads import Hardness, hardness_of
from roughline.assessment.notes import meaning_of_loads, of_unknown_hardness
from roughline.assessment.question import DEFAULT_LOADS, Question
from roughline.assessment.reading import Reading
from roughline.engineering.rules import rules
from roughline.errors.words import speaking
from roughline.lab.controls import STRANGE, ControlError
from roughline.lab.frames import frame
from roughline.lab.measured.state import CONTROLS, Said, Source, at, question_of, used_in
from roughline.lab.server.tasks import Arguments, Progress
from roughline.report.contact_tables import solid_in_words
from roughline.topography.body import Body, Line, Surface
from roughline.units import engineering


@speaking(CONTROLS)
def bodies(arguments: Arguments, progress: Progress) -> bytes:
    """E* of the bodies, and what each load is in all on the `sides` of the prepared body. [m]

    All controls are read, so that each is refused when it is set, and not when the body is pressed.
    """
    body = _flat(arguments.get("sides"))

    def read(said: Said) -> Question:
        question = question_of(said, Source(Path("no file yet"), "", ""))
        with at("joint_area" if "joint_area" in said else ""):
            return question if body is None else replace(question, body=body, reading=Reading())

    question, refused = used_in(arguments, read)
    loads = question.loads
    of = ", of what lies at the surfaces" if question.coated else ""
    rows = [["contact modulus E*", engineering(question.modulus, "Pa") + of]]
    pair = question.pair
    if pair is not None:
        rows += [
            ["rough body", solid_in_words(pair.first)],
            ["smooth body", solid_in_words(pair.second)],
        ]
        notes = [
            *of_unknown_hardness(pair),
            *rules.left_out(pair, question.frequency_in_hertz),
        ]
    else:
        notes = ["a contact modulus alone gives the curve, and no answers for materials"]
    hardness = hardness_of(question)
    rows.append(["yield", _yield_in_words(question, hardness)])
    if not loads:
        notes.append(
            f"no load is given: {DEFAULT_LOADS} loads from first touch to saturation are taken"
        )
    meanings = meaning_of_loads(question, body) if body is not None and loads else []
    header = {
        "refused": refused,
        "rows": rows,
        "loads": list(meanings),
        "notes": notes,
    }
    return frame(header)


def _yield_in_words(question: Question, hardness: Hardness | None) -> str:
    """At which pressure the contact yields, and how well that is known."""
    if hardness is None:
        return "left out" if question.elastic else "no hardness is known: elastic"
    known = "as given" if hardness.factor == 1 else f"known to a factor of {hardness.factor:g}"
    return f"at {engineering(hardness.value, 'Pa')}, {known}"


def _flat(sides: Any) -> Body | None:
    """A flat body with the sides that the page was told; None before there is one."""
    if sides is None:
        return None
    if (
        not isinstance(sides, list)
        or len(sides) not in (1, 2)
        or not all(isinstance(side, float | int) and 0 < side < math.inf for side in sides)
    ):
        raise ControlError(STRANGE)
    if len(sides) == 1:
        return Line(np.zeros(2), sides[0], "m", kind="profile")
    return Surface(np.zeros((2, 2)), (sides[0], sides[1]), "m")
