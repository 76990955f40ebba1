"""Positions of points along a side, as a file states them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError

_STEP_TOLERANCE = 0.01  # of a step that positions may be off


@dataclass(frozen=True, eq=False)
class Positions:
    """Positions of two points or more, rising or falling from each to the next."""

    values: Real  # [unit]
    unit: str | None  # if the file states it
    name: str  # of the side, for messages
    file: str  # likewise

    def __post_init__(self) -> None:
        """Refuse positions that are missing, equal, or neither rise nor fall throughout."""
        steps = np.diff(self.values)
        if not np.isfinite(self.values).all() or not ((steps > 0).all() or (steps < 0).all()):
            raise InputError(
                f"{self.file} states positions along {self.name} that neither rise nor fall from "
                "each point to the next: mend them, or leave them out and give the sizes"
            )

    @property
    def fall(self) -> bool:
        """Whether they fall."""
        return bool(self.values[0] > self.values[-1])

    @property
    def rising(self) -> Real:
        """The positions in rising order."""
        return self.values[::-1] if self.fall else self.values

    @cached_property
    def are_even(self) -> bool:
        """Whether all steps are one, but for rounding."""
        even = np.linspace(self.values[0], self.values[-1], self.values.size)
        return bool(np.abs(self.values - even).max() <= _STEP_TOLERANCE * abs(even[1] - even[0]))

    @property
    def side(self) -> float:
        """The length of all cells; of uneven points, the distance of the ends. [unit]"""
        between = float(abs(self.values[-1] - self.values[0]))
        n = self.values.size
        return between / (n - 1) * n if self.are_even else between
