"""Heß's rule: any body of revolution that sticks to an elastic half-space, by quadrature.

In the reduction method the springs at the edge of the contact let go when they are pulled by
Delta l = sqrt(2 pi a w / E*). The rule holds in the limit of a short range, as JKR does, and for
bodies of revolution: the contact radius a must be the only length of the contact.

References
----------
.. [1] M. Heß, *Über die exakte Abbildung ausgewählter dreidimensionaler Kontakte auf Systeme mit
   niedrigerer räumlicher Dimension*, Cuvillier (2011).
.. [2] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
   Friction*, Springer (2015), §4.2 and 4.3.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from roughline.exact import mdr
from roughline.exact._checks import Real, positive

_TRIED_RADII = 200  # among which the states of a branch are looked for
_SMALLEST_RADIUS = 1e-6  # of them, over the largest


@dataclass(frozen=True)
class StickingBody:
    """Body of revolution of a slope f'(r) that sticks; r reaches from 0 to `largest_radius`.

    Its states are told by the contact radius a. When a body that touches as far as
    `largest_radius` is drawn back, a shrinks along the branch on which the force, or at a given
    depth the depth, falls with it, and the body comes off where that is least.

    Attributes
    ----------
    slope : callable
        f'(r); takes and returns an array. [1]
    largest_radius : float
        Radius up to which the slope is known. [length]
    E_star : float
        Contact modulus. [pressure]
    work_of_adhesion : float
        w. [energy / length²]

    Raises
    ------
    ValueError
        If any number of them is not positive.
    """

    slope: Callable[[Real], Real]
    largest_radius: float
    E_star: float
    work_of_adhesion: float

    def __post_init__(self) -> None:
        positive(
            largest_radius=self.largest_radius,
            E_star=self.E_star,
            work_of_adhesion=self.work_of_adhesion,
        )

    def elongation(self, radius: ArrayLike) -> Real:
        """Delta l = sqrt(2 pi a w / E*) at which the springs at the edge let go. [length]"""
        positive(radius=radius)
        return np.sqrt(2 * pi * np.asarray(radius) * self.work_of_adhesion / self.E_star)

    def depth(self, radius: ArrayLike) -> Real:
        """Depth d = g(a) - Delta l. [length]"""
        stretched = self.elongation(radius)
        return mdr.line_profile(self.slope, np.ravel(radius)).reshape(stretched.shape) - stretched

    def force(self, radius: ArrayLike) -> Real:
        """Force without adhesion, less 2 E* a Delta l. [force]"""
        stretched, a = self.elongation(radius), np.asarray(radius)
        pushed = [mdr.force(self.slope, each, self.E_star) for each in np.ravel(a)]
        return np.reshape(pushed, a.shape) - 2 * self.E_star * a * stretched

    @property
    def pull_off_radius(self) -> float:
        """Contact radius of the least force, at which a body under a force comes off. [length]"""
        return self._radius_of_least(self.force)

    @property
    def lift_off_radius(self) -> float:
        """Contact radius of the least depth, at which a body at a depth comes off. [length]"""
        return self._radius_of_least(self.depth)

    @property
    def pull_off_force(self) -> float:
        """Least force. [force]"""
        return float(self.force(self.pull_off_radius))

    def radius_under(self, force: float) -> float:
        """Contact radius under a force, of the body that is drawn back. [length]

        Raises
        ------
        ValueError
            If the force is below that of the pull-off, or needs more than the largest radius.
        """
        return self._radius_where(self.force, force, "force")

    def radius_at(self, depth: float) -> float:
        """Contact radius at a depth, of the body that is drawn back. [length]

        Raises
        ------
        ValueError
            If the depth is below that of the lift-off, or needs more than the largest radius.
        """
        return self._radius_where(self.depth, depth, "depth")

    def _radii(self) -> Real:
        return self.largest_radius * np.geomspace(_SMALLEST_RADIUS, 1, _TRIED_RADII)

    def _radius_of_least(self, quantity: Callable[[ArrayLike], Real]) -> float:
        """Contact radius at which a quantity is least."""
        from scipy.optimize import minimize_scalar  # here because it loads slowly

        radii = self._radii()
        least = int(quantity(radii).argmin())
        ends = radii[max(least - 1, 0)], radii[min(least + 1, _TRIED_RADII - 1)]
        tolerance = 1e-9 * ends[1]
        found = minimize_scalar(
            quantity, bounds=ends, method="bounded", options={"xatol": tolerance}
        )
        return float(found.x)

    def _radius_where(
        self, quantity: Callable[[ArrayLike], Real], value: float, name: str
    ) -> float:
        """Largest contact radius at which a quantity has a value."""
        from scipy.optimize import brentq  # here because it loads slowly

        lowest = self._radius_of_least(quantity)
        radii = np.append(lowest, self._radii()[self._radii() > lowest])
        values = quantity(radii)
        if not values[0] <= value <= values[-1]:
            raise ValueError(
                f"{name} is {value:g}; from {values[0]:g}, where the body comes off, to "
                f"{values[-1]:g}, at the largest radius, there is contact"
            )
        below = int(np.flatnonzero(values <= value)[-1])
        if values[below] == value:
            return float(radii[below])
        ends = radii[below], radii[below + 1]
        return float(brentq(lambda a: float(quantity(a)) - value, *ends, rtol=1e-14))
