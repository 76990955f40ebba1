"""Solving the load case of a question: the body, with other filling, and made periodic."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from roughline.assessment.assumptions import broken
from roughline.assessment.larger_surface import (
    LargerSurface,
    larger_surface,
    roll_offs_along_a_side,
)
from roughline.assessment.loads import LoadCase, LoadProgress, asked_loads
from roughline.assessment.source import Topography, pressed_body
from roughline.assessment.tiles import FEWEST, Beyond, Tiles, pressed_tiles
from roughline.assessment.uncertainty import Changes, Solution, change
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.contact.selection import among_loads
from roughline.errors import Interrupted
from roughline.topography.body import Body, Surface
from roughline.topography.missing import Missing

_RTOL_OF_TILES = 1e-4  # their scatter need not be known better
_SMALL = 0.001  # changes below this are reported as less than this [%]


def solved(
    case: LoadCase, body: Body, fields: list[int], progress: LoadProgress | None
) -> Solution:
    """Press a body; what its grid leaves open is known if the case asks for it."""
    return _as_measured(Solution.of(*case.press(body, fields, progress)), body)


def _as_measured(solution: Solution, body: Body) -> Solution:
    """The same without intervals where heights are not those of a surface."""
    return replace(solution, intervals=None) if broken("grid", body) else solution


def with_other_filling(
    solution: Solution,
    case: LoadCase,
    body: Surface,
    topographies: Sequence[Topography],
    progress: LoadProgress | None,
) -> Solution:
    """Press the body with its missing points filled otherwise; the change adds to the errors."""
    curve = solution.curve
    method = Missing(topographies[0].reading.missing).other
    other = pressed_body([each.filled_by(method) for each in topographies])
    assert isinstance(other, Surface)
    if np.array_equal(other.heights, body.heights):
        return replace(solution, note=_why_filling_changes_nothing(topographies))
    again = replace(case, grid_error=False)
    if case.n_loads is not None and curve.converged.all():
        again = again.under_forces_of(curve)  # the same forces, not new ones
    moved, interrupted = again.press(other, [], progress)
    asked = asked_loads(case, curve.status.size)
    stiffness, share = change(curve.stiffness, moved.stiffness, asked)
    unloading, _ = change(curve.unloading_stiffness, moved.unloading_stiffness, asked)
    area, area_share = change(curve.area_fraction_corrected, moved.area_fraction_corrected, asked)
    note = (
        f"with missing points filled by {method} instead, stiffness changes by {_at_most(share)}, "
        f"area by {_at_most(area_share)}"
    )
    changes = Changes(stiffness, unloading, area)
    return _as_measured(Solution.of(curve, interrupted, changes, note), body)


def interface_of_the_larger_surface(
    solution: Solution,
    case: LoadCase,
    body: Surface,
    filled: Sequence[Topography],
    joint: float | None,
    progress: LoadProgress | None,
) -> tuple[LargerSurface, bool]:
    """Interface of the larger surface that a body was cut out of.

    The body is pressed again, into a periodic half-space, unless that was asked for to begin with,
    and its tiles are pressed like it. The second result says whether Ctrl-C came.

    Parameters
    ----------
    solution : Solution
        The curve as asked for.
    case : LoadCase
        How it was made.
    body : Surface
        What was pressed.
    filled : sequence of Topography
        To fill missing points otherwise; empty if none were missing.
    joint : float or None
        Nominal area of the larger surface, where it is known. [m²]
    progress : callable, optional
        As for :func:`roughline.press`.
    """
    curve, borne = solution.curve, case.borne(solution.curve)
    periodic = solution
    if not case.periodic and (solution.interrupted or not borne.any()):
        unknown = replace(curve, unloading_stiffness=np.full(borne.size, np.nan))
        periodic = replace(solution, curve=unknown, intervals=None)
    elif not case.periodic:
        case = replace(case.under_forces_of(curve), periodic=True, levelled=True)
        periodic = solved(case, body, [], progress)
        if filled and not periodic.interrupted:
            periodic = with_other_filling(periodic, case, body, filled, progress)
    level = body.detrended()
    beyond = Beyond.of(roll_offs_along_a_side(body), body.area, joint)
    tiles, interrupted = None, solution.interrupted or periodic.interrupted
    known = periodic.intervals
    if known and not interrupted:
        tiles, interrupted = _tiles(level, periodic.curve, case)
    ends = (known.unloading, known.area) if known else (None, None)
    larger = larger_surface(periodic.curve, beyond, tiles, *ends)
    if not beyond.is_told or broken("larger surface", body):
        larger = larger.without_interval
    if larger.stiffness.values.size < borne.size:  # loads that failed before have no force
        larger = larger.among(borne)
    return larger, interrupted


def _tiles(level: Surface, curve: Curve, case: LoadCase) -> tuple[tuple[Tiles, Tiles] | None, bool]:
    """Press the tiles of a map at the mean pressures of its curve; says whether Ctrl-C came."""
    borne = case.borne(curve)
    pressures = curve.force[borne] / level.area
    if min(level.shape) < FEWEST or not borne.any():
        return None, False

    def pressed(tile: Surface) -> Curve:
        curve = press(
            tile,
            E_star=case.E_star,
            hardness=case.hardness,
            forces=pressures * tile.area,
            periodic=True,
            rtol=_RTOL_OF_TILES,
            throw=False,
        )
        return among_loads(curve, borne)

    try:
        return pressed_tiles(level, curve, pressed), False
    except Interrupted:
        return None, True


def of_larger_surface(solution: Solution, larger: LargerSurface) -> Solution:
    """Return a periodic body's solution with the intervals of the larger surface behind it.

    Without the grid's errors there are no intervals: an interval of the other uncertainties alone
    would be too narrow. Nor are there where the body does not tell of the larger surface.
    """
    if solution.intervals is None:
        return solution
    known = larger.stiffness.ends is not None
    return replace(solution, intervals=larger.intervals(solution.curve) if known else None)


def _why_filling_changes_nothing(topographies: Sequence[Topography]) -> str:
    """Say why the other filling gives the same body."""
    if all(each.measurement is not None for each in topographies if each.is_filled):
        return "no filled point is left in the piece that is pressed"
    before = "before the file was written" if topographies[0].file else "before"
    return f"the points were filled {before}: the effect of their filling is not known"


def _at_most(per_cent: float) -> str:
    return f"up to {per_cent:.2g}%" if per_cent >= _SMALL else f"less than {_SMALL}%"
