"""Engineering answers of a pressed body and two materials: intervals and formulas beside each."""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.engineering import formulas
from roughline.engineering.answer import Answer, answer
from roughline.engineering.declared import DECLARED
from roughline.engineering.intervals import Intervals
from roughline.engineering.pair import MaterialPair
from roughline.topography.body import Surface


def saturated_stiffness(surface: Surface, E_star: float) -> float:
    """Stiffness of the flat punch with the outline and grid of a surface. [N / m]"""
    flat = Surface(np.zeros(surface.shape), surface.sizes, surface.unit, is_cut_out=False)
    depth = math.sqrt(surface.area) * 1e-6
    return float(press(flat, E_star=E_star, depths=[depth]).stiffness[0])


def answers(
    curve: Curve,
    area: float,
    pair: MaterialPair,
    *,
    interface_stiffness: Answer | None = None,
    amplitudes: tuple[float | None, float | None] = (None, None),
    frequency: float | None = None,
    intervals: Intervals | None = None,
) -> list[Answer]:
    """Work out the engineering answers of a curve.

    The interval of an answer follows from its formula, evaluated at both ends of the curve's.

    Parameters
    ----------
    curve : Curve
        In SI units, with the contact modulus of the pair.
    area : float
        Nominal contact area. [m²]
    pair : MaterialPair
        The materials.
    interface_stiffness : Answer, optional
        Stiffness of the interface alone, with its own interval, for a free surface or one that was
        cut out of a larger one. Without it, as for a periodic surface, the contact stiffness is
        taken.
    amplitudes : tuple of float, optional
        Rms height and rms slope of the sum of both surfaces, for estimates from the literature.
        [m], [1]
    frequency : float, optional
        Of an ultrasonic wave. [Hz]
    intervals : Intervals, optional
        Of the curve.
    """
    k, k_u = _stiffnesses(curve, intervals)
    pressure = curve.force / area
    k_i, of_what = k_u, ""
    given = [
        answer("normal_force", curve.force),
        answer("mean_pressure", pressure),
        answer("depth", curve.depth),
        answer("contact_stiffness", k),
        answer("stiffness_per_area", k / area),
    ]
    if curve.hardness is not None:
        given.append(answer("unloading_stiffness", k_u))
    if interface_stiffness is not None:
        k_i, of_what = interface_stiffness.rows, f"; k_i {interface_stiffness.validity}"
        given.append(interface_stiffness)
    if curve.area_fraction_corrected is not None:
        ends = intervals.area if intervals else None
        share = np.stack([curve.area_fraction_corrected, *(ends or ())])
        given += _areas(curve, share, area, pair)
    given += _electric(curve.force, k_u, pair)
    given += _thermal(k_u, k_i / area, of_what, pair)
    given += _thermal_estimates(pressure, pair, amplitudes)
    given.append(answer("tangential_stiffness", pair.G_star / pair.E_star * k_u))
    given += _reflection(k_i / area, of_what, pair, frequency)
    return given


def _stiffnesses(curve: Curve, intervals: Intervals | None) -> tuple[Real, Real]:
    """Stiffness on further loading and on unloading, (1 or 3, loads), with their ends."""
    loading, unloading = (intervals.stiffness, intervals.unloading) if intervals else ((), ())
    k = np.stack([curve.stiffness, *loading])
    if curve.unloading_stiffness is None:  # of a line, which has no yield
        return k, k
    return k, np.stack([curve.unloading_stiffness, *unloading])


def _areas(curve: Curve, share: Real, area: float, pair: MaterialPair) -> list[Answer]:
    """Real contact area, the pressure on it, and what of it yields."""
    with np.errstate(divide="ignore", invalid="ignore"):
        pressure = np.where(curve.force == 0, 0.0, curve.force / (share * area))
    given = [
        answer("contact_area", share * area),
        answer("contact_area_fraction", share),
        answer("contact_pressure", pressure),
    ]
    hardness = curve.hardness or pair.hardness
    if hardness is not None:
        given.append(answer("contact_pressure_over_hardness", pressure / hardness))
    if curve.plastic_fraction is not None and curve.hardness is not None:
        assert curve.indentation is not None
        given += [
            answer("plastic_fraction", curve.plastic_fraction),
            answer("indentation", curve.indentation),
        ]
    return given


def _electric(force: Real, k: Real, pair: MaterialPair) -> list[Answer]:
    """Constriction resistance, and Holm's estimate of it."""
    resistivities = pair.both("resistivity")
    if resistivities is None:
        return []
    with np.errstate(divide="ignore"):
        resistance = formulas.electrical_resistance(k, pair.E_star, resistivities)
    given = [answer("constriction_resistance", resistance)]
    if pair.hardness is not None:
        with np.errstate(divide="ignore"):
            single_spot = formulas.holm_resistance(force, pair.hardness, resistivities)
        given.append(answer("holm_resistance", single_spot))
    return given


def _thermal(k: Real, k_i_per_area: Real, of_what: str, pair: MaterialPair) -> list[Answer]:
    """Thermal conductance of the contact, and of the interface alone."""
    conductivities = pair.both("conductivity")
    if conductivities is None:
        return []
    validity = DECLARED["thermal_conductance_per_area"].validity + of_what
    conductance = formulas.thermal_conductance(k, pair.E_star, conductivities)
    per_area = formulas.thermal_conductance(k_i_per_area, pair.E_star, conductivities)
    return [
        answer("thermal_conductance", conductance),
        answer("thermal_conductance_per_area", per_area, validity=validity),
    ]


def _thermal_estimates(
    pressure: Real, pair: MaterialPair, amplitudes: tuple[float | None, float | None]
) -> list[Answer]:
    """Estimates of the literature for the thermal conductance of the interface."""
    conductivities = pair.both("conductivity")
    rms_height, rms_slope = amplitudes
    if conductivities is None or not rms_height or not rms_slope:
        return []
    shape = (rms_height, rms_slope, conductivities)
    elastic = formulas.mikic_conductance(pressure, pair.E_star, *shape)
    given = [answer("mikic_conductance", elastic)]
    if pair.hardness is not None:
        plastic = formulas.yovanovich_conductance(pressure, pair.hardness, *shape)
        given.append(answer("plastic_conductance", plastic))
    return given


def _reflection(
    k_i_per_area: Real, of_what: str, pair: MaterialPair, frequency: float | None
) -> list[Answer]:
    """Reflection of an ultrasonic wave by the interface."""
    impedances = pair.both("impedance")
    if frequency is None or impedances is None:
        return []
    reflected = formulas.reflection(k_i_per_area, frequency, impedances)
    name = f"{DECLARED['reflection'].name} at {frequency / 1e6:g} MHz"
    validity = DECLARED["reflection"].validity + of_what
    return [answer("reflection", reflected, name=name, validity=validity)]
