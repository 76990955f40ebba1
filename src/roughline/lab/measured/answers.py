"""The answers for a page: its question assessed once and kept, and both models compared."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.assessment.assess import assess_body
from roughline.assessment.assess_part import assess_part
from roughline.assessment.assessment import Assessment
from roughline.assessment.comparison import compare_models
from roughline.assessment.part import PartAssessment
from roughline.assessment.question import Question
from roughline.errors.words import speaking
from roughline.lab.frames import frame
from roughline.lab.measured.kept import kept
from roughline.lab.measured.part import part_in_words
from roughline.lab.measured.pictures import contact_drawing, curve_drawing
from roughline.lab.measured.state import (
    CONTROLS,
    at,
    question_of,
    reading_of,
    said_of,
    source_of,
    sources_of,
)
from roughline.lab.server.tasks import Arguments, Progress
from roughline.report.answers import (
    IF_ELASTIC,
    UNRESOLVED,
    answer_table,
    counted,
    headline,
    lead_of,
    star_is_shown,
)
from roughline.report.comparison import comparison_table, verdict_in_words
from roughline.report.contact_tables import curve_table, formula_table, modulus_in_words
from roughline.topography.body import Surface
from roughline.units import engineering


@speaking(CONTROLS)
def answer(arguments: Arguments, progress: Progress) -> bytes:
    """Assess the question of the page; the result is kept for the report.

    Of several maps, `map` says by its number which of them is shown alone.
    """
    result = assessed(arguments, progress)
    if isinstance(result, Assessment):
        return _framed(result)
    wanted = arguments.get("map")
    is_there = isinstance(wanted, int) and 0 <= wanted < len(result.assessments)
    shown = int(wanted or 0) if is_there else 0
    of_part = part_in_words(result, arguments)
    return _framed(result.assessments[shown], part={**of_part, "shown": shown})


def _framed(result: Assessment, **others: Any) -> bytes:
    """The assessment of one body, as the page reads it."""
    arrays: dict[str, NDArray[Any]] = {}
    contact = None
    if isinstance(result.body, Surface):
        drawing = contact_drawing(result)
        contact, arrays = drawing.header, drawing.arrays
    header = {
        "modulus": modulus_in_words(result),
        "lead": lead_of(result),
        "figures": [vars(each) for each in headline(result).figures],
        "answers": answer_table(result, with_elastic=True) if result.answers else None,
        "groups": counted(result, with_elastic=True),
        "if_elastic": IF_ELASTIC,
        "formulas": formula_table(result) if result.answers else None,
        "curve": curve_table(result),
        "star": f"* {UNRESOLVED}" if star_is_shown(result) else "",
        "remarks": list(result.remarks),
        "theories": [f"{each.name}: {each.validity}" for each in result.theories],
        "plot": curve_drawing(result),
        "contact": contact,
        "slip": _slip(result),
        "can_report": result.question.pair is not None and bool(result.question.loads),
        **others,
    }
    return frame(header, arrays)


def assessed(arguments: Arguments, progress: Progress) -> Assessment | PartAssessment:
    """The assessment of the page's question: as it was kept, or else solved.

    Of several maps each is kept as soon as it is done.
    """
    said, session = said_of(arguments), arguments["session"]
    sources = sources_of(said, session)
    questions = [question_of(said, each) for each in sources]
    keys = {each.path: each.key for each in sources}
    steps = _Steps(progress)

    def solve(question: Question) -> Assessment:
        assert isinstance(question.body, Path)
        asked = sorted({**said, "file": keys[question.body]}.items())
        made = partial(assess_body, question, progress=steps)
        return kept(session, "assessment", asked, made, most=len(sources))

    with at("answers"):
        if len(sources) == 1:
            return solve(questions[0])
        # what cannot be asked of a part is refused here
        replace(questions[0], body=list(keys), reading=replace(questions[0].reading, name=None))
        names = [each.name for each in sources]
        return assess_part(questions, names=names, map_progress=steps.of_map, answer=solve)


class _Steps:
    """Steps over the loads of all maps."""

    def __init__(self, progress: Progress) -> None:
        self._progress, self._map, self._maps = progress, 0, 1

    def __call__(self, done: int, total: int) -> None:
        """Tell of the loads of one map."""
        self._progress(self._map * total + done, self._maps * total)

    def of_map(self, done: int, total: int) -> None:
        """Begin the next of several maps."""
        self._map, self._maps = done, total


@speaking(CONTROLS)
def compare(arguments: Arguments, progress: Progress) -> bytes:
    """Compare the models on the surface as the file has it, without its tilt."""
    said = said_of(arguments)
    source = source_of(said, arguments["session"])
    reading = reading_of(said, source.name)
    with at("compare"):
        found = kept(
            arguments["session"],
            "comparison",
            (source.key, reading),
            lambda: compare_models(source.path, reading=reading, progress=progress),
        )
    result = found.comparison
    header, rows = comparison_table(found)
    star = "" if result.resolved.all() else "* fewer than ten cells in contact: the grid decides"
    return frame(
        {
            "what": found.what,
            "verdict": verdict_in_words(found),
            "verdicts": [str(each) for each in found.verdicts],
            "table": [header, rows],
            "star": star,
            "notes": list(result.warnings),
            "force_bar": result.force_bar,
            "full": result.full.mean,
            "reduced": {
                "mean": result.reduced.mean,
                "low": result.reduced.low,
                "high": result.reduced.high,
            },
        }
    )


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
