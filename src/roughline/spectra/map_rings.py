"""Self-affine laws compared with the rings of a map."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.law_search import FEW_NODES, laws_of, least_of_few
from roughline.spectra.leakage import LONGER, LONGEST, map_leakage, power_inside
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

_CORRELATED = 2.4  # modes of a ring that vary together under a Hann window
_ROLLS_PER_DECADE = 40
_FEW_ENDS = 48  # gradual ends that are tried in the first search, about
_FEW_SHARP = 6  # sharp ends that are tried in the first search
_ENDS = 40  # sharp ends that are tried with every exponent and roll-off, at most
_SHARP = 10  # blurs of a response among the first, which may let a sharp end be seen
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
    nyquist : float
        Nyquist's wavenumber.
    instrument : Instrument
        What is known of the instrument.
    """

    means: Means
    windowed: bool
    aspect: float
    nyquist: float
    instrument: Instrument

    @classmethod
    def of(cls, spectrum: IsotropicSpectrum) -> MapRings:
        """Take the rings of a spectrum."""
        q_low = 2 * math.pi / spectrum.length
        means = Means.of(
            spectrum.q / q_low,
            spectrum.C_2d * q_low**2,
            spectrum.modes * spectrum.independent / (_CORRELATED if spectrum.windowed else 1.0),
            spectrum.windowed,
        )
        nyquist = spectrum.length / (2 * spectrum.spacing)
        return cls(means, spectrum.windowed, spectrum.aspect, nyquist, spectrum.instrument)

    @property
    def modes(self) -> Real:
        """Number of modes of the map that each ring stands for."""
        return 2 * np.pi * self.means.q

    @cached_property
    def laws(self) -> Laws:
        """Laws that are not far from the rings."""
        return laws_of(self)

    @cached_property
    def responses(self) -> Responses:
        """What the instrument may do, at the rings and at all exponents that are computed."""
        return Responses.of(self.instrument, self.means.q / self.nyquist, NODES, 2)

    @cached_property
    def weights(self) -> tuple[Real, Real]:
        """Weights of the rings for each response, and what they add to the deviance."""
        return self.means.weighed(self.responses.unknown)

    @property
    def ends(self) -> Real:
        """Where laws may end."""
        return self._ends.ends

    @property
    def margins(self) -> Real:
        """Distance to the next end."""
        return self._ends.margins

    @cached_property
    def few_ends(self) -> Indices:
        """The best sharp ends, and some of those that are gradual; the last one is none."""
        gradual = np.flatnonzero(~self._ends.is_sharp)
        few = gradual[: -1 : self._from_end_to_end]
        return np.concatenate([self._sharp_ends[0][:_FEW_SHARP], few, gradual[-1:]])

    @property
    def _from_end_to_end(self) -> int:
        return -(-self.means.q.size // _FEW_ENDS)

    @cached_property
    def _sharp_ends(self) -> tuple[Indices, Real]:
        """Sharp ends, the best first, and the least deviances that few laws have with them."""
        sharp = np.flatnonzero(self._ends.is_sharp)
        if not sharp.size:
            return sharp, np.zeros(0)
        few = np.unique([0, np.searchsorted(self.responses.blurs[:_SHARP], AS_PIXELS)])
        tried = [
            self.deviances("sharp", float(roll), FEW_NODES, few, sharp)[0]
            for roll in self.rolls[::4]
        ]
        least = np.min([least_of_few(each) for each in tried], axis=(0, 1))
        best = np.argsort(least, kind="stable")[:_ENDS]
        return sharp[best], least[best]

    def more_ends(self, found: Indices, most: float) -> Indices:
        """Gradual ends near those that were found, and all sharp ones that may do."""
        step, first = self._from_end_to_end, np.flatnonzero(~self._ends.is_sharp)[0]
        near = np.add.outer(found[found >= first], np.arange(1 - step, step)).ravel()
        near = near[(near >= first) & (near <= self.few_ends[-1])]
        sharp, least = self._sharp_ends
        return np.unique(np.concatenate([near, sharp[least < most], self.few_ends[-1:]]))

    def deviances(
        self, corner: Corner, roll: float, nodes: slice, responses: Indices, ends: Indices
    ) -> tuple[Real, Real]:
        """Deviances and log levels of laws, over (response, node, end)."""
        law, last = self._law(NODES[nodes], roll, corner)
        some, means, of_ends = self.responses.at(nodes), self.means, self._ends
        weight, added = (each[responses] for each in self.weights)
        inside = of_ends.inside[ends].T.astype(np.float64)
        log_share = of_ends.log_share[ends].T
        shares = some.log_share[responses]
        total = (weight @ inside)[:, np.newaxis]
        scaled = weight * means.power * np.exp(-shares)
        kept = inside * np.exp(-log_share)
        level = (scaled[:, np.newaxis] * np.exp(-law)) @ kept / total
        logs = (weight[:, np.newaxis] * law) @ inside
        logs += ((weight * (shares - np.log(means.power))) @ inside)[:, np.newaxis]
        logs += (weight @ (inside * log_share))[:, np.newaxis]
        log_level = np.log(level)
        deviance = 2 * (logs + total * log_level) + of_ends.beyond[ends]
        deviance += (added @ inside)[:, np.newaxis]
        two_ends = np.outer(self.responses.is_second_end[responses], np.isfinite(self.ends[ends]))
        deviance += math.log(means.weight.sum() + 1) * two_ends[:, np.newaxis]
        folds = np.flatnonzero(self.responses.reaches[responses] > 1)
        if folds.size:
            deviance[folds] = IMPOSSIBLE
            endless = np.flatnonzero(np.isinf(of_ends.ends[ends]))
            seen = some.seen(responses[folds], law, last)
            found = means.endless(seen, weight[folds], added[folds])
            for each, values in zip((deviance, log_level), found, strict=True):
                each[np.ix_(folds, np.arange(law.shape[0]), endless)] = values[..., np.newaxis]
        return deviance, log_level

    def log_powers(self, law: Law, *, seen: bool = True) -> Real:
        """Logarithm of the expected power in each ring for a plateau of one; -inf beyond.

        As the instrument sees it, or that of the surface.
        """
        values, last = self._law(np.array([law.hurst]), law.roll, law.explanation.corner)
        power = self._seen(law, values, last) if seen else values[0]
        return np.where(self.means.q <= law.end, power, -math.inf)

    def _seen(self, law: Law, values: Real, last: Real) -> Real:
        which, node = law.explanation.response, int(np.abs(NODES - law.hurst).argmin())
        return self.responses.at(slice(node, node + 1)).seen(which, values, last)[0]

    def mean_square(self, law: Law) -> tuple[float, float]:
        """Mean squares of a surface as large as the map, and of the map, for a plateau of one.

        That of the map lacks the mean plane and what its instrument does not see, and has what
        longer waves and folded ones add.
        """
        means, hurst, corner = self.means, np.array([law.hurst]), law.explanation.corner
        last = min(law.end, float(means.q[-1]))
        edges = np.append(LONGER, np.arange(LONGER[-1] + _STEP, last + _STEP / 2, _STEP))
        q = (edges[1:] + edges[:-1]) / 2
        levels = power_law(q, hurst, law.roll, corner)
        area = 2 * math.pi * q * np.diff(edges)
        whole = modes_of_surface(edges) @ np.exp(levels[0])
        values, at_last = self._law(hurst, law.roll, corner)
        change = self._seen(law, values, at_last) - values[0]
        seen = np.exp(levels[0] + np.interp(q, means.q, change))
        if not self.windowed:
            return float(whole), float(modes_of_surface(edges) @ seen)
        leakage = map_leakage(self.aspect)
        return float(whole), float(area * np.interp(q, leakage.waves, leakage.kept) @ seen)

    def _law(self, hursts: Real, roll: float, corner: Corner) -> tuple[Real, Real]:
        """Logarithm of the power in each ring without an end, over (hurst, ring), and at the last.

        The last wavenumber is Nyquist's.
        """
        q = self.means.q
        law = power_law(q, hursts, roll, corner)
        if self.windowed:
            leakage = map_leakage(self.aspect)
            long = q < leakage.response.shape[0] + 0.5
            rings = np.rint(q[long]).astype(np.intp) - 1
            waves = np.exp(power_law(leakage.waves, hursts, roll, corner))
            law[:, long] = np.log(waves @ leakage.response[rings].T)
        return law, power_law(np.array([self.nyquist]), hursts, roll, corner)[:, 0]

    @cached_property
    def rolls(self) -> Real:
        """Roll-offs to try, closer to each other than the rings where these are few."""
        last = max(float(self.means.q[-1]) / 2, 4.0)
        longer = np.geomspace(LONGEST, 1, 9)[:-1] if self.windowed else np.zeros(0)
        count = max(2, round(_ROLLS_PER_DECADE * math.log10(last / 4)))
        return np.concatenate([longer, np.arange(1.0, 4.0, 0.25), np.geomspace(4, last, count)])

    @cached_property
    def _ends(self) -> _Ends:
        """Ends to try: sharp ones at every quarter of a ring, gradual ones at every ring."""
        means, q = self.means, self.means.q
        free = np.array([means.free_deviance(k) for k in range(q.size + 1)])
        least = LEAST_MEANS // 2
        # a law may stop at a ring without its window's leakage: the spectrum then ends gradually
        stops = np.arange(least, q.size)
        gradual = _Ends(
            ends=np.append((q[stops[:-1]] + q[stops[1:]]) / 2, math.inf),
            margins=np.append(np.diff(q)[stops[:-1]] / 2, 0.0),
            inside=np.arange(q.size) <= stops[:, np.newaxis],
            log_share=np.zeros((stops.size, q.size)),
            beyond=free[stops + 1],
            is_sharp=np.zeros(stops.size, dtype=bool),
        )
        if not self.windowed:
            return gradual
        sharp = np.arange(q[least], q[-1] + 1.5, _STEP)
        ends = sharp[:, np.newaxis]
        share = np.where(q > ends - _INSIDE, np.interp(ends - q, *power_inside(self.aspect)), 1.0)
        inside = (q <= ends + _BEYOND) & (share > 0) & ~(means.leaked & (q > ends))
        beyond = free[np.searchsorted(q, sharp + _BEYOND, side="right")]
        log_share = np.log(np.where(inside, share, 1.0))
        margins = np.full(sharp.size, _STEP)
        return _Ends(
            ends=np.append(sharp, gradual.ends),
            margins=np.append(margins, gradual.margins),
            inside=np.concatenate([inside, gradual.inside]),
            log_share=np.concatenate([log_share, gradual.log_share]),
            beyond=np.append(beyond, gradual.beyond),
            is_sharp=np.append(np.ones(sharp.size, dtype=bool), gradual.is_sharp),
        )


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
    inside : ndarray of bool, shape (ends, rings)
        Rings that hold the law's power.
    log_share : ndarray, shape (ends, rings)
        Logarithm of the share of it that they have, as it leaks at a sharp end.
    beyond : ndarray, shape (ends,)
        Deviance of the rings beyond, where the spectrum is free.
    is_sharp : ndarray of bool, shape (ends,)
        Whether the law ends at once.
    """

    ends: Real
    margins: Real
    inside: Mask
    log_share: Real
    beyond: Real
    is_sharp: Mask
