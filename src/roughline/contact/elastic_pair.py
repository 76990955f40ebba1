"""Two elastic bodies that face each other, and the half-space that they are pressed as."""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.contact.arguments import given_half_space
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic, Repeated
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.elasticity.layered import Layered

_FAR = 1e3  # side over thickness, from which on pressure is even for layers


@dataclass(frozen=True)
class ElasticBody:
    """One body: of one material, or of layers that are bonded to a base.

    Attributes
    ----------
    young, poisson : tuple of float
        Of each material, from the surface on; the last is that of the base. [pressure], [1]
    thickness : tuple of float
        Of each layer, from the surface on; empty for a body of one material. [length]
    """

    young: tuple[float, ...]
    poisson: tuple[float, ...]
    thickness: tuple[float, ...] = ()

    @property
    def moduli(self) -> tuple[float, ...]:
        """E / (1 - nu²) of each material; infinite of a rigid one. [pressure]"""
        pairs = zip(self.young, self.poisson, strict=True)
        return tuple(young / (1 - poisson**2) for young, poisson in pairs)

    @property
    def half_space(self) -> HalfSpace:
        """What the body is, free; a rigid one is none."""
        if not self.thickness:
            return Homogeneous(self.moduli[0])
        *layers, base = zip(self.young, self.poisson, strict=True)
        young, poisson = zip(*layers, strict=True)
        return Layered(young, poisson, self.thickness, *base)

    @property
    def layers_compliance(self) -> float:
        """How far even pressure compresses the layers, which cannot widen. [length / pressure]

        The sum of their thicknesses over M = E (1 - nu) / ((1 + nu) (1 - 2 nu)).
        """
        layers = zip(self.young, self.poisson, self.thickness, strict=False)  # without the base
        return sum(h * (1 + nu) * (1 - 2 * nu) / (E * (1 - nu)) for E, nu, h in layers)

    def softness(self, side: float) -> float:
        """Strain over the pressure on a place of some side, of the base or of its layers together.

        Layers are strained by what they add to the displacement of the base, over their thickness,
        or down to where the pressure reaches. [1 / pressure]
        """
        of_base = 1 / self.moduli[-1]
        if not self.thickness:
            return of_base
        thickness = sum(self.thickness)
        side = min(side, _FAR * thickness)
        added = float(self.half_space.spectrum(np.array([1 / side]))[0]) - 2 * side * of_base
        return max(of_base, added / min(thickness, 2 * side))


@dataclass(frozen=True)
class ElasticPair:
    """Two bodies, before it is said whether they are repeated.

    Attributes
    ----------
    E_star : float
        Contact modulus of what lies at both surfaces. [pressure]
    bodies : sequence of ElasticBody
        Both, if one of them has layers; none where the contact modulus says all.
    """

    E_star: float
    bodies: Sequence[ElasticBody] = ()

    @property
    def is_layered(self) -> bool:
        """Whether one of the bodies has layers."""
        return bool(self.bodies)

    @property
    def softest(self) -> float:
        """Contact modulus of the softest materials of both. [pressure]"""
        if not self.is_layered:
            return self.E_star
        return 1 / sum(1 / min(each.moduli) for each in self.bodies)

    @property
    def layers_compliance(self) -> float:
        """How far even pressure compresses the layers of both. [length / pressure]"""
        return sum(each.layers_compliance for each in self.bodies)

    def strain(self, pressure: float, side: float) -> float:
        """About how far pressure on a place of some side strains both; infinite: everywhere. [1]"""
        if not self.is_layered:
            return pressure / self.E_star
        return pressure * sum(each.softness(side) for each in self.bodies)

    def half_space(self, *, periodic: Periodic) -> HalfSpace:
        """What both are pressed as; repeated ones are displaced from their mean.

        Bodies with layers are free, or repeated along both axes.

        Raises
        ------
        InputError
            If the contact modulus is beyond all measure.
        """
        if not self.is_layered:
            return given_half_space(None, self.E_star, periodic)
        elastic = [each.half_space for each in self.bodies if min(each.moduli) < math.inf]
        free = functools.reduce(operator.add, elastic)
        return Repeated(free) if periodic else free

    def on_rigid_base(self, *, periodic: bool) -> HalfSpace:
        """What layers on a rigid base are pressed as, the other body being rigid as well.

        Even pressure displaces them, repeated ones too.
        """
        body = next(each for each in self.bodies if min(each.moduli) < math.inf)
        layered = body.half_space
        assert isinstance(layered, Layered)
        return replace(layered, periodic=periodic)
