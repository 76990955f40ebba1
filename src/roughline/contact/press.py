"""The entry point to both models: it takes a body and loads and returns a curve."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import TypedDict, TypeVar, Unpack, overload

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.memory import fits_into_memory, refuse_beyond_memory
from roughline.contact.arguments import (
    given_half_space,
    given_law,
    given_stickiness,
    kept_loads,
)
from roughline.contact.curve import Curve, LineCurve, SurfaceCurve
from roughline.contact.estimates import (
    bytes_of_layers,
    bytes_of_pull,
    bytes_of_shear,
    expected_area_fraction,
    memory_for,
)
from roughline.contact.field_request import FieldRequest
from roughline.contact.grid_error import refuse_few_points, with_grid_error
from roughline.contact.loads import GivenLoads, Loads, refuse_beyond_precision, surface_loads
from roughline.contact.measures import Measure, checked_measures
from roughline.contact.pressing import Pressing
from roughline.contact.reduced import press_line
from roughline.contact.revolution import press_profile
from roughline.contact.shear_loads import GivenShear
from roughline.contact.sliding import SlidingCurve
from roughline.contact.sliding_springs import press_sheared_springs
from roughline.contact.solver import AS_USUAL, Solver
from roughline.contact.status import Status
from roughline.contact.strain import warn_of_strain
from roughline.errors import ConvergenceError, InputError, Interrupted
from roughline.errors.checks import between, flag, refuse, shown
from roughline.errors.public import public_names
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.operators.cell import cell_compliance
from roughline.topography.body import Body, Line, Surface
from roughline.topography.profile import Profile

_CurveType = TypeVar("_CurveType", bound=Curve)


class _PressArguments(TypedDict, total=False):
    """What :func:`press` takes beside the body, which alone decides the kind of curve."""

    E_star: float | None
    half_space: HalfSpace | None
    hardness: float | None
    law: ContactLaw | None
    depths: ArrayLike | None
    forces: ArrayLike | None
    n_loads: int | None
    periodic: Periodic | None
    friction: Friction | None
    shear_forces: ArrayLike | None
    slides: ArrayLike | None
    fields: bool | Sequence[int]
    measures: Sequence[Measure]
    grid_error: bool
    rtol: float
    solver: Solver
    throw: bool
    progress: Callable[[int, int], None] | None


@overload
def press(body: Surface, **asked: Unpack[_PressArguments]) -> SurfaceCurve: ...
@overload
def press(body: Line | Profile, **asked: Unpack[_PressArguments]) -> LineCurve: ...
@overload
def press(body: Body | Profile, **asked: Unpack[_PressArguments]) -> SurfaceCurve | LineCurve: ...


@public_names
def press(
    body: Body | Profile,
    *,
    E_star: float | None = None,
    half_space: HalfSpace | None = None,
    hardness: float | None = None,
    law: ContactLaw | None = None,
    depths: ArrayLike | None = None,
    forces: ArrayLike | None = None,
    n_loads: int | None = None,
    periodic: Periodic | None = None,
    friction: Friction | None = None,
    shear_forces: ArrayLike | None = None,
    slides: ArrayLike | None = None,
    fields: bool | Sequence[int] = False,
    measures: Sequence[Measure] = (),
    grid_error: bool = False,
    rtol: float = 1e-6,
    solver: Solver = AS_USUAL,
    throw: bool = True,
    progress: Callable[[int, int], None] | None = None,
) -> SurfaceCurve | LineCurve:
    """Press a rough body into an elastic half-space.

    A :class:`~roughline.Surface` is solved with the full model (every interaction, the
    half-space free around the surface unless it is periodic), a :class:`~roughline.Line` with the
    reduced model (independent springs, solved exactly), and a :class:`~roughline.Profile` with the
    reduction method for bodies of revolution. Units are any coherent set.

    Parameters
    ----------
    body : Surface, Line or Profile
        The rough body, or one of revolution. [length]
    E_star : float, optional
        Contact modulus, 1 / E* = (1 - nu1²) / E1 + (1 - nu2²) / E2. [pressure]
    half_space : HalfSpace, optional
        What the body is pressed into, in place of `E_star` and `periodic`, which are short for
        :class:`~roughline.Homogeneous`.
    hardness : float, optional
        Largest pressure that a point bears, the indentation hardness of the softer body; where it
        is reached, the surface is permanently indented. Default, or infinite: both bodies are
        elastic. Short for ``law=rl.Yielding(hardness)``. [pressure]
    law : ContactLaw, optional
        What pressure and gap obey at a point. Default: :class:`~roughline.Unilateral`, bodies that
        neither stick nor overlap; :class:`~roughline.Dugdale` and :class:`~roughline.Exponential`
        stick. A profile sticks by :class:`~roughline.JKR`.
    depths, forces : array_like, shape (loads,), optional
        Depths since first touch of the untouched surface [length] or total forces [force]. They may
        rise and fall: each load finds the surface as the last one left it. The order of loads does
        not matter for elastic bodies that only push. A zero after other loads unloads the bodies
        fully. Bodies that stick may be pulled: depths and forces may be negative, and a force is
        that of the first stable contact on the way to it. A pull that no contact bears takes them
        apart.
    n_loads : int, optional
        Number of forces, log-spaced from about ten springs or cells in contact to saturation. Of
        bodies that stick, even depths of a whole cycle: from out of reach to where the force is at
        least about twice the pull-off force, and back until nothing is in contact. Depths are tried
        for it, of a surface half of the mean separation, once, twice and so on, to `rtol` or 1e-3,
        and drawn back in 16 steps; on a periodic half-space, depths that leave a half, a quarter
        and so on of it. All of a profile touches at least.
    periodic : bool, "x" or "y", optional
        Repeat the surface periodically; default: no. Depths then count the approach of the mean
        planes, k is the stiffness of the interface alone and is infinite in full contact. With the
        name of an axis it repeats along that one, as a line seal or a roller does, and is free
        across. Depths then count from a place as far away across as the surface is wide, as
        :class:`~roughline.Homogeneous` says, and k holds what the half-space gives up to there.
    friction : Friction, optional
        What points in contact bear of shear. Loads are then a path: each state follows from the one
        before, and the curve is a :class:`~roughline.SlidingCurve`; of a line and a profile, whose
        springs bear shear along one line, a :class:`~roughline.SlidingLineCurve`. The half-space
        needs a Poisson's ratio, as in ``half_space=rl.Homogeneous(1.0, poisson=0.3)``.
    shear_forces, slides : array_like, shape (loads, 2) or (loads,), optional
        With friction, the total shear force on the half-space [force] or how far the rough body has
        slid [length] at each load, along x and y; numbers are along x. Default: no shear force.
        Between two loads forces and slides change together, evenly; a load that turns on the way is
        to be cut finely.
    fields : bool or sequence of int, optional
        Keep pressure, displacement, gap, contact, plastic points and indentation of every load,
        or of loads with these numbers (from 0).
    measures : sequence of Measure, optional
        Numbers that are taken from the fields of every load, kept or not, such as
        :data:`~roughline.MEAN_GAP`; they are in ``measured`` by their names.
    grid_error : bool, optional
        Estimate discretisation errors as well, from grids of n / 2 and n / 4 points, and where
        bodies yield, from a softer body.
    rtol : float, optional
        Bound on every residual of the returned solution. Gaps within the contact, overlaps outside
        it and the rounding of the depth are relative to the length l = min(h, u): the rms height h,
        unless it is zero, and the largest displacement u of a point in contact, which is the depth
        where nothing yields. Where u is less than 2 eps F / (rtol E* sqrt(A_0)), as under a flat
        body on a periodic half-space, this takes its place; eps is the rounding of numbers,
        2.2e-16, or 1.2e-7 in single precision. Tension, and pressure above the hardness, are
        relative to the mean contact pressure, the error of the force to the force. A point is in
        contact where its pressure is above zero. Dents are as uncertain as the load that left them:
        under lighter loads after it, gaps are right to `rtol` times the l of the largest load so
        far, though the residuals on that dented surface are smaller. Give a smaller `rtol` where
        light loads on a dented surface count.
    solver : Solver, optional
        How the contact is searched for: the largest number of iterations, and the precision of
        their steps.
    throw : bool, optional
        Whether a load that is not solved raises an error; if not, it is marked in ``status``.
    progress : callable, optional
        Called with (loads done, loads in all) after each load.

    Returns
    -------
    SurfaceCurve or LineCurve
        Depth, force and exact stiffness for each load. Of a surface also the stiffness on
        unloading, the real contact area, how much yields, the indentation and the work; with
        friction it is a :class:`~roughline.SlidingCurve`. A line and a profile give a
        :class:`~roughline.LineCurve`, which has no fields.

    Raises
    ------
    InputError
        If the body, the loads or any other argument cannot be used.
    ConvergenceError
        With `throw`, if a load was not solved; it carries the curve.
    Interrupted
        On Ctrl-C between or in the loads of a surface; a KeyboardInterrupt that carries the curve
        of the loads before.

    Warns
    -----
    UnitWarning
        If a given depth is more than ten times the shorter side, or the mean pressure on a
        homogeneous half-space more than ten times E*: half-spaces are linear elastic far below
        that only, and a unit may be wrong. Flat bodies and those with heights in a unit of their
        own, of more than a tenth of the side, are left alone.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> curve = rl.press(surface, E_star=1.0, forces=[1e-4, 1e-3])
    >>> print(curve.depth.round(4), curve.stiffness.round(3))
    [0.0028 0.0093] [0.069 0.252]
    >>> print(curve.area_fraction_corrected.round(3))
    [0.001 0.007]

    With a hardness points yield, and the order of the loads counts:

    >>> curve = rl.press(surface, E_star=1.0, forces=[1e-3, 1e-4], hardness=0.05)
    >>> print(curve.plastic_fraction.round(2))
    [0.79 0.  ]

    A line is solved with the reduced model, which has no area:

    >>> line = rl.SelfAffine(hurst=0.8, rms_height=0.01).line(2**12, rng=7)
    >>> print(rl.press(line, E_star=1.0, depths=[0.01]).stiffness.round(3))
    [0.308]
    """
    half_space = given_half_space(half_space, E_star, periodic)
    rtol = between("rtol", rtol, 1e-12, 0.1, "a tolerance from 1e-12 to 0.1 is needed")
    grid_error = flag("grid_error", grid_error)
    measures = checked_measures(measures)
    throw = flag("throw", throw)
    if not isinstance(solver, Solver):
        refuse("solver", solver, "an rl.Solver is needed, as rl.Solver(max_iterations=20000)")
    if progress is not None and not callable(progress):
        refuse("progress", progress, "a function of (loads done, loads in all) is needed")
    given, shear = GivenLoads(depths, forces, n_loads), GivenShear(friction, shear_forces, slides)
    shear.refuse_beside(n_loads=n_loads is not None, grid_error=grid_error)
    if isinstance(body, Line | Profile):
        stickiness = given_stickiness(law, hardness, body)
        _refuse_fields(body, half_space, grid_error or fields is not False, measures)
        springs = _half_space_of_springs(body, half_space)
        if not shear.is_nothing:
            sheared_curve = press_sheared_springs(body, springs, stickiness, given, shear)
            return _complete(body, sheared_curve, throw)
        if isinstance(body, Line):
            return _complete(body, press_line(body, springs, given), throw)
        return _complete(body, press_profile(body, springs, stickiness, given), throw)
    if not isinstance(body, Surface):
        raise InputError(
            f"body is a {type(body).__name__}; a Surface or a Line is needed, or a Profile of a "
            "body of revolution: wrap heights as Surface(heights, sizes=(Lx, Ly)) or Line(heights, "
            "length=L), and a topography of SurfaceTopography as Surface(topography)"
        )
    law = given_law(law, hardness)
    half_space.refuse(body.spacing)
    if not law.only_pushes:
        law.refuse_grid(cell_compliance(half_space, body.shape, body.spacing))
    single = solver.precision == "float32"
    loads = surface_loads(body, half_space, given, rtol, single=single, law=law)
    sheared = shear.checked(loads.control, loads.values, half_space, law, body.shape)
    loads = replace(loads, shear=sheared)
    wanted = FieldRequest(kept_loads(fields, loads.values.size), measures)
    _refuse_beyond_memory(body, half_space, loads, law, wanted)
    if grid_error:
        refuse_few_points(body)
    # imported here because compiled loops load slowly
    from roughline.contact.cycle import cycle_of_depths
    from roughline.halfspace.search.problem import Method

    method = Method(rtol, solver.max_iterations, solver.precision)
    if n_loads is not None and not law.only_pushes:
        loads = cycle_of_depths(body, half_space, law, loads.values.size, method)
        refuse_beyond_precision(body, half_space, loads, rtol, single)
    pressing = Pressing(body, half_space, law, loads, rtol, measures, solver)
    curve = pressing.curve(progress, wanted.loads)
    if grid_error:
        try:
            curve = with_grid_error(curve, pressing)
        except KeyboardInterrupt:
            raise Interrupted(curve) from None
    return _complete(body, curve, throw)


def _complete(body: Body | Profile, curve: _CurveType, throw: bool) -> _CurveType:
    """Return a curve; with `throw`, refuse one of which a load was not solved."""
    warn_of_strain(body, curve)
    if throw and not curve.converged.all():
        raise ConvergenceError(_failure_message(curve), curve)
    return curve


def _refuse_fields(
    body: Line | Profile, half_space: HalfSpace, fields: bool, measures: Sequence[Measure]
) -> None:
    """Refuse what needs fields, which the reduced model does not have."""
    name = f"the reduced model of a {type(body).__name__}"
    if any(half_space.repeats) or fields:
        raise InputError(
            f"periodic, fields and grid_error belong to the full model; {name} has none of these: "
            "leave them out, or press a Surface"
        )
    if measures:
        raise InputError(
            f"belong to the full model; {name} has no fields that they are taken from: leave them "
            "out, or press a Surface",
            "measures",
        )


def _half_space_of_springs(body: Line | Profile, half_space: HalfSpace) -> Homogeneous:
    """Return the half-space that springs stand for; refuse one that has no single modulus."""
    if not isinstance(half_space, Homogeneous):
        raise InputError(
            f"half_space is {shown(half_space)}; the springs of a {type(body).__name__} have one "
            "modulus: give E_star, or press a Surface"
        )
    return half_space


def _refuse_beyond_memory(
    surface: Surface,
    half_space: HalfSpace,
    loads: Loads,
    law: ContactLaw,
    wanted: FieldRequest,
) -> None:
    """Refuse loads that memory cannot hold; full contact is supposed where that fits."""
    kept = len(wanted.loads)
    memory = partial(
        memory_for,
        surface.shape,
        half_space.periodic,
        max(
            kept, bool(wanted.measures)
        ),  # measures are taken from the fields of one load at a time
        yielding=law.memory == "dents",
        several=loads.values.size > 1,
    )
    of_layers = bytes_of_layers(half_space, surface.shape, surface.spacing)

    def needed(share: float) -> int:
        besides = of_layers + bytes_of_pull(law, share)
        if loads.shear is not None:
            besides += bytes_of_shear(kept, share, coupled=half_space.is_coupled)
        return memory(area_fraction=share, besides=besides)

    if fits_into_memory(needed(1.0)):
        return
    refuse_beyond_memory(
        needed(expected_area_fraction(surface, half_space, loads, law)),
        f"pressing {surface.shape[0]} x {surface.shape[1]} points"
        + (f" and keeping the fields of {kept} loads" if kept else ""),
        "take a smaller piece or every other point" + (", or keep fewer fields" if kept else ""),
    )


def _failure_message(curve: Curve) -> str:
    """Return one line on all loads that failed, equal reasons together."""
    parts = []
    for status in Status:
        failed = np.flatnonzero(curve.status == status)
        if status is not Status.CONVERGED and failed.size:
            which = ", ".join(map(str, failed[:5])) + (", ..." if failed.size > 5 else "")
            count = f"{failed.size} of {curve.status.size} loads (number {which})"
            parts.append(f"{count} {status.reason}")
            if status is Status.PULLED_OFF and not math.isnan(curve.pull_off_force):
                parts[-1] += (
                    f"; the largest is {-curve.pull_off_force:.4g}, at depth "
                    f"{curve.pull_off_depth:.4g}"
                )
            if status is Status.SLIDES and isinstance(curve, SlidingCurve):
                parts[-1] += f"; it bears less than {curve.shear_limit[failed[0]]:.6g}"
            searched = status in (Status.STALLED, Status.MAX_ITERATIONS)
            if searched and isinstance(curve, SurfaceCurve):
                worst = failed[curve.residual[failed].argmax()]
                residual, of = curve.residual[worst], curve.residual_of[worst]
                parts[-1] += f"; worst residual {residual:.1e}, that of {of}"
    statuses = set(curve.status[~curve.converged].tolist())
    advice = "raise rtol"
    if Status.MAX_ITERATIONS in statuses:
        advice = "raise max_iterations (solver=rl.Solver(max_iterations=...)) or rtol"
    if statuses == {Status.PULLED_OFF}:
        advice = "give smaller pulls, or depths"
    coupled = isinstance(curve, SlidingCurve) and curve.half_space.is_coupled
    if Status.STALLED in statuses and coupled:
        advice = (
            "pressures and shear, which move each other, did not settle, as need not be where "
            "friction times Dundurs' |beta| is above 1/2: give less friction, or more loads on the "
            "way"
        )
    if statuses == {Status.SLIDES}:
        advice = "give smaller shear forces, or slides"
    return "; ".join(parts) + f": {advice}, or take throw=False to keep the rest"
