"""One statement of the paper beside the same number here, and how it is judged."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from roughline.plot.style import dimension_label
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Verdict, joint_verdict, verdict

if TYPE_CHECKING:
    import xarray

    from roughline.paper.laws import DimensionLaws
    from roughline.paper.results import PaperResults
    from roughline.paper.windows import Window

STIFFNESS_TOLERANCE = 0.10
"""How near stiffnesses must come, as a share."""
EXACT = "exact"
"""Stands for the interval of a number that does not come from a sample."""

BOTH_MODELS = "lines with the waves and the loads of the surfaces, across this range"
"""What a comparison of the two models needs."""

Cases = Sequence[tuple[float, IntervalEstimate]]
"""A number with its interval for each fractal dimension."""

Range = tuple[float, float]
"""Smallest and largest number that a statement allows."""


@dataclass(frozen=True)
class Claim:
    """One statement of the paper beside the same number here.

    Attributes
    ----------
    statement : str
        What the paper says, and where.
    found : str
        The same number here.
    interval : str
        Its 95 % interval, or why it has none.
    basis : str
        Window of F̄, averaging and grid.
    verdict : Verdict
        On the statement as a whole: one refuted case refutes it.
    cases : str
        The verdict in words, case by case where the cases differ.
    """

    statement: str
    found: str
    interval: str
    basis: str
    verdict: Verdict
    cases: str


def claim_about_every_dimension(
    statement: str,
    found: str,
    basis: str,
    cases: Cases,
    allowed: Range,
    form: str = ".3f",
    needed: str = "three loads or more across this range",
) -> Claim:
    """Return a claim about a number that is judged for every fractal dimension.

    Parameters
    ----------
    statement, found, basis : str
        As in :class:`Claim`.
    cases : Cases
        The number that is judged.
    allowed : Range
        What the statement allows.
    form : str, optional
        Format of the numbers in the intervals.
    needed : str, optional
        What the data lack where the number is not known at any fractal dimension.
    """
    if not known(cases):
        return not_judged(statement, basis, needed)
    whole, in_words = by_dimension(cases, allowed)
    return Claim(
        statement=statement,
        found=found,
        interval=intervals(cases, form),
        basis=basis,
        verdict=whole,
        cases=in_words,
    )


def not_judged(statement: str, basis: str, needed: str) -> Claim:
    """Return a claim that the data cannot judge, as they lack what it needs."""
    cases = f"{Verdict.UNDECIDED}: not judged, as these data have no {needed}"
    return Claim(statement, "-", "-", basis, Verdict.UNDECIDED, cases)


def known(cases: Cases) -> Cases:
    """Return the cases whose number is known."""
    return [(d, number) for d, number in cases if math.isfinite(number.value)]


def around(value: float, tolerance: float) -> Range:
    """Return the range of numbers within a tolerance of a value."""
    return value - tolerance, value + tolerance


def by_dimension(cases: Cases, allowed: Range) -> tuple[Verdict, str]:
    """Judge a statement about every fractal dimension; return the verdict, also in words."""
    verdicts = {d: verdict(number.low, number.high, *allowed) for d, number in known(cases)}
    unknown = [dimension_label(d) for d, number in cases if not math.isfinite(number.value)]
    words = [f"not judged at D_f = {', '.join(unknown)}"] if unknown else []
    for each in (Verdict.REFUTED, Verdict.UNDECIDED, Verdict.CONFIRMED):
        dimensions = [dimension_label(d) for d, of_case in verdicts.items() if of_case is each]
        if dimensions and len(dimensions) == len(verdicts):
            return each, "; ".join([str(each), *words])
        if dimensions:
            words.append(f"{each} at D_f = {', '.join(dimensions)}")
    # the verdict comes first
    return joint_verdict(verdicts.values()), "; ".join(sorted(words, key=_is_not_judged))


def _is_not_judged(words: str) -> bool:
    return words.startswith("not judged")


def cases_of(
    laws: Sequence[DimensionLaws], number: Callable[[DimensionLaws], IntervalEstimate]
) -> Cases:
    """Return a number of the laws for each of their fractal dimensions."""
    return [(each.fractal_dimension, number(each)) for each in laws]


def numbers(cases: Cases, form: str = ".3f") -> str:
    """List the numbers of all fractal dimensions."""
    return ", ".join(f"{number.value:{form}}" for _, number in known(cases))


def numbers_by_dimension(cases: Cases, form: str = ".3f") -> str:
    """List the numbers of all fractal dimensions, and which dimensions these are."""
    dimensions = ", ".join(dimension_label(d) for d, _ in known(cases))
    return f"{numbers(cases, form)} at D_f = {dimensions}"


def intervals(cases: Cases, form: str = ".3f") -> str:
    """List the intervals of all fractal dimensions."""
    return ", ".join(
        f"{number.low:{form}} to {number.high:{form}}" if math.isfinite(number.low) else "-"
        for _, number in known(cases)
    )


def basis_in(window: Window, data: xarray.Dataset, averaged: str = "k") -> str:
    """Describe the window, the averaging and the grid of a number."""
    return f"F̄ = {window[0]:.3g} to {window[1]:.3g}; mean {averaged} at fixed F̄; {bodies_of(data)}"


def in_both_models(window: Window, results: PaperResults) -> str:
    """Describe the basis of a number of both models with the same waves."""
    lines = "" if results.matched is None else f", {bodies_of(results.matched)}"
    return basis_in(window, results.full) + lines


def bodies_of(data: xarray.Dataset) -> str:
    """Say how many lines or surfaces an ensemble has, and their points."""
    count, n = data.sizes["realisation"], int(data.attrs["n"])
    if data.attrs["model"] == "reduced":
        power = n.bit_length() - 1
        points = f"2^{power}" if n == 2**power else n
        return f"{count} line{'s' if count > 1 else ''} of {points} points"
    return f"{count} surface{'s' if count > 1 else ''} of {n}²"
