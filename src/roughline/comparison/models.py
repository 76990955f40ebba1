"""Both models on the same roughness: two curves, and how far they are apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline.comparison.trust import Difference
from roughline.computing.arrays import Real
from roughline.contact.press import press
from roughline.errors import InputError
from roughline.spectra.isotropic import isotropic_spectrum
from roughline.spectra.self_affine import SelfAffine
from roughline.statistics.averages import Average, average, relative_difference
from roughline.statistics.verdict import Verdict
from roughline.topography.body import Body, Surface
from roughline.topography.preparation import tilt_warnings

LINES = 200
_SPRINGS_A_WAVE = 128  # of the shortest wave, so that the springs do not show
_LEAST_SPRINGS = 2**16
_LEAST_SCATTER = 0.01  # where lines are saturated: surfaces scatter by 0.012 at F̄ = 4, 0.003 at 10
_TWO_SIDED = 1.97  # Student's t for 95 %, with the freedom of 200 lines


@dataclass(frozen=True, eq=False)
class Comparison:
    """The two models on the same roughness, at the same dimensionless forces.

    Attributes
    ----------
    force_bar : ndarray, shape (loads,)
        F / (E* h L).
    full, reduced : Average
        Raw stiffness k / (E* L), mean over surfaces and over lines.
    difference : ndarray, shape (loads,)
        Full over reduced, less 1, of what was pressed. [1]
    low, high : ndarray, shape (loads,)
        Ends of the 95 % interval of the difference between the two models, that is, of their
        means over all surfaces and lines of this spectrum. A single surface is one draw among
        these surfaces: the interval then holds the scatter of single surfaces too. [1]
    scatter : ndarray, shape (loads,)
        Relative standard deviation of the stiffness of single surfaces; beside a single surface
        estimated from the lines. [1]
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
    scatter: Real
    resolved: NDArray[np.bool_]
    surfaces: int
    lines: int
    warnings: tuple[str, ...] = ()

    def differences(self) -> list[Difference]:
        """List the differences, load by load."""
        columns = (self.difference, self.low, self.high, self.scatter, self.resolved)
        return [
            Difference(float(value), float(low), float(high), float(scatter), bool(resolved))
            for value, low, high, scatter, resolved in zip(*columns, strict=True)
        ]

    def trusted(self, tolerance: float = 0.1) -> tuple[float, float] | None:
        """Longest range of resolved loads whose verdicts are all "confirmed", or None."""
        good = [
            difference.verdict(tolerance) is Verdict.CONFIRMED and difference.resolved
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
    The intervals are about the two models for this spectrum; those beside a single surface are
    wide, as one surface says little of a mean over many.

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
    full = np.array([stiffness for stiffness, _ in pressed])
    resolved = np.all([each for _, each in pressed], axis=0)
    if isinstance(body, Surface):
        twice = np.array([[_pressed(line, f)[0] for f in (forces, forces / 2)] for line in lines])
        reduced, at_half = twice[:, 0], twice[:, 1]
        scatter = scatter_of_surfaces(reduced, at_half)
        difference, low, high = difference_of_one(full[0], reduced, scatter)
    else:
        reduced = np.array([_pressed(line, forces)[0] for line in lines])
        difference, low, high = relative_difference(full, reduced, paired=False)
        scatter = full.std(axis=0, ddof=1) / full.mean(axis=0)
    return Comparison(
        force_bar=forces,
        full=average(full),
        reduced=average(reduced),
        difference=difference,
        low=low,
        high=high,
        scatter=scatter,
        resolved=resolved,
        surfaces=len(pressed),
        lines=LINES,
        warnings=tilt_warnings(body) if isinstance(body, Surface) else (),
    )


def scatter_of_surfaces(reduced: Real, at_half: Real) -> Real:
    """Estimate how much single surfaces scatter from lines with the same waves.

    Lines scatter as surfaces do, or up to twice as much, but saturate at lower loads, where all
    of them become alike: the larger scatter at the load and at half of it serves both.

    Parameters
    ----------
    reduced, at_half : ndarray, shape (lines, loads)
        Stiffness of lines at the loads, and at half of each.

    Returns
    -------
    ndarray, shape (loads,)
        Standard deviation of the logarithm of the stiffness. [1]
    """
    scatters = [np.log(each).std(axis=0, ddof=1) for each in (reduced, at_half)]
    return np.maximum(np.maximum(*scatters), _LEAST_SCATTER)


def difference_of_one(surface: Real, reduced: Real, scatter: Real) -> tuple[Real, Real, Real]:
    """Relative difference of one surface from lines, as a sample of the models' difference.

    Parameters
    ----------
    surface : ndarray, shape (loads,)
        Stiffness of the surface.
    reduced : ndarray, shape (lines, loads)
        Stiffness of the lines.
    scatter : ndarray, shape (loads,)
        Standard deviation of the logarithm of the stiffness of single surfaces. [1]

    Returns
    -------
    difference, low, high : ndarray, shape (loads,)
        The difference, and the ends of the 95 % interval of that of the two means. [1]
    """
    mean = reduced.mean(axis=0)
    error = reduced.std(axis=0, ddof=1) / mean / math.sqrt(len(reduced))
    difference = np.log(surface / mean)
    width = _TWO_SIDED * np.hypot(scatter, error)
    return np.expm1(difference), np.expm1(difference - width), np.expm1(difference + width)


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
