"""How far integrals over a spectrum differ from the sums over the waves of its bodies."""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import lru_cache

from roughline.errors import ContinuumWarning
from roughline.spectra.band import Band
from roughline.spectra.lattice import BodyName, LatticeSpectrum

_SUMMED = 64  # waves along L from which on the lattice's sum is its integral
_CLOSE = 0.05  # relative difference up to which they count as equal


@lru_cache(maxsize=256)
def sum_over_integral(band: Band, order: int, body: BodyName) -> float:
    """Moment over the whole lattice of wavevectors, over the integral.

    The sum is taken over the longest waves; over shorter ones it equals the integral.
    """
    whole = band.moment(order)
    summed = LatticeSpectrum.of(band, 1.0, 2 * _SUMMED + 1, body)
    # half a wave further: each wavevector stands for the cell around it
    edge = min(band.q_high, (_SUMMED + 0.5) * band.q_low)
    rest = replace(band, q_roll=min(band.q_roll, edge), q_high=edge).moment(order)
    return 1 + (summed.moment(order) - rest) / whole


def are_close(factor: float) -> bool:
    """Whether a quantity of the continuum, over that of the bodies, is within 5 % of 1."""
    return abs(factor - 1) <= _CLOSE


def warn_of_difference(name: str, factor: float, body: BodyName) -> None:
    """Warn where a quantity of the continuum is more than 5 % off that of the bodies.

    It is named as an attribute of the spectrum. The warning points at the caller of the property or
    method that calls this through one function.
    """
    if are_close(factor):
        return
    which = 'n, "line"' if body == "line" else "n"
    warnings.warn(
        f"{name} is that of the continuum, {factor:.2f} times that of the {body}s which "
        f"this spectrum generates, as a sum over few long waves is not the integral. Take "
        f"lattice({which}).{name} for a body of n points, or continuum.{name} for the "
        "integral",
        ContinuumWarning,
        stacklevel=4,
    )
