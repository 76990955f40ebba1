"""The one front door to both models: a body and loads in, a curve out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline._version import __version__
from roughline.curve import RESOLVED_FROM, Curve, Fields, Status
from roughline.errors import ConvergenceError, InputError
from roughline.loads import Loads, Wish, line_loads, surface_loads
from roughline.reduction import Springs
from roughline.topography import Body, Line, Surface

if TYPE_CHECKING:
    from roughline.halfspace.state import Contact


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
        return _press_line(body, E_star, Wish(depths, forces, n_loads))
    if not isinstance(body, Surface):
        raise InputError(
            f"body is a {type(body).__name__}; a Surface or a Line is needed: wrap heights as "
            "Surface(heights, sizes=(Lx, Ly)) or Line(heights, length=L)"
        )
    loads = surface_loads(body, E_star, Wish(depths, forces, n_loads), periodic, rtol)
    curve = _press_surface(
        body, E_star, loads, periodic, fields, rtol, int(max_iterations), progress
    )
    if throw and not curve.converged.all():
        raise ConvergenceError(_failure_message(curve), curve)
    return curve


def _press_line(line: Line, E_star: float, wish: Wish) -> Curve:
    if line.kind == "profile":
        raise InputError(
            "this line is a measured profile, a straight cut, and not the reduced line of its "
            "surface (their spectra differ, the paper's eq. 7): press the surface, or build the "
            "reduced line from its spectrum with SelfAffine(...).line(n)"
        )
    springs = Springs.under(line.heights, line.spacing, E_star)
    loads = line_loads(line, springs, wish)
    if loads.control == "forces":
        force, depth = loads.values, springs.depth(loads.values)
        count = springs.count_under(force)
    else:
        force, depth = springs.force(loads.values), loads.values
        count = springs.count_at(depth)
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
    loads: Loads,
    periodic: bool,
    keep_fields: bool,
    rtol: float,
    max_iterations: int,
    progress: Callable[[int, int], None] | None,
) -> Curve:
    # compiled loops load slowly, so only here
    from roughline.halfspace import operator as operators
    from roughline.halfspace.path import follow

    units = _Units.of(surface, E_star, loads)
    make_operator = operators.periodic if periodic else operators.free
    dx, dy = surface.spacing
    operator = make_operator(surface.shape, (dx / units.length, dy / units.length), 1.0)
    separation = (surface.heights.max() - surface.heights) / units.height
    path = follow(
        operator,
        separation,
        surface.rms_height / units.height,
        loads.control,
        loads.values / (units.force if loads.control == "forces" else units.height),
        rtol,
        max_iterations,
    )
    count = loads.values.size
    depth, force, stiffness, area_fraction, residual = np.full((5, count), np.nan)
    status = np.empty(count, dtype=np.int8)
    resolved = np.zeros(count, dtype=bool)
    all_fields: list[Fields | None] = []
    for i, (contact, tangent) in enumerate(path):
        status[i] = Status[contact.outcome.name]
        if tangent is not None and not tangent.converged:
            status[i] = Status.NO_TANGENT
        residual[i] = contact.residuals.worst
        converged = status[i] == Status.CONVERGED
        if tangent is not None and converged:
            touching = int(np.count_nonzero(contact.pressure > 0))
            depth[i] = contact.depth * units.height
            force[i] = contact.force * units.force
            stiffness[i] = tangent.stiffness * units.force / units.height
            area_fraction[i] = touching / separation.size
            resolved[i] = touching >= RESOLVED_FROM
        if keep_fields:
            all_fields.append(_fields(contact, separation, units) if converged else None)
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
        rms_height=surface.rms_height,
        length=surface.length,
        unit=surface.unit,
        settings={
            "roughline_version": __version__,
            "model": "full",
            "boundary": "periodic" if periodic else "free",
            "control": loads.control,
            "rtol": rtol,
            "max_iterations": max_iterations,
            **_of_body(surface),
        },
        fields=tuple(all_fields),
    )


@dataclass(frozen=True)
class _Units:
    """Units in which E* is 1, a cell has unit area and the roughness unit rms.

    The problem is solved in these, so that no scale is too small or too large for it.
    """

    height: float
    length: float
    E_star: float

    @classmethod
    def of(cls, surface: Surface, E_star: float, loads: Loads) -> _Units:
        height = surface.rms_height
        if height == 0:  # a flat punch: its depth, or about so, is the only height there is
            height = float(loads.values[-1])
            if loads.control == "forces":
                height /= E_star * surface.length
        length = float(np.sqrt(surface.spacing[0]) * np.sqrt(surface.spacing[1]))
        return cls(height, length, E_star)

    @property
    def force(self) -> float:
        return self.E_star * self.height * self.length

    @property
    def pressure(self) -> float:
        return self.E_star * self.height / self.length


def _fields(contact: Contact, separation: NDArray[np.float64], units: _Units) -> Fields:
    pressure = np.zeros(contact.gap.shape)
    pressure.flat[contact.nodes] = contact.pressure * units.pressure
    return Fields(
        pressure=pressure,
        displacement=(contact.gap + (contact.depth - separation)) * units.height,
        gap=contact.gap * units.height,
        contact=pressure > 0,
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
