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
    """

    name: str
    pressure: Real
    area_fraction: Real
    stiffness: Real | None
    mean_gap: Real | None
    validity: str

    __repr__ = summary
