"""What is set in the view "My surface": texts read and checked, control by control."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import roughline as rl
from roughline.assessment import told
from roughline.assessment.fields import FILE, PREPARATION, names_by
from roughline.assessment.question import Question
from roughline.assessment.reading import Reading
from roughline.assessment.told import refuse_alone
from roughline.engineering.coated import Solid
from roughline.engineering.materials import material
from roughline.errors.checks import shown
from roughline.errors.words import Words
from roughline.lab.controls import (
    ControlError,
    is_number,
    refuse_strange,
    texts_of,
    usable,
)
from roughline.lab.measured import controls as c
from roughline.lab.measured.examples import EXAMPLES, path_of
from roughline.lab.server.tasks import Arguments
from roughline.topography.preparation import Preparation
from roughline.units import in_si, lengths, load_in_newtons, refuse_decimal_comma

_FILES = ("file", "example")
_KNOWN = (*_FILES, *c.KEYS)
_OF_ARGUMENTS = {"E_star": ("E",), "materials": ("first", "second")} | {
    each.name: (key,) for key, each in c.BY_CONTROL.items()
}
"""Controls by the names of arguments."""

CONTROLS = Words(
    names_by(lambda field: field.word or field.label or field.control.replace("_", " ")),
    lambda text: f'"{text}"',
)
"""What the page calls arguments of the library: its controls."""

_MOST_LOADS = 20  # of one question
_DEFAULTS = {key: each.default for key, each in c.CHOICES.items()} | {
    "most_missing": c.BY_CONTROL["most_missing"].otherwise
}
"""Of controls that mean something without a text."""
_NEEDED = {"first": "steel", "second": "copper", "E": "110 GPa"}
"""Of controls without whose text there is no answer: what is used while there is none."""

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

    Raises
    ------
    ControlError
        If one has no place here, or the link that they are from is of another version.
    """
    said = texts_of(arguments)
    refuse_strange(said, _KNOWN)
    return {key: text.strip() for key, text in said.items() if text.strip()}


def used_in(arguments: Arguments, read: Callable[[Said], _Read]) -> tuple[_Read, dict[str, str]]:
    """What is read of the texts that can be used, and why others are not, by control.

    Raises
    ------
    ControlError
        If what is wrong is the whole link, or not the text of a control.
    """
    settings = {key: text for key, text in texts_of(arguments).items() if key not in _FILES}
    return usable(
        {**arguments, "state": settings},
        lambda texts: read(said_of({"state": texts})),
        lambda found: _DEFAULTS,
        _NEEDED,
    )


def source_of(said: Said, session: Mapping[str, Any]) -> Source:
    """The file that a page means, or the first of them.

    Raises
    ------
    ControlError
        If there is none, or it is gone.
    """
    return sources_of(said, session)[0]


def sources_of(said: Said, session: Mapping[str, Any]) -> list[Source]:
    """The files that a page means: several are maps of one part.

    Raises
    ------
    ControlError
        If there is none, or one is gone.
    """
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
    """What the controls of the fields in some groups tell, by the names of the fields.

    Raises
    ------
    ControlError
        If a text cannot be used, at its control.
    """
    given = {}
    for key, field in c.BY_CONTROL.items():
        text = said.get(key)
        if groups and field.group not in groups:
            continue
        if field.choices:
            given[field.name] = field.choices[c.CHOICES[key].read(text or _DEFAULTS[key])][0]
        elif text is not None:
            with at(key):
                read: Callable[[str], Any] = _READ.get(key) or field.value
                given[field.name] = read(text)
                refuse_alone(field, given[field.name])
    return given


def reading_of(said: Said, name: str | None) -> Reading:
    """How the file is read."""
    return told.reading_of(told_in(said, FILE), name)


def preparation_of(said: Said) -> Preparation | None:
    """What is done to the topography; None where nothing is set, as on the command line."""
    return told.preparation_of(told_in(said, PREPARATION))


