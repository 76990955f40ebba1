"""Statements on the conductance, what was found, and the verdicts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from roughline.report.page import Table
from roughline.statistics.averages import average
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Verdict, verdict
from studies.correlations.conductance import (
    BANDS,
    DIMENSIONS,
    ELASTIC,
    FULL,
    WINDOW,
    Sample,
    sample,
)
from studies.correlations.findings import (
    change_with_band,
    over_bearing_area,
    over_holm,
    over_root_sum,
)
from studies.correlations.judgement import (
    TOLERANCES,
    Ratio,
    judge,
    simultaneous_intervals,
)
from studies.judged import Judgement, judged_together

EXPONENT_TOLERANCE = 0.01
"""How near exponents must come: the two handbooks' differ by so much."""
MIKIC_EXPONENT, PLASTIC_EXPONENT = 0.94, 0.95
MIXED = (1.0, 0.3, 0.1)
"""Hardnesses between elastic and full plasticity, to which the root sum of squares is put."""

_PRESSURES = f"{WINDOW[0]:g} to {WINDOW[1]:g}"
_SAMPLED = f"p/(E*∇h) or p/H from {_PRESSURES}, all pressures together, with the grid's error"


@dataclass(frozen=True)
class Claim:
    """A statement, the same number here, and what the data say of it.

    Attributes
    ----------
    statement, found, interval, basis : str
        What is said, what was found, its 95 % interval, and of what.
    verdicts : tuple of str
        One for each of the `TOLERANCES`, by Hurst exponent where they differ.
    """

    statement: str
    found: str
    interval: str
    basis: str
    verdicts: tuple[str, ...]


def claims() -> list[Claim]:
    """Return all claims."""
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
        ),
        _of_exponents("Elastic: the exponent is 0.94 (Mikic)", elastic, MIKIC_EXPONENT),
        _of_ratios(
            "Fully plastic: h_c σ/(κ_s m) = 1.25 (p/H)^0.95 (Cooper, Mikic and Yovanovich)",
            "conductance over that of the correlation",
            plastic,
            lambda one: one.over_yovanovich,
        ),
        _of_exponents("Fully plastic: the exponent is 0.95", plastic, PLASTIC_EXPONENT),
        _of_ratios(
            "Fully plastic: the real area is A/A_0 = p/H",
            "area over that",
            plastic,
            over_bearing_area,
        ),
        _of_ratios(
            "In between: h_c² = h_e² + h_p² of the elastic and of the fully plastic body (here)",
            f"conductance over that, H/(E*∇h) = {MIXED[-1]:g} to {MIXED[0]:g}",
            mixed,
            over_root_sum,
        ),
        _of_bands("Elastic: of the surface, only σ and m matter", ELASTIC, 16),
        _of_bands("Fully plastic: of the surface, only σ and m matter", FULL, 16),
        _of_ratios(
            "Fully plastic: all load on a single round spot (Holm)",
            "conductance over Holm's",
            plastic,
            over_holm,
        ),
    ]


def claims_table(found: Sequence[Claim]) -> Table:
    """Return the claims as a table."""
    verdicts = (f"Within {tolerance:.0%}" for tolerance in TOLERANCES)
    header = ("What is said", "Found here", "95 % interval", "Basis", *verdicts)
    rows = [
        (each.statement, each.found, each.interval, each.basis, *each.verdicts) for each in found
    ]
    return Table(header, rows, verdict=4)


def _of_ratios(statement: str, what: str, samples: Sequence[Sample], ratio: Ratio) -> Claim:
    """Judge that a ratio is 1 at all pressures of the window."""
    by_dimension = {
        dimension: [one for one in samples if one.fractal_dimension == dimension]
        for dimension in DIMENSIONS
    }
    spreads, ends = [], []
    for of_it in by_dimension.values():
        means = [average(ratio(one)[:, one.in_window]).mean for one in of_it]
        spreads.append(_range(min(map(min, means)), max(map(max, means))))
        intervals = [each for one in of_it for each in simultaneous_intervals(one, ratio)]
        ends.append(
            _range(min(each.low for each in intervals), max(each.high for each in intervals))
        )
    return Claim(
        statement,
        f"{what}: {', '.join(spreads)} {_HURSTS}",
        ", ".join(ends),
        f"{_SAMPLED}; {_counted(samples)}",
        tuple(
            _in_words(
                [
                    (dimension, judged_together([judge(one, ratio, tolerance) for one in of_it]))
                    for dimension, of_it in by_dimension.items()
                ]
            )
            for tolerance in TOLERANCES
        ),
    )


