"""The half-space that a rough body is pressed into, whatever it is made of."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError


class HalfSpace(ABC):
    """An elastic half-space, before it is divided into cells.

    A new one derives from this class, and :func:`roughline.press` takes it as it is: grids, coarser
    grids and transforms are made of what it answers here. The displacement by a pressure must
    depend on the distance alone, and the energy of no pressure may be negative.

    Attributes
    ----------
    E_star : float
        Contact modulus E* of the surface, for waves much shorter than anything that the body is
        made of. It is the unit of pressures, of `force_bar` and of `stiffness_bar`. [pressure]
    periodic : bool
        Whether pressures repeat themselves beyond the grid. If not, the surface is free there.
    is_pushed_everywhere : bool
        Whether pressure displaces no place of the surface towards the other body. Then nothing can
        touch where the bodies are farther apart than they approach, and is not looked at.
    """

    E_star: float
    periodic: bool
    is_pushed_everywhere: bool = False

    @abstractmethod
    def spectrum(self, q: Real) -> Real:
        """Return the displacement over the pressure of waves.

        Parameters
        ----------
        q : ndarray
            Wavenumbers 2 pi / wavelength, not negative. [1 / length]

        Returns
        -------
        ndarray, shape of q
            Positive. Infinite at q = 0 where an even pressure displaces without bound:
            displacements of the periodic half-space count from their mean then. Else an even
            pressure displaces by this. [length / pressure]
        """

    def kernel(self, first: int, spacing: tuple[float, float], rows: Real) -> None:
        """Fill rows of the table of displacements under unit pressure on one cell.

        Only a free half-space is asked for it.

        Parameters
        ----------
        first : int
            Distance along x of the first of the rows from the loaded cell, in cells.
        spacing : tuple of float
            Sides of a cell, (dx, dy). [length]
        rows : ndarray
            Overwritten; the columns are distances along y in cells. [length / pressure]

        Raises
        ------
        InputError
            If it has none.
        """
        raise InputError(
            f"{type(self).__name__} has no kernel, which a free half-space needs: make it periodic"
        )

    @abstractmethod
    def in_units(self, pressure: float, length: float) -> HalfSpace:
        """Return the same half-space in other units.

        Parameters
        ----------
        pressure, length : float
            The new units, in the old ones. [pressure] and [length]
        """

    @abstractmethod
    def disc_stiffness(self, radius: float) -> float:
        """Return the force per approach of a rigid disc on the free half-space. [force / length]

        Guesses and the least of spaced loads are taken from it, so that an estimate will do.

        Parameters
        ----------
        radius : float
            Its radius. [length]
        """

    @property
    def mean_is_free(self) -> bool:
        """Whether displacements count from their mean, as an even pressure has no bounded one."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.periodic and bool(np.isinf(self.spectrum(np.zeros(1)))[0])
