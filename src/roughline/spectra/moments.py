"""Shares of a roughness by wavenumber, and the spectral moments that follow from them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.checks import refuse
from roughline.spectra.isotropic import IsotropicSpectrum, isotropic_spectrum, surface_waves
from roughline.spectra.lattice import ContinuumSpectrum, LatticeSpectrum, lattice_waves
from roughline.spectra.leakage import RING_HALF_WIDTH
from roughline.spectra.self_affine import SelfAffine
from roughline.topography.body import Surface

SurfaceOrSpectrum = Surface | SelfAffine | ContinuumSpectrum | LatticeSpectrum | IsotropicSpectrum

_BANDS_PER_DECADE = 200  # bands of wavenumbers
_TRANSFORM_ROUNDING = 1e-20  # of the largest C_2d, below which a transform's rounding lies


@dataclass(frozen=True, eq=False)
class Bands:
    """A roughness as shares of <h²> over wavenumbers."""

    q: Real  # ascending [1 / length]
    power: Real  # <h²> of the waves at each; their sum is that of the roughness [length²]


def refuse_no_roughness(given: Any) -> None:
    """Refuse what is neither a surface nor a spectrum."""
    if not isinstance(given, get_args(SurfaceOrSpectrum)):
        refuse("roughness", given, "a Surface or a spectrum is needed")


def continuum_note(roughness: SurfaceOrSpectrum) -> str:
    """What to add to a validity where integrals differ from the surfaces of a SelfAffine."""
    difference = roughness.difference_from_surfaces() if isinstance(roughness, SelfAffine) else ""
    return (
        f"; of the continuum, with {difference} of the surfaces that this spectrum generates: take "
        "spectrum.lattice(n) for those"
        if difference
        else ""
    )


def bands(roughness: SurfaceOrSpectrum) -> Bands:
    """Return the shares of <h²> by wavenumber.

    A periodic surface has those of its own waves. A piece of a larger surface has those of its
    windowed spectrum. A LatticeSpectrum is summed over its wavevectors, as a generated surface has
    them; a continuum, or a SelfAffine itself, is integrated. An IsotropicSpectrum without a window
    is summed over the square lattice of its length, one with a window is integrated.
    """
    if isinstance(roughness, Surface):
        if roughness.is_cut_out:
            return bands(isotropic_spectrum(roughness))
        q, power = surface_waves(roughness)
        return _gathered([(q.ravel()[1:], power.ravel()[1:])])
    if isinstance(roughness, LatticeSpectrum):
        if roughness.body == "line":
            raise InputError(
                'this is the lattice of a line; theories hold for surfaces: lattice(n, "surface")'
            )
        return _gathered(roughness.waves())
    if isinstance(roughness, IsotropicSpectrum):
        return _averaged(roughness)
    continuum = roughness.continuum if isinstance(roughness, SelfAffine) else roughness
    return _integrated(continuum)


def _averaged(spectrum: IsotropicSpectrum) -> Bands:
    """Shares of a spectrum that was averaged over directions."""
    q_0 = 2 * math.pi / spectrum.length
    if spectrum.windowed:
        return Bands(spectrum.q, 2 * math.pi * spectrum.q * spectrum.C_2d * q_0)
    rings = spectrum.q.size
    within = np.concatenate([q for q, _ in lattice_waves(1.0, 2 * rings + 1)])
    ring = np.rint(within).astype(np.intp)
    near = np.abs(within - ring) <= RING_HALF_WIDTH
    # the waves of a ring are not its middle: of the second, they are 2 and sqrt(5)
    middle = np.bincount(ring[near], within[near]) / np.maximum(np.bincount(ring[near]), 1)
    middle = middle[1 : rings + 1]
    known = spectrum.C_2d > _TRANSFORM_ROUNDING * spectrum.C_2d.max()
    # a power law from ring to ring, up to the edge of the last that has waves
    law = np.interp(np.log(within), np.log(middle[known]), np.log(spectrum.C_2d[known]))
    C_2d = np.where(known[ring - 1], np.exp(law), 0.0)
    return _gathered([(q_0 * within, 4 * q_0**2 * C_2d)])


def _integrated(continuum: ContinuumSpectrum) -> Bands:
    """Shares of the narrow bands of a continuum."""
    band = continuum.band
    if math.isinf(band.q_high):
        raise InputError(
            "the spectrum has no upper end, and its slopes are infinite: give q_high, or take "
            "lattice(n) for a surface of n points, or the surface itself"
        )
    low, high = math.log(band.q_low), math.log(band.q_high)
    count = max(400, math.ceil(_BANDS_PER_DECADE * (high - low) / math.log(10)))
    edges = np.exp(np.linspace(low, high, count + 1))
    q = np.sqrt(edges[1:] * edges[:-1])
    return Bands(q, 2 * math.pi * q * continuum.C_2d(q) * np.diff(edges))


def _gathered(waves: Iterable[tuple[Real, Real]]) -> Bands:
    """Join waves that differ by less than a band; <h²> and <|grad h|²> are kept."""
    sums = np.zeros((2, 0))
    first = None
    for q, power in waves:
        number = np.rint(np.log(q) * (_BANDS_PER_DECADE / math.log(10))).astype(np.intp)
        if first is None:
            first = int(number.min())
        number -= first
        count = max(sums.shape[1], int(number.max()) + 1)
        sums = np.pad(sums, ((0, 0), (0, count - sums.shape[1])))
        for row, weight in zip(sums, (power, power * q**2), strict=True):
            row += np.bincount(number, weights=weight, minlength=count)
    heights, slopes = sums[:, sums[0] > 0]
    return Bands(np.sqrt(slopes / heights), heights)


@dataclass(frozen=True, eq=False)
class Moments:
    """Spectral moments of a surface, and the summits that follow from them (Nayak 1971).

    Attributes
    ----------
    m0, m2, m4 : float
        <h²>, <h'²> and <h''²> of a straight cut. [length²], [1], [1 / length²]
    """

    m0: float
    m2: float
    m4: float

    @property
    def nayak(self) -> float:
        """Nayak's parameter m0 m4 / m2²; at least 1.5 for an isotropic surface. [1]"""
        return self.m0 * self.m4 / self.m2**2

    @property
    def rms_slope(self) -> float:
        """Rms gradient of the surface, sqrt(2 m2). [1]"""
        return math.sqrt(2 * self.m2)

    @property
    def summit_density(self) -> float:
        """Summits per area, m4 / (6 pi sqrt(3) m2). [1 / length²]"""
        return self.m4 / (6 * math.pi * math.sqrt(3) * self.m2)

    @property
    def summit_radius(self) -> float:
        """Mean radius of summits, 3 / 8 sqrt(pi / m4) (McCool 1986). [length]"""
        return 3 / 8 * math.sqrt(math.pi / self.m4)

    @property
    def summit_deviation(self) -> float:
        """Standard deviation of summit heights, sqrt((1 - .8968 / nayak) m0). [length]"""
        return math.sqrt((1 - 0.8968 / self.nayak) * self.m0)

    @property
    def summit_mean(self) -> float:
        """Mean height of summits above the mean plane, 4 sqrt(m0 / (pi nayak)). [length]"""
        return 4 * math.sqrt(self.m0 / (math.pi * self.nayak))


def moments(roughness: SurfaceOrSpectrum | Bands) -> Moments:
    """Moments of a surface or of a spectrum, from its :func:`bands`.

    References
    ----------
    P. R. Nayak, "Random process model of rough surfaces", J. Lubr. Technol. 93, 398-407 (1971).
    J. I. McCool, "Comparison of models for the contact of rough surfaces", Wear 107, 37-60 (1986).
    """
    spectrum = roughness if isinstance(roughness, Bands) else bands(roughness)
    return Moments(
        m0=float(spectrum.power.sum()),
        m2=float((spectrum.power * spectrum.q**2).sum()) / 2,
        m4=float((spectrum.power * spectrum.q**4).sum()) * 3 / 8,
    )
