"""The curve and the answers of one pressed file as tables."""

from __future__ import annotations

import numpy as np

from roughline.assessment.pressed import Pressed
from roughline.contact.curve import Status
from roughline.engineering.answers import Answer, Ends
from roughline.units import decimal, engineering, prefix

_NARROW = 0.1  # half width of an interval up to which it is written as ±
_LEAST = 1e-4  # half width below which an interval says nothing
_SHARES = ("A/A_0",)  # symbols of what is written in per cent

UNRESOLVED = "fewer than ten points in contact: the grid decides, not the surface"
"""What the star behind a load means."""


def curve_table(pressed: Pressed) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of a curve in SI units; a star marks loads that the grid decides."""
    curve = pressed.at_asked
    stiffness = pressed.ends_at_asked(pressed.stiffness_interval)
    area = pressed.ends_at_asked(pressed.area_interval)
    header = ["load", "depth", "force", "stiffness k"]
    if curve.area_fraction is not None:
        header += ["raw area", "corrected A/A_0"]
    rows = []
    for i, heading in enumerate(_starred(pressed)):
        if not curve.converged[i]:
            reason = Status(curve.status[i]).reason
            rows.append([heading, "-", "-", reason, "-", "-"][: len(header)])
            continue
        row = [
            heading,
            engineering(curve.depth[i], "m"),
            engineering(curve.force[i], "N"),
            _with_interval(curve.stiffness[i], _at(stiffness, i), "N/m"),
        ]
        if curve.area_fraction is not None and curve.area_fraction_corrected is not None:
            corrected = _with_interval(curve.area_fraction_corrected[i], _at(area, i), "%")
            row += [f"{curve.area_fraction[i]:.3%}", corrected]
        rows.append(row)
    return header, rows


def answer_table(pressed: Pressed, loads: slice) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the answers at some of the loads that were asked for."""
    header = ["", *_starred(pressed)[loads]]
    rows = [
        [f"{each.name} {each.symbol}", *(quantity(each, i) for i in _numbers(pressed, loads))]
        for each in pressed.answers
    ]
    return header, rows


def formula_table(pressed: Pressed) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of how the answers follow, where they hold and where from."""
    header = ["", "formula", "holds", "source"]
    return header, [
        [f"{each.name} {each.symbol}", each.formula, each.validity, each.source]
        for each in pressed.answers
    ]


def star_is_shown(pressed: Pressed) -> bool:
    """Whether the grid decides one of the loads that were asked for."""
    curve = pressed.at_asked
    return not curve.resolved[curve.converged].all()


def quantity(answer: Answer, i: int) -> str:
    """Write one value of an answer, with its interval where that is known."""
    ends = None if answer.low is None or answer.high is None else (answer.low, answer.high)
    unit = "%" if answer.symbol in _SHARES else answer.unit
    return _with_interval(float(answer.values[i]), _at(ends, i), unit)


def _starred(pressed: Pressed) -> list[str]:
    """What each load is called, with a star where the grid decides."""
    curve = pressed.at_asked
    stars = curve.converged & ~curve.resolved
    return [
        f"{name} *" if star else name for name, star in zip(pressed.headings, stars, strict=True)
    ]


def _numbers(pressed: Pressed, loads: slice) -> range:
    return range(pressed.asked.size)[loads]


def _at(ends: Ends | None, i: int) -> tuple[float, float] | None:
    return None if ends is None else (float(ends[0][i]), float(ends[1][i]))


def _with_interval(value: float, ends: tuple[float, float] | None, unit: str) -> str:
    """Write a value, and its interval as ± where that is narrow, else by both ends in its unit."""
    if not np.isfinite(value):
        return "not solved" if np.isnan(value) else "infinite"
    factor, sign = _scale(value, unit)
    shown = f"{decimal(value * factor, 4)}{sign}"
    if ends is None or np.isnan(ends).any() or not value:
        return shown
    low, high = ends
    half_width = max(value - low, high - value) / value
    if half_width < _NARROW:
        return f"{shown} ± {100 * max(half_width, _LEAST):.2g}%"
    first, last = (decimal(end * factor, 3) if np.isfinite(end) else "infinite" for end in ends)
    return f"{shown} ({first} to {last})"


def _scale(value: float, unit: str) -> tuple[float, str]:
    """What a value is multiplied with, and what then stands behind it."""
    if unit == "1":
        return 1.0, ""
    if unit == "%":
        return 100.0, "%"
    factor, prefixed = prefix(value, unit)
    return factor, f" {prefixed}"
