"""What is set in the view "My surface": texts read and checked, control by control."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import roughline as rl
from roughline.assessment import from_fields
from roughline.assessment.fields import FILE, LOADS, PREPARATION, names_by
from roughline.assessment.from_fields import refuse_alone
from roughline.assessment.question import Question
from roughline.assessment.reading import Reading
from roughline.engineering.materials import material
from roughline.errors.words import Words
from roughline.lab.controls import ControlError, refuse_strange, sent_texts, usable
from roughline.lab.measured import controls as c
from roughline.lab.measured.examples import EXAMPLES, path_of
from roughline.lab.server.tasks import Arguments
from roughline.topography.preparation import Preparation

_FILES = ("file", "example")
_KNOWN = (*_FILES, *c.KEYS)
_OF_ARGUMENTS = {each.name: (key,) for key, each in c.BY_CONTROL.items()} | {
    field.name: tuple(field.texts) for field, _ in c.BODIES.values()
}
"""Keys of controls by the names of arguments."""

_SHOWN = dict(pair for field in c.BY_CONTROL.values() for pair in field.choices.values())
"""What the page calls the values of choices."""

CONTROLS = Words(
    names_by(lambda field: field.word or field.label or field.control.replace("_", " "))
    | {"forces": "loads"},
    lambda text: f'"{_SHOWN.get(text, text)}"',
)
"""What the page calls arguments of the library: its controls."""

_DEFAULTS = {key: each.default for key, each in c.CHOICES.items()} | {
    key: each.otherwise for key, each in c.BY_CONTROL.items() if each.kind is float
}
"""Of controls that mean something without a text."""
_NEEDED = {key: c.BEGINS[key] for key in c.BODIES}
"""Of controls without whose text there is no answer: what is used while there is none."""
_MOST = {"points": c.MOST_POINTS, "loads": 20}
"""Largest numbers, or most texts, that this lab takes, by the names of fields."""

_Read = TypeVar("_Read")
Said = Mapping[str, str]


@dataclass(frozen=True)
class Source:
    """The file of a page."""

    path: Path  # where it lies
    name: str  # what its owner calls it
    key: str  # by which the page knows it


def said_of(arguments: Arguments) -> Said:
    """The texts of the controls by their keys; empty ones are as if they were not there.

    One that has no place here is refused, and a link of another version.
    """
    said = sent_texts(arguments)
    refuse_strange(said, _KNOWN)
    return {key: text.strip() for key, text in said.items() if text.strip()}


def used_in(arguments: Arguments, read: Callable[[Said], _Read]) -> tuple[_Read, dict[str, str]]:
    """What is read of the texts that can be used, and why others are not, by control.

    What is wrong with the whole link, or not with the text of a control, is refused.
    """
    settings = {key: text for key, text in sent_texts(arguments).items() if key not in _FILES}
    return usable(
        {**arguments, "state": settings},
        lambda texts: read(said_of({"state": texts})),
        lambda found: _DEFAULTS,
        _NEEDED,
    )


def source_of(said: Said, session: Mapping[str, Any]) -> Source:
    """The file that a page means, or the first of them."""
    return sources_of(said, session)[0]


def sources_of(said: Said, session: Mapping[str, Any]) -> list[Source]:
    """The files that a page means, unless one is gone: several are maps of one part."""
    if key := said.get("example"):
        if key not in EXAMPLES:
            raise ControlError(
                f'there is no example "{key[:40]}"; there are {", ".join(EXAMPLES)}', "file"
            )
        path = path_of(key, Path(session["folder"]) / "results")
        return [Source(path, EXAMPLES[key].file, key)]
    keys = said.get("file", "").split(",")
    paths = [session["files"].get(key) for key in keys]
    if None in paths:
        which = "the file is" if len(paths) == 1 else "one of the files is"
        raise ControlError(f"{which} no longer here: choose it again", "file")
    names = [session["names"][path] for path in paths]
    return [
        Source(Path(path), f"{name} ({i})" if names.count(name) > 1 else name, key)
        for i, (key, path, name) in enumerate(zip(keys, paths, names, strict=True), 1)
    ]


def told_in(said: Said, *groups: str) -> dict[str, Any]:
    """What the controls of the fields in some groups tell, by the names of the fields."""
    given = {}
    for key, field in c.BY_CONTROL.items():
        text = said.get(key)
        if groups and field.group not in groups:
            continue
        if field.choices:
            given[field.name] = field.choices[c.CHOICES[key].read(text or _DEFAULTS[key])][0]
        elif text is not None:
            with at(key):
                given[field.name] = value = field.value(_split(text, field.separator))
                refuse_alone(field, value)
                count = len(value) if isinstance(value, list) else value
                if field.name in _MOST and count > _MOST[field.name]:
                    most = _MOST[field.name]
                    raise ControlError(
                        f"{field.label or key}: {count} are too many; this lab takes up to {most}",
                        key,
                    )
    return given


def _split(text: str, separator: str) -> str | list[str]:
    """The texts of a control that takes several, which a comma with a space parts as well."""
    if not separator:
        return text
    return [part.strip() for part in re.split(rf"{separator}|,\s", text) if part.strip()]


def reading_of(said: Said, name: str | None) -> Reading:
    """How the file is read."""
    return from_fields.build_reading(told_in(said, FILE), name)


def preparation_of(said: Said) -> Preparation | None:
    """What is done to the topography; None where nothing is set, as on the command line."""
    return from_fields.build_preparation(told_in(said, PREPARATION))


def question_of(said: Said, source: Source) -> Question:
    """The question that the page asks of one of its files."""
    given = bodies_of(said) | told_in(said) | {"whole_curve": bool(loads_of(said))}
    with at(""):
        return from_fields.build_question(source.path, given, source.name)


def bodies_of(said: Said) -> dict[str, Any]:
    """Two materials, or a contact modulus, as a question takes them."""
    by_modulus = c.CHOICES["bodies"].read_in(said) == "modulus"
    name, given = "E_star" if by_modulus else "materials", []
    for key, (field, text) in c.BODIES.items():
        if field.name != name:
            continue
        with at(key):
            if key not in said:
                raise ControlError(f'give the {text.label}, such as "{text.begins}"', key)
            if by_modulus:
                refuse_alone(field, said[key])
            given.append(said[key] if by_modulus else material(said[key]))
    return {name: given[0] if by_modulus else tuple(given)}


def loads_of(said: Said) -> list[str]:
    """The loads, as they were typed."""
    return list(told_in(said, LOADS).get("loads", ()))


@contextmanager
def at(key: str) -> Iterator[None]:
    """Say of a refusal at which control it arose, in the words of the page."""
    try:
        yield
    except rl.RoughlineError as error:
        about = [getattr(error, "argument", None), *getattr(error, "others", ())]
        keys = [each for name in about for each in _OF_ARGUMENTS.get(name or "", (name,))]
        among = getattr(error, "among", [key for key in keys if key in c.KEYS] or [key])
        raise ControlError(str(error), *among) from None
