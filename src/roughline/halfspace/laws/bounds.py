"""The bounds of the pressures of some nodes, and what they make of pressures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Indices, InGrid, Mask, Real
from roughline.halfspace.laws.law import ContactLaw


@dataclass(frozen=True, eq=False)
class Bounds:
    """Least and largest pressures of some nodes, numbers or arrays over them.

    A node at a bound bears exactly that. One without pressure, whose lower bound is zero, counts
    as between its bounds as long as it is listed as one in contact.
    """

    low: Real | float
    high: Real | float

    @classmethod
    def of(cls, law: ContactLaw, nodes: InGrid | None = None) -> Bounds:
        """Ask a law for the bounds of nodes of the grid, or of all of it."""
        return cls(*law.bounds(nodes))

    @property
    def largest_pull(self) -> float:
        """Largest tension that a node bears. [pressure]"""
        return -float(np.min(self.low))

    def largest_force(self, area: float) -> float:
        """Return the force under which the mean pressure on an area is the upper bound. [force]"""
        mean = self.high.mean() if isinstance(self.high, np.ndarray) else self.high
        return float(mean) * area

    def at(self, places: Indices | Mask) -> Bounds:
        """Return the bounds of some of the nodes, by ascending places or a mask."""
        if (
            places.dtype != bool
            and isinstance(self.low, np.ndarray)
            and places.size == self.low.size
        ):
            return self  # of all of them
        low = self.low[places] if isinstance(self.low, np.ndarray) else self.low
        high = self.high[places] if isinstance(self.high, np.ndarray) else self.high
        return Bounds(low, high)

    @cached_property
    def pulled(self) -> Indices:
        """The nodes that cannot be without pressure, as far as bounds differ from node to node."""
        return np.flatnonzero(self.low if isinstance(self.low, np.ndarray) else ())

    def pulling(self, pressure: Real) -> Mask:
        """Return which nodes are at a lower bound that is not zero."""
        return np.asarray((pressure == self.low) & (np.asarray(self.low) != 0))

    def yielding(self, pressure: Real) -> Mask:
        """Return which nodes are at the upper bound."""
        return np.asarray(pressure == self.high)

    def touching(self, pressure: Real) -> Mask:
        """Return which nodes are at neither: their gap is zero, and their pressure follows."""
        return ~(self.yielding(pressure) | self.pulling(pressure))

    def nearest(self, pressure: Real) -> Real:
        """Return the nearest pressures within the bounds; these themselves if all are."""
        if np.all((pressure >= self.low) & (pressure <= self.high)):
            return pressure
        return np.clip(pressure, self.low, self.high)

    def lowered(self, pressure: Real) -> Real:
        """Return pressures that are no more than the upper bounds; these themselves if none is."""
        return np.minimum(pressure, self.high) if np.any(pressure > self.high) else pressure

    def violations(self, pressure: Real) -> tuple[float, float]:
        """Return by how much pressures are below and above the bounds, at most. [pressure]"""
        if not pressure.size:
            return 0.0, 0.0
        below, above = float((self.low - pressure).max()), float((pressure - self.high).max())
        return max(below, 0.0), max(above, 0.0)  # which keeps what is no number

    def with_total(self, pressure: Real, total: float) -> Real:
        """Change the pressures between the bounds so that all of them sum to a total. [pressure]

        They are scaled, or, towards an upper bound, moved up by the same part of what each has
        left to it, so none reaches it. Where the nodes at a bound alone would carry too much, all
        are scaled down. Where nodes pull, those between the bounds are moved alike, or all if
        there are none.
        """
        pressure = np.minimum(pressure, self.high)
        touching = self.touching(pressure)
        rest = total - float(pressure[~touching].sum())
        now = float(pressure[touching].sum())
        pulls = rest <= 0 or not touching.any() or float(pressure[touching].min()) < 0
        if pulls and np.any(self.low):
            follow = touching if touching.any() else np.ones_like(touching)
            pressure[follow] += (total - float(pressure.sum())) / int(follow.sum())
            return pressure
        if rest < 0:
            return pressure * (total / float(pressure.sum()))
        if not touching.any():
            return pressure
        if rest <= now or np.isinf(self.high).all():
            even = rest / int(touching.sum())
            pressure[touching] = pressure[touching] * (rest / now) if now > 0 else even
        else:
            left = self.at(touching).high - pressure[touching]
            pressure[touching] += left * min((rest - now) / float(left.sum()), 1.0)
        return pressure
