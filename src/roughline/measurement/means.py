"""Mean powers of a measured spectrum, and how much each of them varies by chance.

Wavenumbers are in units of q_low = 2 pi / L here, and powers are those of modes: q_low² C_2d for
the rings of a map, q_low C_profile for the bins of a line scan. [length²]
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.errors import InputError

FEWEST_MEANS = 12  # of a spectrum, for laws to be compared with it

_LAW_DEVIATION = 0.1  # relative, up to which a spectrum counts as following a law
_BINS_PER_DECADE = 10  # of deviations from the law, and of the free spectrum beyond its end
_POWER_FLOOR = 1e-14  # of the largest power: rounding
_FARTHEST_MEAN = 256  # means; a window leaks 1e-16 so far away
_LEAKAGE_FACTOR = 3.0  # times the leakage of stronger waves; a smaller power may be leakage alone


@dataclass(frozen=True, eq=False)
class Means:
    """Mean powers of a spectrum, and how much each of them varies by chance."""

    q: Real  # wavenumbers
    power: Real  # of a mode
    by_chance: Real  # variance of the logarithm of each, for its number of modes
    weight: Real  # shape of its gamma distribution when deviations from the law are allowed for
    leaked: Mask  # where the power may be what the window leaks of stronger waves, or rounding
    in_tenth: Real  # number of means in the same tenth of a decade

    @classmethod
    def of(cls, q: Real, power: Real, modes: Real, windowed: bool) -> Means:
        """Weigh mean powers, each of a number of independent modes.

        Under a window stronger waves leak into others.
        """
        q, power, modes = (array[modes > 0] for array in (q, power, modes))
        if q.size < FEWEST_MEANS:
            raise InputError(
                f"the spectrum has {q.size} wavenumbers; a fit needs {FEWEST_MEANS}: take more "
                "points"
            )
        floor = _POWER_FLOOR * power.max()
        leaked = power <= floor
        if windowed:
            leaked |= power < _LEAKAGE_FACTOR * _leakage_of_others(q, power)
        by_chance = 2 / modes  # half of the modes are the others' conjugates
        # the means of a bin share one deviation: otherwise the shortest waves, which have most of
        # the means, would decide alone
        bins = _bins(q)
        in_tenth = np.bincount(bins)[bins].astype(np.float64)
        weight = 1 / (by_chance + _LAW_DEVIATION**2 * in_tenth)
        return cls(q, np.maximum(power, floor), by_chance, weight, leaked, in_tenth)

    def weighed(self, unknown: Real) -> tuple[Real, Real]:
        """Weights where the logarithm of a law has an unknown variance, and what they cost."""
        weight = 1 / (1 / self.weight + unknown * self.in_tenth)
        return weight, np.log(self.weight / weight) / self.in_tenth

    def endless(self, law: Real, weight: Real, added: Real) -> tuple[Real, Real]:
        """Deviances and log levels of laws, given over (response, hurst, mean), without an end.

        Weights and what they add to the deviance are those of :meth:`weighed`.
        """
        total = weight.sum(axis=1)[:, np.newaxis]
        logs = np.log(self.power)
        log_level = np.log(np.einsum("xb,xhb->xh", weight, np.exp(logs - law)) / total)
        deviance = np.einsum("xb,xhb->xh", weight, law - logs) + total * log_level
        return 2 * deviance + added.sum(axis=1)[:, np.newaxis], log_level

    def free_deviance(self, first: int) -> float:
        """Deviance of a free spectrum from one mean on, with a penalty for each of its levels.

        A free spectrum has a level for each tenth of a decade.
        """
        keep = ~self.leaked[first:]
        q, power, weight = (array[first:][keep] for array in (self.q, self.power, self.weight))
        if q.size == 0:
            return 0.0
        bins = _bins(q)
        sums, levels, logs = (
            np.bincount(bins, values) for values in (weight, weight * power, weight * np.log(power))
        )
        known = sums > 0
        deviance = sums[known] * np.log(levels[known] / sums[known]) - logs[known]
        penalty = math.log(weight.sum() + 1) * (np.count_nonzero(known) + 1)
        return float(2 * deviance.sum() + penalty)

    def deviations(self, law: Real) -> _Deviations:
        """Compare the powers with the logarithm of a law, -inf where it has ended."""
        from scipy import special  # here because it loads slowly

        bins, inside = _bins(self.q), np.isfinite(law)
        size = int(bins[-1]) + 1
        shape = np.bincount(bins, np.where(inside, 1 / self.by_chance, 0.0), size)
        ratio = np.where(inside, self.power / self.by_chance * np.exp(-np.where(inside, law, 0)), 0)
        known = shape > 0
        safe = np.where(known, shape, 1.0)
        mean = np.where(known, np.bincount(bins, ratio, size) / safe, 1.0)
        # the logarithm of a gamma variable has this mean and this variance
        value = np.where(known, np.log(mean) - special.digamma(safe) + np.log(safe), 0.0)
        variance = np.where(known, special.polygamma(1, safe), math.inf)
        weight = np.bincount(bins, np.where(inside, self.weight, 0.0), size)[known]
        excess = float(weight @ (value**2 - variance)[known] / weight.sum())
        return _Deviations(bins, value, variance, math.sqrt(max(0.0, excess)))


@dataclass(frozen=True, eq=False)
class _Deviations:
    """Logarithms of a spectrum over a law, in tenths of a decade."""

    bins: Indices  # tenth that each mean falls in
    values: Real  # logarithm of the mean ratio, 0 in empty tenths
    variance: Real  # of it, by chance; infinite in empty tenths
    scatter: float  # rms of the logarithm, beyond what chance explains

    def drawn(self, generator: np.random.Generator) -> Real:
        """Draw deviations of the surface itself from its law, one for each mean."""
        of_surface = max(self.scatter, _LAW_DEVIATION) ** 2  # variance
        share = of_surface / (of_surface + self.variance)
        spread = np.sqrt(of_surface * (1 - share))
        drawn = share * self.values + spread * generator.standard_normal(share.size)
        return np.asarray(drawn[self.bins])


def _leakage_of_others(q: Real, power: Real) -> Real:
    """Power that a Hann window leaks into each mean from those three modes away and farther."""
    width, leaked = np.gradient(q), np.zeros(q.size)
    for lag in range(1, min(q.size, _FARTHEST_MEAN)):
        distance = q[lag:] - q[:-lag] - (width[lag:] + width[:-lag]) / 2 + 1
        far = np.maximum(distance, 3.0)
        tail = np.where(distance < 3, 0.0, 1 / (3 * (np.pi * far * (far**2 - 1)) ** 2))
        leaked[lag:] += tail * (width * power)[:-lag]
        leaked[:-lag] += tail * (width * power)[lag:]
    return leaked


def _bins(q: Real) -> Indices:
    """Number of the tenth of a decade that each wavenumber falls in."""
    return np.floor(_BINS_PER_DECADE * np.log10(q / q[0])).astype(np.intp)
