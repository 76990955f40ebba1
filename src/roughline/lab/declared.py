"""What a view declares in its text `declared.txt`, entry by entry, so that its code holds formulae.

[section]
key | part | part
  what it means, in one line or in several; entries without such lines have those of the next
  = word: as the page shows it; word of a choice that is shown as it is
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from importlib.resources import files
from typing import Any, NamedTuple

from roughline.lab.controls import Choice, Number, Several


class Entry(NamedTuple):
    """One entry of a section."""

    parts: list[str]
    lines: list[str]  # below it

    @property
    def meaning(self) -> str:
        """What it means."""
        return " ".join(line for line in self.lines if line[0] != "=")

    @property
    def options(self) -> dict[str, str]:
        """What the page shows for the words of a choice."""
        listed = " ".join(line[1:].strip() for line in self.lines if line[0] == "=")
        pairs = (each.strip().partition(": ") for each in listed.split(";"))
        return {word: shown or word for word, _, shown in pairs}


class NumberScale(NamedTuple):
    """What numbers are over."""

    unit: str
    of: Callable[[Any], float]  # gives it in a state, in that unit
    kind: type[Number] = Number  # of the numbers


def section(room: str, name: str) -> dict[str, Entry]:
    """The entries of a section in the text of a room, by their keys."""
    text = files(room).joinpath("declared.txt").read_text(encoding="utf-8")
    found: dict[str, Entry] = {}
    lines: list[str] = []
    for line in text.partition(f"[{name}]\n")[2].partition("\n[")[0].splitlines():
        if line.startswith("  "):
            lines.append(line.strip())
        elif line:
            key, *parts = map(str.strip, line.split("|"))
            lines = [] if lines else lines
            found[key] = Entry(parts, lines)
    return found


def numbers(room: str, scales: Mapping[str, NumberScale]) -> dict[str, Number]:
    """The numbers of a view: symbol, name, ends, default, how the slider runs, over what."""
    found = {}
    for key, entry in section(room, "numbers").items():
        symbol, name, *ends, slider, over = (*entry.parts, "")[:7]
        run, step = slider.split()
        low, high, default = (int(x) if run == "whole" else float(Fraction(x)) for x in ends)
        scale = scales[over] if over else NumberScale("", float)
        number: dict[str, Any] = {"scale": run, "step": float(step), "meaning": entry.meaning}
        number |= {"low": low, "high": high, "default": default}
        number |= {"unit": scale.unit, "state_scale": scale.of, "over": over}
        found[key] = scale.kind(key=key, symbol=symbol, name=name, **number)
    return found


def choices(room: str, **of: Callable[[str], Any]) -> dict[str, Choice]:
    """The choices of a view: name, default; those without a default are of several words.

    Words stand for themselves, or for what functions make `of` them, by the keys of choices.
    """
    found = {}
    for key, entry in section(room, "choices").items():
        name, *default = entry.parts
        choice: dict[str, Any] = {"options": entry.options, "meaning": entry.meaning}
        choice |= {"default": default[0] if default else (), "of": of.get(key, str)}
        found[key] = (Choice if default else Several)(key=key, name=name, **choice)
    return found
