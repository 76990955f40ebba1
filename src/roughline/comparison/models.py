"""Both models on the same roughness: their mean stiffness, and the difference of the two."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughline.comparison.trust import Difference
from roughline.computing.arrays import Mask, Real
from roughline.computing.summary import summary
from roughline.contact.press import press
from roughline.errors.checks import refuse, refuse_other_seeds, whole_number
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.spectra.isotropic import isotropic_spectrum
from roughline.spectra.self_affine import SelfAffine
from roughline.spectra.synthesis import refuse_points
from roughline.statistics.averages import Average, average, relative_difference
from roughline.statistics.verdict import Verdict
from roughline.topography.body import Body, Surface
from roughline.topography.preparation import tilt_warnings

_COMPARED_LINES = 200  # number of lines that are pressed beside the surfaces
_SPRINGS_PER_WAVE = 128  # springs under the shortest wave, so fine that their spacing has no effect
_LEAST_SPRINGS = 2**16
_LEAST_SCATTER = 0.01  # for saturated lines; surfaces scatter by 0.012 at F̄ = 4 and by 0.003 at 10
_STUDENT_95 = 1.97  # Student's t for 95 % on two sides, with the freedom of 200 lines


@public
@dataclass(frozen=True, eq=False)
class Comparison:
    """The two models on the same roughness, at the same dimensionless forces.

    Attributes
    ----------
    force_bar : ndarray, shape (loads,)
        F / (E* h L).
    full, reduced : Average
        Raw stiffness k / (E* L), averaged over the surfaces and over the lines.
    difference : ndarray, shape (loads,)
        Mean stiffness of the surfaces over mean stiffness of the lines, less 1. [1]
    low, high : ndarray, shape (loads,)
        Ends of the 95 % interval of this difference for the means over all surfaces and all lines
        of the spectrum. A single surface is one draw from these surfaces; its interval therefore
        includes the scatter of single surfaces. [1]
    scatter : ndarray, shape (loads,)
        Relative standard deviation of the stiffness of single surfaces. For a single surface it
        is estimated from the lines. [1]
    resolved : ndarray of bool, shape (loads,)
        Whether ten cells or more were in contact on every surface.
    surfaces, lines : int
        Number of surfaces and lines that were pressed.
    facts : tuple of Fact
        What a user of the numbers must know; empty if there is nothing to say.
    """

    force_bar: Real
    full: Average
    reduced: Average
    difference: Real
    low: Real
    high: Real
    scatter: Real
    resolved: Mask
    surfaces: int
    lines: int
    facts: tuple[Fact, ...] = ()

    __repr__ = summary

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a user of the numbers must know, in words."""
        return tuple(map(str, self.facts))

    def differences(self) -> list[Difference]:
        """List the differences, load by load."""
        columns = (self.difference, self.low, self.high, self.scatter, self.resolved)
        return [
            Difference(float(value), float(low), float(high), float(scatter), bool(resolved))
            for value, low, high, scatter, resolved in zip(*columns, strict=True)
        ]

    def trusted(self, tolerance: float = 0.1) -> tuple[float, float] | None:
        """Return the longest range of resolved loads that are all "confirmed", or None."""
        confirmed_at = [
            difference.verdict(tolerance) is Verdict.CONFIRMED and difference.resolved
            for difference in self.differences()
        ]
        longest, start = (0, 0), None
        for i, confirmed in enumerate([*confirmed_at, False]):
            if confirmed and start is None:
                start = i
            elif not confirmed and start is not None:
                longest, start = max(longest, (start, i), key=lambda run: run[1] - run[0]), None
        first, end = longest
        if first == end:
            return None
        return float(self.force_bar[first]), float(self.force_bar[end - 1])


