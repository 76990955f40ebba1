"""Statements about several cases: their verdicts, and how what was found is written."""

from __future__ import annotations

import math

from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Verdict
from roughline.units import decimal
from studies.judged import (
    Finding,
    Judgement,
    WidenedInterval,
    finding_of_cases,
    judged,
)


def judged_below(first: IntervalEstimate, second: IntervalEstimate, count: int) -> Judgement:
    """Judge that a load is below another."""
    if first.high < second.low:
        return Judgement(Verdict.CONFIRMED, math.nan)
    if first.low > second.high:
        return Judgement(Verdict.REFUTED, math.nan)
    apart = math.log(second.value / first.value)
    widths = math.log(first.high / first.value) + math.log(second.value / second.low)
    enough = count * (widths / apart) ** 2 if apart > 0 else math.nan
    return Judgement(Verdict.UNDECIDED, enough)


def judged_at_least(decades: tuple[float, float], wanted: float) -> Judgement:
    """Judge a range that is surely, and perhaps, some decades long."""
    sure, perhaps = decades
    if sure >= wanted:
        return Judgement(Verdict.CONFIRMED, math.nan)
    return Judgement(Verdict.REFUTED if perhaps < wanted else Verdict.UNDECIDED, math.nan)


def over_side(force: IntervalEstimate, size: int) -> IntervalEstimate:
    """Return a load over E* h L from one over E* h lambda_r."""
    return IntervalEstimate(force.value / size, force.low / size, force.high / size)


def load_in_words(load: IntervalEstimate) -> str:
    """Write a load; where the exponent passes outside the loads, on which side."""
    if not math.isnan(load.value):
        return decimal(load.value, 2)
    if math.isnan(load.low):
        return f"less than {decimal(load.high, 2)}"
    return f"more than {decimal(load.low, 2)}"


def load_interval(load: IntervalEstimate) -> str:
    """Write the interval of a load."""
    return between_ends(load.low, load.high, " to ")


def between_ends(low: float, high: float, to: str = "-") -> str:
    """Write the ends of an interval, of which one may be open."""
    if math.isnan(low):
        return "not told" if math.isnan(high) else f"< {decimal(high, 2)}"
    if math.isnan(high):
        return f"> {decimal(low, 2)}"
    return f"{decimal(low, 2)}{to}{decimal(high, 2)}"


def judged_near(found: IntervalEstimate, value: float, count: int) -> Judgement:
    """Judge that an exponent has a value, within the tolerance of exponents."""
    ends = (value - EXPONENT_TOLERANCE, value + EXPONENT_TOLERANCE)
    return judged(WidenedInterval.of(found), count, *ends)


def range_of_cases(
    statement: str,
    what: str,
    found: list[IntervalEstimate],
    parts: dict[str, Judgement],
    form: str,
) -> Finding:
    """Put a statement about many cases together, with the range of what was found."""
    return finding_of_cases(
        statement,
        f"{what}: {min(each.value for each in found):{form}} to "
        f"{max(each.value for each in found):{form}}",
        f"{min(each.low for each in found):{form}} to {max(each.high for each in found):{form}}",
        parts,
    )


def each_case(
    statement: str,
    what: str,
    found: dict[str, IntervalEstimate],
    parts: dict[str, Judgement],
    form: str,
) -> Finding:
    """Put a statement about several cases together."""
    return finding_of_cases(
        statement,
        f"{what}: {', '.join(f'{each.value:{form}}' for each in found.values())} "
        f"({'; '.join(found)})",
        ", ".join(f"{each.low:{form}} to {each.high:{form}}" for each in found.values()),
        parts,
    )
