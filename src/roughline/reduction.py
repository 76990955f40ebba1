"""The reduced model: a rough line on independent springs, solved exactly for every load at once.

References
----------
.. [1] V. L. Popov and S. G. Psakhie, "Numerical simulation methods in tribology", Tribol. Int. 40,
   916-923 (2007): a line on springs of stiffness E* per length, the paper's eq. 6.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Springs:
    """A rough line on springs, sorted by when they come into contact.

    Attributes
    ----------
    separations : ndarray, shape (n,)
        Distance of each spring at first touch, ascending from zero. [length]
    spring_stiffness : float
        E* times the spacing. [force / length]
    """

    separations: Real
    spring_stiffness: float

    @classmethod
    def under(cls, heights: Real, spacing: float, E_star: float) -> Springs:
        """Put springs under the points of a line.

        Parameters
        ----------
        heights : ndarray, shape (n,)
            Heights. [length]
        spacing : float
            Length that one spring stands for. [length]
        E_star : float
            Stiffness per length, the contact modulus. [pressure]
        """
        return cls(np.sort(heights.max() - heights), E_star * spacing)

    @cached_property
    def _sums(self) -> Real:
        """Sum of the first j separations, j = 0 ... n."""
        return np.concatenate([[0.0], np.cumsum(self.separations)])

    @cached_property
    def touch_forces(self) -> Real:
        """Force at which each spring comes into contact, ascending from zero. [force]"""
        count = np.arange(self.separations.size)
        forces = count * self.separations - self._sums[:-1]
        # equal in exact arithmetic where separations repeat: rounding must not unsort them
        return self.spring_stiffness * np.maximum.accumulate(forces)

    def count_at(self, depths: Real) -> NDArray[np.intp]:
        """Springs in contact at each depth."""
        return np.searchsorted(self.separations, depths, side="left")

    def count_under(self, forces: Real) -> NDArray[np.intp]:
        """Springs in contact under each force."""
        return np.searchsorted(self.touch_forces, forces, side="left")

    def stiffness(self, count: NDArray[np.intp]) -> Real:
        """K = dF/dd of so many springs. [force / length]"""
        return self.spring_stiffness * count.astype(np.float64)

    def force(self, depths: Real) -> Real:
        """Force at each depth. [force]"""
        count = self.count_at(depths)
        return self.spring_stiffness * (count * depths - self._sums[count])

    def depth(self, forces: Real) -> Real:
        """Depth under each positive force. [length]"""
        count = self.count_under(forces)
        return (forces / self.spring_stiffness + self._sums[count]) / count
