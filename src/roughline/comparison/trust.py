"""Where the reduced model may be trusted: a map of its difference from the full model.

The map comes from ensembles of both models with the same self-affine spectrum, from 2 pi / L to
32 times that. The grids resolve these waves well (256² points, free half-space). The map is part of
the package; the study in ``studies/paper`` computes it.

The intervals of the map are studentised, as all intervals over realisations are. With 20 surfaces
and 200 lines at each place they contain the true value in 94 to 96 of 100 cases
(``make bootstrap-coverage``).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.computing.summary import summary
from roughline.errors import InputError
from roughline.errors.public import public
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
"""Columns of the file, which has one row for each point of the map; the first three are axes."""


@dataclass(frozen=True)
class Difference:
    """How far the full model is from the reduced one, at one load.

    Attributes
    ----------
    value : float
        Mean stiffness of the surfaces over mean stiffness of the lines, less 1. [1]
    low, high : float
        Ends of the 95 % interval for the means over all surfaces and all lines. Where a single
        surface was pressed, the interval includes the scatter of single surfaces. [1]
    scatter : float
        Relative standard deviation of the stiffness of single surfaces: how far one surface
        differs from their mean. [1]
    resolved : bool
        Whether ten cells or more were in contact in every realisation.
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


@public
@dataclass(frozen=True, eq=False)
class TrustMap:
    """The difference of the two models over roll-off, fractal dimension and load.

    Attributes
    ----------
    roll_off_ratios, fractal_dimensions, force_bars : ndarray
        The axes: q_roll / q_low, D_f, and F / (E* h L).
    difference, low, high, scatter : ndarray, shape (roll-offs, dimensions, loads)
        As in :class:`Difference`.
    resolved : ndarray of bool, same shape
        Whether ten cells or more were in contact in every realisation.
    """

    roll_off_ratios: Real
    fractal_dimensions: Real
    force_bars: Real
    difference: Real
    low: Real
    high: Real
    scatter: Real
    resolved: Mask

    __repr__ = summary

    @classmethod
    def from_rows(cls, rows: Real) -> TrustMap:
        """Make a map from the rows of its file, which are sorted by the axes.

        Their columns are those of :data:`COLUMNS`.
        """
        roll_offs, dimensions, forces = (np.unique(rows[:, i]) for i in range(3))
        shape = (roll_offs.size, dimensions.size, forces.size)
        difference, low, high, scatter, resolved = rows[:, 3:].T.reshape(5, *shape)
        return cls(
            roll_offs, dimensions, forces, difference, low, high, scatter, resolved=resolved > 0.5
        )

    def at(
        self, fractal_dimension: float, force_bar: float, roll_off_ratio: float = 1.0
    ) -> Difference:
        """Interpolate the map linearly, with the logarithms of ratios and loads.

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
            If the point lies outside the map.
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
        value, low, high, scatter, resolved = map(
            float, interpn(grid, np.stack(fields, axis=-1), inside)[0]
        )
        return Difference(value, low, high, scatter, resolved > 1 - 1e-9)


@public
@cache
def trust_map() -> TrustMap:
    """Return the map that comes with the package."""
    with files("roughline.comparison").joinpath("trust_map.csv").open(encoding="utf-8") as file:
        return TrustMap.from_rows(np.loadtxt(file, delimiter=",", skiprows=1))
