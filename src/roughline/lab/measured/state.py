"""What is set in the view "My surface": texts read and checked, control by control."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from roughline.engineering.materials import material
from roughline.errors.words import Words
from roughline.lab.controls import ControlError, refuse_strange, sent_texts, usable
from roughline.lab.measured import controls as c
from roughline.lab.measured.controls import at
from roughline.lab.measured.examples import EXAMPLES, write_example
from roughline.lab.server.tasks import Arguments
from roughline.question import from_fields
from roughline.question.fields import FILE, LOADS, PREPARATION, names_by
from roughline.question.from_fields import refuse_alone
from roughline.question.question import Question
from roughline.question.reading import Reading
from roughline.topography.preparation import Preparation

_FILES = ("file", "example")
_KNOWN = (*_FILES, *c.KEYS)
_CHOICE_WORDS = dict(pair for field in c.BY_CONTROL.values() for pair in field.choices.values())
"""What the page calls the values of choices."""

PAGE_WORDS = Words(
    names_by(lambda field: field.word or field.label or field.control.replace("_", " "))
    | {"forces": "loads"},
    lambda text: f'"{_CHOICE_WORDS.get(text, text)}"',
)
"""What the page calls arguments of the library: its controls."""

_MEANWHILE = {key: each.default for key, each in c.CONTROLS.items() if each.default}
"""What is used without a text, in words."""
_NEEDED = {key: c.BEGINS[key] for key in c.BODIES}
"""Of controls without whose text there is no answer: what is used while there is none."""

_Read = TypeVar("_Read")
ControlTexts = Mapping[str, str]


@dataclass(frozen=True)
class Source:
    """The file of a page."""

    path: Path  # where it lies
    name: str  # what its owner calls it
    key: str  # by which the page knows it


def control_texts(arguments: Arguments) -> ControlTexts:
    """The texts of the controls by their keys; empty ones are as if they were not there.

    One that has no place here is refused, and a link of another version.
    """
    texts = sent_texts(arguments)
    refuse_strange(texts, _KNOWN)
    return {key: text.strip() for key, text in texts.items() if text.strip()}


def used_in(
    arguments: Arguments, read: Callable[[ControlTexts], _Read]
) -> tuple[_Read, dict[str, str]]:
    """What is read of the texts that can be used, and why others are not, by control.

    What is wrong with the whole link, or not with the text of a control, is refused.
    """
    settings = {key: text for key, text in sent_texts(arguments).items() if key not in _FILES}
    return usable(
        {**arguments, "state": settings},
        lambda texts: read(control_texts({"state": texts})),
        lambda found: _MEANWHILE,
        _NEEDED,
    )


def first_source(texts: ControlTexts, session: Mapping[str, Any]) -> Source:
    """The file that a page means, or the first of them."""
    return page_sources(texts, session)[0]


def page_sources(texts: ControlTexts, session: Mapping[str, Any]) -> list[Source]:
    """The files that a page means, unless one is gone: several are maps of one part."""
    if key := texts.get("example"):
        if key not in EXAMPLES:
            raise ControlError(
                f'there is no example "{key[:40]}"; there are {", ".join(EXAMPLES)}', "file"
            )
        path = write_example(key, Path(session["folder"]) / "results")
        return [Source(path, EXAMPLES[key].file, key)]
    keys = texts.get("file", "").split(",")
    paths = [session["files"].get(key) for key in keys]
    if None in paths:
        which = "the file is" if len(paths) == 1 else "one of the files is"
        raise ControlError(f"{which} no longer here: choose it again", "file")
    names = [session["names"][path] for path in paths]
    return [
        Source(Path(path), f"{name} ({i})" if names.count(name) > 1 else name, key)
        for i, (key, path, name) in enumerate(zip(keys, paths, names, strict=True), 1)
    ]


def field_values(texts: ControlTexts, *groups: str) -> dict[str, Any]:
    """What the controls of the fields in some groups tell, by the names of the fields."""
    return {
        field.name: c.CONTROLS[key].read_in(texts)
        for key, field in c.BY_CONTROL.items()
        if (not groups or field.group in groups) and (key in texts or field.choices)
    }


def page_reading(texts: ControlTexts, name: str | None) -> Reading:
    """How the file is read."""
    return from_fields.build_reading(field_values(texts, FILE), name)


def page_preparation(texts: ControlTexts) -> Preparation | None:
    """What is done to the topography; None where nothing is set, as on the command line."""
    return from_fields.build_preparation(field_values(texts, PREPARATION))


def page_question(texts: ControlTexts, source: Source) -> Question:
    """The question that the page asks of one of its files."""
    values = body_values(texts) | field_values(texts) | {"whole_curve": bool(typed_loads(texts))}
    with at(""):
        return from_fields.build_question(source.path, values, source.name)


def body_values(texts: ControlTexts) -> dict[str, Any]:
    """Two materials, or a contact modulus, as a question takes them."""
    by_modulus = c.CHOICES["bodies"].read_in(texts) == "modulus"
    name, values = "E_star" if by_modulus else "materials", []
    for key, (field, text) in c.BODIES.items():
        if field.name != name:
            continue
        with at(key):
            if key not in texts:
                raise ControlError(f'give the {text.label}, such as "{text.begins}"', key)
            if by_modulus:
                refuse_alone(field, texts[key])
            values.append(texts[key] if by_modulus else material(texts[key]))
    return {name: values[0] if by_modulus else tuple(values)}


def typed_loads(texts: ControlTexts) -> list[str]:
    """The loads, as they were typed."""
    return list(field_values(texts, LOADS).get("loads", ()))
