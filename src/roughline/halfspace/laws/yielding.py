"""Elastic, perfectly plastic bodies, which a largest pressure indents."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.errors.public import public_making
from roughline.halfspace.laws.law import ContactLaw


@public_making
@dataclass(frozen=True)
class Yielding(ContactLaw):
    """Elastic, perfectly plastic bodies: 0 <= p <= H, with permanent dents where p = H [1]_.

    Where p = 0 the gap is not negative, and where 0 < p < H it is zero. Where p = H the bodies
    overlap by what the load indents, and the surface is lower by that ever after. Below the largest
    load so far bodies are elastic: all nodes spring back, and on reloading the contact passes
    through the same states again.

    Attributes
    ----------
    hardness : float
        The most that a node bears, H. [pressure]

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
    assumption: ClassVar[str] = (
        "linear elastic up to the hardness of the softer one, where points bear no more and stay "
        "indented, without adhesion"
    )

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
        """Return zero and the hardness."""
        return 0.0, self.hardness

    def scaled(self, pressure: float, length: float) -> Yielding:
        """Return the law in other units."""
        return Yielding(self.hardness / pressure)
