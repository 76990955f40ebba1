"""Symbols of the formulas: one meaning each, and each of them on the page that uses it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from roughline.engineering.formulas import harmonic_conductivity
from roughline.engineering.pair import MaterialPair
from roughline.engineering.sealing import Fluid, SealShape


@dataclass(frozen=True)
class _Symbol:
    """A symbol of a formula that is no answer."""

    symbol: str  # as formulas write it
    meaning: str
    unit: str = "1"  # SI
    value: float | None = None  # None where it is not one number [unit]


def symbols_of(
    formulas: Sequence[str],
    pair: MaterialPair,
    *,
    E_star: float,
    hardness: float | None,
    area: float,
    rms_height: float,
    sealing: Fluid | None = None,
) -> list[_Symbol]:
    """The symbols of formulas that are no answers, with their values.

    The area is that of the joint if there is one [m²], the rms height that of the sum of both
    surfaces [m].
    """
    conductivities = pair.at_surfaces("conductivity")
    harmonic = conductivities and harmonic_conductivity(conductivities)
    known = [
        _Symbol("E*", "contact modulus", "Pa", E_star),
        _Symbol("A_0", "nominal area", "m²", area),
        _Symbol("H", "hardness of the softer body", "Pa", hardness),
        *_of_bodies("rho", "electrical resistivity", "Ω m", pair.at_surfaces("resistivity")),
        *_of_bodies("kappa", "thermal conductivity", "W/(m K)", conductivities),
        _Symbol("kappa_s", "their harmonic mean", "W/(m K)", harmonic),
        _Symbol("sigma", "rms height", "m", rms_height),
        _Symbol("m", "mean slope of a profile, the rms slope over sqrt(pi)"),
        _Symbol("G*", "tangential contact modulus", "Pa", pair.G_star),
        *_of_bodies("G", "shear modulus", "Pa", pair.both("shear_modulus")),
        *_of_bodies("nu", "Poisson's ratio", "1", pair.both("nu")),
        _Symbol("U", "elastic energy under the pressures of the contact", "J"),
        _Symbol("U_t", "that of the same pressures on the materials at the surfaces", "J"),
        _Symbol("t", "thickness of a layer", "m"),
        _Symbol("E_c", "E (1 - nu) / ((1 + nu) (1 - 2 nu)) of a layer, which cannot widen", "Pa"),
        _Symbol("k_s", "stiffness of a flat punch of the same outline", "N/m"),
        _Symbol("a_H", "radius of Holm's single spot", "m"),
        *_of_bodies("z", "acoustic impedance", "Pa s/m", pair.both("impedance")),
        _Symbol("omega", "angular frequency of the wave", "1/s"),
        _Symbol("K", "stiffness per area of the interface", "N/m³"),
        _Symbol("i", "imaginary unit"),
        *([] if sealing is None else _of_fluid(sealing)),
    ]
    used = {name for each in formulas for name in _names_in(each)}
    return [each for each in known if used.issuperset(each.symbol.split("/"))]


def _names_in(formula: str) -> set[str]:
    """Return the symbols that a formula names, words of the language left out."""
    names = re.findall(r"[A-Za-z]+(?:_[A-Za-z0]+)?\d?\*?", formula)
    return {name for name in names if not name.isalpha() or name in _LETTERS or name in _GREEK}


_GREEK = {"rho", "kappa", "sigma", "omega", "nu", "eta"}
_LETTERS = {*"ABEFGHKMPRTUWdikmptuwz"}


def _of_fluid(sealing: Fluid) -> list[_Symbol]:
    """The symbols of a fluid and of the seal that it crosses."""
    gas = sealing.gas
    found = [
        *_of_seal(sealing.seal),
        _Symbol("P1", "absolute pressure at the inlet", "Pa", sealing.inlet),
        _Symbol("P2", "absolute pressure at the outlet", "Pa", sealing.outlet),
        _Symbol("eta", f"viscosity of {sealing.medium.name}", "Pa s", sealing.medium.viscosity),
        _Symbol("u", "gap", "m"),
    ]
    if gas is None:
        return found
    pressure = sealing.mean_pressure
    return [
        *found,
        _Symbol("R_s", "specific gas constant", "J/(kg K)", gas.gas_constant),
        _Symbol("T", "temperature of the gas", "K", gas.temperature),
        _Symbol("k_g", "thermal conductivity of the gas", "W/(m K)", gas.conductivity),
        _Symbol("M", "temperature jump length", "m", gas.temperature_jump(pressure)),
    ]


def _of_seal(seal: SealShape | None) -> list[_Symbol]:
    """The symbols of the face that a fluid crosses; of a ring they have no value of their own."""
    if seal is not None and seal.is_ring:
        meaning = "of the ring, whose radii are r and R: 2 pi / ln(R/r)"
        return [_Symbol("W/B", meaning, "1", seal.ratio)]
    length, width = (None, None) if seal is None else (seal.width, seal.width / seal.ratio)
    return [
        _Symbol("W", "length of the seal across the flow", "m", length),
        _Symbol("B", "width of the seal along the flow", "m", width),
    ]


def _of_bodies(
    letter: str, meaning: str, unit: str, values: tuple[float, float] | None
) -> list[_Symbol]:
    """The symbols of a property of both bodies."""
    which = ("first", "second")
    return [
        _Symbol(f"{letter}{i + 1}", f"{meaning} of the {which[i]} body", unit, values and values[i])
        for i in range(2)
    ]
