"""What is asked of a fluid in the gap: which one, between which pressures, through which seal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from roughline.engineering.fluids import Gas, Liquid
from roughline.engineering.seal import SealShape
from roughline.fluid.flow import Along
from roughline.fluid.reopening import Reopening
from roughline.fluid.sealing_pressure import SealingPressure

ATMOSPHERE = 101325.0
"""Pressure outside, where no other is given. [Pa]"""


@dataclass(frozen=True)
class Sealing:
    """A fluid in the gap, the pressures on both sides of it, and the seal that it crosses."""

    fluid: Liquid | Gas
    inlet: float | None = None  # absolute [Pa]
    outlet: float = ATMOSPHERE  # absolute [Pa]
    seal: SealShape | None = None
    along: Along | Literal["both"] = "both"  # over the map

    @property
    def directions(self) -> Sequence[Along]:
        """Directions over the map in which the fluid flows."""
        return ("x", "y") if self.along == "both" else (self.along,)

    @property
    def gas(self) -> Gas | None:
        """The fluid, if it is a gas."""
        return self.fluid if isinstance(self.fluid, Gas) else None

    @property
    def conducts(self) -> bool:
        """Whether heat goes through the gas as well, and its conductivity is known."""
        gas = self.gas
        return gas is not None and gas.conductivity is not None and self.mean_pressure > 0

    @property
    def mean_pressure(self) -> float:
        """Mean of both pressures, or that of the outlet alone. [Pa]"""
        return self.outlet if self.inlet is None else (self.inlet + self.outlet) / 2

    @property
    def free_path(self) -> float:
        """Mean free path of the gas at the mean pressure; zero of a liquid, and in vacuum. [m]"""
        if self.gas is None or not self.mean_pressure > 0:
            return 0.0
        return self.gas.mean_free_path(self.mean_pressure)


@dataclass(frozen=True, eq=False)
class Closing:
    """At which mean pressure the last channel closes, and how far the load may be taken off."""

    pressure: SealingPressure
    reopening: Reopening | None = None  # from the largest load; None where that was not solved
