"""A self-affine law fitted to a measured spectrum: exponent, roll-off and cutoff with intervals."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.summary import summary
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.measurement.law_search import Corner, Law, LikelyLaws, Observed, power_law
from roughline.measurement.map_rings import MapRings
from roughline.measurement.means import FEWEST_MEANS
from roughline.measurement.scan_bins import ScanBins
from roughline.spectra.isotropic import IsotropicSpectrum, isotropic_spectrum
from roughline.spectra.profile import ProfileSpectrum, profile_spectrum
from roughline.spectra.self_affine import SelfAffine
from roughline.topography.body import Body, Surface
from roughline.topography.provenance import UNKNOWN

_Spectrum = IsotropicSpectrum | ProfileSpectrum
_Interval = tuple[float, float]

_CONFIDENCE = 0.975  # of profile likelihoods; as ends are chosen too, 95 in 100 hold the truth
SHORTEST_RANGE = 3.0  # ratio of wavenumbers that a power law must span
_LEAST_ISOTROPY = 1 / 3  # least over largest slope, below which directions have no law in common
_CONTRADICTING_DEVIANCE = 4.0  # beyond that of the best instrument, which the true one rarely has
_LARGEST_CHANGE = math.log(1.2)  # of the spectrum, by the instrument
_TIP_CURVATURE = 0.5  # rms curvature times the tip's radius, up to which a tip follows the surface
_MOST_SCATTER = 0.15  # rms of log10 of the spectrum about the law


@dataclass(frozen=True, eq=False)
class SelfAffineFit:
    """A plateau, then a power law, up to where it ends.

    Intervals are at 95 %. Besides chance, they allow for deviations of 10 % from the law in each
    tenth of a decade, for both shapes of the corner at the roll-off, and for what an instrument may
    do to short waves. Their ends are NaN where the law does not describe the spectrum, or where
    directions have none in common: the other numbers are then those of the nearest law.

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
        shortest waves, be they blurred or not. [1 / length]
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
    corner : {"sharp", "smooth"}
        Whether the plateau goes up to the roll-off, or the law is one of 1 + (q / q_roll)².
    blur : float
        Standard deviation of the Gaussian blur that explains the spectrum's tail, beside what is
        known of the instrument. Means over pixels act as one of 0.29 spacings. [length]
    blur_interval : tuple of float
        Its interval. [length]
    q_tail : float or None
        From where on the instrument changes the spectrum by more than a fifth; None if it does so
        nowhere. [1 / length]
    remarks : tuple of str
        What speaks against the assumptions of the fit.
    refusals : tuple of str
        Why the law does not describe the spectrum; empty where it does.
    """

    hurst: float
    hurst_interval: _Interval
    q_roll: float | None
    q_roll_interval: _Interval
    q_high: float | None
    q_high_interval: _Interval
    C_0: float
    rms_height: float
    rms_interval: _Interval
    scatter: float
    q_low: float
    q_last: float
    corner: Corner = "sharp"
    blur: float = 0.0
    blur_interval: _Interval = (0.0, 0.0)
    q_tail: float | None = None
    remarks: tuple[str, ...] = ()
    refusals: tuple[str, ...] = ()

    __repr__ = summary

    @property
    def is_judged(self) -> bool:
        """Whether there are intervals."""
        return not math.isnan(self.hurst_interval[0])

    @property
    def shows_roll_off(self) -> bool:
        """Whether the interval of the roll-off lies beyond the longest waves."""
        return self.q_roll is not None and self.q_roll_interval[0] > self.q_low * (1 + 1e-9)

    @property
    def hurst_in_words(self) -> str:
        """The exponent with its interval, as it is printed."""
        low, high = self.hurst_interval
        span = f"{low:.2f} to {high:.2f}" if self.is_judged else "not judged"
        return f"{self.hurst:.2f} ({span})"

    @property
    def in_words(self) -> str:
        """The exponent as the caption of a spectrum, or that it follows no such law."""
        return "not self-affine" if self.objections else f"H = {self.hurst_in_words}"

    @property
    def objections(self) -> list[str]:
        """All that speaks against a self-affine law; what hangs on the fit stands if empty."""
        return [*self.remarks, *self.refusals]

    def without_intervals(self, *why: str) -> SelfAffineFit:
        """Return the same law, not judged, with a remark that says why where that is told."""
        nothing = (math.nan, math.nan)
        return replace(
            self,
            hurst_interval=nothing,
            q_roll_interval=nothing,
            q_high_interval=nothing,
            rms_interval=nothing,
            blur_interval=nothing,
            remarks=(*why, *self.remarks),
        )

    def spectrum(self) -> SelfAffine:
        """Return the fitted spectrum, for random surfaces and lines like this one.

        Raises
        ------
        InputError
            If the law does not describe the spectrum, or its exponent is outside 0 to 1.
        """
        if self.refusals:
            raise InputError(
                f"there is no self-affine spectrum like this one: {'; '.join(self.refusals)}; "
                "state the law that is meant, as rl.SelfAffine(...)"
            )
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
        law = self.C_0 * np.exp(power_law(q, np.array([self.hurst]), begin, self.corner)[0])
        return np.where((q < self.q_low * (1 - 1e-9)) | (q > end * (1 + 1e-9)), np.nan, law)


@public
def fit_self_affine(spectrum: IsotropicSpectrum | ProfileSpectrum) -> SelfAffineFit:
    """Fit a self-affine law with roll-off and cutoff by maximum likelihood.

    The mean over the modes of a ring has a gamma distribution (Whittle's likelihood). Its expected
    value is the law, smeared by the window of the piece and by the removed mean plane. For each
    slope, roll-off and end the level follows in closed form. Beyond the end of the law the spectrum
    is free, with a penalty for each level that it has there. A profile is fitted with the straight
    cuts of surfaces that follow the law.

    Short waves are seen through an instrument. What is not known of it is tried: no effect, a blur
    up to four spacings, waves that are too short for the grid and appear as longer ones, and white
    noise. The corner at the roll-off is tried sharp and smooth. Intervals hold what is likely with
    any of them. A law that does not describe the spectrum has none, and says why in its refusals.

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
    fit = nearest_law(spectrum)
    return fit.without_intervals() if fit.refusals else fit


def nearest_law(spectrum: _Spectrum) -> SelfAffineFit:
    """The likeliest law with its intervals, even if it does not describe the spectrum.

    Where the spectrum stops rising towards long waves, that is, its roll-off, does not hang on a
    power law beyond.
    """
    spectrum = _within_reach(spectrum)
    observed, remarks = _observed(spectrum)
    fit = _fitted(spectrum, observed, remarks)
    if isinstance(spectrum, IsotropicSpectrum) and spectrum.isotropy < _LEAST_ISOTROPY:
        return fit.without_intervals(
            f"slopes differ by direction, least over largest {spectrum.isotropy:.2f}: one law for "
            f"all directions is not judged below {_LEAST_ISOTROPY:.2f}; fit line scans across the "
            "lay"
        )
    return fit


def fitted(body: Body) -> tuple[_Spectrum, SelfAffineFit]:
    """Return the spectrum of a body and the nearest law, computed once for each body."""
    if body not in _KNOWN:
        spectrum = isotropic_spectrum(body) if isinstance(body, Surface) else profile_spectrum(body)
        _KNOWN[body] = spectrum, nearest_law(spectrum)
    return _KNOWN[body]


_KNOWN: WeakKeyDictionary[Body, tuple[_Spectrum, SelfAffineFit]] = WeakKeyDictionary()


def _fitted(spectrum: _Spectrum, observed: Observed, remarks: tuple[str, ...]) -> SelfAffineFit:
    """The law that explains a spectrum best, and the intervals of all that are likely."""
    q_low, last = 2 * math.pi / spectrum.length, float(observed.means.q[-1])
    laws = observed.laws
    law = laws.at(*laws.best)
    hurst, roll, end, corner, response = law
    log_level = laws.log_level[laws.best]
    deviations = observed.means.deviations(observed.log_powers(law) + log_level)
    likely = LikelyLaws.of(laws, _CONFIDENCE)
    first_roll, last_roll = likely.roll_interval
    first_end, last_end = likely.end_interval
    rms, lowest_rms, highest_rms = spectrum.rms_height * _rms_factors(observed, likely)
    blurs = observed.responses.blurs
    least_blur, most_blur = likely.blur_interval(blurs)
    scatter = deviations.scatter / math.log(10)
    span = q_low * min(end, last) / (q_low * roll if roll > 1 else float(spectrum.q[0]))
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
        scatter=scatter,
        q_low=float(spectrum.q[0]),
        q_last=q_low * last,
        corner=corner,
        blur=float(blurs[response]) * spectrum.spacing,
        blur_interval=(least_blur * spectrum.spacing, most_blur * spectrum.spacing),
        q_tail=_tail(observed, law, q_low),
        remarks=remarks,
        refusals=tuple(_refusals(hurst, likely.hurst_interval, span, scatter)),
    )


