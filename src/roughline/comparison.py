"""Both models on the same roughness: two curves, and how far they are apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline.averages import Average, average, relative_difference
from roughline.contact import press
from roughline.errors import InputError
from roughline.spectra import SelfAffine
from roughline.trust import Difference

Real = NDArray[np.float64]

LINES = 200
_LINE_POINTS = 2**16


@dataclass(frozen=True, eq=False)
class Comparison:
    """The two models on the same roughness, at the same dimensionless forces.

    Attributes
    ----------
    force_bar : ndarray, shape (loads,)
        F / (E* h L).
    full, reduced : Average
        Raw stiffness k / (E* L), mean over surfaces and over lines.
    difference, low, high : ndarray, shape (loads,)
        Full over reduced, less 1, and the ends of its 95 % interval.
    resolved : ndarray of bool, shape (loads,)
        Whether every surface had ten cells or more in contact.
    surfaces, lines : int
        How many were pressed.
    """

    force_bar: Real
    full: Average
    reduced: Average
    difference: Real
    low: Real
    high: Real
    resolved: NDArray[np.bool_]
    surfaces: int
    lines: int

    def differences(self) -> list[Difference]:
        """List the differences, load by load."""
        scatter = self.full.scatter / self.full.mean
        table = zip(self.difference, self.low, self.high, scatter, self.resolved, strict=True)
        return [
            Difference(float(value), float(low), float(high), float(spread), bool(sure))
            for value, low, high, spread, sure in table
        ]

    def trusted(self, tolerance: float = 0.1) -> tuple[float, float] | None:
        """Longest range of loads in which the two means are within a tolerance, or None."""
        good = [
            abs(difference.value) <= tolerance and difference.resolved
            for difference in self.differences()
        ]
        best, start = (0, 0), None
        for i, fits in enumerate([*good, False]):
            if fits and start is None:
                start = i
            elif not fits and start is not None:
                best, start = max(best, (start, i), key=lambda run: run[1] - run[0]), None
        if best[1] == best[0]:
            return None
        return float(self.force_bar[best[0]]), float(self.force_bar[best[1] - 1])


def compare(
    spectrum: SelfAffine,
    *,
    n: int = 256,
    surfaces: int = 20,
    force_bars: ArrayLike | None = None,
    rng: int = 0,
    progress: Callable[[int, int], None] | None = None,
) -> Comparison:
    """Press surfaces and reduced lines of one spectrum, both with the waves of the surface's grid.

    Parameters
    ----------
    spectrum : SelfAffine
        The roughness; only its shape matters, as forces and stiffness are dimensionless.
    n : int, optional
        Points along a side of the surfaces. Waves shorter than two spacings are in neither model;
        with a cutoff that n resolves eightfold, the grid does not show.
    surfaces : int, optional
        Number of surfaces, at least 2; 200 lines are pressed beside them.
    force_bars : array_like, optional
        Rising dimensionless forces; default: 15 from 1e-3 to 3.
    rng : int, optional
        Root of all seeds.
    progress : callable, optional
        Called with (surfaces done, surfaces in all).

    Raises
    ------
    InputError
        If a value is outside its range.
    ConvergenceError
        If a load was not solved to the tolerance.
    """
    if surfaces < 2:
        raise InputError(f"surfaces is {surfaces}; an interval needs at least 2")
    forces = np.geomspace(1e-3, 3, 15) if force_bars is None else np.asarray(force_bars, float)
    q_low = 2 * math.pi
    ratio = spectrum.q_high / spectrum.q_low
    alike = SelfAffine(
        hurst=spectrum.hurst,
        rms_height=1.0,
        q_roll=q_low * spectrum.q_roll / spectrum.q_low,
        q_high=q_low * min(ratio, n / 2),
    )
    seeds = [np.random.SeedSequence(rng, spawn_key=(i,)) for i in range(max(surfaces, LINES))]
    points = max(_LINE_POINTS, 64 * n)
    lines = np.array(
        [
            press(alike.line(points, seed), E_star=1.0, forces=forces).stiffness
            for seed in seeds[:LINES]
        ]
    )
    stiffness, resolved = [], np.ones(forces.size, dtype=bool)
    for i, seed in enumerate(seeds[:surfaces]):
        if progress is not None:
            progress(i, surfaces)
        curve = press(alike.surface(n, seed), E_star=1.0, forces=forces)
        stiffness.append(curve.stiffness)
        resolved &= curve.resolved
    if progress is not None:
        progress(surfaces, surfaces)
    full = np.array(stiffness)
    difference, low, high = relative_difference(full, lines, paired=False)
    return Comparison(
        forces, average(full), average(lines), difference, low, high, resolved, surfaces, LINES
    )
