"""The isotropic spectrum of a given surface, and the reduced line that belongs to it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.computing.summary import summary
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.spectra import synthesis
from roughline.spectra.leakage import RING_HALF_WIDTH
from roughline.topography.body import Line, Surface
from roughline.topography.settings import Settings


@dataclass(frozen=True, eq=False)
class IsotropicSpectrum:
    """Spectrum C_2d of a surface, averaged over all directions.

    Attributes
    ----------
    q : ndarray
        Wavenumbers m 2 pi / L, m = 1, 2, ..., up to the coarser grid spacing's Nyquist.
        [1 / length]
    C_2d : ndarray
        Mean over the modes of the ring around each wavenumber. [length⁴]
    length : float
        L, square root of the nominal area. [length]
    rms_height : float
        Of the surface. [length]
    modes : ndarray
        Number of modes in each mean; 0 where it is interpolated between its neighbours. [1]
    windowed : bool
        Whether a Hann window was applied to the heights.
    aspect : float
        Lx / Ly. [1]
    """

    q: Real
    C_2d: Real
    length: float
    rms_height: float
    modes: Real
    windowed: bool
    aspect: float = 1.0

    __repr__ = summary

    def __add__(self, other: IsotropicSpectrum) -> IsotropicSpectrum:
        """Spectrum of the sum of two independent surfaces, on the waves of the first."""
        inside = (self.q >= other.q[0] * (1 - 1e-9)) & (self.q <= other.q[-1] * (1 + 1e-9))
        added = np.where(inside, np.interp(self.q, other.q, other.C_2d), 0.0)
        return replace(
            self,
            C_2d=self.C_2d + added,
            rms_height=math.hypot(self.rms_height, other.rms_height),
            windowed=self.windowed or other.windowed,
        )

    @property
    def C_reduced(self) -> Real:
        """Spectrum of the line of the reduction method, pi q C_2d, the paper's eq. 7. [length³]"""
        return np.pi * self.q * self.C_2d

    def line(self, n: int, rng: synthesis.Seed = None) -> Line:
        """Generate a random reduced line, scaled to the rms height of the surface.

        Parameters
        ----------
        n : int
            Points; more than two for each wave of the spectrum.
        rng : int, SeedSequence, Generator, optional
            Seed.

        Raises
        ------
        InputError
            If n is too small.
        """
        least = 2 * self.q.size + 1
        if n < least:
            raise InputError(f"n is {n}; the spectrum's {self.q.size} waves need {least} or more")
        moduli = np.zeros((n - 1) // 2)
        moduli[: self.q.size] = np.sqrt(self.C_reduced)
        phases, _ = synthesis.generators(rng)
        scale = self.rms_height / synthesis.rms_of(moduli)
        heights = synthesis.line_heights(moduli, phases, scale, n)
        settings: Settings = {"origin": "reduced line of a surface's spectrum", "n": int(n)}
        return Line(heights, self.length, settings=settings, is_cut_out=False)


@public
def isotropic_spectrum(surface: Surface) -> IsotropicSpectrum:
    """Estimate the spectrum of a surface, averaged over all directions.

    Opposite sides of a surface that is cut out of a larger one do not meet, so its mean plane is
    removed and a Hann window is applied. Other surfaces are periodic and taken as they are.

    Parameters
    ----------
    surface : Surface
        Heights (nx, ny). [length]

    Raises
    ------
    InputError
        If it is flat, or has fewer than 8 points along a side.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(128, rng=7)
    >>> spectrum = rl.isotropic_spectrum(surface)
    >>> print(spectrum.q[:3].round(2), spectrum.C_2d.shape == spectrum.q.shape)
    [ 6.28 12.57 18.85] True
    """
    if min(surface.shape) < 8:
        raise InputError(f"the surface has {surface.shape} points; a spectrum needs 8 x 8 or more")
    level = surface.detrended() if surface.is_cut_out else surface
    heights = level.heights - level.heights.mean()
    rms = math.sqrt(float((heights**2).mean()))
    if rms == 0:
        raise InputError("the heights are constant: they have no spectrum")
    if surface.is_cut_out:
        windows = [np.hanning(n + 1)[:-1] for n in surface.shape]
        window = np.outer(*windows)
        heights = heights * window / math.sqrt(float((window**2).mean()))
    power = np.abs(fft.analyse(heights)) ** 2 / heights.size**2
    q_low = 2 * math.pi / surface.length
    qx, qy = (
        2 * np.pi * np.fft.fftfreq(n, spacing)
        for n, spacing in zip(surface.shape, surface.spacing, strict=True)
    )
    along = np.hypot(qx[:, np.newaxis], qy).ravel() / q_low
    ring = np.rint(along).astype(np.intp)
    inside = np.abs(along - ring) <= RING_HALF_WIDTH
    last = int(min(np.pi / spacing for spacing in surface.spacing) / q_low - 0.5)
    counts, sums = (
        np.bincount(ring[inside], weights=weights, minlength=last + 1)[1 : last + 1]
        for weights in (None, power.ravel()[inside])
    )
    waves = np.arange(1.0, last + 1)
    full = counts > 0
    mean = np.interp(waves, waves[full], sums[full] / counts[full])
    cell = (2 * np.pi) ** 2 / surface.area
    return IsotropicSpectrum(
        q=q_low * waves,
        C_2d=mean / cell,
        length=surface.length,
        rms_height=rms,
        modes=counts.astype(np.float64),
        windowed=surface.is_cut_out,
        aspect=surface.sizes[0] / surface.sizes[1],
    )


def mean_spectrum(spectra: Sequence[IsotropicSpectrum]) -> IsotropicSpectrum:
    """Average the spectra of pieces of one surface, of the same size and points.

    Parameters
    ----------
    spectra : sequence of IsotropicSpectrum
        One or more, with the same waves.
    """
    squares = [each.rms_height**2 for each in spectra]
    return replace(
        spectra[0],
        C_2d=np.mean([each.C_2d for each in spectra], axis=0),
        modes=np.sum([each.modes for each in spectra], axis=0),
        rms_height=float(np.mean(squares)) ** 0.5,
    )