@public
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

    For a spectrum, random surfaces and random reduced lines are pressed. For a surface, the surface
    itself is pressed, and random lines with its spectrum averaged over directions, scaled to its
    rms height. The intervals are those of the means over all surfaces and lines of the spectrum.
    For a single surface they are wide, because one surface does not determine such a mean.

    Parameters
    ----------
    body : SelfAffine or Surface
        The roughness; only its shape matters, as forces and stiffness are dimensionless.
    n : int, optional
        Points along a side of the surfaces of a spectrum. Waves shorter than two spacings are in
        neither model; if the shortest wave spans eight spacings, the grid has no visible effect.
    surfaces : int, optional
        Number of surfaces of a spectrum, at least 2; 200 lines are pressed beside them.
    force_bars : array_like, optional
        Rising dimensionless forces; default: 15 from 1e-3 to 3.
    rng : int, optional
        Root of all seeds.
    progress : callable, optional
        Called with (surfaces done, surfaces in all); for a single surface it counts its loads and
        the lines instead.

    Raises
    ------
    InputError
        If a value is outside its range, or a surface has no spectrum.
    ConvergenceError
        If a load was not solved to the tolerance.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=25.0)
    >>> found = rl.compare(spectrum, n=64, surfaces=4, force_bars=[0.1, 0.3])
    >>> print(found.force_bar, found.difference.round(2))
    [0.1 0.3] [ 0.25 -0.01]
    """
    forces = np.geomspace(1e-3, 3, 15) if force_bars is None else np.asarray(force_bars, float)
    report = progress or (lambda done, total: None)
    refuse_other_seeds(rng)
    if forces.ndim != 1 or not forces.size or not ((forces > 0) & np.isfinite(forces)).all():
        refuse("force_bars", force_bars, "positive, finite F / (E* h L) are needed")
    if isinstance(body, Surface):
        return _compare_surface(body, forces, rng, report)
    whole_number("surfaces", surfaces, 2, "an interval needs at least 2")
    refuse_points(n, "surface")
    return _compare_spectrum(_on_grid(body, n), n, surfaces, forces, rng, report)


def _compare_surface(
    surface: Surface, forces: Real, rng: int, report: Callable[[int, int], None]
) -> Comparison:
    """Compare one surface with random lines of its spectrum."""
    spectrum = isotropic_spectrum(surface)
    springs = _SPRINGS_PER_WAVE * spectrum.q.size
    steps = forces.size + _COMPARED_LINES
    full, resolved = _stiffness_under(forces, surface, lambda done, loads: report(done, steps))
    stiffness = np.empty((_COMPARED_LINES, 2, forces.size))
    for i, seed in enumerate(_seeds(rng, _COMPARED_LINES)):
        line = spectrum.line(springs, seed)
        stiffness[i] = [_stiffness_under(loads, line)[0] for loads in (forces, forces / 2)]
        report(forces.size + i + 1, steps)
    reduced, at_half = stiffness[:, 0], stiffness[:, 1]
    scatter = scatter_of_surfaces(reduced, at_half)
    difference, low, high = difference_of_one(full, reduced, scatter)
    return Comparison(
        force_bar=forces,
        full=average(full[np.newaxis]),
        reduced=average(reduced),
        difference=difference,
        low=low,
        high=high,
        scatter=scatter,
        resolved=resolved,
        surfaces=1,
        lines=_COMPARED_LINES,
        facts=tilt_warnings(surface),
    )


def scatter_of_surfaces(reduced: Real, at_half: Real) -> Real:
    """Estimate the scatter of single surfaces from lines with the same waves.

    Lines scatter as much as surfaces, or up to twice as much. Lines saturate at lower loads than
    surfaces, and saturated lines all have the same stiffness. The larger of their scatters at the
    load and at half the load is therefore taken, and 0.01 at least.

    It is the standard deviation of the logarithm of the stiffness; stiffnesses have the shape
    (lines, loads).
    """
    scatters = [np.log(stiffness).std(axis=0, ddof=1) for stiffness in (reduced, at_half)]
    return np.maximum(np.maximum(*scatters), _LEAST_SCATTER)


def difference_of_one(surface: Real, reduced: Real, scatter: Real) -> tuple[Real, Real, Real]:
    """Return the relative difference of one surface from lines, and the interval of all."""
    mean = reduced.mean(axis=0)
    error = reduced.std(axis=0, ddof=1) / mean / math.sqrt(len(reduced))
    difference = np.log(surface / mean)
    width = _STUDENT_95 * np.hypot(scatter, error)
    return np.expm1(difference), np.expm1(difference - width), np.expm1(difference + width)


def _compare_spectrum(
    spectrum: SelfAffine,
    n: int,
    surfaces: int,
    forces: Real,
    rng: int,
    report: Callable[[int, int], None],
) -> Comparison:
    """Compare random surfaces of n² points with random lines of the same spectrum."""
    springs = max(_LEAST_SPRINGS, _SPRINGS_PER_WAVE // 2 * n)
    pressed = []
    for i, seed in enumerate(_seeds(rng, surfaces)):
        report(i, surfaces)
        pressed.append(_stiffness_under(forces, spectrum.surface(n, seed)))
    report(surfaces, surfaces)
    full = np.array([stiffness for stiffness, _ in pressed])
    lines = (spectrum.line(springs, seed) for seed in _seeds(rng, _COMPARED_LINES))
    reduced = np.array([_stiffness_under(forces, line)[0] for line in lines])
    difference, low, high = relative_difference(full, reduced, paired=False)
    return Comparison(
        force_bar=forces,
        full=average(full),
        reduced=average(reduced),
        difference=difference,
        low=low,
        high=high,
        scatter=full.std(axis=0, ddof=1) / full.mean(axis=0),
        resolved=np.all([resolved for _, resolved in pressed], axis=0),
        surfaces=surfaces,
        lines=_COMPARED_LINES,
    )


def _seeds(root: int, count: int) -> list[np.random.SeedSequence]:
    return [np.random.SeedSequence(root, spawn_key=(i,)) for i in range(count)]


def _on_grid(spectrum: SelfAffine, n: int) -> SelfAffine:
    """The dimensionless spectrum, with the waves that n points carry."""
    q_low = 2 * math.pi
    return SelfAffine(
        hurst=spectrum.hurst,
        rms_height=1.0,
        q_roll=q_low * spectrum.q_roll / spectrum.q_low,
        q_high=q_low * min(spectrum.q_high / spectrum.q_low, n / 2),
    )


def _stiffness_under(
    force_bars: Real, body: Body, progress: Callable[[int, int], None] | None = None
) -> tuple[Real, Mask]:
    """Raw dimensionless stiffness under dimensionless forces, and where it is resolved."""
    forces = force_bars * body.rms_height * body.length
    curve = press(body, E_star=1.0, forces=forces, progress=progress)
    return curve.stiffness / body.length, curve.resolved
