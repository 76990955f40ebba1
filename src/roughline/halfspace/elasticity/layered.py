"""The half-space of bonded layers on an elastic or rigid base."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.checks import between, positive, several
from roughline.errors.public import public_making
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic, given_periodic
from roughline.halfspace.elasticity.homogeneous import Homogeneous

_THINNEST_TOP_LAYER = 0.5  # thickness of the top layer over the side of a cell, at least
_EVEN_PRESSURE_FROM = 1e3  # side over thickness, from which on pressure is even for layers


@public_making
@dataclass(frozen=True)
class Layered(HalfSpace):
    """Elastic layers, bonded to each other and to a base that is elastic or rigid.

    Waves are displaced as the layers together let them [1]_ [2]_: short ones feel the top layer
    alone, and long ones the base. The contact modulus of the top layer is the unit of pressures,
    `force_bar` and `stiffness_bar`. A free half-space has the kernel of the top layer and a smooth
    rest, whose transform falls as fast as exp(-2 q thickness).

    Parameters
    ----------
    young : float or sequence of float
        Young's modulus of each layer, from the top on. [pressure]
    poisson : float or sequence of float
        Poisson's ratio of each layer.
    thickness : float or sequence of float
        Thickness of each layer. [length]
    base_young : float
        Young's modulus of the base; ``math.inf`` makes it rigid. [pressure]
    base_poisson : float, optional
        Poisson's ratio of the base; a rigid one needs none.
    periodic : bool, "x" or "y", optional
        Whether pressures repeat themselves beyond the grid: along both axes, none, or the one that
        is named. Where they do not, the surface is free. On a rigid base, a periodic body is
        displaced by even pressure, and depths hold that; its :attr:`~roughline.HalfSpace.interface`
        is not. Along one axis only, depths on an elastic
        base count from a place as far away across as the surface is wide, and as layers harder than
        their base spread a load: the sum of thickness times E* over that of the base less one. On a
        rigid base they count from the base.

    Raises
    ------
    InputError
        If a modulus or thickness is not positive and finite, a Poisson's ratio is not from 0 to
        0.5, the layers have not as many of each, or `periodic` is something else.

    References
    ----------
    .. [1] T. Nogi and T. Kato, "Influence of a hard surface layer on the limit of elastic contact,
       part I", J. Tribol. 119, 493-500 (1997), for one layer.
    .. [2] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §5.8.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> rubber = rl.Layered(1.0, 0.49, thickness=0.1, base_young=1e3, base_poisson=0.3)
    >>> curve = rl.press(surface, half_space=rubber, depths=[0.02])
    >>> print(curve.force.round(4), curve.area_fraction.round(3))
    [0.0264] [0.107]
    """

    young: float | Sequence[float]
    poisson: float | Sequence[float]
    thickness: float | Sequence[float]
    base_young: float
    base_poisson: float = 0.0
    periodic: Periodic = False

    def __post_init__(self) -> None:
        for name, checked in (("young", positive), ("poisson", _ratio), ("thickness", positive)):
            given = getattr(self, name)
            each = tuple(checked(name, one) for one in several(given) or [given])
            object.__setattr__(self, name, each)
        counts = [len(several(getattr(self, name))) for name in ("young", "poisson", "thickness")]
        if len(set(counts)) > 1:
            raise InputError(
                f"layers have {counts[0]} of young, {counts[1]} of poisson and {counts[2]} of "
                "thickness; as many of each are needed, from the top on"
            )
        if self.base_young != math.inf:
            needed = "a positive, finite number is needed, or math.inf for a rigid base"
            positive("base_young", self.base_young, needed)
        _ratio("base_poisson", self.base_poisson)
        given_periodic("periodic", self.periodic)
        if all(self.repeats) and math.isinf(self.base_young) and self._layers[1].min() == 0.5:
            raise InputError(
                "a periodic layer of poisson 0.5 on a rigid base locks: even pressure displaces "
                "nothing, so that no depth tells it; give poisson=0.499, or periodic=False, of "
                "which .interface is what the waves of pressure displace"
            )

    @property
    def E_star(self) -> float:  # type: ignore[override]
        """Contact modulus of the top layer, E / (1 - nu²). [pressure]"""
        return self._layers[0, 0] / (1 - self._layers[1, 0] ** 2)

    @property
    def spread(self) -> float:  # type: ignore[override]
        """How far hard layers spread a load: that stretches them along a softer base. [length]"""
        young, poisson, thickness = self._layers
        of_base = self.base_young / (1 - self.base_poisson**2)
        harder = np.maximum(young / (1 - poisson**2) / of_base - 1, 0.0)
        return float(thickness @ harder)

    @property
    def softest(self) -> float:
        """Contact modulus of the softest of layers and base. [pressure]"""
        moduli = [young / (1 - poisson**2) for young, poisson in self._materials]
        return 1 / max(1 / each for each in moduli)

    def strain(self, pressure: float, side: float) -> float:
        """Return about how far pressure strains the base, or its layers together. [1]

        Layers are strained by what they add to the displacement of the base, over their thickness,
        or down to where the pressure reaches.
        """
        base_young, base_poisson = self._materials[-1]
        of_base = 1 / (base_young / (1 - base_poisson**2))
        thickness = sum(several(self.thickness))
        side = min(side, _EVEN_PRESSURE_FROM * thickness)
        added = float(self.spectrum(np.array([1 / side]))[0]) - 2 * side * of_base
        return pressure * max(of_base, added / min(thickness, 2 * side))

    @property
    def _materials(self) -> list[tuple[float, float]]:
        """Young's modulus and Poisson's ratio of each layer, and of the base."""
        layers = zip(several(self.young), several(self.poisson), strict=True)
        return [*layers, (self.base_young, self.base_poisson)]

    @cached_property
    def _layers(self) -> Real:
        return np.array([self.young, self.poisson, self.thickness], dtype=float)

    def spectrum(self, q: Real) -> Real:
        """Return the displacement over the pressure of waves, by the layers from the base on."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.layers import compliance

        return compliance(q, self._layers, float(self.base_young), self.base_poisson)

    def _shear_compliance(self, q: Real) -> tuple[Real, Real, Real]:
        """Return the displacements along the surface by shear along and across, and by pressure."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.layers import shear_compliance

        return shear_compliance(q, self._layers, float(self.base_young), self.base_poisson)

    def shear_spectrum(self, q: Real) -> tuple[Real, Real]:
        """Return the displacements over the shear of waves, along and across their direction."""
        return self._shear_compliance(q)[:2]

    def coupling_spectrum(self, q: Real) -> Real:
        """Return how pressure displaces along the surface, over the pressure of waves."""
        return self._shear_compliance(q)[2]

    @property
    def is_coupled(self) -> bool:
        """Whether pressure displaces along the surface, as it does beside a rigid body."""
        return True

    @property
    def _top(self) -> Homogeneous:
        """The half-space of the top layer's material, beside a rigid body."""
        return Homogeneous.of(float(self._layers[0, 0]), float(self._layers[1, 0]))

    @property
    def _lengths(self) -> tuple[float, float]:
        """Thickness of the top layer, and how far kernels change. [length]"""
        young, _, thickness = self._layers
        moduli = [each for each in (*young, self.base_young) if each < math.inf]
        longest = thickness.sum() * (max(moduli) / min(moduli)) ** (1 / 3)  # of plates on springs
        return float(thickness[0]), float(longest)

    def kernel(self, first: int, spacing: tuple[float, float], rows: Real) -> None:
        """Fill rows of the table of displacements under unit pressure on one cell."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.layered_kernel import layered_kernel

        layered_kernel(self, self._lengths, first, spacing, rows)

    def shear_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real, Real]
    ) -> None:
        """Fill rows of the tables of displacements under unit shear on one cell."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.layered_kernel import layered_shear_kernel

        layered_shear_kernel(self, self._top, self._lengths, first, spacing, rows)

    def coupling_kernel(
        self, first: int, spacing: tuple[float, float], rows: tuple[Real, Real]
    ) -> None:
        """Fill rows of the tables of displacements along the surface under pressure on one cell."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.layered_kernel import layered_coupling_kernel

        layered_coupling_kernel(self, self._top, self._lengths, first, spacing, rows)

    def refuse(self, spacing: tuple[float, float]) -> None:
        """Refuse grids of cells more than twice as large as the top layer is thick."""
        thickness, cell = float(self._layers[2, 0]), max(spacing)
        if thickness < _THINNEST_TOP_LAYER * cell:
            raise InputError(
                f"is {thickness:.3g} for the top layer, less than half a cell of {cell:.3g}: leave "
                "that layer out, as its base alone is felt on such a grid, or press on a finer one",
                "thickness",
            )

    def in_units(self, pressure: float, length: float) -> Layered:
        """Return the same half-space in other units."""
        young, _, thickness = self._layers
        return replace(
            self,
            young=tuple(young / pressure),
            thickness=tuple(thickness / length),
            base_young=self.base_young / pressure,
        )


def _ratio(name: str, given: Any) -> float:
    """Return a Poisson's ratio."""
    return between(name, given, 0.0, 0.5, "a number from 0 to 0.5 is needed")
