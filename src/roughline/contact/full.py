"""The full model's curve: a surface pressed into the half-space under given loads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from roughline._version import __version__
from roughline.contact.curve import RESOLVED_FROM, Curve, Fields, Status
from roughline.contact.loads import Loads
from roughline.errors import Interrupted
from roughline.halfspace.conditions import UnilateralContact
from roughline.halfspace.half_space import HalfSpace
from roughline.halfspace.outline import overstated_cells
from roughline.halfspace.path import solve_path
from roughline.halfspace.state import Contact, Load, Method, Problem
from roughline.topography.body import Surface
from roughline.topography.preparation import tilt_warnings

Field = NDArray[np.float64]

# A surface that was cut out of a larger one ends where the larger goes on. Where the outer frame
# of this width carries this share of the force, what lies beyond is missed.
EDGE_WIDTH = 0.05
EDGE_SHARE = 0.05


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
        Loads whose fields are kept.
    periodic, progress
        As for :func:`roughline.press`.

    Raises
    ------
    Interrupted
        On Ctrl-C.
    """
    units = _Units.of(surface, E_star, loads)
    half_space = HalfSpace(E_star, periodic).scaled(units.E_star, units.length)
    dx, dy = surface.spacing
    spacing = dx / units.length, dy / units.length
    operator = half_space.operator(surface.shape, spacing)
    separation = np.subtract(surface.heights.max(), surface.heights, order="C")
    separation /= units.height
    rms_height = surface.rms_height / units.height
    scaled = loads.values / (units.force if loads.control == "forces" else units.height)
    prescribed_loads = [Load.of(loads.control, value) for value in scaled.tolist()]
    count = loads.values.size
    values = np.full((8, count), np.nan)
    status = np.full(count, Status.INTERRUPTED, dtype=np.int8)
    resolved = np.zeros(count, dtype=bool)
    convolutions = np.zeros(count, dtype=np.int64)
    all_fields: list[Fields | None] = [None] * count if kept else []
    interrupted = False
    try:
        # the threads belong to the transforms: those of the linear algebra would spin beside them
        with threadpool_limits(limits=1, user_api="blas"):
            problem = Problem.of(half_space, operator, separation, rms_height, UnilateralContact())
            for i, (contact, tangent) in enumerate(solve_path(problem, prescribed_loads, method)):
                outcome = Status[contact.outcome.name]
                if tangent is not None and not tangent.converged:
                    outcome = Status.NO_TANGENT
                values[0, i] = contact.residuals.worst
                convolutions[i] = contact.convolutions + (tangent.convolutions if tangent else 0)
                if tangent is not None and outcome is Status.CONVERGED:
                    cells, nodes = int(np.count_nonzero(contact.pressure > 0)), contact.gap.size
                    most, overstated = overstated_cells(contact, spacing, periodic)
                    values[1:, i] = (
                        contact.depth * units.height,
                        contact.force * units.force,
                        tangent.stiffness * units.force / units.height,
                        cells / nodes,
                        cells / nodes - overstated / nodes,
                        (cells + most - overstated) / nodes,
                        _edge_share(contact),
                    )
                    resolved[i] = cells >= RESOLVED_FROM
                    if i in kept:
                        all_fields[i] = _fields(contact, units)
                status[i] = outcome
                del contact, tangent  # so that the next load finds their memory free
                if progress is not None:
                    progress(i + 1, count)
    except KeyboardInterrupt:
        interrupted = True
        values[:, status == Status.INTERRUPTED] = np.nan
    residual, depth, force, stiffness, area, corrected, most_area, edge = values
    # what was prescribed is given back as it came; the residual holds what the pressures miss of it
    prescribed = depth if loads.control == "depths" else force
    np.copyto(prescribed, loads.values, where=status == Status.CONVERGED)
    at_the_border = () if periodic else _edge_warnings(surface, force, edge)
    curve = Curve(
        depth=depth,
        force=force,
        stiffness=stiffness,
        area_fraction=area,
        area_fraction_corrected=corrected,
        area_fraction_most=most_area,
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
            "rtol": method.rtol,
            "max_iterations": method.max_iterations,
            "precision": method.precision,
            **surface.settings_as_body(),
        },
        convolutions=convolutions,
        warnings=(*tilt_warnings(surface), *at_the_border),
        fields=tuple(all_fields),
    )
    if interrupted:
        raise Interrupted(curve)
    return curve


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


def _edge_share(contact: Contact) -> float:
    """Share of the force that the outer frame carries."""
    nx, ny = contact.gap.shape
    x, y = np.divmod(contact.nodes, ny)
    within = np.minimum(np.minimum(x, nx - 1 - x) / nx, np.minimum(y, ny - 1 - y) / ny)
    return float(contact.pressure[within < EDGE_WIDTH].sum() / contact.pressure.sum())


def _edge_warnings(surface: Surface, force: Field, edge: Field) -> tuple[str, ...]:
    beyond = np.flatnonzero(edge > EDGE_SHARE)
    if not surface.is_cut_out or not beyond.size:
        return ()
    ends = [f"{force[i]:.3g}" for i in (beyond[0], beyond[-1])]
    unit = " N" if surface.unit == "m" else ""
    at = f"a force of {ends[0]}" if beyond.size == 1 else f"forces of {ends[0]} to {ends[1]}"
    return (
        f"at {at}{unit}, up to {edge[beyond].max():.0%} of the force is carried within "
        f"{EDGE_WIDTH:.0%} of the border, where this surface was cut out of a larger one: what "
        "lies beyond would share the load, so depth, stiffness and area are those of the piece "
        "alone, a punch with this outline. Take a larger piece, lower loads, or the periodic "
        "half-space",
    )


def _fields(contact: Contact, units: _Units) -> Fields:
    pressure = np.zeros(contact.gap.shape)
    pressure.flat[contact.nodes] = contact.pressure * units.pressure
    displacement = contact.gap - contact.separation
    displacement += contact.depth
    displacement *= units.height
    return Fields(
        pressure=pressure,
        displacement=displacement,
        gap=contact.gap * units.height,
        contact=pressure > 0,
    )
