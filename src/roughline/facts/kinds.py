"""Kinds of facts and their words, which the texts beside this file hold.

    name: weight, what it is about
      words in short, of one line of at most 91 letters
      = words in full, or + what they add to those in short; without it, both are one

Without more, a kind is a warning about limits. In words, as in messages that are translated,

- {number:format} is a number of the fact, written as Python writes it, or as in :func:`_written`;
- {@argument=value} is an argument as the caller knows it;
- [name?these|others] are these words where the fact has that name, true or with a value, and the
  others where not; [name=value?...] those where it has this value, or so many entries.
"""

from __future__ import annotations

import re
import string
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from pathlib import Path
from typing import Any, Literal, get_args

from roughline.errors.words import called
from roughline.facts.listed import listed, listed_in_short
from roughline.units import decimal, engineering, in_words

Subject = Literal["What was done to the data", "What the intervals include", "Limits"]
"""What facts are about, as pages head them."""

DATA, INTERVALS, LIMITS = get_args(Subject)

Weight = Literal["grave", "warning", "note"]
"""Grave: the answers do not hold, or are of something else than was asked about."""

UNCHANGED = 1e-3
"""Relative change of rms height and slope below which a step did nothing."""

_ABOUT: dict[str, Subject] = {"data": DATA, "intervals": INTERVALS}
_CHOICE = re.compile(r"\[(\w+)(?:=([^?\[\]]*))?\?([^\[\]|]*)(?:\|([^\[\]]*))?\]")
_NAME = re.compile(r"[\[{](\w+)")
_JOINTS = {",": ", ", ";": "; ", "no": ", no ", "x": " x ", "to": " to ", "and of": " and of "}
_JOINTS |= {"then by": ", then by "}


@dataclass(frozen=True)
class FactKind:
    """A kind of fact.

    Parameters
    ----------
    short, full : str
        Its words, in one line of at most 91 letters and in full.
    about : str
        DATA, INTERVALS or LIMITS.
    weight : str
        "grave", "warning" or "note": of such a fact, unless it says otherwise.
    """

    short: str
    full: str
    about: Subject = LIMITS
    weight: Weight = "warning"

    @cached_property
    def numbers(self) -> frozenset[str]:
        """What its words name."""
        return frozenset(_NAME.findall(self.short + self.full))


def worded(text: str, numbers: Mapping[str, Any]) -> str:
    """Words of a kind, with the numbers of a fact."""
    found = 1
    while found:
        text, found = _CHOICE.subn(lambda choice: _chosen(numbers, *choice.groups()), text)
    return _FORMATTER.vformat(text, (), numbers)


def _chosen(
    numbers: Mapping[str, Any], name: str, wanted: str | None, these: str, others: str | None
) -> str:
    """The words of one choice."""
    value = numbers[name]
    if wanted is not None:
        holds = wanted == str(len(value) if isinstance(value, tuple) else value)
    elif isinstance(value, bool):
        holds = value
    else:  # a number is there even if it is zero
        holds = isinstance(value, Real) or bool(value)
    return these if holds else others or ""


class _InWords(string.Formatter):
    """Puts numbers and names of arguments into words."""

    def get_field(self, name: str, args: Sequence[Any], numbers: Mapping[str, Any]) -> Any:
        argument, _, value = name.partition("=")
        if argument[0] != "@":
            return numbers[name], name
        return called(argument[1:], value == "True" or value or None), name

    def format_field(self, value: Any, how: str) -> str:
        return _written(value, how)


_FORMATTER = _InWords()


def _written(value: Any, how: str) -> str:
    """Write a number or several, as a format says."""
    if isinstance(value, tuple):
        return _several(value, how)
    match how.split():
        case ["in", "ohm"]:
            return engineering(value, "ohm")
        case ["in", unit, *digits] if not isinstance(value, str):
            return in_words(value, None if unit == "None" else unit, *map(int, digits))
        case ["in", *_]:
            return str(value)
        case [digits, "digits"]:
            return decimal(value, int(digits))
        case ["short"]:
            return str(value.brief)
        case ["lost"]:  # by what is left
            return _per_cent(abs(value - 1))
        case ["factor"]:  # by what it exceeds 1
            return f"{1 + float(f'{value:.2g}'):.3g}"
    return f"{100 * value:{how[:-1]}}%" if how[-2:] == "g%" else format(value, how)


def _several(values: tuple[Any, ...], how: str) -> str:
    """Write several numbers or names."""
    words = list(map(str, values))
    match how:
        case "and":
            return listed(words)
        case "few":
            return listed_in_short(words)
        case "count":
            return str(len(values))
        case "changed":
            return _changes(*values)
    if how in _JOINTS:
        return _JOINTS[how].join(words)
    joint, _, each = how.partition(" ")
    words = [_written(value, each) for value in values]
    return _JOINTS[joint].join(dict.fromkeys(words) if joint == "to" else words)


def _changes(height: float, slope: float) -> str:
    """What a step does to rms height and slope, by what it left of them."""
    verbs: dict[str, list[str]] = {}
    for share, of in ((height, "height"), (slope, "slope")):
        if abs(share - 1) >= UNCHANGED:
            verb = "lowers" if share < 1 else "raises"
            verbs.setdefault(verb, []).append(f"the rms {of} by {_per_cent(abs(share - 1))}")
    changes = " and ".join(f"{verb} {' and '.join(which)}" for verb, which in verbs.items())
    return changes or "changes neither rms height nor rms slope"


def _per_cent(share: float) -> str:
    if 0.995 <= share < 1:
        return "more than 99%"
    return f"{100 * share:.2g}%" if share < 0.1 else f"{share:.0%}"


def _read(lines: Sequence[str]) -> Mapping[str, FactKind]:
    """Read the kinds of a file."""
    words: list[tuple[str, list[str]]] = []
    for line in lines:
        if line[:2] == "  ":
            words[-1][1].append(line[2:])
        elif line and line[0] != "#":
            words.append((line, []))
    return dict(_kind(*each) for each in words)


def _kind(head: str, lines: Sequence[str]) -> tuple[str, FactKind]:
    """A kind and its name, from the lines that it is written in."""
    name, _, settings = head.partition(": ")
    start = next((i for i, line in enumerate(lines) if line[0] in "=+"), len(lines))
    short, rest = " ".join(lines[:start]), " ".join(lines[start:])
    full = short + rest[1:] if rest[:1] == "+" else rest[2:] or short
    given = [each for each in settings.split(", ") if each]
    about = next((_ABOUT[each] for each in given if each in _ABOUT), LIMITS)
    weights: list[Weight] = [each for each in get_args(Weight) if each in given]
    return name, FactKind(short, full, about, *weights)


KINDS: dict[str, FactKind] = {}
"""All kinds by their names; those that are met alone need only be added."""

for _file in sorted(Path(__file__).parent.glob("*.txt")):
    KINDS |= _read(_file.read_text("utf-8").splitlines())
