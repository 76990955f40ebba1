"""A self-affine law fitted to a measured spectrum: exponent, roll-off and cutoff with intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import special

from roughline.computing.arrays import Real
from roughline.computing.summary import summary
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.likely_laws import Interval, LikelyLaws
from roughline.spectra.map_rings import MapRings
from roughline.spectra.profile import ProfileSpectrum
from roughline.spectra.scan_bins import ScanBins
from roughline.spectra.self_affine import SelfAffine

_LEVEL = 0.975  # of profile likelihoods; as ends are chosen too, 95 in 100 hold the truth
_TRIED = 200  # likely laws from which the interval of the rms height follows
_LEAST_RANGE = 3.0  # ratio of wavenumbers that a power law must span
_MOST_SCATTER = 0.15  # rms of log10 of the spectrum about the law


@dataclass(frozen=True, eq=False)
class SelfAffineFit:
    """A plateau, then a power law, up to where it ends.

    Intervals are at 95 %. Besides chance, they allow for deviations of 10 % from the law in each
    tenth of a decade.

    Attributes
    ----------
    hurst : float
        Hurst exponent H, from the slope -2 (H + 1) of C_2d. [1]
    hurst_interval : tuple of float
        Its interval.
    q_roll : float or None
        Roll-off wavenumber; None if the law goes on to the longest waves. [1 / length]
    q_roll_interval : tuple of float
        Its interval, which begins at zero if there may be none. [1 / length]
    q_high : float or None
        Where the power law ends, by a cutoff, a filter or noise; None if it goes on to the
        shortest waves. [1 / length]
    q_high_interval : tuple of float
        Its interval. [1 / length]
    C_0 : float
        Value on the plateau, and at q_roll. [length⁴]
    rms_height : float
        Rms height of the surface's waves up to the length of the piece. It follows from that of the
        piece by the law: the part that was removed with the mean plane is added, and the part that
        longer waves contribute is subtracted. [length]
    rms_interval : tuple of float
        Its interval; it is wide where long waves are few. [length]
    scatter : float
        Rms of log10 of the spectrum about the law, beyond what chance explains. [1]
    q_low : float
        Wavenumber of the longest wave of the surface. [1 / length]
    q_last : float
        Wavenumber of its shortest wave. [1 / length]
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

    __repr__ = summary

    @property
    def objections(self) -> list[str]:
        """Reasons why a self-affine law does not describe the spectrum; empty where it does."""
        objections = []
        low, high = self.hurst_interval
        if high < 0 or low > 1:
            objections.append(f"the slope is that of H = {self.hurst:.2f}, outside 0 to 1")
        begin, end = self.q_roll or self.q_low, self.q_high or self.q_last
        if end < _LEAST_RANGE * begin:
            objections.append(f"the power law spans a factor of {end / begin:.2g} only")
        if self.scatter > _MOST_SCATTER:
            objections.append(
                f"the spectrum is off the law by a factor of {10**self.scatter:.2f} (rms)"
            )
        return objections

    def spectrum(self) -> SelfAffine:
        """Return the fitted spectrum, for random surfaces and lines like this one.

        Raises
        ------
        InputError
            If the exponent is outside 0 to 1.
        """
        if not 0 <= self.hurst <= 1:
            raise InputError(f"H is {self.hurst:.2f}; a self-affine surface has H from 0 to 1")
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


@public
def fit_self_affine(spectrum: IsotropicSpectrum | ProfileSpectrum) -> SelfAffineFit:
    """Fit a self-affine law with roll-off and cutoff by maximum likelihood.

    The mean over the modes of a ring has a gamma distribution (Whittle's likelihood). Its expected
    value is the law, smeared by the window of the piece and by the removed mean plane. For each
    slope, roll-off and end the level follows in closed form. Beyond the end of the law the spectrum
    is free, with a penalty for each level that it has there. A profile is fitted with the straight
    cuts of surfaces that follow the law.

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

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(128, rng=7)
    >>> fitted = rl.fit_self_affine(rl.isotropic_spectrum(surface))
    >>> print(round(fitted.hurst, 1))
    0.8
    """
    observed = (
        ScanBins.of(spectrum) if isinstance(spectrum, ProfileSpectrum) else MapRings.of(spectrum)
    )
    q_low, last = 2 * math.pi / spectrum.length, float(observed.means.q[-1])
    laws = observed.laws
    hurst, roll, end = laws.values(*laws.best)
    log_level = laws.log_level[laws.best]
    deviations = observed.means.deviations(observed.log_powers(hurst, roll, end) + log_level)
    likely = LikelyLaws.of(laws, _LEVEL)
    first_roll, last_roll = likely.roll_interval
    first_end, last_end = likely.end_interval
    rms, lowest_rms, highest_rms = spectrum.rms_height * _rms_factors(observed, likely)
    return SelfAffineFit(
        hurst=hurst,
        hurst_interval=likely.hurst_interval,
        q_roll=q_low * roll if roll > 1 else None,
        q_roll_interval=(q_low * first_roll, q_low * last_roll),
        q_high=q_low * end if end < last else None,
        q_high_interval=(q_low * min(first_end, last), q_low * min(last_end, last)),
        C_0=math.exp(log_level) * max(1.0, 1 / roll) ** (-2 * (hurst + 1)) / q_low**2,
        rms_height=float(rms),
        rms_interval=(float(lowest_rms), float(highest_rms)),
        scatter=deviations.scatter / math.log(10),
        q_low=float(spectrum.q[0]),
        q_last=q_low * last,
    )


def _rms_factors(observed: MapRings | ScanBins, likely: LikelyLaws) -> Real:
    """Rms height of a surface as large as the piece over that of the piece, with both ends.

    The mean square of a piece has about a gamma distribution, whose shape is that of its powers.
    """
    factors = []
    for law in (likely.laws.best, *likely.spread(_TRIED)):
        values = likely.laws.values(*law)
        whole, piece = observed.mean_square(*values)
        power = observed.modes * np.exp(observed.log_powers(*values))
        shape = power.sum() ** 2 / (2 * (power**2 / observed.modes).sum())
        chance = special.gammaincinv(shape, [0.975, 0.025]) / shape
        factors.append(whole / piece / np.array([1.0, *chance]))
    best, low, high = factors[0][0], np.min(factors, axis=0)[1], np.max(factors, axis=0)[2]
    return np.sqrt([best, low, high])
