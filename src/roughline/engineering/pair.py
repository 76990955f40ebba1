"""Two materials in contact: moduli and properties of the pair."""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Iterable
from dataclasses import dataclass
from operator import itemgetter

from roughline.contact.arguments import given_half_space
from roughline.contact.conduction import Resistances
from roughline.engineering.coated import Coated, Solid
from roughline.engineering.material import Material
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic, Rigid
from roughline.halfspace.elasticity.homogeneous import Homogeneous


@dataclass(frozen=True, eq=False)
class MaterialPair:
    """Two bodies of given materials in contact, in any order; each may be coated."""

    first: Solid
    second: Solid

    @property
    def E_star(self) -> float:
        """Contact modulus of what lies at both surfaces. [Pa]"""
        return contact_modulus(self.first.surface, self.second.surface)

    @property
    def base_modulus(self) -> float:
        """Contact modulus of both without their layers; infinite of rigid bases. [Pa]"""
        compliance = sum(
            (1 - each.nu**2) / each.E
            for each in (self.first.materials[-1], self.second.materials[-1])
        )
        return 1 / compliance if compliance else math.inf

    def half_space(self, *, periodic: Periodic = False) -> HalfSpace:
        """Return what both are pressed as: one that holds the contact modulus, or their sum.

        Raises
        ------
        InputError
            If the contact modulus is beyond all measure.
        """
        if not self.coated:
            return given_half_space(None, self.E_star, periodic)
        elastic = [each for each in (self.first, self.second) if not math.isinf(each.surface.E)]
        bodies = [each.half_space(periodic=periodic) for each in elastic]
        return functools.reduce(operator.add, bodies)

    def sheared_half_space(self, *, periodic: Periodic = False) -> HalfSpace:
        """Return what both are pressed and sheared as: the first body slides over the second.

        Of bodies of one material each it is one half-space, with E*, a Poisson's ratio nu of both
        by nu / (1 - nu) = n = (E* / 2) (nu1 / G1 + nu2 / G2), and beta.
        """
        if not self.coated:
            surfaces = (self.first.surface, self.second.surface)
            n = self.E_star / 2 * sum(each.nu / each.shear_modulus for each in surfaces)
            return Homogeneous(self.E_star, periodic, n / (1 + n), self.beta)
        second, first = _sheared(self.second, periodic), _sheared(self.first, periodic)
        return second if isinstance(first, Rigid) else second + first

    @property
    def beta(self) -> float:
        """Dundurs' second parameter of what lies at both surfaces, seen from the second body.

        beta = (E* / 4) ((1 - 2 nu2) / G2 - (1 - 2 nu1) / G1). [1]

        References
        ----------
        K. L. Johnson, "Contact Mechanics" (1985), eq. 5.3.
        """
        first, second = (
            (1 - 2 * each.surface.nu) / (4 * each.surface.shear_modulus)
            for each in (self.first, self.second)
        )
        return self.E_star * (second - first)

    @property
    def layers_compliance(self) -> float:
        """How far even pressure compresses the layers of both. [m / Pa]"""
        return sum(each.layers_compliance for each in self.coated)

    @property
    def coated(self) -> list[Coated]:
        """The bodies that are coated."""
        return [each for each in (self.first, self.second) if isinstance(each, Coated)]

    @property
    def G_star(self) -> float:
        """Tangential contact modulus, 1 / G* = (2 - nu1) / (4 G1) + (2 - nu2) / (4 G2). [Pa]

        It is that of what lies at both surfaces, as E* is.

        The tangential stiffness of any contact without slip is G* / E* times the normal one where
        the two problems are uncoupled; for equal materials that is (2 - 2 nu) / (2 - nu).

        References
        ----------
        V. L. Popov, "Contact Mechanics and Friction", 2nd ed. (2017), eq. 8.8.
        """
        return _inverse_sum(
            (2 - each.surface.nu) / (4 * each.surface.shear_modulus)
            for each in (self.first, self.second)
        )

    @property
    def hardness(self) -> float | None:
        """Hardness of the softer body, of those that are known; None if none is. [Pa]

        That of a coated body is its top layer's. A rigid body never yields. A body whose modulus is
        below the hardness of the other is the softer one, be its hardness known or not: it is
        elastic, as rubber is, if it is not.
        """
        softer = self.softer
        return None if softer is None else softer.surface.hardness

    @property
    def hardness_factor(self) -> float:
        """Factor by which that hardness is uncertain. [1]"""
        return 1.0 if self.softer is None else self.softer.surface.hardness_factor

    @property
    def softer(self) -> Solid | None:
        """The body of lower hardness, among those that can yield; None if that is not known."""
        yielding = [each for each in (self.first, self.second) if not math.isinf(each.surface.E)]
        known = [(h, each) for each in yielding if (h := each.surface.hardness) is not None]
        if not known:
            return None
        hardness, softer = min(known, key=itemgetter(0))
        unknown = [each.surface for each in yielding if each.surface.hardness is None]
        return None if any(hardness > each.E for each in unknown) else softer

    @property
    def bearer(self) -> str:
        """Which body has that hardness, in words."""
        named = [name for name, each in self._by_name if each is self.softer]
        return named[0] if named and self.lacking("hardness") else "the softer body"

    def with_hardness(self, hardness: float) -> MaterialPair:
        """Return the pair with another hardness of the softer body, known exactly. [Pa]

        It need not be known which of the two is softer; a rigid body never is.
        """
        return MaterialPair(self.first.with_hardness(hardness), self.second.with_hardness(hardness))

    def lacking(self, quantity: str) -> list[str]:
        """Name the bodies for which a property is not known, and which of their layers.

        The hardness is that of the surface; a rigid body needs none.
        """
        found = []
        for name, body in self._by_name:
            of_hardness = quantity == "hardness"
            unknown = [
                each.name
                for each in ([body.surface] if of_hardness else body.materials)
                if getattr(each, quantity) is None and not (of_hardness and math.isinf(each.E))
            ]
            if unknown:
                is_layer = isinstance(body, Coated) and not of_hardness
                which = " and ".join(dict.fromkeys(unknown))
                found.append(f"{which} in {name}" if is_layer else name)
        return found

    @property
    def _by_name(self) -> list[tuple[str, Solid]]:
        """Both bodies, and what they are called."""
        bodies = (("first", self.first), ("second", self.second))
        return [(f"the {which} body ({each.name})", each) for which, each in bodies]

    def lacks(self, quantity: str, what: str) -> Fact | None:
        """Say that there is no answer, as a property is not known; None where it is."""
        bodies = tuple(self.lacking(quantity))
        if not bodies:
            return None
        return Fact("property_unknown", what=what, quantity=quantity, bodies=bodies)

    @property
    def facts(self) -> list[Fact]:
        """Of which body the hardness is not known, and of which layers the modulus is another."""
        found = []
        lacking, moduli = self.lacking("hardness"), (self.first.surface.E, self.second.surface.E)
        if lacking and self.hardness is not None:
            found.append(Fact("hardness_of_softer_taken", material=lacking[0]))
        elif lacking:
            is_softer = len(lacking) == 1 and not any(map(math.isinf, moduli))
            found.append(Fact("no_hardness", materials=tuple(lacking), is_softer=is_softer))
        for each in dict.fromkeys((*self.first.materials, *self.second.materials)):
            if of := each.layer_E:
                numbers = {"modulus": each.E, "of_layers": of}
                found.append(Fact("layer_modulus_differs", material=each.name, **numbers))
        return found

    def both(self, quantity: str) -> tuple[float, float] | None:
        """Return a property of both bodies; None if one does not have it, or is coated."""
        return None if self.coated else self.at_surfaces(quantity)

    def at_surfaces(self, quantity: str) -> tuple[float, float] | None:
        """Return a property of what lies at both surfaces; None unless it is known for both."""
        first, second = (getattr(each.surface, quantity) for each in (self.first, self.second))
        return None if first is None or second is None else (first, second)

    def resistances(self, quantity: str) -> Resistances | None:
        """Return what both bodies resist with, by their resistivities or conductivities.

        None unless these are known of all their layers. [ohm m] or [m K / W], and [m]
        """
        if self.lacking(quantity):
            return None
        power = -1 if quantity == "conductivity" else 1
        return tuple(
            (tuple(getattr(each, quantity) ** power for each in body.materials), body.thicknesses)
            for body in (self.first, self.second)
        )


@public
def contact_modulus(first: Material, second: Material) -> float:
    """Contact modulus, 1 / E* = (1 - nu1²) / E1 + (1 - nu2²) / E2. [Pa]

    Raises
    ------
    InputError
        If both materials are rigid.

    Examples
    --------
    >>> import roughline as rl
    >>> modulus = rl.contact_modulus(rl.material("steel"), rl.material("copper"))
    >>> print(f"{modulus / 1e9:.1f} GPa")
    89.9 GPa
    """
    return _inverse_sum((1 - each.nu**2) / each.E for each in (first, second))


def _sheared(body: Solid, periodic: Periodic) -> HalfSpace:
    """Return a body as it is pressed and sheared."""
    if isinstance(body, Coated):
        return body.half_space(periodic=periodic)
    rigid = math.isinf(body.E)
    return Rigid(periodic) if rigid else Homogeneous.of(body.E, body.nu, periodic=periodic)


def _inverse_sum(compliances: Iterable[float]) -> float:
    """Modulus of bodies whose compliances add up."""
    compliance = sum(compliances)
    if compliance == 0:
        raise InputError("both materials are rigid: one of them must give way", None, "materials")
    return 1 / compliance
