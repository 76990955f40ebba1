"""By how much a contact violates its conditions."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Residuals:
    """Violations of the contact conditions, recomputed from the returned pressures.

    Attributes
    ----------
    gap, penetration : float
        Largest gap where the bodies touch and overlap elsewhere, over the length scale.
    tension, excess : float
        How far pressures are below and above their bounds at most, over the pressure scale.
    load : float
        Error of the force, over the sum of the forces on all nodes; zero under depth control.
    rounding : float
        Spacing of floating-point numbers at the depth, over the length scale: smaller gaps are
        lost in it.
    """

    gap: float = 0.0
    penetration: float = 0.0
    tension: float = 0.0
    excess: float = 0.0
    load: float = 0.0
    rounding: float = 0.0

    @property
    def worst(self) -> float:
        """The largest of them."""
        return max(self._named.values(), key=_nan_is_largest)

    @property
    def violation(self) -> float:
        """The largest of them but for the rounding."""
        return max(list(self._named.values())[:-1], key=_nan_is_largest)

    @property
    def worst_is_of(self) -> str:
        """What the largest of them is of, in words."""
        return max(self._named, key=lambda name: _nan_is_largest(self._named[name]))

    @property
    def _named(self) -> dict[str, float]:
        return {
            "the gap within the contact": self.gap,
            "the overlap outside the contact": self.penetration,
            "tension": self.tension,
            "pressure above the hardness": self.excess,
            "the force": self.load,
            "the rounding of the depth": self.rounding,
        }


def _nan_is_largest(value: float) -> float:
    return value if value == value else float("inf")
