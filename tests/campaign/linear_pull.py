"""A contact law and a half-space that the package does not know, in a module of their own."""

import dataclasses

import attrs
import numpy as np

import roughline as rl


@attrs.frozen
class LinearPull(rl.ContactLaw):
    """A pull that falls evenly to none across a range."""

    largest: float
    range: float

    @property
    def cutoff(self):
        return self.range

    def bounds(self, nodes):
        return -self.largest, np.inf

    def scaled(self, pressure, length):
        return LinearPull(self.largest / pressure, self.range / length)

    def share_at(self, gap):
        return 1 - gap / self.range

    def gap_at(self, share):
        return self.range * (1 - share)

    def work_beyond(self, gap):
        return (self.range - gap) ** 2 / (2 * self.range)


@dataclasses.dataclass(frozen=True)
class Foundation(rl.HalfSpace):
    """Springs side by side under the short waves of a half-space."""

    E_star: float
    stiffness: float  # pressure over displacement
    periodic: bool = True

    def spectrum(self, q):
        return 1 / (self.stiffness + self.E_star * q / 2)

    def in_units(self, pressure, length):
        return Foundation(self.E_star / pressure, self.stiffness / pressure * length, self.periodic)
