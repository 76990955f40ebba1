"""Analytical theories of rough contact, evaluated for a spectrum: to lie beside the full model.

None of them knows the half-space's edges: they hold per nominal area, for periodic or very large
surfaces.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from roughline.errors import InputError
from roughline.isotropic import IsotropicSpectrum
from roughline.spectra import SelfAffine

Real = NDArray[np.float64]

_PERSSON_GAMMA = 0.45  # Yang and Persson 2008
_PER_DECADE = 200  # wavenumbers of a SelfAffine spectrum


@dataclass(frozen=True, eq=False)
class TheoryCurve:
    """What a theory says over mean pressures.

    Attributes
    ----------
    name : str
        Of the theory.
    pressure : ndarray, shape (loads,)
        Mean pressure over the nominal area. [pressure]
    area_fraction : ndarray, shape (loads,)
        Real over nominal contact area. [1]
    stiffness : ndarray, shape (loads,) or None
        Interface stiffness per nominal area; None where the theory has none. [pressure / length]
    mean_gap : ndarray, shape (loads,) or None
        Distance of the mean planes; None where the theory has none. [length]
    validity : str
        Where it holds.
    """

    name: str
    pressure: Real
    area_fraction: Real
    stiffness: Real | None
    mean_gap: Real | None
    validity: str


@dataclass(frozen=True, eq=False)
class Moments:
    """Spectral moments of a surface, and the summits that follow from them (Nayak 1971).

    Attributes
    ----------
    m0, m2, m4 : float
        <h²>, <h'²> and <h''²> of a straight cut. [length²], [1], [1 / length²]
    """

    m0: float
    m2: float
    m4: float

    @property
    def nayak(self) -> float:
        """Nayak's parameter m0 m4 / m2²; at least 1.5 for an isotropic surface. [1]"""
        return self.m0 * self.m4 / self.m2**2

    @property
    def rms_slope(self) -> float:
        """Rms gradient of the surface, sqrt(2 m2). [1]"""
        return math.sqrt(2 * self.m2)

    @property
    def summit_density(self) -> float:
        """Summits per area, m4 / (6 pi sqrt(3) m2). [1 / length²]"""
        return self.m4 / (6 * math.pi * math.sqrt(3) * self.m2)

    @property
    def summit_radius(self) -> float:
        """Mean radius of summits, 3 / 8 sqrt(pi / m4) (McCool 1986). [length]"""
        return 3 / 8 * math.sqrt(math.pi / self.m4)

    @property
    def summit_deviation(self) -> float:
        """Standard deviation of summit heights, sqrt((1 - .8968 / nayak) m0). [length]"""
        return math.sqrt((1 - 0.8968 / self.nayak) * self.m0)

    @property
    def summit_mean(self) -> float:
        """Mean height of summits above the mean plane, 4 sqrt(m0 / (pi nayak)). [length]"""
        return 4 * math.sqrt(self.m0 / (math.pi * self.nayak))


def moments(spectrum: SelfAffine | IsotropicSpectrum) -> Moments:
    """Moments of a spectrum, as integrals.

    References
    ----------
    P. R. Nayak, "Random process model of rough surfaces", J. Lubr. Technol. 93, 398-407 (1971).
    J. I. McCool, "Comparison of models for the contact of rough surfaces", Wear 107, 37-60 (1986).

    Raises
    ------
    InputError
        For a self-affine spectrum without ``q_high``.
    """
    q, C_2d, width = _sampled(spectrum)
    power = 2 * math.pi * q * C_2d * width
    return Moments(
        m0=float(power.sum()),
        m2=float((power * q**2).sum()) / 2,
        m4=float((power * q**4).sum()) * 3 / 8,
    )


