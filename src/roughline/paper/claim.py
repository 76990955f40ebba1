"""How a claim of the paper is judged: the same number here, for each fractal dimension."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from roughline.plot.style import dimension_label
from roughline.statistics.verdict import Claim, ClaimCase, Range, Verdict, places, verdict

if TYPE_CHECKING:
    import xarray

    from roughline.paper.laws import DimensionLaws
    from roughline.paper.windows import ForceWindow
    from roughline.statistics.bootstrap import IntervalEstimate

ENOUGH_LOADS = "three loads or more across this range"


@dataclass(frozen=True)
class Numbers:
    """One number at several fractal dimensions."""

    by_place: Mapping[str, IntervalEstimate]  # such as "at D_f = 2.0"
    form: str = ".3f"  # in which they are told

    @classmethod
    def of(
        cls,
        laws: Iterable[DimensionLaws],
        number: Callable[[DimensionLaws], IntervalEstimate],
        form: str = ".3f",
    ) -> Numbers:
        """Return a number of the laws of each fractal dimension."""
        return cls({at(each.fractal_dimension): number(each) for each in laws}, form)

    @property
    def known(self) -> Mapping[str, IntervalEstimate]:
        """Those that are known."""
        return {where: each for where, each in self.by_place.items() if math.isfinite(each.value)}

    def __str__(self) -> str:
        return ", ".join(f"{each.value:{self.form}}" for each in self.known.values())

    @property
    def with_places(self) -> str:
        """The numbers, and which fractal dimensions they are of."""
        return f"{self} {places(self.known)}"

    @property
    def intervals(self) -> str:
        """Their intervals."""
        return ", ".join(
            f"{each.low:{self.form}} to {each.high:{self.form}}" if math.isfinite(each.low) else "-"
            for each in self.known.values()
        )

    def judge(self, allowed: Range) -> list[ClaimCase]:
        """Judge each by the range that a statement allows."""
        return [
            ClaimCase(
                where,
                verdict(each.low, each.high, *allowed) if math.isfinite(each.value) else None,
            )
            for where, each in self.by_place.items()
        ]

    def claim(
        self,
        statement: str,
        found: str,
        basis: str,
        allowed: Range,
        needed: str = ENOUGH_LOADS,
    ) -> Claim:
        """Return a claim about them, by the range that the statement allows for each.

        In what was found they stand in the place of "{}". Where none is known, the data lack what
        is needed.
        """
        if not self.known:
            return undecided_claim(statement, basis, needed)
        sentence = found.replace("{}", self.with_places)
        cases = self.judge(allowed)
        words = in_range(allowed, self.form)
        claim = Claim.of(statement, sentence, self.intervals, cases, basis, words)
        return self.drawn_with(claim, allowed)

    def drawn_with(self, claim: Claim, allowed: Range) -> Claim:
        """Return a claim with these numbers, and the range that it allows for each."""
        return replace(claim, numbers=self.known, within=allowed)


def undecided_claim(statement: str, basis: str, needed: str) -> Claim:
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
    allowed: str = "-",
) -> Claim:
    """Return a claim that no interval decides, with a remark on its verdict."""
    return Claim(statement, found, interval, basis, on_it, f"{on_it}{remark}", allowed)


def in_range(allowed: Range, form: str) -> str:
    """Write the range that a statement allows."""
    return f"{allowed[0]:{form}} to {allowed[1]:{form}}"


def at(dimension: float) -> str:
    """Name the place of a fractal dimension."""
    return f"at D_f = {dimension_label(dimension)}"


def basis_in(window: ForceWindow, *bodies: xarray.Dataset, averaged: str = "k") -> str:
    """Describe the window, the averaging and the grid of a number of one model, or of both."""
    described = ", ".join(map(ensemble_in_words, bodies))
    return f"F̄ = {window[0]:.3g} to {window[1]:.3g}; mean {averaged} at fixed F̄; {described}"


def ensemble_in_words(data: xarray.Dataset) -> str:
    """Say how many lines or surfaces an ensemble has, and their points."""
    count, n = data.sizes["realisation"], int(data.attrs["n"])
    if data.attrs["model"] == "reduced":
        power = n.bit_length() - 1
        points = f"2^{power}" if n == 2**power else n
        return f"{count} line{'s' if count > 1 else ''} of {points} points"
    return f"{count} surface{'s' if count > 1 else ''} of {n}²"
