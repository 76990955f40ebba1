"""The answers of a body, or of several maps of a part: in large figures, in groups, as tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.assessment.part import PartAnswer, PartAssessment
from roughline.contact.status import Status
from roughline.facts.fact import Fact
from roughline.report.page import Headline, KeyFigure, sentence
from roughline.report.values import Write, with_interval
from roughline.units import decimal, engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.engineering.rule import Answer

IF_ELASTIC = "if nothing yielded"
"""Heads the answers that elastic bodies would give."""

UNRESOLVED = "fewer than ten points in contact: the grid decides, not the surface"
"""Meaning of the star after a load."""

NO_MEAN = "-"
"""Written where maps have no common value."""

MOST_WARNINGS = 3
"""Warnings that a page or a screen begins with, a line each."""

_MOST_FIGURES = 5  # that a page begins with, beside what was asked for
_GIVEN_SCATTER = 1e-6  # scatter below which a quantity was given, and did not come out


@dataclass(frozen=True)
class _AnswerGroup:
    """Answers about one thing, by their keys, and those that stand for them all.

    These are what was asked for, or the first leading one, or else the first.
    """

    name: str
    keys: Sequence[str]
    headlines: Sequence[str]

    @property
    def headline(self) -> str:
        """The one that stands for them all."""
        return self.headlines[0]


def groups(result: Assessment | PartAssessment) -> list[_AnswerGroup]:
    """The groups of its answers, in their order."""
    asked, leading, keys = asked_keys(result), leading_keys(result), dict[str, list[str]]()
    for key, each in result.answers.items():
        keys.setdefault(each.rule.group, []).append(key)
    return [
        _AnswerGroup(
            name,
            some,
            [key for key in some if key in asked]
            or [next((key for key in some if key in leading), some[0])],
        )
        for name, some in keys.items()
    ]


def asked_keys(result: Assessment | PartAssessment) -> list[str]:
    """Keys of the answers that something was asked for beside the contact."""
    if isinstance(result, PartAssessment):
        asked = {key for each in result.assessments for key in asked_keys(each)}
        return [key for key in result.answers if key in asked]
    return [key for key, each in result.answers.items() if each.answers_question]


def leading_keys(result: Assessment | PartAssessment) -> list[str]:
    """Keys of the answers that a page begins with; those of a part lead on one of its maps."""
    if isinstance(result, PartAssessment):
        # some maps may yield, and others not
        keys = max(map(leading_keys, result.assessments), key=len)
        return [key for key in keys if key in result.answers]
    return [key for key, each in result.answers.items() if each.leads]


def figure_keys(result: Assessment | PartAssessment) -> list[str]:
    """Keys of the answers in large figures: what was asked for, and of each group the first.

    Others that lead follow as long as there is room.
    """
    asked, leading = asked_keys(result), leading_keys(result)
    first = [key for each in groups(result) for key in each.headlines if key in leading]
    further = [key for key in leading if key not in first]
    room = _MOST_FIGURES - len({*first} - {*asked})
    chosen = {*first, *further[: max(room, 0)]}
    return [key for key in result.answers if key in chosen]


def in_full(fact: Fact) -> str:
    """A fact as a sentence, which says whether it is a warning."""
    return sentence(f"warning: {fact}" if fact.is_warning else str(fact))


def headline(result: Assessment | PartAssessment, write: Write = with_interval) -> Headline:
    """The first warnings, the large figures at the largest load, and what stands below them."""
    leading = leading_keys(result)
    figures = [
        KeyFigure.of(each.name, quantity(each, result.largest, write))
        for each in (result.answers[key] for key in figure_keys(result))
    ]
    below = [elastic_in_words(result)]
    if isinstance(result, PartAssessment) and leading and len(result.names) > 1:
        answer = result.answers[leading[0]]
        scatter = scatter_in_words(answer, result.largest)
        below.insert(0, f"places scatter by {scatter} in {answer.name}")
    return Headline(
        figures,
        [sentence(each.in_short) for each in result.facts[:MOST_WARNINGS] if each.is_warning],
        " ".join(map(sentence, filter(None, below))),
    )


def lead_sentence(result: Assessment | PartAssessment) -> str:
    """What was asked: both materials, and the largest load; of a body, with its nominal area."""
    pair, joint = result.question.pair, result.question.joint
    if pair is None:
        return ""
    on_joint = "" if joint is None else f"a joint of {engineering(joint, 'm²')}"
    if isinstance(result, PartAssessment):
        maps, no_mean = result.assessments, not leading_keys(result)
        under = result.headings[result.largest] + (f" on {on_joint}" if on_joint else "")
    else:
        maps, no_mean = [result], False
        force, pressure = (
            quantity(result.answers[key], result.largest)
            for key in ("normal_force", "mean_pressure")
        )
        under = f"{force}, {pressure} over {on_joint or 'the nominal area'}"
    count = len(result.headings)
    which = f", the largest of {count} loads" if count > 1 else ""
    faces = ", against" if pair.coated else " on"  # a layer lies on its base
    text = f"{pair.first.name}{faces} {pair.second.name} under {under}{which}"
    if no_mean:
        return sentence(f"{text}: the maps have no common mean")
    unsure = any(_is_decided_by_grid(each)[result.largest] for each in maps)
    return sentence(text + (f" ({UNRESOLVED})" if unsure else ""))


def answer_in_words(
    result: Assessment | PartAssessment, key: str, write: Write = with_interval
) -> str:
    """Name and value of an answer at the largest load."""
    answer = result.answers[key]
    return f"{answer.name} {answer.symbol} {quantity(answer, result.largest, write)}"


def elastic_in_words(result: Assessment | PartAssessment) -> str:
    """Say what the leading answers would be of elastic bodies, at the largest load.

    Answers that yield does not change by more than their interval are left out.
    """
    i, texts = result.largest, []
    for key in leading_keys(result):
        elastic = result.elastic.get(key)
        if elastic is not None and _differs(elastic, result.answers[key], i):
            texts.append(f"{elastic.name} {_value_alone(elastic, i)}")
    return f"for comparison, {IF_ELASTIC}: {', '.join(texts)}" if texts else ""


def answer_table(
    result: Assessment | PartAssessment,
    loads: Sequence[int] | None = None,
    keys: Sequence[str] | None = None,
    *,
    with_elastic: bool = False,
    write: Write = with_interval,
) -> tuple[list[str], list[list[str]]]:
    """Header and rows of the answers, or of some of them, at all loads or at some of them.

    The answers of a part have a column for their scatter between maps. `with_elastic` puts the
    answer of elastic bodies below where yield changes it by more than its interval.
    """
    headings, of_part = starred(result), isinstance(result, PartAssessment)
    chosen = range(len(headings)) if loads is None else loads
    header = [""]
    for i in chosen:
        header += [headings[i], "scatter"] if of_part else [headings[i]]
    rows = []
    for key in result.answers if keys is None else keys:
        each = result.answers[key]
        rows.append(
            [
                f"{each.name} {each.symbol}",
                *(cell for i in chosen for cell in _cells(each, i, write)),
            ]
        )
        elastic = result.elastic.get(key) if with_elastic else None
        if elastic is not None and any(_differs(elastic, each, i) for i in chosen):
            blank = [""] if of_part else []
            cells = [cell for i in chosen for cell in (_value_alone(elastic, i, write), *blank)]
            rows.append([IF_ELASTIC, *cells])
    return header, rows


def load_table(
    result: Assessment | PartAssessment, keys: Sequence[str]
) -> tuple[list[str], list[list[str]]]:
    """Header and rows of some answers, with a row for each load; leading answers come first."""
    leading = [key for key in leading_keys(result) if key in keys]
    with_scatter = isinstance(result, PartAssessment) and len(result.names) > 1
    header, rows = ["load"], [[heading] for heading in starred(result)]
    for each in (result.answers[key] for key in dict.fromkeys((*leading, *keys))):
        header.append(f"{each.name} {each.symbol}")
        header += [f"scatter of {each.symbol}"] if with_scatter else []
        for i, row in enumerate(rows):
            row += _cells(each, i) if with_scatter else [quantity(each, i)]
    return header, rows


def counted(
    result: Assessment | PartAssessment,
    *,
    with_elastic: bool = False,
    write: Write = with_interval,
) -> list[tuple[str, str, int]]:
    """Name, headline and number of rows of each group, for a page that folds one table."""

    def rows(group: _AnswerGroup) -> list[list[str]]:
        return answer_table(result, keys=group.keys, with_elastic=with_elastic)[1]

    return [
        (each.name, answer_in_words(result, each.headline, write), len(rows(each)))
        for each in groups(result)
    ]


def quantity(answer: Answer | PartAnswer, i: int, write: Write = with_interval) -> str:
    """Write one value of an answer, with its interval where that is known; of a part, its mean."""
    return _written(answer, i, _ends(answer, i), write)


def scatter_in_words(answer: PartAnswer, i: int) -> str:
    """Write the scatter of an answer between maps: per cent where small, a factor where large."""
    factor = float(answer.scatter[i])
    if np.isnan(factor) or answer.count[i] < 2:
        return NO_MEAN
    if factor < 1 + _GIVEN_SCATTER:
        return "none"
    return f"{100 * (factor - 1):.2g}%" if factor < 1.5 else f"factor {decimal(factor, 3)}"


def written_unit(answer: Answer | PartAnswer) -> str:
    """Unit in which an answer is written: its own, or per cent."""
    return "%" if answer.rule.in_per_cent else answer.unit


def starred(result: Assessment | PartAssessment) -> list[str]:
    """What each load is called, with its mark."""
    return [f"{name}{mark}" for name, mark in zip(result.headings, marks(result), strict=True)]


def marks(result: Assessment | PartAssessment) -> list[str]:
    """What stands behind the name of each load: a star where the grid decides on any of the maps.

    Where a fluid lifts the bodies apart, it is called open.
    """
    if isinstance(result, PartAssessment):
        return [max(some, key=len) for some in zip(*map(marks, result.assessments), strict=True)]
    lifted = result.curve_as_asked.status == Status.LIFTED
    stars = _is_decided_by_grid(result)
    both = zip(lifted, stars, strict=True)
    return [", open" * bool(is_open) + " *" * bool(star) for is_open, star in both]


def has_star(result: Assessment | PartAssessment) -> bool:
    """Whether the grid decides one of the loads that were asked for."""
    return any(mark[-1:] == "*" for mark in marks(result))


def _is_decided_by_grid(assessment: Assessment) -> list[bool]:
    """Which of the loads that were asked for have too few points in contact."""
    curve = assessment.curve_as_asked
    return list(curve.converged & ~curve.resolved & (curve.force > 0))


def _cells(answer: Answer | PartAnswer, i: int, write: Write = with_interval) -> list[str]:
    """One value with its interval; of a part, its scatter as well."""
    scatter = [scatter_in_words(answer, i)] if isinstance(answer, PartAnswer) else []
    return [quantity(answer, i, write), *scatter]


def _value_alone(answer: Answer | PartAnswer, i: int, write: Write = with_interval) -> str:
    return _written(answer, i, None, write)


def _written(
    answer: Answer | PartAnswer, i: int, ends: tuple[float, float] | None, write: Write
) -> str:
    value = _value(answer, i)
    if np.isnan(value) and isinstance(answer, PartAnswer):
        return NO_MEAN
    return write(value, ends, written_unit(answer))


def _value(answer: Answer | PartAnswer, i: int) -> float:
    return float((answer.mean if isinstance(answer, PartAnswer) else answer.values)[i])


def _ends(answer: Answer | PartAnswer, i: int) -> tuple[float, float] | None:
    if answer.low is None or answer.high is None:
        return None
    return float(answer.low[i]), float(answer.high[i])


def _differs(elastic: Answer | PartAnswer, yielding: Answer | PartAnswer, i: int) -> bool:
    """Whether elastic bodies give something else: beyond the interval, or a per cent without."""
    other, value = _value(elastic, i), _value(yielding, i)
    low, high = _ends(yielding, i) or (np.nan, np.nan)
    if np.isnan([low, high]).any():
        low, high = 0.99 * value, 1.01 * value
    return bool(other < low or other > high)
