"""Whether the roughness of a map drifts from side to side, more than its places scatter."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import special

from roughline.computing.arrays import Real
from roughline.topography.body import Surface

_STRIPS = 24  # of which the mean squares of slopes are compared
_MOST = 0.9  # correlation of neighbouring strips


@dataclass(frozen=True)
class Drift:
    """How much the rms slope changes along a side, by a straight line through its logarithm.

    Attributes
    ----------
    along : str
        The side, "x" or "y".
    change : float
        Logarithm of the last over the first.
    error : float
        Its standard error, from the scatter of strips about the line.
    freedom : float
        Degrees of freedom of that scatter.
    """

    along: str
    change: float
    error: float
    freedom: float

    @property
    def chance(self) -> float:
        """Probability of as much or more without a drift."""
        ratio = abs(self.change) / self.error if self.error else math.inf
        return 2 * float(special.stdtr(self.freedom, -ratio)) if self.change else 1.0

    def allowed(self, chance: float) -> float:
        """Logarithm that is exceeded without a drift with a probability."""
        return self.error * float(special.stdtrit(self.freedom, 1 - chance / 2))


def drifts(surface: Surface) -> list[Drift]:
    """Return the drift along both sides of a map; none of a map with too few points for it.

    Strips across a side each have a mean square of slopes. Neighbours may correlate, and count for
    fewer then. The strips need not be Gaussian, nor the map isotropic: their own scatter is the
    measure.
    """
    if min(surface.shape) <= _STRIPS:
        return []
    heights, (dx, dy) = surface.detrended().heights, surface.spacing
    across = (np.diff(heights, axis=0) / dx)[:, :-1]
    along = (np.diff(heights, axis=1) / dy)[:-1]
    squares = across**2 + along**2
    found = []
    for axis, name in enumerate("xy"):
        means = np.array([each.mean() for each in np.array_split(squares, _STRIPS, axis=axis)])
        if means.min() > 0:
            found.append(_drift(name, np.log(means) / 2))
    return found


def _drift(name: str, logs: Real) -> Drift:
    """Fit a line to the logarithms of rms slopes of strips, whose scatter may be correlated."""
    n = logs.size
    place = np.linspace(-0.5, 0.5, n) * (1 - 1 / n)
    change = float((place * logs).sum() / (place**2).sum())
    rest = logs - logs.mean() - change * place
    square = float((rest**2).sum())
    if not square:
        return Drift(name, change, 0.0, float(n - 2))
    # a line takes away from the correlation of what is left, about 2 / n
    correlation = float((rest[1:] * rest[:-1]).sum()) / square + 2 / n
    longer = (1 + min(max(correlation, 0.0), _MOST)) / (1 - min(max(correlation, 0.0), _MOST))
    error = math.sqrt(square / (n - 2) * longer / float((place**2).sum()))
    return Drift(name, change, error, max(n / longer - 2, 1.0))
