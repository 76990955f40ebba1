"""Two materials in contact: moduli and properties of the pair."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from operator import itemgetter

from roughline.engineering.materials import Material
from roughline.errors import InputError
from roughline.errors.public import public


@dataclass(frozen=True, eq=False)
class MaterialPair:
    """Two bodies of given materials in contact, in any order."""

    first: Material
    second: Material

    @property
    def E_star(self) -> float:
        """Contact modulus. [Pa]"""
        return contact_modulus(self.first, self.second)

    @property
    def G_star(self) -> float:
        """Tangential contact modulus, 1 / G* = (2 - nu1) / (4 G1) + (2 - nu2) / (4 G2). [Pa]

        The tangential stiffness of any contact without slip is G* / E* times the normal one where
        the two problems are uncoupled; for equal materials that is (2 - 2 nu) / (2 - nu).

        References
        ----------
        V. L. Popov, "Contact Mechanics and Friction", 2nd ed. (2017), eq. 8.8.
        """
        return _inverse_sum(
            (2 - each.nu) / (4 * each.shear_modulus) for each in (self.first, self.second)
        )

    @property
    def hardness(self) -> float | None:
        """Hardness of the softer body, of those that are known; None if none is. [Pa]

        A rigid body never yields. A body whose modulus is below the hardness of the other is the
        softer one, be its hardness known or not: it is elastic, as rubber is, if it is not.
        """
        softer = self._softer
        return None if softer is None else softer.hardness

    @property
    def hardness_factor(self) -> float:
        """Factor by which that hardness is uncertain. [1]"""
        return 1.0 if self._softer is None else self._softer.hardness_factor

    @property
    def _softer(self) -> Material | None:
        """The body of lower hardness, among those that can yield."""
        yielding = [each for each in (self.first, self.second) if not math.isinf(each.E)]
        known = [(each.hardness, each) for each in yielding if each.hardness is not None]
        if not known:
            return None
        hardness, softer = min(known, key=itemgetter(0))
        unknown = [each for each in yielding if each.hardness is None]
        return None if any(hardness > each.E for each in unknown) else softer

    @property
    def bearer(self) -> str:
        """Which body has that hardness, in words."""
        named = [name for name, each in self._by_name if each is self._softer]
        return named[0] if named and self.lacking("hardness") else "the softer body"

    def with_hardness(self, hardness: float) -> MaterialPair:
        """Return the pair with another hardness of the softer body, known exactly. [Pa]

        It need not be known which of the two is softer; a rigid body never is.
        """

        def given(each: Material) -> Material:
            if math.isinf(each.E):
                return each
            source = f"{each.source}; hardness given"
            return replace(each, hardness=hardness, hardness_factor=1.0, source=source)

        return MaterialPair(given(self.first), given(self.second))

    def lacking(self, quantity: str) -> list[str]:
        """Name the bodies for which a property is not known; a rigid one needs no hardness."""
        return [
            name
            for name, each in self._by_name
            if getattr(each, quantity) is None
            and not (quantity == "hardness" and math.isinf(each.E))
        ]

    @property
    def _by_name(self) -> list[tuple[str, Material]]:
        """Both bodies, and what they are called."""
        bodies = (("first", self.first), ("second", self.second))
        return [(f"the {which} body ({each.name})", each) for which, each in bodies]

    def lacks(self, quantity: str, what: str) -> str:
        """Say that there is no answer, as a property is not known; nothing where it is."""
        lacking = self.lacking(quantity)
        if not lacking:
            return ""
        return (
            f"no {what}: the {quantity} of {' and of '.join(lacking)} is not known; give it with "
            f'the material, as "{quantity}=..."'
        )

    def both(self, quantity: str) -> tuple[float, float] | None:
        """Return a property of both bodies; None unless it is known for both."""
        first, second = getattr(self.first, quantity), getattr(self.second, quantity)
        return None if first is None or second is None else (first, second)


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


def _inverse_sum(compliances: Iterable[float]) -> float:
    """Modulus of bodies whose compliances add up."""
    compliance = sum(compliances)
    if compliance == 0:
        raise InputError("both materials are rigid: one of them must give way")
    return 1 / compliance
