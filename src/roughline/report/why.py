"""Why answers are not known better: in words, and as bars of what each cause alone leaves open."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from roughline.engineering.margin import Reason, multiple
from roughline.facts.listed import listed
from roughline.report.page import Bar, BarGroup, Bars
from roughline.report.values import with_interval
from roughline.units import decimal

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.engineering.rule import Answer

TITLE = "Why it is not known better"
"""Heads what leaves answers open."""

_TOGETHER = "all together"
_NO_INTERVAL = "without an interval"
_LONGEST_AXIS = 100.0  # times the value, beyond which an axis does not reach, nor below its inverse
_SHORTEST_AXIS = 1.1  # times the value, up to which an axis reaches at least
_TICKS_APART = 15.0  # distance of labels that would touch each other [% of the axis]


def bars(assessment: Assessment, keys: Iterable[str]) -> Bars | None:
    """What leaves some answers open at the largest load; None if nothing does.

    Answers that the same leaves open to the same ends stand together.
    """
    load = assessment.largest
    open_answers = [each for key in keys if (each := assessment.answers[key]).why(load)]
    if not open_answers:
        return None
    reasons = {each.key: _reasons(each, load) for each in open_answers}
    axis = _BarAxis.of(each for some in reasons.values() for each in some)
    groups: dict[tuple[Bar, ...], list[Answer]] = {}
    for answer in open_answers:
        made = tuple(_bar(answer, load, each, axis) for each in reasons[answer.key])
        groups.setdefault(made, []).append(answer)
    named = [
        BarGroup(listed([f"{each.name} {each.symbol}" for each in answers]), made)
        for made, answers in groups.items()
    ]
    about = _about(assessment, [each for some in reasons.values() for each in some])
    return Bars(TITLE, about, axis.ticks, axis.place(1.0), named)


def why_in_words(assessment: Assessment, keys: Iterable[str]) -> list[tuple[str, str]]:
    """Names of answers, and what leaves each open at the largest load, the most first."""
    load, found = assessment.largest, []
    for answer in (assessment.answers[key] for key in keys):
        if reasons := answer.why(load):
            texts = [f"{each.title}: {_ends_in_words(answer, load, each)}" for each in reasons]
            found.append((answer.name, "; ".join(texts)))
    return found


def _about(assessment: Assessment, reasons: Sequence[Reason]) -> str:
    """What bars show, and how they add up."""
    headings = assessment.headings
    under = f" under {headings[assessment.largest]}" if len(headings) > 1 else ""
    widening = dict.fromkeys(each.title for each in reasons if each.is_bound)
    text = (
        f"What each cause alone leaves open{under}, the most first, as multiples of the value. "
        "Independent causes add in squares"
    )
    return text + (f"; {listed(list(widening))} widens what they leave." if widening else ".")


def _reasons(answer: Answer, load: int) -> list[Reason]:
    """The whole interval of an answer over its value, and below it what leaves it open."""
    low, high = math.nan, math.nan
    if answer.ends is not None:
        low, high = (multiple(each[load], answer.values[load]) for each in answer.ends)
    return [Reason("", _TOGETHER, "", low, high), *answer.why(load)]


def _bar(answer: Answer, load: int, reason: Reason, axis: _BarAxis) -> Bar:
    """A bar of one cause, or of the whole interval; none where its ends are not known."""
    words, has_multiples = _ends_in_words(answer, load, reason), 0 < answer.values[load] < math.inf
    if not (reason.is_known and has_multiples):
        return Bar(reason.title, words, reason.remedy)
    left, right = axis.place(reason.low), axis.place(reason.high)
    return Bar(reason.title, words, reason.remedy, left, round(right - left, 2))


def _ends_in_words(answer: Answer, load: int, reason: Reason) -> str:
    """Both ends over the value; of what is zero or infinite, the other end with its unit."""
    if not reason.is_known:
        return reason.ends_in_words if reason.cause else _NO_INTERVAL
    value = answer.values[load]
    if 0 < value < math.inf:
        return reason.ends_in_words
    by_cause = {each.cause: each.ends for each in answer.margins}
    low, high = by_cause.get(reason.cause) or answer.ends or (answer.values, answer.values)
    end = with_interval(float((high if value == 0 else low)[load]), None, answer.unit)
    return f"up to {end}" if value == 0 else f"{end} or more"


@dataclass(frozen=True)
class _BarAxis:
    """A logarithmic axis of multiples of a value, from below one to above it."""

    low: float
    high: float

    @classmethod
    def of(cls, reasons: Iterable[Reason]) -> _BarAxis:
        """As long as what some reasons leave open needs, as far as it may reach."""
        ends = [end for each in reasons if each.is_known for end in (each.low, each.high)]
        some = [end for end in ends if 0 < end < math.inf]  # others have no place on it
        low, high = min([1 / _SHORTEST_AXIS, *some]), max([_SHORTEST_AXIS, *some])
        return cls(_outward(max(low, 1 / _LONGEST_AXIS), -1), _outward(min(high, _LONGEST_AXIS), 1))

    def place(self, ratio: float) -> float:
        """Where a multiple of the value is on the axis; beyond its ends, there. [% of it]"""
        within = min(max(ratio, self.low), self.high)
        return round(100 * math.log(within / self.low) / math.log(self.high / self.low), 2)

    @property
    def ticks(self) -> Mapping[str, float]:
        """Places of the value and of both ends of the axis, by what stands there."""
        value = self.place(1.0)
        found = {decimal(self.low, 2): 0.0, "1": value, decimal(self.high, 2): 100.0}
        return {
            name: at for name, at in found.items() if at == value or abs(at - value) > _TICKS_APART
        }


def _outward(ratio: float, sign: int) -> float:
    """A ratio rounded to two digits, down or up."""
    digit = 10.0 ** (math.floor(math.log10(ratio)) - 1)
    rounded = math.ceil(sign * ratio / digit - 1e-9)  # what has two digits already stays
    return sign * rounded * digit
