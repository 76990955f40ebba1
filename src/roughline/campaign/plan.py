"""What a campaign computes: ensembles of random bodies."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, fields
from typing import Any, Literal, NoReturn

import numpy as np

from roughline.campaign.by_name import described
from roughline.contact.arguments import yielding_law
from roughline.contact.shear_loads import LARGEST_SHARE_HELD, refuse_unknown_shear
from roughline.errors import InputError
from roughline.errors.public import public_making
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.pulling_zone import resolves_pull_off, zone
from roughline.halfspace.operators.cell import cell_compliance
from roughline.spectra.self_affine import SelfAffine

_ModelName = Literal["full", "reduced"]

_FEWEST_POINTS, _MOST_POINTS = 3, {"full": 2**15, "reduced": 2**28}
BODIES = ("hardness_bar", "law", "half_space", "friction", "shear_bars")
"""Settings of bodies that are not elastic, or not of one material, or rub; others have none."""

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]*")


@public_making
@dataclass(frozen=True)
class Ensemble:
    """Random bodies of one model, pressed at the same dimensionless forces.

    Every body has length L = 1, rms height h = 1 and E* = 1; phases are random, moduli fixed. So
    pressures are over E* h / L, gaps over h, and lengths along the surface over L.

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
    boundary : str, optional
        Of the half-space, "free" or "periodic", or as `half_space` has it; "none" for lines.
    roll_off_ratio : float
        q_roll / q_low: the spectrum is flat below q_roll.
    cutoff_ratio : float or None
        q_high / q_low; None for the largest wavenumber of the grid.
    hardness_bar : float or None
        H / (E* g) with g the rms slope of each body, its own :attr:`~roughline.Surface.rms_slope`
        on its grid. None for elastic bodies; infinity becomes None. Full model only.
    law : ContactLaw or None
        What pressures and gaps obey; None where bodies only push, or for `hardness_bar`. So
        ``rl.Dugdale(0.2, 0.4)`` has w L / (E* h²) = 0.2 and h_0 / h = 0.4. Bodies that stick are
        drawn apart after their largest load. Full model only.
    half_space : HalfSpace or None
        What bodies are pressed into, in place of a homogeneous half-space. Its moduli are taken
        over its E*. Full model only.
    friction : Friction or None
        What points in contact bear of shear. Loads are then a path, which may stay and fall, and
        the half-space needs a Poisson's ratio. Full model only.
    shear_bars : tuple of float or None
        With friction, the shear force Q / (E* h L) along x at each of the forces.

    Raises
    ------
    InputError
        If a value is outside its range.
    """

    name: str
    model: _ModelName
    fractal_dimensions: tuple[float, ...]
    n: int
    realisations: int
    force_bars: tuple[float, ...]
    seed: int
    boundary: str = ""
    roll_off_ratio: float = 1.0
    cutoff_ratio: float | None = None
    hardness_bar: float | None = None
    law: ContactLaw | None = None
    half_space: HalfSpace | None = None
    friction: Friction | None = None
    shear_bars: tuple[float, ...] | None = None

    def __post_init__(self) -> None:
        refuse = self._refuse
        if self.hardness_bar == math.inf:
            object.__setattr__(self, "hardness_bar", None)
        if not _NAME.fullmatch(self.name):
            refuse("a name has letters, digits, hyphens, dots and underscores")
        if self.model not in _MOST_POINTS:
            refuse(f'model is {self.model!r}; allowed are "full" and "reduced"')
        self._refuse_boundary()
        if not _FEWEST_POINTS <= self.n <= _MOST_POINTS[self.model]:
            refuse(f"{self.n} points; allowed are {_FEWEST_POINTS} to {_MOST_POINTS[self.model]}")
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
        if self.law is not None:
            self._refuse_law(self.law)
        self._refuse_shear()

    def _refuse_boundary(self) -> None:
        """Refuse another boundary than that of the half-space; where none is given, take that."""
        allowed = ("none",) if self.model == "reduced" else ("free", "periodic")
        if self.half_space is not None:
            if not isinstance(self.half_space, HalfSpace):
                self._refuse(f"half_space is {self.half_space!r}; an rl.HalfSpace is needed")
            if self.model == "reduced":
                self._refuse("half_space is given, and lines lie on springs: leave it out")
            allowed = (self.half_space.boundary,)
        if not self.boundary:
            object.__setattr__(self, "boundary", allowed[0])
        if self.boundary not in allowed:
            had = " or ".join(map(repr, allowed))
            what = f"the {self.model} model" if self.half_space is None else "the half-space"
            self._refuse(f"boundary is {self.boundary!r}; {what} has {had}")

    def _refuse(self, what: str) -> NoReturn:
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
                    "sort them; a plan without friction has no loading histories: for falling "
                    "loads use rl.press(surface, forces=[...])"
                )
            before = 0.0 if self.friction is not None else force  # whose loads are a path

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
        largest = max(self.force_bars)  # of a path it need not be the last
        for dimension in self.fractal_dimensions:
            # differences on the grid miss some of the slope that the waves have
            most = hardness_bar * self.spectrum(dimension).lattice(self.n).rms_slope
            if not largest < most:
                self._refuse(
                    f"force_bar {largest:g} at fractal dimension {dimension:g}: bodies "
                    f"with hardness_bar {hardness_bar:g} bear less than H A_0, which is at most "
                    f"{most:.3g} here: give smaller force_bars, or a larger hardness_bar"
                )

    def _refuse_law(self, law: ContactLaw) -> None:
        """Refuse a law that a plan cannot have, loads beyond it, and grids that are too coarse."""
        if not isinstance(law, ContactLaw):
            self._refuse(f"law is {law!r}; an rl.ContactLaw is needed")
        if self.model == "reduced":
            self._refuse(
                "law is given, and the springs of the reduced model only push: leave it out"
            )
        if self.hardness_bar is not None:
            self._refuse("law and hardness_bar are given; one of the two is needed")
        if not self.force_bars[-1] < (most := Bounds.of(law).largest_force(1.0)):
            self._refuse(
                f"force_bar {self.force_bars[-1]:g} is more than the law bears, which is less than "
                f"{most:.3g}: give smaller force_bars"
            )
        try:
            grid = (self.n, self.n), (1 / self.n, 1 / self.n)
            law.refuse_grid(cell_compliance(self.pressed_into, *grid))
        except InputError as error:
            self._refuse(str(error))
        in_cells = law.scaled(1.0, 1 / self.n)
        if not (law.only_pushes or resolves_pull_off(in_cells)):
            self._refuse(
                "the zone that pulls about a contact, n L E* w / (pi sigma_0²), is "
                f"{zone(in_cells):.2g} cells wide, which resolves no pull-off: give a law with a "
                "longer range, or more points"
            )

    def _refuse_shear(self) -> None:
        """Refuse friction that a plan cannot have, and shear that is not borne."""
        friction, shears, forces = self.friction, self.shear_bars, self.force_bars
        if friction is None:
            if shears is not None:
                self._refuse(
                    "shear_bars are given without friction, and without it nothing bears "
                    "shear: give friction = 0.3 too"
                )
            return
        if not isinstance(friction, Friction):
            self._refuse(f"friction is {friction!r}; an rl.Friction is needed, such as 0.3")
        if self.model == "reduced":
            self._refuse('friction is given, and a plan has it of surfaces: take model = "full"')
        if self.law is not None:
            self._refuse("friction of bodies that stick is not solved: leave law out")
        if shears is None:
            self._refuse(
                "friction is given without shear_bars: give a shear force Q / (E* h L) "
                "for each of force_bars"
            )
        if len(shears) != len(forces):
            self._refuse(
                f"shear_bars are {len(shears)} and force_bars are {len(forces)}; give as "
                "many of both"
            )
        try:
            friction.refuse_other_grids((self.n, self.n))
            refuse_unknown_shear(self.pressed_into)
        except InputError as error:
            self._refuse(str(error))
        for shear, force in zip(shears, forces, strict=True):
            limit = math.inf
            if isinstance(friction.coefficient, float):
                limit = friction.coefficient * force * LARGEST_SHARE_HELD
            if not abs(shear) < limit:
                self._refuse(
                    f"shear_bar {shear:g} at force_bar {force:g}: friction bears less than mu F = "
                    f"{limit:.6g} there; give less"
                )

    def contact_law(self, rms_slope: float) -> ContactLaw:
        """Return what pressures and gaps of a body obey that has such a rms slope."""
        if self.law is not None:
            return self.law
        return yielding_law(None if self.hardness_bar is None else self.hardness_bar * rms_slope)

    @property
    def pressed_into(self) -> HalfSpace:
        """What bodies are pressed into, in units in which E* is 1."""
        if self.half_space is None:
            return Homogeneous(1.0, periodic=self.boundary == "periodic")
        return self.half_space.in_units(self.half_space.E_star, 1.0)

    @property
    def memory(self) -> Literal["none", "dents", "path"]:
        """What loads leave in the bodies, as their contact law says."""
        return self.contact_law(1.0).memory

    def spectrum(self, fractal_dimension: float) -> SelfAffine:
        """Return the spectrum of the bodies of one fractal dimension."""
        q_low = 2 * math.pi
        return SelfAffine(
            fractal_dimension=fractal_dimension,
            rms_height=1.0,
            q_roll=self.roll_off_ratio * q_low,
            q_high=None if self.cutoff_ratio is None else self.cutoff_ratio * q_low,
        )

    def body_seed(self, realisation: int) -> np.random.SeedSequence:
        """Return the seed of one body; it does not depend on the number of bodies."""
        return np.random.SeedSequence(self.seed, spawn_key=(realisation,))

    def identity(self) -> dict[str, Any]:
        """Return all settings that the results of a body depend on.

        The number of bodies is not among them.
        """
        extent = ("name", "fractal_dimensions", "realisations")
        settings = {
            each.name: getattr(self, each.name) for each in fields(self) if each.name not in extent
        }
        settings["force_bars"] = list(self.force_bars)
        settings["cutoff_ratio"] = self.cutoff_ratio or "grid"
        for name in BODIES:
            if settings[name] is None:  # so that stores of elastic bodies are as they always were
                del settings[name]
            elif name not in ("hardness_bar", "shear_bars"):
                settings[name] = described(settings[name])
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
