"""Elastic, perfectly plastic bodies, which a largest pressure indents."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.errors.public import public_making
from roughline.halfspace.laws.law import ContactLaw, Solved

# A guess whose pressures exceed the hardness so many times leaves no doubt that nodes yield.
_BEYOND_DOUBT = 3.0


@public_making
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
    is_elastic : bool
        Whether bodies are tried without the hardness, until a node exceeds it.

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
    is_elastic: bool = False
    assumption: ClassVar[str] = (
        "linear elastic up to the hardness of the softer one, where points bear no more and stay "
        "indented, without adhesion"
    )
    memory: ClassVar[Literal["none", "dents", "path"]] = "dents"

    def __post_init__(self) -> None:
        if not 0 < self.hardness < math.inf:
            raise InputError(
                f"hardness is {self.hardness!r}; a positive, finite pressure is needed: bodies "
                "without a hardness are rl.Unilateral()"
            )

    @property
    def settings(self) -> dict[str, str | float]:
        """The hardness. [pressure]"""
        return {"hardness": self.hardness}

    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return zero and the hardness, which elastic bodies do not have."""
        return 0.0, math.inf if self.is_elastic else self.hardness

    def scaled(self, pressure: float, length: float) -> Yielding:
        """Return the law in other units."""
        return replace(self, hardness=self.hardness / pressure)

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

    def start(self, value: float, last: float | None, largest: float | None) -> Yielding:
        """Start as elastic bodies, unless they have yielded and meet a larger load than ever."""
        beyond = largest is None or value > largest
        return replace(self, is_elastic=not (beyond and self.has_yielded))

    def foreseen(self, nodes: Indices, pressure: Real) -> Yielding:
        """Yield at once where there is no doubt that nodes will."""
        return self._beyond(_BEYOND_DOUBT, pressure) or self

    def then(self, contact: Solved) -> Yielding | None:
        """Yield where a node of the elastic bodies exceeds the hardness."""
        return self._beyond(1.0, contact.pressure)

    def _beyond(self, times: float, pressure: Real) -> Yielding | None:
        """Return bodies that yield, where elastic ones would bear so many times the hardness."""
        beyond = self.is_elastic and np.any(pressure > times * self.hardness)
        return Yielding(self.hardness, has_yielded=True) if beyond else None
