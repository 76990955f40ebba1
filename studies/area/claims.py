"""What is said of the area in contact, and one law for all spectra."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Claim, Range, around
from roughline.theories import bush_gibson_thomas, persson
from studies.area.measure import (
    BANDS,
    FINE_BANDS,
    HALVES,
    HURSTS,
    Sample,
    bend_with_nayak,
    exponent,
    fall_with_nayak,
    grid_shift,
    kappa,
    line_over_nayak,
    sample,
    widened_kappa,
)
from studies.area.rings import COUNT as RINGS_OF_EACH
from studies.area.rings import Rings, rings
from studies.judged import Found, claim_on, confidence_of_each

TOLERANCE = 0.05
"""How near kappa must come to a number to confirm it."""
_SAME = 0.02
"""How near kappas must come to be called the same."""
_STRAIGHT = 0.01
"""How near kappa must come to a straight line over log Nayak."""
LIGHT, MIDDLE, HEAVY = 0.005, 0.05, 0.15
"""Shares of the area at which statements are judged."""
WINDOW = (LIGHT, HEAVY)
_OF_EACH = confidence_of_each(len(BANDS) * len(HURSTS))
_OF_HURSTS = confidence_of_each(len(HURSTS))


@dataclass(frozen=True)
class CommonLaw:
    """Kappa at a share of the area, for all spectra: a line over the log of Nayak's parameter."""

    level: float  # the share
    at_ten: IntervalEstimate  # kappa where Nayak's parameter is 10
    per_decade: IntervalEstimate  # by how much it changes to a parameter ten times as large
    deviation: float  # largest relative deviation of a mean from the line

    def __call__(self, nayak: float) -> float:
        """Evaluate the law."""
        return self.at_ten.value + self.per_decade.value * (math.log10(nayak) - 1)


def main_samples() -> list[Sample]:
    """Return the surfaces of all bands and Hurst exponents, eight cells for the shortest wave."""
    return [sample("main", band, hurst) for hurst in HURSTS for band in BANDS]


def common_law(level: float) -> CommonLaw:
    """Fit the law by least squares over all spectra, which count alike."""
    samples = main_samples()
    at_ten, per_decade = line_over_nayak(samples, level)
    x = np.log10([one.nayak for one in samples]) - 1
    y = np.array([kappa(one, level).value for one in samples])
    deviation = float(np.abs(y / (at_ten.value + per_decade.value * x) - 1).max())
    return CommonLaw(level, at_ten, per_decade, deviation)


def grid_error(level: float) -> float:
    """Return by how much kappa would be higher on infinitely fine grids, at most. [1]"""
    shifts = [grid_shift(band, hurst, level).value for band in FINE_BANDS for hurst in HURSTS]
    return HALVES * max(shifts, key=abs)


def claims() -> list[Claim]:
    """Return all claims with their verdicts."""
    return [
        _kappa_is(
            bush_gibson_thomas.KAPPA, "κ = √(2π) = 2.507 at light loads (Bush, Gibson and Thomas)"
        ),
        _kappa_is(persson.KAPPA, "κ = √(8/π) = 1.596 at light loads (Persson)"),
        _of_samples(
            f"A is linear in F (eq. 4), to ±{EXPONENT_TOLERANCE:g} of the exponent",
            f"exponent from {WINDOW[0]:.1%} to {WINDOW[1]:.0%} in contact",
            lambda one: Found.of(exponent(one, WINDOW, _OF_EACH), one.count),
            around(1, EXPONENT_TOLERANCE),
            ".3f",
        ),
        _of_hursts(
            f"One κ for all surfaces (eq. 4), to {TOLERANCE:.0%}",
            f"change of κ from q_high/q_roll = {BANDS[0]} to {BANDS[-1]} at {MIDDLE:.0%} in "
            "contact",
            lambda hurst: _percent(_fall(hurst), _decades(hurst)),
            around(0, TOLERANCE),
        ),
        _of_hursts(
            "κ falls as Nayak's parameter grows (Yastrebov, Anciaux and Molinari)",
            f"change of κ for ten times the parameter, at {MIDDLE:.0%} in contact",
            lambda hurst: _percent(_fall(hurst)),
            (-math.inf, 0.0),
        ),
        _of_hursts(
            f"It falls about logarithmically, to {_STRAIGHT:.0%} of κ",
            "κ of the middle band over the straight line between the narrowest and the widest, "
            f"less 1, at {MIDDLE:.0%} in contact",
            lambda hurst: _percent(bend_with_nayak(hurst, MIDDLE, _OF_HURSTS)),
            around(0, _STRAIGHT),
        ),
        _nayak_alone(),
        _nayak_of_others(),
    ]


