"""How a claim of the paper is judged: the same number here, for each fractal dimension."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from roughline.plot.style import dimension_label
from roughline.statistics.verdict import Case, Claim, Range, Verdict, places, verdict

if TYPE_CHECKING:
    import xarray

    from roughline.paper.laws import DimensionLaws
    from roughline.paper.windows import Window
    from roughline.statistics.bootstrap import IntervalEstimate

    Numbers = Mapping[str, IntervalEstimate]

ENOUGH_LOADS = "three loads or more across this range"


def claim_about_every_dimension(
    statement: str,
    found: str,
    basis: str,
    numbers: Numbers,
    allowed: Range,
    form: str = ".3f",
    needed: str = ENOUGH_LOADS,
) -> Claim:
    """Return a claim about numbers that are judged by the range that the statement allows.

    In what was found they stand in the place of "{}". Where none is known, the data lack what is
    needed.
    """
    if not known(numbers):
        return not_judged(statement, basis, needed)
    told = found.replace("{}", listed_with_places(numbers, form))
    return Claim.of(statement, told, intervals(numbers, form), judged(numbers, allowed), basis)


def not_judged(statement: str, basis: str, needed: str) -> Claim:
    """Return a claim that the data cannot judge, as they lack what it needs."""
    cases = f"{Verdict.UNDECIDED}: not judged, as these data have no {needed}"
    return Claim(statement, "-", "-", basis, Verdict.UNDECIDED, cases)


def exact_claim(
    statement: str,
    found: str,
    basis: str,
    on_it: Verdict,
    remark: str = "",
    interval: str = "exact",
) -> Claim:
    """Return a claim that no interval decides, with a remark on its verdict."""
    return Claim(statement, found, interval, basis, on_it, f"{on_it}{remark}")


def judged(numbers: Numbers, allowed: Range) -> list[Case]:
    """Judge each number by the range that a statement allows."""
    return [
        Case(where, verdict(each.low, each.high, *allowed) if math.isfinite(each.value) else None)
        for where, each in numbers.items()
    ]


def by_dimension(
    laws: Iterable[DimensionLaws], number: Callable[[DimensionLaws], IntervalEstimate]
) -> Numbers:
    """Return a number of the laws by where it is, such as "at D_f = 2.0"."""
    return {at(each.fractal_dimension): number(each) for each in laws}


def at(dimension: float) -> str:
    """Name the place of a fractal dimension."""
    return f"at D_f = {dimension_label(dimension)}"


def known(numbers: Numbers) -> Numbers:
    """Return the numbers that are known."""
    return {where: each for where, each in numbers.items() if math.isfinite(each.value)}


def listed(numbers: Numbers, form: str = ".3f") -> str:
    """List the numbers of all fractal dimensions."""
    return ", ".join(f"{each.value:{form}}" for each in known(numbers).values())


def listed_with_places(numbers: Numbers, form: str = ".3f") -> str:
    """List the numbers of all fractal dimensions, and which dimensions these are."""
    return f"{listed(numbers, form)} {places(known(numbers))}"


def intervals(numbers: Numbers, form: str = ".3f") -> str:
    """List the intervals of all fractal dimensions."""
    return ", ".join(
        f"{each.low:{form}} to {each.high:{form}}" if math.isfinite(each.low) else "-"
        for each in known(numbers).values()
    )


def basis_in(window: Window, *bodies: xarray.Dataset, averaged: str = "k") -> str:
    """Describe the window, the averaging and the grid of a number of one model, or of both."""
    said = ", ".join(map(bodies_of, bodies))
    return f"F̄ = {window[0]:.3g} to {window[1]:.3g}; mean {averaged} at fixed F̄; {said}"


def bodies_of(data: xarray.Dataset) -> str:
    """Say how many lines or surfaces an ensemble has, and their points."""
    count, n = data.sizes["realisation"], int(data.attrs["n"])
    if data.attrs["model"] == "reduced":
        power = n.bit_length() - 1
        points = f"2^{power}" if n == 2**power else n
        return f"{count} line{'s' if count > 1 else ''} of {points} points"
    return f"{count} surface{'s' if count > 1 else ''} of {n}²"
