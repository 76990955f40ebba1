"""The half-space of one material."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.public import public_making
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic, given_periodic


@public_making
@dataclass(frozen=True)
class Homogeneous(HalfSpace):
    """An elastic half-space of one material.

    Parameters
    ----------
    E_star : float
        Contact modulus, 1 / E* = (1 - nu1²) / E1 + (1 - nu2²) / E2. [pressure]
    periodic : bool, "x" or "y", optional
        Whether pressures repeat themselves beyond the grid: along both axes, none, or the one that
        is named. Where they do not, the surface is free. Along one axis only, depths count from a
        place as far away across as the surface is wide: far across from a load, its mean along that
        axis displaces by (2 / (pi E*)) ln(width / distance) for each force per length.

    Raises
    ------
    InputError
        If the modulus is not positive and finite, or `periodic` is something else.

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §13.2 (waves), eq. 3.25 (cells),
       §2.3 (lines).
    """

    E_star: float
    periodic: Periodic = False

    def __post_init__(self) -> None:
        if not 0 < self.E_star < math.inf:
            raise InputError(
                f"E_star is {self.E_star!r}; a positive, finite contact modulus is needed"
            )
        given_periodic("periodic", self.periodic)

    @property
    def is_pushed_everywhere(self) -> bool:  # type: ignore[override]
        """Whether the surface is free: the kernel is positive everywhere then."""
        return not any(self.repeats)

    @property
    def interface(self) -> Homogeneous:
        """A half-space of this modulus that repeats along both axes, as seen from its mean plane.

        Even pressure has no bounded displacement.
        """
        return replace(self, periodic=True)

    def spectrum(self, q: Real) -> Real:
        """Return 2 / (E* q), the displacement over the pressure of waves."""
        return 2 / (self.E_star * q)

    def modulus(self, q: Real) -> Real:
        """Return E*, which all waves feel."""
        return np.full_like(q, self.E_star)

    def disc_stiffness(self, radius: float) -> float:
        """Return 2 E* a."""
        return 2 * self.E_star * radius

    def kernel(self, first: int, spacing: tuple[float, float], rows: Real) -> None:
        """Fill rows of the table of displacements under unit pressure on one cell."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.kernel import love

        along_x, along_y = (np.arange(n) for n in rows.shape)
        love(first + along_x, along_y, *spacing, 1 / self.E_star, rows)

    def in_units(self, pressure: float, length: float) -> Homogeneous:
        """Return the same half-space in other units; it has no length of its own to be scaled."""
        return replace(self, E_star=self.E_star / pressure)
