"""Loads, given or spaced, checked before anything is solved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.arguments import LARGEST, checked_count
from roughline.contact.quantities import RESOLVED_FROM
from roughline.errors import InputError
from roughline.errors.checks import shown
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.law import ContactLaw, refuse_pulls
from roughline.reduction.springs import Springs
from roughline.topography.body import Body, Line, Surface

_Control = Literal["depths", "forces"]  # what is prescribed
_SATURATED_FORCE_BAR = 3.0  # k is within 15 % of the punch there, for every fractal dimension
_GAP_ROUNDING = 1e-15  # rounding of a gap over the depth, as observed
_GAP_ROUNDING_SINGLE = 3e-6  # the same in single precision
_SMALLEST_REACH = 1e-100  # below, squares of pressures leave the range of double precision
_LARGEST_CYCLE = 0.5  # of the mean separation, the largest depth of bodies that stick
_LARGEST_YIELDING = 0.5  # of the force under which all of the area yields
_BYTES_PER_LOAD = 1000  # of what a load gives
_LARGEST_FIRST = 1e-3  # first of the spaced forces over the last, at most; few points touch early


@dataclass(frozen=True, eq=False)
class Loads:
    """Checked loads, in the order in which they are applied."""

    control: _Control  # what is prescribed
    values: Real  # [length] or [force]


@dataclass(frozen=True)
class GivenLoads:
    """The loads as the caller gave them, not checked yet; exactly one may be other than None."""

    depths: ArrayLike | None
    forces: ArrayLike | None
    n_loads: int | None  # forces, evenly spaced on a logarithmic scale


def line_loads(line: Line, springs: Springs, given: GivenLoads) -> Loads:
    """Return the loads of a line; spaced ones run from ten springs in contact to all of them."""
    if given.n_loads is None:
        loads = _checked_loads(given)
        refuse_pulls(loads.control, loads.values)
        largest = int(loads.values.argmax())
        if loads.values[largest] > LARGEST:
            raise InputError(
                f"{loads.control}[{largest}] is {loads.values[largest]:g}; at most {LARGEST:g} can "
                "be computed with: give smaller loads"
            )
        return loads
    _refuse_constant(line, given)
    few = min(RESOLVED_FROM, line.heights.size - 1)
    highest_points = int(np.count_nonzero(line.heights == line.heights.max()))
    lowest = springs.touch_force(max(few, highest_points))
    return _spaced_loads(given, lowest, springs.touch_force(line.heights.size - 1))


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
            'best: give a larger rtol, or precision="mixed"'
        )
    if given.n_loads is None:
        loads, free = _checked_loads(given), half_space.mean_is_free
        law.refuse(loads.control, loads.values, surface.heights, surface.area, free)
    else:
        _refuse_constant(surface, given)
        if law.only_pushes:
            loads = _spaced_loads(given, *_range_of_forces(surface, half_space, law))
        else:
            loads = _cycle(surface, half_space, law, given)
    _refuse_beyond_precision(surface, half_space.E_star, loads, rtol, single)
    return loads


def _range_of_forces(
    surface: Surface, half_space: HalfSpace, law: ContactLaw
) -> tuple[float, float]:
    """Return the forces from about ten cells in contact to saturation."""
    E_star, area = half_space.E_star, surface.area
    # Persson: 95 % contact at a mean pressure of E* times the rms slope
    saturated = _SATURATED_FORCE_BAR * E_star * surface.rms_height * surface.length
    highest = E_star * surface.rms_slope * area if half_space.periodic else saturated
    highest = min(highest, _LARGEST_YIELDING * law.largest_force(area))
    separation = np.sort(surface.heights.max() - surface.heights, axis=None)
    few = max(RESOLVED_FROM, int(np.count_nonzero(separation == 0)))
    if few >= separation.size:
        return highest, highest
    # so many cells as one disc, pressed down to the last of them
    radius = np.sqrt(few * surface.spacing[0] * surface.spacing[1] / np.pi)
    return float(half_space.disc_stiffness(float(radius)) * separation[few]), highest


def _cycle(surface: Surface, half_space: HalfSpace, law: ContactLaw, given: GivenLoads) -> Loads:
    """Return even depths of bodies that stick, from out of reach to a large one, and back.

    At the largest one the bodies would overlap by half of their mean separation. On the way back no
    contact is drawn out further than a flat disc that is as wide as all of that contact, when the
    springs of its line let go.
    """
    n_loads = _counted(given)
    separation = surface.heights.max() - surface.heights
    deepest = _LARGEST_CYCLE * float(separation.mean())
    within = np.count_nonzero(separation < deepest + law.reach) * surface.area / separation.size
    radius = float(np.sqrt(within / np.pi))
    work = law.largest_pull * law.reach  # at least that of adhesion
    drawn = float(np.sqrt(2 * np.pi * radius * work / half_space.E_star))
    first, last = -law.reach, -law.reach - drawn
    nearer = round(1 + (n_loads - 1) * (deepest - first) / (2 * deepest - first - last))
    nearer = min(max(nearer, 2), n_loads - 1)
    there = np.linspace(first, deepest, nearer)
    return Loads("depths", np.append(there, np.linspace(deepest, last, n_loads - nearer + 1)[1:]))


def _checked_loads(given: GivenLoads) -> Loads:
    depths, forces = given.depths, given.forces
    if (depths is None) == (forces is None):
        count = "no loads" if depths is None else "both depths and forces"
        raise InputError(f"{count} given; give one of depths, forces and n_loads")
    control: _Control = "forces" if depths is None else "depths"
    values = _numbers(control, forces if depths is None else depths)
    if values.ndim != 1 or values.size == 0:
        raise InputError(f"{control} have shape {values.shape}; a list of one or more is needed")
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
        raise InputError("n_loads given together with depths or forces; give one of the three")
    n_loads = checked_count("n_loads", given.n_loads, 2)
    refuse_beyond_memory(_BYTES_PER_LOAD * n_loads, f"n_loads = {n_loads}", "give fewer loads")
    return n_loads


def _refuse_constant(body: Body, given: GivenLoads) -> None:
    if body.rms_height == 0:
        raise InputError(
            f"all heights are {body.heights.flat[0]:g}: a flat punch has no range of loads from "
            f"which to choose n_loads = {given.n_loads}; give depths or forces"
        )


def _refuse_beyond_precision(
    surface: Surface, E_star: float, loads: Loads, rtol: float, single: bool
) -> None:
    """Refuse loads so large or small that gaps cannot be resolved to the tolerance.

    A flat body has no heights to compare its loads with: they are compared with each other.
    """
    if surface.rms_height == 0:
        unit, name = float(np.abs(loads.values).max()) or 1.0, "of the largest load"
    elif loads.control == "forces":
        unit, name = surface.rms_height * E_star * surface.length, "E* h L"
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
    if 0 < reach[least] < _SMALLEST_REACH:
        raise InputError(
            f"{loads.control}[{least}] is {reach[least]:.1g} {name}, too small to "
            f"differ from zero; give at least {_SMALLEST_REACH:g} {name}"
        )


def _numbers(name: str, values: Any) -> Real:
    """Return one number or a list of them as an array; refuse text, and what is no number."""
    try:
        array = np.atleast_1d(np.ma.filled(np.ma.asarray(values), np.nan))
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} are not numbers ({error}); give a list of numbers") from error
    if array.size and array.dtype.kind not in "iuf":
        raise InputError(f"{name} are not numbers ({name}={shown(values)}); give a list of numbers")
    return array.astype(np.float64)
