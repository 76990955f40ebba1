"""A fact that stands with answers: its kind, its numbers, and what it concerns.

Whoever finds a fact tells numbers, and none recognises one by its words: these are made where it is
shown, by one function for each kind.
"""

from __future__ import annotations

import functools
import inspect
import textwrap
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, Generic, Literal, ParamSpec

from roughline.errors.checks import refuse

Subject = Literal["What was done to the data", "What the intervals include", "Limits"]
"""What facts are about, as pages head them."""

DATA: Subject = "What was done to the data"
INTERVALS: Subject = "What the intervals include"
LIMITS: Subject = "Limits"

Weight = Literal["grave", "warning", "note"]
"""Grave: the answers do not hold, or are of something else than was asked about."""

LINE = 91
"""Letters of the longest text in short: a line of 100, with "warning: " before it."""

Wording = str | tuple[str, str]
"""The words of a fact: in short, and in full; or one text for both."""

_Parameters = ParamSpec("_Parameters")


class FactKind(Generic[_Parameters]):
    """A kind of fact, by the function that words it; called with its numbers, it makes a fact.

    Parameters
    ----------
    words : callable
        Returns the words, from numbers in SI units and names. What it says in short has one line of
        at most 91 letters: what, how much, and what to do.
    about : str
        DATA, INTERVALS or LIMITS.
    weight : str
        "grave", "warning" or "note": of such a fact, unless it says otherwise.
    """

    def __init__(
        self, words: Callable[_Parameters, Wording], about: Subject, weight: Weight = "warning"
    ) -> None:
        functools.update_wrapper(self, words)
        self.words, self.about, self.weight = words, about, weight
        self.name = words.__name__
        self._signature = inspect.signature(words)

    def __call__(self, *args: _Parameters.args, **kwargs: _Parameters.kwargs) -> Fact:
        """Make a fact with these numbers."""
        numbers = self._signature.bind(*args, **kwargs)
        numbers.apply_defaults()
        return Fact(self, numbers.arguments, about=self.about, weight=self.weight)

    def __repr__(self) -> str:
        return f"<kind of fact: {self.name}>"

    def __reduce__(self) -> str:
        """Travel to other processes by name."""
        return self.name


def kind(
    about: Subject, weight: Weight = "warning"
) -> Callable[[Callable[_Parameters, Wording]], FactKind[_Parameters]]:
    """Decorate the function that words a kind of fact."""
    return lambda words: FactKind(words, about, weight)


@dataclass(frozen=True)
class Fact:
    """Something worth telling; ``str`` words it in full.

    Attributes
    ----------
    kind : FactKind
        What it is.
    numbers : mapping of str to Any
        By name: numbers in SI units, names, and facts that it is made of.
    of : tuple of str
        Keys of the answers that it concerns; none if it concerns all of them.
    about : str
        DATA, INTERVALS or LIMITS.
    weight : str
        "grave", "warning" or "note".
    """

    kind: FactKind[Any]
    numbers: Mapping[str, Any] = field(default_factory=dict)
    of: tuple[str, ...] = ()
    about: Subject = LIMITS
    weight: Weight = "warning"

    def __post_init__(self) -> None:
        if not isinstance(self.kind, FactKind):
            refuse("kind", self.kind, "a kind of fact, which has words, is needed")
        self.kind._signature.bind(**self.numbers)
        object.__setattr__(self, "numbers", MappingProxyType(dict(self.numbers)))

    def __hash__(self) -> int:
        return hash((self.kind.name, self.of, self.about, self.weight))

    def __reduce__(self) -> tuple[Any, ...]:
        return Fact, (self.kind, dict(self.numbers), self.of, self.about, self.weight)

    def __str__(self) -> str:
        words = self.kind.words(**self.numbers)
        return words if isinstance(words, str) else words[1]

    @property
    def in_short(self) -> str:
        """The same in one line of at most 91 letters."""
        words = self.kind.words(**self.numbers)
        return textwrap.shorten(
            words if isinstance(words, str) else words[0], LINE, placeholder="…"
        )

    @property
    def is_grave(self) -> bool:
        """Whether the answers do not hold, or are of something else than was asked about."""
        return self.weight == "grave"

    @property
    def is_warning(self) -> bool:
        """Whether it is more than a note."""
        return self.weight != "note"

    @property
    def innermost(self) -> Fact:
        """The fact that it says something further about; itself if there is none."""
        inner = self.numbers.get("fact")
        return inner.innermost if isinstance(inner, Fact) else self

    @property
    def without_numbers(self) -> tuple[Any, ...]:
        """What it has in common with facts that differ in their numbers alone."""
        return self.kind.name, *(_unnumbered(each) for each in self.numbers.items())

    def concerning(self, *keys: str) -> Fact:
        """The same of some answers, by their keys."""
        return replace(self, of=keys)

    def as_(self, weight: Weight) -> Fact:
        """The same with another weight."""
        return replace(self, weight=weight)

    def grave(self, is_so: bool = True) -> Fact:
        """The same as grave, if it is so."""
        return replace(self, weight="grave") if is_so else self

    def within(self, outer: Fact) -> Fact:
        """What says something further about it, of the same answers and with the same weight."""
        return replace(outer, of=self.of, about=self.about, weight=self.weight)


def grave_first(facts: Iterable[Fact]) -> list[Fact]:
    """Return facts in their order, but for grave ones, which come first."""
    return sorted(facts, key=lambda each: not each.is_grave)


def _unnumbered(value: Any) -> Any:
    """Leave numbers out of what a fact holds."""
    if isinstance(value, Fact):
        return value.without_numbers
    if isinstance(value, tuple | list):
        return tuple(map(_unnumbered, value))
    return value if isinstance(value, str | bool) or value is None else "number"
