"""The study's numbers: what shears a contact beside Jäger's principle, and beside reduced lines."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any, Literal

import numpy as np

import roughline as rl
from roughline.computing.arrays import Real
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import NO_ESTIMATE
from studies.friction.body import BAND, SEED, Case, beside_jaeger
from studies.friction.run import FORCE_BARS, Body, body_of, one_material
from studies.judged import Found

FEWEST = 2
"""Bodies that an interval needs."""
LINES = 200
"""Reduced lines of each Hurst exponent."""
_SPRINGS_PER_WAVE = 128  # under the shortest wave
_LINE = 1  # first number of the seeds of lines, behind which theirs follow

Quantity = Literal["stiffness", "slide", "loop"]
"""What is compared: k, the slide at the largest shear force, or what a cycle dissipates."""


@dataclass(frozen=True, eq=False)
class Sample:
    """Bodies of one case that were solved."""

    case: Case
    bodies: list[Mapping[str, Any]]

    @property
    def count(self) -> int:
        """Number of bodies."""
        return len(self.bodies)

    def values(self, name: str) -> Real:
        """Return what was measured of each body, shape (bodies, ...)."""
        return np.array([body[name] for body in self.bodies], dtype=np.float64)

    def sheared(self, name: str) -> Real:
        """Return the mean of what was measured along each axis."""
        axes = "x" if self.case.is_coupled else "xy"
        return np.mean([self.values(f"{name}_{axis}") for axis in axes], axis=0)

    def stiffness(self, confidence: float = 0.95) -> Found:
        """Return k_t / k_n over Mindlin's, less 1."""
        normal = self.case.mindlin * self.values("normal")
        return excess(self.sheared("stiffness"), normal, confidence)

    def slip(self, i: int, confidence: float = 0.95) -> Found:
        """Return the slide under a share of mu F over Jäger's, less 1."""
        return excess(self.sheared("slides")[:, i], self.values("jaeger")[:, i], confidence)

    def loop(self, cycle: int, confidence: float = 0.95) -> Found:
        """Return what a cycle dissipates over Jäger's loop, less 1."""
        return excess(self.sheared("loops")[:, cycle], self.values("jaeger_loop"), confidence)

    def off(self, i: int) -> Real:
        """Return by how much each body is off Jäger's slide along each axis, shape (2, bodies)."""
        slides = (self.values(f"slides_{axis}")[:, i] for axis in "xy")
        return np.array([each / self.values("jaeger")[:, i] - 1 for each in slides])

    def by_coupling(self, i: int, confidence: float = 0.95) -> Found:
        """Return the slide over that of the same bodies without coupling, less 1."""
        alone = self.values("alone_slides_x")[:, i]
        return excess(self.values("slides_x")[:, i], alone, confidence)

    def nearer(self) -> Found:
        """Return the depth when pressed over that without friction, less 1."""
        return excess(self.values("depth_x"), self.values("depth"))


@dataclass(frozen=True, eq=False)
class Curve:
    """What a line does under normal loads."""

    forces: Real  # rising
    depth: Real
    stiffness: Real
    work: Real

    def under(self, forces: Real) -> tuple[Real, Real, Real]:
        """Depth, stiffness and work under some of the forces."""
        at = np.searchsorted(self.forces, forces)
        return self.depth[at], self.stiffness[at], self.work[at]


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
        """How many bodies had a load that was not solved; what follows it is left out."""
        return sum(
            "normal" not in each or "NaN" in json.dumps(each) for each in self.bodies.values()
        )

    @property
    def version(self) -> str:
        """Version of roughline that pressed them; "a and b" if they were several."""
        return " and ".join(sorted({each["version"] for each in self.bodies.values()}))

    @cached_property
    def _solved(self) -> dict[Case, list[Mapping[str, Any]]]:
        found: dict[Case, list[Mapping[str, Any]]] = {}
        for (case, _), each in self.bodies.items():
            if "normal" in each:
                found.setdefault(case, []).append(each)
        return found

    def pressed(self, case: Case) -> Sample:
        """Return all bodies of a case."""
        return Sample(case, self._solved.get(case, []))

    def sample(self, case: Case) -> Sample:
        """Return the bodies of a case that were sheared."""
        return Sample(case, [each for each in self.pressed(case).bodies if "slides_x" in each])

    def over_hursts(
        self, cases: Iterable[Case], number: Callable[[Sample], Real]
    ) -> dict[int, float]:
        """Return a number of bodies, the mean over cases, by the numbers of those that all have."""
        found: dict[int, list[float]] = {}
        samples = [self.sample(case) for case in cases]
        for one in samples:
            for body, value in zip(one.bodies, number(one).tolist(), strict=True):
                found.setdefault(body["number"], []).append(value)
        return {i: float(np.mean(of)) for i, of in found.items() if len(of) == len(samples)}


def excess(values: Real, reference: Real, confidence: float = 0.95) -> Found:
    """Return the mean over bodies of some values over others, less 1."""
    return mean(values / reference - 1, confidence)


def mean(values: Real, confidence: float = 0.95) -> Found:
    """Return a mean over bodies; those of which it is not known are left out."""
    known = values[np.isfinite(values)]
    if len(known) < FEWEST:
        return Found.of(NO_ESTIMATE, len(known))
    return Found.of(bootstrap.means(known).interval_estimate(confidence), len(known))


@cache
def lines(hurst: float) -> list[Curve]:
    """Press the reduced lines of a Hurst exponent under all forces that are asked for.

    A spring under the shear force Q has slid as far as the body, or bears mu times its normal
    force. So springs shear as Jäger's principle says of their own F(d), exactly.
    """
    forces = np.unique([each.forces for each in one_material()])
    spectrum, found = Case(hurst, FORCE_BARS[0]).spectrum, []
    for number in range(LINES):
        seed = np.random.SeedSequence(SEED, spawn_key=(_LINE, number))
        line = spectrum.line(BAND * _SPRINGS_PER_WAVE, rng=seed)
        found.append(Curve(forces, *_pressed(line, forces)))
    return found


def _pressed(line: rl.Line, forces: Real) -> tuple[Real, Real, Real]:
    """Depth, stiffness and work of a line under normal loads."""
    curve = rl.press(line, E_star=1.0, forces=forces)
    shortened = curve.depth[:, np.newaxis] - (line.heights.max() - line.heights)
    work = line.spacing * np.square(np.maximum(shortened, 0.0)).sum(axis=1) / 2
    return curve.depth, curve.stiffness, work


def _of(bodies: Iterable[Mapping[str, Any]], quantity: Quantity) -> Real:
    """Return a quantity of bodies, from their normal contact and Jäger's principle."""
    if quantity == "slide":
        return np.array([each["jaeger"][-1] for each in bodies])
    return np.array(
        [each["normal" if quantity == "stiffness" else "jaeger_loop"] for each in bodies]
    )


def over_lines(one: Sample, *quantities: Quantity, confidence: float = 0.95) -> Found:
    """Return quantities of surfaces over those of their reduced lines, multiplied, less 1."""
    case = one.case
    reduced = [beside_jaeger(case, each.under) for each in lines(case.hurst)]
    surfaces, springs = (
        bootstrap.sum_of_log_means(
            np.stack([_of(bodies, each) for each in quantities], axis=1), np.ones(len(quantities))
        )
        for bodies in (one.bodies, reduced)
    )
    found = (surfaces - springs).interval_estimate(confidence).exp() - 1
    return Found.of(found, one.count)
