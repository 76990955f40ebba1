"""One statement of the paper beside the same number here, and how it is judged."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Verdict, joint_verdict, verdict

if TYPE_CHECKING:
    import xarray

    from roughline.paper.laws import DimensionLaws
    from roughline.paper.windows import Window

STIFFNESS_TOLERANCE = 0.10
"""How near stiffnesses must come, as a share."""
EXACT = "exact"
"""Stands for the interval of a number that does not come from a sample."""

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
    statement: str, found: str, basis: str, cases: Cases, allowed: Range, form: str = ".3f"
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
    """
    whole, in_words = by_dimension(cases, allowed)
    return Claim(
        statement=statement,
        found=found,
        interval=intervals(cases, form),
        basis=basis,
        verdict=whole,
        cases=in_words,
    )


def around(value: float, tolerance: float) -> Range:
    """Return the range of numbers within a tolerance of a value."""
    return value - tolerance, value + tolerance


def by_dimension(cases: Cases, allowed: Range) -> tuple[Verdict, str]:
    """Judge a statement about every fractal dimension; return the verdict, also in words."""
    verdicts = {d: verdict(number.low, number.high, *allowed) for d, number in cases}
    words = []
    for each in (Verdict.REFUTED, Verdict.UNDECIDED, Verdict.CONFIRMED):
        dimensions = [f"{d:.1f}" for d, of_case in verdicts.items() if of_case is each]
        if len(dimensions) == len(verdicts):
            return each, str(each)
        if dimensions:
            words.append(f"{each} at D_f = {', '.join(dimensions)}")
    return joint_verdict(verdicts.values()), "; ".join(words)


def cases_of(
    laws: Sequence[DimensionLaws], number: Callable[[DimensionLaws], IntervalEstimate]
) -> Cases:
    """Return a number of the laws for each of their fractal dimensions."""
    return [(each.fractal_dimension, number(each)) for each in laws]


def numbers(cases: Cases, form: str = ".3f") -> str:
    """List the numbers of all fractal dimensions."""
    return ", ".join(f"{number.value:{form}}" for _, number in cases)


def numbers_by_dimension(cases: Cases, form: str = ".3f") -> str:
    """List the numbers of all fractal dimensions, and which dimensions these are."""
    return f"{numbers(cases, form)} at D_f = {', '.join(f'{d:.1f}' for d, _ in cases)}"


def intervals(cases: Cases, form: str = ".3f") -> str:
    """List the intervals of all fractal dimensions."""
    return ", ".join(f"{number.low:{form}} to {number.high:{form}}" for _, number in cases)


def basis_in(window: Window, data: xarray.Dataset, averaged: str = "k") -> str:
    """Describe the window, the averaging and the grid of a number."""
    return f"F̄ = {window[0]:.3g} to {window[1]:.3g}; mean {averaged} at fixed F̄; {bodies_of(data)}"


def bodies_of(data: xarray.Dataset) -> str:
    """Say how many lines or surfaces an ensemble has, and their points."""
    count, n = data.sizes["realisation"], int(data.attrs["n"])
    if data.attrs["model"] == "reduced":
        power = n.bit_length() - 1
        return f"{count} lines of {f'2^{power}' if n == 2**power else n} points"
    return f"{count} surface{'s' if count > 1 else ''} of {n}²"
