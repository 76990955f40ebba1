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
from roughline.isotropic import isotropic_spectrum
from roughline.preparation import tilt_warnings
from roughline.spectra import SelfAffine
from roughline.topography import Body, Surface
from roughline.trust import Difference

Real = NDArray[np.float64]

LINES = 200
_SPRINGS_A_WAVE = 128  # of the shortest wave, so that the springs do not show
_LEAST_SPRINGS = 2**16


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
    warnings : tuple of str
        What to know before the numbers are used; empty where there is nothing to say.
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
    warnings: tuple[str, ...] = ()

    def differences(self) -> list[Difference]:
        """List the differences, load by load; the scatter beside a single surface is of lines."""
        of = self.full if self.surfaces > 1 else self.reduced
        scatter = of.scatter / of.mean
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
    body: SelfAffine | Surface,
    *,
    n: int = 256,
    surfaces: int = 20,
    force_bars: ArrayLike | None = None,
    rng: int = 0,
    progress: Callable[[int, int], None] | None = None,
) -> Comparison:
    """Press both models of the same roughness, with the same waves.

    Of a spectrum, random surfaces and random reduced lines are pressed. Of a given surface, that
    surface and random lines with its spectrum, averaged over directions, scaled to its rms height.

    Parameters
    ----------
    body : SelfAffine or Surface
        The roughness; only its shape matters, as forces and stiffness are dimensionless.
    n : int, optional
        Points along a side of the surfaces of a spectrum. Waves shorter than two spacings are in
        neither model; with a cutoff that n resolves eightfold, the grid does not show.
    surfaces : int, optional
        Number of surfaces of a spectrum, at least 2; 200 lines are pressed beside them.
    force_bars : array_like, optional
        Rising dimensionless forces; default: 15 from 1e-3 to 3.
    rng : int, optional
        Root of all seeds.
    progress : callable, optional
        Called with (surfaces done, surfaces in all).

    Raises
    ------
    InputError
        If a value is outside its range, or a surface has no spectrum.
    ConvergenceError
        If a load was not solved to the tolerance.
    """
    forces = np.geomspace(1e-3, 3, 15) if force_bars is None else np.asarray(force_bars, float)
    tell = progress or (lambda done, total: None)
    if isinstance(body, Surface):
        spectrum = isotropic_spectrum(body)
        points = _SPRINGS_A_WAVE * spectrum.q.size
        lines = (spectrum.line(points, seed) for seed in _seeds(rng, LINES))
        tell(0, 1)
        pressed = [_pressed(body, forces)]
        tell(1, 1)
    else:
        if surfaces < 2:
            raise InputError(f"surfaces is {surfaces}; an interval needs at least 2")
        alike = _on_grid(body, n)
        points = max(_LEAST_SPRINGS, _SPRINGS_A_WAVE // 2 * n)
        lines = (alike.line(points, seed) for seed in _seeds(rng, LINES))
        pressed = []
        for i, seed in enumerate(_seeds(rng, surfaces)):
            tell(i, surfaces)
            pressed.append(_pressed(alike.surface(n, seed), forces))
        tell(surfaces, surfaces)
    reduced = np.array([_pressed(line, forces)[0] for line in lines])
    full = np.array([stiffness for stiffness, _ in pressed])
    difference, low, high = relative_difference(full, reduced, paired=False)
    return Comparison(
        force_bar=forces,
        full=average(full),
        reduced=average(reduced),
        difference=difference,
        low=low,
        high=high,
        resolved=np.all([resolved for _, resolved in pressed], axis=0),
        surfaces=len(pressed),
        lines=LINES,
        warnings=tilt_warnings(body) if isinstance(body, Surface) else (),
    )


def _seeds(root: int, count: int) -> list[np.random.SeedSequence]:
    return [np.random.SeedSequence(root, spawn_key=(i,)) for i in range(count)]


def _on_grid(spectrum: SelfAffine, n: int) -> SelfAffine:
    """The dimensionless spectrum with the waves that n points carry."""
    q_low = 2 * math.pi
    return SelfAffine(
        hurst=spectrum.hurst,
        rms_height=1.0,
        q_roll=q_low * spectrum.q_roll / spectrum.q_low,
        q_high=q_low * min(spectrum.q_high / spectrum.q_low, n / 2),
    )


def _pressed(body: Body, force_bars: Real) -> tuple[Real, NDArray[np.bool_]]:
    """Raw dimensionless stiffness under dimensionless forces, and where it is resolved."""
    curve = press(body, E_star=1.0, forces=force_bars * body.rms_height * body.length)
    return curve.stiffness / body.length, curve.resolved
