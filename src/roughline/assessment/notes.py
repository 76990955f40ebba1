"""What is to be said beside the numbers: of the topographies, the loads, and what is not known."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.given import is_force, several
from roughline.assessment.hardness import hardness_of
from roughline.assessment.nominal import nominal_area
from roughline.assessment.question import Question
from roughline.engineering.answer import Answer
from roughline.engineering.formulas import electrical_resistance
from roughline.engineering.intervals import Ends
from roughline.engineering.joint import constriction_of_disc
from roughline.topography.body import Body, Surface
from roughline.topography.repetition import border_jump
from roughline.units import decimal, engineering

_CONSTRICTION_MATTERS = 0.1  # of the interface's stiffness over that of the bodies around a joint
_MOVED = (  # by the scatter of hardness; keys of the answers of which it is told
    "contact_stiffness",
    "unloading_stiffness",
    "interface_stiffness",
    "contact_area",
    "constriction_resistance",
)
_BORDER_OUTWEIGHS = 0.5  # share of a repeated map's mean-square slope from which on it is warned


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
        sides = " x ".join(engineering(s, "m") for s in body.sizes)
        nominal = f"the nominal area, {sides}"
    else:
        nominal = f"the square of the line's length, {engineering(body.length, 'm')}"
    loads = question.headings[: len(several(question.loads))]  # unloading speaks for itself
    notes = []
    for text, force in dict(zip(loads, question.forces(area), strict=False)).items():
        pressure = engineering(force / area, "Pa")
        if question.joint is None:
            notes.append(
                f"load {text}: {engineering(force, 'N')} in all, {pressure} over {nominal}"
            )
        else:
            on_joint = engineering(force * question.scale(area), "N")
            joint = engineering(question.joint, "m²")
            notes.append(
                f"load {text}: {on_joint} on the joint of {joint}, {pressure} everywhere; "
                f"{engineering(force, 'N')} of it on the map, {sides}"
            )
    forced = any(map(is_force, several(question.loads)))
    if forced and question.joint is None and _is_map(body):
        notes.append(
            "forces act on the map alone, not on the part that it was cut out of; with the area of "
            "the joint (joint_area=) they act on that, and the answers are the joint's"
        )
    return notes


def of_joint_and_borders(result: Assessment, *, grave: bool) -> list[str]:
    """Say what a joint is taken to be, and how far a repeated map jumps; grave things or others."""
    said = [borders_of_repeated(result.question, result.body)]
    if result.question.joint is not None:
        said.append(meaning_of_joint(result.question, result.answers))
    return [text for text, is_grave in said if text and is_grave == grave]


def meaning_of_joint(question: Question, answers: Mapping[str, Answer]) -> tuple[str, bool]:
    """Say what a joint is taken to be, and what is left out of it.

    The second result says whether that is more than a tenth of the answers.
    """
    assert question.joint is not None
    assert question.pair is not None
    disc = constriction_of_disc(question.joint, question.modulus)
    stiffest = float(np.nanmax(answers["interface_stiffness"].values, initial=0.0))
    share = stiffest / disc
    resistivities = question.pair.both("resistivity")
    added = engineering(disc, "N/m")
    if resistivities is not None:
        resistance = electrical_resistance(disc, question.modulus, resistivities)
        added += f" and {engineering(resistance, 'ohm')}"
    text = (
        "answers are the joint's, which is taken to be alike everywhere and evenly loaded, and of "
        "its interface alone: bodies wider than the joint add its own constriction in series, "
        f"{added} for a disc as large"
    )
    if share <= _CONSTRICTION_MATTERS:
        return text, False
    return (
        f"{text}; the interface is up to {decimal(share, 2)} times as stiff as that, so such "
        "bodies decide as well, and load the joint's edge more than its middle"
    ), True


def borders_of_repeated(question: Question, body: Body) -> tuple[str, bool]:
    """Say how far a map jumps across its borders where it is repeated.

    The second result says whether that outweighs all other steps. Nothing is said of a surface
    that is no map: it may be meant to be repeated.
    """
    if not question.is_repeated or not isinstance(body, Surface) or not body.is_cut_out:
        return "", False
    found = border_jump(body if question.joint is None else body.detrended())
    text = (
        f"repeated, the map jumps by {engineering(found.jump, 'm', 3)} (rms) across its borders, "
        f"{decimal(found.jump / found.step, 2) if found.step else 'infinitely many'} times an "
        f"ordinary step between neighbouring points, {engineering(found.step, 'm', 3)}"
    )
    if found.share_of_slope <= _BORDER_OUTWEIGHS:
        return text, False
    return (
        f"{text}; {found.share_of_slope:.0%} of its mean-square slope lies there, so contact near "
        "the borders is that of a cliff which the part does not have: remove what is left of the "
        'form (trend="curvature"), or take a larger map'
    ), True


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


def _is_map(body: Body) -> bool:
    """Whether it is a surface that a larger one goes on around."""
    return isinstance(body, Surface) and body.is_cut_out


def of_yield(result: Assessment) -> list[str]:
    """Say what yields at the largest load, with which hardness, and how far its scatter matters."""
    curve, pair, hardness = result.curve, result.question.pair, hardness_of(result.question)
    if curve.hardness is None or hardness is None or curve.plastic_fraction is None:
        return []
    whose = "given" if pair is None or hardness.factor == 1 else "of the softer body"
    known = f"{engineering(hardness.value, 'Pa')}, {whose}"
    share = float(curve.plastic_fraction[result.asked[result.largest]])
    notes = []
    if share > 0:
        notes.append(
            f"{100 * share:.3g}% of the contact yields at the largest load: it bears the hardness, "
            f"{known}"
        )
    elif not np.isnan(share):
        notes.append(f"nothing yields at the largest load: no point reaches the hardness, {known}")
    if result.hardness_scatter:
        moved = [
            f"{result.answers[key].name} {_per_cent(result.hardness_scatter[key], result.largest)}"
            for key in _MOVED
            if key in result.hardness_scatter
        ]
        notes.append(
            f"the hardness of the table is known to a factor of {hardness.factor:g}; as soft and "
            f"as hard as that, at the largest load: {', '.join(moved)}; that is in the intervals"
        )
    return notes


def _per_cent(ratios: Ends, load: int) -> str:
    """Write how far two ratios are from one, at a load."""
    if np.isnan([end[load] for end in ratios]).any():
        return "unknown, as the softest body does not bear the load"
    low, high = (100 * (float(end[load]) - 1) for end in ratios)
    return f"{low:+.2g} to {high:+.2g}%"
