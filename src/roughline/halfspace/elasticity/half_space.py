"""The half-space that a rough body is pressed into, whatever it is made of."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.checks import as_plain, refuse
from roughline.halfspace.elasticity.disc import disc_stiffness

Periodic = bool | Literal["x", "y"]
"""Whether pressures repeat themselves beyond the grid: along both axes, none, or one of them."""


def given_periodic(argument: str, given: Any) -> Periodic:
    """Return along which axes pressures repeat themselves; refuse all else."""
    value = as_plain(given)
    for each in (True, False):
        if value is each:
            return each
    for axis in ("x", "y"):
        if isinstance(value, str) and value == axis:
            return axis
    refuse(argument, given, 'True, False, "x" or "y" is needed')


def repeated_axes(periodic: Periodic) -> tuple[bool, bool]:
    """Return whether pressures repeat themselves along x, and along y."""
    return periodic in (True, "x"), periodic in (True, "y")


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
    periodic : bool, "x" or "y"
        Whether pressures repeat themselves beyond the grid: along both axes, none, or the one that
        is named. Where they do not, the surface is free. The half-space that repeats along one axis
        and is free across is a strip.
    is_pushed_everywhere : bool
        Whether pressure displaces no place of the surface towards the other body. Then nothing can
        touch where the bodies are farther apart than they approach, and is not looked at.
    spread : float
        How far layers that are harder than their base spread a load, beyond what one material does.
        The depth of a strip counts from a place that is so much farther away. [length]
    """

    E_star: float
    periodic: Periodic
    is_pushed_everywhere: bool = False
    spread: float = 0.0

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

        It is that of the free half-space, whatever repeats itself. Only a half-space that is free
        along an axis is asked for it.

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

    def shear_spectrum(self, q: Real) -> tuple[Real, Real]:
        """Return the displacements over the shear of waves, along and across their direction.

        Only friction asks for it.

        Parameters
        ----------
        q : ndarray
            Wavenumbers 2 pi / wavelength, not negative. [1 / length]

        Returns
        -------
        along, across : ndarray, shape of q
            Of a wave whose shear points along its wavevector (plane strain), and across it
            (antiplane). Infinite at q = 0 where the spectrum is. [length / pressure]

        Raises
        ------
        InputError
            If it is not known how shear displaces it.
        """
        raise InputError(
            f"half_space is {self!r}, of which it is not known how shear displaces it: friction "
            "needs Poisson's ratio, as in rl.Homogeneous(E_star, poisson=0.3)"
        )

    def coupling_spectrum(self, q: Real) -> Real:
        """Return how pressure displaces along the surface, over the pressure of waves.

        A wave p cos(q x) displaces by minus this times sin(q x) along x, and a wave of shear
        s sin(q x) by minus this times cos(q x) into the body. It is positive where pressure draws
        the surface together, as on one compressible material. [length / pressure]
        """
        return np.zeros_like(q)

    @property
    def is_coupled(self) -> bool:
        """Whether pressure displaces along the surface, and shear into the body."""
        return False

    def shear_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real, Real]
    ) -> None:
        """Fill rows of the tables of displacements along the surface under unit shear on one cell.

        Parameters
        ----------
        first, spacing
            As of :meth:`kernel`.
        rows : tuple of ndarray
            Overwritten: displacements along x by shear along x, along y by shear along y, and
            along either by shear along the other, which is odd in x and y. [length / pressure]

        Raises
        ------
        InputError
            If it has none.
        """
        raise InputError(
            f"{type(self).__name__} has no shear_kernel, which friction on a free half-space "
            "needs: make it periodic, or leave friction out"
        )

    def coupling_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real]
    ) -> None:
        """Fill rows of the tables of displacements along the surface under pressure on one cell.

        Parameters
        ----------
        first, spacing
            As of :meth:`kernel`.
        rows : tuple of ndarray
            Overwritten: displacements towards the cell, along x and along y. Each is odd in its own
            distance. [length / pressure]

        Raises
        ------
        InputError
            If it has none.
        """
        raise InputError(
            f"{type(self).__name__} has no coupling_kernel, which friction on a free half-space "
            "needs where pressure displaces along the surface: make it periodic"
        )

    @property
    def even_shear(self) -> tuple[HalfSpace, float]:
        """A half-space and a factor: times it, its spectrum is the mean of along and across.

        Friction takes it for the half-space's response to shear while it searches.
        """
        return _EvenShear(self), 1.0

    @abstractmethod
    def in_units(self, pressure: float, length: float) -> HalfSpace:
        """Return the same half-space in other units: moduli and lengths divided by the new ones.

        Parameters
        ----------
        pressure, length : float
            The new units, in the old ones. [pressure] and [length]
        """

    def disc_stiffness(self, radius: float) -> float:
        """Return the force per approach of a rigid disc on the free half-space. [force / length]

        Guesses and the range of spaced loads are taken from it, so that an estimate will do. It
        follows from the spectrum, nearly to rounding where that comes to 2 / (E* q) as fast as on
        layers; a half-space that knows it in closed form may say so.

        Parameters
        ----------
        radius : float
            Its radius. [length]
        """
        return disc_stiffness(self.spectrum, self.E_star, radius)

    def refuse(self, spacing: tuple[float, float]) -> None:  # noqa: B027 as most resolve it
        """Refuse a grid that does not resolve the half-space, if there are such grids.

        It is asked of the grid of a surface, not of the coarser ones that guesses come from.

        Parameters
        ----------
        spacing : tuple of float
            Sides of a cell, (dx, dy). [length]

        Raises
        ------
        InputError
            If the grid is too coarse.
        """

    def modulus(self, q: Real) -> Real:
        """Return the contact modulus that waves feel.

        It is that of a homogeneous half-space which they displace as much. Waves much shorter than
        anything that the body is made of feel `E_star`.

        Parameters
        ----------
        q : ndarray
            Wavenumbers 2 pi / wavelength, positive. [1 / length]

        Returns
        -------
        ndarray, shape of q
            2 / (q C(q)), with the displacement C over the pressure. [pressure]
        """
        return 2 / (q * self.spectrum(q))

    def __add__(self, other: HalfSpace) -> HalfSpace:
        """Return both, one facing the other: :class:`~roughline.TwoBodies`."""
        return TwoBodies(self, other)

    @property
    def interface(self) -> HalfSpace:
        """What it is without its mean: repeated along both axes, displaced by waves alone.

        Under even pressure layers on a rigid base are compressed as a whole; that is left out here,
        and what is left is the interface. A deep body has no bounded mean, so that its interface is
        the body itself, repeated.
        """
        return _Interface(self)

    @property
    def softest(self) -> float:
        """Contact modulus of the softest material that it is made of. [pressure]"""
        return self.E_star

    def strain(self, pressure: float, side: float) -> float:
        """Return about how far pressure strains it, on a place of some side.

        Parameters
        ----------
        pressure : float
            The mean pressure. [pressure]
        side : float
            Side of the place; infinite where pressure is everywhere. [length]
        """
        return pressure / self.E_star

    @property
    def repeats(self) -> tuple[bool, bool]:
        """Whether pressures repeat themselves beyond the grid along x, and along y."""
        return repeated_axes(self.periodic)

    @property
    def boundary(self) -> str:
        """What is beyond the grid, in words: free, periodic, or periodic along one axis."""
        return ("free", "periodic along x", "periodic along y", "periodic")[
            int(self.repeats[0]) + 2 * int(self.repeats[1])
        ]

    @property
    def has_base(self) -> bool:
        """Whether an even pressure displaces by a finite length, as on a rigid base."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return not bool(np.isinf(self.spectrum(np.zeros(1)))[0])

    @property
    def mean_is_free(self) -> bool:
        """Whether displacements count from their mean, as an even pressure has no bounded one."""
        return all(self.repeats) and not self.has_base


@dataclass(frozen=True)
class TwoBodies(HalfSpace):
    """Two half-spaces under the same pressure, whose displacements add.

    It is what ``first + second`` makes of half-spaces.

    Parameters
    ----------
    first, second : HalfSpace
        What the two bodies are, such as a :class:`~roughline.Layered` and a
        :class:`~roughline.Homogeneous` one. Both have the same `periodic`.

    Raises
    ------
    InputError
        If one is no half-space, or both do not repeat themselves along the same axes.

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §4.2: a compliance is the sum of
       those of the two bodies.
    """

    first: HalfSpace
    second: HalfSpace

    def __post_init__(self) -> None:
        for name in ("first", "second"):
            if not isinstance(getattr(self, name), HalfSpace):
                raise InputError(
                    f"is {getattr(self, name)!r}; a half-space such as rl.Homogeneous(E_star) is "
                    "needed for each of the two bodies",
                    name,
                )
        if self.first.repeats != self.second.repeats:
            raise InputError(
                f"one half-space is {self.first.boundary} and the other is {self.second.boundary}; "
                "give both the same boundary"
            )

    @property
    def E_star(self) -> float:  # type: ignore[override]
        """Contact modulus of both, 1 / E* = 1 / E*_1 + 1 / E*_2. [pressure]"""
        return 1 / (1 / self.first.E_star + 1 / self.second.E_star)

    @property
    def periodic(self) -> Periodic:  # type: ignore[override]
        """Whether pressures repeat themselves beyond the grid."""
        return self.first.periodic

    @property
    def is_pushed_everywhere(self) -> bool:  # type: ignore[override]
        """Whether pressure displaces no place of either surface towards the other body."""
        return self.first.is_pushed_everywhere and self.second.is_pushed_everywhere

    @property
    def spread(self) -> float:  # type: ignore[override]
        """How far a hard layer of one of them spreads a load. [length]"""
        return max(self.first.spread, self.second.spread)

    @property
    def softest(self) -> float:
        """Contact modulus of the softest materials of both. [pressure]"""
        return 1 / (1 / self.first.softest + 1 / self.second.softest)

    def strain(self, pressure: float, side: float) -> float:
        """Return about how far pressure strains both together. [1]"""
        return self.first.strain(pressure, side) + self.second.strain(pressure, side)

    def spectrum(self, q: Real) -> Real:
        """Return the displacement over the pressure of waves."""
        return self.first.spectrum(q) + self.second.spectrum(q)

    def kernel(self, first: int, spacing: tuple[float, float], rows: Real) -> None:
        """Fill rows of the table of displacements under unit pressure on one cell."""
        self.first.kernel(first, spacing, rows)
        other = np.empty_like(rows)
        self.second.kernel(first, spacing, other)
        rows += other

    def shear_spectrum(self, q: Real) -> tuple[Real, Real]:
        """Return the displacements over the shear of waves, along and across their direction."""
        first, second = self.first.shear_spectrum(q), self.second.shear_spectrum(q)
        return first[0] + second[0], first[1] + second[1]

    def coupling_spectrum(self, q: Real) -> Real:
        """Return how pressure displaces along the surface; the second body is mirrored."""
        return self.first.coupling_spectrum(q) - self.second.coupling_spectrum(q)

    @property
    def is_coupled(self) -> bool:
        """Whether pressure displaces along the surface; two equal bodies do not."""
        return self.first != self.second and (self.first.is_coupled or self.second.is_coupled)

    def shear_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real, Real]
    ) -> None:
        """Fill rows of the tables of displacements under unit shear on one cell."""
        self.first.shear_kernel(first, spacing, rows)
        others = np.empty_like(rows[0]), np.empty_like(rows[0]), np.empty_like(rows[0])
        self.second.shear_kernel(first, spacing, others)
        for each, other in zip(rows, others, strict=True):
            each += other

    def coupling_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real]
    ) -> None:
        """Fill rows of the tables of displacements along the surface under pressure on one cell."""
        others = np.empty_like(rows[0]), np.empty_like(rows[0])
        for each in rows:
            each[:] = 0.0
        for body, sign in ((self.first, 1.0), (self.second, -1.0)):
            if body.is_coupled:
                body.coupling_kernel(first, spacing, others)
                for each, other in zip(rows, others, strict=True):
                    each += sign * other

    def refuse(self, spacing: tuple[float, float]) -> None:
        """Refuse grids that do not resolve one of the two."""
        self.first.refuse(spacing)
        self.second.refuse(spacing)

    def in_units(self, pressure: float, length: float) -> TwoBodies:
        """Return the same half-spaces in other units."""
        return TwoBodies(*(each.in_units(pressure, length) for each in (self.first, self.second)))


@dataclass(frozen=True)
class Rigid(HalfSpace):
    """A body that nothing displaces: one that faces it as the second of two is mirrored."""

    periodic: Periodic = False
    E_star: float = math.inf
    is_pushed_everywhere: bool = True

    def spectrum(self, q: Real) -> Real:
        """Return zeros."""
        return np.zeros_like(q)

    def kernel(self, first: int, spacing: tuple[float, float], rows: Real) -> None:
        """Fill rows with zeros."""
        rows[:] = 0.0

    def shear_spectrum(self, q: Real) -> tuple[Real, Real]:
        """Return zeros."""
        return np.zeros_like(q), np.zeros_like(q)

    def shear_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real, Real]
    ) -> None:
        """Fill rows with zeros."""
        for each in rows:
            each[:] = 0.0

    def in_units(self, pressure: float, length: float) -> Rigid:
        """Return itself."""
        return self


@dataclass(frozen=True, repr=False)
class _Interface(HalfSpace):
    """A half-space that is repeated, and displaced from its mean."""

    half_space: HalfSpace

    def __repr__(self) -> str:
        """Return what makes it, in Python."""
        return f"({self.half_space!r}).interface"

    @property
    def E_star(self) -> float:  # type: ignore[override]
        """Contact modulus of the surface. [pressure]"""
        return self.half_space.E_star

    @property
    def periodic(self) -> bool:  # type: ignore[override]
        """Pressures repeat themselves beyond the grid."""
        return True

    @property
    def interface(self) -> HalfSpace:
        """Itself."""
        return self

    @property
    def softest(self) -> float:
        """Contact modulus of the softest material. [pressure]"""
        return self.half_space.softest

    def strain(self, pressure: float, side: float) -> float:
        """Return about how far pressure strains the whole. [1]"""
        return self.half_space.strain(pressure, side)

    def spectrum(self, q: Real) -> Real:
        """Return the displacement over the pressure of waves; without a bound for even pressure."""
        return np.where(q == 0, np.inf, self.half_space.spectrum(q))

    def refuse(self, spacing: tuple[float, float]) -> None:
        """Refuse grids that do not resolve the whole."""
        self.half_space.refuse(spacing)

    def in_units(self, pressure: float, length: float) -> _Interface:
        """Return the same half-space in other units."""
        return _Interface(self.half_space.in_units(pressure, length))

    def disc_stiffness(self, radius: float) -> float:
        """Return the force per approach of a rigid disc on the whole."""
        return self.half_space.disc_stiffness(radius)


@dataclass(frozen=True)
class _EvenShear(HalfSpace):
    """A half-space that pressure displaces as shear displaces another, whatever its direction."""

    half_space: HalfSpace

    @property
    def E_star(self) -> float:  # type: ignore[override]
        """Modulus of short waves. [pressure]"""
        short = np.array([1e9])
        return 2 / float(short[0] * self.spectrum(short)[0])

    @property
    def periodic(self) -> Periodic:  # type: ignore[override]
        """Whether shear repeats itself beyond the grid."""
        return self.half_space.periodic

    def spectrum(self, q: Real) -> Real:
        """Return the mean displacement over the shear of waves, along and across."""
        along, across = self.half_space.shear_spectrum(q)
        return (along + across) / 2

    def kernel(self, first: int, spacing: tuple[float, float], rows: Real) -> None:
        """Fill rows of the table of the mean of both displacements."""
        along, across = np.empty_like(rows), np.empty_like(rows)
        self.half_space.shear_kernel(first, spacing, (rows, across, along))
        rows += across
        rows /= 2

    def in_units(self, pressure: float, length: float) -> _EvenShear:
        """Return the same half-space in other units."""
        return _EvenShear(self.half_space.in_units(pressure, length))
