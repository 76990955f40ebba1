"""Numbers that claims are about, and how many realisations would decide where a sample does not."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Claim, ClaimCase, Range, Verdict, places, verdict


@dataclass(frozen=True)
class Found:
    """A number with its interval, widened by an error of the grid."""

    low: float  # of the interval, as `high`
    # range that the error of the grid alone leaves open for the number, within these ends
    least: float
    most: float
    high: float
    count: int  # realisations that it is of

    @classmethod
    def of(cls, estimate: IntervalEstimate, count: int) -> Found:
        """Return a number of which the grid leaves nothing open."""
        return cls(estimate.low, estimate.value, estimate.value, estimate.high, count)

    @property
    def value(self) -> float:
        """The number, in the middle of what the grid leaves open."""
        return (self.least + self.most) / 2

    def judged(self, where: str, allowed: Range) -> ClaimCase:
        """Judge the number by the range that a statement allows."""
        found = verdict(self.low, self.high, *allowed)
        if found is not Verdict.UNDECIDED:
            return ClaimCase(where, found)
        return ClaimCase(where, found, self.count * growth_to_decide(self, allowed)[0])


def growth_to_decide(found: Found, allowed: Range) -> tuple[float, bool]:
    """By what factor an ensemble has to grow to decide, and whether to refute.

    Intervals shrink as the square root of the realisations; what the grid leaves open stays.
    """
    least, most = allowed
    if found.most < least:
        return ((found.high - found.most) / (least - found.most)) ** 2, True
    if found.least > most:
        return ((found.least - found.low) / (found.least - most)) ** 2, True
    if found.least <= least or found.most >= most:
        return math.inf, False
    widths = (
        (found.least - found.low) / (found.least - least),
        (found.high - found.most) / (most - found.most),
    )
    return max(widths) ** 2, False


def claim_on(
    statement: str,
    what: str,
    found: Mapping[str, Found],
    allowed: Range | Mapping[str, Range],
    form: str,
    *,
    each: bool = True,
) -> Claim:
    """Return a claim that the numbers of several cases lie in a range, or each in its own.

    The numbers are told by where they are, every one, or else the smallest and the largest.
    """
    numbers = list(found.values())
    cases = [
        number.judged(where, allowed[where] if isinstance(allowed, Mapping) else allowed)
        for where, number in found.items()
    ]
    if each:
        told = f"{', '.join(f'{one.value:{form}}' for one in numbers)} {places(found)}"
        interval = ", ".join(spread((one.low, one.high), form) for one in numbers)
    else:
        told = spread((one.value for one in numbers), form)
        interval = spread((end for one in numbers for end in (one.low, one.high)), form)
    return Claim.of(statement, f"{what}: {told}", interval, cases)


def confidence_of_each(cases: int, level: float = 0.95) -> float:
    """Return the level of each interval for all to hold together at a level (Bonferroni)."""
    return 1 - (1 - level) / cases


def spread(values: Iterable[float], form: str = ".2f") -> str:
    """Write the smallest and the largest of some values, once where they are written alike."""
    every = list(values)
    smallest, largest = f"{min(every):{form}}", f"{max(every):{form}}"
    return smallest if smallest == largest else f"{smallest} to {largest}"


def cell(estimate: IntervalEstimate, form: str = ".2f", to: str = "-") -> str:
    """Write a number with its interval, or a dash where it is not known."""
    if math.isnan(estimate.value):
        return "-"
    return f"{estimate.value:{form}} ({estimate.low:{form}}{to}{estimate.high:{form}})"


def change(estimate: IntervalEstimate, form: str = "+.1%") -> str:
    """Write a relative change with its interval."""
    return cell(estimate, form, " to ")
