"""By how much a large surface may differ from pieces of it: both ends of the ratio.

All widths were chosen to hold 95 of 100: of single pieces on those of
benchmarks/interface_stiffness.py, of many on parts such as benchmarks/part_coverage.py has.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real

WAVES_OVER_SIDE = 4
"""Where a piece shows no roll-off, waves up to this many times its side are allowed for."""

# What was measured: contact area fractions, and the most roll-off wavelengths.
_MEASURED = (0.001, 0.95)
_MOST_WAVES = 16

_Pair = tuple[float, float]
"""At the lower and at the upper end."""


@dataclass(frozen=True)
class Halves:
    """Half widths of an interval of log(whole over piece), as terms that depend on the contact.

    Attributes
    ----------
    patches : float
        Over the root of the contact area fraction a: contact patches are few at light loads.
    waves : tuple of float
        Alike at all loads: the longest waves of a piece are always few.
    full : tuple of float
        Times sqrt(a / (1 - a)): near full contact little decides what is still open, and sides that
        do not match keep gaps.
    """

    patches: float
    waves: _Pair
    full: _Pair = (0.0, 0.0)


@dataclass(frozen=True)
class Share:
    """How the whole differs from its pieces under the same mean pressure, both periodic.

    Attributes
    ----------
    seen : Halves
        Of a piece with one roll-off wavelength along its side; divided by w for w wavelengths.
    unseen : Halves
        Of a piece that shows no roll-off, and so lacks the longer waves.
    bounded : bool
        Whether the quantity is a share of the area, which is known the better the fuller it is.
    """

    seen: Halves
    unseen: Halves
    bounded: bool = False


STIFFNESS_OF_ONE = Share(
    Halves(0.16, (0.65, 0.4), (0.25, 0.9)),
    # without its longer waves a piece is too stiff
    Halves(0.02, (1.8, 0.35), (0.0, 0.5)),
)
"""Stiffness per area, compared with that of a single piece."""

STIFFNESS_OF_MANY = Share(
    Halves(0.05, (0.1, 0.05), (0.0, 0.3)), Halves(0.02, (1.8, 0.1), (0.0, 0.2))
)
"""Stiffness per area, compared with the mean over many pieces: more pieces do not improve it."""

AREA_OF_ONE = Share(Halves(0.2, (0.2, 0.6)), Halves(0.06, (0.25, 0.6)), bounded=True)
"""Contact area fraction, compared with that of a single piece."""

AREA_OF_MANY = Share(Halves(0.03, (0.1, 0.35)), Halves(0.02, (0.05, 0.2)), bounded=True)
"""Contact area fraction, compared with the mean over many pieces."""


def share_of_the_whole(
    area_fraction: ArrayLike, roll_offs: float | None, of: Share = STIFFNESS_OF_ONE
) -> tuple[Real, Real]:
    """Ratio of a quantity of a large surface to that of a piece of it, both periodic.

    Returns both ends, between which 95 of 100 ratios lie under the same mean pressure. Nearer to
    full contact than was measured, the upper end of a stiffness is infinite.

    Parameters
    ----------
    area_fraction : array_like
        Of the piece. [1]
    roll_offs : float or None
        Along its side, as of :func:`roughline.assessment.larger_surface.roll_offs_along_a_side`.
    of : Share, optional
        For which quantity; default: the stiffness per area, compared with a single piece.
    """
    share = np.clip(np.asarray(area_fraction, dtype=np.float64), 0.0, 1.0)
    lightest, fullest = _MEASURED
    with np.errstate(divide="ignore"):
        patches = 1 / np.sqrt(np.fmax(share, lightest))
        patches *= 1 + np.log(np.fmax(lightest / share, 1.0)) / 2  # stiffness goes on as a power
        full = np.sqrt(np.minimum(share, fullest) / (1 - np.minimum(share, fullest)))
    if roll_offs is None:
        waves, halves = 1.0, of.unseen
    else:
        waves, halves = min(roll_offs, _MOST_WAVES), of.seen
    low, high = (
        (halves.patches * patches + halves.waves[i] + halves.full[i] * full) / waves for i in (0, 1)
    )
    if of.bounded:
        open_share = np.sqrt(1 - share)
        return np.exp(-low * open_share), np.exp(high * open_share)
    return np.exp(-low), np.where(share > fullest, np.inf, np.exp(high))