def _refusals(hurst: float, interval: _Interval, span: float, scatter: float) -> Iterator[str]:
    """Say why a law does not describe a spectrum, from its slope, its span and what is off it."""
    if interval[1] < 0 or interval[0] > 1:
        yield f"the slope is that of H = {hurst:.2f}, outside 0 to 1"
    if span < SHORTEST_RANGE:
        yield f"the power law spans a factor of {span:.2g} only"
    if scatter > _MOST_SCATTER:
        yield f"the spectrum is off the law by a factor of {10**scatter:.2f} (rms)"


def _tail(observed: Observed, law: Law, q_low: float) -> float | None:
    """From where on an instrument changes the spectrum; None if it does so nowhere."""
    own, seen = (observed.log_powers(law, seen=each) for each in (False, True))
    inside = np.isfinite(own)
    changed = np.abs(seen[inside] - own[inside]) > _LARGEST_CHANGE
    return q_low * float(observed.means.q[changed.argmax()]) if changed.any() else None


def _observed(spectrum: _Spectrum) -> tuple[Observed, tuple[str, ...]]:
    """The spectrum as laws are compared with it, and what speaks against its instrument.

    An instrument that contradicts the spectrum's tail is taken as unknown.
    """
    observed, instrument = _compared(spectrum), spectrum.instrument
    if instrument.pixels is None and instrument.blur is None:
        return observed, ()
    unknown = _compared(replace(spectrum, instrument=UNKNOWN))
    laws = unknown.laws
    if instrument.pixels == "points" and instrument.blur is None:  # as if unknown, but for this
        as_stated = laws.of_responses[unknown.responses.blurs == 0].min()
    else:
        as_stated = observed.laws.deviance.min()
    if as_stated <= laws.deviance.min() + _CONTRADICTING_DEVIANCE:
        return observed, ()
    blur = unknown.responses.blurs[laws.at(*laws.best).response]
    objection = (
        "the spectrum's tail is not that of the instrument as it was told: a blur of "
        f"{blur:.2g} pixels explains it better, and means over pixels act as one of 0.29: "
        "check pixels and blur"
    )
    return unknown, (objection,)


