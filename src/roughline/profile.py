"""Line scans: the spectrum of a straight cut, and the surface's spectrum behind it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughline import synthesis
from roughline.errors import InputError
from roughline.isotropic import IsotropicSpectrum
from roughline.topography import Line

Real = NDArray[np.float64]

_BINS_PER_DECADE = 20
_LEAST_POINTS = 64
_WITHIN = 8  # wavenumbers in a bin at which it is compared
_FLAT = 1e-12  # rms over the whole height, tilt included, that is rounding
_FLOOR = 1e-14  # of the largest power: rounding
_DECAY = 3  # of C_2d within a bin, between those of H = 0 and H = 1: 2 and 4


@dataclass(frozen=True, eq=False)
class ProfileSpectrum:
    """Spectrum C_profile of straight cuts, averaged over bins of wavenumbers.

    Attributes
    ----------
    q : ndarray
        Geometric middles of bins that widen with q. [1 / length]
    C_profile : ndarray
        Mean over the waves in each. [length³]
    modes : ndarray
        Twice the number of waves in each, as a wave has two phases. [1]
    edges : ndarray
        Ends of the bins, one more than these. [1 / length]
    length : float
        Of a cut. [length]
    rms_height : float
        Of the cuts. [length]
    windowed : bool
        Whether a Hann window was laid over the heights.
    """

    q: Real
    C_profile: Real
    modes: Real
    edges: Real
    length: float
    rms_height: float
    windowed: bool

    def drawn(self, rng: synthesis.Seed = None) -> ProfileSpectrum:
        """Return a spectrum that other cuts of the same surface might have had."""
        generator, _ = synthesis.generators(rng)
        halves = self.modes / (4 if self.windowed else 2)
        drawn = self.C_profile * generator.gamma(halves) / halves
        widths = np.diff(self.edges)
        change = math.sqrt(float(drawn @ widths) / float(self.C_profile @ widths))
        return replace(self, C_profile=drawn, rms_height=self.rms_height * change)

    def surface(self) -> IsotropicSpectrum:
        """Spectrum of the surface, if it is alike in all directions.

        Abel's integral, C_profile(q) = 2 int_q^inf C_2d(q') q' dq' / sqrt(q'² - q²), is inverted
        by non-negative least squares for levels on the bins, within which C_2d falls like q^-3.
        What lies beyond the shortest wave is taken to be zero.
        """
        from scipy import optimize

        low, high = self.edges[:-1], self.edges[1:]
        kernel = np.zeros((self.q.size, self.q.size))
        for share in (np.arange(_WITHIN) + 0.5) / _WITHIN:
            at = (low + share * (high - low))[:, np.newaxis]
            kernel += _integral(at, high) - _integral(at, np.maximum(low, at))
        kernel *= 2 * self.q**_DECAY / _WITHIN
        least = _FLOOR * self.C_profile.max()
        weight = np.sqrt(self.modes) / np.maximum(self.C_profile, least)
        columns = kernel * weight[:, np.newaxis]
        scale = np.linalg.norm(columns, axis=0)
        levels = optimize.nnls(columns / scale, weight * self.C_profile)[0] / scale
        q_low = 2 * math.pi / self.length
        q = q_low * np.arange(1, round(self.edges[-1] / q_low - 0.5) + 1)
        bins = np.clip(np.searchsorted(self.edges, q) - 1, 0, self.q.size - 1)
        return IsotropicSpectrum(
            q=q,
            C_2d=levels[bins] * (q / self.q[bins]) ** -_DECAY,
            length=self.length,
            rms_height=self.rms_height,
            modes=np.zeros(q.size),
            windowed=self.windowed,
        )


def profile_spectrum(lines: Line | Sequence[Line]) -> ProfileSpectrum:
    """Estimate the spectrum of straight cuts.

    The tilt is removed and a Hann window laid over each, as its ends do not meet.

    Parameters
    ----------
    lines : Line or sequence of Line
        Cuts of kind "profile", of equal length and number of points. [length]

    Raises
    ------
    InputError
        If a line is no profile, is flat, or has fewer than 64 points, or if they differ in size.
    """
    cuts = [lines] if isinstance(lines, Line) else list(lines)
    first = cuts[0]
    for cut in cuts:
        if cut.kind != "profile":
            raise InputError(
                "this is a reduced line, whose spectrum is not that of a cut; a measured profile "
                "is needed"
            )
        if (cut.heights.size, cut.length) != (first.heights.size, first.length):
            raise InputError("the lines differ in length or points; they must be alike")
    n = first.heights.size
    if n < _LEAST_POINTS:
        raise InputError(f"the line has {n} points; a spectrum needs {_LEAST_POINTS} or more")
    heights = np.array([cut.detrended().heights for cut in cuts])
    rms = math.sqrt(float((heights**2).mean()))
    if rms <= _FLAT * max(float(np.ptp(cut.heights)) for cut in cuts):
        raise InputError("the heights are constant: they have no spectrum")
    window = np.hanning(n + 1)[:-1]
    heights *= window / math.sqrt(float((window**2).mean()))
    waves = (n - 1) // 2
    power = np.abs(np.fft.rfft(heights, axis=1)[:, 1 : waves + 1]) ** 2 / n**2
    q_low = 2 * math.pi / first.length
    m = np.arange(1, waves + 1)
    bins = np.floor(_BINS_PER_DECADE * np.log10(m)).astype(np.intp)
    counts = np.bincount(bins)
    there = counts > 0
    starts = m[np.searchsorted(bins, np.flatnonzero(there))] - 0.5
    edges = np.append(starts, waves + 0.5)
    return ProfileSpectrum(
        q=q_low * np.exp(np.bincount(bins, np.log(m))[there] / counts[there]),
        C_profile=np.bincount(bins, power.mean(axis=0))[there] / counts[there] / q_low,
        modes=(2 * len(cuts) * counts[there]).astype(np.float64),
        edges=q_low * edges,
        length=first.length,
        rms_height=rms,
        windowed=True,
    )


def _integral(q: Real, end: Real) -> Real:
    """Integral of q'^-2 / sqrt(q'² - q²) from q to an end; zero for ends below q."""
    end = np.maximum(end, q)
    return np.sqrt(end**2 - q**2) / (q**2 * end)