def _of_exponents(statement: str, samples: Sequence[Sample], expected: float) -> Claim:
    """Judge the exponent of the power law that fits best."""
    laws = [(one.fractal_dimension, one.fit()) for one in samples]
    least, most = expected - EXPONENT_TOLERANCE, expected + EXPONENT_TOLERANCE
    judged = [
        (dimension, Judgement(verdict(*law.exponent_interval, least, most), math.nan))
        for dimension, law in laws
    ]
    return Claim(
        f"{statement}, to ±{EXPONENT_TOLERANCE:g}",
        f"{', '.join(f'{law.exponent:.3f}' for _, law in laws)} {_HURSTS}",
        ", ".join(_range(*law.exponent_interval, ".3f") for _, law in laws),
        f"least squares of logarithms, pressures from {_PRESSURES}; {_counted(samples)}",
        (_in_words(judged),) + ("-",) * (len(TOLERANCES) - 1),
    )


def _of_bands(statement: str, hardness: float, wide: int) -> Claim:
    """Judge that the ratio does not depend on how wide the band of waves is."""
    narrow = min(BANDS)
    changes = [
        (dimension, change_with_band(hardness, dimension, narrow, wide)) for dimension in DIMENSIONS
    ]
    samples = [sample(BANDS[width], hardness, DIMENSIONS[0]) for width in (narrow, wide)]
    return Claim(
        statement,
        f"from q_high/q_roll = {narrow} to {wide} the ratio to the correlation changes by "
        f"{', '.join(f'{change.value:+.0%}' for _, change in changes)} {_HURSTS}",
        ", ".join(_signed(change) for _, change in changes),
        f"at a pressure of 0.01; {' and '.join(str(one.count) for one in samples)} surfaces",
        tuple(
            _in_words(
                [
                    (dimension, Judgement(verdict(each.low, each.high, -share, share), math.nan))
                    for dimension, each in changes
                ]
            )
            for share in TOLERANCES
        ),
    )


def _in_words(judged: Sequence[tuple[float, Judgement]]) -> str:
    """Say the verdicts, by Hurst exponent where they differ, and what would decide."""
    parts = []
    for each in (Verdict.REFUTED, Verdict.UNDECIDED, Verdict.CONFIRMED):
        cases = [case for case in judged if case[1].verdict is each]
        if not cases:
            continue
        hursts = ", ".join(f"{3 - dimension:.1f}" for dimension, _ in cases)
        where = "" if len(cases) == len(judged) else f" at Hurst {hursts}"
        needed = [case.enough for _, case in cases if not math.isnan(case.enough)]
        parts.append(f"{each}{where}{_enough(max(needed)) if needed else ''}")
    return "; ".join(parts)


def _enough(count: float) -> str:
    """Say how many realisations would decide."""
    return f" ({Judgement(Verdict.UNDECIDED, count).what_would_decide})"


_HURSTS = f"at Hurst {', '.join(f'{3 - dimension:.1f}' for dimension in DIMENSIONS)}"


def _range(low: float, high: float, form: str = ".2f") -> str:
    return f"{low:{form}} to {high:{form}}"


def _signed(number: IntervalEstimate) -> str:
    return f"{number.low:+.0%} to {number.high:+.0%}"


def _counted(samples: Sequence[Sample]) -> str:
    """Say how many surfaces there are for each Hurst exponent and hardness."""
    return f"{min(one.count for one in samples)} surfaces each"
