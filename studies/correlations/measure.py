"""The study's numbers: dimensionless conductance of each surface, beside the correlations.

By Barber's identity the conductance of the interface per area is h_c = kappa_s k_u / (E* A_0), with
k_u the stiffness on unloading of a periodic surface. So the handbooks' h_c sigma / (kappa_s m) is
k_u sigma / (E* A_0 m). Here m = g / sqrt(pi) is the mean absolute slope of a cut, and g the own rms
slope of the surface. Surfaces have sigma = E* = A_0 = 1.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline import campaign
from roughline.computing.arrays import Mask, Real
from roughline.contact.scaling import EXACT_PUNCH, PUNCH_GRID_ERROR
from roughline.engineering.formulas import (
    holm_resistance,
    interface_stiffness,
    mikic_conductance,
    yovanovich_conductance,
)
from roughline.statistics.averages import Average, average
from roughline.statistics.power_law import PowerLaw, fit_power_law
from roughline.statistics.window import inside_window

HERE = Path(__file__).parent
DIMENSIONS = (2.2, 2.5, 2.7)
HARDNESSES = (1.0, 0.3, 0.1, 0.03, 0.01)
ELASTIC, FULL = math.inf, 0.01  # hardness_bar of the elastic and of the fully plastic bodies
FINE_HARDNESSES = (0.1, 0.01)
BANDS = {2: "band2", 4: "band4", 8: "main", 16: "band16", 32: "band32"}
"""Ensembles by q_high / q_roll; the last one has no elastic bodies."""
BOXES = {4: "box4", 8: "main", 16: "box16"}
"""Ensembles by the number of roll-off waves along a side."""
PRESSURES = (1e-4, 1e-3, 1e-2, 1e-1)
WINDOW = (1e-3, 1e-1)
"""Pressures at which the handbooks are judged."""

_UNIT_SLOPE = math.sqrt(math.pi)  # rms slope at which m = 1


def mikic(pressure: Real) -> Real:
    """Mikic's h_c sigma / (kappa_s m) of elastic surfaces under p / (E* g)."""
    over_m = pressure * _UNIT_SLOPE  # p / (E* m)
    return mikic_conductance(over_m, 1.0, 1.0, _UNIT_SLOPE, (1.0, 1.0))


def yovanovich(pressure: Real) -> Real:
    """h_c sigma / (kappa_s m) under p / H, after Cooper, Mikic and Yovanovich."""
    return yovanovich_conductance(pressure, 1.0, 1.0, _UNIT_SLOPE, (1.0, 1.0))


def holm(pressure: Real, slope: float) -> Real:
    """h_c sigma / (kappa_s m) of Holm's single spot under p / H, for the rms slope of a surface."""
    conductance = 1 / holm_resistance(pressure, 1.0, (1.0, 1.0))  # conductivities 1: kappa_s = 1
    return conductance / (slope / _UNIT_SLOPE)


@dataclass(frozen=True, eq=False)
class Sample:
    """Surfaces of one spectrum and hardness, at four pressures a decade."""

    prefix: str  # first part of the name of the ensemble
    every: int  # which loads were read: all, or with 2 every other one
    fractal_dimension: float  # D_f
    hardness_bar: float  # H / (E* g); infinite if elastic
    slope: float  # rms slope g, over sigma / L; that of each surface to some parts in 100,000
    pressure: Real  # shape (pressures,): p / H, or p / (E* g) of elastic bodies
    # shape (realisations, pressures), and NaN beside a load that was not solved
    conductance: Real  # h_c sigma / (kappa_s m)
    area: Real  # A / A_0
    plastic: Real  # share of the contact at the hardness

    @property
    def elastic(self) -> bool:
        """Whether the bodies have no hardness."""
        return self.hardness_bar == ELASTIC

    @property
    def count(self) -> int:
        """Number of realisations."""
        return len(self.conductance)

    @property
    def over_mikic(self) -> Real:
        """Conductance over Mikic's under the same p / (E* g)."""
        scale = 1.0 if self.elastic else self.hardness_bar
        return self.conductance / mikic(self.pressure * scale)

    @property
    def over_yovanovich(self) -> Real:
        """Conductance over that of Cooper, Mikic and Yovanovich; of bodies with a hardness."""
        return self.conductance / yovanovich(self.pressure)

    @property
    def ratio(self) -> Real:
        """Conductance over Mikic's of elastic bodies, else over the plastic correlation."""
        return self.over_mikic if self.elastic else self.over_yovanovich

    @property
    def in_window(self) -> Mask:
        """Which pressures lie in the window."""
        return inside_window(self.pressure, WINDOW)

    @property
    def variable(self) -> Real:
        """The handbook's variable: p / H, or sqrt(2) p / (E* m) of elastic bodies."""
        return self.pressure * (math.sqrt(2) * _UNIT_SLOPE if self.elastic else 1.0)

    def places(self, *pressures: float) -> list[int]:
        """Return which of the pressures are the nearest to these, by their numbers."""
        return [int(np.abs(self.pressure / each - 1).argmin()) for each in pressures]

    def mean_at(self, values: Real, *pressures: float) -> Average:
        """Average values at some of the pressures over the realisations."""
        return average(values[:, self.places(*pressures)])

    def fit(self) -> PowerLaw:
        """Fit c x^a to the mean conductance in the window, x the handbook's variable."""
        inside = self.in_window
        solved = np.isfinite(self.conductance[:, inside]).all(axis=1)
        x = self.variable[inside]
        return fit_power_law(x, self.conductance[solved][:, inside], (x[0], x[-1]))


