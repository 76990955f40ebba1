"""What can be set on the page: each control declared once, for the page and for its reader."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypeVar

import roughline as rl
from roughline.errors.checks import shown
from roughline.units import engineering, in_si, refuse_decimal_comma

VERSION = "1"
"""Of the addresses; one of another version is refused."""

STRANGE = "this question is not one of the lab: reload the page"
"""What is said of a question that no page of this lab asks."""

_LONGEST_TEXT = 1000  # of the text of a control

_PAGE_PARAMETERS = ("view", "theme")  # parameters of an address that are no part of a view's state
_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?\s*", re.IGNORECASE | re.ASCII)
_SLIDER_DIGITS = 4  # with which pages have written the ends of their sliders
_COMPUTED_DIGITS = 12  # of a number that is computed from a text with a unit

Texts = Mapping[str, str]
_Read = TypeVar("_Read")


class ControlError(rl.InputError):
    """The value that a control of the page is set to cannot be used."""

    def __init__(self, message: str, at: str = "", *others: str) -> None:
        super().__init__(message)
        self.at = at  # key of the control; empty for the whole view
        self.among = (at, *others)  # keys of all controls that do not go together


@dataclass(frozen=True, kw_only=True)
class Control:
    """One value that is set on a page: from this follow its control, its address and its code.

    It is read over the scales of the state that those before it make, where it has scales.
    """

    key: str  # its name in the address, and in the state
    name: str  # the same in words
    default: Any
    meaning: str  # one sentence, with its unit

    def read(self, text: str, state: Any = None) -> Any:
        """Return the value in a text, or raise a ControlError."""
        raise NotImplementedError

    def text(self, value: Any) -> str:
        """A value as an address has it."""
        return str(value)

    def read_in(self, texts: Texts, state: Any = None) -> Any:
        """Return the value in the text of this control, or its default if there is no text."""
        return self.read(texts[self.key], state) if self.key in texts else self.usual

    @property
    def usual(self) -> Any:
        """The value where there is no text."""
        return self.default


@dataclass(frozen=True, kw_only=True)
class Number(Control):
    """A number, set by a slider or as text; with its unit it is divided by a scale."""

    symbol: str  # what the field calls it
    low: float
    high: float
    # how the slider runs; "whole" allows whole numbers alone
    scale: Literal["linear", "logarithmic", "whole"] = "logarithmic"
    step: float = 0.02  # of the slider: in the number or, on a logarithmic scale, in decades
    unit: str = ""  # in which it may be given; empty for none
    state_scale: Callable[[Any], float] = float  # gives the scale of a state, in the unit
    over: str = ""  # what the scale is called

    def read(self, text: str, state: Any = None) -> float:
        """Return the number in a text, over the scale of a state if it has its unit."""
        if self.unit and has_unit(text):
            return self._over_scale(text, state)
        try:
            refuse_decimal_comma(text, self.name)
            if not is_number(text) or math.isinf(float(text)):
                raise rl.InputError(f"{self.name} is {shown(text)}")
        except rl.InputError as error:
            raise ControlError(f"{error}; give a number {self.range}", self.key) from None
        return self.checked(float(text))

    def text(self, value: float) -> str:
        """A number with the fewest digits that are read as the same."""
        return as_text(value)

    def in_unit(self, text: str, state: Any) -> float:
        """The number in a text with a unit, in the unit of the control."""
        return in_si(text, self.unit, self.name)

    def _over_scale(self, text: str, state: Any) -> float:
        try:
            value = self.in_unit(text, state)
        except rl.UnitError as error:
            raise ControlError(str(error), self.key) from None
        scale = self.state_scale(state)
        try:
            return self.checked(rounded(value / scale))
        except ControlError:
            unit = self.unit.replace("**2", "²")
            low, high = (engineering(end * scale, unit, 3) for end in (self.low, self.high))
            raise ControlError(
                f"{self.name} is {shown(text.strip())}; give one from {low} to {high}, which is "
                f"{self.range} {self.over}",
                self.key,
            ) from None

    def checked(self, value: float) -> float:
        """Return a number in range; an end that is written with fewer digits is the end."""
        for end in (self.low, self.high) if self.scale != "whole" else ():
            if any(
                value == float(f"{end:.{n}g}") for n in range(_SLIDER_DIGITS, _COMPUTED_DIGITS + 1)
            ):
                return end
        if not self.low <= value <= self.high:
            raise ControlError(f"{self.name} is {value:.6g}; give a number {self.range}", self.key)
        if self.scale != "whole":
            return value
        if value != math.floor(value):
            raise ControlError(f"{self.name} is {value:g}; give a whole number", self.key)
        return int(value)

    @property
    def range(self) -> str:
        """The range in words."""
        return f"from {self.low:g} to {self.high:g}"


@dataclass(frozen=True, kw_only=True)
class Choice(Control):
    """One of several words, which stand for values; the default is a word."""

    options: Mapping[str, str]  # by the word in the address, what the page shows
    of: Callable[[str], Any] = str  # gives the value of a word

    def read(self, text: Any, state: Any = None) -> Any:
        """Return the value of a word if it is one of them, or raise a ControlError."""
        if text not in self.options:
            allowed = ", ".join(self.options)
            raise ControlError(f"{self.name} is {shown(text)}; allowed are {allowed}", self.key)
        return self.of(text)

    @property
    def usual(self) -> Any:
        """The value of the default."""
        return self.of(self.default)


@dataclass(frozen=True, kw_only=True)
class Several(Choice):
    """Some of several words, with commas between; the default is all of their values."""

    is_needed: bool = False  # whether there has to be one

    def read(self, text: str, state: Any = None) -> tuple[Any, ...]:
        """Return the values of the words."""
        words = [word for word in text.split(",") if word]
        strange = [word for word in words if word not in self.options]
        if strange or (self.is_needed and not words):
            why = f"{self.name} is {shown(strange[0])}" if strange else f"no {self.name} is chosen"
            allowed = ", ".join(self.options)
            raise ControlError(f"{why}; choose one or more of {allowed}", self.key)
        return tuple(self.of(word) for word in dict.fromkeys(words))

    @property
    def usual(self) -> tuple[Any, ...]:
        """The default."""
        return tuple(self.default)

    def text(self, value: tuple[Any, ...]) -> str:
        """The words with commas between."""
        return ",".join(f"{each:g}" if isinstance(each, float) else str(each) for each in value)


@dataclass(frozen=True, kw_only=True)
class QuantityText(Control):
    """A quantity with its unit, which stays as it was typed."""

    label: str  # what the field calls it
    unit: str
    ends: tuple[float, float]  # that are allowed, in the unit

    def read(self, text: str, state: Any = None) -> str:
        """Return the text, if it is such a quantity."""
        try:
            value = in_si(text, self.unit, self.name)
        except rl.UnitError as error:
            raise ControlError(str(error), self.key) from None
        if not self.ends[0] <= value <= self.ends[1]:
            low, high = (engineering(end, self.unit) for end in self.ends)
            sentence = f"{self.name} is {shown(text)}; give one from {low} to {high}"
            raise ControlError(sentence, self.key)
        return text.strip()


def is_number(text: str) -> bool:
    """Whether a text is a number without a unit."""
    return _NUMBER.fullmatch(text) is not None


def has_unit(text: str) -> bool:
    """Whether something follows the number that a text begins with."""
    number = _NUMBER.match(text)
    return number is not None and number.end() < len(text)


def rounded(value: float) -> float:
    """A number that was computed from a text with a unit, without the rounding of that."""
    return float(f"{value:.{_COMPUTED_DIGITS}g}")


def as_code(value: float) -> str:
    """A number as lines of code have it, without the rounding of what it was computed from."""
    return repr(rounded(value))


def as_text(value: float) -> str:
    """A number as an address has it: the fewest digits that are read as the same number."""
    return repr(float(value)).removesuffix(".0")


def sent_texts(arguments: Mapping[str, Any], name: str = "state") -> Texts:
    """Return the texts of the controls by their keys, as a page sends them in an argument."""
    texts = arguments.get(name)
    if not isinstance(texts, Mapping):
        raise ControlError(STRANGE)
    for key, text in texts.items():
        if not isinstance(text, str):
            raise ControlError(STRANGE, key)
    return texts


def usable(
    arguments: Mapping[str, Any],
    read: Callable[[Texts], _Read],
    as_texts: Callable[[_Read], Texts],
    needed: Texts | None = None,
) -> tuple[_Read, dict[str, str]]:
    """Read the texts of the controls; for one that cannot be used, the one before it counts.

    Of the arguments of a task, "state" has the texts, those changed last at its end, "before" those
    that were used last, and "red" the keys of those that were refused last, where there are any.
    `read` reads texts or raises the first ControlError, and `told` gives all of what was read as
    texts again; `needed` has those of controls that may not be empty, where no other can be used.

    Returns what was read, and sentences by the keys of controls whose text is not used. Where
    controls do not go together, the one that was changed counts as before, not the others. What is
    wrong with the whole address, or with no text of a control, is raised.
    """
    sent, needed = sent_texts(arguments), needed or {}
    before = sent_texts(arguments, "before") if "before" in arguments else {}
    texts, refused = dict(sent), {}
    changed = _changed(sent, before, arguments.get("red"))
    for key in changed:
        if len(sent[key]) > _LONGEST_TEXT:
            refused[key] = f"this text has {len(sent[key])} characters; give a shorter one"
            _replace(texts, key, before, needed)
    while True:
        try:
            found = read(texts)
        except ControlError as error:
            wrong = [key for key in changed if key in error.among and key not in refused]
            wrong += [key for key in error.among if texts.get(key) != needed.get(key)]
            if error.at == "v" or not wrong:
                raise
            _replace(texts, wrong[0], {} if wrong[0] in refused else before, needed)
            refused.setdefault(wrong[0], str(error))
            continue
        used = {**as_texts(found), **texts}
        return found, {
            key: f"{sentence}; {used.get(key, '').strip() or 'none'} is used meanwhile"
            for key, sentence in refused.items()
        }


def _changed(sent: Texts, before: Texts, red: Any) -> list[str]:
    """Keys of changed controls: those that are red already, then what was changed last."""
    red = red if isinstance(red, list) else []
    changed = [key for key in sent if sent[key] != before.get(key)]
    return sorted(changed, key=lambda key: key in red)[::-1]


def _replace(texts: dict[str, str], key: str, *others: Texts) -> None:
    """Take the first of the other texts of a control, or none."""
    texts.pop(key, None)
    if found := [each[key] for each in others if key in each]:
        texts[key] = found[0]


def refuse_strange(sent: Mapping[str, str], known: Collection[str]) -> None:
    """Refuse an address of another version, and parameters that are no keys of a view."""
    wrong, version = "", sent.get("v", VERSION)
    strange = [name[:40] for name in sent if name not in (*known, "v", *_PAGE_PARAMETERS)]
    if version != VERSION:
        wrong = f'this link is of version "{version[:20]}" of the lab\'s addresses, and this lab '
        wrong += f"reads version {VERSION}"
    elif strange:
        wrong = f'the link sets "{strange[0]}", which this lab does not know: it may be of another '
        wrong += "version"
    if wrong:
        raise ControlError(f"{wrong}; set the controls by hand", "v")
