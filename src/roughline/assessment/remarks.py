"""All warnings and notes of an assessment, the most serious first."""

from __future__ import annotations

from roughline.assessment import notes as say
from roughline.assessment.assessment import Assessment
from roughline.assessment.case import COARSENED_FROM
from roughline.assessment.question import Question
from roughline.errors.words import called
from roughline.spectra.moments import Moments
from roughline.topography.body import Line, Surface
from roughline.topography.effects import grave_effects
from roughline.topography.files.read import suspicions


def warnings_of(
    result: Assessment, spectrum: Moments | None, grid_error_was_tried: bool
) -> list[str]:
    """What is suspicious, where assumptions break, and why there is no interval."""
    # what a curve says of the borders is said below, as a warning or as a note
    of_borders, _ = say.borders_of_repeated(result.question, result.body)
    said_elsewhere = {of_borders, *grave_effects(result.body)}
    bodies, body, curve = [each.body for each in result.topographies], result.body, result.curve
    of_curve = [text for text in curve.warnings if text not in said_elsewhere]
    is_scan = isinstance(body, Line) and body.kind == "profile"
    warnings = [
        *(of_curve if is_scan else say.departures_in_words(result)),
        *say.of_each(bodies, suspicions),
        *say.of_each(bodies, grave_effects),
        *say.broken_assumptions(result, spectrum),
        *say.of_full_contact(result),
        *say.of_wide_interval(result),
        *say.how_far_a_line_serves(result, grave=True),
        *([] if is_scan else of_curve),
        *say.of_borders(result, grave=True),
    ]
    if isinstance(body, Surface) and curve.stiffness_error is None:
        warnings.append(_why_without_grid_error(result.question, body, grid_error_was_tried))
    return warnings


def notes_of(result: Assessment, of_filling: str) -> list[str]:
    """What is left out, what was filled, how the loads were meant, and what was cropped."""
    question, body, pair = result.question, result.body, result.question.pair
    bodies = [each.body for each in result.topographies]
    notes = say.of_yield(result)
    if pair is not None:
        notes += say.how_far_a_line_serves(result, grave=False)
        notes += dict.fromkeys(each.note for each in result.answers.values() if each.note)
        notes += say.of_unknown_hardness(pair)
        notes += result.left_out
        if result.curve.area_fraction is None:
            notes.append("no contact area: the reduced model of a line does not predict it")
    notes += say.of_each(bodies, say.filled_spikes_and_effects)
    notes += [of_filling] if of_filling else []
    notes += say.meaning_of_loads(question, body)
    return notes + say.of_borders(result, grave=False) + say.cropping_and_resampling(body)


def _why_without_grid_error(question: Question, body: Surface, tried: bool) -> str:
    """Say that values come without an interval, and why; `tried` if Ctrl-C stopped the estimate."""
    if tried:
        why = "interrupted before"
    elif question.grid_error is not None:
        why = "switched off"
    elif min(body.shape) < COARSENED_FROM:
        why = (
            f"fewer than {COARSENED_FROM} points a side; with {called('grid_error', True)} it "
            "is estimated nevertheless"
        )
    else:
        asked = called("grid_error", True)
        why = f"that takes about twice as long; with {asked} it is estimated"
    return f"grid error not estimated, so values come without intervals ({why})"
