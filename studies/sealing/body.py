"""One body of the study: where it seals, what leaks before, and how far it may be unloaded.

Bodies have rms height, side and E* 1. Loads are p / (E* g), with g the rms slope of the spectrum,
and so is the hardness.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise

import numpy as np

import roughline as rl
from roughline.contact.curve import SurfaceCurve
from roughline.errors import ConvergenceError
from roughline.fluid.gap import Along
from roughline.fluid.sealing_pressure import OPEN

SEED = 2012
BAND = 4
"""q_high / q_roll."""
ELASTIC, WEAK, MOSTLY, FULL = math.inf, 1.0, 0.3, 0.1
"""Hardnesses H / (E* g): at sealing none, an eighth, most and nearly all of the contact yields."""
LOADS = (0.005, 0.01, 0.02, 0.03, 0.04, 0.06, 0.09, 0.13, 0.18)
"""Loads under which the flow is computed, as far as they are below the hardness."""
MEDIA = (0.5, 0.42)
"""Areas at which effective media of the gaps of a body seal."""
PEAKS = (0.8, 0.95, 1.2)
"""Largest loads before unloading, over the sealing pressure along x."""
FRACTIONS = (
    *(0.97, 0.94, 0.91, 0.88, 0.85, 0.82, 0.78, 0.74, 0.7, 0.6, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15),
    *(0.1, 0.07, 0.05, 0.03, 0.02, 0.01),
)
"""Loads on unloading, over the largest load."""
TENFOLD = 10.0
"""Leak, over that under the largest load, up to which bodies are unloaded."""
COMPARED = 0.5
"""Load, over the largest, under which the leaks on unloading and on loading are compared."""

_SEARCHED = {ELASTIC: (0.1, 0.8), WEAK: (0.1, 0.8), MOSTLY: (0.06, 0.28), FULL: (0.02, 0.095)}
_SEARCHES = 10  # loads from and to these, between two of which the last channel closes
_ROUNDS, _PARTS = 3, 4  # so often what lies between these two is cut into so many parts

DIRECTIONS: tuple[Along, ...] = ("x", "y")
Measured = dict[str, float | list[float]]


@dataclass(frozen=True)
class Case:
    """Bodies that differ in nothing but their seeds."""

    waves: int  # of the roll-off, along a side
    hurst: float
    hardness: float  # H / (E* g)
    cells: int = 8  # for the shortest wave

    @property
    def points(self) -> int:
        """Points along a side."""
        return self.waves * BAND * self.cells

    @property
    def loads(self) -> tuple[float, ...]:
        """Loads under which the flow is computed."""
        return tuple(load for load in LOADS if load < self.hardness)

    @cached_property
    def spectrum(self) -> rl.SelfAffine:
        """The spectrum of the surfaces."""
        q_roll = 2 * math.pi * self.waves
        return rl.SelfAffine(hurst=self.hurst, rms_height=1.0, q_roll=q_roll, q_high=BAND * q_roll)

    @cached_property
    def slope(self) -> float:
        """Rms slope g of the spectrum, which is that of every surface."""
        return math.sqrt(self.spectrum.lattice(self.points).moment(2))

    def surface(self, number: int) -> rl.Surface:
        """Return the surface of a number."""
        seed = np.random.SeedSequence(SEED, spawn_key=(self.waves, number))
        return self.spectrum.surface(self.points, rng=seed)


@dataclass(frozen=True)
class _Look:
    """What is seen under one load."""

    has_channel: dict[Along, bool]
    area: float  # A / A_0, corrected for the steps of its outline
    cells: float  # A / A_0, in cells
    plastic: float  # share of the contact that yields


@dataclass(frozen=True)
class _Pressed:
    """A body under loads p / (E* g), one after the other."""

    loads: tuple[float, ...]
    curve: SurfaceCurve

    @classmethod
    def of(cls, case: Case, surface: rl.Surface, loads: Iterable[float]) -> _Pressed:
        """Press a surface."""
        loads = tuple(loads)
        curve = rl.press(
            surface,
            E_star=1.0,
            forces=[load * case.slope for load in loads],
            hardness=case.hardness * case.slope,
            periodic=True,
            fields=True,
            measures=[OPEN[along] for along in DIRECTIONS],
        )
        return cls(loads, curve)

    def has_channel(self, i: int, along: Along) -> bool:
        """Whether any channel is open under a load."""
        return bool(self.curve.measured[OPEN[along].name].values[i])

    def permeance(self, i: int, along: Along) -> float:
        """Permeance under a load, in rms heights³."""
        flow = rl.flow(self.curve.fields[i], along=along)
        if not flow.converged:
            raise ConvergenceError("the flow did not converge", self.curve)
        return flow.permeance

    def of_medium(self, i: int, threshold: float) -> float:
        """Permeance of the effective medium of the gaps under a load, in rms heights³."""
        fields = self.curve.fields[i]
        assert fields is not None  # those of all loads are kept
        gap = np.where(fields.contact, 0.0, np.maximum(fields.gap, 0.0))
        return rl.effective_medium(gap, threshold) ** 3

    def looks(self) -> dict[float, _Look]:
        """Return what is seen under each load."""
        curve = self.curve
        assert curve.area_fraction is not None
        assert curve.area_fraction_corrected is not None
        plastic = curve.plastic_fraction
        return {
            load: _Look(
                {along: self.has_channel(i, along) for along in DIRECTIONS},
                curve.area_fraction_corrected[i],
                curve.area_fraction[i],
                0.0 if plastic is None else plastic[i],
            )
            for i, load in enumerate(self.loads)
        }


def measured(case: Case, number: int) -> Measured:
    """Measure the body of a number; it depends on nothing else."""
    surface = case.surface(number)
    low, high = _SEARCHED[case.hardness]
    searched = np.geomspace(low, high, _SEARCHES).tolist()
    first = _Pressed.of(case, surface, sorted({*case.loads, *searched}))
    places = list(map(first.loads.index, case.loads))
    found: Measured = {
        f"permeance_{along}": [first.permeance(i, along) for i in places] for along in DIRECTIONS
    }
    for threshold in MEDIA:
        found[f"medium_{threshold:g}"] = [first.of_medium(i, threshold) for i in places]
    seen = first.looks()
    del first  # its fields are large
    for _ in range(_ROUNDS):
        both = [_closing(seen, along) for along in DIRECTIONS]
        inner = {p for ends in both for p in np.geomspace(*ends, _PARTS + 1)[1:-1].tolist()}
        seen |= _Pressed.of(case, surface, sorted(inner)).looks()
    for along in DIRECTIONS:
        ends = _closing(seen, along)
        found[f"sealing_{along}"] = math.sqrt(math.prod(ends))
        for name in ("area", "cells", "plastic"):
            found[f"{name}_{along}"] = sum(getattr(seen[load], name) for load in ends) / 2
    sealing, _ = _closing(seen, "x")
    for peak in PEAKS:
        found |= {
            f"{name}_{peak:g}": value
            for name, value in _unloaded(case, surface, peak * sealing).items()
        }
    return found


def _closing(seen: dict[float, _Look], along: Along) -> tuple[float, float]:
    """Return the last load with a channel, and the next, which has none."""
    loads = sorted(seen)
    return next((low, high) for low, high in pairwise(loads) if not seen[high].has_channel[along])


def _unloaded(case: Case, surface: rl.Surface, peak: float) -> Measured:
    """Press a body, take the load off again, and see what leaks.

    Contact that shrinks opens channels, never closes them, so that both searches may halve.
    """
    steps = [1.0, *FRACTIONS, 0.0]
    body = _Pressed.of(case, surface, [peak * step for step in steps[:-1]])
    permeance = cache(lambda i: body.permeance(i, "x"))
    count = len(body.loads)
    if not body.has_channel(0, "x"):
        opens = bisect_left(range(count), True, key=lambda i: body.has_channel(i, "x"))
        return {"opens": (steps[opens - 1] + steps[opens]) / 2}
    limit = TENFOLD * permeance(0)
    leaks = bisect_left(range(count), True, key=lambda i: permeance(i) >= limit)
    tenfold = 0.0
    if leaks < count:  # between two loads the logarithms are linear
        logs = np.log([permeance(leaks - 1), permeance(leaks)])
        tenfold = math.exp(np.interp(np.log(limit), logs, np.log(steps[leaks - 1 : leaks + 1])))
    again = steps.index(COMPARED)
    loading = _Pressed.of(case, surface, [peak * COMPARED]).permeance(0, "x")
    return {
        "permeance": permeance(0),
        "tenfold": tenfold,
        "unloading": permeance(again),
        "loading": loading,
    }