def question_of(said: Said, source: Source) -> Question:
    """The question that the page asks of one of its files.

    Raises
    ------
    ControlError
        If a text cannot be used; it says at which control.
    """
    given = bodies_of(said) | told_in(said) | {"whole_curve": bool(loads_of(said))}
    with at(""):
        return told.question_of(source.path, given, source.name)


def bodies_of(said: Said) -> dict[str, Any]:
    """Two materials, or a contact modulus, as a question takes them."""
    if c.CHOICES["bodies"].read_in(said) == "modulus":
        with at("E"):
            if "E" not in said:
                raise ControlError('give the contact modulus, such as "110 GPa"', "E")
            modulus = in_si(said["E"], "Pa", "contact modulus")
            if not 0 < modulus < math.inf:
                raise ControlError(
                    f'contact modulus is "{said["E"][:40]}"; give a positive one', "E"
                )
        return {"E_star": modulus}
    pair: list[Solid] = []
    for key in ("first", "second"):
        with at(key):
            if key not in said:
                raise ControlError(
                    f'give the {key} material: a name, values such as "E=70 GPa nu=0.33", or '
                    'a coated one such as "rubber 2 mm on steel"',
                    key,
                )
            pair.append(material(said[key]))
    if all(math.isinf(each.surface.E) for each in pair):
        raise ControlError("both materials are rigid: one of them must give way", "second")
    return {"materials": tuple(pair)}


def loads_of(said: Said) -> list[str]:
    """The loads, as they were typed."""
    with at("loads"):
        return _loads(said.get("loads", ""))


def _loads(text: str) -> list[str]:
    """Loads with semicolons, or commas and spaces, between."""
    loads = [part.strip() for part in re.split(r";|,\s", text) if part.strip()]
    for load in loads:
        if not 0 < load_in_newtons(load, 1.0) < math.inf:
            raise ControlError(f'load is "{load[:40]}"; give positive ones', "loads")
    if len(loads) > _MOST_LOADS:
        raise ControlError(f"{len(loads)} loads; give up to {_MOST_LOADS}", "loads")
    return loads


def _friction(text: str) -> float | str:
    """A number; a text that is none is refused by what it is of."""
    refuse_decimal_comma(text, "the coefficient of friction")
    return float(text) if is_number(text) else text


def _theories(text: str) -> list[str]:
    """Names of theories with commas between."""
    return [name for name in text.split(",") if name]


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


def _share(text: str) -> float:
    """A share, in per cent or as a number."""
    number = text.removesuffix("%")
    refuse_decimal_comma(number, "most missing")
    share = float(number) if is_number(number) else math.nan
    share = share / 100 if text.endswith("%") else share
    if not 0 <= share < 1:
        raise ControlError(
            f'most missing is "{text[:40]}"; give a share such as 20 %, below 100 %',
            "most_missing",
        )
    return share


def _sizes(text: str) -> str:
    """Sides of a file that states none, as they were typed."""
    sides = lengths(text, "size")
    if len(sides) > 2 or not all(0 < side < math.inf for side in sides):
        raise ControlError(
            f"size is {shown(text)}; give one or two positive lengths, such as 1 mm, 0.5 mm",
            "size",
        )
    return text


def _points(text: str) -> int:
    """Points along the longer side."""
    if not (text.isascii() and text.isdecimal()) or not 2 <= int(text[:20]) <= c.MOST_POINTS:
        raise ControlError(
            f'points to resample to is "{text[:40]}"; give a whole number from 2 to '
            f"{c.MOST_POINTS}, the most that this lab resamples to",
            "resample",
        )
    return int(text)


_READ: dict[str, Callable[[str], Any]] = {
    "loads": _loads,
    "friction": _friction,
    "theories": _theories,
    "most_missing": _share,
    "size": _sizes,
    "resample": _points,
}
"""Readers of controls whose texts are not those of the command line, or have limits of the lab."""
