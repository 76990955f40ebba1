"""Loads, given or spaced, checked before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Mask, Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.arguments import LARGEST_NUMBER, checked_count
from roughline.contact.full_contact import in_full_contact
from roughline.contact.quantities import RESOLVED_FROM
from roughline.contact.shear_loads import ShearLoads
from roughline.errors import InputError
from roughline.errors.checks import shown
from roughline.errors.words import called, named
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.pulling_zone import farthest_pulled
from roughline.reduction.revolution import LoadControl, Revolution
from roughline.reduction.springs import Springs
from roughline.topography.body import Body, Line, Surface
from roughline.topography.profile import Profile

_SATURATED_FORCE_BAR = 3.0  # k is within 15 % of the punch there, for every fractal dimension
_GAP_ROUNDING = 1e-15  # rounding of a gap over the depth, as observed
_GAP_ROUNDING_SINGLE = 3e-6  # the same in single precision
_SHORTEST_REACH = 1e-100  # below, squares of pressures leave the range of double precision
_UNBEARABLE_PULL = 1.01  # pull over the largest that all of the area can bear
OVER_PULL_OFF = 2.0
"""The largest force of a cycle of bodies that stick, over the pull-off force, at least."""
_MOST_CYCLES = 12  # of bodies that stick, with ever larger depths
_PULL_OFF_MARGIN = 1.1  # the last depth of a profile that sticks, over that at which it comes off
_LARGEST_YIELDING = 0.5  # of the force under which all of the area yields
_BYTES_PER_LOAD = 1000  # of what a load gives
_LARGEST_FIRST = 1e-3  # first of the spaced forces over the last, at most; few points touch early


@dataclass(frozen=True, eq=False)
class Loads:
    """Checked loads, in the order in which they are applied."""

    control: LoadControl  # what is prescribed
    values: Real  # [length] or [force]
    shear: ShearLoads | None = None  # along the surface, where there is friction


@dataclass(frozen=True)
class GivenLoads:
    """The loads as the caller gave them, not checked yet; exactly one may be other than None."""

    depths: ArrayLike | None
    forces: ArrayLike | None
    n_loads: int | None  # forces, evenly spaced on a logarithmic scale


def line_loads(line: Line, springs: Springs, given: GivenLoads) -> Loads:
    """Return the loads of a line; spaced ones run from ten springs in contact to all of them."""
    if given.n_loads is None:
        loads = _computable_loads(given)
        refuse_pulls(loads.control, loads.values)
        return loads
    _refuse_constant(line, given)
    few = min(RESOLVED_FROM, line.heights.size - 1)
    highest_points = int(np.count_nonzero(line.heights == line.heights.max()))
    lowest = springs.touch_force(max(few, highest_points))
    return _spaced_loads(given, lowest, springs.touch_force(line.heights.size - 1))


def profile_loads(profile: Profile, body: Revolution, given: GivenLoads) -> Loads:
    """Return the loads of a profile; spaced ones run from ten radii in contact to all of them.

    If it sticks, they are depths of a whole cycle: from first touch to where all of it touches and
    the force is so many times the pull-off force, and back until nothing touches.
    """
    if given.n_loads is None:
        loads = _computable_loads(given)
        if not body.work_of_adhesion:
            refuse_pulls(loads.control, loads.values)
        return loads
    _refuse_constant(profile, given)
    _, depths, forces = body.table
    if body.work_of_adhesion:
        missing = OVER_PULL_OFF * -float(forces.min()) - float(forces[-1])
        # where all of it touches, it is a flat punch
        last_step = max(missing, 0.0) / (2 * body.E_star * profile.largest_radius)
        deepest = float(depths[-1]) + last_step
        return even_cycle(0.0, deepest, _PULL_OFF_MARGIN * float(depths.min()), _counted(given))
    few = profile.radii[min(RESOLVED_FROM, profile.radii.size - 1)]
    lowest = float(body.at_rest(np.array([few]))[1][0])
    return _spaced_loads(given, lowest, float(forces[-1]))


def surface_loads(
    surface: Surface,
    half_space: HalfSpace,
    given: GivenLoads,
    rtol: float,
    *,
    single: bool,
    law: ContactLaw,
) -> Loads:
    """Return the loads of a surface; spaced ones run from about ten cells to saturation.

    Loads are refused if gaps cannot be resolved to `rtol` under them, in `single` precision or in
    double, or if the law does not allow them.
    """
    if single and rtol < _GAP_ROUNDING_SINGLE:
        raise InputError(
            f"rtol is {rtol:g}; single precision resolves gaps to {_GAP_ROUNDING_SINGLE:g} at "
            'best: give a larger rtol, or leave precision="float32" of rl.Solver out'
        )
    if given.n_loads is None:
        loads = _checked_loads(given)
        _refuse_by_law(law, surface, loads, mean_is_free=half_space.mean_is_free)
    else:
        _refuse_constant(surface, given)
        if law.only_pushes:
            loads = _spaced_loads(given, *_range_of_forces(surface, half_space, law))
        else:
            loads = _cycle(surface, half_space, law, given)
    refuse_beyond_precision(surface, half_space, loads, rtol, single)
    return loads


def _range_of_forces(
    surface: Surface, half_space: HalfSpace, law: ContactLaw
) -> tuple[float, float]:
    """Return the forces from about ten cells in contact to saturation."""
    highest = min(
        _saturated(surface, half_space),
        _LARGEST_YIELDING * Bounds.of(law).largest_force(surface.area),
    )
    separation = np.sort(surface.heights.max() - surface.heights, axis=None)
    few = max(RESOLVED_FROM, int(np.count_nonzero(separation == 0)))
    if few >= separation.size:
        return highest, highest
    # so many cells as one disc, pressed down to the last of them
    radius = np.sqrt(few * surface.spacing[0] * surface.spacing[1] / np.pi)
    return float(half_space.disc_stiffness(float(radius)) * separation[few]), highest


def _saturated(surface: Surface, half_space: HalfSpace) -> float:
    """Return the force under which 95 % are in contact, or k of a free body is near the punch's.

    The gradient of the surface whose full contact has the same pressures tells the former. A free
    body is pressed at least so far that its pressures are as large a part of those in full contact
    as they are on a homogeneous half-space.
    """
    slope = in_full_contact(surface, half_space).rms_slope
    # Persson: 95 % contact at a mean pressure of E* times the rms slope
    full = half_space.E_star * slope * surface.area
    if all(half_space.repeats):
        return full
    side = surface.length
    if any(half_space.repeats):  # the length of its lines takes the place of the side of the punch
        side = surface.sizes[half_space.repeats.index(True)]
    saturated = _SATURATED_FORCE_BAR * half_space.E_star * surface.rms_height * side
    least = saturated * (slope / surface.rms_slope)
    return min(max(saturated * _beside_homogeneous(surface, half_space), least), max(full, least))


def _beside_homogeneous(surface: Surface, half_space: HalfSpace) -> float:
    """Return how stiff a half-space is under a disc of the surface's area, beside one of E*."""
    radius = float(np.sqrt(surface.area / np.pi))
    homogeneous = Homogeneous(half_space.E_star)
    return half_space.disc_stiffness(radius) / homogeneous.disc_stiffness(radius)


