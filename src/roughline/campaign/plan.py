"""What a campaign computes: ensembles of random bodies."""

from __future__ import annotations

import math
import re
from dataclasses import asdict, dataclass
from typing import Any, Literal

import numpy as np

from roughline.contact.arguments import STICKING, sticking_law
from roughline.errors import InputError
from roughline.errors.checks import one_of
from roughline.halfspace.laws.pulling_zone import resolves_pull_off, zone
from roughline.spectra.self_affine import SelfAffine

_Model = Literal["full", "reduced"]
_Boundary = Literal["free", "periodic", "none"]

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
        q_high / q_low; None for the largest wavenumber of the grid.
    hardness_bar : float or None
        H / (E* g) with g the rms slope of each body, its own :attr:`~roughline.Surface.rms_slope`
        on its grid. None for elastic bodies; infinity becomes None. Full model only.
    work_bar, range_bar : float or None
        w L / (E* h²), the work of adhesion, and h_0 / h, the range of the pull, of bodies that
        stick; None where they only push. Each body is then drawn apart after its largest load.
        Full model, without a hardness.
    attraction : {"dugdale", "exponential"}
        Law of the pull.

    Raises
    ------
    InputError
        If a value is outside its range.
    """

    name: str
    model: _Model
    fractal_dimensions: tuple[float, ...]
    n: int
    realisations: int
    force_bars: tuple[float, ...]
    seed: int
    boundary: _Boundary
    roll_off_ratio: float = 1.0
    cutoff_ratio: float | None = None
    hardness_bar: float | None = None
    work_bar: float | None = None
    range_bar: float | None = None
    attraction: str = "dugdale"

    def __post_init__(self) -> None:
        refuse = self._refuse
        if self.hardness_bar == math.inf:
            object.__setattr__(self, "hardness_bar", None)
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
        self._refuse_forces()
        if not 1 <= self.roll_off_ratio < math.inf:
            refuse(f"roll_off_ratio is {self.roll_off_ratio}; q_roll / q_low is 1 or more")
        end = self.n / 2 if self.cutoff_ratio is None else self.cutoff_ratio
        if not self.roll_off_ratio < end <= self.n / 2:
            refuse(
                f"roll_off_ratio {self.roll_off_ratio:g} and cutoff_ratio {end:g} on {self.n} "
                "points; roll_off_ratio < cutoff_ratio <= points / 2 is needed"
            )
        if self.hardness_bar is not None:
            self._refuse_hardness(self.hardness_bar)
        self._refuse_adhesion()

    def _refuse(self, what: str) -> None:
        raise InputError(f"ensemble {self.name!r}: {what}")

    def _refuse_forces(self) -> None:
        """Refuse forces that a plan cannot have."""
        if not self.force_bars:
            self._refuse("no force_bars: give at least one")
        before = 0.0
        for force in self.force_bars:
            if not before < force < math.inf:
                after = f" after {before:g}" if before else ""
                self._refuse(
                    f"force_bars must be positive, finite and rising, and {force:g} came{after}: "
                    "sort them; a plan has no loading histories: for falling loads use "
                    "rl.press(surface, forces=[...])"
                )
            before = force

    def _refuse_hardness(self, hardness_bar: float) -> None:
        """Refuse a hardness that a plan cannot have, and loads that no body of it bears."""
        if not hardness_bar > 0:
            self._refuse(
                f"hardness_bar is {hardness_bar}; a positive H / (E* times the rms slope) is "
                "needed, or none for elastic bodies"
            )
        if self.model == "reduced":
            self._refuse(
                f"hardness_bar is {hardness_bar:g}, and the reduced model has no yield: leave it "
                'out, or take model = "full"'
            )
        for dimension in self.fractal_dimensions:
            # differences on the grid miss some of the slope that the waves have
            most = hardness_bar * self.spectrum(dimension).lattice(self.n).rms_slope
            if not self.force_bars[-1] < most:
                self._refuse(
                    f"force_bar {self.force_bars[-1]:g} at fractal dimension {dimension:g}: bodies "
                    f"with hardness_bar {hardness_bar:g} bear less than H A_0, which is at most "
                    f"{most:.3g} here: give smaller force_bars, or a larger hardness_bar"
                )

    def _refuse_adhesion(self) -> None:
        """Refuse an adhesion that a plan cannot have."""
        given = {"work_bar": self.work_bar, "range_bar": self.range_bar}
        one_of("attraction", self.attraction, tuple(STICKING))
        if self.work_bar is None and self.range_bar is None:
            return
        for name, value in given.items():
            if value is None or not 0 < value < math.inf:
                self._refuse(
                    f"{name} is {value}; bodies that stick need a positive, finite work_bar, "
                    "w L / (E* h²), and range_bar, h_0 / h"
                )
        if self.model == "reduced" or self.hardness_bar is not None:
            other = "the reduced model" if self.model == "reduced" else "bodies that yield"
            self._refuse(f"work_bar is {self.work_bar}, and {other} cannot stick: leave it out")
        assert self.work_bar is not None
        assert self.range_bar is not None
        law = sticking_law(self.attraction, self.work_bar, self.range_bar).scaled(1.0, 1 / self.n)
        if not resolves_pull_off(law):
            self._refuse(
                f"the zone that pulls about a contact, n range_bar² / (pi work_bar), is "
                f"{zone(law):.2g} cells wide, which resolves no "
                "pull-off: give a larger range_bar, or more points"
            )

    @property
    def memory(self) -> Literal["none", "dents", "path"]:
        """What loads leave in the bodies, as their contact law says."""
        if self.work_bar is not None:
            return "path"
        return "none" if self.hardness_bar is None else "dents"

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
        if self.hardness_bar is None:  # so that stores of elastic bodies are as they always were
            del settings["hardness_bar"]
        if self.work_bar is None:
            for name in ("work_bar", "range_bar", "attraction"):
                del settings[name]
        return settings

    @property
    def cases(self) -> int:
        """Number of bodies."""
        return len(self.fractal_dimensions) * self.realisations


@dataclass(frozen=True)
class Plan:
    """A whole campaign.

    Attributes
    ----------
    name : str
        Name of the campaign.
    ensembles : tuple of Ensemble
        What is computed, in this order; their names differ.

    Raises
    ------
    InputError
        If there is no ensemble, or two have the same name.
    """

    name: str
    ensembles: tuple[Ensemble, ...]

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
    """Evenly spaced values, rounded to 12 decimals."""
    return tuple(round(float(value), 12) for value in np.linspace(low, high, count))
