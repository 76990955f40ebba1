"""The answers for a page: its question assessed once and kept, in tables, maps and curves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.assessment.assess import assess_body
from roughline.assessment.assessment import Assessment
from roughline.lab.frames import frame
from roughline.lab.measured.kept import kept
from roughline.lab.measured.pictures import contact_drawing, curve_drawing
from roughline.lab.measured.state import Arguments, at, question_of, said_of, source_of
from roughline.lab.measured.words import in_controls
from roughline.report.contact_tables import (
    UNRESOLVED,
    answer_table,
    curve_table,
    formula_table,
    star_is_shown,
)
from roughline.server.tasks import Progress
from roughline.topography.body import Surface
from roughline.units import engineering


def answer(arguments: Arguments, progress: Progress) -> bytes:
    """Assess the question of the page; the result is kept for the report."""
    result = assessed(arguments, progress)
    arrays: dict[str, NDArray[Any]] = {}
    contact = None
    if isinstance(result.body, Surface):
        drawing = contact_drawing(result)
        contact, arrays = drawing.header, drawing.arrays
    question = result.question
    header = {
        "modulus": _modulus(result),
        "answers": answer_table(result, slice(None)) if result.answers else None,
        "formulas": formula_table(result) if result.answers else None,
        "curve": curve_table(result),
        "star": f"* {UNRESOLVED}" if star_is_shown(result) else "",
        "remarks": [in_controls(each) for each in result.remarks],
        "theories": [f"{each.name}: {each.validity}" for each in result.theories],
        "plot": curve_drawing(result),
        "contact": contact,
        "slip": _slip(result),
        "can_report": question.pair is not None and bool(question.loads),
    }
    return frame(header, arrays)


def assessed(arguments: Arguments, progress: Progress) -> Assessment:
    """The assessment of the page's question: as it was kept, or else solved."""
    said = said_of(arguments)
    source = source_of(said, arguments["session"])
    question = question_of(said, source)

    def solve() -> Assessment:
        with at("answers"):
            return assess_body(question, progress=Steps(arguments, progress))

    return kept(arguments["session"], "assessment", sorted(said.items()), solve)


class Steps:
    """Steps over all the times that a body is pressed, of which each counts its own loads.

    Parameters
    ----------
    arguments : mapping
        Of the task; "presses" says how often the body is pressed.
    progress : callable
        Told (steps done, steps in all).
    """

    def __init__(self, arguments: Mapping[str, Any], progress: Progress) -> None:
        given = arguments.get("presses")
        self._presses = given if isinstance(given, int) and 1 <= given <= 8 else 1
        self._before, self._last, self._progress = 0, 0, progress

    def __call__(self, done: int, total: int) -> None:
        """Tell of the loads of one pressing."""
        if done < self._last:
            self._before += 1
        self._last = done
        presses = max(self._presses, self._before + 1)
        self._progress(self._before * total + done, presses * total)


def _modulus(result: Assessment) -> str:
    pair = result.question.pair
    of = f" of {pair.first.name} and {pair.second.name}" if pair else ""
    return f"E*{of} = {engineering(result.curve.E_star, 'Pa')}"


def _slip(result: Assessment) -> dict[str, Any] | None:
    slip = result.partial_slip
    if slip is None:
        return None
    shown = np.unique(np.linspace(0, slip.force.size - 1, 12).astype(int))
    return {
        "friction": slip.friction,
        "rows": [
            [engineering(float(slip.displacement[i]), "m"), engineering(float(slip.force[i]), "N")]
            for i in shown
        ],
    }
