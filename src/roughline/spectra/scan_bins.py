"""Self-affine laws of surfaces compared with the bins of line scans, which are their cuts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing import linear_algebra
from roughline.computing.arrays import Real
from roughline.spectra.leakage import LONG_WAVES, map_leakage
from roughline.spectra.map_rings import modes_of_surface
from roughline.spectra.profile import Cuts, ProfileSpectrum, cuts_of_surface
from roughline.spectra.self_affine_laws import HURSTS, LEAST_MEANS, Laws, Means, power_law

_NOTHING = 1e-300  # replaces a power of zero where logarithms are taken
_SAME = 1 + 1e-9  # ratio of equal wavenumbers, with rounding
_TIMES_AS_LONG = 2  # as a scan, are the periodic lines that cuts are taken from
_TABLED = 80  # wavenumbers of a drawn spectrum of cuts
_CORRELATED = 35 / 18  # modes that vary together under a Hann window: 1 + 2 (4/9 + 1/36)


@dataclass(frozen=True, eq=False)
class ScanBins:
    """Mean powers of a scan's bins, and how laws of its surface appear in them.

    Wavenumbers are in units of q_low, powers are q_low C_profile; levels are q_low² C_2d.

    Attributes
    ----------
    means : Means
        Of the bins.
    edges : ndarray, shape (means + 1,)
        Their ends.
    cuts : Cuts
        Spectrum that cuts of a surface are expected to have in them.
    """

    means: Means
    edges: Real
    cuts: Cuts

    @classmethod
    def of(cls, spectrum: ProfileSpectrum) -> ScanBins:
        """Take the bins of a spectrum."""
        q_low = 2 * math.pi / spectrum.length
        edges = spectrum.edges / q_low
        power = spectrum.C_profile * q_low
        correlated = np.where(edges[:-1] < LONG_WAVES, 1.0, _CORRELATED)
        means = Means.of(spectrum.q / q_low, power, spectrum.modes / correlated, windowed=True)
        return cls(means, edges, cuts_of_surface(edges))

    @property
    def modes(self) -> Real:
        """Number of modes of the scan that each bin stands for."""
        return 2 * np.diff(self.edges)

    @cached_property
    def laws(self) -> Laws:
        """Every law, compared with the bins."""
        with linear_algebra.on_one_thread():  # threads gain nothing on small matrices
            return self._compare_laws()

    def _compare_laws(self) -> Laws:
        """Compare every law with the bins."""
        means, cuts, bins = self.means, self.cuts, self.means.q.size
        rolls = cuts.q[cuts.q < self.edges[-1] / 2]
        # a law ends with a bin, or goes on beyond the last one
        last = np.append(np.arange(LEAST_MEANS // 2, bins), bins - 1)
        levels = np.append(cuts.longer + 1 + last[:-1], cuts.q.size)
        ends = np.append(self.edges[last[:-1] + 1], math.inf)
        margins = np.append(np.diff(self.edges)[last[:-1]], 0.0)
        beyond = np.array([means.free_deviance(k + 1) for k in last])
        inside = np.arange(bins)[:, np.newaxis] <= last
        weight = np.where(inside, means.weight[:, np.newaxis], 0.0)  # over (bin, end)
        powers = np.log(means.power) @ weight
        total, scaled = weight.sum(axis=0), weight * means.power[:, np.newaxis]
        # what each level adds to each bin, for each end
        ended = cuts.matrix.T[:, :, np.newaxis] * (
            np.arange(cuts.q.size)[:, np.newaxis, np.newaxis] < levels
        )
        ended = ended.reshape(cuts.q.size, -1)
        hursts = HURSTS[::2]  # a scan does not resolve smaller steps
        deviance = np.full((hursts.size, rolls.size, last.size), math.inf)
        log_level = np.zeros(deviance.shape)
        for j, roll in enumerate(rolls):
            sums = np.exp(power_law(cuts.q, hursts, roll)) @ ended
            sums = np.maximum(sums, _NOTHING).reshape(hursts.size, *weight.shape)
            level = np.einsum("be,hbe->he", scaled, 1 / sums) / total
            log_level[:, j] = np.log(level)
            laws = np.einsum("be,hbe->he", weight, np.log(sums))
            deviance_of_roll = 2 * (laws + total * log_level[:, j] - powers) + beyond
            possible = ends > roll  # else no power law is left
            deviance[:, j, possible] = deviance_of_roll[:, possible]
        return Laws(hursts, rolls, ends, margins, deviance, log_level)

    def log_powers(self, hurst: float, roll: float, end: float) -> Real:
        """Logarithm of the expected power in each bin for a plateau of one; -inf beyond."""
        law = np.log(np.maximum(self.cuts.matrix @ self._levels(hurst, roll, end), _NOTHING))
        return np.where(self.edges[1:] <= end * _SAME, law, -math.inf)

    def mean_square(self, hurst: float, roll: float, end: float) -> tuple[float, float]:
        """Mean squares of a surface as large as the scan, and of the scan, for a plateau of one.

        That of the scan lacks mean and tilt, and has what longer waves add.
        """
        last = min(end, float(self.edges[-1]))
        levels = self._levels(hurst, roll, last)
        whole = modes_of_surface(self.cuts.edges) @ levels
        return float(whole), float(self.cuts.mean_square @ levels)

    def surfaces(self, count: int, generator: np.random.Generator) -> Iterator[Real]:
        """Draw spectra of surfaces that the scan may have been cut from.

        A law is drawn by its likelihood, and its level and the deviations from it at random.
        Beyond the end of the law the spectrum deviates from it as the scan does. The power that
        longer waves have in a piece as large as the scan is added to its longest wave. The piece
        has few long waves, pi m of wavenumber m, so their mean power is drawn too.

        Yields
        ------
        ndarray, shape (waves,)
            Powers q_low² C_2d at the scan's waves 1, 2, ...
        """
        m = np.arange(1.0, round(float(self.edges[-1])))
        for drawn in self._drawn(count, generator):
            power = np.exp(drawn.log_powers(m))
            power[0] += self._left_of_longer(drawn.hurst, drawn.roll) * math.exp(drawn.level)
            yield power * generator.gamma(np.pi * m) / (np.pi * m)

    def drawn_cuts(self, points: int, count: int, generator: np.random.Generator) -> Iterator[Real]:
        """Draw straight cuts, as long as the scan, of Gaussian surfaces that it may be cut from.

        Yields
        ------
        ndarray, shape (points,)
            Heights, in the unit of the scan's.
        """
        last = float(self.edges[-1])
        waves = np.arange(1, _TIMES_AS_LONG * points // 2) / _TIMES_AS_LONG
        q = np.geomspace(waves[0], last, _TABLED)
        across = np.append(0.0, np.geomspace(waves[0] / 8, last, 2 * _TABLED))
        widths, waves_of_surface = np.gradient(across), np.hypot(q[:, np.newaxis], across)
        modes = np.zeros(_TIMES_AS_LONG * points // 2 + 1, dtype=np.complex128)
        for drawn in self._drawn(count, generator):
            # Abel's integral, over the wavenumbers across the cut
            powers = 2 * np.exp(drawn.log_powers(waves_of_surface)) @ widths
            logs = np.interp(np.log(waves), np.log(q), np.log(np.maximum(powers, _NOTHING)))
            random = generator.standard_normal((2, waves.size))
            amplitudes = np.exp(logs / 2) / math.sqrt(2 * _TIMES_AS_LONG)
            modes[1 : waves.size + 1] = amplitudes * (random[0] + 1j * random[1])
            yield np.fft.irfft(modes, _TIMES_AS_LONG * points, norm="forward")[:points]

    def _drawn(self, count: int, generator: np.random.Generator) -> Iterator[_DrawnSpectrum]:
        """Draw spectra: a law by its likelihood, its level and deviations from it at random."""
        laws, means = self.laws, self.means
        for law in zip(*laws.drawn(count, generator), strict=True):
            hurst, roll, end = laws.values(*law)
            level = laws.log_level[law]
            ended = self.log_powers(hurst, roll, end) + level
            endless = self.log_powers(hurst, roll, math.inf) + level
            inside = np.isfinite(ended)
            deviations = means.deviations(ended).drawn(generator)
            beyond = np.log(means.power) - endless
            weight = means.weight[inside].sum()
            level -= math.log(generator.gamma(weight) / weight)
            change = np.where(inside, deviations, beyond)
            yield _DrawnSpectrum(hurst, roll, float(level), self.edges, change)

    def _left_of_longer(self, hurst: float, roll: float) -> float:
        """Power to add to the longest wave of a square piece for the waves longer than that.

        Longer waves make the mean square of the piece larger than its own waves do.
        """
        leakage = map_leakage()
        seen = leakage.edges[1:] < self.edges[-1]
        level = np.exp(power_law(leakage.waves[seen], np.array([hurst]), roll)[0])
        area = np.pi * np.diff(leakage.edges**2)[seen]
        waves = modes_of_surface(leakage.edges)[seen]
        return max(0.0, float((area * leakage.kept[seen] - waves) @ level)) / (2 * math.pi)

    def _levels(self, hurst: float, roll: float, end: float) -> Real:
        levels = np.exp(power_law(self.cuts.q, np.array([hurst]), roll)[0])
        return np.where(self.cuts.edges[1:] <= end * _SAME, levels, 0.0)


@dataclass(frozen=True, eq=False)
class _DrawnSpectrum:
    """A spectrum of a surface: a law with a change in each bin of the scan."""

    hurst: float
    roll: float
    level: float  # logarithm of the power on the plateau
    edges: Real
    change: Real  # of the logarithm, in each bin

    def log_powers(self, q: Real) -> Real:
        """Logarithm of q_low² C_2d; beyond the scan's waves the change is that of the nearest."""
        law = power_law(q.ravel(), np.array([self.hurst]), self.roll)[0].reshape(q.shape)
        return self.level + law + self.change[np.searchsorted(self.edges[1:-1], q)]
