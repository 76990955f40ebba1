"""What it takes to draw bodies apart that stick, once their largest load was on."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.loads import separation_depth, unbearable_pull
from roughline.contact.press import press
from roughline.contact.status import Status
from roughline.facts.fact import Fact
from roughline.topography.body import Surface

_STEPS = 8  # from no load to the largest pull, on to where bodies come apart, and across that
_NEAR_FULL_CONTACT = 1 - 1e-6  # of the depth of full contact


@dataclass(frozen=True, eq=False)
class Separation:
    """What it takes to draw bodies apart once their largest load was on.

    "In rows" are a value and, where they are known, both ends of its interval, (1 or 3,).
    """

    curve: SurfaceCurve  # over falling depths, from the largest load on
    pull_off: Real  # largest pull under a force that falls, in rows [N]
    area_fraction: Real  # that still touches under no load, in rows [1]
    work: float  # that is done from no load on until the bodies are apart [J]
    unsolved: Fact | None = None  # why a load on the way, or a pull-off, is not known


def draw_apart(curve: SurfaceCurve, largest: int, *, grid_error: bool) -> Separation | None:
    """Draw a surface apart from the largest load of a curve; None if that was not solved.

    Pull-off and area are uncertain by the grid's errors, if these are wanted.
    """
    law, surface = curve.law, curve.surface
    if not curve.converged[largest]:
        return None
    force = float(curve.force[largest])
    under = press(
        surface,
        half_space=curve.half_space,
        law=law,
        forces=[force, 0.0, unbearable_pull(law, surface.area)],
        grid_error=grid_error,
        throw=False,
    )
    if not under.converged[:2].all():  # no contact bears the last
        reason = Status(under.status[~under.converged][0]).reason
        unknown = np.array([np.nan])
        unsolved = Fact("unloading_unsolved", why=reason)
        return Separation(under, unknown, unknown, math.nan, unsolved)
    share, error = under.area_fraction_corrected, under.area_fraction_error
    drawn, depths = _drawn(surface, under)
    return Separation(
        drawn,
        _rows(-under.pull_off_force, under.pull_off_force_error),
        _rows(float(share[1]), None if error is None else float(error[1])),
        float(drawn.work[-1] - drawn.work[1]),
        _unsolved(under, drawn, depths),
    )


def _unsolved(under: SurfaceCurve, drawn: SurfaceCurve, depths: Real) -> Fact | None:
    """Say which load on the way was not solved, and what it takes at most, or why nothing is known.

    Past the largest pull bodies pull less, and at the last of the depths they are apart.
    """
    lost = np.flatnonzero(~drawn.converged)
    if lost.size:
        first = int(lost[0])
        at = {"depth": float(depths[first]), "why": Status(drawn.status[first]).reason}
        work, pull = drawn.work, -under.pull_off_force
        least = most = None
        if first >= 2 and np.isfinite(pull):
            least = float(work[first - 1] - work[1])
            most = least + pull * float(depths[first - 1] - depths[-1])
        return Fact("separation_unsolved", **at, least=least, most=most)
    return None if np.isfinite(under.pull_off_force) else Fact("pull_off_unresolved")


def _drawn(surface: Surface, under: SurfaceCurve) -> tuple[SurfaceCurve, Real]:
    """Draw bodies apart at falling depths, through those of no load and of the pull-off.

    Where they come apart is looked for first, as it bounds the work that they take.
    """
    law, off = under.law, under.pull_off_depth
    loaded, unloaded = float(under.depth[0]), float(under.depth[1])
    if under.half_space.mean_is_free:  # full contact has one depth, at which forces are not known
        full = float(np.mean(surface.heights.max() - surface.heights))
        loaded, unloaded, off = (
            min(each, _NEAR_FULL_CONTACT * full) for each in (loaded, unloaded, off)
        )
    if not np.isfinite(off):  # the grid does not resolve it
        off = unloaded
    pressed = partial(press, surface, half_space=under.half_space, law=law, throw=False)
    last_depths = np.linspace(
        off, separation_depth(surface, under.half_space, law, loaded), _STEPS + 1
    )
    looked = pressed(depths=[loaded, unloaded, *last_depths])
    last = max(0, int(np.flatnonzero(looked.force < 0).max(initial=0)) - 2)
    ends = [unloaded, off, *last_depths[last : last + 2].tolist()]
    steps = [np.linspace(start, end, _STEPS + 1) for start, end in pairwise(ends)]
    depths = np.array([loaded, *np.unique(np.concatenate(steps))[::-1]])
    return pressed(depths=depths), depths


def _rows(value: float, error: float | None) -> Real:
    """A value and, where its error is known, both ends of its interval."""
    if error is None or not np.isfinite(error):
        return np.array([value])
    return np.array([value, value / (1 + error / value) if value else 0.0, value + error])
