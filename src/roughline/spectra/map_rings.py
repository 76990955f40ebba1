"""Self-affine laws compared with the rings of a map."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing import linear_algebra
from roughline.computing.arrays import Indices, Real
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.leakage import LONGER, LONGEST, map_leakage, power_inside
from roughline.spectra.self_affine_laws import HURSTS, LEAST_MEANS, Laws, Means, power_law

_CORRELATED = 2.4  # modes of a ring that vary together under a Hann window
_ROLLS_PER_DECADE = 40
_ENDS = 60  # ends that are tried with every exponent and roll-off, at most
_INSIDE, _BEYOND = 4, 2  # rings below and above an end in which its leakage is computed
_STEP = 0.25  # from end to end that is tried, and from wave to wave


@dataclass(frozen=True, eq=False)
class MapRings:
    """Mean powers of a map's rings, and how laws of its surface appear in them.

    Wavenumbers are in units of q_low, powers are q_low² C_2d.

    Attributes
    ----------
    means : Means
        Of the rings.
    windowed : bool
        Whether the map is a piece, under a window; else it is periodic.
    aspect : float
        Lx / Ly. [1]
    """

    means: Means
    windowed: bool
    aspect: float

    @classmethod
    def of(cls, spectrum: IsotropicSpectrum) -> MapRings:
        """Take the rings of a spectrum."""
        q_low = 2 * math.pi / spectrum.length
        means = Means.of(
            spectrum.q / q_low,
            spectrum.C_2d * q_low**2,
            spectrum.modes / (_CORRELATED if spectrum.windowed else 1.0),
            spectrum.windowed,
        )
        return cls(means, spectrum.windowed, spectrum.aspect)

    @property
    def modes(self) -> Real:
        """Number of modes of the map that each ring stands for."""
        return 2 * np.pi * self.means.q

    @cached_property
    def laws(self) -> Laws:
        """Every law, compared with the rings."""
        with linear_algebra.on_one_thread():  # threads gain nothing on small matrices
            return self._compare_laws()

    def _compare_laws(self) -> Laws:
        """Compare every law with the rings."""
        rolls, ends = self._rolls(), self._ends()
        # the best ends depend little on exponent and roll-off: few laws find them
        tried = [ends.compared(self._law(HURSTS[::16], roll), self.means)[0] for roll in rolls[::4]]
        least = np.min([deviance.min(axis=0) for deviance in tried], axis=0)
        ends = ends.at(np.sort(np.argsort(least, kind="stable")[:_ENDS]))
        compared = [ends.compared(self._law(HURSTS, roll), self.means) for roll in rolls]
        deviance, log_level = (np.stack([each[i] for each in compared], axis=1) for i in (0, 1))
        return Laws(HURSTS, rolls, ends.ends, ends.margins, deviance, log_level)

    def log_powers(self, hurst: float, roll: float, end: float) -> Real:
        """Logarithm of the expected power in each ring for a plateau of one; -inf beyond."""
        law = self._law(np.array([hurst]), roll)[0]
        return np.where(self.means.q <= end, law, -math.inf)

    def mean_square(self, hurst: float, roll: float, end: float) -> tuple[float, float]:
        """Mean squares of a surface as large as the map, and of the map, for a plateau of one.

        That of the map lacks the mean plane, and has what longer waves add.
        """
        last = min(end, float(self.means.q[-1]))
        edges = np.append(LONGER, np.arange(LONGER[-1] + _STEP, last + _STEP / 2, _STEP))
        q = (edges[1:] + edges[:-1]) / 2
        level = np.exp(power_law(q, np.array([hurst]), roll)[0])
        area = 2 * math.pi * q * np.diff(edges)
        whole = modes_of_surface(edges) @ level
        if not self.windowed:
            return float(whole), float(whole)
        leakage = map_leakage(self.aspect)
        return float(whole), float(area * np.interp(q, leakage.waves, leakage.kept) @ level)

    def _law(self, hursts: Real, roll: float) -> Real:
        """Logarithm of the power in each ring for a law without an end, over (hurst, ring)."""
        q = self.means.q
        law = power_law(q, hursts, roll)
        if self.windowed:
            leakage = map_leakage(self.aspect)
            long = q < leakage.response.shape[0] + 0.5
            rings = np.rint(q[long]).astype(np.intp) - 1
            waves = np.exp(power_law(leakage.waves, hursts, roll))
            law[:, long] = np.log(waves @ leakage.response[rings].T)
        return law

    def _rolls(self) -> Real:
        """Roll-offs to try, closer to each other than the rings where these are few."""
        last = max(float(self.means.q[-1]) / 2, 4.0)
        longer = np.geomspace(LONGEST, 1, 9)[:-1] if self.windowed else np.zeros(0)
        count = max(2, round(_ROLLS_PER_DECADE * math.log10(last / 4)))
        return np.concatenate([longer, np.arange(1.0, 4.0, 0.25), np.geomspace(4, last, count)])

    def _ends(self) -> _Ends:
        """Ends to try: sharp ones at every quarter of a ring, gradual ones at every ring."""
        means, q = self.means, self.means.q
        free = np.array([means.free_deviance(k) for k in range(q.size + 1)])
        least = LEAST_MEANS // 2
        width = _INSIDE + _BEYOND + 1
        # a law may stop at a ring without its window's leakage: the spectrum then ends gradually
        stops = np.arange(least, q.size)
        nowhere = np.zeros((stops.size, width), dtype=np.intp)
        gradual = _Ends(
            ends=np.append((q[stops[:-1]] + q[stops[1:]]) / 2, math.inf),
            margins=np.append(np.diff(q)[stops[:-1]] / 2, 0.0),
            untouched=stops + 1,
            near=nowhere,
            log_share=np.full(nowhere.shape, math.nan),
            beyond=free[stops + 1],
        )
        if not self.windowed:
            return gradual
        sharp = np.arange(q[least], q[-1] + 1.5, _STEP)
        first = np.searchsorted(q, sharp - _INSIDE, side="right")
        near = np.minimum(first[:, np.newaxis] + np.arange(width), q.size - 1)
        ends = sharp[:, np.newaxis]
        share = np.interp(ends - q[near], *power_inside(self.aspect))
        leaks = (first[:, np.newaxis] + np.arange(width) < q.size) & (q[near] <= ends + _BEYOND)
        leaks &= (share > 0) & ~(means.leaked[near] & (q[near] > ends))
        log_share = np.log(np.where(leaks, share, math.nan))
        beyond = free[np.searchsorted(q, sharp + _BEYOND, side="right")]
        margins = np.full(sharp.size, _STEP)
        return gradual.joined(_Ends(sharp, margins, np.maximum(first, 1), near, log_share, beyond))


def modes_of_surface(edges: Real) -> Real:
    """Number of modes that a square surface has in each range of wavenumbers.

    Where they are few they are counted; beyond, they are an area in the plane of wavevectors.
    """
    counted = 16
    m = np.arange(-counted, counted + 1)
    along = np.hypot(m[:, np.newaxis], m)
    lattice = np.histogram(along[(along > 0) & (along <= counted)], edges)[0]
    area = np.pi * np.diff(np.maximum(edges, counted) ** 2)
    return lattice + area


@dataclass(frozen=True, eq=False)
class _Ends:
    """Ends of a law, and the rings that each leaves unchanged, changes, or ignores.

    Attributes
    ----------
    ends, margins : ndarray, shape (ends,)
        As in :class:`Laws`.
    untouched : ndarray, shape (ends,)
        Number of rings that follow the law as if it had no end.
    near : ndarray, shape (ends, rings nearby)
        Rings in which the leakage at the end is computed.
    log_share : ndarray, shape (ends, rings nearby)
        Logarithm of the share of the law's power that they have; NaN for rings without leakage.
    beyond : ndarray, shape (ends,)
        Deviance of the rings beyond, where the spectrum is free.
    """

    ends: Real
    margins: Real
    untouched: Indices
    near: Indices
    log_share: Real
    beyond: Real

    def at(self, which: Indices) -> _Ends:
        """Return the ends of some indices."""
        return _Ends(*(getattr(self, name)[which] for name in self.__dataclass_fields__))

    def joined(self, other: _Ends) -> _Ends:
        """Return these ends and others."""
        pairs = ((getattr(self, name), getattr(other, name)) for name in self.__dataclass_fields__)
        return _Ends(*(np.concatenate(pair) for pair in pairs))

    def compared(self, law: Real, means: Means) -> tuple[Real, Real]:
        """Return deviances and log levels of laws (hursts, rings) with each end."""
        weight, near, last = means.weight, self.near, self.untouched - 1
        leaks = np.isfinite(self.log_share)
        share = np.where(leaks, self.log_share, 0.0)
        nearby = np.where(leaks, weight[near], 0.0)
        log_power = weight * np.log(means.power)
        scaled = weight * means.power * np.exp(-law)
        total = np.cumsum(weight)[last] + nearby.sum(axis=1)
        powers = np.cumsum(log_power)[last] + np.where(leaks, log_power[near], 0.0).sum(axis=1)
        laws = np.cumsum(weight * law, axis=1)[:, last]
        laws += (nearby * (law[:, near] + share)).sum(axis=2)
        level = np.cumsum(scaled, axis=1)[:, last]
        level += (np.where(leaks, np.exp(-share), 0.0) * scaled[:, near]).sum(axis=2)
        log_level = np.log(level / total)
        return 2 * (laws + total * log_level - powers) + self.beyond, log_level
