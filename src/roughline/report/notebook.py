"""What a notebook shows and ``print`` prints of an assessment: what the terminal says of it."""

from __future__ import annotations

import io
from collections.abc import Callable

from rich.console import Console

from roughline.assessment.assessment import Assessment
from roughline.assessment.part import PartAssessment
from roughline.computing.notebook import in_notebook, printed
from roughline.plot.notebook import html, png
from roughline.plot.style import styled
from roughline.report.answers import answer_table, lead_sentence, load_table
from roughline.report.contact_figures import overview
from roughline.report.contact_tables import curve_table, modulus_in_words
from roughline.report.terminal import print_assessment, print_part
from roughline.report.texture_table import (
    causes_in_words,
    filters_in_words,
    standard_title,
    texture_in_text,
    texture_table,
)
from roughline.texture.iso import IsoParameters

_MOST_ABREAST = 3  # loads of which the answers stand beside each other


@printed.register
def _assessment_text(assessment: Assessment) -> str:
    return _written(lambda console: print_assessment(assessment, console=console))


@printed.register
def _part_text(part: PartAssessment) -> str:
    return _written(lambda console: print_part(part, console=console))


@printed.register
def _texture_text(found: IsoParameters) -> str:
    return texture_in_text(found)


def _written(printing: Callable[[Console], None]) -> str:
    """What is printed on a console, without colours."""
    text = io.StringIO()
    printing(Console(markup=False, file=text))
    return text.getvalue().rstrip()


@in_notebook.register
def _table_of_assessment(assessment: Assessment) -> str:
    """What was asked, all answers or the curve, the pictures of the page, and the remarks."""
    if assessment.question.pair is None:
        title = modulus_in_words(assessment)
        header, rows = curve_table(assessment)
    else:
        title = lead_sentence(assessment)
        header, rows = _answers(assessment)
    with styled():
        picture = png(overview(assessment))
    return html(title, header, rows, picture, _remarks(assessment))


@in_notebook.register
def _table_of_part(part: PartAssessment) -> str:
    """What was asked of several maps, their answers, and the remarks."""
    return html(lead_sentence(part), *_answers(part), remarks=_remarks(part))


@in_notebook.register
def _table_of_texture(found: IsoParameters) -> str:
    """The parameters, and below them filters, remarks and what is not defined."""
    remarks = [filters_in_words(found), *found.remarks, *causes_in_words(found)]
    return html(standard_title(found), *texture_table(found), remarks=remarks)


def _answers(result: Assessment | PartAssessment) -> tuple[list[str], list[list[str]]]:
    if len(result.headings) > _MOST_ABREAST:
        return load_table(result, list(result.answers))
    return answer_table(result)


def _remarks(result: Assessment | PartAssessment) -> list[str]:
    return [
        *(f"warning: {each}" for each in result.warnings),
        *(f"note: {each}" for each in result.notes),
    ]
