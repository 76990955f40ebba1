"""The ratio of both models' middle stiffnesses, by which reduced lines stand for one surface.

The map of trust has means, and of 20 surfaces at each place, which scatter by a tenth under light
loads. A line scan asks for the middle of single surfaces. The table has the ratio of geometric
means of 256 surfaces and 600 lines at each place (``benchmarks/median_ratio.py``).
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files

import numpy as np

from roughline.computing.arrays import Real


def median_ratio(fractal_dimension: float, force_bars: Real, roll_off_ratio: float) -> Real:
    """Median stiffness of Gaussian surfaces over that of their reduced lines.

    Forces F / (E* h L) and q_roll / q_low are interpolated by their logarithms. Beyond the table,
    the ratio is that of the nearest place.
    """
    from scipy.interpolate import interpn  # here because it loads slowly

    (roll_offs, dimensions, loads), ratios = _table()
    axes = np.log(roll_offs), dimensions, np.log(loads)
    points = np.column_stack(
        np.broadcast_arrays(np.log(roll_off_ratio), fractal_dimension, np.log(force_bars))
    )
    inside = np.clip(points, [axis[0] for axis in axes], [axis[-1] for axis in axes])
    return np.asarray(np.exp(interpn(axes, np.log(ratios), inside)))


@cache
def _table() -> tuple[list[Real], Real]:
    """Axes of the table, and its ratios over roll-offs, dimensions and loads."""
    with files("roughline.comparison").joinpath("median_ratio.csv").open(encoding="utf-8") as file:
        rows = np.loadtxt(file, delimiter=",", skiprows=1)
    axes = [np.unique(rows[:, i]) for i in range(3)]
    rows = rows[np.lexsort(rows[:, 2::-1].T)]
    return axes, rows[:, 3].reshape([axis.size for axis in axes])
