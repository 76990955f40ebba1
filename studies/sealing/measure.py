"""The study's numbers: leaks beside theories and beside one another, and the error of the grid.

A leak is the mean permeance along x and along y, in rms heights³. The leak of an ensemble is the
mean of its bodies, and is told where no body is sealed in both directions.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np

import roughline as rl
from roughline.computing.arrays import Real
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import NO_ESTIMATE, IntervalEstimate, Resampled
from studies.judged import Found
from studies.sealing.body import DIRECTIONS, FRACTIONS, PEAKS, Case
from studies.sealing.run import CELLS, FINE_CELLS, FINE_WAVES, Body, body_of

OF_GAPS = "of gaps"
"""Name of the effective medium of the gaps that a body has, not of those of Persson's theory."""
_WRITTEN = 1e-4  # of a number, at most: what the digits leave open that are written
_HALVES = 2.0  # an error that halves with the spacing is twice the difference of two grids


@dataclass(frozen=True, eq=False)
class Sample:
    """The bodies of one case that were solved."""

    case: Case
    bodies: Mapping[int, Mapping[str, Any]]  # what was measured of each, by their numbers

    @property
    def count(self) -> int:
        """Number of bodies."""
        return len(self.bodies)

    def values(self, name: str) -> Real:
        """Return what was measured of each body, shape (bodies, ...)."""
        return np.array([body[name] for body in self.bodies.values()], dtype=np.float64)

    def of_both(self, name: str) -> Real:
        """Return the mean of what was measured along x and along y of each body."""
        x, y = (self.values(f"{name}_{along}") for along in DIRECTIONS)
        return (x + y) / 2

    @property
    def leaking(self) -> Sample:
        """The bodies of which it was measured what leaks."""
        found = {number: each for number, each in self.bodies.items() if "permeance_x" in each}
        return Sample(self.case, found)

    def leak(self, load: float) -> Real:
        """Return the leak of each body under a load; NaN if it is above the hardness."""
        if load not in self.case.loads:
            return np.full(self.count, np.nan)
        return self.of_both("permeance")[:, self.case.loads.index(load)]

    def beside(self, other: Sample) -> tuple[Sample, Sample]:
        """Return the bodies of both that have the same seeds."""
        common = [number for number in self.bodies if number in other.bodies]
        first, second = (
            Sample(one.case, {number: one.bodies[number] for number in common})
            for one in (self, other)
        )
        return first, second


