"""Analytical theories of rough contact, evaluated for a roughness: to lie beside the full model.

None of them knows the half-space's edges: they hold per nominal area, for periodic or very large
surfaces.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.spectra.moments import SurfaceOrSpectrum, bands, moments
from roughline.spectra.self_affine import SelfAffine

_PERSSON_GAMMA = 0.45  # Yang and Persson 2008
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)  # within a band


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


def theory(
    name: str,
    roughness: SurfaceOrSpectrum,
    E_star: float,
    pressure: ArrayLike,
) -> TheoryCurve:
    """Evaluate a theory for a surface or a spectrum.

    Parameters
    ----------
    name : {"persson", "bush-gibson-thomas", "greenwood-williamson"}
        Which.
    roughness : Surface, LatticeSpectrum, IsotropicSpectrum, ContinuumSpectrum or SelfAffine
        A surface, with its own waves; ``spectrum.lattice(n)``, with those that generated surfaces
        have; ``spectrum.continuum``, or the spectrum itself, with integrals up to ``q_high``.
        ``validity`` says so where a SelfAffine's integrals are more than 5 % off its surfaces.
        [length]
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
    curve = THEORIES[name](roughness, E_star, pressures)
    if isinstance(roughness, SelfAffine) and (difference := roughness.off_its_surfaces()):
        validity = (
            f"{curve.validity}; of the continuum, with {difference} of the surfaces that this "
            "spectrum generates: take spectrum.lattice(n) for these"
        )
        return replace(curve, validity=validity)
    return curve


def refuse_unknown(name: str) -> None:
    """Refuse a name that no theory has.

    Raises
    ------
    InputError
        With the names that there are.
    """
    if name not in THEORIES:
        raise InputError(f"no theory is called {name!r}; there are {', '.join(THEORIES)}")


def _persson(roughness: SurfaceOrSpectrum, E_star: float, pressure: Real) -> TheoryCurve:
    """Persson's theory, with Yang and Persson's share of elastic energy, gamma = 0.45.

    References
    ----------
    B. N. J. Persson, "Relation between interfacial separation and load", PRL 99, 125502 (2007),
    eqs. 10-13; C. Yang and B. N. J. Persson, "Contact mechanics: contact area and interfacial
    separation from small contact to full contact", J. Phys.: Condens. Matter 20, 215214 (2008).
    """
    found = bands(roughness)
    # With t² = pi int q³ C dq up to q, the integrals over q are sums over bands of one over t:
    # a band may carry much of the slopes, as the longest waves do.
    ends = np.sqrt(np.cumsum(found.q**2 * found.power / 2))
    starts = np.concatenate([[0.0], ends[:-1]])
    half = (ends - starts)[:, np.newaxis] / 2
    t = (ends + starts)[:, np.newaxis] / 2 + half * _NODES
    weight = 2 / math.sqrt(math.pi) / found.q[:, np.newaxis] * half * _WEIGHTS
    gap, compliance = np.empty((2, pressure.size))
    for i, p in enumerate(pressure / E_star):
        # int_p^inf dp'/p' [gamma + 3 (1 - gamma) P²] exp(-(p'/t)²), P = erf(p'/t)
        gap[i] = float((weight * _energy(p / t)).sum())
        share = _PERSSON_GAMMA + 3 * (1 - _PERSSON_GAMMA) * special.erf(p / t) ** 2
        compliance[i] = float((weight * share * np.exp(-((p / t) ** 2))).sum()) / p
    with np.errstate(divide="ignore"):
        stiffness = E_star / compliance
    return TheoryCurve(
        "persson",
        pressure,
        special.erf(pressure / (E_star * ends[-1])),
        stiffness,
        gap,
        "all loads, Gaussian random surfaces; area 20-30 % low at light loads; stiffness, in the "
        "mean over surfaces, within 20 % from 4 to 60 % contact if the roll-off is at 2 q_0 or "
        "more; without one 10 % less to 26 % more is found, and a single surface is 0.75 to 1.5 "
        "times as stiff",
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


def _bush_gibson_thomas(roughness: SurfaceOrSpectrum, E_star: float, pressure: Real) -> TheoryCurve:
    """Asymptotic area of Bush, Gibson and Thomas, A / A_0 = sqrt(2 pi) p / (E* rms |grad h|).

    References
    ----------
    A. W. Bush, R. D. Gibson and T. R. Thomas, "The elastic contact of a rough surface", Wear 35,
    87-111 (1975).
    """
    slope = moments(roughness).rms_slope
    return TheoryCurve(
        "bush-gibson-thomas",
        pressure,
        math.sqrt(2 * math.pi) * pressure / (E_star * slope),
        None,
        None,
        "the limit of light loads, summits apart; area high beyond about 1e-4",
    )


def _greenwood_williamson(
    roughness: SurfaceOrSpectrum, E_star: float, pressure: Real
) -> TheoryCurve:
    """Greenwood and Williamson's independent spheres, with summits after Nayak and McCool.

    References
    ----------
    J. A. Greenwood and J. B. P. Williamson, Proc. R. Soc. A 295, 300-319 (1966); J. I. McCool,
    Wear 107, 37-60 (1986).
    """
    found = moments(roughness)
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


THEORIES: dict[str, Callable[[SurfaceOrSpectrum, float, Real], TheoryCurve]] = {
    "persson": _persson,
    "bush-gibson-thomas": _bush_gibson_thomas,
    "greenwood-williamson": _greenwood_williamson,
}
"""By name."""

PERSSON_KAPPA = math.sqrt(8 / math.pi)
"""A E* rms_slope / F at light loads, in Persson's theory."""

BGT_KAPPA = math.sqrt(2 * math.pi)
"""A E* rms_slope / F at light loads, in the theory of Bush, Gibson and Thomas."""
