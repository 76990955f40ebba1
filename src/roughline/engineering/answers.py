"""Engineering answers of a pressed body and two materials: intervals and formulas beside each."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.engineering import formulas
from roughline.engineering.pair import MaterialPair
from roughline.topography.body import Surface
from roughline.units import decimal

Ends = tuple[Real, Real]


@dataclass(frozen=True, eq=False)
class Answer:
    """One quantity over the loads.

    Attributes
    ----------
    name, symbol, unit : str
        What it is; the unit is SI.
    values : ndarray, shape (loads,)
        NaN where a load was not solved. [unit]
    low, high : ndarray, shape (loads,), or None
        Ends of the interval that is known; what else is uncertain is not in it. [unit]
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
    low: Real | None
    high: Real | None
    formula: str
    validity: str = ""
    source: str = ""

    @property
    def rows(self) -> Real:
        """Values, and both ends where they are known, (1 or 3, loads). [unit]"""
        ends = () if self.low is None or self.high is None else (self.low, self.high)
        return np.stack([self.values, *ends])

    def at(self, loads: NDArray[np.intp]) -> Answer:
        """The same at some of the loads, by their numbers."""
        values, *ends = self.rows[:, loads]
        low, high = ends or (None, None)
        return replace(self, values=values, low=low, high=high)


def saturated_stiffness(surface: Surface, E_star: float) -> float:
    """Stiffness of the flat punch with the outline and grid of a surface. [N / m]"""
    flat = Surface(np.zeros(surface.shape), surface.sizes, surface.unit)
    depth = math.sqrt(surface.area) * 1e-6
    return float(press(flat, E_star=E_star, depths=[depth]).stiffness[0])


def answers(
    curve: Curve,
    area: float,
    pair: MaterialPair,
    *,
    interface_stiffness: Answer | None = None,
    rms_height: float | None = None,
    rms_slope: float | None = None,
    frequency: float | None = None,
    stiffness_interval: Ends | None = None,
    area_interval: Ends | None = None,
) -> list[Answer]:
    """Work out what follows from a curve.

    An interval is carried on by evaluating each formula at its two ends.

    Parameters
    ----------
    curve : Curve
        In SI units, with the contact modulus of the pair.
    area : float
        Nominal contact area. [m²]
    pair : MaterialPair
        The materials.
    interface_stiffness : Answer, optional
        Of the interface alone, with its own interval, for a free surface or one that was cut out of
        a larger one; without it, as for a surface that is periodic, it is the contact stiffness.
    rms_height, rms_slope : float, optional
        Of the sum of both surfaces, for the estimates of the literature. [m], [1]
    frequency : float, optional
        Of an ultrasonic wave. [Hz]
    stiffness_interval, area_interval : tuple of ndarray, shape (loads,), optional
        Both ends, of stiffness [N / m] and of the area fraction [1].
    """
    k = np.stack([curve.stiffness, *(stiffness_interval or ())])
    pressure = curve.force / area
    found = [
        _answer("normal force", "F", "N", curve.force, "given, or F(d)"),
        _answer("mean pressure", "p", "Pa", pressure, "F / A_0, A_0 the nominal area"),
        _answer("approach since touch", "d", "m", curve.depth, "of remote points"),
        _answer(
            "contact stiffness",
            "k",
            "N/m",
            k,
            "dF/dd at frozen contact, exact",
            "elastic, without friction or adhesion",
        ),
        _answer("stiffness per area", "k/A_0", "N/m³", k / area, "k / A_0"),
    ]
    own, whose = k, ""
    if interface_stiffness is not None:
        found.append(interface_stiffness)
        own, whose = interface_stiffness.rows, f"; k_i {interface_stiffness.validity}"
    if curve.area_fraction_corrected is not None:
        share = np.stack([curve.area_fraction_corrected, *(area_interval or ())])
        found += _areas(curve.force, share, area, pair)
    found += _electric(curve.force, k, pair)
    found += _thermal(pressure, k, own / area, whose, pair, (rms_height, rms_slope))
    found.append(
        _answer(
            "tangential stiffness",
            "k_t",
            "N/m",
            pair.G_star / pair.E_star * k,
            "k G*/E*, 1/G* = (2 - nu1)/(4 G1) + (2 - nu2)/(4 G2)",
            "before any slip; normal and tangential problems uncoupled",
            "Popov 2017, ch. 8",
        )
    )
    impedances = pair.both("impedance")
    if frequency is not None and impedances is not None:
        found.append(
            _answer(
                f"reflection at {frequency / 1e6:g} MHz",
                "|R|",
                "1",
                formulas.reflection(own / area, frequency, impedances),
                "|z1 - z2 + i w z1 z2 / K| / |z1 + z2 + i w z1 z2 / K|, K = k_i / A_0",
                "longitudinal plane waves much longer than the distances of contact spots" + whose,
                "Tattersall 1973",
            )
        )
    return found


def _answer(
    name: str,
    symbol: str,
    unit: str,
    rows: Real,
    formula: str,
    validity: str = "",
    source: str = "",
) -> Answer:
    """Make an answer from values, or from rows of values and of both ends of their interval."""
    values, *ends = np.atleast_2d(rows)
    low, high = (np.minimum(*ends), np.maximum(*ends)) if ends else (None, None)
    return Answer(name, symbol, unit, values, low, high, formula, validity, source)


