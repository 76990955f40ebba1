"""The numbers of the view "Explore" in words, as the reports write them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.assessment.uncertainty import intervals_of
from roughline.contact.quantities import RESOLVED_FROM
from roughline.contact.scaling import PAPER_PUNCH, stiffness_bar
from roughline.engineering.intervals import Intervals
from roughline.lab.explore.state import ExploreState
from roughline.report.values import value_and_interval, with_interval
from roughline.units import decimal, engineering, supported_digits

_DIGITS = 3

_Item = dict[str, str]
"""One number of the answer strip: its key, symbol, value, unit and meaning."""


def line_words(state: ExploreState, stiffness: float, lines: int) -> list[_Item]:
    """What the reduced model gives at the load."""
    without = "" if state.hardness_bar is None else " Its springs do not yield."
    without += "" if state.w is None else " Its springs do not stick."
    return [
        item(
            "stiffness_1d",
            "k̄ (1D)",
            decimal(stiffness, _DIGITS),
            f"Stiffness k / (E* L) of the reduced model, mean of {lines} lines with the same "
            f"waves. It is made for the free half-space.{without}",
        )
    ]


def contact_words(pressed: rl.Curve, fields: rl.Fields | None, surface: rl.Surface) -> list[_Item]:
    """What the full model gives at the load."""
    if not pressed.converged[0] or fields is None:
        reason = rl.Status(pressed.status[0]).reason
        return [item("stiffness_3d", "k̄ (3D)", "not solved", f"The load was not solved: {reason}")]
    intervals = intervals_of(pressed)
    return [
        _stiffness(pressed, intervals),
        _area(pressed, intervals),
        *_pressure_and_depth(pressed, fields, surface),
        *_of_yield(pressed, intervals, surface),
        _roughness(surface),
    ]


def _stiffness(pressed: rl.Curve, intervals: Intervals | None) -> _Item:
    unsure = not pressed.resolved[0]
    sticks = isinstance(pressed.law, rl.Dugdale)
    ends = _first(intervals.stiffness) if intervals else None
    return item(
        "stiffness_3d",
        "k̄ (3D)",
        decimal(float(pressed.stiffness_bar[0]), _digits(pressed.stiffness, ends))
        + (" *" if unsure else ""),
        "Stiffness k / (1.1419 E* L) of the full model: the exact slope dF/dd over that of a "
        "square punch. The interval shows how far finer grids may change it."
        + (" It is that at a given reach of the pull: along a branch the slope is less." * sticks)
        + (f" Fewer than {RESOLVED_FROM} cells touch: the grid decides." if unsure else ""),
        with_interval(float(pressed.stiffness[0]), ends, "N/m"),
    )


def _area(pressed: rl.Curve, intervals: Intervals | None) -> _Item:
    assert pressed.area_fraction_corrected is not None
    area = float(pressed.area_fraction_corrected[0])
    ends = _first(intervals.area) if intervals else None
    written = with_interval(area, ends, "%")
    return item(
        "area",
        "contact",
        f"{decimal(100 * area, supported_digits(area, ends, _DIGITS))}%",
        "Real contact area over the nominal one, corrected for the steps of its outline. The "
        "interval shows how much finer grids, with finer roughness, may change it.",
        *value_and_interval(written)[1:],
    )


def _pressure_and_depth(pressed: rl.Curve, fields: rl.Fields, surface: rl.Surface) -> list[_Item]:
    force, depth = float(pressed.force[0]), float(pressed.depth[0])
    in_contact = float(fields.pressure[fields.contact].mean())
    return [
        item(
            "pressure",
            "p_c",
            f"{decimal(in_contact / pressed.E_star, _DIGITS)} E*",
            "Mean pressure within the contact, over the cells that touch.",
            engineering(in_contact, "Pa", _DIGITS)
            + (
                f", {decimal(in_contact / pressed.hardness, _DIGITS)} H" if pressed.hardness else ""
            ),
        ),
        item(
            "depth",
            "d",
            f"{decimal(depth / surface.rms_height, _DIGITS)} h",
            "Depth since the first touch of the highest summit.",
            engineering(depth, "m", _DIGITS),
        ),
        item(
            "force",
            "F",
            engineering(force, "N", _DIGITS),
            "Total force on the surface, for the side and the contact modulus that are set.",
            f"{engineering(force / surface.area, 'Pa', _DIGITS)} over the nominal area",
        ),
    ]


def _of_yield(pressed: rl.Curve, intervals: Intervals | None, surface: rl.Surface) -> list[_Item]:
    """Stiffness on unloading, share of the contact that yields, and indentation."""
    if pressed.hardness is None:
        return []
    assert pressed.unloading_stiffness is not None
    assert pressed.plastic_fraction is not None
    assert pressed.indentation is not None
    ends = _first(intervals.unloading) if intervals else None
    indentation = float(pressed.indentation[0])
    return [
        item(
            "unloading",
            "k̄_u (3D)",
            decimal(float(unloading_bar(pressed)[0]), _digits(pressed.unloading_stiffness, ends)),
            "Stiffness on unloading k_u / (1.1419 E* L): all of the contact springs back, while on "
            "loading the spots at the hardness bear no more. Ultrasound and currents depend on it.",
            with_interval(float(pressed.unloading_stiffness[0]), ends, "N/m"),
        ),
        item(
            "plastic",
            "plastic",
            f"{decimal(100 * float(pressed.plastic_fraction[0]), _DIGITS)}%",
            "Share of the contact that is at the hardness; the hardness is given below.",
            f"H {engineering(pressed.hardness, 'Pa', _DIGITS)}",
        ),
        item(
            "indentation",
            "indentation",
            f"{decimal(indentation / surface.rms_height, _DIGITS)} h",
            "Largest permanent indentation, which remains after unloading.",
            engineering(indentation, "m", _DIGITS),
        ),
    ]


def unloading_bar(pressed: rl.Curve) -> NDArray[np.float64]:
    """Stiffness on unloading, dimensionless as that on loading. [1]"""
    assert pressed.unloading_stiffness is not None
    return stiffness_bar(pressed.unloading_stiffness, pressed.E_star, pressed.length, PAPER_PUNCH)


def _roughness(surface: rl.Surface) -> _Item:
    return item(
        "roughness",
        "h",
        engineering(surface.rms_height, "m", _DIGITS),
        "Rms height; the rms slope on this grid is given below.",
        f"slope {decimal(surface.rms_slope, _DIGITS)}",
    )


def status(pressed: rl.Curve, n: int, seconds: float, *, is_coarse: bool) -> str:
    """What was solved, how well, and how long it took."""
    assert pressed.convolutions is not None
    certified = "certified" if pressed.converged[0] else "NOT CONVERGED"
    return (
        f"{n}²{' (coarse)' if is_coarse else ''}, {int(pressed.convolutions[0])} convolutions, "
        f"residual {pressed.residual[0]:.1g} {certified}, {decimal(seconds, 2)} s"
    )


def _digits(stiffness: NDArray[np.float64], ends: tuple[float, float] | None) -> int:
    """Digits that the interval of a stiffness at the first load supports."""
    return supported_digits(float(stiffness[0]), ends, _DIGITS)


def _first(ends: Any) -> tuple[float, float] | None:
    """Both ends of an interval at the first load; None where there is no interval."""
    return None if ends is None else (float(ends[0][0]), float(ends[1][0]))


def number_rows(*columns: NDArray[np.float64]) -> list[list[str]]:
    """Rows of a table of numbers."""
    return [[decimal(float(value), _DIGITS) for value in row] for row in zip(*columns, strict=True)]


def item(key: str, symbol: str, value: str, meaning: str, below: str = "") -> _Item:
    """One number of the answer strip."""
    return {"key": key, "symbol": symbol, "value": value, "below": below, "meaning": meaning}
