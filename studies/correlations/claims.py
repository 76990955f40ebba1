"""What is said of the conductance, with verdicts from simultaneous intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from roughline.statistics.averages import average
from roughline.statistics.verdict import (
    Claim,
    ClaimCase,
    Verdict,
    around,
    joint_verdict,
    places,
    verdict,
)
from studies.correlations.measure import (
    BANDS,
    DIMENSIONS,
    ELASTIC,
    FULL,
    WINDOW,
    Sample,
    sample,
)
from studies.correlations.ratios import (
    Ratio,
    change_with_band,
    grid_shift,
    over_bearing_area,
    over_holm,
    over_root_sum,
)
from studies.judged import Found, confidence_of_each, growth_to_decide, spread

TOLERANCES = (0.1, 0.2)
LEVEL = 0.95
EXPONENT_TOLERANCE = 0.01
"""How near exponents must come: the two handbooks' differ by so much."""
MIXED = (1.0, 0.3, 0.1)
"""Hardnesses between elastic and full plasticity, to which the root sum of squares is put."""

_HALVES = 2.0  # an error that halves with the spacing is twice the difference of two grids
_PRESSURES = spread(WINDOW, "g")
_WHERE = {dimension: f"at Hurst {3 - dimension:.1f}" for dimension in DIMENSIONS}
_EVERYWHERE = places(_WHERE.values())


def claims(tolerance: float) -> list[Claim]:
    """Return all claims, judged with a tolerance of ratios."""
    elastic, plastic = (
        [sample("main", hardness, dimension) for dimension in DIMENSIONS]
        for hardness in (ELASTIC, FULL)
    )
    mixed = [sample("main", hardness, dimension) for hardness in MIXED for dimension in DIMENSIONS]
    return [
        _of_ratios(
            "Elastic: h_c σ/(κ_s m) = 1.55 (√2 p/(E* m))^0.94 (Mikic)",
            "conductance over Mikic's",
            elastic,
            lambda one: one.over_mikic,
            tolerance,
        ),
        _of_exponents("Elastic: the exponent is 0.94 (Mikic)", elastic, 0.94, tolerance),
        _of_ratios(
            "Fully plastic: h_c σ/(κ_s m) = 1.25 (p/H)^0.95 (Cooper, Mikic and Yovanovich)",
            "conductance over that of the correlation",
            plastic,
            lambda one: one.over_yovanovich,
            tolerance,
        ),
        _of_exponents("Fully plastic: the exponent is 0.95", plastic, 0.95, tolerance),
        _of_ratios(
            "Fully plastic: the real area is A/A_0 = p/H",
            "area over that",
            plastic,
            over_bearing_area,
            tolerance,
        ),
        _of_ratios(
            "In between: h_c² = h_e² + h_p² of the elastic and of the fully plastic body (here)",
            f"conductance over that, H/(E*∇h) = {MIXED[-1]:g} to {MIXED[0]:g}",
            mixed,
            over_root_sum,
            tolerance,
        ),
        _of_bands("Elastic: of the surface, only σ and m matter", ELASTIC, tolerance),
        _of_bands("Fully plastic: of the surface, only σ and m matter", FULL, tolerance),
        _of_ratios(
            "Fully plastic: all load on a single round spot (Holm)",
            "conductance over Holm's",
            plastic,
            over_holm,
            tolerance,
        ),
    ]


def _of_ratios(
    statement: str, what: str, samples: Sequence[Sample], ratio: Ratio, tolerance: float
) -> Claim:
    """Judge that a ratio is 1 at all pressures of the window."""
    spreads, ends, cases = [], [], []
    for dimension, where in _WHERE.items():
        of_it = [one for one in samples if one.fractal_dimension == dimension]
        found = [at_all_pressures(one, ratio) for one in of_it]
        means = [average(ratio(one)[:, one.in_window]).mean for one in of_it]
        spreads.append(spread(np.ravel(means)))
        ends.append(spread(end for one in found for each in one for end in (each.low, each.high)))
        cases.append(ClaimCase.together(where, [judge(where, one, tolerance) for one in found]))
    return Claim.of(
        statement,
        f"{what}: {', '.join(spreads)} {_EVERYWHERE}",
        ", ".join(ends),
        cases,
        f"p/(E*∇h) or p/H from {_PRESSURES}, all pressures together, with the grid's error; "
        f"{_counted(samples)}",
    )


