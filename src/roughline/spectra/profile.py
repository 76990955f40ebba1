"""Line scans: the spectrum of straight cuts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.summary import summary
from roughline.errors import InputError
from roughline.errors.checks import refuse, several
from roughline.errors.public import public
from roughline.spectra.leakage import LONG_WAVES
from roughline.topography.body import Line
from roughline.topography.provenance import Instrument

_BINS_PER_DECADE = 20
_FEWEST_POINTS = 64
_HEIGHT_ROUNDING = 1e-12  # rms over the whole height, tilt included, below which it is rounding


@dataclass(frozen=True, eq=False)
class ProfileSpectrum:
    """Spectrum C_profile of straight cuts, averaged over bins of wavenumbers.

    Attributes
    ----------
    q : ndarray
        Multiples of q_low / 2, with q_low = 2 pi / length, for the longest waves; then geometric
        middles of bins that widen with q. [1 / length]
    C_profile : ndarray
        Square of the cosine series' coefficient, then means over the waves of the bins. [length³]
    modes : ndarray
        1 for a coefficient, twice the number of waves for a bin, as a wave has two phases; times
        the number of cuts. [1]
    edges : ndarray
        Ends of the ranges of wavenumbers that these values stand for; one more than `q`.
        [1 / length]
    length : float
        Length of a cut. [length]
    rms_height : float
        Rms height of the cuts. [length]
    spacing : float
        Of their points. [length]
    instrument : Instrument
        What is known of the instrument that measured the heights.
    """

    q: Real
    C_profile: Real
    modes: Real
    edges: Real
    length: float
    rms_height: float
    spacing: float
    instrument: Instrument

    __repr__ = summary


@public
def profile_spectrum(lines: Line | Sequence[Line]) -> ProfileSpectrum:
    """Estimate the spectrum of straight cuts.

    The tilt is removed. A cut has few long waves. They are taken from a cosine series, which needs
    no window and so uses the whole cut; for the others a Hann window is applied to it.

    Parameters
    ----------
    lines : Line or sequence of Line
        Cuts of kind "profile", of equal length and number of points. [length]

    Raises
    ------
    InputError
        If a line is not a profile, is flat, or has fewer than 64 points, or if they differ in size.
    """
    from scipy import fft  # here because it loads slowly

    cuts = [lines] if isinstance(lines, Line) else several(lines)
    if not cuts or not all(isinstance(cut, Line) for cut in cuts):
        refuse("lines", lines, 'a Line of kind "profile", or a list of them, is needed')
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
    if n < _FEWEST_POINTS:
        raise InputError(f"the line has {n} points; a spectrum needs {_FEWEST_POINTS} or more")
    heights = np.array([cut.detrended().heights for cut in cuts])
    rms = math.sqrt(float((heights**2).mean()))
    if rms <= _HEIGHT_ROUNDING * max(float(np.ptp(cut.heights)) for cut in cuts):
        raise InputError("the heights are constant: they have no spectrum")
    q_low = 2 * math.pi / first.length
    k = np.arange(2, 2 * LONG_WAVES + 1)
    series = fft.dct(heights, axis=1, norm="ortho")[:, k] ** 2 / n
    window = np.hanning(n + 1)[:-1]
    heights *= window / math.sqrt(float((window**2).mean()))
    waves = (n - 1) // 2
    m = np.arange(LONG_WAVES + 1, waves + 1)
    power = np.abs(fft.rfft(heights, axis=1)[:, m]) ** 2 / n**2
    bins = np.floor(_BINS_PER_DECADE * np.log10(m)).astype(np.intp)
    counts = np.bincount(bins)
    filled = counts > 0
    starts = m[np.searchsorted(bins, np.flatnonzero(filled))[1:]] - 0.5
    means = np.bincount(bins, power.mean(axis=0))[filled] / counts[filled]
    return ProfileSpectrum(
        q=q_low * np.append(k / 2, np.exp(np.bincount(bins, np.log(m))[filled] / counts[filled])),
        C_profile=np.append(series.mean(axis=0), means) / q_low,
        modes=len(cuts) * np.append(np.ones(k.size), 2.0 * counts[filled]),
        edges=q_low * np.concatenate([[0.75], k / 2 + 0.25, starts, [waves + 0.5]]),
        length=first.length,
        rms_height=rms,
        spacing=first.length / n,
        instrument=first.provenance.instrument,
    )
