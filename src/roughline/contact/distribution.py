"""How values are distributed: their density in bins, and what lies at zero or at the hardness."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.summary import summary

_FEWEST_BINS, _MOST_BINS = 8, 128


@dataclass(frozen=True, eq=False)
class Distribution:
    """Distribution of the gap or of the pressure over the nominal area, or of patch areas.

    Values that much of the area shares exactly have no density: a gap or a pressure of zero, and
    the hardness where the contact yields. Their shares are kept apart, so that the integral of the
    density and both shares are one together.

    Attributes
    ----------
    edges : ndarray, shape (bins + 1,)
        Edges of the bins, rising. [unit of the values]
    density : ndarray, shape (bins,)
        Share of the area, or of the patches, with values in a bin over the width of the bin.
        [1 / unit of the values]
    at_zero : float
        Share at exactly zero: of gaps where the bodies touch, of pressures where they do not. [1]
    at_hardness : float
        Share at exactly the hardness; zero but for pressures. [1]
    mean : float
        Mean of all values, those at zero included. [unit of the values]
    std : float
        Their standard deviation. [unit of the values]
    skewness : float
        Their skewness; NaN where all are equal. [1]

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=0.01).surface(64, rng=1)
    >>> curve = rl.press(surface, E_star=1.0, forces=[0.01], periodic=True, fields=True)
    >>> pressure = curve.fields[0].distribution("pressure")
    >>> print(round(pressure.mean, 6))  # the mean over the nominal area: F / A_0
    0.01
    >>> print(round(pressure.at_zero + pressure.shares.sum(), 12))
    1.0
    """

    edges: Real
    density: Real
    at_zero: float
    at_hardness: float
    mean: float
    std: float
    skewness: float

    __repr__ = summary

    @property
    def shares(self) -> Real:
        """Share of the area, or of the patches, with values in each bin. [1]"""
        return self.density * np.diff(self.edges)


def binned(
    values: Real, at_zero: int, at_hardness: int = 0, edges: Real | None = None
) -> Distribution:
    """Return the distribution of positive values beside values at zero and at the hardness.

    Those are counted: `at_zero` are not among the values, `at_hardness` are the largest of them.
    """
    count = values.size + at_zero
    spread = np.sort(values)[: values.size - at_hardness]
    if edges is None:
        edges = _equal_bins(spread)
    found = np.histogram(spread, edges)[0]
    mean = float(values.sum()) / count
    squares, cubes = (
        (float(((values - mean) ** power).sum()) + at_zero * (-mean) ** power) / count
        for power in (2, 3)
    )
    std = math.sqrt(squares)
    return Distribution(
        edges=edges,
        density=found / count / np.diff(edges),
        at_zero=at_zero / count,
        at_hardness=at_hardness / count,
        mean=mean,
        std=std,
        skewness=cubes / std**3 if std > 0 else math.nan,
    )


def _equal_bins(rising: Real) -> Real:
    """Return edges of equal bins from zero to the largest value; one edge alone without values.

    Their width is that of Freedman and Diaconis, twice the range of the middle half over the cube
    root of the count, within a least and a largest number of bins.
    """
    if not rising.size:
        return np.zeros(1)
    low, high = np.quantile(rising, (0.25, 0.75))
    width = 2 * (high - low) / rising.size ** (1 / 3)
    wanted = rising[-1] / width if width > 0 else _FEWEST_BINS
    bins = int(np.clip(math.ceil(wanted), _FEWEST_BINS, _MOST_BINS))
    return np.linspace(0.0, rising[-1], bins + 1)
