"""All rules of answers, and how one of one's own is added."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import get_args

import numpy as np

from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Answer, Group, Rule
from roughline.engineering.rules.acoustic import ACOUSTIC
from roughline.engineering.rules.contact import CONTACT
from roughline.engineering.rules.electrical import ELECTRICAL
from roughline.engineering.rules.mechanical import MECHANICAL
from roughline.engineering.rules.thermal import THERMAL
from roughline.errors import InputError
from roughline.errors.checks import one_of, refuse
from roughline.errors.public import public

GROUPS: tuple[Group, ...] = get_args(Group)
"""Groups of answers, in the order in which pages show them."""


@public
class Rules:
    """The rules by which answers are worked out: a group at a time, in the order of pages."""

    def __init__(self, declared: Sequence[Rule]) -> None:
        self._by_key = {rule.key: rule for rule in declared}

    def __iter__(self) -> Iterator[Rule]:
        """Rules one by one, group by group."""
        return iter(sorted(self._by_key.values(), key=lambda rule: GROUPS.index(rule.group)))

    def __getitem__(self, key: str) -> Rule:
        """The rule of a key.

        Raises
        ------
        InputError
            If there is none of that key.
        """
        return self._by_key[one_of("key", key, self._by_key)]

    def add(self, rule: Rule) -> None:
        """Add a rule: its answer then stands in every assessment, table, file and report.

        Raises
        ------
        InputError
            If it is no Rule, of no group, or its key or symbol is that of another.
        """
        if not isinstance(rule, Rule):
            refuse("rule", rule, "give a Rule, as rl.Rule(key=..., ...)")
        one_of("group", rule.group, GROUPS)
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

    def left_out(self, pair: MaterialPair, frequency: float | None) -> list[str]:
        """Say which answers there are not, as a property of a material is missing.

        Parameters
        ----------
        pair : MaterialPair
            The materials.
        frequency : float or None
            Of an ultrasonic wave, if its reflection is asked for. [Hz]
        """
        return list(dict.fromkeys(filter(None, (each.lacking(pair, frequency) for each in self))))

    def answers(self, pressed: Pressed) -> tuple[dict[str, Answer], list[str]]:
        """Work out all answers by their keys, and say which are left out, and why."""
        answers: dict[str, Answer] = {}
        left_out = self.left_out(pressed.pair, pressed.frequency)
        for rule in self:
            lacks = rule.lacking(pressed.pair, pressed.frequency)
            answer = None if lacks else rule.answer(pressed)
            if answer is None:
                continue
            if text := _why_not_used(answer, pressed):
                left_out.append(f"no {answer.name}: {text}")
            else:
                answers[rule.key] = answer
        return answers, left_out


def _why_not_used(answer: Answer, pressed: Pressed) -> str:
    """Say why an answer cannot be used; an empty text if it can."""
    values, solved = answer.values, pressed.known
    if values.shape != solved.shape:
        return f"its rule gives {values.size} values, and there are {solved.size} loads"
    unknown = solved & (np.isnan(values) | (np.isinf(values) & (not answer.rule.may_be_infinite)))
    if unknown.any():
        value = values[np.flatnonzero(unknown)[0]]
        return f"its rule gives {value:g} under a load that was solved, which is not finite"
    return ""


rules = Rules([*MECHANICAL, *CONTACT, *ELECTRICAL, *THERMAL, *ACOUSTIC])
"""By which all answers are worked out."""
