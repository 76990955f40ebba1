"""Self-affine laws of surfaces compared with the bins of line scans, which are their cuts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.measurement.law_search import IMPOSSIBLE, Corner, Law, LawEnds, Observed, power_law
from roughline.measurement.map_rings import modes_of_surface
from roughline.measurement.means import FEWEST_MEANS, Means
from roughline.spectra.leakage import LONG_WAVES, LONGER_WAVES, map_leakage, scan_leakage
from roughline.spectra.profile import ProfileSpectrum

_POWER_FLOOR = 1e-300  # replaces a power of zero where logarithms are taken
_SMALLEST_REST = 0.01  # of a scan's mean square
_SAME_WAVENUMBER = 1 + 1e-9  # ratio of equal wavenumbers, with rounding
_LINE_LENGTH = 2  # as a scan, are the periodic lines that cuts are taken from
_TABLED_WAVES = 80  # wavenumbers of a drawn spectrum of cuts
_CORRELATED_MODES = 35 / 18  # modes that vary together under a Hann window: 1 + 2 (4/9 + 1/36)
_WAVES_PER_BIN = 8  # wavenumbers that a mean over a bin is of
_SHORTER_WAVES = np.array([1.25, 1.6, 2, 4, 8, 32])  # times the shortest wavenumber of a cut
_BIN_DECAY = 3  # of C_2d within a bin, between those of H = 0 and H = 1: 2 and 4


@dataclass(frozen=True, eq=False)
class _Cuts:
    """Expected spectrum of straight cuts, from levels of the surface's spectrum.

    Wavenumbers are in units of the cut's q_low. C_2d has its levels at geometric middles of ranges
    in which it falls like q^-3. They begin with waves that are longer than the cut, go on with its
    own, and end beyond the shortest.
    """

    edges: Real  # of the ranges
    q: Real  # their geometric middles
    matrix: Real  # C_profile as :func:`profile_spectrum` estimates it, over (mean, level)
    mean_square: Real  # expected of the heights, without mean and tilt, for a level of one


def _cuts_of_surface(edges: Real) -> _Cuts:
    """Compute the spectrum that cuts of a surface are expected to have.

    C_profile follows by Abel's integral, 2 int_q^inf C_2d(q') q' dq' / sqrt(q'² - q²). The longest
    waves are smeared by the ends of the cut and by the tilt that is removed. The edges are those of
    a :class:`ProfileSpectrum`. [q_low]
    """
    ends = np.concatenate([LONGER_WAVES, edges, edges[-1] * _SHORTER_WAVES])
    low, high = ends[:-1], ends[1:]
    q = np.sqrt(low * high)

    def cut(at: Real) -> Real:
        at = at[:, np.newaxis]
        return 2 * q**_BIN_DECAY * (_integral(at, high) - _integral(at, np.maximum(low, at)))

    leakage = scan_leakage()
    matrix = [leakage.response @ cut(leakage.waves)]
    shares = (np.arange(_WAVES_PER_BIN) + 0.5) / _WAVES_PER_BIN
    for first, last in pairwise(edges[leakage.response.shape[0] :]):
        matrix.append(cut(first + shares * (last - first)).mean(axis=0, keepdims=True))
    long = 2 * np.diff(leakage.edges)[:, np.newaxis] * cut(leakage.waves)
    # of waves beyond the longest modes, the mean and the tilt take nothing
    total = 2 * math.pi * q**_BIN_DECAY * (1 / low - 1 / high)
    short = np.where(high > leakage.edges[-1], total - long.sum(axis=0), 0.0)
    return _Cuts(ends, q, np.concatenate(matrix), leakage.remaining @ long + short)


def _integral(q: Real, end: Real) -> Real:
    """Integral of q'^-2 / sqrt(q'² - q²) from q to an end; zero for ends below q."""
    end = np.maximum(end, q)
    return np.sqrt(end**2 - q**2) / (q**2 * end)


@dataclass(frozen=True, eq=False)
class ScanBins(Observed):
    """Mean powers q_low C_profile of a scan's bins, and how laws of its surface appear in them.

    Levels of laws are q_low² C_2d.
    """

    edges: Real  # of the bins
    cuts: _Cuts  # spectrum that cuts of a surface are expected to have in them
    dimensions = 1

    @classmethod
    def of(cls, spectrum: ProfileSpectrum) -> ScanBins:
        """Take the bins of a spectrum."""
        q_low = 2 * math.pi / spectrum.length
        edges = spectrum.edges / q_low
        power = spectrum.C_profile * q_low
        correlated = np.where(edges[:-1] < LONG_WAVES, 1.0, _CORRELATED_MODES)
        means = Means.of(spectrum.q / q_low, power, spectrum.modes / correlated, windowed=True)
        nyquist = spectrum.length / (2 * spectrum.spacing)
        instrument = spectrum.instrument.in_units(spectrum.spacing)
        return cls(means, nyquist, instrument, edges, _cuts_of_surface(edges))

    @property
    def modes(self) -> Real:
        """Number of modes of the scan that each bin stands for."""
        return 2 * np.diff(self.edges)

    @cached_property
    def rolls(self) -> Real:
        """Roll-offs to try."""
        return self.cuts.q[self.cuts.q < self.edges[-1] / 2]

    @cached_property
    def ends(self) -> LawEnds:
        """LawEnds to try: those of the bins."""
        bins = self.means.q.size
        last = np.arange(FEWEST_MEANS // 2, bins + 1)
        last[-1] = bins - 1
        return LawEnds(
            at=np.append(self.edges[last[:-1] + 1], math.inf),
            margins=np.append(np.diff(self.edges)[last[:-1]], 0.0),
            inside=np.arange(bins) <= last[:, np.newaxis],
            log_share=np.zeros((last.size, bins)),
            free_deviance=np.array([self.means.free_deviance(int(each) + 1) for each in last]),
        )

    def expected(self, hursts: Real, roll: float, corner: Corner, ends: Real) -> tuple[Real, Real]:
        """Logarithm of the expected powers, over (hurst, bin, end), and at Nyquist's wavenumber."""
        cuts = self.cuts
        held = cuts.edges[1:, np.newaxis] <= ends * _SAME_WAVENUMBER
        ended = (cuts.matrix.T[:, :, np.newaxis] * held[:, np.newaxis]).reshape(cuts.q.size, -1)
        sums = np.exp(power_law(cuts.q, hursts, roll, corner)) @ ended
        law = np.log(np.maximum(sums, _POWER_FLOOR)).reshape(hursts.size, -1, ends.size)
        to_nyquist = math.log(self.nyquist / self.means.q[-1])
        return law, law[:, -1, -1] - (2 * hursts + 1) * to_nyquist

    def deviances(
        self, corner: Corner, roll: float, nodes: slice, responses: Indices, ends: LawEnds
    ) -> tuple[Real, Real]:
        """Deviances and log levels of laws; those that end before their roll-off cannot be."""
        deviance, log_level = super().deviances(corner, roll, nodes, responses, ends)
        deviance[:, :, ends.at <= roll] = IMPOSSIBLE
        return deviance, log_level

    def mean_square(self, law: Law) -> tuple[float, float]:
        """Mean squares of a surface as large as the scan, and of the scan, for a plateau of one."""
        cuts, last = self.cuts, min(law.end, float(self.edges[-1]))
        levels = np.exp(power_law(cuts.q, np.array([law.hurst]), law.roll, law.corner)[0])
        levels[cuts.edges[1:] > last * _SAME_WAVENUMBER] = 0.0
        own, seen = (np.exp(self.log_powers(law, seen=each)) for each in (False, True))
        piece = float(cuts.mean_square @ levels)
        more = float(self.modes @ (seen - own))
        return float(modes_of_surface(cuts.edges) @ levels), max(
            piece + more, _SMALLEST_REST * piece
        )

    def surfaces(self, count: int, generator: np.random.Generator) -> Iterator[Real]:
        """Draw spectra of surfaces that the scan may have been cut from.

        A law is drawn by its likelihood, and its level and the deviations from it at random.
        Beyond the end of the law the spectrum deviates from it as the scan does. The power that
        longer waves have in a piece as large as the scan is added to its longest wave. The piece
        has few long waves, pi m of wavenumber m, so their mean power is drawn too.

        Yields powers q_low² C_2d at the waves 1, 2, ... of the scan.
        """
        m = np.arange(1.0, round(float(self.edges[-1])))
        for drawn in self._drawn(count, generator):
            power = np.exp(drawn.log_powers(m))
            power[0] += self._left_of_longer(drawn.law) * math.exp(drawn.level)
            yield power * generator.gamma(np.pi * m) / (np.pi * m)

    def drawn_cuts(self, points: int, count: int, generator: np.random.Generator) -> Iterator[Real]:
        """Draw straight cuts, as long as the scan, of Gaussian surfaces that it may be cut from.

        Heights are in the unit of the scan.
        """
        last = float(self.edges[-1])
        waves = np.arange(1, _LINE_LENGTH * points // 2) / _LINE_LENGTH
        q = np.geomspace(waves[0], last, _TABLED_WAVES)
        across = np.append(0.0, np.geomspace(waves[0] / 8, last, 2 * _TABLED_WAVES))
        widths, waves_of_surface = np.gradient(across), np.hypot(q[:, np.newaxis], across)
        modes = np.zeros(_LINE_LENGTH * points // 2 + 1, dtype=np.complex128)
        for drawn in self._drawn(count, generator):
            # Abel's integral, over the wavenumbers across the cut
            powers = 2 * np.exp(drawn.log_powers(waves_of_surface)) @ widths
            logs = np.interp(np.log(waves), np.log(q), np.log(np.maximum(powers, _POWER_FLOOR)))
            random = generator.standard_normal((2, waves.size))
            amplitudes = np.exp(logs / 2) / math.sqrt(2 * _LINE_LENGTH)
            modes[1 : waves.size + 1] = amplitudes * (random[0] + 1j * random[1])
            yield np.fft.irfft(modes, _LINE_LENGTH * points, norm="forward")[:points]

    def _drawn(self, count: int, generator: np.random.Generator) -> Iterator[_DrawnSpectrum]:
        """Draw spectra of the surface, as the instrument sees it, as :meth:`surfaces` says."""
        laws, means = self.laws, self.means
        for which in zip(*laws.drawn(count, generator), strict=True):
            law = laws.at(*which)
            level = laws.log_level[which]
            ended, seen = (self.log_powers(law, seen=each) for each in (False, True))
            endless = self.log_powers(law._replace(end=math.inf), seen=False) + level
            inside = np.isfinite(ended)
            deviations = means.deviations(seen + level).drawn(generator)
            without_end = np.log(means.power) - endless
            weight = means.weight[inside].sum()
            level -= math.log(generator.gamma(weight) / weight)
            effect = np.where(inside, seen, 0.0) - np.where(inside, ended, 0.0)
            change = np.where(inside, deviations + effect, without_end)
            yield _DrawnSpectrum(law, float(level), self.edges, change)

    def _left_of_longer(self, law: Law) -> float:
        """Power to add to the longest wave of a square piece for the waves longer than that.

        Longer waves make the mean square of the piece larger than its own waves do.
        """
        waves, left = self._left
        level = np.exp(power_law(waves, np.array([law.hurst]), law.roll, law.corner)[0])
        return max(0.0, float(left @ level)) / (2 * math.pi)

    @cached_property
    def _left(self) -> tuple[Real, Real]:
        """Waves of a surface, and what its piece has of each beside its own modes."""
        leakage = map_leakage()
        seen = leakage.edges[1:] < self.edges[-1]
        area = np.pi * np.diff(leakage.edges**2)
        left = area * leakage.remaining - modes_of_surface(leakage.edges)
        return leakage.waves[seen], left[seen]


@dataclass(frozen=True, eq=False)
class _DrawnSpectrum:
    """A spectrum of a surface: a law with a change in each bin of the scan."""

    law: Law
    level: float  # logarithm of the power on the plateau
    edges: Real
    change: Real  # of the logarithm, in each bin

    def log_powers(self, q: Real) -> Real:
        """Logarithm of q_low² C_2d; beyond the scan's waves the change is that of the nearest."""
        hurst, roll, _, corner, _ = self.law
        law = power_law(q.ravel(), np.array([hurst]), roll, corner)[0].reshape(q.shape)
        return self.level + law + self.change[np.searchsorted(self.edges[1:-1], q)]
