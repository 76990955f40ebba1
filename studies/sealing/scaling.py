"""Finite-size scaling: the area at which endless surfaces seal, from periodic ones of some sizes.

Under a growing load the gap of a periodic body winds along both directions up to a first area, and
along one of them up to a last one, beyond which it is sealed. With n waves along a side there are
two ways to the area a of endless surfaces:

- At the threshold of two-dimensional percolation a known share of square cells winds along a side.
  The area up to which so many bodies do nears a as n^(-2 - 1/nu), nu = 4/3.
- The means of the first and the last area are what the probabilities to wind along both directions,
  and along any, add up to over the area. They near a from below and from above, as

      a_first = a + c_first n^(-1/nu) + d n^(-2/nu),   a_last = a + c_last n^(-1/nu) + d n^(-2/nu),

  with 1/nu of percolation, or the one that fits best. Without the second order, which both share,
  the threshold of random sites comes out .01 too low from sizes of 4 to 32.

References
----------
Newman and Ziff, Phys. Rev. E 64, 016706 (2001) (shares, and how fast they near the threshold).
Pinson, J. Stat. Phys. 75, 1167 (1994) (the share of cells that wind at the threshold).
Stauffer and Aharony, Introduction to Percolation Theory, 1994, ch. 4 (finite-size scaling).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from roughline.computing.arrays import Real
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import IntervalEstimate
from studies.judged import Found
from studies.sealing.body import DIRECTIONS
from studies.sealing.measure import Data, Sample, area_shift, mean, widened_by_grid
from studies.sealing.run import COUNTS

LARGEST, SMALLEST = max(COUNTS), min(COUNTS)
"""Roll-off waves along a side of the largest and of the smallest bodies."""
PERCOLATION = 0.75
"""1/nu of two-dimensional percolation."""
WINDING = 0.521058
"""Share of square cells at the threshold of percolation that wind along x."""
_OF_SHARES = 2.75
"""2 + 1/nu."""
_EXPONENTS = np.linspace(0.2, 2.0, 361)
"""Exponents that are tried; the interval of none reaches further."""


@dataclass(frozen=True, eq=False)
class Fit:
    """Limits of endless surfaces, by least squares, for each of some exponents."""

    exponents: Real
    limits: Real
    errors: Real  # their standard errors
    misfits: Real  # sums of squares, in squared standard errors
    freedom: int  # of the misfit
    bodies: int  # of the size with the fewest

    @property
    def misfit(self) -> float:
        """Least sum of squares over its degrees of freedom: about 1 where the law holds."""
        return float(self.misfits.min() / self.freedom)

    def limit(self, confidence: float = 0.95) -> IntervalEstimate:
        """Area at sealing of endless surfaces."""
        room = self._room(confidence)
        allowed = room >= 0
        width = np.sqrt(room[allowed]) * self.errors[allowed]
        limits = self.limits[allowed]
        best = float(self.limits[self.misfits.argmin()])
        return IntervalEstimate(best, float((limits - width).min()), float((limits + width).max()))

    def exponent(self, confidence: float = 0.95) -> IntervalEstimate:
        """The exponent 1/nu that fits best."""
        allowed = self.exponents[self._room(confidence) >= 0]
        best = float(self.exponents[self.misfits.argmin()])
        return IntervalEstimate(best, float(allowed.min()), float(allowed.max()))

    def _room(self, confidence: float) -> Real:
        """By how much each misfit is below what is allowed, which is more where no fit is good."""
        from scipy.special import stdtrit  # here because it loads slowly

        allowed = stdtrit(self.bodies - 1, (1 + confidence) / 2) ** 2
        least = float(self.misfits.min())
        return least + allowed * max(1.0, self.misfit) - self.misfits


def fitted(areas: Mapping[int, Real], exponents: Real) -> Fit:
    """Fit the limit to areas of bodies, shape (bodies, 2), by the waves along a side.

    The two of a body are not independent, the bodies are.
    """
    waves = np.array(list(areas), dtype=np.float64)
    means = np.stack([each.mean(axis=0) for each in areas.values()])
    roots = np.stack([_inverse_root(np.cov(each.T) / len(each)) for each in areas.values()])
    design = np.zeros((len(exponents), waves.size, 2, 4))
    design[..., 0] = 1
    design[:, :, 0, 1] = design[:, :, 1, 2] = first_order = waves ** -exponents[:, np.newaxis]
    design[..., 3] = first_order[..., np.newaxis] ** 2
    target = (roots @ means[..., np.newaxis]).reshape(-1, 1)
    scaled = (roots @ design).reshape(len(exponents), target.size, -1)
    turned = scaled.transpose(0, 2, 1)
    inverse = np.linalg.inv(turned @ scaled)
    best = inverse @ turned @ target
    misfits = ((target - scaled @ best) ** 2).sum(axis=(1, 2))
    freedom = means.size - best.shape[1] - (len(exponents) > 1)
    fewest = min(map(len, areas.values()))
    return Fit(exponents, best[:, 0, 0], np.sqrt(inverse[:, 0, 0]), misfits, freedom, fewest)


def _inverse_root(covariance: Real) -> Real:
    """A matrix R with Rᵀ R the inverse of a covariance; what scatters nowhere is kept finite."""
    least = 1e-16 + 1e-9 * float(np.trace(covariance))
    root: Real = np.linalg.inv(np.linalg.cholesky(covariance + least * np.eye(2)))
    return root


def first_and_last(one: Sample) -> Real:
    """Areas up to which the gap winds along both directions, and along any, (bodies, 2)."""
    areas = np.stack([one.values(f"area_{along}") for along in DIRECTIONS], axis=1)
    return np.sort(areas, axis=1)


@dataclass(frozen=True, eq=False)
class Threshold:
    """Area up to which as many endless surfaces wind along a side as at the threshold."""

    value: float
    resampled: Real  # the same of resamples of the bodies

    def interval_estimate(self, confidence: float = 0.95) -> IntervalEstimate:
        """The area with its interval, percentiles of the resamples."""
        ends = np.quantile(self.resampled, [(1 - confidence) / 2, (1 + confidence) / 2])
        return IntervalEstimate(self.value, *ends.tolist())

    def __sub__(self, other: Threshold) -> Threshold:
        """The difference of two; what bodies of the same numbers have in common drops out."""
        return Threshold(self.value - other.value, self.resampled - other.resampled)


def threshold_of(areas: Mapping[int, Real]) -> Threshold:
    """Find the threshold from areas of bodies, shape (bodies, 2), by the waves along a side."""
    found = [_at_share(each) for each in areas.values()]
    errors = np.array([max(float(one.resampled.std()), 1e-9) for one in found])
    waves = np.array(list(areas), dtype=np.float64)
    design = np.stack([np.ones_like(waves), waves**-_OF_SHARES], axis=1) / errors[:, np.newaxis]
    weights = np.linalg.pinv(design)[0] / errors
    value = float(weights @ [one.value for one in found])
    return Threshold(value, weights @ np.stack([one.resampled for one in found]))


def _at_share(areas: Real) -> Threshold:
    """The area up to which as many bodies of one size wind along a side as at the threshold."""
    count = len(areas)
    draws = np.random.default_rng(count).integers(count, size=(bootstrap.ROUNDS, count))
    resampled = np.quantile(areas[draws].reshape(bootstrap.ROUNDS, -1), 1 - WINDING, axis=1)
    return Threshold(float(np.quantile(areas, 1 - WINDING)), resampled)


def at_share(one: Sample) -> IntervalEstimate:
    """Return the area up to which as many bodies wind along a side as at the threshold."""
    return _at_share(first_and_last(one)).interval_estimate()


@lru_cache(maxsize=32)
def threshold(data: Data, hurst: float, hardness: float) -> Threshold:
    """Find the area at which endless surfaces seal, on the grid of the study."""
    return threshold_of(_areas(data, hurst, hardness))


def at_sealing(data: Data, hurst: float, hardness: float, confidence: float = 0.95) -> Found:
    """Return the area at which endless surfaces seal, widened by the error of the grid."""
    found = threshold(data, hurst, hardness).interval_estimate(confidence)
    shift = area_shift(data, hurst, hardness, confidence=confidence)
    return widened_by_grid(found, shift, data.sample(LARGEST, hurst, hardness).count)


def hurst_change(
    data: Data, hursts: tuple[float, float], hardness: float, confidence: float = 0.95
) -> Found:
    """Return by how much the area at sealing is larger at the second Hurst exponent.

    Bodies of both have the same seeds, so that much of their scatter is the same.
    """
    first, second = (threshold(data, hurst, hardness) for hurst in hursts)
    shifts = []
    for hurst in hursts:
        fine, coarse = data.grids(hurst, hardness)
        changes = fine.of_both("area") - coarse.of_both("area")
        shifts.append(dict(zip(fine.bodies, changes, strict=True)))
    common = [number for number in shifts[0] if number in shifts[1]]
    shift = mean(np.array([shifts[1][i] - shifts[0][i] for i in common]), confidence)
    found = (second - first).interval_estimate(confidence)
    return widened_by_grid(found, shift, data.sample(LARGEST, hursts[0], hardness).count)


def scaling(data: Data, hurst: float, hardness: float, free: bool = False) -> Fit:
    """Fit the means of the first and the last area, with 1/nu of percolation or the best one."""
    exponents = _EXPONENTS if free else np.array([PERCOLATION])
    return fitted(_areas(data, hurst, hardness), exponents)


def _areas(data: Data, hurst: float, hardness: float) -> dict[int, Real]:
    samples = {waves: data.sample(waves, hurst, hardness) for waves in COUNTS}
    return {waves: first_and_last(one) for waves, one in samples.items()}


def size_change(data: Data, hurst: float, hardness: float, confidence: float) -> IntervalEstimate:
    """Return by how much more is in contact at sealing on the largest than on the smallest."""
    large, small = (
        bootstrap.means(data.sample(waves, hurst, hardness).of_both("area"), rng)
        for rng, waves in enumerate((LARGEST, SMALLEST))
    )
    return (large - small).interval_estimate(confidence)
