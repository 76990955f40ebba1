"""A fluid between the two bodies: where it goes, how much comes through, and what theories say."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.lab.explore.state import ExploreState
from roughline.lab.explore.words import item, number_rows
from roughline.lab.maps import throttled_at
from roughline.report.values import value_and_interval, with_interval
from roughline.theories.theory_curve import TheoryCurve
from roughline.units import decimal, engineering, supported_digits

_APERTURE = rl.hydraulic_aperture("x")
_DIGITS = 3
_THEORIES = {"critical-junction": "critical junction", "bruggeman": "Bruggeman"}
FORCES, _THEORY_FORCES = np.geomspace(1e-3, 9, 14), np.geomspace(1e-3, 9, 27)
"""Dimensionless forces of the curve; the largest seal most surfaces."""
_SEALED = "sealed"


def measures(state: ExploreState, first: list[rl.Flow] | None = None) -> list[rl.Measure]:
    """What is measured of each load, if there is a fluid; a list gets the flow of the first."""
    if not state.fluid:
        return []
    if first is None:
        return [_APERTURE]

    def aperture(fields: rl.Fields) -> float:
        flow = rl.flow(fields)
        if not first:
            first.append(flow)
        return flow.hydraulic_aperture

    return [replace(_APERTURE, value=aperture)]


def apertures(pressed: rl.Curve) -> NDArray[np.float64] | None:
    """Hydraulic apertures over the rms height, zero where sealed; None without a fluid. [1]"""
    measured = pressed.measured.get(_APERTURE.name)
    return None if measured is None else measured.values / pressed.rms_height


def flow_words(pressed: rl.Curve, flow: rl.Flow) -> list[dict[str, str]]:
    """What comes through at the load, and the channel that carries most of it."""
    aperture, ends = flow.hydraulic_aperture, None
    measured = pressed.measured[_APERTURE.name]
    if measured.low is not None and measured.high is not None:
        ends = float(measured.low[0]), float(measured.high[0])
    meaning = (
        "Hydraulic aperture: gap of two flat plates that let as much fluid through, from left to "
        "right; a leak is proportional to its cube. The interval shows how far finer grids may "
        "change it."
    )
    if flow.is_sealed:
        below = f"at most {engineering(ends[1], 'm', _DIGITS)}" if ends and ends[1] > 0 else ""
        return [item("aperture", "u_h", _SEALED, meaning, below)]
    doubt = flow.validity or ("" if flow.converged else "the flow did not converge")
    value = decimal(aperture / pressed.rms_height, supported_digits(aperture, ends, _DIGITS))
    below = " ".join(filter(None, value_and_interval(with_interval(aperture, ends, "m"))))
    x, y = (decimal(share, _DIGITS) for share in throttled_at(flow))
    share = f"{decimal(100 * flow.largest_share, _DIGITS)}%" if flow.largest_share else "none"
    gap = decimal(float(flow.gap[flow.constriction]) / pressed.rms_height, _DIGITS)
    return [
        item(
            *("aperture", "u_h", f"{value} h" + (" *" if doubt else "")),
            meaning + (f" But {doubt}." if doubt else ""),
            below,
        ),
        item(
            *("channel", "largest channel", share),
            "Largest share of the flow that one channel between two places of contact carries. "
            "Below: where the fluid is throttled most, the ring in the map, and the gap there.",
            f"ring: x {x} L, y {y} L, gap {gap} h",
        ),
    ]


def of_curve(pressed: rl.Curve, state: ExploreState, surface: rl.Surface) -> dict[str, Any]:
    """Theories beside a curve with a fluid, all as a table, and in words where it seals."""
    of_theories, table = _drawn(state, surface), rows(pressed, "3D")
    for each in of_theories:
        table += _rows(each["force_bar"], each["aperture"], each["name"])
    return {"theories": of_theories, "table": table, "words": _where_sealed(pressed)}


def rows(pressed: rl.Curve, name: str) -> list[list[str]]:
    """Rows of F̄, the hydraulic aperture or that it is sealed, and a name; none without a fluid."""
    found = apertures(pressed)
    return [] if found is None else _rows(pressed.force_bar, found, name)


def _rows(forces: NDArray[Any], found: NDArray[Any], name: str) -> list[list[str]]:
    return [
        [force, _SEALED if aperture == 0 else text, name]
        for (force, text), aperture in zip(number_rows(forces, found), found, strict=True)
    ]


def _where_sealed(pressed: rl.Curve) -> str:
    """Say between which loads of a rising curve it seals."""
    is_open = np.flatnonzero(
        pressed.measured[_APERTURE.name].values != 0
    )  # and those that were not solved
    if not is_open.size:
        return "sealed under every load"
    open_until, *sealed_from = (
        decimal(float(force), _DIGITS) for force in pressed.force_bar[is_open[-1] :][:2]
    )
    if not sealed_from:
        return f"no load up to F̄ = {open_until} seals"
    return f"seals between F̄ = {open_until} and {sealed_from[0]}: marks at the foot"


def theories(state: ExploreState, surface: rl.Surface) -> list[TheoryCurve]:
    """Theories of the flow for the waves of the surface."""
    pressures = state.force(_THEORY_FORCES) / surface.area
    return [rl.theory(name, surface, state.E_star, pressures) for name in _THEORIES]


def _drawn(state: ExploreState, surface: rl.Surface) -> list[dict[str, Any]]:
    """The same as the page draws them."""
    return [
        {
            "name": _THEORIES[each.name],
            "force_bar": _THEORY_FORCES,
            "aperture": each.hydraulic_aperture / surface.rms_height,
            "validity": each.validity,
        }
        for each in theories(state, surface)
        if each.hydraulic_aperture is not None
    ]
