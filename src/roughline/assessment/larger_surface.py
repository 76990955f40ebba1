"""Stiffness of an interface alone: of a piece as it is, and of the surface that it was cut from."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.engineering.answer import Answer, Ends
from roughline.engineering.answers import saturated_stiffness
from roughline.engineering.declared import DECLARED
from roughline.engineering.formulas import interface_stiffness
from roughline.errors import InputError
from roughline.spectra.fit import fit_self_affine
from roughline.spectra.isotropic import isotropic_spectrum
from roughline.topography.body import Body, Line, Surface

# Where a piece shows no roll-off, waves up to this many times its side are allowed for.
_WAVES_OVER_SIDE = 4

# What was measured: contact area fractions, and the most roll-off wavelengths.
_MEASURED = (0.001, 0.95)
_MOST_WAVES = 16

# Half widths of the interval of log(stiffness of the whole surface over that of its piece), at the
# lower and the upper end, chosen to hold 95 of 100 (benchmarks/interface_stiffness.py). With a
# roll-off inside, all of them fall with its wavelength over the side.
_FEW_PATCHES = 0.16  # over the root of the contact area fraction: patches are few at light loads
_FEW_WAVES = (0.65, 0.4)
# Near full contact little decides what is still open, and sides that do not match keep gaps.
_FULL = (0.25, 0.9)
# Without a roll-off the longer waves of the whole surface make it less stiff.
_UNKNOWN_PATCHES = 0.02
_UNKNOWN_WAVES = (1.8, 0.35)
_UNKNOWN_FULL = (0.0, 0.5)

_PUNCH_ERROR = 0.396  # of the stiffness of a punch on n x n points, times n


def roll_offs_along_a_side(surface: Surface) -> float | None:
    """Roll-off wavelengths along a side of a surface.

    Parameters
    ----------
    surface : Surface
        Without its tilt. [length]

    Returns
    -------
    float or None
        None if the fitted interval of the roll-off reaches the longest waves, so that there may be
        none, or if there are too few points for a fit.
    """
    try:
        fit = fit_self_affine(isotropic_spectrum(surface))
    except InputError:
        return None
    if fit.q_roll is None or fit.q_roll_interval[0] <= fit.q_low * (1 + 1e-9):
        return None
    return fit.q_roll * surface.length / (2 * math.pi)


def share_of_the_whole(area_fraction: ArrayLike, roll_offs: float | None) -> tuple[Real, Real]:
    """Stiffness per area of a large surface over that of a piece of it, both periodic.

    Both ends, between which 95 of 100 lie under the same mean pressure. Nearer to full contact
    than was measured the upper end is infinite.

    Parameters
    ----------
    area_fraction : array_like
        Of the piece. [1]
    roll_offs : float or None
        Along its side, as of :func:`roll_offs_along_a_side`.
    """
    share = np.clip(np.asarray(area_fraction, dtype=np.float64), 0.0, 1.0)
    lightest, fullest = _MEASURED
    with np.errstate(divide="ignore"):
        patches = 1 / np.sqrt(np.fmax(share, lightest))
        patches *= 1 + np.log(np.fmax(lightest / share, 1.0)) / 2  # stiffness goes on as a power
        full = np.sqrt(np.minimum(share, fullest) / (1 - np.minimum(share, fullest)))
    if roll_offs is None:
        waves, constants = 1.0, (_UNKNOWN_PATCHES, _UNKNOWN_WAVES, _UNKNOWN_FULL)
    else:
        waves, constants = min(roll_offs, _MOST_WAVES), (_FEW_PATCHES, _FEW_WAVES, _FULL)
    few, long, filled = constants
    low, high = ((few * patches + long[i] + filled[i] * full) / waves for i in (0, 1))
    return np.exp(-low), np.where(share > fullest, np.inf, np.exp(high))


def stiffness_of_the_piece(body: Body, curve: Curve, interval: Ends | None = None) -> Answer:
    """Interface stiffness of a free body as it is, 1 / k_i = 1 / k - 1 / k_s.

    Nearer to the punch than its grid knows the punch, the upper end of the interval is infinite.

    Parameters
    ----------
    body : Surface or Line
        What was pressed, in SI units.
    curve : Curve
        In the free half-space, or of the reduced model.
    interval : tuple of ndarray, shape (loads,), optional
        Both ends of its stiffness on unloading. [N / m]
    """
    k = curve.stiffness if curve.unloading_stiffness is None else curve.unloading_stiffness
    if isinstance(body, Line):
        saturated, error = curve.E_star * body.length, 0.0
        validity = "of the reduced line alone; waves longer than the scan are missing"
    else:
        saturated = saturated_stiffness(body, curve.E_star)
        error = _PUNCH_ERROR / math.sqrt(body.heights.size)
        validity = (
            "of this piece alone, a punch with its outline; under the same mean pressure a large "
            "surface is a fifth less stiff at half contact and a third stiffer at 80 %: press it "
            "periodically for that"
        )
    low, high = interval or np.full((2, k.size), np.nan)
    close = k > saturated * (1 - error)
    low = np.where(close, np.fmin(low, k * (1 - error)), low)
    high = np.where(close, np.inf, high)
    known = interval is not None or bool(close.any())
    return _interface_stiffness(
        interface_stiffness(k, saturated),
        (interface_stiffness(low, saturated), interface_stiffness(high, saturated))
        if known
        else (None, None),
        validity,
    )


def stiffness_of_the_larger_surface(
    piece: Surface, curve: Curve, interval: Ends | None = None
) -> Answer:
    """Interface stiffness of the part of a large surface that a piece was cut out of.

    Its interval holds that of the large surface under the same mean pressure: it combines that of
    the curve with what one piece leaves open, as independent.

    Parameters
    ----------
    piece : Surface
        Without its tilt, in SI units.
    curve : Curve
        Of the piece in the periodic half-space.
    interval : tuple of ndarray, shape (loads,), optional
        Both ends of its stiffness on unloading. [N / m]
    """
    assert curve.area_fraction_corrected is not None
    assert curve.unloading_stiffness is not None
    roll_offs = roll_offs_along_a_side(piece)
    shares = share_of_the_whole(curve.area_fraction_corrected, roll_offs)
    k = curve.unloading_stiffness
    with np.errstate(divide="ignore", invalid="ignore"):
        halves = [np.log(share) for share in shares]
        if interval is not None:
            halves = [
                sign * np.hypot(half, np.log(end / k))
                for sign, half, end in zip((-1, 1), halves, interval, strict=True)
            ]
        low, high = (np.where(k == 0, 0.0, k * np.exp(half)) for half in halves)
    if roll_offs is None:
        held = (
            "it shows no roll-off, so that longer waves are missing: the interval allows for waves "
            f"{_WAVES_OVER_SIDE} times as long as its side, longer ones lower the stiffness further"
        )
    else:
        held = f"it holds {roll_offs:.2g} roll-off wavelengths along a side"
    return _interface_stiffness(
        k,
        (low, high),
        f"of the larger surface that the map was cut out of; {held}",
        formula="dF/dd of the map in a periodic half-space under the same force, on unloading",
    )


def _interface_stiffness(
    values: Real, ends: tuple[Real | None, Real | None], validity: str, **formula: str
) -> Answer:
    """The answer, with ends in their own order."""
    declared = vars(DECLARED["interface_stiffness"]) | {"validity": validity} | formula
    return Answer("interface_stiffness", values=values, low=ends[0], high=ends[1], **declared)
