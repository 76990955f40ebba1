"""The half-space of one material."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.checks import between, positive
from roughline.errors.public import public_making
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic, given_periodic


@public_making
@dataclass(frozen=True, repr=False)
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
    poisson : float, optional
        Poisson's ratio, from 0 to 0.5. Friction needs it: shear displaces by it, and pressure does
        not. [1]
    beta : float, optional
        Dundurs' second parameter, from -0.5 to 0.5: how much pressure displaces along the surface,
        positive where the half-space is the more compressible body. Bodies of one material, the
        default, have none. :meth:`of` gives that of a material beside a rigid body. [1]

    Raises
    ------
    InputError
        If the modulus is not positive and finite, `periodic` is something else, or one of the
        others is out of its range.

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §13.2 (waves), eq. 3.25 (cells),
       §2.3 (lines), §3.6 (shear), §5.4 (Dundurs' parameter).
    """

    E_star: float
    periodic: Periodic = False
    poisson: float | None = None
    beta: float = 0.0

    def __post_init__(self) -> None:
        if not 0 < self.E_star < math.inf:
            raise InputError(
                f"E_star is {self.E_star!r}; a positive, finite contact modulus is needed"
            )
        given_periodic("periodic", self.periodic)
        if self.poisson is not None:
            between("poisson", self.poisson, 0.0, 0.5, "a number from 0 to 0.5 is needed")
        between("beta", self.beta, -0.5, 0.5, "a number from -0.5 to 0.5 is needed")
        if self.beta and self.poisson is None:
            raise InputError(
                f"beta is {self.beta!r} without a Poisson's ratio, by which shear displaces: give "
                "poisson= too"
            )

    def __repr__(self) -> str:
        shear = "" if self.poisson is None else f", poisson={self.poisson!r}, beta={self.beta!r}"
        return f"Homogeneous(E_star={self.E_star!r}, periodic={self.periodic!r}{shear})"

    @classmethod
    def of(cls, young: float, poisson: float, *, periodic: Periodic = False) -> Homogeneous:
        """Return the half-space of a material beside a rigid body.

        The sum of two, ``rl.Homogeneous.of(E1, nu1) + rl.Homogeneous.of(E2, nu2)``, is that of two
        bodies, of which `beta` follows.

        Parameters
        ----------
        young : float
            Young's modulus. [pressure]
        poisson : float
            Poisson's ratio, from 0 to 0.5. [1]
        periodic : bool, "x" or "y", optional
            As of the class.
        """
        positive("young", young)
        between("poisson", poisson, 0.0, 0.5, "a number from 0 to 0.5 is needed")
        beta = (1 - 2 * poisson) / (2 * (1 - poisson))
        return cls(young / (1 - poisson**2), periodic, poisson, beta)

    @property
    def _n(self) -> float:
        """How much more shear across a wave displaces than shear along it: nu / (1 - nu)."""
        if self.poisson is None:
            raise InputError(
                f"half_space is {self!r} without a Poisson's ratio, and friction needs it: give "
                "half_space=rl.Homogeneous(E_star, poisson=0.3)"
            )
        return self.poisson / (1 - self.poisson)

    @property
    def is_coupled(self) -> bool:
        """Whether `beta` is not zero."""
        return self.beta != 0

    @property
    def even_shear(self) -> tuple[HalfSpace, float]:
        """Itself: shear displaces it as pressure does, times 1 + n / 2."""
        return self, 1 + self._n / 2

    def shear_spectrum(self, q: Real) -> tuple[Real, Real]:
        """Return 2 / (E* q), and 1 + n of it across."""
        along = self.spectrum(q)
        return along, (1 + self._n) * along

    def coupling_spectrum(self, q: Real) -> Real:
        """Return 2 beta / (E* q)."""
        return self.beta * self.spectrum(q)

    def shear_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real, Real]
    ) -> None:
        """Fill rows of the tables of displacements under unit shear on one cell."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.shear_kernel import across_shear, along_shear

        xx, yy, xy = rows
        x, y = (np.arange(n) for n in xx.shape)
        n, x = self._n, x + first
        self.kernel(first, spacing, yy)
        along = along_shear(x, y, *spacing, n / self.E_star)
        np.add(yy, along, out=xx)
        yy *= 1 + n
        yy -= along  # as x² / r³ and y² / r³ add up to 1 / r
        xy[:] = across_shear(x, y, *spacing, n / self.E_star)

    def coupling_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real]
    ) -> None:
        """Fill rows of the tables of displacements along the surface under pressure on one cell."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.shear_kernel import by_pressure

        x, y = (np.arange(n) for n in rows[0].shape)
        dx, dy = spacing
        rows[0][:] = by_pressure(x + first, y, dx, dy, self.beta / self.E_star)
        rows[1][:] = by_pressure(y, x + first, dy, dx, self.beta / self.E_star).T

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
