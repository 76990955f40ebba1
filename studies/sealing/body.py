"""One body of the study: where it seals, what leaks before, and how far it may be unloaded.

Bodies have rms height, side and E* 1. Loads are p / (E* g), with g the rms slope of the spectrum,
and so is the hardness.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise

import numpy as np

import roughline as rl
from roughline.contact.curve import SurfaceCurve
from roughline.errors import ConvergenceError
from roughline.fluid.gap import Along
from roughline.fluid.sealing_pressure import CHANNEL

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

_ABOUT = {ELASTIC: 0.22, WEAK: 0.22, MOSTLY: 0.13, FULL: 0.05}
"""Loads about which bodies seal."""
_FIRST, _PARTS = 8, 4
"""Loads that are tried first, and parts into which what lies between two of them is cut."""
_NEAR = 1.004
"""Ratio of the loads between which the last channel closes, at most."""
_FURTHER = 1.3  # step to a lighter or a heavier load where the first ones do not do
_MOST = 0.95  # of the hardness, which all of the contact bears at last
_RTOL, _RTOL_OF_CHANNELS = 1e-6, 1e-4
"""Tolerances of the residuals where the flow is computed, and where channels are looked for."""

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

    @property
    def searched(self) -> tuple[float, ...]:
        """Loads that are tried first; sealing loads scatter less on larger bodies."""
        about, factor = _ABOUT[self.hardness], 1 + 3 / self.waves**0.75
        high = min(about * factor, _MOST * self.hardness)
        return tuple(np.geomspace(about / factor, high, _FIRST).tolist())

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
    def of(
        cls, case: Case, surface: rl.Surface, loads: Iterable[float], fields: bool = True
    ) -> _Pressed:
        """Press a surface; without fields only channels and areas are seen, less accurately."""
        loads = tuple(loads)
        curve = rl.press(
            surface,
            E_star=1.0,
            forces=[load * case.slope for load in loads],
            hardness=case.hardness * case.slope,
            periodic=True,
            fields=fields,
            measures=[CHANNEL[along] for along in DIRECTIONS],
            rtol=_RTOL if fields else _RTOL_OF_CHANNELS,
        )
        return cls(loads, curve)

    def has_channel(self, i: int, along: Along) -> bool:
        """Whether a part of the gap winds along a direction under a load."""
        return bool(self.curve.measured[CHANNEL[along].name].values[i])

    def permeances(self, i: int) -> tuple[float, float]:
        """Permeances along x and along y under a load, in rms heights³."""
        x, y = rl.flow(self.curve.fields[i], along="both")
        if not (x.converged and y.converged):
            raise ConvergenceError("the flow did not converge", self.curve)
        return x.permeance, y.permeance

    def of_medium(self, i: int, threshold: float) -> float:
        """Permeance of the effective medium of the gaps under a load, in rms heights³."""
        fields = self.curve.fields[i]
        assert fields is not None  # those of all loads are kept
        gap = np.where(fields.contact, 0.0, np.maximum(fields.gap, 0.0))
        return rl.effective_medium(gap, threshold) ** 3

    def looks(self) -> dict[float, _Look]:
        """Return what is seen under each load."""
        curve = self.curve
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


def measured(case: Case, number: int, leaks: bool = True) -> Measured:
    """Measure the body of a number: where it seals and, if asked for, what leaks before and after.

    It depends on nothing else.
    """
    surface = case.surface(number)
    seen = _seen(case, surface)
    found: Measured = {}
    for along in DIRECTIONS:
        ends = _closing(seen, along)
        found[f"sealing_{along}"] = math.sqrt(math.prod(ends))
        for name in ("area", "cells", "plastic"):
            found[f"{name}_{along}"] = sum(getattr(seen[load], name) for load in ends) / 2
    if not leaks:
        return found
    found |= _leaks(case, surface)
    sealing, _ = _closing(seen, "x")
    for peak in PEAKS:
        found |= {
            f"{name}_{peak:g}": value
            for name, value in _unloaded(case, surface, peak * sealing).items()
        }
    return found


def _seen(case: Case, surface: rl.Surface) -> dict[float, _Look]:
    """What is seen under loads so many that the last channels close between two near ones."""
    seen: dict[float, _Look] = {}
    loads = list(case.searched)
    while loads:
        seen |= _Pressed.of(case, surface, sorted(loads), fields=False).looks()
        loads = list(_wanted(seen, case.hardness))
    return seen


def _wanted(seen: dict[float, _Look], hardness: float) -> Iterator[float]:
    """Loads that are to be looked at next; none if the last channels are found."""
    lightest, heaviest = min(seen), max(seen)
    if not all(seen[lightest].has_channel.values()):
        yield lightest / _FURTHER
        return
    if any(seen[heaviest].has_channel.values()):
        heavier = heaviest * _FURTHER
        yield heavier if heavier < _MOST * hardness else math.sqrt(heaviest * hardness)
        return
    for low, high in {_closing(seen, along) for along in DIRECTIONS}:
        if high > _NEAR * low:
            yield from np.geomspace(low, high, _PARTS + 1)[1:-1].tolist()


def _closing(seen: dict[float, _Look], along: Along) -> tuple[float, float]:
    """Return the last load with a channel, and the next, which has none."""
    loads = sorted(seen)
    return next((low, high) for low, high in pairwise(loads) if not seen[high].has_channel[along])


def _leaks(case: Case, surface: rl.Surface) -> Measured:
    """What leaks under some loads, and what would through effective media of the gaps."""
    body = _Pressed.of(case, surface, case.loads)
    places = range(len(case.loads))
    permeances = [body.permeances(i) for i in places]
    found: Measured = {
        f"permeance_{along}": [each[k] for each in permeances] for k, along in enumerate(DIRECTIONS)
    }
    for threshold in MEDIA:
        found[f"medium_{threshold:g}"] = [body.of_medium(i, threshold) for i in places]
    return found


def _unloaded(case: Case, surface: rl.Surface, peak: float) -> Measured:
    """Press a body, take the load off again, and see what leaks.

    Contact that shrinks opens channels, never closes them, so that both searches may halve.
    """
    steps = [1.0, *FRACTIONS, 0.0]
    body = _Pressed.of(case, surface, [peak * step for step in steps[:-1]])
    permeance = cache(lambda i: body.permeances(i)[0])
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
    loading = _Pressed.of(case, surface, [peak * COMPARED]).permeances(0)[0]
    return {
        "permeance": permeance(0),
        "tenfold": tenfold,
        "unloading": permeance(again),
        "loading": loading,
    }
