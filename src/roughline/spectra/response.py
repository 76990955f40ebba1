"""What an instrument does to the waves of a surface: pixels, blur, and waves shorter than it sees.

Wavenumbers are in units of the Nyquist wavenumber pi / spacing here, and lengths in spacings.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal, cast

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.topography.settings import Settings

Pixels = Literal["means", "points"]

BLURS = np.append(0.0, np.geomspace(0.2, 4.0, 26))
"""Standard deviations of blurs that are tried."""

AS_PIXELS = 0.3
"""Blur that acts as means over pixels do, or a little more."""

_NOISES = np.geomspace(0.1, 1.4, 13)
"""Where white noise is as strong as the surface's waves, that is tried."""

_REACHES = (1.4, 2.0, 4.0)  # where waves may end that are shorter than the spacing resolves
_FOLDS = 0.6  # blurs up to which such waves are seen
_EACH = 3  # of them
_KNOWN = 0.1  # of the logarithm of what an instrument does, to which its law is known
_IMAGES = 2  # times twice the Nyquist wavenumber, on both sides
_DIRECTIONS = 12  # of waves, on a quarter of a circle
_PLACES = 24  # between which images of shorter waves are interpolated


@dataclass(frozen=True)
class Instrument:
    """What is known of the instrument that measured heights.

    Attributes
    ----------
    pixels : {"means", "points"} or None
        Whether heights are means over pixels or those of points; None if that is not known.
    blur : float or None
        Standard deviation of its Gaussian blur, in spacings; None if it is not known.
    tip_radius : float or None
        Radius of a tip; None if there is none, or it is not known. [length]
    """

    pixels: Pixels | None = None
    blur: float | None = None
    tip_radius: float | None = None

    @classmethod
    def of(cls, settings: Settings, spacing: float) -> Instrument:
        """Take what settings of a body say.

        Parameters
        ----------
        settings : mapping
            Of a body.
        spacing : float
            Of its points. [length]
        """
        pixels, blur, radius = (settings.get(name) for name in ("pixels", "blur", "tip_radius"))
        return cls(
            cast(Pixels, pixels) if pixels in ("means", "points") else None,
            float(blur) / spacing if isinstance(blur, float | int) else None,
            float(radius) if isinstance(radius, float | int) else None,
        )


UNKNOWN = Instrument()
"""An instrument of which nothing is known."""


@dataclass(frozen=True, eq=False)
class Responses:
    """What an instrument may do, each at the wavenumbers of a spectrum.

    Attributes
    ----------
    blurs, reaches : ndarray, shape (responses,)
        Standard deviation of its blur; end of the surface's waves, 1 if none are too short for it,
        and infinite where there is noise instead.
    log_share : ndarray, shape (responses, means)
        Logarithm of the share of their power that waves keep.
    folded : ndarray, shape (responses, hursts, means)
        Power of waves that are too short, which appear as longer ones, or of noise, over that of
        the surface at the Nyquist wavenumber.
    unknown : ndarray, shape (responses, means)
        Variance of the logarithm of the power, as responses are not known exactly.
    is_second_end : ndarray of bool, shape (responses,)
        Whether it ends a spectrum, so that another end is one cause more than is needed: a blur of
        more than pixels that are means, where it is not known.
    """

    blurs: Real
    reaches: Real
    log_share: Real
    folded: Real
    unknown: Real
    is_second_end: Mask

    @classmethod
    def of(cls, instrument: Instrument, u: Real, hursts: Real, dimensions: int) -> Responses:
        """List what an instrument may do to a map, or to a scan of one dimension.

        Parameters
        ----------
        instrument : Instrument
            What is known of it.
        u : ndarray, shape (means,)
            Wavenumbers of the spectrum.
        hursts : ndarray, shape (hursts,)
            Exponents.
        dimensions : {1, 2}
            Of the grid.
        """
        means = instrument.pixels == "means"
        tried = BLURS if instrument.blur is None else np.array([instrument.blur])
        sharp = tried[tried <= _FOLDS][::_EACH]
        noisy = sharp[: 1 if means else 3 : 2]
        blurs = np.concatenate(
            [tried, np.repeat(sharp, len(_REACHES)), np.repeat(noisy, _NOISES.size)]
        )
        reaches = np.ones(blurs.size)
        reaches[tried.size : tried.size + sharp.size * len(_REACHES)] = np.tile(
            _REACHES, sharp.size
        )
        reaches[tried.size + sharp.size * len(_REACHES) :] = np.inf
        pixel = _pixel_means(u, dimensions) if means else np.zeros(u.size)
        blurred = -((math.pi * blurs[:, np.newaxis] * u) ** 2)
        folded = np.zeros((blurs.size, hursts.size, u.size))
        places, images = _images(tuple(hursts), dimensions, means, tuple(sharp))
        for i, image in enumerate(images, tried.size):
            folded[i] = [np.interp(u, places, of_hurst) for of_hurst in image]
        exponents = -(2 * hursts + dimensions)[:, np.newaxis]
        for i, crossing in enumerate(np.tile(_NOISES, noisy.size), len(images) + tried.size):
            folded[i] = crossing**exponents
        effect = folded[:, hursts.size // 2] * np.minimum(u, 1.0) ** (1 + dimensions)  # at H = 0.5
        unknown = blurred if instrument.blur is None else np.zeros(blurred.shape)
        uncertain = (_KNOWN * (np.abs(unknown) + np.log1p(effect))) ** 2
        second = (blurs > AS_PIXELS) & (instrument.blur is None)
        return cls(blurs, reaches, blurred + pixel, folded, uncertain, second)

    def at(self, hursts: slice) -> Responses:
        """The same for some of the exponents."""
        return replace(self, folded=self.folded[:, hursts])

    def seen(self, which: int | Indices, law: Real, last: Real) -> Real:
        """Logarithm of the expected power of laws, as the instrument sees them.

        Parameters
        ----------
        which : int or ndarray, shape (responses,)
            The responses.
        law : ndarray, shape (hursts, means)
            Logarithm of the power of the surface.
        last : ndarray, shape (hursts,)
            The same at the Nyquist wavenumber.
        """
        kept = law + self.log_share[which][..., np.newaxis, :]
        folded = self.folded[which]
        if not folded.any():
            return kept
        return np.asarray(np.log(np.exp(kept) + np.exp(last)[:, np.newaxis] * folded))


def _pixel_means(u: Real, dimensions: int) -> Real:
    """Logarithm of the share of their power that waves keep in means over pixels."""
    if dimensions == 1:
        return np.asarray(2 * np.log(np.sinc(u / 2)))
    angles = _angles()
    x, y = np.outer(u, np.cos(angles)), np.outer(u, np.sin(angles))
    return np.asarray(np.log((np.sinc(x / 2) * np.sinc(y / 2)).__pow__(2).mean(axis=1)))


@lru_cache(maxsize=8)
def _images(
    hursts: tuple[float, ...], dimensions: int, means: bool, blurs: tuple[float, ...]
) -> tuple[Real, Real]:
    """Folded power at some wavenumbers, over (blur and reach, hurst, wavenumber)."""
    places = np.linspace(0, 1, _PLACES)
    shifts = 2.0 * np.arange(-_IMAGES, _IMAGES + 1)
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
    return places, np.array(folded).reshape(-1, len(hursts), _PLACES)


def _angles() -> Real:
    return np.asarray((np.arange(_DIRECTIONS) + 0.5) / _DIRECTIONS * math.pi / 2)
