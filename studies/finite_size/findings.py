"""What the study finds: where the power law ends, and how the stiffness goes on from there."""

from __future__ import annotations

import math

from roughline.paper.stated import EXPONENT_TOLERANCE
from studies.finite_size.crossover import BETWEEN_THEM, scaling_exponent_of
from studies.finite_size.measures import (
    crossing,
    decades_of_linear_law,
    exponent_in,
    over_persson,
    reduced_over_full,
)
from studies.finite_size.samples import BAND, HURSTS, SIZES, WIDE, Sample, sample
from studies.finite_size.statements import (
    each_case,
    judged_at_least,
    judged_below,
    judged_near,
    load_in_words,
    load_interval,
    over_side,
    range_of_cases,
)
from studies.judged import (
    Finding,
    Judgement,
    WidenedInterval,
    confidence_of_each,
    finding_of_cases,
    judged,
    judged_together,
)

MANY = 8
"""Roll-off waves along a side from which on there are many."""
SINGLE = (0.006, 0.06)
"""F / (E* h lambda_r) of the power law of a single wave."""
BETWEEN = (0.5, 5.0)
"""F / (E* h lambda_r) between the power law and the load at which the exponent nears 1."""
GAMMAS = (0.4, 0.5)
DECADE = 1.0
NEAR = 0.2
"""How near a stiffness must come to a theory's."""
_MEDIUM, _SAME = 0.3, 0.1  # F / (E* h lambda_r) and tolerance of the comparison of models
_BELOW = {0: "at the load of γ", 1: "a decade below", 2: "two decades below"}


def findings() -> list[Finding]:
    """Return all statements with their verdicts."""
    return [
        _single_wave(),
        _finite_size(),
        _linear_law(),
        _gamma(),
        _between(),
        _persson(),
        _reduced(),
    ]


def _single_wave() -> Finding:
    """Judge the power law of surfaces of one roll-off wave."""
    cases = {
        f"{geometry} at Hurst {hurst:g}": (sample(geometry, WIDE, 1, hurst), hurst)
        for geometry in ("periodic", "free")
        for hurst in HURSTS
    }
    level = confidence_of_each(len(cases))
    found = {name: exponent_in(one, SINGLE, level) for name, (one, _) in cases.items()}
    parts = {
        name: judged_near(found[name], scaling_exponent_of(hurst), one.count)
        for name, (one, hurst) in cases.items()
    }
    return each_case(
        "A surface of one roll-off wave: k ~ F^(1/(1+H)) under light loads (eq. 14; Pastewka and "
        f"others), to ±{EXPONENT_TOLERANCE:g}",
        f"exponent from F/(E* h λ_r) = {SINGLE[0]:g} to {SINGLE[1]:g}",
        found,
        parts,
        ".3f",
    )


def _finite_size() -> Finding:
    """Judge that the power law ends at lower loads on larger surfaces."""
    small, large = 1, max(SIZES[BAND])
    level = confidence_of_each(2 * len(HURSTS))
    found, parts = {}, {}
    for hurst in HURSTS:
        first, last = (
            over_side(crossing("periodic", BAND, size, hurst, level).halfway.force, size)
            for size in (small, large)
        )
        name = f"Hurst {hurst:g}"
        found[name] = (first, last)
        parts[name] = judged_below(last, first, sample("periodic", BAND, large, hurst).count)
    return finding_of_cases(
        "The power law is an effect of finite size: on larger surfaces it ends under lower loads "
        "(Pastewka and others)",
        f"half way to exponent {BETWEEN_THEM:g} at F/(E* h L) with {small} and with {large} "
        "roll-off waves along a side: "
        + ", ".join(
            f"{load_in_words(first)} and {load_in_words(last)} at {name}"
            for name, (first, last) in found.items()
        ),
        ", ".join(
            f"{load_interval(first)} and {load_interval(last)}" for first, last in found.values()
        ),
        parts,
    )


def _linear_law() -> Finding:
    """Judge that stiffness is linear in the force over a decade."""
    cases = _many()
    level = confidence_of_each(len(cases))
    found = {name: decades_of_linear_law(one, level) for name, one in cases.items()}
    parts = {name: judged_at_least(each, DECADE) for name, each in found.items()}
    least, most = min(sure for sure, _ in found.values()), max(most for _, most in found.values())
    return finding_of_cases(
        f"With {MANY} waves or more, k = p/(γ h) over a decade of loads or more (Persson; Akarapu "
        "and others; Pastewka and others)",
        f"the exponent is 1 within {EXPONENT_TOLERANCE:g} over {least:.2f} to {most:.2f} decades",
        f"{least:.2f} to {most:.2f}",
        parts,
    )