def _areas(force: Real, share: Real, area: float, pair: MaterialPair) -> list[Answer]:
    with np.errstate(divide="ignore", invalid="ignore"):
        pressure = force / (share * area)
    found = [
        _answer(
            "real contact area",
            "A",
            "m²",
            share * area,
            "cells in contact, corrected for the outline's steps",
            "falls with every finer wave; the grid's shortest is the last here",
            "Yastrebov, Anciaux and Molinari 2017",
        ),
        _answer("contact area fraction", "A/A_0", "1", share, "A / A_0"),
        _answer(
            "mean contact pressure",
            "p_c",
            "Pa",
            pressure,
            "F / A",
            "elastic; no body bears more than its hardness",
        ),
    ]
    if pair.hardness is not None:
        found.append(
            _answer(
                "contact pressure over hardness",
                "p_c/H",
                "1",
                pressure / pair.hardness,
                "F / (A H), H of the softer body",
                f"elastic below {formulas.ELASTIC_UP_TO:g}, plastic near 1",
            )
        )
    return found


def _electric(force: Real, k: Real, pair: MaterialPair) -> list[Answer]:
    resistivities = pair.both("resistivity")
    if resistivities is None:
        return []
    with np.errstate(divide="ignore"):
        resistance = formulas.electrical_resistance(k, pair.E_star, resistivities)
    found = [
        _answer(
            "constriction resistance",
            "R",
            "ohm",
            resistance,
            "E* (rho1 + rho2) / (2 k)",
            "clean metal; films add to it",
            "Barber 2003",
        )
    ]
    if pair.hardness is not None:
        found.append(
            _answer(
                "Holm's single-spot estimate",
                "R_Holm",
                "ohm",
                formulas.holm_resistance(force, pair.hardness, resistivities),
                "(rho1 + rho2) / (4 a), pi a² = F / H",
                "for comparison: all of the load on one plastic spot; spots apart resist less, and "
                "elastic ones, which are smaller, more",
                "Holm 1967",
            )
        )
    return found


def _thermal(
    pressure: Real,
    k: Real,
    own_per_area: Real,
    whose: str,
    pair: MaterialPair,
    amplitudes: tuple[float | None, float | None],
) -> list[Answer]:
    conductivities = pair.both("conductivity")
    if conductivities is None:
        return []
    found = [
        _answer(
            "thermal conductance",
            "G",
            "W/K",
            formulas.thermal_conductance(k, pair.E_star, conductivities),
            "kappa_s k / E*, kappa_s = 2 kappa1 kappa2 / (kappa1 + kappa2)",
            "solid spots alone, in vacuum",
            "Barber 2003",
        ),
        _answer(
            "thermal conductance per area",
            "h_c",
            "W/(m² K)",
            formulas.thermal_conductance(own_per_area, pair.E_star, conductivities),
            "kappa_s k_i / (E* A_0)",
            f"the same without the bodies' constriction to A_0, as k_i is{whose}",
            "Barber 2003",
        ),
    ]
    rms_height, rms_slope = amplitudes
    if not rms_height or not rms_slope:
        return found
    shape = (rms_height, rms_slope, conductivities)
    found.append(
        _answer(
            "Mikic's elastic estimate",
            "h_Mikic",
            "W/(m² K)",
            formulas.mikic_conductance(pressure, pair.E_star, *shape),
            "1.55 kappa_s m/sigma (sqrt(2) p/(E* m))^0.94",
            "Gaussian heights, light loads, no large waves",
            "Mikic 1974",
        )
    )
    if pair.hardness is not None:
        found.append(
            _answer(
                "plastic estimate",
                "h_CMY",
                "W/(m² K)",
                formulas.yovanovich_conductance(pressure, pair.hardness, *shape),
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
            if worst > formulas.ELASTIC_UP_TO:
                warnings.append(
                    f"the mean contact pressure reaches {decimal(worst, 2)} of the softer body's "
                    "hardness; "
                    f"beyond {formulas.ELASTIC_UP_TO:g} the summits yield: area and conductance "
                    "are then larger than these elastic ones, towards the plastic estimates"
                )
    if plasticity is not None and plasticity > 1:
        warnings.append(
            f"the plasticity index is {decimal(plasticity, 2)}, over 1: summits yield at first "
            "touch; under repeated loads they deform elastically about their flattened shape"
        )
    return warnings


def left_out(pair: MaterialPair, frequency: float | None) -> list[str]:
    """Say which answers :func:`answers` leaves out because a material lacks a value.

    Parameters
    ----------
    pair : MaterialPair
        The materials.
    frequency : float or None
        Of an ultrasonic wave, if its reflection is wanted. [Hz]
    """
    needed = {
        "hardness": "no contact pressure over hardness, and no estimates with it",
        "resistivity": "no constriction resistance",
        "conductivity": "no thermal conductance",
    }
    found = []
    if frequency is not None and not all(each.carries_sound for each in (pair.first, pair.second)):
        found.append("no reflection: a rigid or an incompressible body carries no such wave")
    elif frequency is not None:
        needed["density"] = "no reflection"
    for quantity, answer in needed.items():
        if lacking := pair.lacking(quantity):
            found.append(
                f"{answer}: the {quantity} of {' and of '.join(lacking)} is not known; give it "
                f'with the material, as "{quantity}=..."'
            )
    return found
