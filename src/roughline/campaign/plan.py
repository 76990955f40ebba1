"""What a study computes: ensembles of random bodies, and a gallery of single ones."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Literal

import numpy as np

from roughline._version import __version__

Model = Literal["full", "reduced"]
Scale = Literal["quick", "full"]

PAPER_DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
"""The six fractal dimensions of the paper's Figures 3 and 4."""


@dataclass(frozen=True)
class Ensemble:
    """Random bodies of one model, pressed at the same dimensionless forces.

    Every body has length 1, rms height 1 and E* 1; phases are random, moduli fixed, and the
    spectrum falls from 2 pi / length to the grid.

    Attributes
    ----------
    model : {"full", "reduced"}
        Surfaces in the half-space or lines on springs.
    fractal_dimensions : tuple of float
        One ensemble for each; they share their phases.
    n : int
        Points along a side.
    realisations : int
        Bodies for each fractal dimension; body i has the seed ``(seed, spawn_key=(i,))``.
    force_bars : tuple of float
        Rising dimensionless forces F / (E* h L).
    seed : int
        Root of all seeds.
    batch : int
        Bodies that are computed, and stored, together.
    """

    model: Model
    fractal_dimensions: tuple[float, ...]
    n: int
    realisations: int
    force_bars: tuple[float, ...]
    seed: int
    batch: int

    def seed_of(self, realisation: int) -> np.random.SeedSequence:
        """Return the seed of one body, which does not depend on how many there are."""
        return np.random.SeedSequence(self.seed, spawn_key=(realisation,))

    def cases(self) -> list[Case]:
        """List the batches, dimension by dimension within each batch of realisations."""
        return [
            Case(self, i, range(start, min(start + self.batch, self.realisations)))
            for start in range(0, self.realisations, self.batch)
            for i in range(len(self.fractal_dimensions))
        ]


@dataclass(frozen=True)
class Case:
    """One batch of one ensemble: the unit of work and of storage."""

    ensemble: Ensemble
    dimension_index: int
    realisations: range


@dataclass(frozen=True)
class Gallery:
    """Single bodies of both models for the paper's Figures 1 and 2.

    Attributes
    ----------
    fractal_dimensions : tuple of float
        One surface and one line for each.
    n, n_line : int
        Points along a side of the surface, points of the line.
    force_bar : float
        The dimensionless force that all are pressed with.
    seed : int
        Seed of all; the surfaces share their phases.
    """

    fractal_dimensions: tuple[float, ...]
    n: int
    n_line: int
    force_bar: float
    seed: int


@dataclass(frozen=True)
class Plan:
    """A whole study.

    Attributes
    ----------
    scale : str
        Its name.
    full, reduced : Ensemble
        Surfaces and lines.
    gallery : Gallery
        Single bodies to look at.
    """

    scale: str
    full: Ensemble
    reduced: Ensemble
    gallery: Gallery

    def settings(self) -> dict[str, object]:
        """Everything the results depend on, the version included."""
        return {"roughline_version": __version__, **asdict(self)}


def paper_plan(scale: Scale, seed: int = 2012) -> Plan:
    """Return the paper's study at one of two scales.

    Parameters
    ----------
    scale : {"quick", "full"}
        Minutes on two cores, or the paper's own sizes: 60 surfaces of 2048², 500 lines of 2^20.
    seed : int, optional
        Root of all seeds.
    """
    quick = scale == "quick"
    count_1d = 21 if quick else 101
    full = Ensemble(
        model="full",
        fractal_dimensions=PAPER_DIMENSIONS,
        n=256 if quick else 2048,
        realisations=10 if quick else 60,
        force_bars=_decades(1e-3, 1e1, per_decade=6),
        seed=seed,
        batch=1,
    )
    reduced = Ensemble(
        model="reduced",
        fractal_dimensions=tuple(round(2 + i / (count_1d - 1), 12) for i in range(count_1d)),
        n=2**16 if quick else 2**20,
        realisations=100 if quick else 500,
        force_bars=_decades(1e-5, 1e1, per_decade=10),
        seed=seed,
        batch=20,
    )
    gallery = Gallery(
        fractal_dimensions=(2.0, 7 / 3, 8 / 3, 3.0),
        n=256 if quick else 1024,
        n_line=2**12,
        force_bar=0.3,
        seed=seed,
    )
    return Plan(scale, full, reduced, gallery)


def _decades(low: float, high: float, per_decade: int) -> tuple[float, ...]:
    """Log-spaced values that hit every power of ten exactly."""
    start, end = round(np.log10(low)), round(np.log10(high))
    steps = range(start * per_decade, end * per_decade + 1)
    return tuple(float(f"{10 ** (step / per_decade):.15g}") for step in steps)
