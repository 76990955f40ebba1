"""What is to be said beside the numbers: of the topographies, the loads, and what is not known."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from roughline.assessment.nominal import nominal_area
from roughline.assessment.question import Question
from roughline.topography.body import Body, Surface
from roughline.units import engineering


def of_each(bodies: Sequence[Body], say: Callable[[Body], list[str]]) -> list[str]:
    """Say something of each topography, and of which of two it is."""
    if len(bodies) == 1:
        return say(bodies[0])
    return [
        f"{which} body: {note}"
        for which, body in zip(("first", "second"), bodies, strict=True)
        for note in say(body)
    ]


def filled_points_and_spikes(body: Body) -> list[str]:
    """Say what was filled, and what spikes there are."""
    notes = []
    if body.settings.get("missing_points"):
        count, share = body.settings["missing_points"], float(body.settings["missing_share"])
        notes.append(f"{count} missing points ({share:.2%}) filled: {body.settings['filled']}")
    if body.settings.get("outliers_kept"):
        notes.append(
            f"{body.settings['outliers_kept']} spikes kept; the highest point decides where touch "
            "is, so see whether they are real, or remove them"
        )
    if body.settings.get("outliers_removed"):
        notes.append(f"{body.settings['outliers_removed']} spikes removed and filled")
    return notes


def meaning_of_loads(question: Question, body: Body) -> list[str]:
    """Say of each load what it is in all, and over which area."""
    area = nominal_area(body)
    if isinstance(body, Surface):
        nominal = f"the nominal area, {' x '.join(engineering(s, 'm') for s in body.sizes)}"
    else:
        nominal = f"the square of the line's length, {engineering(body.length, 'm')}"
    forces = question.forces(area)
    return [
        f"load {text}: {engineering(force, 'N')} in all, "
        f"{engineering(force / area, 'Pa')} over {nominal}"
        for text, force in zip(question.headings[: len(forces)], forces, strict=True)
    ]


def cropping_and_resampling(body: Body) -> list[str]:
    """Say what was cropped and resampled when two surfaces were laid together."""
    if not isinstance(body, Surface):
        return []
    notes = []
    for name in ("first", "second"):
        if f"{name}_cropped_to" in body.settings:
            sizes = " x ".join(engineering(size, "m") for size in body.sizes)
            notes.append(
                f"{name} body: cropped to what both have in common, {sizes}, from x = y = 0"
            )
    if "second_resampled_to" in body.settings:
        pixel = " x ".join(engineering(size, "m") for size in body.spacing)
        notes.append(f"second body: resampled by cubic splines to pixels of {pixel}, the first's")
    return notes