@dataclass(frozen=True, eq=False)
class Data:
    """All bodies that were pressed, by their cases and numbers."""

    bodies: Mapping[Body, Mapping[str, Any]]

    @classmethod
    def of(cls, lines: Iterable[str]) -> Data:
        """Read the lines of a run."""
        return cls({body_of(line): json.loads(line) for line in lines})

    @property
    def unsolved(self) -> int:
        """How many bodies had a load that was not solved; they are left out."""
        return sum("sealing_x" not in each for each in self.bodies.values())

    @property
    def version(self) -> str:
        """Version of roughline that pressed them; "a and b" if they were several."""
        return " and ".join(sorted({each["version"] for each in self.bodies.values()}))

    def sample(self, waves: int, hurst: float, hardness: float, cells: int = CELLS) -> Sample:
        """Return the bodies of a case."""
        case = Case(waves, hurst, hardness, cells)
        return Sample(case, self._solved.get(case, {}))

    @cached_property
    def _solved(self) -> dict[Case, dict[int, Mapping[str, Any]]]:
        """The bodies of each case of which all loads were solved."""
        found: dict[Case, dict[int, Mapping[str, Any]]] = {}
        for (case, number), each in self.bodies.items():
            if "sealing_x" in each:
                found.setdefault(case, {})[number] = each
        return found

    def grids(
        self, hurst: float, hardness: float, cells: int = FINE_CELLS
    ) -> tuple[Sample, Sample]:
        """Return the same small bodies on a grid, and on one with half as many points a side."""
        fine = self.sample(FINE_WAVES, hurst, hardness, cells)
        return fine.beside(self.sample(FINE_WAVES, hurst, hardness, cells // 2))

    def leaks(self, waves: int, hurst: float, hardness: float) -> Sample:
        """Return the bodies of a case of which it was measured what leaks."""
        return self.sample(waves, hurst, hardness).leaking

    def leaking_grids(self, hurst: float, hardness: float) -> tuple[Sample, Sample]:
        """Return the same small leaking bodies on a finer grid, and on that of the study."""
        fine, coarse = self.grids(hurst, hardness)
        return fine.leaking.beside(coarse.leaking)


def mean(values: Real, confidence: float = 0.95, step: float = 0.0) -> IntervalEstimate:
    """Return a mean over bodies with its interval; values are known to a step."""
    return _known_to(bootstrap.means(values), step, values.size).interval_estimate(confidence)


def _known_to(found: Resampled, step: float, bodies: int) -> Resampled:
    """Return a mean with what the steps of its values leave open in all errors.

    Without it, resamples of equal values have none, and tell nothing of the mean.
    """
    left_open = step / math.sqrt(12 * bodies)
    error, errors = (np.hypot(each, left_open) for each in (found.error, found.errors))
    return replace(found, error=error, errors=errors)


def area_shift(
    data: Data,
    hurst: float,
    hardness: float,
    name: str = "area",
    cells: int = FINE_CELLS,
    confidence: float = 0.95,
) -> IntervalEstimate:
    """Return by how much the area at sealing is larger than on a grid half as fine. [1]"""
    fine, coarse = data.grids(hurst, hardness, cells)
    return mean(fine.of_both(name) - coarse.of_both(name), confidence)


def widened_by_grid(found: IntervalEstimate, shift: IntervalEstimate, count: int) -> Found:
    """Widen an area by what finer grids would change, and by how well that is known."""
    value, low, high = (_HALVES * each for each in (shift.value, shift.low, shift.high))
    return Found(
        found.low + min(low, 0),
        found.value + min(value, 0),
        found.value + max(value, 0),
        found.high + max(high, 0),
        count,
    )


def ratio(first: Real, second: Real, confidence: float = 0.95) -> IntervalEstimate:
    """Return the ratio of mean leaks of the same bodies, NaN where one of them is sealed."""
    if not (np.stack([first, second]) > 0).all():
        return NO_ESTIMATE
    pairs = np.column_stack([first, second])
    logarithm = bootstrap.sum_of_log_means(pairs, np.array([1.0, -1.0]))
    return _known_to(logarithm, _WRITTEN, first.size).interval_estimate(confidence).exp()


@cache
def theory_of(name: str, threshold: float, case: Case, load: float) -> float:
    """Leak of a theory under a load, in rms heights³."""
    spectrum = case.spectrum.lattice(case.points)
    curve = rl.theory(name, spectrum, 1.0, [load * case.slope], threshold)
    assert curve.hydraulic_aperture is not None
    return float(curve.hydraulic_aperture[0] ** 3)


def over_theory(
    data: Data, theory: tuple[str, float], case: Case, load: float, confidence: float = 0.95
) -> Found | None:
    """Return the leak over that of a theory, by its name and threshold, widened by the grid.

    None where a body is sealed, or nothing leaks by the theory.
    """
    name, threshold = theory
    one = data.leaks(case.waves, case.hurst, case.hardness)
    values = one.leak(load)
    if name == OF_GAPS:
        expected = one.values(f"medium_{threshold:g}")[:, case.loads.index(load)]
    else:
        expected = np.full(one.count, theory_of(name, threshold, case, load))
    fine, coarse = (each.leak(load) for each in data.leaking_grids(case.hurst, case.hardness))
    found, shift = ratio(values, expected, confidence), ratio(fine, coarse).value
    if math.isnan(found.value) or math.isnan(shift):
        return None
    return _widened(found, shift, one.count)


def plastic_factor(
    data: Data, waves: int, hurst: float, hardness: float, load: float, confidence: float = 0.95
) -> Found | None:
    """Return the leak of elastic bodies over that of the same bodies that yield, under a load."""
    hard = math.inf
    elastic, yielding = data.leaks(waves, hurst, hard).beside(data.leaks(waves, hurst, hardness))
    found = ratio(elastic.leak(load), yielding.leak(load), confidence)
    shift = 1.0
    for of, power in ((hard, 1), (hardness, -1)):
        fine, coarse = data.leaking_grids(hurst, of)
        shift *= ratio(fine.leak(load), coarse.leak(load)).value ** power
    if math.isnan(found.value) or math.isnan(shift):
        return None
    return _widened(found, shift, elastic.count)


def _widened(found: IntervalEstimate, shift: float, count: int) -> Found:
    """Widen a ratio to one side by the error of the grid, from its factor on a finer one."""
    factor = shift**_HALVES
    down, up = min(factor, 1), max(factor, 1)
    return Found(found.low * down, found.value * down, found.value * up, found.high * up, count)


def taken_off(one: Sample, peak: float, confidence: float = 0.95) -> IntervalEstimate:
    """Return the share of the largest load that may be taken off before ten times as much leaks."""
    return mean(1 - one.values(f"tenfold_{peak:g}"), confidence)


def tightening(one: Sample, peak: float, confidence: float = 0.95) -> IntervalEstimate:
    """Return the leak on loading over that on unloading, under half of the largest load."""
    return ratio(one.values(f"loading_{peak:g}"), one.values(f"unloading_{peak:g}"), confidence)


def until_open(one: Sample, confidence: float = 0.95) -> IntervalEstimate:
    """Return the share of a load beyond sealing that may be taken off until a channel opens."""
    opens, steps = one.values(f"opens_{PEAKS[-1]:g}"), np.array([1.0, *FRACTIONS, 0.0])
    places = np.searchsorted(-steps, -opens)  # of the load under which a channel is open
    return mean(1 - opens, confidence, step=float(np.mean(steps[places - 1] - steps[places])))