def _gamma() -> Finding:
    """Judge gamma where the exponent is 1."""
    level = confidence_of_each(2 * len(SIZES[BAND]) * len(HURSTS))
    every = {
        f"{_case(size, hurst)} ({geometry})": (
            crossing(geometry, BAND, size, hurst, level).gamma,
            sample(geometry, BAND, size, hurst).count,
        )
        for geometry in ("periodic", "free")
        for size in SIZES[BAND]
        for hurst in HURSTS
    }
    found = {name: each for name, each in every.items() if not math.isnan(each[0].value)}
    parts = {
        name: judged(WidenedInterval.of(each), count, *GAMMAS)
        for name, (each, count) in found.items()
    }
    return range_of_cases(
        f"γ = F/(k h) is {GAMMAS[0]:g} to {GAMMAS[1]:g} where the law is linear (Pastewka and "
        "others)",
        f"γ where the exponent is 1, in the {len(found)} of {len(every)} cases of sizes, "
        "geometries and Hurst exponents in which the loads reach it",
        [each for each, _ in found.values()],
        parts,
        ".3f",
    )


def _between() -> Finding:
    """Judge the exponent beyond the power law."""
    cases = _many()
    level = confidence_of_each(len(cases))
    found = {name: exponent_in(one, BETWEEN, level) for name, one in cases.items()}
    parts = {name: judged_near(found[name], BETWEEN_THEM, one.count) for name, one in cases.items()}
    return range_of_cases(
        f"With {MANY} waves or more, k ~ F^{BETWEEN_THEM:g} beyond the power law (here), to "
        f"±{EXPONENT_TOLERANCE:g}",
        f"exponent from F/(E* h λ_r) = {BETWEEN[0]:g} to {BETWEEN[1]:g}",
        list(found.values()),
        parts,
        ".3f",
    )


def _persson() -> Finding:
    """Judge Persson's theory at the load of gamma, and at lighter ones."""
    cases = _many()
    level = confidence_of_each(len(_BELOW) * len(cases))
    found = {below: [over_persson(one, below, level) for one in cases.values()] for below in _BELOW}
    parts = {
        f"{_BELOW[below]} ({name})": judged(WidenedInterval.of(each), one.count, 1 - NEAR, 1 + NEAR)
        for below, ratios in found.items()
        for each, (name, one) in zip(ratios, cases.items(), strict=True)
    }
    by_load = [
        f"{min(each.value for each in ratios):.2f} to {max(each.value for each in ratios):.2f} "
        f"{_BELOW[below]}"
        for below, ratios in found.items()
    ]
    every = [each for ratios in found.values() for each in ratios]
    return Finding(
        f"With {MANY} waves or more, Persson's theory gives k to {NEAR:.0%}",
        f"k over the theory's: {', '.join(by_load)}",
        f"{min(each.low for each in every):.2f} to {max(each.high for each in every):.2f}",
        judged_together(list(parts.values())),
        _by_load(parts),
    )


def _by_load(parts: dict[str, Judgement]) -> str:
    """Say for which loads all cases agree, where the statement as a whole is another."""
    said = []
    for name in _BELOW.values():
        verdicts = {part.verdict for case, part in parts.items() if case.startswith(name)}
        said.append(f"{' or '.join(sorted(verdicts))} {name}")
    return "; ".join(said)


def _reduced() -> Finding:
    """Judge the reduced model beside free surfaces of all sizes."""
    cases = {_case(size, hurst): (size, hurst) for size in SIZES[BAND] for hurst in HURSTS}
    level = confidence_of_each(len(cases))
    found = {name: reduced_over_full(*case, _MEDIUM, level) for name, case in cases.items()}
    parts = {
        name: judged(
            WidenedInterval.of(found[name]), sample("free", BAND, *case).count, -_SAME, _SAME
        )
        for name, case in cases.items()
    }
    return range_of_cases(
        f"The reduced model has the stiffness of the surface, to {_SAME:.0%} (the founding paper)",
        f"stiffness of lines over that of free surfaces, less 1, at F/(E* h λ_r) = {_MEDIUM:g}",
        list(found.values()),
        parts,
        "+.0%",
    )


def _case(size: int, hurst: float) -> str:
    """Name surfaces of one size and Hurst exponent."""
    return f"{size} wave{'s' if size > 1 else ''} at Hurst {hurst:g}"


def _many() -> dict[str, Sample]:
    """Return the periodic surfaces of many waves."""
    return {
        _case(size, hurst): sample("periodic", BAND, size, hurst)
        for size in SIZES[BAND]
        if size >= MANY
        for hurst in HURSTS
    }
