"""An answer, and the rule that it follows from: all that is known of it stands there."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal, get_args

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.measures import Measure
from roughline.engineering.intervals import Ends
from roughline.engineering.margin import MATTERS, Margin, Reason, multiple
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import Pressed
from roughline.engineering.sealing import Fluid
from roughline.engineering.symbols import Symbol
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, refuse, several, shown
from roughline.errors.public import are_numbers, public
from roughline.facts.fact import Fact

_Group = Literal[
    "mechanics", "contact", "adhesion", "friction", "sealing", "electrical", "thermal", "acoustic"
]
"""What an answer is about."""

_GROUPS: tuple[_Group, ...] = get_args(_Group)  # in the order in which pages show them

_Facts = Fact | Sequence[Fact | None] | None

Limits = tuple[Real | float, Real | float]
"""Least and largest possible value, over the loads or at all of them."""


def within(ends: Ends, limits: Limits) -> Ends:
    """Ends of an interval, as far as they are within limits."""
    return np.maximum(ends[0], limits[0]), np.minimum(ends[1], limits[1])


def always(_pressed: Pressed) -> bool:
    """Whatever was pressed."""
    return True


@public
@dataclass(frozen=True, eq=False)
class Rule:
    """One answer: what it is, how it follows from what was pressed, and within which limits.

    Parameters
    ----------
    key : str
        Name by which the answer is found, such as "contact_stiffness".
    name, symbol, unit : str
        What it is called in tables and formulas; the unit is SI.
    group : str
        "mechanics", "contact", "adhesion", "friction", "sealing", "electrical", "thermal" or
        "acoustic": what it is about.
    formula : str
        How it follows, in words and symbols.
    value : callable
        Works it out from what was pressed: an array of shape (loads,) or, with both ends of its
        interval in either order, (3, loads); None where there is no such answer. [unit]
    symbols : callable, optional
        What its formula uses that is no answer: a :class:`~roughline.Symbol` for each. Pages show
        those that stand in the formula. Default: none.
    validity, source : str, optional
        Where the formula holds, and its publication.
    differing : callable, optional
        Texts that differ for what was pressed: name, symbol, formula, validity or source, by
        these names.
    lacking : callable, optional
        Says which property of two materials is missing for it, from these and the frequency of the
        wave that is asked for, if one is: a fact, such as that of ``pair.lacks(...)`` or
        :func:`roughline.own_words`, or None where none is.
    unknown : callable, optional
        Says why loads that were solved have no value, which is NaN then: a fact, or None where all
        have one. Without it, an answer with a value that is no number is left out as a fault of its
        rule.
    facts : callable, optional
        What is to be said with it of what was pressed: a fact, several, or None for nothing.
    limits : callable, optional
        Least and largest possible value, beyond which no interval reaches; default: from zero on.
        [unit]
    under : callable, optional
        Key of an answer that this one never exceeds, and the factor of that one's upper end.
    leads : callable, optional
        Whether a page begins with it. Default: never.
    answers_question : callable, optional
        Whether it is what something was asked for beside the contact, as a pull-off force is of
        bodies that stick. It leads then, and stands first, and its group before all others.
        Default: never.
    is_shown_at_many_loads : bool, optional
        Whether tables of many loads, which have no room for all answers, show it though it does not
        lead.
    is_extensive : bool, optional
        Whether it grows or falls with the nominal area under the same mean pressure.
    is_given : bool, optional
        Whether it stands without an interval, as loads and depths do.
    in_per_cent : bool, optional
        Whether it is written in per cent.
    may_be_infinite : bool, optional
        Whether infinity is a value of it, as of a stiffness in full contact. An answer that is not
        finite is left out otherwise, with a note that says so.
    measures : sequence of Measure or callable, optional
        What it needs from the fields of every load: ``pressed.measure(name)`` returns them, in
        rows. A callable returns them from both materials, and from the fluid in the gap or None.

    Examples
    --------
    An answer of one's own stands in every table, file and report once it is added:

    >>> import roughline as rl
    >>> energy = rl.Rule(
    ...     key="stored_energy",
    ...     name="energy at constant stiffness",
    ...     symbol="W",
    ...     unit="J",
    ...     group="mechanics",
    ...     formula="F² / (2 k_u)",
    ...     value=lambda pressed: pressed.force**2 / (2 * pressed.unloading),
    ... )
    >>> rl.rules.add(energy)
    >>> surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, rng=7)
    >>> question = rl.Question(surface, materials="steel,copper", loads="10 N", elastic=True)
    >>> answer = rl.assess(question).answers["stored_energy"]
    >>> print(answer.name, answer.unit, answer.values.size)
    energy at constant stiffness J 1
    >>> rl.rules.remove("stored_energy")
    """

    key: str
    name: str
    symbol: str
    unit: str
    group: _Group
    formula: str
    value: Callable[[Pressed], Real | None]
    validity: str = ""
    source: str = ""
    symbols: Callable[[Pressed], Sequence[Symbol]] = lambda _pressed: ()
    differing: Callable[[Pressed], Mapping[str, str]] = lambda _pressed: {}
    lacking: Callable[[MaterialPair, float | None], Fact | None] = lambda _pair, _frequency: None
    unknown: Callable[[Pressed], Fact | None] = lambda _pressed: None
    facts: Callable[[Pressed], _Facts] = lambda _pressed: None
    limits: Callable[[Pressed], Limits] = lambda _pressed: (0.0, np.inf)
    under: Callable[[Pressed], tuple[str, float]] | None = None
    leads: Callable[[Pressed], bool] = lambda _pressed: False
    answers_question: Callable[[Pressed], bool] = lambda _pressed: False
    is_shown_at_many_loads: bool = False
    is_extensive: bool = False
    is_given: bool = False
    in_per_cent: bool = False
    may_be_infinite: bool = False
    measures: Sequence[Measure] | Callable[[MaterialPair, Fluid | None], Sequence[Measure]] = ()

    def __post_init__(self) -> None:
        for name, annotation in type(self).__annotations__.items():
            value = getattr(self, name)
            if annotation.startswith("Callable") and value is not None and not callable(value):
                refuse(name, value, "a function is needed, such as lambda pressed: pressed.force")

    def _checked_rows(self, rows: Any) -> Real:
        """Return values, and both ends of their interval where there are three rows."""
        values = np.atleast_2d(rows) if are_numbers(rows) else np.empty((0, 0))
        if values.ndim != 2 or len(values) not in (1, 3):
            raise InputError(
                f"value of the rule {shown(self.key)} returned {shown(rows)}; numbers of shape "
                "(loads,) or, with both ends of the interval, (3, loads) are needed, or None for "
                "no answer"
            )
        return values

    def _checked_limits(self, limits: Any) -> Limits:
        """Return the least and the largest possible value."""
        both = several(limits)
        if len(both) != 2 or not all(map(are_numbers, both)) or np.any(np.greater(*both)):
            raise InputError(
                f"limits of the rule {shown(self.key)} returned {shown(limits)}; the least and "
                "the largest possible value are needed, in this order, such as (0.0, np.inf)"
            )
        return both[0], both[1]

    def answer(self, pressed: Pressed) -> Answer | None:
        """Work out the answer; None where there is none."""
        rows = self.value(pressed)
        if rows is None:
            return None
        values, *ends = self._checked_rows(rows)
        limits = self._checked_limits(self.limits(pressed))
        low, high = within((np.minimum(*ends), np.maximum(*ends)), limits) if ends else (None, None)
        names = ("name", "symbol", "formula", "validity", "source")
        texts = {name: getattr(self, name) for name in names}
        texts |= self.differing(pressed)
        is_first = self.answers_question(pressed)
        for name in ("formula", "validity"):
            texts[name] = re.sub(r"\bk_[ui]\b", lambda k: pressed.symbols[k[0]], texts[name])
        return Answer(
            self,
            values,
            low,
            high,
            **texts,
            symbols=[each for each in self.symbols(pressed) if each.is_in(texts["formula"])],
            limits=limits,
            under=None if self.under is None else self.under(pressed),
            leads=is_first or self.leads(pressed),
            answers_question=is_first,
            facts=tuple(each.concerning(self.key) for each in self._returned("facts", pressed)),
        )

    def _returned(self, what: str, *of: Any) -> list[Fact]:
        """What is to be said with the answer, or in its place."""
        found = getattr(self, what)(*of)
        facts = found if isinstance(found, tuple | list) else [found]
        if not all(each is None or isinstance(each, Fact) for each in facts):
            raise InputError(
                f"{what} of the rule {shown(self.key)} returned {shown(found)}; a fact is needed, "
                'such as rl.own_words("..."), or None for nothing'
            )
        return [each for each in facts if each is not None]


@dataclass(frozen=True, eq=False)
class Answer:
    """One quantity over the loads.

    Attributes
    ----------
    rule : Rule
        That it follows from.
    values : ndarray, shape (loads,)
        NaN where a load was not solved. [unit]
    low, high : ndarray, shape (loads,), or None
        Ends of the interval; None where it is not known. Uncertainties that are not known are not
        in it. [unit]
    name, symbol : str
        What it is called in tables and formulas.
    formula : str
        How it follows from the curve.
    validity : str
        Where the formula holds.
    source : str
        Publication of the formula.
    symbols : sequence of Symbol
        What the formula uses that is no answer.
    limits : tuple
        Least and largest possible value. [unit]
    under : tuple of (str, float), or None
        Key of an answer that it never exceeds, and the factor of that one's upper end.
    leads : bool
        Whether a page begins with it.
    answers_question : bool
        Whether it is what something was asked for beside the contact.
    facts : tuple of Fact
        What is to be said with it.
    margins : sequence of Margin
        How far each cause alone leaves it open: independent ones add in squares, and the scatter of
        the hardness bounds what they leave.
    """

    rule: Rule = field(repr=False)
    values: Real
    low: Real | None
    high: Real | None
    name: str
    symbol: str
    formula: str
    validity: str = ""
    source: str = ""
    symbols: Sequence[Symbol] = ()
    limits: Limits = (0.0, np.inf)
    under: tuple[str, float] | None = None
    leads: bool = False
    answers_question: bool = False
    facts: tuple[Fact, ...] = ()
    margins: Sequence[Margin] = ()

    def why(self, load: int = -1) -> list[Reason]:
        """Say why it is not known better under a load: what leaves it open, the most first.

        Parameters
        ----------
        load : int, optional
            Number of the load among those that were asked for, from 0; negative ones count from the
            last.

        Returns
        -------
        list of Reason
            Each with its ends over the value, as it alone leaves them open, and what would narrow
            it; those that are not known first. Empty where nothing moves it, and of a load that was
            not solved.

        Raises
        ------
        InputError
            If there is no such load.
        """
        count = self.values.size
        if not (isinstance(load, int) and -count <= load < count):
            refuse("load", load, f"a number from 0 to {count - 1} is needed")
        value = self.values[load]
        found = []
        for each in () if np.isnan(value) else self.margins:
            if not each.factor[load] <= MATTERS:
                low, high = (multiple(end[load], value) for end in each.ends)
                found.append(Reason(each.cause, each.title, each.remedy, low, high, each.is_bound))
        return sorted(found, key=lambda each: -np.nan_to_num(each.factor, nan=np.inf))

    @property
    def key(self) -> str:
        """Name by which it is found, such as "contact_stiffness"."""
        return self.rule.key

    @property
    def unit(self) -> str:
        """SI unit."""
        return self.rule.unit

    @property
    def is_of_larger(self) -> bool:
        """Whether it is about the surface that a map was cut out of, rather than about the map."""
        return any(each.is_of_larger for each in self.margins)

    @property
    def ends(self) -> Ends | None:
        """Both ends of its interval. [unit]"""
        return None if self.low is None or self.high is None else (self.low, self.high)

    @property
    def rows(self) -> Real:
        """Values, and both ends where they are known, (1 or 3, loads). [unit]"""
        return np.stack([self.values, *(self.ends or ())])

    @property
    def without_interval(self) -> Answer:
        """Answer without its interval."""
        return replace(self, low=None, high=None)


@public
class Rules:
    """The rules by which answers are worked out: a group at a time, in the order of pages."""

    def __init__(self, rules: Iterable[Rule] = ()) -> None:
        self._by_key: dict[str, Rule] = {}
        for rule in rules:
            self.add(rule)

    def __iter__(self) -> Iterator[Rule]:
        """Rules one by one, group by group."""
        return iter(sorted(self._by_key.values(), key=lambda rule: _GROUPS.index(rule.group)))

    def __getitem__(self, key: str) -> Rule:
        """The rule of a key.

        Raises
        ------
        InputError
            If there is none of that key.
        """
        return self._by_key[allowed_choice("key", key, self._by_key)]

    def add(self, rule: Rule) -> None:
        """Add a rule: its answer then stands in every assessment, table, file and report.

        Raises
        ------
        InputError
            If it is no Rule, of no group, or its key or symbol is that of another.
        """
        if not isinstance(rule, Rule):
            refuse("rule", rule, "give a Rule, as rl.Rule(key=..., ...)")
        allowed_choice("group", rule.group, _GROUPS)
        for other in self:
            if rule.key == other.key or rule.symbol == other.symbol:
                same = "key" if rule.key == other.key else "symbol"
                raise InputError(
                    f'has the {same} "{getattr(rule, same)}" of the {other.name}; give another, '
                    "or remove that one first (rl.rules.remove)",
                    "rule",
                )
        self._by_key[rule.key] = rule

    def remove(self, key: str) -> None:
        """Remove a rule.

        Raises
        ------
        InputError
            If there is none of that key.
        """
        del self._by_key[self[key].key]

    def measures(self, pair: MaterialPair, sealing: Fluid | None) -> list[Measure]:
        """What the rules need from the fields of every load, each once.

        Some of it only where a fluid in the gap is asked for, or of some materials.
        """
        found = [
            each
            for rule in self
            for each in (rule.measures(pair, sealing) if callable(rule.measures) else rule.measures)
        ]
        return list(dict.fromkeys(found))

    def left_out(self, pair: MaterialPair, frequency: float | None) -> list[Fact]:
        """Say which answers there are not, as a property of a material is missing.

        The frequency [Hz] is that of an ultrasonic wave, if its reflection is asked for.
        """
        found = [fact for each in self for fact in each._returned("lacking", pair, frequency)]
        return [each.as_("note") for each in dict.fromkeys(found)]

    def answers(self, pressed: Pressed) -> tuple[dict[str, Answer], list[Fact]]:
        """Work out all answers by their keys, and say which are left out, and why.

        What was asked for beside the contact comes first, with its group.
        """
        answers: dict[str, Answer] = {}
        left_out: dict[Fact, list[Fact]] = {}  # answers by why
        unanswered = set()  # why something that was asked for is not answered
        for rule in self:
            lacks = rule._returned("lacking", pressed.pair, pressed.frequency)
            answer = None if lacks else rule.answer(pressed)
            if answer is None:
                continue
            why, share = _why_not_used(answer, pressed)
            if why:
                of = Fact(
                    "answer_under_loads", name=answer.name, share=share if share < 1 else None
                )
                left_out.setdefault(why, []).append(of)
                if rule.answers_question(pressed):
                    unanswered.add(why)
            if share < 1:
                answers[rule.key] = answer
        return _in_order(answers), [
            *self.left_out(pressed.pair, pressed.frequency),
            *(
                Fact("without_answer", names=tuple(of), why=why).grave(why in unanswered)
                for why, of in left_out.items()
            ),
        ]


def _in_order(answers: Mapping[str, Answer]) -> dict[str, Answer]:
    """Answers in groups, those that answer the question before the others of their group."""
    asked = {each.rule.group for each in answers.values() if each.answers_question}

    def place(item: tuple[str, Answer]) -> tuple[bool, int, bool]:
        group = item[1].rule.group
        return group not in asked, _GROUPS.index(group), not item[1].answers_question

    return dict(sorted(answers.items(), key=place))


def _why_not_used(answer: Answer, pressed: Pressed) -> tuple[Fact | None, float]:
    """Say why an answer cannot be used, and under which share of the loads that were solved."""
    values, solved = answer.values, pressed.known
    if values.shape != solved.shape:
        return Fact("shape_of_values", values=values.size, loads=solved.size), 1.0
    unknown = solved & (np.isnan(values) | (np.isinf(values) & (not answer.rule.may_be_infinite)))
    if not unknown.any():
        return None, 0.0
    for why in answer.rule._returned("unknown", pressed):
        return why, float(unknown[solved].mean())
    return Fact("not_finite", value=f"{values[np.flatnonzero(unknown)[0]]:g}"), 1.0
