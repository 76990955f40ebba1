"""A self-affine law fitted to a measured spectrum: exponent, roll-off and cutoff with intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import special

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.map_rings import MapRings
from roughline.spectra.profile import ProfileSpectrum
from roughline.spectra.scan_bins import ScanBins
from roughline.spectra.self_affine import SelfAffine
from roughline.spectra.self_affine_laws import Laws

Interval = tuple[float, float]

_LEVEL = 0.975  # of profile likelihoods; 95 in 100 hold the truth, as ends are chosen as well
_TRIED = 200  # of the likely laws, for what they say of the rms height
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
        Its interval, which begins at zero if there may be none. [1 / length]
    q_high : float or None
        Where the power law ends, by a cutoff, a filter or noise; None if it goes on to the
        shortest waves. [1 / length]
    q_high_interval : tuple of float
        Its interval. [1 / length]
    C_0 : float
        Value on the plateau, and at q_roll. [length⁴]
    rms_height : float
        Of the surface's waves up to the length of the piece: what the piece has, with what the
        removed mean plane took and without what longer waves added, both by the law. [length]
    rms_interval : tuple of float
        Its interval; long waves are few. [length]
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

    The mean over the modes of a ring has a gamma distribution (Whittle's likelihood); its
    expectation is the law smeared as the piece's window and removed mean plane smear it. For each
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
    means = (
        ScanBins.of(spectrum) if isinstance(spectrum, ProfileSpectrum) else MapRings.of(spectrum)
    )
    q_low, last = 2 * math.pi / spectrum.length, float(means.means.q[-1])
    laws = means.laws
    best = laws.best
    hurst, roll, end = laws.values(*best)
    # a chi-squared variable with one degree of freedom is twice a gamma variable of shape 1/2
    likely = laws.within(2 * special.gammaincinv(0.5, _LEVEL))
    hursts, rolls, ends = (np.unique(indices) for indices in likely)
    step = laws.hursts[1] - laws.hursts[0]
    first_roll = laws.rolls[max(rolls[0] - 1, 0)] if laws.rolls[rolls[0]] > 1 else 0.0
    last_roll = laws.rolls[min(rolls[-1] + 1, laws.rolls.size - 1)]
    first_end = (laws.ends - laws.margins)[ends].min()
    last_end = (laws.ends + laws.margins)[ends].max()
    deviations = means.means.deviations(means.log_powers(hurst, roll, end) + laws.log_level[best])
    rms = spectrum.rms_height * _rms_factors(means, laws, likely)
    return SelfAffineFit(
        hurst=hurst,
        hurst_interval=(
            float(laws.hursts[hursts[0]] - step),
            float(laws.hursts[hursts[-1]] + step),
        ),
        q_roll=q_low * roll if roll > 1 else None,
        q_roll_interval=(q_low * float(first_roll), q_low * float(max(last_roll, 1.0))),
        q_high=q_low * end if end < last else None,
        q_high_interval=(q_low * float(min(first_end, last)), q_low * float(min(last_end, last))),
        C_0=math.exp(laws.log_level[best]) * max(1.0, 1 / roll) ** (-2 * (hurst + 1)) / q_low**2,
        rms_height=float(rms[0]),
        rms_interval=(float(rms[1]), float(rms[2])),
        scatter=deviations.scatter / math.log(10),
        q_low=float(spectrum.q[0]),
        q_last=q_low * last,
    )


def _rms_factors(means: MapRings | ScanBins, laws: Laws, likely: tuple[Indices, ...]) -> Real:
    """Rms height of a surface as large as the piece over that of the piece, with both ends.

    The mean square of a piece has about a gamma distribution, whose shape is that of its powers.
    """
    some = np.unique(np.linspace(0, likely[0].size - 1, _TRIED).astype(np.intp))
    factors = []
    for law in (laws.best, *zip(*(indices[some] for indices in likely), strict=True)):
        values = laws.values(*law)
        whole, piece = means.mean_square(*values)
        power = means.modes * np.exp(means.log_powers(*values))
        shape = power.sum() ** 2 / (2 * (power**2 / means.modes).sum())
        chance = special.gammaincinv(shape, [0.975, 0.025]) / shape
        factors.append(whole / piece / np.array([1.0, *chance]))
    best, low, high = factors[0][0], np.min(factors, axis=0)[1], np.max(factors, axis=0)[2]
    return np.sqrt([best, low, high])
