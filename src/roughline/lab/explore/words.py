"""The numbers of the view "Explore" in words, as the reports write them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.contact.quantities import RESOLVED_FROM
from roughline.lab.explore.state import FIGURES, ExploreState, StripWords
from roughline.margins.grid import intervals_of_grid
from roughline.report.values import figure, up_to_three_digits
from roughline.units import supported_digits

_DIGITS = 3
LINES = 20
"""How many lines stand for the reduced model, by their mean stiffness."""

STRIP = ("stiffness_3d", "area", "pressure", "depth", "force", "roughness")
"""Numbers of the full model by their keys; that of the reduced one is told as a comparison."""


def line_words(state: ExploreState, stiffness: float) -> dict[str, str]:
    """What the reduced model gives at the load."""
    in_unit = up_to_three_digits(stiffness * state.E_star * state.length, None, "N/m")
    mean = f" mean of {LINES} lines with the same waves."
    return FIGURES["stiffness_1d"].in_words(in_unit, unlike(state), mean)


def unlike(state: ExploreState) -> str:
    """Say what the reduced model leaves out of a state."""
    return ", ".join(each.unlike for each in state.added if each.unlike)


def contact_words(
    pressed: rl.SurfaceCurve, fields: rl.Fields | None, surface: rl.Surface, state: ExploreState
) -> StripWords:
    """What the full model gives at the load."""
    if not pressed.converged[0] or fields is None:
        unsolved = f"The load was not solved: {rl.Status(pressed.status[0]).reason}"
        yield replace(FIGURES["stiffness_3d"], meaning=unsolved).in_words("not solved")
        return
    in_contact = float(fields.pressure[fields.contact].mean())
    yield from _with_intervals(pressed, in_contact, state)
    height, force, depth = surface.rms_height, float(pressed.force[0]), float(pressed.depth[0])
    yield FIGURES["depth"].in_words(
        f"{figure(depth / height)} h", up_to_three_digits(depth, None, "m")
    )
    mean = up_to_three_digits(force / state.length**2, None, "Pa")
    yield FIGURES["force"].in_words(
        up_to_three_digits(force, None, "N"), f"{mean} over the nominal area"
    )
    yield FIGURES["roughness"].in_words(
        up_to_three_digits(height, None, "m"), f"slope {figure(surface.rms_slope)}"
    )
    for each in state.added:
        yield from each.words(pressed, fields, state)


def _with_intervals(pressed: rl.SurfaceCurve, in_contact: float, state: ExploreState) -> StripWords:
    """Stiffness, area and pressure, with what finer grids may change."""
    intervals, unsure = intervals_of_grid(pressed), not pressed.resolved[0]
    stiffness, area = float(pressed.stiffness[0]), float(pressed.area_fraction_corrected[0])
    of_k = first(intervals.stiffness) if intervals else None
    of_area = first(intervals.area) if intervals else None
    sticks = pressed.law is not None and not pressed.law.only_pushes
    rounded, below = stiffness_with_ends(stiffness, of_k, state)
    yield FIGURES["stiffness_3d"].in_words(
        rounded + " *" * unsure,
        below,
        " It is that at a given reach of the pull: along a branch the slope is less." * sticks
        + f" Fewer than {RESOLVED_FROM} cells touch: the grid decides." * unsure,
    )
    yield FIGURES["area"].in_words(*with_ends(area, of_area, "%"))
    ends = None
    if of_area and of_area[0] > 0:
        ends = in_contact * area / of_area[1], in_contact * area / of_area[0]
    over = [f"{figure(in_contact / state.E_star)} E*"]
    over += [f"{figure(in_contact / pressed.hardness)} H"] if pressed.hardness else []
    yield FIGURES["pressure"].in_words(*with_ends(in_contact, ends, "Pa", *over))


def status(pressed: rl.SurfaceCurve, n: int, seconds: float, *, is_coarse: bool) -> str:
    """What was solved, how well, and how long it took."""
    certified = "certified" if pressed.converged[0] else "NOT CONVERGED"
    return (
        f"{n}²{' (coarse)' if is_coarse else ''}, {int(pressed.convolutions[0])} convolutions, "
        f"residual {pressed.residual[0]:.1g} {certified}, {figure(seconds, 2)} s"
    )


def with_ends(
    value: float, ends: tuple[float, float] | None, unit: str, *more: str
) -> tuple[str, str]:
    """A value with the digits that its interval supports; and that, as rounded, with more."""
    rounded, bracket, interval = up_to_three_digits(value, ends, unit).partition(" (")
    return rounded, ", ".join(filter(None, (bracket.strip() + interval, *more)))


def stiffness_with_ends(
    value: float, ends: tuple[float, float] | None, state: ExploreState
) -> tuple[str, str]:
    """A stiffness; and its interval, and what it is over the modulus and the side."""
    over_side = figure(state.stiffness_bars(value), supported_digits(value, ends, _DIGITS))
    return with_ends(value, ends, "N/m", f"k / (E* L) {over_side}")


def first(ends: Any) -> tuple[float, float] | None:
    """Both ends of an interval at the first load; None where there is no interval."""
    return None if ends is None else (float(ends[0][0]), float(ends[1][0]))


def number_rows(*columns: NDArray[np.float64]) -> list[list[str]]:
    """Rows of a table of numbers."""
    return [[figure(float(value)) for value in row] for row in zip(*columns, strict=True)]


def load_rows(
    forces: NDArray[np.float64], values: NDArray[np.float64], pressed: rl.SurfaceCurve, name: str
) -> list[list[str]]:
    """Rows of loads and a quantity; a star marks those with too few cells in contact."""
    rows = [[*row, name] for row in number_rows(forces, values)]
    for i, row in enumerate(rows):
        if not pressed.converged[i]:
            row[1] = rl.Status(pressed.status[i]).reason
        elif not pressed.resolved[i] and pressed.force[i] > 0:
            row[1] += " *"
    return rows
