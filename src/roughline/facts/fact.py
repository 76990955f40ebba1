"""A fact that stands with answers: its kind, its numbers, and what it concerns.

Whoever finds a fact tells numbers, and none recognises one by its words: these are made where it is
shown, from the text of its kind.
"""

from __future__ import annotations

import copy
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, get_args

from attrs import frozen

from roughline.errors.checks import allowed_choice, refuse
from roughline.errors.public import public
from roughline.facts.kinds import KINDS, Subject, Weight, worded

LINE = 91
"""Letters of the longest text in short: a line of 100, with "warning: " before it."""


@frozen(init=False, slots=False)
class Fact:
    """Something worth telling; ``str`` words it in full.

    Parameters
    ----------
    kind : str
        What it is: one of :data:`~roughline.facts.kinds.KINDS`.
    **numbers
        All that its words name: numbers in SI units, names, and facts that it is made of.

    Attributes
    ----------
    kind, numbers
        As they were given.
    of : tuple of str
        Keys of the answers that it concerns; none if it concerns all of them.
    about : str
        DATA, INTERVALS or LIMITS.
    weight : str
        "grave", "warning" or "note".

    Raises
    ------
    InputError
        If there is no such kind, or its words name other numbers.
    """

    kind: str
    numbers: Mapping[str, Any]
    of: tuple[str, ...]
    about: Subject
    weight: Weight

    def __init__(self, kind: str, /, **numbers: Any) -> None:
        known = KINDS.get(kind)
        if known is None or not (known.short and known.full):
            refuse("kind", kind, "a kind of fact, which has words, is needed")
        if numbers.keys() != known.numbers:
            wanted = ", ".join(sorted(known.numbers)) or "none"
            refuse("numbers", ", ".join(numbers) or "none", f"the words of {kind} name {wanted}")
        about, weight = known.about, known.weight
        vars(self).update(kind=kind, numbers=numbers, of=(), about=about, weight=weight)

    def __hash__(self) -> int:
        return hash((self.kind, self.of, self.about, self.weight))

    def __str__(self) -> str:
        return worded(KINDS[self.kind].full, self.numbers)

    @property
    def brief(self) -> str:
        """The same in short, however long names and arguments are."""
        return worded(KINDS[self.kind].short, self.numbers)

    @property
    def in_short(self) -> str:
        """The same in one line of at most 91 letters."""
        return textwrap.shorten(self.brief, LINE, placeholder="…")

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
        return self.kind, *(_unnumbered(each) for each in self.numbers.items())

    def concerning(self, *keys: str) -> Fact:
        """The same of some answers, by their keys."""
        return self._with(of=keys)

    def as_(self, weight: Weight) -> Fact:
        """The same with another weight."""
        return self._with(weight=weight)

    def grave(self, is_so: bool = True) -> Fact:
        """The same as grave, if it is so."""
        return self.as_("grave") if is_so else self

    def within(self, outer: Fact) -> Fact:
        """What says something further about it, of the same answers and with the same weight."""
        return outer._with(of=self.of, about=self.about, weight=self.weight)

    def _with(self, **changes: Any) -> Fact:
        changed = copy.copy(self)
        vars(changed).update(changes)
        return changed


class WithFacts:
    """What has facts, in words."""

    @property
    def facts(self) -> Sequence[Fact]:
        """What is worth telling."""
        return ()

    @property
    def warnings(self) -> list[str]:
        """Where an assumption breaks, or what is suspicious; the gravest come first."""
        return [str(each) for each in self.facts if each.is_warning]

    @property
    def notes(self) -> list[str]:
        """What is left out, and how bodies and loads were prepared."""
        return [str(each) for each in self.facts if not each.is_warning]

    @property
    def remarks(self) -> list[str]:
        """All of both."""
        return [*self.warnings, *self.notes]


@public
def own_words(text: str, weight: Weight = "warning") -> Fact:
    """Tell something in words of one's own, as a rule of one's own does.

    Parameters
    ----------
    text : str
        What is told, without a full stop; a screen shows the first 91 letters.
    weight : str, optional
        "grave", where the answers do not hold, "warning" or "note".

    Returns
    -------
    Fact
        It is shown wherever the answer of its rule is.

    Raises
    ------
    InputError
        If the weight is none of these.

    Examples
    --------
    >>> import roughline as rl
    >>> fact = rl.own_words("tides are left out", "note")
    >>> print(fact, fact.is_warning)
    tides are left out False
    """
    allowed_choice("weight", weight, get_args(Weight))
    return Fact("own_words", text=text).as_(weight)


def by_weight(facts: Iterable[Fact]) -> list[Fact]:
    """Return facts, each once: grave ones first, then warnings, then notes."""
    return sorted(dict.fromkeys(facts), key=lambda each: get_args(Weight).index(each.weight))


def _unnumbered(value: Any) -> Any:
    """Leave numbers out of what a fact holds."""
    if isinstance(value, Fact):
        return value.without_numbers
    if isinstance(value, tuple | list):
        return tuple(map(_unnumbered, value))
    return value if isinstance(value, str | bool) or value is None else "number"