def _cycle(surface: Surface, half_space: HalfSpace, law: ContactLaw, given: GivenLoads) -> Loads:
    """Return even depths of bodies that stick: from out of reach to the first tried, and back.

    How far they go in the end takes solutions: :func:`roughline.contact.cycle.cycle`.
    """
    deepest = next(deepest_ones(surface, half_space))
    last = separation_depth(surface, half_space, law, deepest)
    return even_cycle(-farthest_pulled(law), deepest, last, _counted(given))


def deepest_ones(surface: Surface, half_space: HalfSpace) -> Iterator[float]:
    """Yield the largest depths that a cycle tries, from half of the mean separation on. [length]

    They double. Where full contact is rigid, what they leave to its depth is halved instead.
    """
    full = float(np.mean(surface.heights.max() - surface.heights))
    for power in range(1, _MOST_CYCLES + 1):
        yield full * (1 - 0.5**power if half_space.mean_is_free else 0.25 * 2.0**power)


def even_cycle(first: float, deepest: float, last: float, n_loads: int) -> Loads:
    """Return even depths to a large one, and back."""
    nearer = round(1 + (n_loads - 1) * (deepest - first) / (2 * deepest - first - last))
    nearer = min(max(nearer, 2), n_loads - 1)
    there = np.linspace(first, deepest, nearer)
    return Loads("depths", np.append(there, np.linspace(deepest, last, n_loads - nearer + 1)[1:]))


