"""What is said of the power law's end, and of how the stiffness goes on from there."""

from __future__ import annotations

import math

from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Claim, ClaimCase, Verdict, around, verdict
from roughline.units import decimal
from studies.finite_size.crossover import BETWEEN_THEM, scaling_exponent_of
from studies.finite_size.measure import (
    crossing,
    decades_of_linear_law,
    exponent_in,
    over_persson,
    reduced_over_full,
)
from studies.finite_size.samples import BAND, HURSTS, SIZES, WIDE, Sample, sample
from studies.judged import Found, claim_on, confidence_of_each, spread

MANY = 8
"""Roll-off waves along a side from which on there are many."""
_SINGLE = (0.006, 0.06)
"""F / (E* h lambda_r) of the power law of a single wave."""
BETWEEN = (0.5, 5.0)
"""F / (E* h lambda_r) between the power law and the load at which the exponent nears 1."""
GAMMAS = (0.4, 0.5)
_DECADE = 1.0
_NEAR = 0.2  # how near a stiffness must come to a theory's
_MEDIUM, _SAME = 0.3, 0.1  # F / (E* h lambda_r) and tolerance of the comparison of models
_BELOW = {0: "at the load of γ", 1: "a decade below", 2: "two decades below"}


def claims() -> list[Claim]:
    """Return all claims with their verdicts."""
    return [
        _single_wave(),
        _finite_size(),
        _linear_law(),
        _gamma(),
        _between(),
        _persson(),
        _reduced(),
    ]


def _single_wave() -> Claim:
    """Judge the power law of surfaces of one roll-off wave."""
    cases = {
        f"on {geometry} surfaces at Hurst {hurst:g}": sample(geometry, WIDE, 1, hurst)
        for geometry in ("periodic", "free")
        for hurst in HURSTS
    }
    level = confidence_of_each(len(cases))
    return claim_on(
        "A surface of one roll-off wave: k ~ F^(1/(1+H)) under light loads (eq. 14; Pastewka and "
        f"others), to ±{EXPONENT_TOLERANCE:g}",
        f"exponent from F/(E* h λ_r) = {_SINGLE[0]:g} to {_SINGLE[1]:g}",
        {
            where: Found.of(exponent_in(one, _SINGLE, level), one.count)
            for where, one in cases.items()
        },
        {
            where: around(scaling_exponent_of(one.hurst), EXPONENT_TOLERANCE)
            for where, one in cases.items()
        },
        ".3f",
    )


def _finite_size() -> Claim:
    """Judge that the power law ends at lower loads on larger surfaces."""
    small, large = 1, max(SIZES[BAND])
    level = confidence_of_each(2 * len(HURSTS))
    ends = {
        f"at Hurst {hurst:g}": [
            crossing("periodic", BAND, size, hurst, level).halfway.force.over(size)
            for size in (small, large)
        ]
        for hurst in HURSTS
    }
    count = sample("periodic", BAND, large, HURSTS[0]).count
    told = (f"{_load(first)} and {_load(last)} {where}" for where, (first, last) in ends.items())
    return Claim.of(
        "The power law is an effect of finite size: on larger surfaces it ends under lower loads "
        "(Pastewka and others)",
        f"half way to exponent {BETWEEN_THEM:g} at F/(E* h L) with {small} and with {large} "
        f"roll-off waves along a side: {', '.join(told)}",
        ", ".join(
            " and ".join(between_ends(each, " to ") for each in of_it) for of_it in ends.values()
        ),
        [_judged_below(where, last, first, count) for where, (first, last) in ends.items()],
    )


def _linear_law() -> Claim:
    """Judge that stiffness is linear in the force over a decade."""
    cases = _many()
    level = confidence_of_each(len(cases))
    decades = {where: decades_of_linear_law(one, level) for where, one in cases.items()}
    found = spread(end for ends in decades.values() for end in ends)
    return Claim.of(
        f"With {MANY} waves or more, k = p/(γ h) over a decade of loads or more (Persson; Akarapu "
        "and others; Pastewka and others)",
        f"the exponent is 1 within {EXPONENT_TOLERANCE:g} over {found} decades",
        found,
        [ClaimCase(where, verdict(*ends, _DECADE, math.inf)) for where, ends in decades.items()],
    )


