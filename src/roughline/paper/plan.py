"""The paper's study as a plan, in minutes or at the paper's own sizes."""

from __future__ import annotations

from typing import Literal

from roughline.campaign.plan import Ensemble, Gallery, Plan, decades, evenly

StudyScale = Literal["quick", "full"]

PAPER_DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
"""The six fractal dimensions of the paper's Figures 3 and 4."""

ENSEMBLE_REDUCED = "lines"
ENSEMBLE_FULL = "surfaces"
ENSEMBLE_MATCHED = "lines-of-surfaces"
"""Lines of the reduced model with the waves of the surfaces and no shorter ones."""


def paper_plan(scale: StudyScale, seed: int = 2012) -> Plan:
    """Return the paper's study at one of two scales.

    Parameters
    ----------
    scale : {"quick", "full"}
        Minutes on two cores, or the paper's own sizes: 60 surfaces of 2048², 500 lines of 2^20.
    seed : int, optional
        Root of all seeds.
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
        fractal_dimensions=PAPER_DIMENSIONS,
        n=n,
        realisations=10 if quick else 60,
        force_bars=forces,
        seed=seed,
        boundary="free",
    )
    matched = Ensemble(
        name=ENSEMBLE_MATCHED,
        model="reduced",
        fractal_dimensions=PAPER_DIMENSIONS,
        n=256 * n,
        realisations=line_count,
        force_bars=forces,
        seed=seed,
        boundary="none",
        cutoff_ratio=n / 2,
    )
    gallery = Gallery(
        fractal_dimensions=(2.0, 7 / 3, 8 / 3, 3.0),
        n=n,
        n_line=2**12,
        force_bar=0.3,
        seed=seed,
    )
    return Plan(f"the paper, {scale} scale", (lines, matched, surfaces), gallery)
