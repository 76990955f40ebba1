"""The reduced model's curve of a body of revolution, with and without adhesion."""

from __future__ import annotations

import math

import numpy as np

from roughline._version import __version__
from roughline.computing.arrays import Real
from roughline.contact.curve import LineCurve
from roughline.contact.loads import GivenLoads, comes_nearer, profile_loads
from roughline.contact.quantities import RESOLVED_FROM
from roughline.contact.status import Status
from roughline.errors import InputError
from roughline.facts.fact import Fact
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.laws.jkr import JKR
from roughline.reduction.revolution import Moved, Revolution
from roughline.topography.profile import Profile


def press_profile(
    profile: Profile, half_space: Homogeneous, law: JKR | None, given: GivenLoads
) -> LineCurve:
    """Press a body of revolution by the reduction method."""
    work_of_adhesion = 0.0 if law is None else law.work_of_adhesion
    body = Revolution.of(profile.radii, profile.heights, half_space.E_star, work_of_adhesion)
    if (falls := body.falls_at) is not None:
        raise InputError(
            f"this profile is so uneven from radius {falls:.3g} on that its contact would not be "
            "one disc, as the reduction method has it: smooth it, let it end there, or press a "
            "Surface"
        )
    loads = profile_loads(profile, body, given)
    moves: list[Moved] = []
    for value in loads.values.tolist():
        start = moves[-1].radius if moves and law is not None else 0.0
        moves.append(body.moved(loads.control, start, value))
    radius = np.array([each.radius for each in moves])
    depth, force = _depths_and_forces(body, radius, loads.control == "forces", loads.values)
    is_solved = np.isfinite(depth)
    pulls = [each.pull_off for each in moves if each.pull_off is not None]
    pull_off_depth, pull_off_force = min(pulls, key=lambda pull: pull[1], default=[math.nan] * 2)
    work, dissipated = (None, None) if law is None else _works(body, moves, depth)
    return LineCurve(
        depth=depth,
        force=force,
        stiffness=np.where(is_solved, 2 * half_space.E_star * radius, math.nan),
        area_fraction=np.where(is_solved, (radius / profile.largest_radius) ** 2, math.nan),
        status=np.where(is_solved, Status.CONVERGED, Status.PULLED_OFF).astype(np.int8),
        resolved=np.searchsorted(profile.radii, radius) >= RESOLVED_FROM,
        residual=np.where(is_solved, 0.0, math.nan),
        half_space=half_space,
        rms_height=profile.rms_height,
        length=math.sqrt(profile.area),
        unit=profile.unit,
        settings={
            "roughline_version": __version__,
            "model": "reduced",
            "control": loads.control,
            **({} if law is None else law.settings),
        },
        work=work,
        dissipated_work=dissipated,
        on_approach=comes_nearer(depth),
        pull_off_depth=pull_off_depth,
        pull_off_force=pull_off_force,
        facts=_facts(body, radius, depth),
        law=law,
        control=loads.control,
    )


def _depths_and_forces(
    body: Revolution, radius: Real, are_forces: bool, values: Real
) -> tuple[Real, Real]:
    """Return depth and force of each contact; NaN where no contact bears a pull."""
    if not are_forces:
        pairs = zip(radius.tolist(), values.tolist(), strict=True)
        return values, np.array([body.force(a, d) if a else 0.0 for a, d in pairs])
    force = np.where((radius > 0) | (values >= 0), values, math.nan)
    pairs = zip(radius.tolist(), force.tolist(), strict=True)
    depth = np.array([body.depth(a, F) if a else 0.0 * F for a, F in pairs])
    return depth, force


def _works(body: Revolution, moves: list[Moved], depth: Real) -> tuple[Real, Real]:
    """Return the work done by each load, and the part of it that was dissipated."""
    pairs = zip(moves, depth.tolist(), strict=True)
    stored = np.array(
        [body.stored(each.radius, d) if each.radius else 0.0 * d for each, d in pairs]
    )
    dissipated = np.cumsum([each.dissipated for each in moves]) + 0.0 * stored
    return stored + dissipated, dissipated


def _facts(body: Revolution, radius: Real, depth: Real) -> tuple[Fact, ...]:
    """Say under which loads all of the body touches."""
    ended = (radius == body.radii[-1]) & (depth > body.table[1][-1] * (1 + 1e-9))
    return (Fact("all_of_profile_touches", depth=float(depth[ended].min())),) if ended.any() else ()
