"""What is set in the view "My surface": texts read and checked, control by control."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import roughline as rl
from roughline.engineering.materials import material
from roughline.errors.words import Words
from roughline.lab.controls import ControlError, refuse_strange, sent_texts, usable
from roughline.lab.measured import controls as c
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
_CONTROL_KEYS = {each.name: (key,) for key, each in c.BY_CONTROL.items()} | {
    field.name: tuple(field.texts) for field, _ in c.BODIES.values()
}
"""Keys of controls by the names of arguments."""

_CHOICE_WORDS = dict(pair for field in c.BY_CONTROL.values() for pair in field.choices.values())
"""What the page calls the values of choices."""

CONTROLS = Words(
    names_by(lambda field: field.word or field.label or field.control.replace("_", " "))
    | {"forces": "loads"},
    lambda text: f'"{_CHOICE_WORDS.get(text, text)}"',
)
"""What the page calls arguments of the library: its controls."""

_DEFAULTS = {key: each.default for key, each in c.CHOICES.items()} | {
    key: each.otherwise for key, each in c.BY_CONTROL.items() if each.kind is float
}
"""Of controls that mean something without a text."""
_NEEDED = {key: c.BEGINS[key] for key in c.BODIES}
"""Of controls without whose text there is no answer: what is used while there is none."""
_MOST_VALUES = {"points": c.MOST_POINTS, "loads": 20}
"""Largest numbers, or most texts, that this lab takes, by the names of fields."""

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
        lambda found: _DEFAULTS,
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
    values = {}
    for key, field in c.BY_CONTROL.items():
        text = texts.get(key)
        if groups and field.group not in groups:
            continue
        if field.choices:
            values[field.name] = field.choices[c.CHOICES[key].read(text or _DEFAULTS[key])][0]
        elif text is not None:
            with at(key):
                values[field.name] = value = field.value(_split(text, field.separator))
                refuse_alone(field, value)
                count = len(value) if isinstance(value, list) else value
                if field.name in _MOST_VALUES and count > _MOST_VALUES[field.name]:
                    most = _MOST_VALUES[field.name]
                    raise ControlError(
                        f"{field.label or key}: {count} are too many; this lab takes up to {most}",
                        key,
                    )
    return values


def _split(text: str, separator: str) -> str | list[str]:
    """The texts of a control that takes several, which a comma with a space parts as well."""
    if not separator:
        return text
    return [part.strip() for part in re.split(rf"{separator}|,\s", text) if part.strip()]


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


@contextmanager
def at(key: str) -> Iterator[None]:
    """Say of a refusal at which control it arose, in the words of the page."""
    try:
        yield
    except rl.RoughlineError as error:
        about = [getattr(error, "argument", None), *getattr(error, "others", ())]
        keys = [each for name in about for each in _CONTROL_KEYS.get(name or "", (name,))]
        among = getattr(error, "among", [key for key in keys if key in c.KEYS] or [key])
        raise ControlError(str(error), *among) from None
