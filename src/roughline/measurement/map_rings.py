"""Self-affine laws compared with the rings of a map."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Real
from roughline.measurement.law_search import Corner, Law, LawEnds, Observed, power_law
from roughline.measurement.means import FEWEST_MEANS, Means
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.leakage import LONGER_WAVES, map_leakage, power_inside

_CORRELATED_MODES = 2.4  # modes of a ring that vary together under a Hann window
_ROLLS_PER_DECADE = 40  # roll-offs that are tried, from four rings on
_RINGS_BELOW, _RINGS_ABOVE = 4, 2  # rings below and above an end in which its leakage is computed
_END_STEP = 0.25  # from end to end that is tried, and from wave to wave


@dataclass(frozen=True, eq=False)
class MapRings(Observed):
    """Mean powers q_low² C_2d of a map's rings, and how laws of its surface appear in them."""

    windowed: bool  # whether the map is a piece, under a window; else it is periodic
    aspect: float  # Lx / Ly
    dimensions = 2

    @classmethod
    def of(cls, spectrum: IsotropicSpectrum) -> MapRings:
        """Take the rings of a spectrum."""
        q_low = 2 * math.pi / spectrum.length
        means = Means.of(
            spectrum.q / q_low,
            spectrum.C_2d * q_low**2,
            spectrum.modes
            * spectrum.independent
            / (_CORRELATED_MODES if spectrum.windowed else 1.0),
            spectrum.windowed,
        )
        nyquist = spectrum.length / (2 * spectrum.spacing)
        instrument = spectrum.instrument.in_units(spectrum.spacing)
        return cls(means, nyquist, instrument, spectrum.windowed, spectrum.aspect)

    @property
    def modes(self) -> Real:
        """Number of modes of the map that each ring stands for."""
        return 2 * np.pi * self.means.q

    @cached_property
    def rolls(self) -> Real:
        """Roll-offs to try, closer to each other than the rings where these are few."""
        last = max(float(self.means.q[-1]) / 2, 4.0)
        longer = np.geomspace(LONGER_WAVES[0], 1, 9)[:-1] if self.windowed else np.zeros(0)
        count = max(2, round(_ROLLS_PER_DECADE * math.log10(last / 4)))
        return np.concatenate([longer, np.arange(1.0, 4.0, 0.25), np.geomspace(4, last, count)])

    @cached_property
    def ends(self) -> LawEnds:
        """Ends to try: sharp ones at every quarter of a ring, gradual ones at every ring."""
        means, q = self.means, self.means.q
        free = np.array([means.free_deviance(k) for k in range(q.size + 1)])
        least = FEWEST_MEANS // 2
        # a law may stop at a ring without its window's leakage: the spectrum then ends gradually
        stops = np.arange(least, q.size)
        gradual = LawEnds(
            at=np.append((q[stops[:-1]] + q[stops[1:]]) / 2, math.inf),
            margins=np.append(np.diff(q)[stops[:-1]] / 2, 0.0),
            inside=np.arange(q.size) <= stops[:, np.newaxis],
            log_share=np.zeros((stops.size, q.size)),
            free_deviance=free[stops + 1],
        )
        if not self.windowed:
            return gradual
        sharp = np.arange(q[least], q[-1] + 1.5, _END_STEP)
        ends = sharp[:, np.newaxis]
        share = np.where(
            q > ends - _RINGS_BELOW, np.interp(ends - q, *power_inside(self.aspect)), 1.0
        )
        inside = (q <= ends + _RINGS_ABOVE) & (share > 0) & ~(means.leaked & (q > ends))
        return LawEnds(
            at=np.append(sharp, gradual.at),
            margins=np.append(np.full(sharp.size, _END_STEP), gradual.margins),
            inside=np.concatenate([inside, gradual.inside]),
            log_share=np.concatenate([np.log(np.where(inside, share, 1.0)), gradual.log_share]),
            free_deviance=np.append(
                free[np.searchsorted(q, sharp + _RINGS_ABOVE, side="right")], gradual.free_deviance
            ),
        )

    def expected(self, hursts: Real, roll: float, corner: Corner, ends: Real) -> tuple[Real, Real]:
        """Logarithm of the expected powers, over (hurst, ring, 1), and at Nyquist's wavenumber."""
        q = self.means.q
        law = power_law(q, hursts, roll, corner)
        if self.windowed:
            leakage = map_leakage(self.aspect)
            long = q < leakage.response.shape[0] + 0.5
            rings = np.rint(q[long]).astype(np.intp) - 1
            waves = np.exp(power_law(leakage.waves, hursts, roll, corner))
            law[:, long] = np.log(waves @ leakage.response[rings].T)
        last = power_law(np.array([self.nyquist]), hursts, roll, corner)[:, 0]
        return law[:, :, np.newaxis], last

    def mean_square(self, law: Law) -> tuple[float, float]:
        """Mean squares of a surface as large as the map, and of the map, for a plateau of one."""
        q_rings = self.means.q
        last = min(law.end, float(q_rings[-1]))
        edges = np.append(
            LONGER_WAVES, np.arange(LONGER_WAVES[-1] + _END_STEP, last + _END_STEP / 2, _END_STEP)
        )
        q = (edges[1:] + edges[:-1]) / 2
        levels = power_law(q, np.array([law.hurst]), law.roll, law.corner)[0]
        endless = law._replace(end=math.inf)
        own, seen = (self.log_powers(endless, seen=each) for each in (False, True))
        modes = modes_of_surface(edges)
        if self.windowed:
            leakage = map_leakage(self.aspect)
            of_piece = (
                np.interp(q, leakage.waves, leakage.remaining) * 2 * math.pi * q * np.diff(edges)
            )
        else:
            of_piece = modes
        in_piece = np.exp(levels + np.interp(q, q_rings, seen - own))
        return float(modes @ np.exp(levels)), float(of_piece @ in_piece)


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
