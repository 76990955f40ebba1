"""The report for a client: one page, as HTML and PDF, from an assessment."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from roughline.plot.bodies import draw_heights
from roughline.plot.spectra import draw_spectrum
from roughline.plot.style import PAGE, new_figure, save, styled
from roughline.report.contact_figures import (
    draw_area,
    draw_filled,
    draw_force,
    draw_last_contact,
    draw_partial_slip,
    draw_stiffness,
    has_falling_loads,
    write_contact,
)
from roughline.report.contact_tables import (
    UNRESOLVED,
    answer_table,
    elastic_in_words,
    formula_table,
    leading_keys,
    material_in_words,
    quantity,
    star_is_shown,
)
from roughline.report.document import write_document
from roughline.report.page import Picture, Section, Table
from roughline.topography.body import Body, Line, Surface
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment

_ABREAST = 4  # loads that fit beside each other on a page

ASSUMPTIONS = (
    "Both bodies are half-spaces, linear elastic up to the hardness of the softer body, if that is "
    "known, and perfectly plastic there; small slopes, no friction in the normal problem, no "
    "adhesion, static loads.",
    "Heights as measured: the filter, the probe and the grid decide the finest waves, and with "
    "them the real contact area; stiffness and conductance depend on them less.",
    "Intervals, where given, hold the uncertainty due to the grid, to filled points and to the "
    "scatter of the hardness, or to a line scan; those of k_i, h_c and |R| of a map hold what one "
    "map does not show of the larger surface as well. They do not hold the scatter of other "
    "material data, nor, for all other answers, the scatter between places on the part.",
)
ASSUMPTIONS_OF_JOINT = (
    *ASSUMPTIONS[:2],
    "The joint is alike everywhere, and evenly loaded: each place carries the mean pressure and "
    "has the roughness of the map. The map is pressed at that pressure in a periodic half-space, "
    "and quantities per area are multiplied by the joint's area. Answers are those of the "
    "interface; waviness longer than the map, bending, and the constriction of the bodies to the "
    "joint's outline are left out.",
    "Intervals, where given, hold the uncertainty due to the grid, to filled points, to the "
    "scatter of the hardness, and to what one map does not show of the surface around it. They do "
    "not hold the scatter of other material data, nor that of places which are not alike.",
)


def write_contact_report(assessment: Assessment, folder: Path, how_to_repeat: str) -> list[Path]:
    """Write ``report.html``, ``report.pdf``, ``curve.nc`` and the figures.

    Parameters
    ----------
    assessment : Assessment
        With answers for two materials.
    folder : Path
        Made if it does not exist.
    how_to_repeat : str
        The command, or the lines of Python, that give the same report.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    files = write_contact(assessment, folder)
    with styled():
        overview = save(_overview(assessment), folder, "overview")
    title, lead = f"Contact of {assessment.question.name}", _lead(assessment)
    sections = _sections(assessment, overview[0], how_to_repeat)
    return [*write_document(folder, title, lead, sections), *files, *overview]


def _lead(assessment: Assessment) -> str:
    """The answers at the largest load, by the names that they have in the table."""
    pair, curve = assessment.question.pair, assessment.curve_as_asked
    assert pair is not None
    largest = assessment.largest
    answers = assessment.answers
    shown = {key: quantity(each, largest) for key, each in answers.items()}
    leading = [f"{answers[key].name} {shown[key]}" for key in leading_keys(assessment)]
    elastic = elastic_in_words(assessment)
    joint = assessment.question.joint
    over = "the nominal area" if joint is None else f"a joint of {engineering(joint, 'm²')}"
    unsure = curve.converged[largest] and not curve.resolved[largest]
    return sentence(
        f"{pair.first.name} on {pair.second.name} under {shown['normal_force']}, "
        f"{shown['mean_pressure']} over {over}: {', '.join(leading)}"
        + (f" ({UNRESOLVED})" if unsure else "")
        + (f"; {elastic}" if elastic else "")
    )


def _overview(assessment: Assessment) -> Figure:
    friction, falls = assessment.question.friction, has_falling_loads(assessment)
    figure = new_figure(PAGE, 4.6)
    panels = figure.subplots(2, 3 if friction is not None or falls else 2).ravel()
    draw_heights(panels[0], assessment.body, "m")
    draw_filled(panels[0], assessment)
    remaining = list(panels[1:])
    if assessment.roughness is not None:
        draw_spectrum(remaining.pop(0), assessment.roughness, "m")
    draw_stiffness(remaining.pop(0), assessment)
    if isinstance(assessment.body, Surface):
        if assessment.theories or (friction is not None) != falls:  # with both there is no room
            draw_area(remaining.pop(0), assessment)
        if remaining:
            draw_last_contact(remaining.pop(0), assessment.body, assessment)
    if falls and remaining:
        draw_force(remaining.pop(0), assessment)
    if friction is not None and remaining:
        draw_partial_slip(remaining.pop(0), assessment.partial_slip)
    for empty in remaining:
        empty.set_axis_off()
    return figure


