"""A gas whose molecules fly as far as the gap is wide: what it finds at its local pressure.

A map is a small place of a seal. Over it the pressure hardly changes; along the seal it falls. So
each place has the permeance Λ of its own pressure P, all of them the same throughput, and this is

    q = W / (12 η B) ∫ P Λ(P) dP   from the outlet's pressure to the inlet's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Real

_Value = TypeVar("_Value", float, NDArray[np.float64])

# Flow between plates by the BGK equation over that of slip of the first order, found to 1e-4 by
# the program that writes the page on the flow; from the last one on with its limit, 2/π ln.
_TABLED_PATHS = (0, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 300, 1000)  # over the gap
_TABLED_EXCESS = (
    *(1, 1.0185, 1.0477, 1.0948, 1.174, 1.332, 1.4919, 1.6895, 2.0132, 2.3049, 2.6332),
    *(3.1136, 3.5041, 4.1554, 4.8965),
)
_PATH_STRETCH = 4.0  # ln(1 + 4 λ/u) makes it nearly a straight line

_NODES = (0.5 - 0.5 / math.sqrt(3), 0.5 + 0.5 / math.sqrt(3))  # of Gauss on 0 to 1
_MOST_STEPS = 40  # towards the gap of plates; each leaves less than a third of the error
_CONDUCTANCE_EXPONENT = 2.5  # about that in the gap: 3 of a liquid, 2 of molecules alone


def kinetic_excess(path: float | _Value, gap: _Value) -> _Value:
    """How much more than slip of the first order lets through kinetic theory does. [1]

    It is that of flat plates that reflect diffusely, by the BGK equation [1]_, to 0.4 %. Mean free
    path and gap are of one unit; the gap is positive.

    References
    ----------
    .. [1] Cercignani, C., Daneri, A. Flow of a rarefied gas between two parallel plates. J. Appl.
       Phys. 34, 3509-3513 (1963).
    """
    known = np.log1p(_PATH_STRETCH * np.array(_TABLED_PATHS))
    rare = np.log(gap + _PATH_STRETCH * path) - np.log(gap)
    return np.interp(rare, known, _TABLED_EXCESS) + 2 / math.pi * np.maximum(rare - known[-1], 0.0)


def conductance(gap: _Value, path: float | _Value) -> _Value:
    """Conductance of a square between plates, u³ of a liquid, whose path is zero. [length³]

    The gap is positive.
    """
    return gap**2 * (gap + 6 * path) * kinetic_excess(path, gap)


@dataclass(frozen=True)
class Rarefied:
    """How rare a gas is on its way along a seal; a liquid has no mean free path.

    Attributes
    ----------
    path : float
        Mean free path at the mean of the pressures of inlet and outlet. [length]
    fall : float
        Difference of both pressures over their sum, at least 0: 1 into a vacuum. [1]
    """

    path: float = 0.0
    fall: float = 0.0

    def is_even(self, aperture: float) -> bool:
        """Whether the permeance at the mean pressure tells what flows, to a per cent.

        It does where there is little slip, or little difference of both pressures. The limit is
        that of rough gaps, as measured, or stricter.
        """
        return 9 * self.fall**3 * self.path <= self.path + 0.6 * aperture

    @property
    def stations(self) -> list[tuple[float, float]]:
        """Weights and mean free paths of two places along the seal that tell what flows.

        They are those of Gauss for the square root of the pressure above the outlet's, as a rare
        gas in a vacuum has a logarithm there: to a per cent for all gases and pressures. The
        weighted permeances are the mean of P Λ over the mean pressure.
        """
        pressures = [1 - self.fall + 2 * self.fall * node**2 for node in _NODES]  # over the mean
        return [
            (node * pressure, self.path / pressure)
            for node, pressure in zip(_NODES, pressures, strict=True)
        ]

    def plates(self, gap: float | Real) -> Real:
        """Permeance between flat plates, the mean along the seal; zero without a gap. [length³]"""
        gaps = np.asarray(gap, dtype=float)
        if self.path == 0:
            return gaps**3
        safe = np.where(gaps > 0, gaps, 1.0)
        through = [weight * conductance(safe, path) for weight, path in self.stations]
        return np.where(gaps > 0, sum(through), 0.0 * gaps)  # of what is unknown, unknown

    def gap_of_plates(self, permeance: float) -> float:
        """Gap of flat plates that let as much through along the seal. [length]"""
        gap = float(np.cbrt(permeance))
        if self.path == 0 or gap == 0:
            return gap
        for _ in range(_MOST_STEPS):
            gap *= (permeance / float(self.plates(gap))) ** (1 / _CONDUCTANCE_EXPONENT)
        return gap