def _refuse_by_law(law: ContactLaw, surface: Surface, loads: Loads, *, mean_is_free: bool) -> None:
    """Refuse loads that bodies obeying a law never have.

    They are pulls on bodies that only push, forces of which the upper bounds bear no more, and,
    where full contact is rigid, depths beyond it.
    """
    control, values, bounds = loads.control, loads.values, Bounds.of(law)
    if law.only_pushes:
        refuse_pulls(control, values)
    if control == "forces":
        most, largest = bounds.largest_force(surface.area), int(values.argmax())
        if values[largest] >= most:
            hardness = (
                f"{'' if np.ndim(bounds.high) == 0 else 'mean '}hardness {most / surface.area:g}"
            )
            raise InputError(
                f"forces[{largest}] is {values[largest]:g}; a body of {hardness} and nominal area "
                f"{surface.area:g} bears less than H A_0 = {most:g}: give smaller forces, or a "
                "larger hardness"
            )
    elif mean_is_free and np.isposinf(bounds.high).all():
        full_contact, depth = float(np.mean(surface.heights.max() - surface.heights)), values.max()
        if not depth < full_contact:
            raise InputError(
                f"depth {depth:g} is beyond reach: the periodic half-space is in full contact "
                f"at {full_contact:g}, whatever the force; give smaller depths, or forces"
            )


def refuse_pulls(control: str, values: Real) -> None:
    """Refuse loads under which bodies that only push do not touch, unless they unload."""
    before_touch = np.maximum.accumulate(values) <= 0
    for wrong, what in (
        (values < 0, "negative: compression counts positive"),
        ((values == 0) & before_touch, "zero, at which nothing touches"),
    ):
        if wrong.any():
            raise InputError(
                f"{control}[{wrong.argmax()}] is {values[wrong][0]}, {what}; give positive "
                "numbers, and zero only to unload"
            )


def _computable_loads(given: GivenLoads) -> Loads:
    """Return given loads that are not too large to compute with."""
    loads = _checked_loads(given)
    largest = int(np.abs(loads.values).argmax())
    if abs(loads.values[largest]) > LARGEST_NUMBER:
        raise InputError(
            f"{loads.control}[{largest}] is {loads.values[largest]:g}; at most {LARGEST_NUMBER:g} "
            "can be computed with: give smaller loads"
        )
    return loads


def comes_nearer(depth: Real) -> Mask:
    """Return at which loads bodies have come nearer since the load before that was solved."""
    nearer, known = np.zeros(depth.size, bool), np.isfinite(depth)
    nearer[known] = np.diff(depth[known], prepend=-np.inf) >= 0
    return nearer


def separation_depth(
    surface: Surface, half_space: HalfSpace, law: ContactLaw, deepest: float
) -> float:
    """Return a depth at which bodies that stick have come apart, after a largest one. [length]

    No contact is drawn out further than a flat disc that is as wide as all that was in contact or
    within reach. Its edge lets go where 2 pi a w is what a smaller radius takes from the energy
    k l² / 2. Springs of a line do so at 2 pi a w = k l² / (2 a). Where k grows more slowly with a,
    as on a hard layer, the edge lets go later, at the latest when all of the disc pulls as it can.
    """
    separation, reach = surface.heights.max() - surface.heights, farthest_pulled(law)
    within = np.count_nonzero(separation < deepest + reach) * surface.area / separation.size
    radius = float(np.sqrt(within / np.pi))
    pull = Bounds.of(law).largest_pull
    work = pull * reach  # at least that of adhesion
    if not radius:
        return -reach
    smaller, stiffness, larger = (
        half_space.disc_stiffness(each * radius) for each in (0.5, 1.0, 2.0)
    )
    usual = float(np.sqrt(4 * np.pi * radius**2 * work / stiffness))
    growth = float(np.log2(min(stiffness / smaller, larger / stiffness)))  # k as a to this power
    largest = pull * np.pi * radius**2 / stiffness
    later = usual / np.sqrt(growth) if growth > 0 else np.inf
    return -reach - max(usual, min(later, largest))