def _of_exponents(
    statement: str, samples: Sequence[Sample], expected: float, tolerance: float
) -> Claim:
    """Judge the exponent of the power law that fits best, by a tolerance of its own."""
    laws = {_WHERE[one.fractal_dimension]: one.fit() for one in samples}
    allowed = around(expected, EXPONENT_TOLERANCE)
    claim = Claim.of(
        f"{statement}, to ±{EXPONENT_TOLERANCE:g}",
        f"{', '.join(f'{law.exponent:.3f}' for law in laws.values())} {_EVERYWHERE}",
        ", ".join(spread(law.exponent_interval, ".3f") for law in laws.values()),
        [
            ClaimCase(where, verdict(*law.exponent_interval, *allowed))
            for where, law in laws.items()
        ],
        f"least squares of logarithms, pressures from {_PRESSURES}; {_counted(samples)}",
    )
    return claim if tolerance == TOLERANCES[0] else replace(claim, cases="-")


def _of_bands(statement: str, hardness: float, tolerance: float) -> Claim:
    """Judge that the ratio does not depend on how wide the band of waves is."""
    narrow, wide = min(BANDS), 16
    changes = {
        where: change_with_band(hardness, dimension, narrow, wide)
        for dimension, where in _WHERE.items()
    }
    samples = [sample(BANDS[width], hardness, DIMENSIONS[0]) for width in (narrow, wide)]
    return Claim.of(
        statement,
        f"from q_high/q_roll = {narrow} to {wide} the ratio to the correlation changes by "
        f"{', '.join(f'{each.value:+.0%}' for each in changes.values())} {_EVERYWHERE}",
        ", ".join(spread((each.low, each.high), "+.0%") for each in changes.values()),
        [
            ClaimCase(where, verdict(each.low, each.high, *around(0, tolerance)))
            for where, each in changes.items()
        ],
        f"at a pressure of 0.01; {' and '.join(str(one.count) for one in samples)} surfaces",
    )


def _counted(samples: Sequence[Sample]) -> str:
    """Say how many surfaces there are for each Hurst exponent and hardness."""
    return f"{min(one.count for one in samples)} surfaces each"


def at_all_pressures(one: Sample, ratio: Ratio) -> list[Found]:
    """Return a ratio at each pressure of the window, with intervals that hold together.

    They have Bonferroni's level, and are widened on one side by the error of the grid.
    """
    inside = one.in_window
    level = confidence_of_each(int(np.count_nonzero(inside)), LEVEL)
    mean = average(ratio(one)[:, inside], confidence=level)
    grid = _HALVES * np.array([shift.value for shift in grid_shift(one, ratio)])[inside]
    down, up = 1 + np.minimum(grid, 0), 1 + np.maximum(grid, 0)
    ends = np.array([mean.low * down, mean.mean * down, mean.mean * up, mean.high * up])
    return [Found(low, least, most, high, one.count) for low, least, most, high in ends.T.tolist()]


def judge(where: str, found: Sequence[Found], tolerance: float) -> ClaimCase:
    """Judge that ratios at several pressures are all 1; one that refutes it is enough."""
    allowed = around(1, tolerance)
    cases = [each.judged(where, allowed) for each in found]
    whole = joint_verdict(each.verdict for each in cases if each.verdict)
    if whole is not Verdict.UNDECIDED:
        return ClaimCase(where, whole)
    refuting = [
        case.enough
        for case, each in zip(cases, found, strict=True)
        if case.verdict is whole and growth_to_decide(each, allowed)[1]
    ]
    return ClaimCase(where, whole, min(refuting)) if refuting else ClaimCase.together(where, cases)
