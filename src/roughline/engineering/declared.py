"""All answers that can be given: name, unit, formula, validity and source of each."""

from __future__ import annotations

from dataclasses import dataclass

from roughline.engineering.formulas import ELASTIC_UP_TO

_IN_VACUUM = "solid spots alone, as in vacuum: gas in the gap adds to it"


@dataclass(frozen=True)
class Declaration:
    """One answer, before its values are known.

    Attributes
    ----------
    name, symbol, unit : str
        What it is called in tables and formulas; the unit is SI.
    formula : str
        How it follows from the curve.
    validity : str
        Where the formula holds.
    source : str
        Publication of the formula.
    growth : float
        Power of the nominal area with which it grows where every place carries the same mean
        pressure; 0 for what does not grow.
    """

    name: str
    symbol: str
    unit: str
    formula: str
    validity: str = ""
    source: str = ""
    growth: float = 0.0


DECLARED = {
    "normal_force": Declaration("normal force", "F", "N", "given, or F(d)", growth=1),
    "mean_pressure": Declaration("mean pressure", "p", "Pa", "F / A_0, A_0 the nominal area"),
    "depth": Declaration("approach since touch", "d", "m", "of remote points"),
    "contact_stiffness": Declaration(
        "contact stiffness",
        "k",
        "N/m",
        "dF/dd at frozen contact on further loading, exact",
        "without friction or adhesion; where metals yield, points at the hardness bear no more",
        growth=1,
    ),
    "stiffness_per_area": Declaration("stiffness per area", "k/A_0", "N/m³", "k / A_0"),
    "unloading_stiffness": Declaration(
        "unloading stiffness",
        "k_u",
        "N/m",
        "dF/dd at frozen contact on unloading, exact",
        "all of the contact springs back; this stiffness governs vibration, ultrasound and "
        "currents",
        "Almqvist et al. 2007",
        growth=1,
    ),
    "interface_stiffness": Declaration(
        "interface stiffness",
        "k_i",
        "N/m",
        "1/k_i = 1/k_u - 1/k_s, on unloading; k_s of the flat punch",
        growth=1,
    ),
    "contact_area": Declaration(
        "real contact area",
        "A",
        "m²",
        "cells in contact, corrected for the outline's steps",
        "falls with every finer wave; the shortest wave of the grid is the finest here",
        "Yastrebov, Anciaux and Molinari 2017",
        growth=1,
    ),
    "contact_area_fraction": Declaration("contact area fraction", "A/A_0", "1", "A / A_0"),
    "contact_pressure": Declaration(
        "mean contact pressure",
        "p_c",
        "Pa",
        "F / A",
        "at most the hardness of the softer body",
    ),
    "plastic_fraction": Declaration(
        "yielded share of the contact",
        "A_p/A",
        "1",
        "cells at the hardness over cells in contact",
        "elastic, perfectly plastic: no hardening, no pile-up",
        "Almqvist et al. 2007",
    ),
    "indentation": Declaration(
        "largest permanent indentation",
        "w",
        "m",
        "overlap at points at the hardness, which lowers the surface permanently",
        "at one point; the finest summits on the grid decide it",
        "Almqvist et al. 2007",
    ),
    "contact_pressure_over_hardness": Declaration(
        "contact pressure over hardness",
        "p_c/H",
        "1",
        "F / (A H), H of the softer body",
        f"elastic below {ELASTIC_UP_TO:g}, all of the contact yields at 1",
    ),
    "constriction_resistance": Declaration(
        "constriction resistance",
        "R",
        "ohm",
        "E* (rho1 + rho2) / (2 k_u)",
        "clean metal; films add to it. k_u, as current spreads from the contact spots like the "
        "displacement on unloading, however the spots were formed",
        "Barber 2003",
        growth=-1,
    ),
    "specific_contact_resistance": Declaration(
        "specific contact resistance",
        "rho_c",
        "ohm m²",
        "R A_0, A_0 the nominal area of the joint",
        "of the interface alone; clean metal",
        "Barber 2003",
    ),
    "holm_resistance": Declaration(
        "Holm's single-spot estimate",
        "R_Holm",
        "ohm",
        "(rho1 + rho2) / (4 a_H), pi a_H² = F / H",
        "for comparison: all of the load on one plastic spot; separate spots have less resistance, "
        "and elastic spots, which are smaller, have more",
        "Holm 1967",
        growth=-0.5,
    ),
    "thermal_conductance": Declaration(
        "thermal conductance in vacuum",
        "G",
        "W/K",
        "kappa_s k_u / E*, kappa_s = 2 kappa1 kappa2 / (kappa1 + kappa2)",
        f"{_IN_VACUUM}. k_u, as heat spreads from the contact spots however they were formed",
        "Barber 2003",
        growth=1,
    ),
    "thermal_conductance_per_area": Declaration(
        "thermal conductance per area in vacuum",
        "h_c",
        "W/(m² K)",
        "kappa_s k_i / (E* A_0)",
        f"{_IN_VACUUM}. Without the bodies' constriction to A_0, like k_i",
        "Barber 2003",
    ),
    "mikic_conductance": Declaration(
        "Mikic's elastic estimate",
        "h_Mikic",
        "W/(m² K)",
        "1.55 kappa_s m/sigma (sqrt(2) p/(E* m))^0.94",
        f"{_IN_VACUUM}. Gaussian heights, light loads, no large waves",
        "Mikic 1974",
    ),
    "plastic_conductance": Declaration(
        "plastic estimate",
        "h_CMY",
        "W/(m² K)",
        "1.25 kappa_s m/sigma (p/H)^0.95",
        f"{_IN_VACUUM}. Gaussian heights, all contact plastic",
        "Yovanovich 2005",
    ),
    "tangential_stiffness": Declaration(
        "tangential stiffness",
        "k_t",
        "N/m",
        "k_u G*/E*, 1/G* = (2 - nu1)/(4 G1) + (2 - nu2)/(4 G2)",
        "before any slip; normal and tangential problems uncoupled; k_u, as a small shear causes "
        "no yield",
        "Popov 2017, ch. 8",
        growth=1,
    ),
    "reflection": Declaration(
        "reflection",
        "|r|",
        "1",
        "|z1 - z2 + i omega z1 z2 / K| / |z1 + z2 + i omega z1 z2 / K|, K = k_i / A_0",
        "longitudinal plane waves much longer than the distances between contact spots; k_u, as "
        "their amplitude is small, so that all of the contact springs back",
        "Tattersall 1973",
    ),
}
"""By key."""
