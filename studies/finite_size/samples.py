"""The study's ensembles: stiffness over force in units of one roll-off wave.

Surfaces have L = h = E* = 1, and L / lambda_r roll-off waves along a side, with lambda_r =
2 pi / q_roll. In units of such a wave, force and stiffness are F / (E* h lambda_r) and
k / (E* lambda_r). Then k = p / (gamma h) reads k / (E* lambda_r) = F / (E* h lambda_r) / gamma,
whatever the size.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

import roughline as rl
from roughline.computing.arrays import Mask, Real
from roughline.contact.scaling import EXACT_PUNCH, PUNCH_GRID_ERROR
from roughline.contact.status import Status
from roughline.engineering.formulas import interface_stiffness
from studies.reduced_data import Reduced

if TYPE_CHECKING:
    import xarray

REDUCED = Reduced(Path(__file__).parent, ("stiffness", "status", "resolved"))

Geometry = Literal["periodic", "free", "lines"]
GEOMETRIES: tuple[Geometry, ...] = ("periodic", "free", "lines")
HURSTS = (0.8, 0.5, 0.2)
BAND, WIDE = 16, 64
"""q_high / q_roll."""
SIZES = {BAND: (1, 2, 4, 8, 16, 32), WIDE: (1, 2, 4)}
"""Roll-off waves along a side, by the band."""
FINE_SIZES = (2, 8)
"""Those pressed with eight cells for the shortest wave too, periodic, band 16."""
RESOLVED = 0.95
"""Share of the bodies that must have ten cells or springs in contact."""
_NEAR_PUNCH = 0.9
"""Share of the punch's stiffness up to which a free surface shows that of its interface."""


@dataclass(frozen=True, eq=False)
class Sample:
    """Bodies of one spectrum and size in one geometry, in units of a roll-off wave."""

    geometry: Geometry  # half-space, or springs
    band: int  # q_high / q_roll
    size: int  # L / lambda_r
    hurst: float  # H
    force: Real  # shape (loads,): F / (E* h lambda_r)
    # shape (realisations, loads): k / (E* lambda_r)
    stiffness: Real  # of a free surface that of its interface, 1 / (1/k - 1/k_s)
    whole: Real  # as pressed, with the punch that a free surface is
    # loads of the plan that are not here: a body was not solved, or more than one of twenty have
    # fewer than ten cells or springs in contact, or free surfaces are in the mean more than 90 % as
    # stiff as the punch
    left_out: int

    @property
    def count(self) -> int:
        """Number of realisations."""
        return len(self.stiffness)

    @property
    def force_bar(self) -> Real:
        """F / (E* h L), shape (loads,)."""
        return self.force / self.size

    @property
    def pressure(self) -> Real:
        """P lambda_r / (E* h), shape (loads,)."""
        return self.force / self.size**2

    @property
    def gamma(self) -> Real:
        """F / (k h) of the mean stiffness, shape (loads,)."""
        return self.force / self.stiffness.mean(axis=0)

    def first(self, count: int) -> Sample:
        """Return the first realisations alone."""
        return replace(self, stiffness=self.stiffness[:count], whole=self.whole[:count])


@cache
def sample(geometry: Geometry, band: int, size: int, hurst: float, fine: bool = False) -> Sample:
    """Return the bodies of one spectrum, size and geometry."""
    name = f"fine-{size}" if fine else f"{'wide-' if band == WIDE else ''}{geometry}-{size}"
    ensemble = REDUCED.plan.ensemble(name)
    one = REDUCED.data[name].sel(fractal_dimension=3 - hurst)
    whole, usable = one.stiffness.values, _usable(one)
    stiffness = whole
    if geometry == "free":
        punch = EXACT_PUNCH - PUNCH_GRID_ERROR / ensemble.n
        usable &= np.nan_to_num(whole, nan=np.inf).mean(axis=0) < _NEAR_PUNCH * punch
        stiffness = interface_stiffness(whole, punch)
    return Sample(
        geometry=geometry,
        band=band,
        size=size,
        hurst=hurst,
        force=one.force_bar.values[usable] * size,
        stiffness=stiffness[:, usable] * size,
        whole=whole[:, usable] * size,
        left_out=int(np.count_nonzero(~usable)),
    )


def persson(one: Sample) -> Real:
    """Stiffness of Persson's theory at the loads of a sample, k / (E* lambda_r)."""
    name = f"{'wide-' if one.band == WIDE else ''}periodic-{one.size}"
    ensemble = REDUCED.plan.ensemble(name)
    lattice = ensemble.spectrum(3 - one.hurst).lattice(ensemble.n)
    stiffness = rl.theory("persson", lattice, 1.0, one.force_bar).stiffness
    assert stiffness is not None  # of this theory
    return stiffness * one.size


def _usable(one: xarray.Dataset) -> Mask:
    """Whether a load is solved in all bodies and resolved in nearly all, shape (loads,)."""
    solved = (one.status.values == Status.CONVERGED).all(axis=0)
    return solved & ((one.resolved.values == 1).mean(axis=0) >= RESOLVED)
