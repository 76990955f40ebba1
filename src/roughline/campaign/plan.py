"""What a campaign computes: ensembles of random bodies, and a gallery of single ones."""

from __future__ import annotations

import math
import re
from dataclasses import asdict, dataclass
from typing import Any, Literal

import numpy as np

from roughline.errors import InputError
from roughline.spectra.self_affine import SelfAffine

Model = Literal["full", "reduced"]
Boundary = Literal["free", "periodic", "none"]

_SMALLEST, _LARGEST = 3, {"full": 2**15, "reduced": 2**28}
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]*")


@dataclass(frozen=True)
class Ensemble:
    """Random bodies of one model, pressed at the same dimensionless forces.

    Every body has length 1, rms height 1 and E* 1; phases are random, moduli fixed.

    Attributes
    ----------
    name : str
        Name of its group in the store.
    model : {"full", "reduced"}
        Surfaces in the half-space or lines on springs.
    fractal_dimensions : tuple of float
        One set of bodies for each; they share their phases.
    n : int
        Points along a side.
    realisations : int
        Bodies for each fractal dimension; body i has the seed ``(seed, spawn_key=(i,))``.
    force_bars : tuple of float
        Rising dimensionless forces F / (E* h L).
    seed : int
        Root of all seeds.
    boundary : {"free", "periodic", "none"}
        Of the half-space; "none" for lines.
    roll_off_ratio : float
        q_roll / q_low: the spectrum is flat below q_roll.
    cutoff_ratio : float or None
        q_high / q_low; None for the grid's own end.

    Raises
    ------
    InputError
        If a value is outside its range.
    """

    name: str
    model: Model
    fractal_dimensions: tuple[float, ...]
    n: int
    realisations: int
    force_bars: tuple[float, ...]
    seed: int
    boundary: Boundary
    roll_off_ratio: float = 1.0
    cutoff_ratio: float | None = None

    def __post_init__(self) -> None:
        def refuse(what: str) -> None:
            raise InputError(f"ensemble {self.name!r}: {what}")

        if not _NAME.fullmatch(self.name):
            refuse("a name has letters, digits, hyphens, dots and underscores")
        if self.model not in _LARGEST:
            refuse(f'model is {self.model!r}; allowed are "full" and "reduced"')
        boundaries = ("none",) if self.model == "reduced" else ("free", "periodic")
        if self.boundary not in boundaries:
            refuse(f"boundary is {self.boundary!r}; the {self.model} model has {boundaries}")
        if not _SMALLEST <= self.n <= _LARGEST[self.model]:
            refuse(f"{self.n} points; allowed are {_SMALLEST} to {_LARGEST[self.model]}")
        if self.realisations < 1:
            refuse(f"{self.realisations} realisations; at least one is needed")
        if self.seed < 0:
            refuse(f"seed is {self.seed}; a whole number from 0 on is needed")
        if not self.fractal_dimensions:
            refuse("no fractal_dimensions: give at least one, 2 to 3")
        for dimension in self.fractal_dimensions:
            if not 2 <= dimension <= 3:
                refuse(f"fractal dimension {dimension}; allowed is 2 to 3")
        if len(set(self.fractal_dimensions)) < len(self.fractal_dimensions):
            refuse("a fractal dimension is given twice; each is computed once")
        forces = np.array(self.force_bars, dtype=np.float64)
        if not forces.size:
            refuse("no force_bars: give at least one")
        if not (np.isfinite(forces).all() and forces[0] > 0 and (np.diff(forces) > 0).all()):
            refuse("force_bars must be positive, finite and rising")
        if not 1 <= self.roll_off_ratio < math.inf:
            refuse(f"roll_off_ratio is {self.roll_off_ratio}; q_roll / q_low is 1 or more")
        end = self.n / 2 if self.cutoff_ratio is None else self.cutoff_ratio
        if not self.roll_off_ratio < end <= self.n / 2:
            refuse(
                f"roll_off_ratio {self.roll_off_ratio:g} and cutoff_ratio {end:g} on {self.n} "
                "points; roll_off_ratio < cutoff_ratio <= points / 2 is needed"
            )

    def spectrum(self, fractal_dimension: float) -> SelfAffine:
        """Return the spectrum of the bodies of one fractal dimension."""
        q_low = 2 * math.pi
        return SelfAffine(
            fractal_dimension=fractal_dimension,
            rms_height=1.0,
            q_roll=self.roll_off_ratio * q_low,
            q_high=None if self.cutoff_ratio is None else self.cutoff_ratio * q_low,
        )

    def seed_of(self, realisation: int) -> np.random.SeedSequence:
        """Return the seed of one body; it does not depend on the number of bodies."""
        return np.random.SeedSequence(self.seed, spawn_key=(realisation,))

    def identity(self) -> dict[str, Any]:
        """Return all settings that the results of a body depend on.

        The number of bodies is not among them.
        """
        settings = asdict(self)
        for extent in ("name", "fractal_dimensions", "realisations"):
            del settings[extent]
        settings["force_bars"] = list(self.force_bars)
        settings["cutoff_ratio"] = self.cutoff_ratio or "grid"
        return settings

    @property
    def cases(self) -> int:
        """Number of bodies."""
        return len(self.fractal_dimensions) * self.realisations


@dataclass(frozen=True)
class Gallery:
    """Single bodies of both models for pictures, as in the paper's Figures 1 and 2.

    Attributes
    ----------
    fractal_dimensions : tuple of float
        One surface and one line for each.
    n, n_line : int
        Points along a side of the surface, points of the line.
    force_bar : float
        Dimensionless force on each body.
    seed : int
        Seed of all bodies; the surfaces share their phases.
    """

    fractal_dimensions: tuple[float, ...]
    n: int
    n_line: int
    force_bar: float
    seed: int


@dataclass(frozen=True)
class Plan:
    """A whole campaign.

    Attributes
    ----------
    name : str
        Name of the campaign.
    ensembles : tuple of Ensemble
        What is computed, in this order; no two of one name.
    gallery : Gallery or None
        Single bodies to look at.

    Raises
    ------
    InputError
        If there is no ensemble, or two have the same name.
    """

    name: str
    ensembles: tuple[Ensemble, ...]
    gallery: Gallery | None = None

    def __post_init__(self) -> None:
        if not self.ensembles:
            raise InputError("the plan has no ensemble: give at least one")
        names = [ensemble.name for ensemble in self.ensembles]
        for name in names:
            if names.count(name) > 1:
                raise InputError(f"two ensembles are named {name!r}: name them apart")

    def ensemble(self, name: str) -> Ensemble:
        """Return the ensemble of that name."""
        return next(ensemble for ensemble in self.ensembles if ensemble.name == name)

    @property
    def cases(self) -> int:
        """Number of bodies in all."""
        return sum(ensemble.cases for ensemble in self.ensembles)


def decades(low: float, high: float, per_decade: int) -> tuple[float, ...]:
    """Log-spaced values from `low` to at most `high`; powers of ten are exact if low is one."""
    steps = math.floor(per_decade * math.log10(high / low) + 1e-9)
    start = math.log10(low)
    values = [10 ** (start + step / per_decade) for step in range(steps + 1)]
    return tuple(float(f"{value:.14g}") for value in values)


def evenly(low: float, high: float, count: int) -> tuple[float, ...]:
    """Evenly spaced values, rounded to decimals such as a person types."""
    return tuple(round(float(value), 12) for value in np.linspace(low, high, count))
