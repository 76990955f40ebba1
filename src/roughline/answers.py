"""Engineering answers of a pressed body and two materials, each with its error and its formula."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline import interface
from roughline.contact import press
from roughline.curve import Curve
from roughline.materials import Material, contact_modulus, tangential_modulus
from roughline.topography import Surface

Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Answer:
    """One quantity over the loads.

    Attributes
    ----------
    name, symbol, unit : str
        What it is; the unit is SI.
    values : ndarray, shape (loads,)
        NaN where a load was not solved. [unit]
    error : ndarray, shape (loads,), or None
        What is known to be uncertain, as half the width of an interval. [unit]
    formula : str
        How it follows.
    validity : str
        Where it holds.
    source : str
        Where it is from.
    """

    name: str
    symbol: str
    unit: str
    values: Real
    error: Real | None
    formula: str
    validity: str = ""
    source: str = ""


@dataclass(frozen=True, eq=False)
class Interface:
    """Two bodies of given materials in contact.

    Parameters
    ----------
    first, second : Material
        The rough body and the one that it is pressed into; which is which does not matter.
    """

    first: Material
    second: Material

    @property
    def E_star(self) -> float:
        """Contact modulus. [Pa]"""
        return contact_modulus(self.first, self.second)

    @property
    def G_star(self) -> float:
        """Tangential contact modulus. [Pa]"""
        return tangential_modulus(self.first, self.second)

    @property
    def hardness(self) -> float | None:
        """Hardness of the softer body, None if it is not known of both. [Pa]

        A rigid body never yields.
        """
        known = [each.hardness for each in (self.first, self.second) if not math.isinf(each.E)]
        return min(value for value in known if value) if known and all(known) else None

    def both(self, quantity: str) -> tuple[float, float] | None:
        """Return a property of both, None unless both are known."""
        first, second = getattr(self.first, quantity), getattr(self.second, quantity)
        return None if first is None or second is None else (first, second)


def saturated_stiffness(surface: Surface, E_star: float) -> float:
    """Stiffness of the flat punch with the outline and grid of a surface. [N / m]"""
    flat = Surface(np.zeros(surface.shape), surface.sizes, surface.unit)
    depth = math.sqrt(surface.area) * 1e-6
    return float(press(flat, E_star=E_star, depths=[depth]).stiffness[0])


def answers(
    curve: Curve,
    area: float,
    pair: Interface,
    *,
    saturated: float | None = None,
    rms_height: float | None = None,
    rms_slope: float | None = None,
    frequency: float | None = None,
    stiffness_error: ArrayLike | None = None,
    area_error: ArrayLike | None = None,
) -> list[Answer]:
    """Work out what follows from a curve.

    Parameters
    ----------
    curve : Curve
        In SI units, with the contact modulus of the pair.
    area : float
        Nominal contact area. [m²]
    pair : Interface
        The materials.
    saturated : float, optional
        Stiffness of the flat punch of the same outline, for a free surface; without it, as for a
        periodic one, the stiffness is the interface's own. [N / m]
    rms_height, rms_slope : float, optional
        Of the sum of both surfaces, for the estimates of the literature. [m], [1]
    frequency : float, optional
        Of an ultrasonic wave. [Hz]
    stiffness_error, area_error : array_like, shape (loads,), optional
        Half widths of intervals of stiffness [N / m] and area fraction [1].
    """
    k, E_star = curve.stiffness, pair.E_star
    dk = None if stiffness_error is None else np.asarray(stiffness_error, dtype=np.float64)
    found = [
        Answer("normal force", "F", "N", curve.force, None, "given, or F(d)"),
        Answer(
            "mean pressure", "p", "Pa", curve.force / area, None, "F / A_0, A_0 the nominal area"
        ),
        Answer("approach since touch", "d", "m", curve.depth, None, "of remote points"),
        Answer(
            "contact stiffness",
            "k",
            "N/m",
            k,
            dk,
            "dF/dd at frozen contact, exact",
            "elastic, without friction or adhesion",
        ),
        Answer("stiffness per area", "k/A_0", "N/m³", k / area, _times(dk, 1 / area), "k / A_0"),
    ]
    own, own_error = k, dk
    if saturated is not None:
        own = interface.interface_stiffness(k, saturated)
        own_error = None if dk is None else dk * (own / k) ** 2
        found.append(
            Answer(
                "interface stiffness",
                "k_i",
                "N/m",
                own,
                own_error,
                "1/k_i = 1/k - 1/k_s, k_s of the flat punch",
                "without the bodies' own compliance; uncertain near full contact",
            )
        )
    if curve.area_fraction_corrected is not None:
        found += _areas(curve, area, pair, area_error)
    found += _electric(curve, pair, dk)
    found += _thermal(curve, area, pair, dk, own, own_error, rms_height, rms_slope)
    ratio = pair.G_star / E_star
    found.append(
        Answer(
            "tangential stiffness",
            "k_t",
            "N/m",
            ratio * k,
            _times(dk, ratio),
            "k G*/E*, 1/G* = (2 - nu1)/(4 G1) + (2 - nu2)/(4 G2)",
            "before any slip; normal and tangential problems uncoupled",
            "Popov 2017, ch. 8",
        )
    )
    impedances = pair.both("impedance")
    if frequency is not None and impedances is not None:
        found.append(
            Answer(
                f"reflection at {frequency / 1e6:g} MHz",
                "|R|",
                "1",
                interface.reflection(own / area, frequency, impedances),
                None,
                "|z1 - z2 + i w z1 z2 / K| / |z1 + z2 + i w z1 z2 / K|, K = k_i / A_0",
                "longitudinal plane waves much longer than the distances of contact spots",
                "Tattersall 1973",
            )
        )
    return found


def _areas(
    curve: Curve, area: float, pair: Interface, area_error: ArrayLike | None
) -> list[Answer]:
    assert curve.area_fraction_corrected is not None
    share = curve.area_fraction_corrected
    error = None if area_error is None else np.asarray(area_error, dtype=np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):
        pressure = curve.force / (share * area)
        relative = None if error is None else error / share
    found = [
        Answer(
            "real contact area",
            "A",
            "m²",
            share * area,
            _times(error, area),
            "cells in contact, corrected for the outline's steps",
            "falls with every finer wave; the grid's shortest is the last here",
            "Yastrebov, Anciaux and Molinari 2017",
        ),
        Answer("contact area fraction", "A/A_0", "1", share, error, "A / A_0"),
        Answer(
            "mean contact pressure",
            "p_c",
            "Pa",
            pressure,
            None if relative is None else pressure * relative,
            "F / A",
            "elastic; no body bears more than its hardness",
        ),
    ]
    if pair.hardness is not None:
        found.append(
            Answer(
                "contact pressure over hardness",
                "p_c/H",
                "1",
                pressure / pair.hardness,
                None if relative is None else pressure / pair.hardness * relative,
                "F / (A H), H of the softer body",
                f"elastic below {interface.ELASTIC_UP_TO:g}, plastic near 1",
            )
        )
    return found


def _electric(curve: Curve, pair: Interface, dk: Real | None) -> list[Answer]:
    resistivities = pair.both("resistivity")
    if resistivities is None:
        return []
    resistance = interface.electrical_resistance(curve.stiffness, pair.E_star, resistivities)
    found = [
        Answer(
            "constriction resistance",
            "R",
            "ohm",
            resistance,
            None if dk is None else resistance * dk / curve.stiffness,
            "E* (rho1 + rho2) / (2 k)",
            "clean metal; films add to it",
            "Barber 2003",
        )
    ]
    if pair.hardness is not None:
        found.append(
            Answer(
                "Holm's estimate",
                "R_Holm",
                "ohm",
                interface.holm_resistance(curve.force, pair.hardness, resistivities),
                None,
                "(rho1 + rho2) / (4 a), pi a² = F / H",
                "one plastic spot, whatever the roughness",
                "Holm 1967",
            )
        )
    return found


def _thermal(
    curve: Curve,
    area: float,
    pair: Interface,
    dk: Real | None,
    own: Real,
    own_error: Real | None,
    rms_height: float | None,
    rms_slope: float | None,
) -> list[Answer]:
    conductivities = pair.both("conductivity")
    if conductivities is None:
        return []
    kappa = interface.harmonic_conductivity(conductivities)
    per_area = interface.thermal_conductance(own / area, pair.E_star, conductivities)
    found = [
        Answer(
            "thermal conductance",
            "G",
            "W/K",
            interface.thermal_conductance(curve.stiffness, pair.E_star, conductivities),
            None if dk is None else interface.thermal_conductance(dk, pair.E_star, conductivities),
            "kappa_s k / E*, kappa_s = 2 kappa1 kappa2 / (kappa1 + kappa2)",
            "solid spots alone, in vacuum",
            "Barber 2003",
        ),
        Answer(
            "interface conductance per area",
            "h_c",
            "W/(m² K)",
            per_area,
            None if own_error is None else own_error * (kappa / (pair.E_star * area)),
            "kappa_s k_i / (E* A_0)",
            "solid spots alone, in vacuum",
            "Barber 2003",
        ),
    ]
    if not rms_height or not rms_slope:
        return found
    pressure = curve.force / area
    shape = (rms_height, rms_slope, conductivities)
    found.append(
        Answer(
            "Mikic's elastic estimate",
            "h_Mikic",
            "W/(m² K)",
            interface.mikic_conductance(pressure, pair.E_star, *shape),
            None,
            "1.55 kappa_s m/sigma (sqrt(2) p/(E* m))^0.94",
            "Gaussian heights, light loads, no large waves",
            "Mikic 1974",
        )
    )
    if pair.hardness is not None:
        found.append(
            Answer(
                "plastic estimate",
                "h_CMY",
                "W/(m² K)",
                interface.yovanovich_conductance(pressure, pair.hardness, *shape),
                None,
                "1.25 kappa_s m/sigma (p/H)^0.95",
                "Gaussian heights, all contact plastic",
                "Yovanovich 2005",
            )
        )
    return found


def elastic_warnings(found: Sequence[Answer], plasticity: float | None) -> list[str]:
    """Say where the elastic assumption breaks.

    Parameters
    ----------
    found : sequence of Answer
        Of one curve.
    plasticity : float or None
        Greenwood and Williamson's index.
    """
    warnings = []
    for each in found:
        if each.symbol == "p_c/H" and np.isfinite(each.values).any():
            worst = float(np.nanmax(each.values))
            if worst > interface.ELASTIC_UP_TO:
                warnings.append(
                    f"the mean contact pressure reaches {worst:.2g} of the softer body's hardness; "
                    f"beyond {interface.ELASTIC_UP_TO:g} the summits yield: area and conductance "
                    "are then larger than these elastic ones, towards the plastic estimates"
                )
    if plasticity is not None and plasticity > 1:
        warnings.append(
            f"the plasticity index is {plasticity:.2g}, over 1: summits yield at first touch; "
            "under repeated loads they deform elastically about their flattened shape"
        )
    return warnings


def _times(error: Real | None, factor: float | Real) -> Real | None:
    return None if error is None else np.asarray(error * factor)
