"""Roughness of a topography: amplitudes, slopes, summits, spectrum, and the law it follows."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.summary import summary
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.measurement.departures import checked_fit, departures
from roughline.measurement.fit import SelfAffineFit, fitted
from roughline.measurement.gaussian_heights import skewness_and_kurtosis
from roughline.spectra.isotropic import IsotropicSpectrum, isotropy
from roughline.spectra.profile import ProfileSpectrum
from roughline.topography.body import Body, Line, Surface
from roughline.topography.borders import border_doubts


@dataclass(frozen=True, eq=False)
class Roughness:
    """Parameters of a topography; those of areas for a surface, of profiles for a line.

    Attributes
    ----------
    rms_height : float
        Sq or Rq. [length]
    rms_slope : float
        Sdq or Rdq, from forward differences. [1]
    skewness, kurtosis : float
        Ssk, Sku or Rsk, Rku; 0 and 3 for Gaussian heights, NaN for flat ones. [1]
    summits : int
        Points above all their neighbours, 8 of a surface and 2 of a line.
    summit_skewness : float
        Skewness of their heights; NaN for fewer than 3. [1]
    isotropy : float or None
        Smallest over largest rms slope of all directions; None for a line. [1]
    spectrum : IsotropicSpectrum, ProfileSpectrum or None
        Spectrum, averaged over directions; None if there is none.
    fit : SelfAffineFit or None
        The self-affine law that fits best; None if there is no fit. Where `fit.objections` has
        entries, the law does not describe the topography, and has no intervals.
    remarks : list of str
        How the topography departs from what predictions rest on, the gravest first; why there is
        no spectrum or no fit, or why it is not to be trusted.
    """

    rms_height: float
    rms_slope: float
    skewness: float
    kurtosis: float
    summits: int
    summit_skewness: float
    isotropy: float | None
    spectrum: IsotropicSpectrum | ProfileSpectrum | None
    fit: SelfAffineFit | None
    remarks: list[str]

    __repr__ = summary

    @property
    def power(self) -> Real | None:
        """C_2d of a surface [length⁴] or C_profile of a line [length³], at `spectrum.q`."""
        spectrum = self.spectrum
        if spectrum is None:
            return None
        return spectrum.C_2d if isinstance(spectrum, IsotropicSpectrum) else spectrum.C_profile

    @property
    def law(self) -> tuple[Real, Real] | None:
        """The fitted law as (q, power); None without a fit, or where it does not describe these."""
        spectrum, fit = self.spectrum, self.fit
        if spectrum is None or fit is None or fit.objections:
            return None
        if isinstance(spectrum, IsotropicSpectrum):
            return spectrum.q, fit.values(spectrum.q)
        if not 0 <= fit.hurst <= 1:
            return None
        q = spectrum.q[(spectrum.q >= fit.q_low) & (spectrum.q <= (fit.q_high or fit.q_last))]
        return q, replace(fit.spectrum().continuum, C_0=fit.C_0).C_profile(q)


@public
def roughness(body: Body) -> Roughness:
    """Describe a topography.

    Parameters
    ----------
    body : Surface or Line
        Prepared; a Line of kind "profile". [length]

    References
    ----------
    ISO 25178-2:2021, 4.2; M. S. Longuet-Higgins, "The statistical analysis of a random, moving
    surface", Phil. Trans. R. Soc. A 249, 321-387 (1957), for the slopes of all directions.

    Raises
    ------
    InputError
        For a reduced line, which is no topography.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, rng=7)
    >>> found = rl.roughness(surface)
    >>> print(f"{found.rms_height:.1e} {found.rms_slope:.2f}")
    1.0e-06 0.02
    """
    if isinstance(body, Line) and body.kind == "reduced":
        raise InputError(
            "this is a reduced line, made for springs, and not a topography: describe its surface"
        )
    skewness, kurtosis = skewness_and_kurtosis(body.heights)
    summits = _summits(body.heights)
    remarks, spectrum, fit = [*map(str, border_doubts(body))], None, None
    remarks += [each.text for each in departures(body)]
    try:
        spectrum, law = fitted(body)
        fit = checked_fit(body, law)
        remarks += fit.remarks
        remarks += [f"{each}: press it as it is, which asks for no law" for each in fit.refusals]
    except InputError as error:
        remarks.append(str(error))
    ratio = isotropy(body) if isinstance(body, Surface) else None
    return Roughness(
        rms_height=body.rms_height,
        rms_slope=body.rms_slope,
        skewness=skewness,
        kurtosis=kurtosis,
        summits=summits.size,
        summit_skewness=skewness_and_kurtosis(summits)[0] if summits.size > 2 else math.nan,
        isotropy=ratio,
        spectrum=spectrum,
        fit=fit,
        remarks=remarks,
    )


def _summits(heights: Real) -> Real:
    """Heights of inner points above all their neighbours."""
    inner = heights[(slice(1, -1),) * heights.ndim]
    higher = np.ones(inner.shape, dtype=bool)
    for shift in np.ndindex((3,) * heights.ndim):
        if shift != (1,) * heights.ndim:
            window = tuple(slice(i, i + n) for i, n in zip(shift, inner.shape, strict=True))
            higher &= inner > heights[window]
    return inner[higher]
