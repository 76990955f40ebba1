"""Verdicts of the studies, and how many realisations would decide where a sample does not."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from roughline.report.page import Table
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Verdict, joint_verdict, verdict

_COUNTLESS = 100_000  # realisations above which the mean lies on the border of the range


@dataclass(frozen=True)
class WidenedInterval:
    """Interval of a mean, widened by an error of the grid.

    Attributes
    ----------
    low, high : float
        Its ends.
    least, most : float
        Range that the error of the grid alone leaves open for the mean, within these ends.
    """

    low: float
    least: float
    most: float
    high: float

    @classmethod
    def of(cls, estimate: IntervalEstimate) -> WidenedInterval:
        """Return the interval of a mean of which the grid leaves nothing open."""
        return cls(estimate.low, estimate.value, estimate.value, estimate.high)


@dataclass(frozen=True)
class Judgement:
    """What a sample says of a statement.

    Attributes
    ----------
    verdict : Verdict
        On the statement.
    enough : float
        Realisations that would decide where this sample does not, by its scatter; infinite where
        the grid's error leaves it open, NaN where the sample decides.
    """

    verdict: Verdict
    enough: float

    @property
    def what_would_decide(self) -> str:
        """How many realisations would decide; empty where the sample does."""
        if math.isnan(self.enough):
            return ""
        if math.isinf(self.enough):
            return "finer grids would decide"
        return f"{number_in_words(self.enough)} surfaces would decide"

    @property
    def in_words(self) -> str:
        """The verdict, and what would decide."""
        if not self.what_would_decide:
            return str(self.verdict)
        return f"{self.verdict} ({self.what_would_decide})"


@dataclass(frozen=True)
class Finding:
    """A statement, what was found, and the verdict.

    Attributes
    ----------
    statement, found, interval : str
        What is said, what was found, and its 95 % interval.
    judgement : Judgement
        On it.
    where : str
        For which spectra the verdict is not the commonest one, if they differ.
    """

    statement: str
    found: str
    interval: str
    judgement: Judgement
    where: str


def finding_of_cases(
    statement: str, found: str, interval: str, parts: Mapping[str, Judgement]
) -> Finding:
    """Put a statement about several cases together, which are judged one by one."""
    judgements = list(parts.values())
    where = where_others(list(parts.items()))
    return Finding(statement, found, interval, judged_together(judgements), where)


def confidence_of_each(cases: int, level: float = 0.95) -> float:
    """Return the level of each interval for all to hold together at a level (Bonferroni)."""
    return 1 - (1 - level) / cases


def findings_table(findings: Sequence[Finding]) -> Table:
    """Return statements with their verdicts as a table."""
    rows = [
        (
            each.statement,
            each.found,
            each.interval,
            each.judgement.in_words + (f"; {each.where}" if each.where else ""),
        )
        for each in findings
    ]
    return Table(("What is said", "Found here", "95 % interval", "Verdict"), rows, (), 3)


def where_others(parts: Sequence[tuple[str, Judgement]]) -> str:
    """Name the cases of every verdict but the commonest, and that one."""
    cases: dict[Verdict, list[str]] = {}
    for name, part in parts:
        cases.setdefault(part.verdict, []).append(name)
    commonest = max(cases, key=lambda each: len(cases[each]))
    others = {found: names for found, names in cases.items() if found is not commonest}
    if not others:
        return ""
    said = [f"{found} for {', '.join(names)}" for found, names in others.items()]
    return "; ".join([*said, f"else {commonest}"])


def number_in_words(enough: float) -> str:
    """Write a number of realisations that would decide, to two digits, as it is known no better."""
    if enough > _COUNTLESS:
        return f"over {_COUNTLESS:,}"
    digits = 1 - math.floor(math.log10(enough))
    return f"some {math.ceil(round(enough, digits)):,}"


def judged(interval: WidenedInterval, count: int, least: float, most: float) -> Judgement:
    """Judge one interval by the range that a statement allows.

    Parameters
    ----------
    interval : WidenedInterval
        What was found.
    count : int
        Realisations that it is of.
    least, most : float
        The range.
    """
    found = verdict(interval.low, interval.high, least, most)
    if found is not Verdict.UNDECIDED:
        return Judgement(found, math.nan)
    return Judgement(found, count * growth_to_decide(interval, least, most)[0])


def judged_together(parts: Sequence[Judgement]) -> Judgement:
    """Judge a statement about several cases; what decides all that are open decides."""
    whole = joint_verdict(each.verdict for each in parts)
    enough = [each.enough for each in parts if each.verdict is Verdict.UNDECIDED]
    return Judgement(whole, max(enough) if whole is Verdict.UNDECIDED else math.nan)


def growth_to_decide(interval: WidenedInterval, least: float, most: float) -> tuple[float, bool]:
    """By what factor an ensemble has to grow to decide, and whether to refute.

    Intervals shrink as the square root of the realisations; what the grid leaves open stays.
    """
    low, high = interval.low, interval.high
    if interval.most < least:
        return ((high - interval.most) / (least - interval.most)) ** 2, True
    if interval.least > most:
        return ((interval.least - low) / (interval.least - most)) ** 2, True
    if interval.least <= least or interval.most >= most:
        return math.inf, False
    widths = (
        (interval.least - low) / (interval.least - least),
        (high - interval.most) / (most - interval.most),
    )
    return max(widths) ** 2, False
