"""The one front door to both models: a body and loads in, a curve out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline._version import __version__
from roughline.curve import RESOLVED_FROM, Curve, Fields, Status
from roughline.errors import ConvergenceError, InputError
from roughline.reduction import Springs
from roughline.topography import Body, Line, Surface

Real = NDArray[np.float64]

_SATURATED_FORCE_BAR = 3.0  # k is within 5 % of the punch there, for every fractal dimension


@dataclass(frozen=True, eq=False)
class _Loads:
    """Checked loads: depths or forces, rising."""

    control: str
    values: Real


def press(
    body: Body,
    *,
    E_star: float,
    depths: ArrayLike | None = None,
    forces: ArrayLike | None = None,
    n_loads: int | None = None,
    periodic: bool = False,
    fields: bool = False,
    rtol: float = 1e-6,
    max_iterations: int = 5000,
    throw: bool = True,
    progress: Callable[[int, int], None] | None = None,
) -> Curve:
    """Press a rough body into an elastic half-space.

    A :class:`~roughline.Surface` is solved with the full model (every interaction, the
    half-space free around the surface unless `periodic`), a :class:`~roughline.Line` with the
    reduced model (independent springs, exact). Units are any coherent set.

    Parameters
    ----------
    body : Surface or Line
        The rough body. [length]
    E_star : float
        Contact modulus, 1 / E* = (1 - nu1²) / E1 + (1 - nu2²) / E2. [pressure]
    depths, forces : array_like, shape (loads,), optional
        Rising, positive depths since first touch [length] or total forces [force].
    n_loads : int, optional
        Or so many forces, log-spaced from about ten springs or cells in contact to saturation.
    periodic : bool, optional
        Repeat the surface periodically. Depths then count the approach of the mean planes, k is
        the stiffness of the interface alone and is infinite in full contact.
    fields : bool, optional
        Keep pressure, displacement, gap and contact of every load.
    rtol : float, optional
        Bound on every residual of what is returned: gap on contact and overlap off it over the
        rms height (or over the depth, where that is smaller), tension over the mean contact
        pressure, error of the force over the force.
    max_iterations : int, optional
        Bound on the convolutions of one load.
    throw : bool, optional
        Whether a load that is not solved raises; if not, it is marked in ``status``.
    progress : callable, optional
        Called with (loads done, loads in all) after each load.

    Returns
    -------
    Curve
        Depth, force, exact stiffness and real contact area for each load.

    Raises
    ------
    InputError
        If the body, the modulus or the loads cannot be used.
    ConvergenceError
        With `throw`, if a load was not solved; it carries the curve.
    """
    _check_number("E_star", E_star, 0, np.inf, "a positive, finite contact modulus")
    _check_number("rtol", rtol, 1e-12, 1e-1, "a tolerance from 1e-12 to 0.1")
    _check_number("max_iterations", max_iterations, 0, np.inf, "a positive number")
    if isinstance(body, Line):
        if periodic or fields:
            raise InputError(
                "periodic and fields belong to the full model; the reduced model of a Line has "
                "no boundary and no fields: leave them out, or press a Surface"
            )
        return _press_line(body, E_star, depths, forces, n_loads)
    if not isinstance(body, Surface):
        raise InputError(
            f"body is a {type(body).__name__}; a Surface or a Line is needed: wrap heights as "
            "Surface(heights, sizes=(Lx, Ly)) or Line(heights, length=L)"
        )
    loads = _surface_loads(body, E_star, depths, forces, n_loads, periodic)
    settings = {
        "roughline_version": __version__,
        "model": "full",
        "boundary": "periodic" if periodic else "free",
        "control": loads.control,
        "rtol": rtol,
        "max_iterations": max_iterations,
    }
    curve = _press_surface(
        body, E_star, loads, periodic, fields, rtol, max_iterations, settings, progress
    )
    if throw and not curve.converged.all():
        raise ConvergenceError(_failure_message(curve), curve)
    return curve


def _press_line(
    line: Line,
    E_star: float,
    depths: ArrayLike | None,
    forces: ArrayLike | None,
    n_loads: int | None,
) -> Curve:
    if line.kind == "profile":
        raise InputError(
            "this line is a measured profile, a straight cut, and not the reduced line of its "
            "surface (their spectra differ, the paper's eq. 7): press the surface, or build the "
            "reduced line from its spectrum with SelfAffine(...).line(n)"
        )
    springs = Springs.under(line.heights, line.spacing, E_star)
    if n_loads is None:
        loads = _given_loads(depths, forces)
    else:
        _refuse_constant(line, n_loads)
        few = min(RESOLVED_FROM, line.heights.size - 1)
        positive = springs.touch_forces[springs.touch_forces > 0]
        lowest = max(springs.touch_forces[few], positive[0])
        loads = _spaced_loads(depths, forces, n_loads, lowest, springs.touch_forces[-1])
    if loads.control == "forces":
        force, depth, count = (
            loads.values,
            springs.depth(loads.values),
            springs.count_under(loads.values),
        )
    else:
        force, depth, count = (
            springs.force(loads.values),
            loads.values,
            springs.count_at(loads.values),
        )
    return Curve(
        depth=depth,
        force=force,
        stiffness=springs.stiffness(count),
        area_fraction=None,
        status=np.zeros(depth.size, dtype=np.int8),
        resolved=count >= RESOLVED_FROM,
        residual=np.zeros(depth.size),
        E_star=E_star,
        rms_height=line.rms_height,
        length=line.length,
        unit=line.unit,
        settings={
            "roughline_version": __version__,
            "model": "reduced",
            "control": loads.control,
            **_of_body(line),
        },
    )


def _press_surface(
    surface: Surface,
    E_star: float,
    loads: _Loads,
    periodic: bool,
    keep_fields: bool,
    rtol: float,
    max_iterations: int,
    settings: dict[str, str | int | float],
    progress: Callable[[int, int], None] | None,
) -> Curve:
    # compiled loops load slowly, so only here
    from roughline.halfspace import operator as operators
    from roughline.halfspace.active_set import Load, Outcome
    from roughline.halfspace.path import follow

    # The problem is solved without units: E* = 1, cells of unit area, heights over their rms.
    rms_height = surface.rms_height
    unit_height = rms_height or float(loads.values[-1])
    if not rms_height and loads.control == "forces":
        unit_height = float(loads.values[-1]) / (E_star * surface.length)
    unit_length = float(np.sqrt(surface.spacing[0]) * np.sqrt(surface.spacing[1]))
    unit_force = E_star * unit_height * unit_length
    spacing = (surface.spacing[0] / unit_length, surface.spacing[1] / unit_length)
    separation = (surface.heights.max() - surface.heights) / unit_height
    make_operator = operators.periodic if periodic else operators.free
    operator = make_operator(surface.shape, spacing, 1.0)
    if loads.control == "forces":
        problem_loads = [Load(force=value / unit_force) for value in loads.values]
    else:
        problem_loads = [Load(depth=value / unit_height) for value in loads.values]

    count = loads.values.size
    depth, force, stiffness, area_fraction, residual = np.full((5, count), np.nan)
    status = np.full(count, Status.STALLED, dtype=np.int8)
    resolved = np.zeros(count, dtype=bool)
    all_fields: list[Fields | None] = []
    outcomes = {
        Outcome.CERTIFIED: Status.CONVERGED,
        Outcome.STALLED: Status.STALLED,
        Outcome.MAX_ITERATIONS: Status.MAX_ITERATIONS,
    }
    path = follow(
        operator, separation, rms_height / unit_height, problem_loads, 1.0, rtol, max_iterations
    )
    for i, (contact, tangent) in enumerate(path):
        status[i] = outcomes[contact.outcome]
        if status[i] == Status.CONVERGED and not tangent.converged:
            status[i] = Status.NO_TANGENT
        residual[i] = contact.residuals.worst
        converged = status[i] == Status.CONVERGED
        if converged:
            touching = int(np.count_nonzero(contact.pressure > 0))
            depth[i] = contact.depth * unit_height
            force[i] = contact.force * unit_force
            stiffness[i] = tangent.stiffness * E_star * unit_length
            area_fraction[i] = touching / separation.size
            resolved[i] = touching >= RESOLVED_FROM
        if keep_fields:
            pressure = np.zeros(separation.size)
            pressure[contact.patch.nodes] = contact.pressure * (unit_force / unit_length**2)
            pressure = pressure.reshape(surface.shape)
            found = Fields(
                pressure,
                contact.displacement * unit_height,
                contact.gap * unit_height,
                pressure > 0,
            )
            all_fields.append(found if converged else None)
        if progress is not None:
            progress(i + 1, count)
    return Curve(
        depth=depth,
        force=force,
        stiffness=stiffness,
        area_fraction=area_fraction,
        status=status,
        resolved=resolved,
        residual=residual,
        E_star=E_star,
        rms_height=rms_height,
        length=surface.length,
        unit=surface.unit,
        settings={**settings, **_of_body(surface)},
        fields=tuple(all_fields),
    )


def _surface_loads(
    surface: Surface,
    E_star: float,
    depths: ArrayLike | None,
    forces: ArrayLike | None,
    n_loads: int | None,
    periodic: bool,
) -> _Loads:
    if n_loads is None:
        loads = _given_loads(depths, forces)
        if periodic and loads.control == "depths":
            deepest = float(np.mean(surface.heights.max() - surface.heights))
            if not loads.values[-1] < deepest:
                raise InputError(
                    f"depth {loads.values[-1]:g} is beyond reach: the periodic half-space is in "
                    f"full contact at {deepest:g}, whatever the force; give smaller depths, or "
                    "forces"
                )
        return loads
    _refuse_constant(surface, n_loads)
    if periodic:
        # Persson: 95 % contact at a mean pressure of E* times the rms slope
        highest = E_star * surface.rms_slope * surface.area
    else:
        highest = _SATURATED_FORCE_BAR * E_star * surface.rms_height * surface.length
    separation = np.sort(surface.heights.max() - surface.heights, axis=None)
    few = max(RESOLVED_FROM, int(np.count_nonzero(separation == 0)))
    radius = np.sqrt(few * surface.spacing[0] * surface.spacing[1] / np.pi)
    lowest = highest * 1e-3
    if few < separation.size:
        lowest = min(lowest, 2 * E_star * radius * separation[few])
    return _spaced_loads(depths, forces, n_loads, lowest, highest)


def _given_loads(depths: ArrayLike | None, forces: ArrayLike | None) -> _Loads:
    if (depths is None) == (forces is None):
        given = "no loads" if depths is None else "both depths and forces"
        raise InputError(f"{given} given; give one of depths, forces and n_loads")
    control = "forces" if depths is None else "depths"
    try:
        values = np.atleast_1d(np.asarray(forces if depths is None else depths, np.float64))
    except (TypeError, ValueError) as error:
        raise InputError(f"{control} are not numbers ({error})") from error
    if values.ndim != 1 or values.size == 0:
        raise InputError(f"{control} have shape {values.shape}; a list of one or more is needed")
    for wrong, what in (
        (~np.isfinite(values), "not finite"),
        (values < 0, "negative: compression counts positive"),
        (values == 0, "zero: it touches nothing"),
    ):
        if wrong.any():
            raise InputError(
                f"{control}[{wrong.argmax()}] is {values[wrong][0]}, {what}; give positive, "
                "rising numbers"
            )
    falling = np.diff(values) <= 0
    if falling.any():
        i = int(falling.argmax())
        raise InputError(
            f"{control}[{i + 1}] = {values[i + 1]:g} does not exceed {control}[{i}] = "
            f"{values[i]:g}; sort them and give each once"
        )
    return _Loads(control, values)


def _spaced_loads(
    depths: ArrayLike | None,
    forces: ArrayLike | None,
    n_loads: int,
    lowest: float,
    highest: float,
) -> _Loads:
    if depths is not None or forces is not None:
        raise InputError("n_loads given beside depths or forces; give one of the three")
    if not isinstance(n_loads, int | np.integer) or n_loads < 2:
        raise InputError(f"n_loads is {n_loads!r}; a whole number of at least 2 is needed")
    return _Loads("forces", np.geomspace(lowest, highest, int(n_loads)))


def _refuse_constant(body: Body, n_loads: int) -> None:
    if body.rms_height == 0:
        raise InputError(
            f"all heights are {body.heights.flat[0]:g}: a flat punch has no range of loads from "
            f"which to choose n_loads = {n_loads}; give depths or forces"
        )


def _check_number(name: str, value: float, low: float, high: float, allowed: str) -> None:
    try:
        usable = low <= value <= high and 0 < value < np.inf
    except TypeError:
        usable = False
    if not usable:
        raise InputError(f"{name} is {value!r}; {allowed} is needed")


def _of_body(body: Body) -> dict[str, str | int | float]:
    return {f"body_{name}": value for name, value in body.settings.items()}


def _failure_message(curve: Curve) -> str:
    """One line for all loads that failed, equal reasons together."""
    parts = []
    for status in Status:
        failed = np.flatnonzero(curve.status == status)
        if status is not Status.CONVERGED and failed.size:
            worst = curve.residual[failed].max()
            which = ", ".join(map(str, failed[:5])) + (", ..." if failed.size > 5 else "")
            parts.append(
                f"{failed.size} of {curve.status.size} loads (number {which}) {status.reason}; "
                f"worst residual {worst:.1e}"
            )
    return "; ".join(parts) + ": raise max_iterations or rtol, or take throw=False to keep the rest"