def theory(
    name: str,
    spectrum: SelfAffine | IsotropicSpectrum,
    E_star: float,
    pressure: ArrayLike,
) -> TheoryCurve:
    """Evaluate a theory for a spectrum.

    Parameters
    ----------
    name : {"persson", "bush-gibson-thomas", "greenwood-williamson"}
        Which.
    spectrum : SelfAffine or IsotropicSpectrum
        The roughness; of a SelfAffine the continuum, with ``q_high``. [length]
    E_star : float
        Contact modulus. [pressure]
    pressure : array_like, shape (loads,)
        Mean pressures over the nominal area. [pressure]

    Raises
    ------
    InputError
        If there is no theory of that name, a pressure is not positive, or the spectrum has no
        upper end.
    """
    refuse_unknown(name)
    pressures = np.atleast_1d(np.asarray(pressure, dtype=np.float64))
    if not ((pressures > 0) & np.isfinite(pressures)).all():
        raise InputError(f"pressures must be positive and finite; {pressures.min()} is among them")
    return THEORIES[name](spectrum, E_star, pressures)


def refuse_unknown(name: str) -> None:
    """Refuse a name that no theory has.

    Raises
    ------
    InputError
        With the names that there are.
    """
    if name not in THEORIES:
        raise InputError(f"no theory is called {name!r}; there are {', '.join(THEORIES)}")


def _persson(
    spectrum: SelfAffine | IsotropicSpectrum, E_star: float, pressure: Real
) -> TheoryCurve:
    """Persson's theory, with Yang and Persson's share of elastic energy, gamma = 0.45.

    References
    ----------
    B. N. J. Persson, "Relation between interfacial separation and load", PRL 99, 125502 (2007),
    eqs. 10-13; C. Yang and B. N. J. Persson, "Contact mechanics: contact area and interfacial
    separation from small contact to full contact", J. Phys.: Condens. Matter 20, 215214 (2008).
    """
    q, C_2d, width = _sampled(spectrum)
    # pi int q³ C up to the middle of each band, so that the first band has a part of itself
    steps = math.pi * q**3 * C_2d * width
    w = 1 / np.sqrt(np.cumsum(steps) - steps / 2)
    weight = math.sqrt(math.pi) * q**2 * C_2d * w * width
    whole = math.sqrt(math.pi * float((q**3 * C_2d * width).sum()))
    gap, compliance = np.empty((2, pressure.size))
    for i, p in enumerate(pressure / E_star):
        # int_p^inf dp'/p' [gamma + 3 (1 - gamma) P²] exp(-(w p')²), P = erf(w p')
        gap[i] = float(weight @ _energy(w * p))
        share = _PERSSON_GAMMA + 3 * (1 - _PERSSON_GAMMA) * special.erf(w * p) ** 2
        compliance[i] = float(weight @ (share * np.exp(-((w * p) ** 2)))) / p
    with np.errstate(divide="ignore"):
        stiffness = E_star / compliance
    return TheoryCurve(
        "persson",
        pressure,
        special.erf(pressure / (E_star * whole)),
        stiffness,
        gap,
        "all loads, Gaussian random surfaces; area 20-30 % low at light loads; stiffness within "
        "20 % from 4 to 60 % contact; where few asperities touch (finite size) too compliant",
    )


def _energy(x: Real) -> Real:
    """Integrate [gamma + 3 (1 - gamma) erf(t)²] exp(-t²) / t from x to infinity."""
    return np.interp(np.log(x), _LOG_X, _TABLE, right=0.0) + np.where(
        x < math.exp(_LOG_X[0]), _PERSSON_GAMMA * (_LOG_X[0] - np.log(x)), 0.0
    )


_LOG_X = np.linspace(math.log(1e-4), math.log(6.0), 20_000)
_INTEGRAND = (
    _PERSSON_GAMMA + 3 * (1 - _PERSSON_GAMMA) * special.erf(np.exp(_LOG_X)) ** 2
) * np.exp(-np.exp(2 * _LOG_X))
_TABLE = np.concatenate(
    [np.cumsum(((_INTEGRAND[1:] + _INTEGRAND[:-1]) / 2 * np.diff(_LOG_X))[::-1])[::-1], [0.0]]
)


