"""The curve and the answers of one pressed file as tables."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from roughline.answers import Answer, Ends
from roughline.curve import Status
from roughline.quantities import engineering
from roughline.report.pressed import Pressed

_NARROW = 0.1  # half width of an interval up to which it is written as ±
_ENGINEERING = ("N", "m", "Pa", "N/m", "ohm", "W/K")


def curve_table(pressed: Pressed) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of a curve in SI units; a star marks loads that the grid decides."""
    curve = pressed.curve
    header = ["load", "depth", "force", "stiffness k"]
    if curve.area_fraction is not None:
        header += ["contact area", "corrected"]
    rows = []
    for i in range(curve.depth.size):
        mark = "" if curve.resolved[i] else " *"
        if not curve.converged[i]:
            rows.append(
                [str(i + 1), "-", "-", Status(curve.status[i]).reason, "-", "-"][: len(header)]
            )
            continue
        row = [
            f"{i + 1}{mark}",
            engineering(curve.depth[i], "m"),
            engineering(curve.force[i], "N"),
            _with_interval(
                curve.stiffness[i],
                _at(pressed.stiffness_interval, i),
                lambda value, digits: engineering(value, "N/m", digits),
            ),
        ]
        if curve.area_fraction is not None and curve.area_fraction_corrected is not None:
            corrected = _with_interval(
                curve.area_fraction_corrected[i],
                _at(pressed.area_interval, i),
                lambda value, _: f"{value:.3%}",
            )
            row += [f"{curve.area_fraction[i]:.3%}", corrected]
        rows.append(row)
    return header, rows


def answer_table(pressed: Pressed) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the answers at the loads that were asked for."""
    header = ["", *(f"load {n + 1}" for n in range(pressed.asked.size)), "formula"]
    rows = []
    for each in pressed.answers:
        row = [f"{each.name} {each.symbol}"]
        for i in pressed.asked:
            row.append(quantity(each, int(i)))
        rows.append([*row, each.formula])
    return header, rows


def quantity(answer: Answer, i: int) -> str:
    """Write one value of an answer, with its interval where that is known."""

    def write(value: float, digits: int) -> str:
        if answer.unit in _ENGINEERING:
            return engineering(value, answer.unit, digits)
        return f"{value:.{digits}g}" + ("" if answer.unit == "1" else f" {answer.unit}")

    ends = None if answer.low is None or answer.high is None else (answer.low, answer.high)
    return _with_interval(float(answer.values[i]), _at(ends, i), write)


def _at(ends: Ends | None, i: int) -> tuple[float, float] | None:
    return None if ends is None else (float(ends[0][i]), float(ends[1][i]))


def _with_interval(
    value: float, ends: tuple[float, float] | None, write: Callable[[float, int], str]
) -> str:
    """Write a value, and its interval as ± where that is narrow, else by both ends."""
    if not np.isfinite(value):
        return "not solved" if np.isnan(value) else "infinite"
    shown = write(value, 4)
    if ends is None or np.isnan(ends).any() or not value:
        return shown
    low, high = ends
    half_width = max(value - low, high - value) / value
    if half_width < _NARROW:
        return f"{shown} ± {100 * half_width:.2g}%"
    first, last = (write(end, 3) if np.isfinite(end) else "infinite" for end in ends)
    number, _, unit = first.partition(" ")
    return f"{shown} ({number if last.endswith(f' {unit}') else first} to {last})"
