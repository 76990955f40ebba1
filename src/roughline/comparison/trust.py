"""Where the reduced model may be trusted: its distance from the full model, as a map.

The map comes from ensembles of both models with the same self-affine spectrum, from
2 pi / L to 32 times that, well resolved by the grids (256² points, free half-space); it is part of
the package, and made anew from the study in ``studies/paper``.

Its intervals are percentiles of resampled realisations, which with 20 surfaces hold the truth in
90 to 93 of 100 cases. They were widened about the difference, in the logarithm of the ratio, by
1.0957: Student's t of 19 degrees of freedom over the normal 1.96, times √(20 / 19). Widened so,
they hold it in 93 to 95 (``make bootstrap-coverage``). The next run of the study writes
studentised intervals.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.statistics.verdict import Verdict, verdict

COLUMNS = (
    "roll_off_ratio",
    "fractal_dimension",
    "force_bar",
    "difference",
    "low",
    "high",
    "scatter",
    "resolved",
)
"""Of the file, a row for each point of the map; the first three are the axes."""


@dataclass(frozen=True)
class Difference:
    """How far the reduced model is from the full one.

    Attributes
    ----------
    value : float
        Stiffness of the full model over that of the reduced one, less 1, of the means, or of one
        surface over the mean of lines. [1]
    low, high : float
        Ends of the 95 % interval of the difference of the means over all surfaces and lines; where
        one surface was pressed, its scatter about the mean is part of it. [1]
    scatter : float
        Relative standard deviation of the stiffness of single surfaces: one surface differs from
        the mean by so much. [1]
    resolved : bool
        Whether, in every realisation, ten cells or more were in contact.
    """

    value: float
    low: float
    high: float
    scatter: float
    resolved: bool

    def __str__(self) -> str:
        text = f"{self.value:+.0%} ({self.low:+.0%} to {self.high:+.0%})"
        return text if self.resolved else f"{text}, at the limit of the grid"

    def verdict(self, tolerance: float = 0.1) -> Verdict:
        """Judge whether the two models agree within a tolerance, over all surfaces."""
        return verdict(self.low, self.high, -tolerance, tolerance)


@dataclass(frozen=True, eq=False)
class TrustMap:
    """Difference of the two models over roll-off, fractal dimension and load.

    Attributes
    ----------
    roll_off_ratios, fractal_dimensions, force_bars : ndarray
        The axes: q_roll / q_low, D_f, and F / (E* h L).
    difference, low, high, scatter : ndarray, shape (roll-offs, dimensions, loads)
        As in :class:`Difference`.
    resolved : ndarray of bool, same shape
        Whether every realisation had ten cells or more in contact.
    """

    roll_off_ratios: Real
    fractal_dimensions: Real
    force_bars: Real
    difference: Real
    low: Real
    high: Real
    scatter: Real
    resolved: NDArray[np.bool_]

    def at(
        self, fractal_dimension: float, force_bar: float, roll_off_ratio: float = 1.0
    ) -> Difference:
        """Read the map, linearly between its points (ratios and loads by their logarithms).

        Parameters
        ----------
        fractal_dimension : float
            D_f, 2 to 3.
        force_bar : float
            Dimensionless force F / (E* h L).
        roll_off_ratio : float, optional
            q_roll / q_low, 1 without roll-off.

        Raises
        ------
        InputError
            Outside the map.
        """
        from scipy.interpolate import interpn  # here because it loads slowly

        axes = {
            "roll_off_ratio": (roll_off_ratio, self.roll_off_ratios),
            "fractal_dimension": (fractal_dimension, self.fractal_dimensions),
            "force_bar": (force_bar, self.force_bars),
        }
        for name, (value, axis) in axes.items():
            if not axis[0] * (1 - 1e-9) <= value <= axis[-1] * (1 + 1e-9):
                raise InputError(
                    f"{name} is {value:g}; the map reaches from {axis[0]:g} to {axis[-1]:g}: "
                    "compare the two models on surfaces of your own instead"
                )
        grid = (np.log(self.roll_off_ratios), self.fractal_dimensions, np.log(self.force_bars))
        point = np.array([np.log(roll_off_ratio), fractal_dimension, np.log(force_bar)])
        inside = np.clip(point, [axis[0] for axis in grid], [axis[-1] for axis in grid])
        fields = (self.difference, self.low, self.high, self.scatter, self.resolved.astype(float))
        value, low, high, scatter, resolved = (
            float(interpn(grid, field, inside)[0]) for field in fields
        )
        return Difference(value, low, high, scatter, resolved > 1 - 1e-9)


@cache
def trust_map() -> TrustMap:
    """Return the map that comes with the package."""
    with files("roughline.comparison").joinpath("trust_map.csv").open(encoding="utf-8") as file:
        return from_rows(np.loadtxt(file, delimiter=",", skiprows=1))


def from_rows(rows: Real) -> TrustMap:
    """Make a map of rows in the order of :data:`COLUMNS`, sorted by the axes."""
    axes = [np.unique(rows[:, i]) for i in range(3)]
    values = rows[:, 3:].T.reshape(5, *(axis.size for axis in axes))
    return TrustMap(
        roll_off_ratios=axes[0],
        fractal_dimensions=axes[1],
        force_bars=axes[2],
        difference=values[0],
        low=values[1],
        high=values[2],
        scatter=values[3],
        resolved=values[4] > 0.5,
    )