def _kappa_is(value: float, statement: str) -> Claim:
    """Judge that kappa of light loads is a number."""
    return _of_samples(
        f"{statement}, to {TOLERANCE:.0%}",
        f"κ at {LIGHT:.1%} in contact",
        lambda one: widened_kappa(one, LIGHT, _OF_EACH),
        around(value, value * TOLERANCE),
        ".2f",
    )


def _nayak_alone() -> Claim:
    """Judge that the law of all spectra holds for each."""
    law = common_law(MIDDLE)
    return _of_samples(
        f"Of self-affine spectra, Nayak's parameter alone determines κ (here), to {_SAME:.0%}",
        f"κ at {MIDDLE:.0%} in contact over {law.at_ten.value:.3f} {law.per_decade.value:+.3f} "
        "log10(α/10)",
        lambda one: Found.of(kappa(one, MIDDLE, _OF_EACH).over(law(one.nayak)), one.count),
        around(1, _SAME),
        ".3f",
    )


def _nayak_of_others() -> Claim:
    """Judge that the law of self-affine spectra holds for those of another family."""
    level = confidence_of_each(len(rings()))
    return claim_on(
        f"The same line holds for spectra of two narrow rings of waves (here), to {_SAME:.0%}",
        f"κ at {MIDDLE:.0%} in contact over the line, less 1",
        {
            f"at α = {one.nayak:.0f}": Found.of(over_law(one, level), RINGS_OF_EACH)
            for one in rings()
        },
        around(0, _SAME),
        "+.1%",
    )


def over_law(one: Rings, confidence: float = 0.95) -> IntervalEstimate:
    """Return kappa of two rings over that of the common law, less 1."""
    return one.kappa(MIDDLE, confidence).over(common_law(MIDDLE)(one.nayak)) - 1


def _of_samples(
    statement: str, what: str, found: Callable[[Sample], Found], allowed: Range, form: str
) -> Claim:
    """Judge a statement about every spectrum."""
    numbers = {
        f"at q_high/q_roll = {band} and Hurst {hurst:g}": found(sample("main", band, hurst))
        for band in BANDS
        for hurst in HURSTS
    }
    return claim_on(statement, what, numbers, allowed, form, each=False)


def _of_hursts(
    statement: str, what: str, found: Callable[[float], IntervalEstimate], allowed: Range
) -> Claim:
    """Judge a statement about all bands of each Hurst exponent."""
    least = min(sample("main", band, HURSTS[0]).count for band in BANDS)
    numbers = {f"at Hurst {hurst:g}": Found.of(found(hurst), least) for hurst in HURSTS}
    return claim_on(statement, what, numbers, allowed, "+.1%")


def _fall(hurst: float) -> IntervalEstimate:
    return fall_with_nayak(hurst, MIDDLE, _OF_HURSTS)


def _decades(hurst: float) -> float:
    """How many factors of ten Nayak's parameter spans."""
    first, last = (sample("main", BANDS[i], hurst).nayak for i in (0, -1))
    return math.log10(last / first)


def _percent(logarithm: IntervalEstimate, factor: float = 1.0) -> IntervalEstimate:
    """Relative change of kappa from a change of its logarithm."""
    ends = (logarithm.value, logarithm.low, logarithm.high)
    return IntervalEstimate(*(math.expm1(each * factor) for each in ends))