def _bush_gibson_thomas(
    spectrum: SelfAffine | IsotropicSpectrum, E_star: float, pressure: Real
) -> TheoryCurve:
    """Asymptotic area of Bush, Gibson and Thomas, A / A_0 = sqrt(2 pi) p / (E* rms |grad h|).

    References
    ----------
    A. W. Bush, R. D. Gibson and T. R. Thomas, "The elastic contact of a rough surface", Wear 35,
    87-111 (1975).
    """
    slope = moments(spectrum).rms_slope
    return TheoryCurve(
        "bush-gibson-thomas",
        pressure,
        math.sqrt(2 * math.pi) * pressure / (E_star * slope),
        None,
        None,
        "the limit of light loads, summits apart; area high beyond about 1e-4",
    )


def _greenwood_williamson(
    spectrum: SelfAffine | IsotropicSpectrum, E_star: float, pressure: Real
) -> TheoryCurve:
    """Greenwood and Williamson's independent spheres, with summits after Nayak and McCool.

    References
    ----------
    J. A. Greenwood and J. B. P. Williamson, Proc. R. Soc. A 295, 300-319 (1966); J. I. McCool,
    Wear 107, 37-60 (1986).
    """
    found = moments(spectrum)
    density, radius, deviation = found.summit_density, found.summit_radius, found.summit_deviation
    t = np.linspace(-3.0, 12.0, 3000)  # separation over the deviation of the summits
    scale = density * E_star * math.sqrt(radius)
    force = 4 / 3 * scale * deviation**1.5 * _tail(1.5, t)
    if pressure.max() > force[0]:
        limit = f"{force[0] / E_star:.3g} E*"
        raise InputError(
            f"greenwood-williamson has no answer at pressures over {limit}, where its mean planes "
            "cross: leave it out, or take lighter loads"
        )
    at = np.interp(-np.log(pressure), -np.log(force), t)
    return TheoryCurve(
        "greenwood-williamson",
        pressure,
        math.pi * density * radius * deviation * _tail(1.0, at),
        2 * scale * math.sqrt(deviation) * _tail(0.5, at),
        found.summit_mean + deviation * at,
        "light loads; spheres of one radius that do not feel each other; poor for wide spectra, "
        f"here Nayak's parameter is {found.nayak:.3g}",
    )


def _tail(power: float, t: Real) -> Real:
    """Integrate (s - t)^n over the standard normal density from t to infinity."""
    bent = special.pbdv(-power - 1, t)[0]
    return special.gamma(power + 1) / math.sqrt(2 * math.pi) * np.exp(-(t**2) / 4) * bent


def _sampled(spectrum: SelfAffine | IsotropicSpectrum) -> tuple[Real, Real, Real]:
    """Wavenumbers, spectrum and widths of bands for radial integrals."""
    if isinstance(spectrum, IsotropicSpectrum):
        return spectrum.q, spectrum.C_2d, np.full(spectrum.q.size, 2 * math.pi / spectrum.length)
    if math.isinf(spectrum.q_high):
        raise InputError(
            "the spectrum has no upper end, and its slopes are infinite: give q_high, or take the "
            "spectrum of a surface with isotropic_spectrum(surface)"
        )
    low, high = math.log(spectrum.q_low), math.log(spectrum.q_high)
    count = max(400, math.ceil(_PER_DECADE * (high - low) / math.log(10)))
    edges = np.exp(np.linspace(low, high, count + 1))
    q = np.sqrt(edges[1:] * edges[:-1])
    return q, spectrum.C_2d(q), np.diff(edges)


THEORIES: dict[str, Callable[[SelfAffine | IsotropicSpectrum, float, Real], TheoryCurve]] = {
    "persson": _persson,
    "bush-gibson-thomas": _bush_gibson_thomas,
    "greenwood-williamson": _greenwood_williamson,
}
"""By name."""
