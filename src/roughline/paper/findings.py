"""The three numbers that matter: how sure each is, and what it says of the paper, in a sentence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from roughline.paper.claim import Numbers
from roughline.paper.laws import exponent_estimate
from roughline.paper.stated import EXPONENT_TOLERANCE, REDUCED_ENDS, STIFFNESS_TOLERANCE
from roughline.report.page import KeyFigure
from roughline.statistics.power_law import linear_exponent
from roughline.statistics.verdict import ClaimCase, Verdict, around, joint_verdict, places

if TYPE_CHECKING:
    from roughline.paper.results import PaperResults
    from roughline.statistics.bootstrap import IntervalEstimate

_NO_DIFFERENCE = around(0, EXPONENT_TOLERANCE)
_VERBS = {
    Verdict.CONFIRMED: "confirms",
    Verdict.REFUTED: "refutes",
    Verdict.UNDECIDED: "does not decide on",
}


def findings(results: PaperResults, by_more: PaperResults | None) -> list[KeyFigure]:
    """Return the exponents of both models, and the ratio of their stiffness.

    Each sentence ends with what a larger study found, where there is one.
    """
    found = _found(results)
    more: Sequence[_LeadingNumber | None] = _found(by_more) if by_more else [None] * len(found)
    return [
        KeyFigure(each.name, each.ends, each.where, each.sentence(of_more))
        for each, of_more in zip(found, more, strict=True)
        if each.numbers.known
    ]


def lone_bodies(results: PaperResults) -> list[str]:
    """Say what bodies that are one of a kind cannot tell."""
    return [
        f"One {name} of each D_f does not tell how far another would differ: its numbers have no "
        f"intervals, and claims on {name}s are undecided; {option} 2 or more tells."
        for name, option, data in (
            ("surface", "--realisations", results.full),
            ("line", "--lines", results.reduced),
        )
        if data.sizes["realisation"] == 1
    ]


@dataclass(frozen=True)
class _LeadingNumber:
    """A number over the fractal dimensions, and how it judges a statement of the paper."""

    name: str
    subject: str  # how its sentence begins
    numbers: Numbers
    stated: str
    cases: Sequence[ClaimCase]

    @property
    def ends(self) -> str:
        """The number at the smallest and at the largest fractal dimension."""
        return " to ".join(f"{each.value:.2f}" for _, each in _first_and_last(self.numbers.known))

    @property
    def where(self) -> str:
        """These fractal dimensions."""
        first, *last = (where for where, _ in _first_and_last(self.numbers.known))
        return " and ".join([first, *(each.removeprefix("at D_f = ") for each in last)])

    def judges(self, stated: str) -> str:
        """Say what it does to a statement, and at which fractal dimensions if not at all."""
        judged = {each.where: each.verdict for each in self.cases if each.verdict}
        together = joint_verdict(judged.values())
        of_it = [where for where, verdict in judged.items() if verdict is together]
        where = "" if len(of_it) == len(judged) else f" {places(of_it)}"
        return f"{_VERBS[together]} {stated}{where}"

    def sentence(self, more: _LeadingNumber | None) -> str:
        """Tell it all, and in short what the larger study found."""
        ends = []
        for where, each in _first_and_last(self.numbers.known):
            value, low, high = (
                f"{x:{self.numbers.form}}" for x in (each.value, each.low, each.high)
            )
            ends.append(f"{value}{'' if low == 'nan' else f' (95 %: {low} to {high})'} {where}")
        text = f"{self.subject} {' and '.join(ends)}: this {self.judges(self.stated)}"
        if more and more.numbers.known:
            text += f"; the full study, {more.ends}, {more.judges('it')}"
        return f"{text}."


def _first_and_last(known: Mapping[str, IntervalEstimate]) -> list[tuple[str, IntervalEstimate]]:
    """Return the numbers of the smallest and of the largest fractal dimension, or of the only."""
    every = [*known.items()]
    return every[:: max(len(every) - 1, 1)]


def _found(results: PaperResults) -> list[_LeadingNumber]:
    """Evaluate them."""
    surfaces = Numbers.of(results.laws, lambda laws: exponent_estimate(laws.full))
    lines = Numbers.of(results.laws, lambda laws: exponent_estimate(laws.reduced))
    ratio = Numbers.of(results.laws, lambda laws: laws.agreement, ".2f")
    off_linear = Numbers.of(
        results.laws,
        lambda laws: exponent_estimate(laws.full) - linear_exponent(laws.fractal_dimension),
    )
    off_ends = Numbers.of(
        [laws for laws in results.laws if laws.fractal_dimension in REDUCED_ENDS],
        lambda laws: exponent_estimate(laws.reduced) - REDUCED_ENDS[laws.fractal_dimension],
    )
    return [
        _LeadingNumber(
            "Exponent α of surfaces",
            "The exponent of the surfaces is α =",
            surfaces,
            "the paper's 0.2567 D_f",
            off_linear.judge(_NO_DIFFERENCE),
        ),
        _LeadingNumber(
            "Exponent α of lines",
            "The exponent of the lines is α =",
            lines,
            "the paper's 0.5 and 0.75",
            off_ends.judge(_NO_DIFFERENCE),
        ),
        _LeadingNumber(
            "Stiffness, surfaces over lines",
            "With the same waves, the stiffness of surfaces over that of lines is",
            ratio,
            f"agreement within {STIFFNESS_TOLERANCE:.0%}",
            ratio.judge(around(1, STIFFNESS_TOLERANCE)),
        ),
    ]
