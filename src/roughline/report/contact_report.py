"""The report for a client, as HTML and PDF, from an assessment."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.plot.bodies import draw_heights
from roughline.plot.spectra import draw_spectrum
from roughline.plot.style import PAGE, new_figure, save, styled
from roughline.report.answers import (
    UNRESOLVED,
    headline,
    lead_of,
    load_table,
    sections_of,
    star_is_shown,
)
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
from roughline.report.contact_tables import formula_table, material_in_words, symbol_table
from roughline.report.document import write_document
from roughline.report.page import Picture, Section, Table, sentence
from roughline.report.preparation import STEPS, preparation_in_words
from roughline.topography.body import Line, Surface
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.engineering.pair import MaterialPair

OF_FORMULAS = "how each answer follows, where that holds, and whose result it is"
OF_ASSUMPTIONS = "what all answers and their intervals rest on"
OF_REPEATING = "what gives the same numbers again"
"""Said of sections that are folded."""

_ABREAST = 3  # loads that fit beside each other on a page
_PANEL, _PANELS = 2.6, 8.2  # heights of a row of panels, and of all at most [inch]

_ASSUMPTIONS = (
    "Both bodies are half-spaces, linear elastic up to the hardness of the softer body, if that is "
    "known, and perfectly plastic there; small slopes, no friction in the normal problem, no "
    "adhesion, static loads.",
    "Heights as measured: the filter, the probe and the grid decide the finest waves, and with "
    "them the real contact area; stiffness and conductance depend on them less.",
    "Intervals, where given, hold the uncertainty due to the grid, to filled points and to the "
    "scatter of the hardness, or to a line scan; those of k_i, h_c and |r| of a map hold what one "
    "map does not show of the larger surface as well. They do not hold the scatter of other "
    "material data, nor, for all other answers, the scatter between places on the part.",
)
_ASSUMPTIONS_OF_JOINT = (
    *_ASSUMPTIONS[:2],
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
    title, lead = f"Contact of {assessment.question.name}", lead_of(assessment)
    sections = _sections(assessment, overview[0], how_to_repeat)
    document = write_document(folder, title, lead, sections, headline(assessment))
    return [*document, *files, *overview]


def _overview(assessment: Assessment) -> Figure:
    """Two panels abreast, of what is known."""
    body, panels = assessment.body, [partial(_draw_body, assessment=assessment)]
    if assessment.roughness is not None:
        panels.append(partial(draw_spectrum, found=assessment.roughness, unit="m"))
    panels.append(partial(draw_stiffness, assessment=assessment))
    if isinstance(body, Surface):
        panels.append(partial(draw_area, assessment=assessment))
        panels.append(partial(draw_last_contact, surface=body, assessment=assessment))
    if has_falling_loads(assessment):
        panels.append(partial(draw_force, assessment=assessment))
    if assessment.question.friction is not None:
        panels.append(partial(draw_partial_slip, slip=assessment.partial_slip))
    rows = -(-len(panels) // 2)
    figure = new_figure(PAGE, min(_PANEL * rows, _PANELS))
    axes = figure.subplots(rows, 2, squeeze=False).ravel()
    for draw, each in zip(panels, axes, strict=False):
        draw(each)
    for empty in axes[len(panels) :]:
        empty.set_axis_off()
    return figure


def _draw_body(axes: Axes, assessment: Assessment) -> None:
    """Heights, with the points that were filled."""
    draw_heights(axes, assessment.body, "m")
    draw_filled(axes, assessment)


def _sections(assessment: Assessment, overview: Path, how_to_repeat: str) -> list[Section]:
    settings = "; ".join(
        f"{key} = {_shown(value)}"
        for key, value in assessment.settings.items()
        if key.removeprefix("body_") not in STEPS  # they are told with the surface
    )
    legend = [f"A star after a load: {UNRESOLVED}."] if star_is_shown(assessment) else []
    notes = [*map(sentence, assessment.notes)]
    return [
        Section(
            "Answers",
            [*materials_in_words(assessment.question.pair), *legend],
            tables=_many_loads(assessment),
        ),
        *sections_of(assessment, _ABREAST),
        *([Section("Notes", notes=notes)] if notes else []),
        Section(
            "Surface",
            [_surface(assessment)],
            pictures=[Picture(overview, "Overview", _caption(assessment))],
        ),
        Section(
            "Formulas and sources",
            tables=[Table(*formula_table(assessment)), Table(*symbol_table(assessment))],
            behind=OF_FORMULAS,
        ),
        Section("Assumptions", assumptions_of(assessment), behind=OF_ASSUMPTIONS),
        Section("How to repeat it", [how_to_repeat, settings], behind=OF_REPEATING),
    ]


def materials_in_words(pair: MaterialPair | None) -> list[str]:
    """A sentence on both materials."""
    if pair is None:
        return []
    return [f"Materials: {material_in_words(pair.first)}; {material_in_words(pair.second)}."]


def _many_loads(assessment: Assessment) -> list[Table]:
    """Of many loads, the leading answers of each, and others that belong beside them."""
    if assessment.asked.size <= _ABREAST:
        return []
    keys = [
        key
        for key, each in assessment.answers.items()
        if each.leads or each.rule.is_shown_at_many_loads
    ]
    return [Table.of_numbers(*load_table(assessment, keys))]


def assumptions_of(assessment: Assessment) -> list[str]:
    """Assumptions of the answers."""
    of_theories = [f"{theory.name}: {theory.validity}." for theory in assessment.theories]
    joint = assessment.question.joint is not None
    return [*(_ASSUMPTIONS_OF_JOINT if joint else _ASSUMPTIONS), *of_theories]


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
    if isinstance(assessment.body, Surface):
        red = " (red: at the hardness)" if yields else ""
        shown.append(
            "contact area, corrected for the outline's steps as in the table, over force; the "
            f"points in contact at the largest load{red}"
        )
    if has_falling_loads(assessment):
        shown.append("force over depth")
    if question.friction is not None:
        shown.append("partial slip at the largest load")
    with_theories = "; with theories for the same spectrum" if assessment.theories else ""
    return f"{'; '.join(shown)}{with_theories}."


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
        done = f"Preparation: {preparation_in_words(body)}."
    else:
        first, second = (preparation_in_words(part.body) for part in assessment.topographies)
        done = f"Preparation of the first body: {first}; of the second: {second}."
        what += ", two bodies together" if isinstance(body, Surface) else ", the first of two"
    text = (
        f"{what}; rms height {engineering(body.rms_height, 'm')}, rms slope {body.rms_slope:.3g}. "
        f"{done}"
    )
    if parameters is not None and parameters.fit is not None:
        text += f" Hurst exponent {parameters.fit.hurst_in_words}."
    if parameters is not None and parameters.remarks:
        text += " " + " ".join(sentence(remark) for remark in parameters.remarks)
    return text