def unbearable_pull(law: ContactLaw, area: float) -> float:
    """Return a pull that no contact bears, under which bodies come off. [force]"""
    return -_UNBEARABLE_PULL * Bounds.of(law).largest_pull * area


def _checked_loads(given: GivenLoads) -> Loads:
    depths, forces = given.depths, given.forces
    if (depths is None) == (forces is None):
        count = "no loads" if depths is None else "both depths and forces"
        raise InputError(f"{count} given; give one of depths, forces and n_loads")
    control: LoadControl = "forces" if depths is None else "depths"
    values = checked_numbers(control, forces if depths is None else depths)
    wrong = ~np.isfinite(values)
    if wrong.any():
        raise InputError(
            f"{control}[{wrong.argmax()}] is {values[wrong][0]}, not finite; give positive "
            "numbers, and zero only to unload"
        )
    return Loads(control, values)


def _spaced_loads(given: GivenLoads, lowest: float, highest: float) -> Loads:
    n_loads = _counted(given)
    lowest = min(lowest, _LARGEST_FIRST * highest)
    return Loads("forces", np.geomspace(lowest, highest, n_loads))


def _counted(given: GivenLoads) -> int:
    """Return the number of loads that are to be spaced."""
    if given.depths is not None or given.forces is not None:
        raise InputError(
            f"{named('n_loads')} given together with depths or forces; give one of the three"
        )
    n_loads = checked_count("n_loads", given.n_loads, 2)
    refuse_beyond_memory(
        _BYTES_PER_LOAD * n_loads, f"{named('n_loads')} = {n_loads}", "give fewer loads"
    )
    return n_loads


def _refuse_constant(body: Body | Profile, given: GivenLoads) -> None:
    if body.rms_height == 0:
        raise InputError(
            f"all heights are {body.heights.flat[0]:g}: a flat punch has no range of loads to "
            f"choose from; give {called('depths')} or {called('forces')}"
        )


def refuse_beyond_precision(
    surface: Surface, half_space: HalfSpace, loads: Loads, rtol: float, single: bool
) -> None:
    """Refuse loads so large or small that gaps cannot be resolved to the tolerance.

    A flat body has no heights to compare its loads with: they are compared with each other.
    """
    if surface.rms_height == 0:
        unit, name = float(np.abs(loads.values).max()) or 1.0, "of the largest load"
    elif loads.control == "forces":
        unit, name = surface.rms_height * half_space.E_star * surface.length, "E* h L"
        if (stiffer := _beside_homogeneous(surface, half_space)) != 1:
            unit, name = unit * stiffer, "of what sinks a flat punch by the rms height"
    else:
        unit, name = surface.rms_height, "rms heights"
    reach = np.abs(loads.values) / unit
    most, least = int(reach.argmax()), int(np.where(reach > 0, reach, np.inf).argmin())
    rounding = _GAP_ROUNDING_SINGLE if single else _GAP_ROUNDING
    if reach[most] * rounding > rtol:
        raise InputError(
            f"{loads.control}[{most}] is {reach[most]:.1g} {name}: so deep, "
            f"{'single' if single else 'double'} precision cannot resolve gaps to rtol = {rtol:g}; "
            f"give at most {rtol / rounding:.0g} {name}, or a larger rtol"
        )
    if 0 < reach[least] < _SHORTEST_REACH:
        raise InputError(
            f"{loads.control}[{least}] is {reach[least]:.1g} {name}, too small to "
            f"differ from zero; give at least {_SHORTEST_REACH:g} {name}"
        )


def checked_numbers(name: str, values: Any) -> Real:
    """Return one number or a list of them as an array; refuse all else, such as text."""
    try:
        array = np.atleast_1d(np.ma.filled(np.ma.asarray(values), np.nan))
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} are not numbers ({error}); give a list of numbers") from error
    if array.size and array.dtype.kind not in "iuf":
        raise InputError(f"{name} are not numbers ({name}={shown(values)}); give a list of numbers")
    if array.ndim != 1 or array.size == 0:
        raise InputError(f"have shape {array.shape}; a list of one or more is needed", name)
    return array.astype(np.float64)