def _gamma() -> Claim:
    """Judge gamma where the exponent is 1."""
    level = confidence_of_each(2 * len(SIZES[BAND]) * len(HURSTS))
    every = {
        f"on {geometry} surfaces {_case(size, hurst)}": Found.of(
            crossing(geometry, BAND, size, hurst, level).gamma,
            sample(geometry, BAND, size, hurst).count,
        )
        for geometry in ("periodic", "free")
        for size in SIZES[BAND]
        for hurst in HURSTS
    }
    found = {where: each for where, each in every.items() if not math.isnan(each.value)}
    return claim_on(
        f"γ = F/(k h) is {GAMMAS[0]:g} to {GAMMAS[1]:g} where the law is linear (Pastewka and "
        "others)",
        f"γ where the exponent is 1, in the {len(found)} of {len(every)} cases of sizes, "
        "geometries and Hurst exponents in which the loads reach it",
        found,
        GAMMAS,
        ".3f",
        each=False,
    )


def _between() -> Claim:
    """Judge the exponent beyond the power law."""
    cases = _many()
    level = confidence_of_each(len(cases))
    return claim_on(
        f"With {MANY} waves or more, k ~ F^{BETWEEN_THEM:g} beyond the power law (here), to "
        f"±{EXPONENT_TOLERANCE:g}",
        f"exponent from F/(E* h λ_r) = {BETWEEN[0]:g} to {BETWEEN[1]:g}",
        {
            where: Found.of(exponent_in(one, BETWEEN, level), one.count)
            for where, one in cases.items()
        },
        around(BETWEEN_THEM, EXPONENT_TOLERANCE),
        ".3f",
        each=False,
    )


def _persson() -> Claim:
    """Judge Persson's theory at the load of gamma, and at lighter ones."""
    cases = _many()
    level = confidence_of_each(len(_BELOW) * len(cases))
    by_load = {
        where: [Found.of(over_persson(one, below, level), one.count) for one in cases.values()]
        for below, where in _BELOW.items()
    }
    told = (f"{spread(one.value for one in of_it)} {where}" for where, of_it in by_load.items())
    ends = (end for of_it in by_load.values() for one in of_it for end in (one.low, one.high))
    return Claim.of(
        f"With {MANY} waves or more, Persson's theory gives k to {_NEAR:.0%}",
        f"k over the theory's: {', '.join(told)}",
        spread(ends),
        [
            ClaimCase.together(where, [one.judged(where, around(1, _NEAR)) for one in of_it])
            for where, of_it in by_load.items()
        ],
    )


def _reduced() -> Claim:
    """Judge the reduced model beside free surfaces of all sizes."""
    cases = [(size, hurst) for size in SIZES[BAND] for hurst in HURSTS]
    level = confidence_of_each(len(cases))
    return claim_on(
        f"The reduced model has the stiffness of the surface, to {_SAME:.0%} (the founding paper)",
        f"stiffness of lines over that of free surfaces, less 1, at F/(E* h λ_r) = {_MEDIUM:g}",
        {
            _case(*case): Found.of(
                reduced_over_full(*case, _MEDIUM, level), sample("free", BAND, *case).count
            )
            for case in cases
        },
        around(0, _SAME),
        "+.0%",
        each=False,
    )


def _judged_below(
    where: str, first: IntervalEstimate, second: IntervalEstimate, count: int
) -> ClaimCase:
    """Judge that a load is below another."""
    if first.high < second.low:
        return ClaimCase(where, Verdict.CONFIRMED)
    if first.low > second.high:
        return ClaimCase(where, Verdict.REFUTED)
    apart = math.log(second.value / first.value)
    widths = math.log(first.high / first.value) + math.log(second.value / second.low)
    enough = count * (widths / apart) ** 2 if apart > 0 else math.nan
    return ClaimCase(where, Verdict.UNDECIDED, enough)


def _load(load: IntervalEstimate) -> str:
    """Write a load; where the exponent passes outside the loads, on which side."""
    if not math.isnan(load.value):
        return decimal(load.value, 2)
    if math.isnan(load.low):
        return f"less than {decimal(load.high, 2)}"
    return f"more than {decimal(load.low, 2)}"


def between_ends(load: IntervalEstimate, to: str = "-") -> str:
    """Write the interval of a load, of which an end may be open."""
    if math.isnan(load.low):
        return "not told" if math.isnan(load.high) else f"< {decimal(load.high, 2)}"
    if math.isnan(load.high):
        return f"> {decimal(load.low, 2)}"
    return f"{decimal(load.low, 2)}{to}{decimal(load.high, 2)}"


def _case(size: int, hurst: float) -> str:
    """Say which surfaces have one size and Hurst exponent."""
    return f"with {size} wave{'s' if size > 1 else ''} at Hurst {hurst:g}"


def _many() -> dict[str, Sample]:
    """Return the periodic surfaces of many waves."""
    return {
        _case(size, hurst): sample("periodic", BAND, size, hurst)
        for size in SIZES[BAND]
        if size >= MANY
        for hurst in HURSTS
    }
