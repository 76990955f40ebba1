"""A self-affine law fitted to a measured spectrum: exponent, roll-off and cutoff with intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special, stats

from roughline.errors import InputError
from roughline.isotropic import IsotropicSpectrum
from roughline.profile import ProfileSpectrum
from roughline.spectra import SelfAffine

Real = NDArray[np.float64]
Interval = tuple[float, float]

_DESCRIPTION = 0.1  # deviations from the law that still count as following it
_HURSTS = np.linspace(-0.49, 1.5, 200)
_CANDIDATES = 80  # roll-offs and cutoffs tried, evenly in their logarithms
_SMEARED = (1, 4)  # rings that a cutoff half fills: the one it falls in, and those of a Hann window
_JUMPS = 20  # largest jumps of the spectrum, tried as its end as well
_BINS_PER_DECADE = 10  # of deviations from the law, and of the free spectrum beyond its end
_CORRELATED = 2.2  # modes that a Hann window makes of one, in each direction
_LEVEL = 0.975  # of profile likelihoods; 95 in 100 hold the truth, as ends are chosen as well
_FLOOR = 1e-14  # of the largest power: rounding
_LEAST_MEANS = 12
_LEAST_RANGE = 3.0  # of wavenumbers under the power law, to speak of a law
_MOST_SCATTER = 0.15  # rms of log10 of the spectrum about the law


@dataclass(frozen=True, eq=False)
class SelfAffineFit:
    """A plateau, then a power law, up to where it ends.

    Intervals are of 95 %, and allow for deviations of 10 % from the law, in each tenth of a decade,
    that no sample explains.

    Attributes
    ----------
    hurst : float
        Hurst exponent H, from the slope -2 (H + 1) of C_2d. [1]
    hurst_interval : tuple of float
        Its interval.
    q_roll : float or None
        Roll-off wavenumber; None if the law goes on to the longest waves. [1 / length]
    q_roll_interval : tuple of float
        Its interval, which begins at the longest waves if there may be none. [1 / length]
    q_high : float or None
        Where the power law ends, by a cutoff, a filter or noise; None if it goes on to the
        shortest waves. [1 / length]
    q_high_interval : tuple of float
        Its interval. [1 / length]
    C_0 : float
        Value on the plateau, and at q_roll. [length⁴]
    rms_height : float
        Of the surface. [length]
    rms_interval : tuple of float
        For surfaces of the same origin and size; long waves are few. [length]
    scatter : float
        Rms of log10 of the spectrum about the law, beyond what chance explains. [1]
    q_low : float
        Longest wave of the surface. [1 / length]
    q_last : float
        Shortest. [1 / length]
    """

    hurst: float
    hurst_interval: Interval
    q_roll: float | None
    q_roll_interval: Interval
    q_high: float | None
    q_high_interval: Interval
    C_0: float
    rms_height: float
    rms_interval: Interval
    scatter: float
    q_low: float
    q_last: float

    @property
    def objections(self) -> list[str]:
        """Why a self-affine law does not describe the spectrum; empty where it does."""
        found = []
        low, high = self.hurst_interval
        if high < 0 or low > 1:
            found.append(f"the slope is that of H = {self.hurst:.2f}, outside 0 to 1")
        begin, end = self.q_roll or self.q_low, self.q_high or self.q_last
        if end < _LEAST_RANGE * begin:
            found.append(f"the power law spans a factor of {end / begin:.2g} only")
        if self.scatter > _MOST_SCATTER:
            found.append(f"the spectrum is off the law by a factor of {10**self.scatter:.2f} (rms)")
        return found

    def spectrum(self) -> SelfAffine:
        """Return the fitted spectrum, for random surfaces and lines like this one.

        Raises
        ------
        InputError
            If the exponent is outside 0 to 1.
        """
        if not 0 <= self.hurst <= 1:
            raise InputError(f"H is {self.hurst:.2f}; a self-affine surface has 0 to 1")
        return SelfAffine(
            hurst=self.hurst,
            length=2 * math.pi / self.q_low,
            rms_height=self.rms_height,
            q_roll=self.q_roll,
            q_high=self.q_high,
        )

    def values(self, q: Real) -> Real:
        """C_2d of the law, NaN outside its range. [length⁴]"""
        begin, end = self.q_roll or self.q_low, self.q_high or self.q_last
        law = self.C_0 * np.maximum(1.0, q / begin) ** (-2 * (self.hurst + 1))
        return np.where((q < self.q_low * (1 - 1e-9)) | (q > end * (1 + 1e-9)), np.nan, law)


def fit_self_affine(spectrum: IsotropicSpectrum | ProfileSpectrum) -> SelfAffineFit:
    """Fit a self-affine law with roll-off and cutoff by maximum likelihood.

    The mean over the modes of a ring has a gamma distribution (Whittle's likelihood); for each
    slope, roll-off and end the level follows in closed form. Beyond its end the spectrum is free,
    at a cost for each value that it takes there. The law of a profile is that of the surface's
    straight cuts.

    Parameters
    ----------
    spectrum : IsotropicSpectrum or ProfileSpectrum
        Of a surface, or of line scans.

    Raises
    ------
    InputError
        If there are fewer than 12 rings.

    References
    ----------
    P. Whittle, "Estimation and information in stationary time series", Ark. Mat. 2, 423-434
    (1953).
    """
    cut = isinstance(spectrum, ProfileSpectrum)
    mean = spectrum.C_profile if isinstance(spectrum, ProfileSpectrum) else spectrum.C_2d
    known = spectrum.modes > 0
    q, power, modes = (array[known] for array in (spectrum.q, mean, spectrum.modes))
    if q.size < _LEAST_MEANS:
        raise InputError(
            f"the spectrum has {q.size} wavenumbers; a fit needs {_LEAST_MEANS}: take more points"
        )
    power = np.maximum(power, _FLOOR * power.max())
    halves = modes / 2  # the other half are their conjugates
    correlated = _CORRELATED ** (1 if cut else 2) if spectrum.windowed else 1.0
    # a deviation is shared by the rings of its bin: else the shortest waves, whose rings are many,
    # would decide alone
    bins = _bins(q)
    weight = 1 / (correlated / halves + _DESCRIPTION**2 * np.bincount(bins)[bins])
    smeared = _SMEARED[spectrum.windowed]
    deviance, rolls, ends, q_ends = _deviances(q, power, weight, smeared, cut)
    best = np.unravel_index(np.argmin(deviance), deviance.shape)
    hurst, roll, end = _HURSTS[best[0]], rolls[best[1]], ends[best[2]]
    within = deviance <= deviance[best] + stats.chi2.ppf(_LEVEL, 1)
    spans = [np.flatnonzero(within.any(axis=other)) for other in ((1, 2), (0, 2), (0, 1))]
    step = _HURSTS[1] - _HURSTS[0]
    inside = slice(0, end + 1 - smeared)
    if cut:
        t = np.minimum(1.0, (q / q[roll]) ** 2)
        beta = _incomplete_beta(t) - _incomplete_beta((q / q_ends[best[2]]) ** 2)
        laws = _log_cut(q, q[roll], beta)
    else:
        laws = _log_law(q, q[roll])
    law = np.exp(laws[best[0], inside])
    C_0 = float((weight[inside] * power[inside] / law).sum() / weight[inside].sum())
    misfit = np.log10(power[inside] / (C_0 * law))
    by_chance = (correlated / halves[inside]) / math.log(10) ** 2
    shares = weight[inside] / weight[inside].sum()
    spread = math.sqrt(2 * float((modes * power**2).sum())) / float((modes * power).sum())
    spread = 1.96 * min(spread * math.sqrt(correlated), 1.0) / 2  # of the rms, not of its square
    last = q.size - 1
    return SelfAffineFit(
        hurst=float(hurst),
        hurst_interval=(float(_HURSTS[spans[0][0]] - step), float(_HURSTS[spans[0][-1]] + step)),
        q_roll=float(q[roll]) if roll > 0 else None,
        q_roll_interval=(
            float(q[max(rolls[max(spans[1][0] - 1, 0)], 0)]),
            float(q[rolls[min(spans[1][-1] + 1, rolls.size - 1)]]),
        ),
        q_high=float(q[end - smeared // 2]) if end < last else None,
        q_high_interval=(
            float(q[max(ends[max(spans[2][0] - 1, 0)] - smeared, 0)]),
            float(q[min(ends[min(spans[2][-1] + 1, ends.size - 1)] + 1, last)]),
        ),
        C_0=C_0,
        rms_height=spectrum.rms_height,
        rms_interval=(
            spectrum.rms_height * math.exp(-spread),
            spectrum.rms_height * math.exp(spread),
        ),
        scatter=math.sqrt(max(0.0, float(shares @ (misfit**2 - by_chance)))),
        q_low=float(q[0]),
        q_last=float(q[-1]),
    )


def _deviances(
    q: Real, power: Real, weight: Real, smeared: int, cut: bool
) -> tuple[Real, NDArray[np.intp], NDArray[np.intp], Real]:
    """Deviance, and cost of what lies beyond, over exponents, roll-offs and ends.

    With the roll-offs and ends that were tried, and the wavenumber at each end.
    """
    last = q.size - 1
    rolls = _spaced(0, last // 2)
    least = min(_LEAST_MEANS // 2, last)
    jumps = least + np.argsort(-np.abs(np.diff(np.log(power[least:]))))[:_JUMPS]
    ends = np.union1d(_spaced(least, last), jumps)
    q_ends = np.sqrt(q[ends] * q[np.minimum(ends + 1, last)])
    if cut:  # waves beyond the shortest one seen add to a cut, if there are any
        ends, q_ends = np.append(ends, last), np.append(q_ends, math.inf)
    beyond = np.array([_free_deviance(q[e + 1 :], power[e + 1 :], weight[e + 1 :]) for e in ends])
    beta = [_incomplete_beta((q / end) ** 2) for end in q_ends] if cut else []
    deviance = np.full((_HURSTS.size, rolls.size, ends.size), np.inf)
    for j, roll in enumerate(rolls):
        usable = ends > roll + 2  # else no power law is left
        if not cut:
            own = _law_deviances(_log_law(q, q[roll]), power, weight)
            deviance[:, j, usable] = own[:, ends[usable] - smeared]
            continue
        up_to_roll = _incomplete_beta(np.minimum(1.0, (q / q[roll]) ** 2))
        for k in np.flatnonzero(usable):
            inside = slice(0, ends[k] + 1 - smeared)
            log_law = _log_cut(q[inside], q[roll], (up_to_roll - beta[k])[:, inside])
            own = _law_deviances(log_law, power[inside], weight[inside])
            deviance[:, j, k] = own[:, -1]
    return deviance + beyond, rolls, ends, q_ends


def _law_deviances(log_law: Real, power: Real, weight: Real) -> Real:
    """Deviance from laws, each at its best level, over (law, number of means less one)."""
    total = np.cumsum(weight)
    level = np.cumsum(weight * power * np.exp(-log_law), axis=1) / total
    return 2 * (
        np.cumsum(weight * log_law, axis=1)
        + total * np.log(level)
        - np.cumsum(weight * np.log(power))
    )


def _log_law(q: Real, q_roll: float) -> Real:
    """Logarithm of C_2d with a plateau of one, over (hurst, q)."""
    return np.outer(-2 * (_HURSTS + 1), np.log(np.maximum(1.0, q / q_roll)))


def _log_cut(q: Real, q_roll: float, beta: Real) -> Real:
    """Logarithm of its straight cut, as in :meth:`Band.cut`, for all exponents at once."""
    decay = 2 * (_HURSTS[:, np.newaxis] + 1)
    plateau = 2 * np.sqrt(np.maximum(q_roll**2 - q**2, 0.0))
    return np.log(plateau + q * (q / q_roll) ** -decay * np.maximum(beta, _FLOOR))


def _incomplete_beta(t: Real) -> Real:
    """B(t; (decay - 1) / 2, 1 / 2) over (hurst, t)."""
    a = _HURSTS[:, np.newaxis] + 0.5
    return np.asarray(special.beta(a, 0.5) * special.betainc(a, 0.5, np.minimum(t, 1.0)))


def _free_deviance(q: Real, power: Real, weight: Real) -> float:
    """Deviance of a spectrum with a level for each bin, and the price of these levels."""
    if q.size == 0:
        return 0.0
    bins = _bins(q)
    sums, means, logs = (
        np.bincount(bins, values) for values in (weight, weight * power, weight * np.log(power))
    )
    there = sums > 0
    own = sums[there] * np.log(means[there] / sums[there]) - logs[there]
    price = math.log(weight.sum() + 1) * (np.count_nonzero(there) + 1)
    return float(2 * own.sum() + price)


def _bins(q: Real) -> NDArray[np.intp]:
    """Numbers of the bins of equal ratios that wavenumbers fall in."""
    return np.floor(_BINS_PER_DECADE * np.log10(q / q[0])).astype(np.intp)


def _spaced(first: int, last: int) -> NDArray[np.intp]:
    """Whole numbers from first to last, evenly in their logarithms."""
    return np.unique(np.rint(np.geomspace(first + 1, last + 1, _CANDIDATES)).astype(np.intp)) - 1
