"""The curve that a theory gives."""

from __future__ import annotations

from dataclasses import dataclass

from roughline.computing.arrays import Real
from roughline.computing.summary import summary


@dataclass(frozen=True, eq=False)
class TheoryCurve:
    """What a theory predicts over mean pressures.

    Attributes
    ----------
    name : str
        Name of the theory.
    pressure : ndarray, shape (loads,)
        Mean pressure over the nominal area. [pressure]
    area_fraction : ndarray, shape (loads,)
        Real over nominal contact area. [1]
    stiffness : ndarray, shape (loads,) or None
        Interface stiffness per nominal area; None where the theory has none. [pressure / length]
    mean_gap : ndarray, shape (loads,) or None
        Distance of the mean planes; None where the theory has none. [length]
    validity : str
        Where it holds.
    hydraulic_aperture : ndarray, shape (loads,) or None
        Gap of two flat plates that let as much fluid through, 0 where the contact seals; None where
        the theory has none. [length]
    """

    name: str
    pressure: Real
    area_fraction: Real
    stiffness: Real | None
    mean_gap: Real | None
    validity: str
    hydraulic_aperture: Real | None = None

    __repr__ = summary