def _sections(assessment: Assessment, overview: Path, how_to_repeat: str) -> list[Section]:
    pair = assessment.question.pair
    assert pair is not None
    settings = "; ".join(f"{key} = {_shown(value)}" for key, value in assessment.settings.items())
    table_of = partial(answer_table, assessment, with_elastic=True)
    legend = [f"A star after a load: {UNRESOLVED}."] if star_is_shown(assessment) else []
    return [
        Section(
            "Answers",
            [f"Materials: {material_in_words(pair.first)}; {material_in_words(pair.second)}."],
            notes=[*legend, *map(sentence, assessment.remarks)],
            tables=[
                Table(header, rows, numbers=range(1, len(header)))
                for header, rows in map(table_of, _abreast(assessment))
            ],
        ),
        Section(
            "Surface",
            [_surface(assessment)],
            pictures=[Picture(overview, "Overview", _caption(assessment))],
        ),
        Section("Formulas and sources", tables=[Table(*formula_table(assessment))]),
        Section(
            "Assumptions",
            assumptions_of(assessment),
        ),
        Section("How to repeat it", [how_to_repeat, settings]),
    ]


def assumptions_of(assessment: Assessment) -> list[str]:
    """Assumptions of the answers."""
    of_theories = [f"{theory.name}: {theory.validity}." for theory in assessment.theories]
    joint = assessment.question.joint is not None
    return [*(ASSUMPTIONS_OF_JOINT if joint else ASSUMPTIONS), *of_theories]


def _abreast(assessment: Assessment) -> list[slice]:
    """Loads that stand beside each other in a table."""
    return [slice(i, i + _ABREAST) for i in range(0, assessment.asked.size, _ABREAST)]


def _caption(assessment: Assessment) -> str:
    question, yields = assessment.question, assessment.curve.hardness is not None
    marked = any(part.filled_region is not None for part in assessment.topographies)
    marks = ["open marks: fewer than ten points in contact"]
    marks += ["dashed: on unloading"] if yields else []
    marks += ["blue: after a larger load"] if has_falling_loads(assessment) else []
    shown = [
        ("Heights of the map" if question.joint is not None else "Heights")
        + (" (red: filled points)" if marked else ""),
        "spectrum with the nearest self-affine law",
        f"stiffness over force ({'; '.join(marks)})",
    ]
    if assessment.theories:
        shown.append("and theories for the same spectrum")
    if has_falling_loads(assessment):
        shown.append("force over depth")
    if isinstance(assessment.body, Surface):
        red = " (red: at the hardness)" if yields else ""
        shown.append(
            f"and the points in contact at the largest load{red}; their area is corrected for the "
            "outline's steps, as in the table"
        )
    return f"{', '.join(shown)}."


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _surface(assessment: Assessment) -> str:
    body, parameters = assessment.body, assessment.roughness
    if isinstance(body, Line):
        what = f"{body.heights.size} points over {engineering(body.length, 'm')}"
    else:
        sides = " x ".join(engineering(size, "m") for size in body.sizes)
        what = f"{body.shape[0]} x {body.shape[1]} points on {sides}"
    if len(assessment.topographies) == 1:
        done = f"Preparation: {_preparation(body)}."
    else:
        first, second = (_preparation(part.body) for part in assessment.topographies)
        done = f"Preparation of the first body: {first}; of the second: {second}."
        what += ", two bodies together" if isinstance(body, Surface) else ", the first of two"
    text = (
        f"{what}; rms height {engineering(body.rms_height, 'm')}, rms slope {body.rms_slope:.3g}. "
        f"{done}"
    )
    if parameters is not None and parameters.fit is not None:
        low, high = parameters.fit.hurst_interval
        text += f" Hurst exponent {parameters.fit.hurst:.2f} ({low:.2f} to {high:.2f})."
    if parameters is not None and parameters.remarks:
        text += " " + " ".join(sentence(remark) for remark in parameters.remarks)
    return text


def _preparation(body: Body) -> str:
    steps = (
        "cropped",
        "outliers_removed",
        "detrended",
        "low_pass",
        "resampled",
        "resampled_to",
        "filled",
    )
    done = [
        f"{name.replace('_', ' ')}: {body.settings[name]}"
        for name in steps
        if name in body.settings
    ]
    return ", ".join(done) or "none"


def sentence(text: str) -> str:
    """A remark as a sentence: with a capital and a full stop."""
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")
