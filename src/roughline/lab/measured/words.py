"""What the view "My surface" calls arguments of the library: its controls."""

from __future__ import annotations

from roughline.assessment.fields import Field, names_by
from roughline.errors.words import Words


def _word_of(field: Field) -> str:
    return field.word or field.label or field.control


CONTROLS = Words(names_by(_word_of), lambda text: f'"{text}"')
