"""One statement of the paper beside what was found, and how it is judged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from roughline.statistics.bootstrap import Estimate
from roughline.statistics.power_law import PowerLaw
from roughline.statistics.verdict import Verdict, of_all, verdict

if TYPE_CHECKING:
    import xarray

EXPONENT_TOLERANCE = 0.05
"""How near exponents must come; the paper's own plots show no more."""
STIFFNESS_TOLERANCE = 0.10
"""How near stiffnesses must come, as a share."""

Cases = Sequence[tuple[float, Estimate]]
"""A number with its interval for each fractal dimension."""


@dataclass(frozen=True)
class Claim:
    """One statement of the paper beside what was found.

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
        On the statement as a whole: one case that is refuted refutes it.
    cases : str
        The verdict in words, case by case where these differ.
    """

    statement: str
    found: str
    interval: str
    basis: str
    verdict: Verdict
    cases: str


def by_dimension(cases: Cases, least: float, most: float) -> tuple[Verdict, str]:
    """Judge a statement about every fractal dimension; the verdict, and in words."""
    found = {d: verdict(number.low, number.high, least, most) for d, number in cases}
    words = []
    for each in (Verdict.REFUTED, Verdict.UNDECIDED, Verdict.CONFIRMED):
        dimensions = [f"{d:.1f}" for d, one in found.items() if one is each]
        if len(dimensions) == len(found):
            return each, str(each)
        if dimensions:
            words.append(f"{each} at D_f = {', '.join(dimensions)}")
    return of_all(found.values()), "; ".join(words)


def alpha(law: PowerLaw) -> Estimate:
    """Exponent of a power law with its interval."""
    return Estimate(law.exponent, *law.exponent_interval)


def values(cases: Cases, form: str = ".3f") -> str:
    """List the numbers of all fractal dimensions, and which dimensions these are."""
    numbers = ", ".join(f"{number.value:{form}}" for _, number in cases)
    return f"{numbers} at D_f = {', '.join(f'{d:.1f}' for d, _ in cases)}"


def intervals(cases: Cases, form: str = ".3f") -> str:
    """List the intervals of all fractal dimensions."""
    return ", ".join(f"{number.low:{form}} to {number.high:{form}}" for _, number in cases)


def basis(window: tuple[float, float], data: xarray.Dataset, averaged: str = "k") -> str:
    """Window, averaging and grid of a number."""
    return f"F̄ = {window[0]:.3g} to {window[1]:.3g}; mean {averaged} at fixed F̄; {grid(data)}"


def grid(data: xarray.Dataset) -> str:
    """Name how many bodies on which grid."""
    count, n = data.sizes["realisation"], int(data.attrs["n"])
    if data.attrs["model"] == "reduced":
        power = n.bit_length() - 1
        return f"{count} lines of {f'2^{power}' if n == 2**power else n} points"
    return f"{count} surface{'s' if count > 1 else ''} of {n}²"
