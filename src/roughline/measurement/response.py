"""What an instrument does to the waves of a surface: pixels, blur, and waves shorter than it sees.

Wavenumbers are in units of the Nyquist wavenumber pi / spacing here, and lengths in spacings.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.topography.provenance import Instrument

_TRIED_BLURS = np.append(0.0, np.geomspace(0.2, 4.0, 26))  # standard deviations
_AS_PIXELS = 0.3  # blur that acts as means over pixels do, or a little more
_TRIED_NOISES = np.geomspace(0.1, 1.4, 13)
"""Where white noise is as strong as the surface's waves, that is tried."""

_FAINTEST = -200.0  # logarithm of a share of their power that waves keep, told from no less
_REACHES = (1.4, 2.0, 4.0)  # where waves may end that are shorter than the spacing resolves
_LARGEST_FOLDED_BLUR = 0.6  # up to which such waves are seen
_BLUR_STEP = 3  # from one of these blurs to the next that is tried with such waves
_KNOWN_WITHIN = 0.1  # of the logarithm of what an instrument does, to which its law is known
_DIRECTIONS = 12  # of waves, on a quarter of a circle
_IMAGE_PLACES = 24  # between which images of shorter waves are interpolated


@dataclass(frozen=True, eq=False)
class Responses:
    """What an instrument may do, each at the wavenumbers of a spectrum."""

    blurs: Real  # standard deviation of its blur
    reaches: Real  # end of the surface's waves; 1 if none are too short, infinite for noise instead
    log_share: Real  # logarithm of the share of their power that waves keep, over (response, mean)
    folded: Real
    """Power of waves that are too short and appear as longer ones, or of noise.

    Over that of the surface at the Nyquist wavenumber, over (response, hurst, mean).
    """

    unknown: Real  # variance of the logarithm of the power, as they are not known exactly
    is_second_end: Mask
    """Whether it is an unknown blur of more than pixels that are means.

    It ends a spectrum, so that another end is one cause more than is needed.
    """

    @classmethod
    def of(cls, instrument: Instrument, u: Real, hursts: Real, dimensions: int) -> Responses:
        """List what an instrument may do to a map, or to a scan of one dimension.

        Its lengths are in spacings. At wavenumbers u, and for surfaces of some exponents.
        """
        means, known = instrument.pixels == "means", instrument.blur is not None
        tried = np.array([instrument.blur]) if known else _TRIED_BLURS
        sharp = tried[tried <= _LARGEST_FOLDED_BLUR][::_BLUR_STEP]
        noisy = sharp[: 1 if means else 3 : 2]
        blurs, reaches = np.array(
            [(blur, 1.0) for blur in tried]
            + [(blur, reach) for blur in sharp for reach in _REACHES]
            + [(blur, math.inf) for blur in noisy for _ in _TRIED_NOISES]
        ).T
        folded = np.zeros((blurs.size, hursts.size, u.size))
        places, images = _images(tuple(hursts), dimensions, means, tuple(sharp))
        for i, image in enumerate(images, tried.size):
            folded[i] = [np.interp(u, places, of_hurst) for of_hurst in image]
        exponents = -(2 * hursts + dimensions)[:, np.newaxis]
        for i, crossing in enumerate(np.tile(_TRIED_NOISES, noisy.size), len(images) + tried.size):
            folded[i] = crossing**exponents
        blurred = np.maximum(-((math.pi * blurs[:, np.newaxis] * u) ** 2), _FAINTEST)
        effect = folded[:, hursts.size // 2] * np.minimum(u, 1.0) ** (1 + dimensions)  # at H = 0.5
        unknown = (_KNOWN_WITHIN * ((not known) * np.abs(blurred) + np.log1p(effect))) ** 2
        pixel = _pixel_means(u, dimensions) if means else 0.0
        second = (blurs > _AS_PIXELS) & (not known)
        return cls(blurs, reaches, blurred + pixel, folded, unknown, second)

    def seen(self, which: int | Indices, nodes: slice, law: Real, last: Real) -> Real:
        """Logarithm of the expected power of laws of some exponents, as the instrument sees them.

        The surface's is given over (hurst, mean), and at the Nyquist wavenumber.
        """
        own = law + self.log_share[which][..., np.newaxis, :]
        folded = self.folded[:, nodes][which]
        if not folded.any():
            return own
        return np.asarray(np.log(np.exp(own) + np.exp(last)[:, np.newaxis] * folded))


def _pixel_means(u: Real, dimensions: int) -> Real:
    """Logarithm of the share of their power that waves keep in means over pixels."""
    if dimensions == 1:
        return np.asarray(2 * np.log(np.sinc(u / 2)))
    angles = _angles()
    x, y = np.outer(u, np.cos(angles)), np.outer(u, np.sin(angles))
    return np.asarray(np.log(((np.sinc(x / 2) * np.sinc(y / 2)) ** 2).mean(axis=1)))


@lru_cache(maxsize=8)
def _images(
    hursts: tuple[float, ...], dimensions: int, means: bool, blurs: tuple[float, ...]
) -> tuple[Real, Real]:
    """Folded power at some wavenumbers, over (blur and reach, hurst, wavenumber)."""
    places = np.linspace(0, 1, _IMAGE_PLACES)
    farthest = math.floor((max(_REACHES) + 1) / 2)  # images farther away end before
    shifts = 2.0 * np.arange(-farthest, farthest + 1)
    if dimensions == 1:
        x = places[:, np.newaxis, np.newaxis] + shifts[shifts != 0]
        y = np.zeros(x.shape)
    else:
        angles = _angles()
        sx, sy = (each.ravel() for each in np.meshgrid(shifts, shifts))
        other = (sx != 0) | (sy != 0)
        x = np.outer(places, np.cos(angles))[..., np.newaxis] + sx[other]
        y = np.outer(places, np.sin(angles))[..., np.newaxis] + sy[other]
    q = np.hypot(x, y)
    pixel = (np.sinc(x / 2) * np.sinc(y / 2)) ** 2 if means else np.ones(q.shape)
    laws = [q ** -(2 * hurst + dimensions) * pixel for hurst in hursts]
    folded = [
        [(law * weight).sum(axis=2).mean(axis=1) for law in laws]
        for blur in blurs
        for reach in _REACHES
        for weight in [np.where(q <= reach, np.exp(-((math.pi * blur * q) ** 2)), 0.0)]
    ]
    return places, np.array(folded).reshape(-1, len(hursts), _IMAGE_PLACES)


def _angles() -> Real:
    return np.asarray((np.arange(_DIRECTIONS) + 0.5) / _DIRECTIONS * math.pi / 2)
