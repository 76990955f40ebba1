"""The curve of one body as a table, and the formulas of its answers with their symbols."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from roughline.contact.curve import SurfaceCurve
from roughline.contact.quantities import QUANTITIES
from roughline.contact.status import Status
from roughline.engineering.coated import Coated
from roughline.report.answers import starred
from roughline.report.typeset import formula_in_symbols
from roughline.report.values import Write, value_and_interval, with_interval
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.computing.arrays import Real
    from roughline.engineering.coated import Solid
    from roughline.engineering.intervals import Ends
    from roughline.engineering.material import Material
    from roughline.engineering.pair import MaterialPair

_SI = {name: QUANTITIES[name].unit_in("m") or "" for name in ("depth", "force", "stiffness")}


def curve_table(assessment: Assessment) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of a curve in SI units; a star marks loads that the grid decides.

    Force and stiffness are the joint's, where its area is given. With a hardness, the stiffness on
    unloading takes the place of the raw area.
    """
    curve, scale, known = assessment.curve_as_asked, assessment.scale, assessment.intervals_as_asked
    force = assessment.load_on(curve.force)
    loading: Ends | None = None
    unloading: Ends | None = None
    area: Ends | None = None
    if known is not None:
        loading, unloading, area = known.stiffness, known.unloading, known.area
    header = ["load", "depth", "force", "stiffness k"]
    if curve.hardness is not None:
        header += ["unloading k_u", "corrected A/A_0"]
    elif isinstance(curve, SurfaceCurve):
        header += ["raw area", "corrected A/A_0"]
    rows = []
    for i, heading in enumerate(starred(assessment)):
        if not curve.converged[i]:
            reason = Status(curve.status[i]).reason
            rows.append([heading, "-", "-", reason, "-", "-"][: len(header)])
            continue
        row = [
            heading,
            engineering(curve.depth[i], _SI["depth"]),
            engineering(scale * force[i], _SI["force"]),
            _stiffness(curve.stiffness, loading, i, scale),
        ]
        if isinstance(curve, SurfaceCurve):
            if curve.hardness is not None:
                row.append(_stiffness(curve.unloading_stiffness, unloading, i, scale))
            else:
                row.append(f"{curve.area_fraction[i]:.3%}")
            share = float(curve.area_fraction_corrected[i])
            row.append(with_interval(share, _at(area, i), "%"))
        rows.append(row)
    return header, rows


def formula_table(assessment: Assessment) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the answers' formulas, where they hold and their sources."""
    rows = [
        [
            f"{each.name} {each.symbol}",
            formula_in_symbols(each.formula),
            each.validity,
            each.source,
        ]
        for each in assessment.answers.values()
    ]
    return ["", "formula", "validity", "source"], rows


def symbol_table(assessment: Assessment) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the symbols of the formulas that are no answers."""
    header = ["symbol", "meaning", "value"]
    by_symbol = {
        each.symbol: each for answer in assessment.answers.values() for each in answer.symbols
    }
    rows = [
        [
            formula_in_symbols(each.symbol),
            formula_in_symbols(each.meaning),
            "" if each.value is None else with_interval(each.value, None, each.unit),
        ]
        for each in by_symbol.values()
    ]
    return header, rows


def area_in_words(assessment: Assessment, load: int, write: Write = with_interval) -> str:
    """Write the corrected area fraction under a load of the curve, with the digits known of it."""
    curve = assessment.curve
    if not isinstance(curve, SurfaceCurve):
        return "an area that is not known"
    share = float(curve.area_fraction_corrected[load])
    written = write(share, _at(assessment.area_interval, load), "%")
    return value_and_interval(written)[0]


def modulus_in_words(assessment: Assessment, modulus: str | None = None) -> str:
    """The contact modulus, which may be written already, and of which materials it is."""
    written = modulus or engineering(assessment.curve.E_star, "Pa")
    return modulus_of_pair(assessment.question.pair, written)


def modulus_of_pair(pair: MaterialPair | None, modulus: str) -> str:
    """A contact modulus that is written, and of which materials it is, if they are known."""
    if pair is None:
        return f"E* = {modulus}"
    names = " and ".join(each.surface.name for each in (pair.first, pair.second))
    return f"E* of {names}{', which lie at the surfaces,' if pair.coated else ''} = {modulus}"


def solid_in_words(solid: Solid) -> str:
    """Name, moduli and hardness of a material, and where they are from; those of each layer."""
    if not isinstance(solid, Coated):
        return _in_words(solid)
    return f"{solid.name}: {', '.join(map(_in_words, solid.materials))}"


def _in_words(material: Material) -> str:
    if math.isinf(material.E):
        return f"{material.name} ({material.source})"
    parts = [f"E = {engineering(material.E, 'Pa')}", f"nu = {material.nu:g}"]
    if material.hardness:
        factor = material.hardness_factor
        known = f" to a factor of {factor:g}" if factor > 1 else ""
        parts.append(f"H = {engineering(material.hardness, 'Pa')}{known}")
    return f"{material.name} ({', '.join(parts)}; {material.source})"


def _stiffness(values: Real, ends: Ends | None, i: int, scale: float) -> str:
    """Write a stiffness of the curve, times the scale of a joint, with its interval."""
    if ends is not None:
        ends = ends[0] * scale, ends[1] * scale
    return with_interval(scale * float(values[i]), _at(ends, i), _SI["stiffness"])


def _at(ends: Ends | None, i: int) -> tuple[float, float] | None:
    return None if ends is None else (float(ends[0][i]), float(ends[1][i]))