def _compared(spectrum: _Spectrum) -> Observed:
    if isinstance(spectrum, ProfileSpectrum):
        return ScanBins.of(spectrum)
    return MapRings.of(spectrum)


def _within_reach(spectrum: _Spectrum) -> _Spectrum:
    """The waves that a tip of known radius follows.

    Up to some wavenumber the rms curvature of the waves is small over that of the tip.
    """
    radius, q = spectrum.instrument.tip_radius, spectrum.q
    if radius is None:
        return spectrum
    if isinstance(spectrum, ProfileSpectrum):
        squares = 2 * q**4 * spectrum.C_profile * np.diff(spectrum.edges)
    else:  # along one direction, 3/8 of q⁴
        squares = 3 / 8 * 2 * math.pi * q**5 * spectrum.C_2d * np.gradient(q)
    n = int(np.count_nonzero(radius * np.sqrt(np.cumsum(squares)) < _TIP_CURVATURE))
    if n < min(FEWEST_MEANS, q.size):
        raise InputError(
            f"a tip of radius {radius:.3g} follows {n} wavenumbers of the spectrum; a fit needs "
            f"{FEWEST_MEANS}: check tip_radius, or measure with a finer tip"
        )
    # edges are one more than wavenumbers
    longest: dict[str, Any] = {
        name: value[: value.size - q.size + n]
        for name, value in vars(spectrum).items()
        if isinstance(value, np.ndarray)
    }
    return replace(spectrum, **longest)


def _rms_factors(observed: Observed, likely: LikelyLaws) -> Real:
    """Rms height of a surface as large as the piece over that of the piece, with both ends.

    The mean square of a piece has about a gamma distribution, whose shape is that of its powers.
    The interval misses where the law is missed or where chance is larger; both are as rare.
    """
    from scipy import special  # here because it loads slowly

    factors, miss_chance = [], 1 - _CONFIDENCE
    for which in (likely.laws.best, *likely.outline()):
        law = likely.laws.at(*which)
        larger, piece = observed.mean_square(law)
        power = observed.modes * np.exp(observed.log_powers(law))
        shape = power.sum() ** 2 / (2 * (power**2 / observed.modes).sum())
        chance = special.gammaincinv(shape, [1 - miss_chance / 2, miss_chance / 2]) / shape
        factors.append(larger / piece / np.array([1.0, *chance]))
    best, low, high = factors[0][0], np.min(factors, axis=0)[1], np.max(factors, axis=0)[2]
    return np.sqrt([best, low, high])