@cache
def plan() -> campaign.Plan:
    """Read the plan of the study."""
    return campaign.read_plan(HERE / "plan.toml")


@cache
def data() -> Mapping[str, NDArray[Any]]:
    """Read the reduced data: arrays by "ENSEMBLE/VARIABLE"."""
    with np.load(HERE / "data.npz") as arrays:
        return dict(arrays)


def version() -> str:
    """Return the version of roughline that computed the data."""
    return str(data()["roughline_version"])


def name_of(prefix: str, hardness_bar: float) -> str:
    """Return the name of an ensemble."""
    return f"{prefix}-elastic" if hardness_bar == ELASTIC else f"{prefix}-hardness{hardness_bar:g}"


def dimensions_of(prefix: str) -> tuple[float, ...]:
    """Return the fractal dimensions of an ensemble's fully plastic bodies."""
    return plan().ensemble(name_of(prefix, FULL)).fractal_dimensions


@cache
def sample(prefix: str, hardness_bar: float, fractal_dimension: float, *, every: int = 1) -> Sample:
    """Return the surfaces of an ensemble and a fractal dimension.

    Values are read between the loads, linear in the logarithms. The stiffness of free surfaces is
    that of the interface alone, 1 / k_i = 1 / k - 1 / k_s. To compare with an ensemble that has no
    more, with `every` 2 values are read between every other load alone.
    """
    ensemble = plan().ensemble(name_of(prefix, hardness_bar))
    place = ensemble.fractal_dimensions.index(fractal_dimension)
    elastic = hardness_bar == ELASTIC

    def of(variable: str) -> Real:
        return data()[f"{ensemble.name}/{variable}"][place].astype(np.float64)

    slopes = of("rms_slope")
    slope = float(slopes.mean())
    loads = np.array(ensemble.force_bars) / (slope * (1.0 if elastic else hardness_bar))
    pressure = _pressures_between(loads)

    def read(values: Real) -> Real:
        x = np.log(loads[::every])
        rows = [np.interp(np.log(pressure), x, row[::every]) for row in values]
        return np.array(rows)

    stiffness = of("stiffness" if elastic else "unloading_stiffness")
    if ensemble.boundary == "free":
        punch = EXACT_PUNCH - PUNCH_GRID_ERROR / ensemble.n
        stiffness = interface_stiffness(stiffness, punch)
    area = np.exp(read(np.log(of("area_fraction"))))
    return Sample(
        prefix,
        every,
        fractal_dimension,
        hardness_bar,
        slope,
        pressure,
        conductance=np.exp(read(np.log(stiffness))) * _UNIT_SLOPE / slopes[:, np.newaxis],
        area=area,
        plastic=np.zeros_like(area) if elastic else read(of("plastic_fraction")),
    )


def _pressures_between(loads: Real) -> Real:
    """Return the pressures, four a decade, that the loads enclose."""
    all_of_them = 10 ** (np.arange(-16, -3) / 4)
    return all_of_them[(all_of_them >= loads[0]) & (all_of_them <= loads[-1])]
