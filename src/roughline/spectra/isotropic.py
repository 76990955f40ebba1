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
from roughline.spectra.leakage import RING_HALF_WIDTH
from roughline.spectra.synthesis import Seed, random_line
from roughline.topography.body import Line, Surface
from roughline.topography.provenance import UNKNOWN, Instrument
from roughline.topography.settings import Settings

_BINS_PER_DECADE = 10
_FEWEST_RINGS = 3  # of wavenumbers, as 8 x 8 square pixels have
_SMALLEST_INDEPENDENT = 0.02


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
    spacing : float
        Root of a grid cell's area; where it is not given, half the shortest wavelength. [length]
    instrument : Instrument
        What is known of the instrument that measured the heights.
    independent : ndarray or float
        Share of the modes of each mean that would scatter it as much if all were alike. [1]
    isotropy : float
        Smallest over largest rms slope of all directions; 1 where that is not known. [1]
    """

    q: Real
    C_2d: Real
    length: float
    rms_height: float
    modes: Real
    windowed: bool
    aspect: float = 1.0
    spacing: float = 0.0
    instrument: Instrument = UNKNOWN
    independent: Real | float = 1.0
    isotropy: float = 1.0

    __repr__ = summary

    def __post_init__(self) -> None:
        if not self.spacing:
            object.__setattr__(self, "spacing", math.pi / float(self.q[-1]))

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

    def line(self, n: int, rng: Seed = None) -> Line:
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
        heights = random_line(moduli, self.rms_height, n, rng)
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
    level = surface.detrended() if surface.is_cut_out else surface
    q, power = surface_waves(level)
    q_low = 2 * math.pi / surface.length
    last = _rings(surface)
    if not has_rings(surface):
        ratio = max(surface.spacing) / min(surface.spacing)
        raise InputError(
            f"the pixels are {ratio:.3g} times as long as wide, so that hardly a wave is seen "
            "along both sides; a spectrum over all directions needs pixels that are nearly square: "
            "resample the finer side, or fit line scans"
        )
    along = np.minimum(q.ravel() / q_low, last + 0.5)
    ring = np.rint(along).astype(np.intp)
    inside = np.abs(along - ring) <= RING_HALF_WIDTH
    of_modes = power.ravel()[inside]
    counts, sums, squares = (
        np.bincount(ring[inside], weights, last + 1)[1 : last + 1].astype(np.float64)
        for weights in (np.ones(of_modes.size), of_modes, of_modes**2)
    )
    waves = np.arange(1.0, last + 1)
    full = counts > 0
    mean = np.interp(waves, waves[full], sums[full] / counts[full])
    cell = (2 * np.pi) ** 2 / surface.area
    return IsotropicSpectrum(
        q=q_low * waves,
        C_2d=mean / cell,
        length=surface.length,
        rms_height=level.rms_height,
        modes=counts,
        windowed=surface.is_cut_out,
        aspect=surface.sizes[0] / surface.sizes[1],
        spacing=math.sqrt(math.prod(surface.spacing)),
        instrument=surface.provenance.instrument,
        independent=_independent(waves, counts, sums, squares),
        isotropy=isotropy(level),
    )


def has_rings(surface: Surface) -> bool:
    """Whether enough wavenumbers are seen along both sides of a surface; long pixels show none."""
    return _rings(surface) >= _FEWEST_RINGS


def _rings(surface: Surface) -> int:
    """How many multiples of the least wavenumber are seen along both sides."""
    q_low = 2 * math.pi / surface.length
    return int(min(np.pi / spacing for spacing in surface.spacing) / q_low - 0.5)


def surface_waves(surface: Surface) -> tuple[Real, Real]:
    """Wavenumbers of the modes of a surface, and their shares of <h²>, as an FFT orders them.

    A piece of a larger surface is seen through a Hann window.
    """
    if min(surface.shape) < 8:
        raise InputError(f"the surface has {surface.shape} points; a spectrum needs 8 x 8 or more")
    heights = surface.heights - surface.heights.mean()
    if not np.square(heights).any():
        raise InputError("the heights are constant: they have no spectrum")
    if surface.is_cut_out:
        window = np.outer(*(np.hanning(n + 1)[:-1] for n in surface.shape))
        heights = heights * window / math.sqrt(float((window**2).mean()))
    power = np.abs(fft.analyse(heights)) ** 2 / heights.size**2
    qx, qy = (
        2 * np.pi * np.fft.fftfreq(n, spacing)
        for n, spacing in zip(surface.shape, surface.spacing, strict=True)
    )
    return np.hypot(qx[:, np.newaxis], qy), power


def mean_spectrum(spectra: Sequence[IsotropicSpectrum]) -> IsotropicSpectrum:
    """Average the spectra of pieces of one surface, of the same size and points."""
    squares = [each.rms_height**2 for each in spectra]
    return replace(
        spectra[0],
        C_2d=np.mean([each.C_2d for each in spectra], axis=0),
        modes=np.sum([each.modes for each in spectra], axis=0),
        rms_height=float(np.mean(squares)) ** 0.5,
        independent=sum(each.independent for each in spectra) / len(spectra),
        isotropy=float(np.mean([each.isotropy for each in spectra])),
    )


def _independent(waves: Real, counts: Real, sums: Real, squares: Real) -> Real:
    """Share of the modes of a ring that are independent and alike, in tenths of a decade.

    The powers of n such modes are exponential and come in pairs; the square of their sum is n / 2
    + 1 times the sum of their squares. Where they are not alike, it is less.
    """
    tenth = np.floor(_BINS_PER_DECADE * np.log10(waves)).astype(np.intp)
    known = squares > 0
    effective = np.where(known, 2 * sums**2 / np.where(known, squares, 1.0) - 2, counts)
    modes = np.bincount(tenth, counts)
    share = np.bincount(tenth, effective) / np.maximum(modes, 1)
    return np.clip(share, _SMALLEST_INDEPENDENT, 1.0)[tenth]


def isotropy(surface: Surface) -> float:
    """Smallest over largest rms slope of all directions; NaN for a flat or a thin surface."""
    if min(surface.shape) < 2:
        return math.nan
    (dx, dy), h = surface.spacing, surface.heights
    along_x = (np.diff(h, axis=0) / dx)[:, :-1] + (np.diff(h, axis=0) / dx)[:, 1:]
    along_y = (np.diff(h, axis=1) / dy)[:-1] + (np.diff(h, axis=1) / dy)[1:]
    squares = [
        float((a * b).mean())
        for a, b in ((along_x, along_x), (along_x, along_y), (along_y, along_y))
    ]
    minor, major = np.linalg.eigvalsh([squares[:2], squares[1:]])
    return math.sqrt(max(0.0, minor) / major) if major > 0 else math.nan
