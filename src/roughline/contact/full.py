"""The full model's curve: a surface pressed into the half-space under given loads."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from roughline._version import __version__
from roughline.computing.arrays import Real
from roughline.contact.border import border_share, border_warnings
from roughline.contact.curve import Curve, Fields, Status
from roughline.contact.loads import Loads
from roughline.contact.quantities import QUANTITIES, RESOLVED_FROM
from roughline.errors import Interrupted
from roughline.halfspace.conditions import UnilateralContact
from roughline.halfspace.half_space import HalfSpace
from roughline.halfspace.outline import overstated_cells
from roughline.halfspace.path import solve_path
from roughline.halfspace.state import Contact, Load, Method, Problem
from roughline.halfspace.tangent import Tangent
from roughline.topography.body import Surface
from roughline.topography.preparation import tilt_warnings


def press_surface(
    surface: Surface,
    E_star: float,
    loads: Loads,
    method: Method,
    *,
    periodic: bool,
    kept: frozenset[int],
    progress: Callable[[int, int], None] | None,
) -> Curve:
    """Press a surface.

    Parameters
    ----------
    surface : Surface
        The surface. [length]
    E_star : float
        Contact modulus. [pressure]
    loads : Loads
        Checked loads.
    method : Method
        Tolerance, bound on the convolutions and precision.
    kept : frozenset of int
        Numbers of the loads whose fields are kept.
    periodic, progress
        As for :func:`roughline.press`.

    Raises
    ------
    Interrupted
        On Ctrl-C.
    """
    scaled = _Scaled.of(surface, E_star, loads)
    half_space = HalfSpace(E_star, periodic).scaled(scaled.E_star, scaled.length)
    solutions: list[_Solution] = []
    interrupted = False
    try:
        # the transforms have the cores; threads of the linear algebra would wait in busy loops
        with threadpool_limits(limits=1, user_api="blas"):
            path = _path(half_space, scaled, surface.rms_height, loads, method)
            for i, (contact, tangent) in enumerate(path):
                solutions.append(_solution(contact, tangent, scaled, periodic, i in kept))
                del contact, tangent  # so that the next load finds their memory free
                if progress is not None:
                    progress(i + 1, loads.values.size)
    except KeyboardInterrupt:
        interrupted = True
    solutions += [_Solution()] * (loads.values.size - len(solutions))
    curve = _curve(surface, E_star, loads, method, periodic, solutions)
    if kept:
        curve = replace(curve, fields=tuple(solution.fields for solution in solutions))
    if interrupted:
        raise Interrupted(curve)
    return curve


def _path(
    half_space: HalfSpace, scaled: _Scaled, rms_height: float, loads: Loads, method: Method
) -> Iterator[tuple[Contact, Tangent | None]]:
    """Solve the contact under each load in turn, in the units of `scaled`."""
    operator = half_space.operator(scaled.separation.shape, scaled.spacing)
    problem = Problem.of(
        half_space, operator, scaled.separation, rms_height / scaled.height, UnilateralContact()
    )
    values = loads.values / (scaled.force if loads.control == "forces" else scaled.height)
    return solve_path(problem, [Load.of(loads.control, value) for value in values.tolist()], method)


@dataclass(frozen=True, eq=False)
class _Solution:
    """What the model gives under one load: quantities of the curve by their names, and more.

    The defaults are those of a load that was not solved.

    Attributes
    ----------
    border_share : float
        Share of the force that the border carries. [1]
    fields : Fields or None
        Fields on the grid, if they are kept.
    """

    status: Status = Status.INTERRUPTED
    residual: float = math.nan
    convolutions: int = 0
    resolved: bool = False
    depth: float = math.nan
    force: float = math.nan
    stiffness: float = math.nan
    area_fraction: float = math.nan
    area_fraction_corrected: float = math.nan
    area_fraction_most: float = math.nan
    border_share: float = math.nan
    fields: Fields | None = None


def _solution(
    contact: Contact,
    tangent: Tangent | None,
    scaled: _Scaled,
    periodic: bool,
    with_fields: bool,
) -> _Solution:
    """Return what one load gives, in the units of the surface."""
    if tangent is None:
        status = Status[contact.outcome.name]
        return _Solution(status, contact.residuals.worst, contact.convolutions)
    convolutions = contact.convolutions + tangent.convolutions
    if not tangent.converged:
        return _Solution(Status.NO_TANGENT, contact.residuals.worst, convolutions)
    cells, nodes = int(np.count_nonzero(contact.pressure > 0)), contact.gap.size
    most, overstated = overstated_cells(contact, scaled.spacing, periodic)
    return _Solution(
        status=Status.CONVERGED,
        residual=contact.residuals.worst,
        convolutions=convolutions,
        resolved=cells >= RESOLVED_FROM,
        depth=contact.depth * scaled.height,
        force=contact.force * scaled.force,
        stiffness=tangent.stiffness * scaled.force / scaled.height,
        area_fraction=cells / nodes,
        area_fraction_corrected=cells / nodes - overstated / nodes,
        area_fraction_most=(cells + most - overstated) / nodes,
        border_share=border_share(contact),
        fields=_fields(contact, scaled) if with_fields else None,
    )


def _curve(
    surface: Surface,
    E_star: float,
    loads: Loads,
    method: Method,
    periodic: bool,
    solutions: Sequence[_Solution],
) -> Curve:
    """Put the solutions of all loads together, without fields."""
    columns = _columns(solutions)
    # what was prescribed is given back as it came; the residual holds what the pressures miss of it
    prescribed = columns[loads.control.removesuffix("s")]
    np.copyto(prescribed, loads.values, where=columns["status"] == Status.CONVERGED)
    shares = np.array([solution.border_share for solution in solutions])
    at_the_border = () if periodic else border_warnings(surface, columns["force"], shares)
    return Curve(
        **columns,
        E_star=E_star,
        rms_height=surface.rms_height,
        length=surface.length,
        unit=surface.unit,
        settings={
            "roughline_version": __version__,
            "model": "full",
            "boundary": "periodic" if periodic else "free",
            "control": loads.control,
            "rtol": method.rtol,
            "max_iterations": method.max_iterations,
            "precision": method.precision,
            **surface.settings_as_body(),
        },
        warnings=(*tilt_warnings(surface), *at_the_border),
    )


def _columns(solutions: Sequence[_Solution]) -> dict[str, Any]:
    """Return each quantity of the solutions as an array over the loads, by its name."""
    return {
        each.name: np.array(
            [getattr(solution, each.name) for solution in solutions], QUANTITIES[each.name].dtype
        )
        for each in dataclasses.fields(_Solution)
        if each.name in QUANTITIES
    }


@dataclass(frozen=True, eq=False)
class _Scaled:
    """A surface in units in which E* is 1, a cell has unit area and the roughness unit rms.

    The problem is solved in these, so that no scale is too small or too large for it.

    Attributes
    ----------
    height, length : float
        Units of lengths across and along the surface. [length]
    E_star : float
        Unit of pressures where both lengths are equal. [pressure]
    separation : ndarray, shape (nx, ny)
        Distance of the bodies at first touch over `height`. [1]
    spacing : tuple of float
        Sides of a cell over `length`. [1]
    """

    height: float
    length: float
    E_star: float
    separation: Real
    spacing: tuple[float, float]

    @classmethod
    def of(cls, surface: Surface, E_star: float, loads: Loads) -> _Scaled:
        """Choose the units."""
        height = surface.rms_height
        if height == 0:  # a flat punch: its depth, or about so, is the only height there is
            height = float(loads.values[-1])
            if loads.control == "forces":
                height /= E_star * surface.length
        dx, dy = surface.spacing
        length = float(np.sqrt(dx) * np.sqrt(dy))
        separation = np.subtract(surface.heights.max(), surface.heights, order="C")
        separation /= height
        return cls(height, length, E_star, separation, (dx / length, dy / length))

    @property
    def force(self) -> float:
        """Unit of forces. [force]"""
        return self.E_star * self.height * self.length

    @property
    def pressure(self) -> float:
        """Unit of pressures. [pressure]"""
        return self.E_star * self.height / self.length


def _fields(contact: Contact, scaled: _Scaled) -> Fields:
    pressure = np.zeros(contact.gap.shape)
    pressure.flat[contact.nodes] = contact.pressure * scaled.pressure
    displacement = contact.gap - contact.separation
    displacement += contact.depth
    displacement *= scaled.height
    return Fields(
        pressure=pressure,
        displacement=displacement,
        gap=contact.gap * scaled.height,
        contact=pressure > 0,
    )
