"""The paper's study as a plan, in minutes or at the paper's own sizes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

from roughline.campaign.plan import Ensemble, Plan, decades, evenly

_DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)  # of the paper's Figures 3 and 4

ENSEMBLE_REDUCED = "lines"
ENSEMBLE_FULL = "surfaces"
ENSEMBLE_MATCHED = "lines-of-surfaces"
"""Lines of the reduced model with the waves of the surfaces and no shorter ones."""


def paper_plan(scale: Literal["quick", "full"], seed: int = 2012) -> Plan:
    """Return the paper's study, for minutes on two cores or at its own sizes.

    These are 60 surfaces of 2048² and 500 lines of 2^20. All seeds grow from the seed.
    """
    quick = scale == "quick"
    n = 256 if quick else 2048
    line_count = 100 if quick else 500
    forces = decades(1e-3, 1e1, per_decade=6)
    lines = Ensemble(
        name=ENSEMBLE_REDUCED,
        model="reduced",
        fractal_dimensions=evenly(2, 3, 21 if quick else 101),
        n=2**16 if quick else 2**20,
        realisations=line_count,
        force_bars=decades(1e-5, 1e1, per_decade=10),
        seed=seed,
        boundary="none",
    )
    surfaces = Ensemble(
        name=ENSEMBLE_FULL,
        model="full",
        fractal_dimensions=_DIMENSIONS,
        n=n,
        realisations=10 if quick else 60,
        force_bars=forces,
        seed=seed,
        boundary="free",
    )
    matched = Ensemble(
        name=ENSEMBLE_MATCHED,
        model="reduced",
        fractal_dimensions=_DIMENSIONS,
        n=256 * n,
        realisations=line_count,
        force_bars=forces,
        seed=seed,
        boundary="none",
        cutoff_ratio=n / 2,
    )
    return Plan(f"the paper, {scale} scale", (lines, matched, surfaces))


def with_settings(
    plan: Plan,
    *,
    fractal_dimensions: tuple[float, ...] | None = None,
    points: int | None = None,
    realisations: int | None = None,
    line_points: int | None = None,
    lines: int | None = None,
    force_bars: tuple[float, ...] | None = None,
) -> Plan:
    """Return the paper's study with settings of one's own; what is not given stays.

    The fractal dimensions are those of surfaces and lines, the loads those of the surfaces and of
    the lines with their waves; `realisations` and `lines` are for each fractal dimension. A value
    outside its range is refused.
    """
    changes: dict[str, dict[str, Any]] = {
        ENSEMBLE_REDUCED: {"n": line_points, "realisations": lines},
        ENSEMBLE_MATCHED: {"realisations": lines, "force_bars": force_bars},
        ENSEMBLE_FULL: {"n": points, "realisations": realisations, "force_bars": force_bars},
    }
    for each in changes.values():
        each["fractal_dimensions"] = fractal_dimensions
    if points is not None:
        changes[ENSEMBLE_MATCHED] |= {"n": 256 * points, "cutoff_ratio": points / 2}
    changed = {
        each.name: replace(
            each, **{key: value for key, value in changes[each.name].items() if value is not None}
        )
        for each in reversed(plan.ensembles)  # surfaces first: what is wrong is said of them
    }
    return replace(plan, ensembles=tuple(changed[each.name] for each in plan.ensembles))
