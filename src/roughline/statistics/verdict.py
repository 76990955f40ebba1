"""Claims and verdicts: an interval is compared with the range that a statement allows."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import groupby
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roughline.statistics.bootstrap import IntervalEstimate

Range = tuple[float, float]
"""Smallest and largest number that a statement allows."""

_MOST_NAMED = 6  # cases of the commonest verdict
_MOST_REALISATIONS = 100_000  # above which the mean lies on the border of the range


class Verdict(StrEnum):
    """What a sample says of a statement.

    Attributes
    ----------
    CONFIRMED
        The whole interval lies within the range that the statement allows.
    REFUTED
        The whole interval lies outside that range.
    UNDECIDED
        The interval lies partly within the range, or there is no interval: the sample does not
        decide.
    """

    CONFIRMED = "confirmed"
    REFUTED = "refuted"
    UNDECIDED = "undecided"


def verdict(low: float, high: float, least: float, most: float) -> Verdict:
    """Judge an interval, low to high, by the range that the statement allows, least to most."""
    if least <= low and high <= most:
        return Verdict.CONFIRMED
    if high < least or low > most:
        return Verdict.REFUTED
    return Verdict.UNDECIDED


def around(value: float, tolerance: float) -> Range:
    """Return the range of numbers within a tolerance of a value."""
    return value - tolerance, value + tolerance


def joint_verdict(verdicts: Iterable[Verdict]) -> Verdict:
    """Judge a statement about several cases: one refuted case refutes the statement."""
    different = set(verdicts)
    if Verdict.REFUTED in different:
        return Verdict.REFUTED
    return Verdict.CONFIRMED if different == {Verdict.CONFIRMED} else Verdict.UNDECIDED


@dataclass(frozen=True)
class ClaimCase:
    """One of the cases that a claim is about."""

    where: str  # which case, with its preposition: "at D_f = 2.0"
    verdict: Verdict | None  # on it; None where the data do not tell the number
    enough: float = math.nan
    """Realisations that would decide where the sample does not.

    Infinite where finer grids would, NaN where it is not known.
    """

    @classmethod
    def together(cls, where: str, parts: Sequence[ClaimCase]) -> ClaimCase:
        """Judge cases as one; what decides all that are open decides."""
        verdict = joint_verdict(each.verdict for each in parts if each.verdict)
        needed = [each.enough for each in parts if each.verdict is Verdict.UNDECIDED]
        return cls(where, verdict, max(needed) if verdict is Verdict.UNDECIDED else math.nan)


@dataclass(frozen=True)
class Claim:
    """A statement beside the same number here, and the verdict."""

    statement: str  # what is said, and where
    found: str  # the same number here
    interval: str  # its 95 % interval, or why it has none
    basis: str  # what the number is of: window, averaging, grid
    verdict: Verdict  # on the statement as a whole: one refuted case refutes it
    cases: str  # the verdict in words, case by case where the cases differ
    allowed: str = "-"  # the range that the statement allows, in words
    # the numbers that were judged, by their cases, and that range; nothing where no range decides
    numbers: Mapping[str, IntervalEstimate] = field(default_factory=dict)
    within: Range = (-math.inf, math.inf)

    @classmethod
    def of(
        cls,
        statement: str,
        found: str,
        interval: str,
        cases: Sequence[ClaimCase],
        basis: str = "",
        allowed: str = "-",
    ) -> Claim:
        """Return a claim about several cases, which are judged one by one."""
        verdict = joint_verdict(each.verdict for each in cases if each.verdict)
        return cls(statement, found, interval, basis, verdict, in_words(cases), allowed)


def in_words(cases: Sequence[ClaimCase]) -> str:
    """Say the verdict, case by case where the cases differ, and what would decide.

    Cases of the commonest verdict are not named if they are many.
    """
    decided = sum(each.verdict is not None for each in cases)
    words: list[str] = []
    for each in (Verdict.REFUTED, Verdict.UNDECIDED, Verdict.CONFIRMED, None):
        parts = [case for case in cases if case.verdict is each]
        if not parts:
            continue
        where = f" {places(case.where for case in parts)}"
        if each and len(parts) == decided:
            where = ""
        elif each and len(parts) > max(_MOST_NAMED, decided / 2):
            where = " elsewhere" if words else ""
        words.append(f"{each or 'not judged'}{where}{_what_would_decide(parts)}")
    return "; ".join(words)


def places(wheres: Iterable[str]) -> str:
    """List cases; neighbours that differ in the last word alone share the others."""
    ends = (each.rpartition(" ")[::2] for each in wheres)
    shared = groupby(ends, key=lambda each: each[0])
    return ", ".join(f"{first} {', '.join(last for _, last in of_it)}" for first, of_it in shared)


def _what_would_decide(cases: Sequence[ClaimCase]) -> str:
    """Say in brackets how many surfaces would decide, or that finer grids would."""
    needed = [each.enough for each in cases if not math.isnan(each.enough)]
    if not needed:
        return ""
    if math.isinf(most := max(needed)):
        return " (finer grids would decide)"
    return f" ({about(most)} surfaces would decide)"


def about(count: float) -> str:
    """Write a number of realisations to two digits, as it is known no better."""
    if count > _MOST_REALISATIONS:
        return f"over {_MOST_REALISATIONS:,}"
    digits = 1 - math.floor(math.log10(count))
    return f"some {math.ceil(round(count, digits)):,}"
