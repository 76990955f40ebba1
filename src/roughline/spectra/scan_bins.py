"""Self-affine laws of surfaces compared with the bins of line scans, which are their cuts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.spectra.law_search import FEW_NODES, laws_of, least_of_few
from roughline.spectra.leakage import LONG_WAVES, map_leakage
from roughline.spectra.map_rings import modes_of_surface
from roughline.spectra.profile import Cuts, ProfileSpectrum, cuts_of_surface
from roughline.spectra.response import AS_PIXELS, Instrument, Responses
from roughline.spectra.self_affine_laws import (
    IMPOSSIBLE,
    LEAST_MEANS,
    NODES,
    Corner,
    Law,
    Laws,
    Means,
    power_law,
)

_NOTHING = 1e-300  # replaces a power of zero where logarithms are taken
_SHARP = 10  # blurs of a response among the first, which may let a sharp end be seen
_BEST_ENDS = 6  # that are tried in the first search
_FEW = 3  # ends from end to end in the first search
_LEAST_LEFT = 0.01  # of a scan's mean square
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
    nyquist : float
        Nyquist's wavenumber.
    instrument : Instrument
        What is known of the instrument.
    """

    means: Means
    edges: Real
    cuts: Cuts
    nyquist: float
    instrument: Instrument

    @classmethod
    def of(cls, spectrum: ProfileSpectrum) -> ScanBins:
        """Take the bins of a spectrum."""
        q_low = 2 * math.pi / spectrum.length
        edges = spectrum.edges / q_low
        power = spectrum.C_profile * q_low
        correlated = np.where(edges[:-1] < LONG_WAVES, 1.0, _CORRELATED)
        means = Means.of(spectrum.q / q_low, power, spectrum.modes / correlated, windowed=True)
        nyquist = spectrum.length / (2 * spectrum.spacing)
        return cls(means, edges, cuts_of_surface(edges), nyquist, spectrum.instrument)

    @property
    def modes(self) -> Real:
        """Number of modes of the scan that each bin stands for."""
        return 2 * np.diff(self.edges)

    @cached_property
    def laws(self) -> Laws:
        """Laws that are not far from the bins."""
        return laws_of(self)

    @cached_property
    def responses(self) -> Responses:
        """What the instrument may do, at the bins and at all exponents that are computed."""
        return Responses.of(self.instrument, self.means.q / self.nyquist, NODES, 1)

    @cached_property
    def weights(self) -> tuple[Real, Real]:
        """Weights of the bins for each response, and what they add to the deviance."""
        return self.means.weighed(self.responses.unknown)

    @cached_property
    def rolls(self) -> Real:
        """Roll-offs to try."""
        return self.cuts.q[self.cuts.q < self.edges[-1] / 2]

    @cached_property
    def last(self) -> Indices:
        """Last bin of each law; it ends with the bin, or goes on beyond the last one."""
        bins = self.means.q.size
        return np.append(np.arange(LEAST_MEANS // 2, bins), bins - 1)

    @cached_property
    def ends(self) -> Real:
        """Where laws may end."""
        return np.append(self.edges[self.last[:-1] + 1], math.inf)

    @cached_property
    def margins(self) -> Real:
        """Distance to the next end."""
        return np.append(np.diff(self.edges)[self.last[:-1]], 0.0)

    @cached_property
    def few_ends(self) -> Indices:
        """The ends that few laws like best, every third one, and none."""
        every = range(0, self.last.size, _FEW)
        return np.unique([*self._best_ends[0][:_BEST_ENDS], *every, self.last.size - 1])

    @cached_property
    def _best_ends(self) -> tuple[Indices, Real]:
        """Ends, the best first, and the least deviances that few laws have with them."""
        ends = np.arange(self.last.size)
        few = np.unique([0, np.searchsorted(self.responses.blurs[:_SHARP], AS_PIXELS)])
        tried = [
            self.deviances("sharp", float(roll), FEW_NODES, few, ends)[0]
            for roll in self.rolls[::4]
        ]
        least = np.min([least_of_few(each) for each in tried], axis=(0, 1))
        best = np.argsort(least, kind="stable")
        return best, least[best]

    def more_ends(self, found: Indices, most: float) -> Indices:
        """Ends near those that were found, all that may do, and none."""
        near = np.add.outer(found, np.arange(1 - _FEW, _FEW)).ravel()
        near = near[(near >= 0) & (near < self.last.size)]
        best, least = self._best_ends
        return np.unique([*near, *best[least < most], self.last.size - 1])

    def deviances(
        self, corner: Corner, roll: float, nodes: slice, responses: Indices, ends: Indices
    ) -> tuple[Real, Real]:
        """Deviances and log levels of laws, over (response, node, end)."""
        means, some = self.means, self.responses.at(nodes)
        weight, added = (each[responses] for each in self.weights)
        inside = np.arange(means.q.size)[:, np.newaxis] <= self.last[ends]
        law = np.where(inside, self._expected(NODES[nodes], roll, corner, ends), 0.0)
        shares = some.log_share[responses]
        total = (weight @ inside)[:, np.newaxis]
        scaled = weight * means.power * np.exp(-shares)
        level = np.tensordot(scaled, np.exp(-law) * inside, (1, 1)) / total
        logs = np.tensordot(weight, law, (1, 1))
        logs += ((weight * (shares - np.log(means.power))) @ inside)[:, np.newaxis]
        log_level = np.log(level)
        deviance = 2 * (logs + total * log_level) + self._beyond[ends]
        deviance += (added @ inside)[:, np.newaxis]
        two_ends = np.outer(self.responses.is_second_end[responses], np.isfinite(self.ends[ends]))
        deviance += math.log(means.weight.sum() + 1) * two_ends[:, np.newaxis]
        folds = np.flatnonzero(self.responses.reaches[responses] > 1)
        if folds.size:
            deviance[folds] = IMPOSSIBLE
            endless = np.flatnonzero(np.isinf(self.ends[ends]))
            law = law[:, :, endless[0]]
            seen = some.seen(responses[folds], law, self._at_nyquist(law, NODES[nodes]))
            found = means.endless(seen, weight[folds], added[folds])
            for each, values in zip((deviance, log_level), found, strict=True):
                each[np.ix_(folds, np.arange(law.shape[0]), endless)] = values[..., np.newaxis]
        deviance[:, :, self.ends[ends] <= roll] = IMPOSSIBLE  # else no power law is left
        return deviance, log_level

    @cached_property
    def _beyond(self) -> Real:
        """Deviance of the bins beyond each end, where the spectrum is free."""
        return np.array([self.means.free_deviance(k + 1) for k in self.last])

    def _expected(self, hursts: Real, roll: float, corner: Corner, ends: Indices) -> Real:
        """Logarithm of the power of cuts, over (hurst, bin, end)."""
        cuts = self.cuts
        level = np.append(cuts.longer + 1 + self.last[:-1], cuts.q.size)[ends]
        ended = cuts.matrix.T[:, :, np.newaxis] * (
            np.arange(cuts.q.size)[:, np.newaxis, np.newaxis] < level
        )
        sums = np.exp(power_law(cuts.q, hursts, roll, corner)) @ ended.reshape(cuts.q.size, -1)
        return np.log(np.maximum(sums, _NOTHING)).reshape(hursts.size, -1, ends.size)

    def _at_nyquist(self, law: Real, hursts: Real) -> Real:
        """Logarithm of the power of endless cuts at Nyquist's wavenumber, from that in the bins."""
        beyond = math.log(self.nyquist / self.means.q[-1])
        return np.asarray(law[:, -1] - (2 * hursts + 1) * beyond)

    def log_powers(self, law: Law, *, seen: bool = True) -> Real:
        """Logarithm of the expected power in each bin for a plateau of one; -inf beyond.

        As the instrument sees it, or that of the surface.
        """
        power = self.cuts.matrix @ self._levels(law, law.end)
        values = np.log(np.maximum(power, _NOTHING))
        if seen:
            hurst = np.array([law.hurst])
            node = int(np.abs(NODES - law.hurst).argmin())
            last = self._at_nyquist(values[np.newaxis], hurst)
            values = self.responses.at(slice(node, node + 1)).seen(
                law.explanation.response, values[np.newaxis], last
            )[0]
        return np.where(self.edges[1:] <= law.end * _SAME, values, -math.inf)

    def mean_square(self, law: Law) -> tuple[float, float]:
        """Mean squares of a surface as large as the scan, and of the scan, for a plateau of one.

        That of the scan lacks mean and tilt and what its instrument does not see, and has what
        longer waves and folded ones add.
        """
        last = min(law.end, float(self.edges[-1]))
        levels = self._levels(law, last)
        whole = modes_of_surface(self.cuts.edges) @ levels
        own, seen = (self.log_powers(law, seen=each) for each in (False, True))
        inside = np.isfinite(own)
        more = 2 * np.diff(self.edges)[inside] @ (np.exp(seen) - np.exp(own))[inside]
        piece = float(self.cuts.mean_square @ levels)
        return float(whole), max(piece + float(more), _LEAST_LEFT * piece)

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
            power[0] += self._left_of_longer(drawn.law) * math.exp(drawn.level)
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
        """Draw spectra: a law by its likelihood, its level and deviations from it at random.

        They are those of the surface as the instrument sees it.
        """
        laws, means = self.laws, self.means
        for which in zip(*laws.drawn(count, generator), strict=True):
            law = laws.at(*which)
            level = laws.log_level[which]
            ended, seen = (self.log_powers(law, seen=each) for each in (False, True))
            endless = self.log_powers(law._replace(end=math.inf), seen=False) + level
            inside = np.isfinite(ended)
            deviations = means.deviations(seen + level).drawn(generator)
            beyond = np.log(means.power) - endless
            weight = means.weight[inside].sum()
            level -= math.log(generator.gamma(weight) / weight)
            effect = np.where(inside, seen, 0.0) - np.where(inside, ended, 0.0)
            change = np.where(inside, deviations + effect, beyond)
            yield _DrawnSpectrum(law, float(level), self.edges, change)

    def _left_of_longer(self, law: Law) -> float:
        """Power to add to the longest wave of a square piece for the waves longer than that.

        Longer waves make the mean square of the piece larger than its own waves do.
        """
        leakage = map_leakage()
        seen = leakage.edges[1:] < self.edges[-1]
        corner = law.explanation.corner
        level = np.exp(power_law(leakage.waves[seen], np.array([law.hurst]), law.roll, corner)[0])
        area = np.pi * np.diff(leakage.edges**2)[seen]
        waves = modes_of_surface(leakage.edges)[seen]
        return max(0.0, float((area * leakage.kept[seen] - waves) @ level)) / (2 * math.pi)

    def _levels(self, law: Law, end: float) -> Real:
        corner = law.explanation.corner
        levels = np.exp(power_law(self.cuts.q, np.array([law.hurst]), law.roll, corner)[0])
        return np.where(self.cuts.edges[1:] <= end * _SAME, levels, 0.0)


@dataclass(frozen=True, eq=False)
class _DrawnSpectrum:
    """A spectrum of a surface: a law with a change in each bin of the scan."""

    law: Law
    level: float  # logarithm of the power on the plateau
    edges: Real
    change: Real  # of the logarithm, in each bin

    def log_powers(self, q: Real) -> Real:
        """Logarithm of q_low² C_2d; beyond the scan's waves the change is that of the nearest."""
        hurst, corner = np.array([self.law.hurst]), self.law.explanation.corner
        law = power_law(q.ravel(), hurst, self.law.roll, corner)[0].reshape(q.shape)
        return self.level + law + self.change[np.searchsorted(self.edges[1:-1], q)]
