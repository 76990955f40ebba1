"""Questions, readings and preparations of what was told of their fields."""

from __future__ import annotations

from typing import Any

import attrs

from roughline.errors import InputError
from roughline.errors.words import called
from roughline.question.arguments import several
from roughline.question.asked import KINDS, asked_for
from roughline.question.fields import FIELDS, Field, FieldValues
from roughline.question.question import Question
from roughline.question.reading import Reading
from roughline.topography.missing import Missing
from roughline.topography.preparation import Preparation


def arguments_for(kind: str, values: FieldValues) -> dict[str, Any]:
    """Return what is told of one class, as its arguments."""
    fields = [each for each in FIELDS if each.of == kind and values.get(each.name) is not None]
    first_by: dict[str, Field] = {}
    for each in fields:
        other = first_by.setdefault(each.argument, each)
        if other is not each and values[other.name]:
            raise InputError(
                f"{called(other.name)} and {called(each.name)} are both given: give one of them",
                None,
                other.name,
                each.name,
            )
    given = {each.argument: values[each.name] for each in fields}
    if kind == "Reading" and (missing := arguments_for("Missing", values)):
        given["missing"] = Missing(**missing)
    return given


def build_reading(values: FieldValues, name: str | None = None) -> Reading:
    """Return how files are read; the first is called by a name, if one is given."""
    return Reading(name=name, **arguments_for("Reading", values))


def build_preparation(values: FieldValues) -> Preparation | None:
    """Return how topographies are prepared; None where nothing is told."""
    found = Preparation(**arguments_for("Preparation", values))
    return None if found == Preparation() else found


def build_question(
    body: Any, values: FieldValues, name: str | None = None, **others: Any
) -> Question:
    """Return the question of a body or a file that is told, with arguments that have no control."""
    return Question(
        body,
        ask=asked_for(values),
        reading=build_reading(values, name),
        preparation=build_preparation(values),
        **arguments_for("Question", values),
        **others,
    )


def refuse_alone(field: Field, value: Any) -> None:
    """Refuse a value of a field that could be used with no others, as what it is of does."""
    made_of_fields = {"Reading": Reading, "Missing": Missing, "Preparation": Preparation}
    if field.of in made_of_fields:
        made_of_fields[field.of](**{field.argument: value})
        return
    kind = KINDS.get(field.of, Question)
    if not attrs.has(kind):
        kind(*several(value))
        return
    read: Any = getattr(attrs.fields_dict(kind).get(field.argument), "converter", None)
    if read is not None:
        read(value)
