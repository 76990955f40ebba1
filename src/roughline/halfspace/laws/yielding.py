"""Elastic, perfectly plastic bodies, which a largest pressure indents."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.halfspace.laws.law import ContactLaw, Solved

# A guess whose pressures exceed the hardness so many times leaves no doubt that nodes yield.
_BEYOND_DOUBT = 3.0
_SAME_FORCE = 1e-13  # forces that differ by no more than this part count as one


@dataclass(frozen=True)
class Yielding(ContactLaw):
    """Elastic, perfectly plastic bodies: 0 <= p <= H, with permanent dents where p = H [1]_.

    Where p = 0 the gap is not negative, and where 0 < p < H it is zero. Where p = H the bodies
    overlap by what the load indents, and the surface is lower by that ever after. Bodies are tried
    as elastic until a node exceeds the hardness, and they are elastic below the largest load so
    far: all nodes spring back, and on reloading the contact passes through the same states again.

    Attributes
    ----------
    hardness : float
        The most that a node bears, H. [pressure]
    has_yielded : bool
        Whether a load before has indented the surface.

    Raises
    ------
    InputError
        If the hardness is not positive and finite.

    References
    ----------
    .. [1] A. Almqvist, F. Sahlin, R. Larsson and S. Glavatskih, "On the dry elasto-plastic contact
       of nominally flat surfaces", Tribol. Int. 40, 574-579 (2007).
    """

    hardness: float
    has_yielded: bool = False
    memory: ClassVar[Literal["none", "dents", "path"]] = "dents"

    def __post_init__(self) -> None:
        if not 0 < self.hardness < math.inf:
            raise InputError(
                f"hardness is {self.hardness!r}; a positive, finite pressure is needed: bodies "
                "without a hardness are rl.Unilateral()"
            )

    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return zero and the hardness."""
        return 0.0, self.hardness

    def scaled(self, pressure: float, length: float) -> Yielding:
        """Return the law in other units."""
        return Yielding(self.hardness / pressure, self.has_yielded)

    def refuse(
        self, control: str, values: Real, heights: Real, area: float, mean_is_free: bool
    ) -> None:
        """Refuse pulls, and forces that all of the area cannot bear."""
        super().refuse(control, values, heights, area, mean_is_free)
        most, largest = self.largest_force(area), int(values.argmax())
        if control == "forces" and not values[largest] < most:
            raise InputError(
                f"forces[{largest}] is {values[largest]:g}; a body of hardness {self.hardness:g} "
                f"and nominal area {area:g} bears less than H A_0 = {most:g}: give smaller forces, "
                "or a larger hardness"
            )

    def start(self, value: float, last: float | None, largest: float | None) -> ContactLaw:
        """Start as elastic bodies, unless they have yielded and meet a larger load than ever."""
        beyond = largest is None or value > largest
        return self if beyond and self.has_yielded else _ElasticSoFar(self)

    def attainable(self, force: float, cell_area: float) -> float:
        """Return slightly less where nodes at the hardness alone would bear the force.

        With no elastic node among them the depth would be open.
        """
        nodes = force / (self.hardness * cell_area)
        whole = round(nodes)
        same = bool(whole) and abs(nodes - whole) <= _SAME_FORCE * whole
        return force * (1 - 2 * _SAME_FORCE) if same else force

    def for_steeper(self, times: float) -> Yielding:
        """Return bodies so many times softer: contact depends on H / (E* slope)."""
        return Yielding(self.hardness / times)


@dataclass(frozen=True)
class _ElasticSoFar(ContactLaw):
    """Bodies that yield, as long as no node exceeds the hardness."""

    yielding: Yielding
    memory: ClassVar[Literal["none", "dents", "path"]] = "dents"

    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return that pressures only push."""
        return 0.0, math.inf

    def scaled(self, pressure: float, length: float) -> _ElasticSoFar:
        """Return the law in other units."""
        return _ElasticSoFar(self.yielding.scaled(pressure, length))

    def start(self, value: float, last: float | None, largest: float | None) -> ContactLaw:
        """Start as the bodies that yield do."""
        return self.yielding.start(value, last, largest)

    def foreseen(self, nodes: Indices, pressure: Real) -> ContactLaw:
        """Yield at once where there is no doubt that nodes will."""
        doubtless = np.any(pressure > _BEYOND_DOUBT * self.yielding.hardness)
        return self.bounded() if doubtless else self

    def then(self, contact: Solved) -> ContactLaw | None:
        """Yield where a node exceeds the hardness."""
        return self.bounded() if np.any(contact.pressure > self.yielding.hardness) else None

    def bounded(self) -> ContactLaw:
        """The bodies that yield."""
        return Yielding(self.yielding.hardness, has_yielded=True)
