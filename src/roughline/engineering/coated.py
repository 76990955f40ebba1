"""A coated body: layers of materials that are bonded to each other and to a base."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from roughline.engineering.material import Material
from roughline.errors import InputError
from roughline.errors.checks import as_number, several, shown
from roughline.errors.earlier import refuse_part
from roughline.errors.public import public
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic
from roughline.halfspace.elasticity.layered import Layered
from roughline.units import engineering

_LAYER = 'a layer is a Material and its thickness in m, such as (rl.material("gold"), 0.5e-6)'


@public
@dataclass(frozen=True)
class Coated:
    """A body of layers on a base, such as rubber on steel, or gold on nickel on copper.

    Parameters
    ----------
    layers : sequence of (Material, float)
        The material of each layer and its thickness [m], from the surface on.
    base : Material
        What the layers lie on, as deep as one wishes; it may be rigid.

    Raises
    ------
    InputError
        If there is no layer, one is rigid, a thickness is not positive and finite, or a Poisson's
        ratio is negative.

    Examples
    --------
    >>> import roughline as rl
    >>> contact = rl.material("gold 0.5 um on nickel 2 um on copper")
    >>> print(contact.name)
    gold 500 nm on nickel 2 µm on copper
    >>> same = rl.Coated(
    ...     [(rl.material("gold"), 0.5e-6), (rl.material("nickel"), 2e-6)], rl.material("copper")
    ... )
    >>> same == contact
    True
    """

    layers: Sequence[tuple[Material, float]]
    base: Material

    def __post_init__(self) -> None:
        given = several(self.layers)
        if not given:
            raise InputError(f"is {shown(self.layers)}; at least one is needed: {_LAYER}", "layers")
        object.__setattr__(self, "layers", tuple(map(_layer, given)))
        for each, thickness in self.layers:
            if math.isinf(each.E):
                raise InputError(
                    "a rigid layer hides what lies below it: give a rigid body without layers"
                )
            if not 0 < thickness < math.inf:
                raise InputError(
                    f"the layer of {each.name} is {engineering(thickness, 'm')} thick; a positive, "
                    "finite thickness is needed"
                )
        for each in (*(each for each, _ in self.layers), self.base):
            if each.nu < 0:
                raise InputError(
                    f"nu of {each.name} is {each.nu}; of layers and their base 0 to 0.5 is allowed"
                )

    if not TYPE_CHECKING:  # checkers know what there is

        def __getattr__(self, name):
            refuse_part("material", name, type(self).__name__)

    @property
    def name(self) -> str:
        """Its layers and their thicknesses, and the base."""
        layers = [f"{each.name} {engineering(h, 'm')}" for each, h in self.layers]
        return " on ".join([*layers, self.base.name])

    @property
    def surface(self) -> Material:
        """What lies at the surface: the material of the top layer."""
        return self.layers[0][0]

    @property
    def materials(self) -> tuple[Material, ...]:
        """Materials of the layers, from the surface on, and of the base."""
        return (*(each for each, _ in self.layers), self.base)

    @property
    def thicknesses(self) -> tuple[float, ...]:
        """Thickness of each layer, from the surface on. [m]"""
        return tuple(thickness for _, thickness in self.layers)

    def half_space(self, *, periodic: Periodic = False) -> HalfSpace:
        """Return the body, pressed by a rigid one."""
        return Layered(
            young=[each.E for each, _ in self.layers],
            poisson=[each.nu for each, _ in self.layers],
            thickness=self.thicknesses,
            base_young=self.base.E,
            base_poisson=self.base.nu,
            periodic=periodic,
        )

    @property
    def layers_compliance(self) -> float:
        """How far even pressure compresses the layers, which cannot widen. [m / Pa]

        The sum of their thicknesses over M = E (1 - nu) / ((1 + nu) (1 - 2 nu)).
        """
        return sum(
            h * (1 + each.nu) * (1 - 2 * each.nu) / (each.E * (1 - each.nu))
            for each, h in self.layers
        )

    def refuse_grid(self, spacing: tuple[float, float]) -> None:
        """Refuse cells of a grid [m] that do not resolve the layers."""
        try:
            self.half_space().refuse(spacing)
        except InputError:
            top, thickness = self.layers[0]
            raise InputError(
                f"have a layer of {top.name}, {engineering(thickness, 'm')}, thinner than half "
                f"a cell of {engineering(max(spacing), 'm')}: leave it out, as what lies below is "
                "felt alone on such a grid, or press on a finer one",
                "materials",
            ) from None

    def with_hardness(self, hardness: float) -> Coated:
        """Return the same with a hardness of the top layer that is known exactly. [Pa]"""
        (top, thickness), *others = self.layers
        return replace(self, layers=((top.with_hardness(hardness), thickness), *others))


Solid = Material | Coated
"""What a body is made of."""


def _layer(given: object) -> tuple[Material, float]:
    """A material and a thickness."""
    if isinstance(given, tuple | list) and len(given) == 2 and isinstance(given[0], Material):
        thickness = as_number(given[1])
        if thickness is not None:
            return given[0], thickness
    raise InputError(f"layers holds {shown(given)}; {_LAYER}")
