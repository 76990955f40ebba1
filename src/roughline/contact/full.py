"""The full model's curve: a surface pressed into the half-space under given loads."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import TypeVar

import numpy as np

from roughline._version import __version__
from roughline.computing import linear_algebra
from roughline.computing.arrays import Indices, Mask, Real
from roughline.contact.borders import border_warnings, share_at_border
from roughline.contact.curve import SurfaceCurve
from roughline.contact.field_request import FieldRequest
from roughline.contact.fields import Fields, Indentation
from roughline.contact.loads import Loads, comes_nearer
from roughline.contact.measures import Measure, all_measured
from roughline.contact.quantities import RESOLVED_FROM
from roughline.contact.scaled_surface import ScaledSurface
from roughline.contact.selection import among_loads, at_loads
from roughline.contact.status import Status
from roughline.contact.written_sliding import WrittenSliding
from roughline.errors import Interrupted
from roughline.facts.fact import Fact
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.inverse.cache import working_memory
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.pulling_zone import facts_of_pull, resolution, resolves_pull_off
from roughline.halfspace.search.outline import overstated_cells
from roughline.halfspace.search.path import solve_path
from roughline.halfspace.search.problem import Contact, Grid, Load, Method, Outcome, Problem
from roughline.halfspace.search.response import Response
from roughline.topography.body import Surface
from roughline.topography.borders import border_doubts
from roughline.topography.effects import grave_effects
from roughline.topography.preparation import tilt_warnings
from roughline.topography.repetition import border_jump
from roughline.topography.settings import as_body

_Stored = TypeVar("_Stored")
_NO_FIELDS = FieldRequest()


def press_surface(
    surface: Surface,
    loads: Loads,
    law: ContactLaw,
    *,
    half_space: HalfSpace,
    method: Method,
    wanted: FieldRequest = _NO_FIELDS,
    progress: Callable[[int, int], None] | None = None,
) -> SurfaceCurve:
    """Press a surface as :func:`roughline.press` does."""
    # where the order of loads does not matter, each is solved once, as they rise
    values, places = loads.values, np.arange(loads.values.size)
    if law.memory == "none" and loads.shear is None:
        values, places = np.unique(loads.values, return_inverse=True)
    scaled = ScaledSurface.of(surface, half_space, loads)
    law_there = scaled.law(law)
    curve = _unsolved(scaled, half_space, loads, method, (law, law_there), wanted.measures)
    record = _WrittenCurve(curve, scaled, law_there, wanted)
    sliding = loads.shear and WrittenSliding(curve, scaled, loads.shear)
    interrupted = False
    try:
        # the transforms have the cores; threads of the linear algebra would wait in busy loops
        with linear_algebra.on_one_thread(), working_memory():
            path = _path(scaled, loads.control, values)
            bodies = _problem(scaled, law_there, method)
            solved = (
                sliding.contacts(bodies, path, method, wanted.loads)
                if sliding
                else solve_path(bodies, path, method)
            )
            for i in range(len(path)):  # no contact is held while the next is solved
                record.write(np.flatnonzero(places == i), next(solved))
                if progress is not None:
                    progress(i + 1, len(path))
    except KeyboardInterrupt:
        interrupted = True
    curve = record.assembled(loads)
    if sliding:
        curve = sliding.extended(curve)
    if interrupted:
        raise Interrupted(curve)
    return curve


def _path(scaled: ScaledSurface, control: str, values: Real) -> list[Load]:
    """Return the loads one by one, in the units of `scaled`."""
    if control == "forces":
        return [Load(force=value) for value in (values / scaled.force).tolist()]
    return [Load(depth=value) for value in (values / scaled.height).tolist()]


def _problem(scaled: ScaledSurface, law: ContactLaw, method: Method) -> Problem:
    """Return the untouched bodies, in the units of `scaled`, which the law has, too."""
    grid = Grid(scaled.half_space, scaled.surface.shape, scaled.spacing)
    bodies = Problem(
        grid,
        scaled.separation(),
        scaled.surface.rms_height / scaled.height,
        method.resolution(grid),
        law,
    )
    return replace(bodies, law=bodies.pull.at_hand())


def _unsolved(
    scaled: ScaledSurface,
    half_space: HalfSpace,
    loads: Loads,
    method: Method,
    laws: tuple[ContactLaw, ContactLaw],
    measures: Sequence[Measure],
) -> SurfaceCurve:
    """Return the curve of a surface of which no load is solved yet.

    The laws are the one that is given, and the same in the units of `scaled`.
    """
    (law, law_there), surface, count = laws, scaled.surface, loads.values.size
    unknown = partial(np.full, count, math.nan)
    return SurfaceCurve(
        depth=unknown(),
        force=unknown(),
        stiffness=unknown(),
        unloading_stiffness=unknown(),
        area_fraction=unknown(),
        area_fraction_corrected=unknown(),
        area_fraction_most=unknown(),
        plastic_fraction=unknown(),
        indentation=unknown(),
        work=unknown(),
        dissipated_work=unknown(),
        pulling_fraction=unknown(),
        largest_pressure=unknown(),
        border_share=unknown(),
        on_approach=np.zeros(count, dtype=bool),
        status=np.full(count, Status.INTERRUPTED, dtype=np.int8),
        residual=unknown(),
        residual_of=(),
        resolved=np.zeros(count, dtype=bool),
        convolutions=np.zeros(count, dtype=np.int64),
        measured=all_measured(measures, np.full((count, len(measures)), math.nan)),
        half_space=half_space,
        rms_height=surface.rms_height,
        length=surface.length,
        unit=surface.unit,
        settings={
            "roughline_version": __version__,
            "model": "full",
            "boundary": half_space.boundary,
            "control": loads.control,
            "rtol": method.rtol,
            "max_iterations": method.max_iterations,
            "precision": method.precision,
            **({} if isinstance(half_space, Homogeneous) else {"half_space": repr(half_space)}),
            **law.settings,
            **resolution(law_there),
            **as_body(surface.settings),
        },
        surface=surface,
        law=law,
        control=loads.control,
    )


class _WrittenCurve:
    """A curve that is written load by load, with what loads leave beside their numbers."""

    def __init__(
        self,
        curve: SurfaceCurve,
        scaled: ScaledSurface,
        law_there: ContactLaw,
        wanted: FieldRequest,
    ) -> None:
        count = curve.status.size
        self._law_there = law_there  # in the units of `scaled`
        self._curve = curve
        self._scaled = scaled
        self._wanted = wanted
        self._fields: list[Fields | None] = [None] * count
        self._dents: list[Indentation | None] = [None] * count
        self._residual_of = [""] * count
        self._pulls: list[tuple[float, float]] = []  # depth and force, where bodies came off

    def write(self, at: Indices, contact: Contact) -> None:
        """Write the contact under one load, in the units of the scaled surface, to equal loads."""
        curve, scaled, outcome = self._curve, self._scaled, contact.outcome
        response = contact.response
        status = Status[outcome.name]
        if outcome is Outcome.PULLED_OFF:
            self._pulls.append((contact.depth * scaled.height, contact.force * scaled.force))
        elif outcome is not Outcome.UNKNOWN_SURFACE:
            curve.residual[at] = contact.residuals.worst
            for load in at.tolist():
                self._residual_of[load] = contact.residuals.worst_name
            if response is not None:
                status = Status.CONVERGED if response.converged else Status.NO_TANGENT
        if response is not None and status is Status.CONVERGED:
            self._write_solved(at, contact, response)
        curve.convolutions[at[0]] = contact.convolutions  # equal ones later on take none
        curve.status[at] = status  # last: until then the load is interrupted

    def _write_solved(self, at: Indices, contact: Contact, response: Response) -> None:
        """Write the quantities of a contact that was solved."""
        curve, scaled, law = self._curve, self._scaled, self._curve.law
        cells, nodes = int(np.count_nonzero(~contact.pulling)), contact.separation.size
        most, overstated = _overstated(contact, scaled, law)
        dents = self._dents_after(int(at[0]), contact) if law.memory == "dents" else None
        dissipated = indented = 0.0
        if dents is not None:
            work = law.bounds(dents.nodes)[1] * dents.depth
            dissipated, indented = scaled.cell_area * float(work.sum()), float(dents.depth.max())
        self._keep_fields(at.tolist(), contact, dents)
        k = scaled.force / scaled.height
        stored = _elastic_energy(contact) + _energy_of_pull(contact)
        curve.resolved[at] = cells >= RESOLVED_FROM
        curve.depth[at] = contact.depth * scaled.height
        curve.force[at] = contact.force * scaled.force
        curve.stiffness[at] = response.loading.stiffness * k
        curve.unloading_stiffness[at] = response.unloading.stiffness * k
        curve.area_fraction[at] = cells / nodes
        curve.area_fraction_corrected[at] = cells / nodes - overstated / nodes
        curve.area_fraction_most[at] = (cells + most - overstated) / nodes
        curve.plastic_fraction[at] = float(contact.plastic.sum()) / cells if cells else 0.0
        curve.indentation[at] = indented
        curve.work[at] = stored * scaled.force * scaled.height + dissipated
        curve.dissipated_work[at] = dissipated
        curve.pulling_fraction[at] = _pulling_nodes(contact) / nodes
        curve.largest_pressure[at] = scaled.pressure * float(contact.pressure.max(initial=0.0))
        curve.border_share[at] = share_at_border(contact)

    def _keep_fields(self, at: list[int], contact: Contact, dents: Indentation | None) -> None:
        """Keep the fields of loads that are asked for, and take measures from them."""
        kept, measures = self._wanted.loads.intersection(at), self._wanted.measures
        if not kept and not measures:
            return
        fields = _fields(contact, self._scaled, dents)
        for each, value in [(each, each.of(fields)) for each in measures]:
            self._curve.measured[each.name].values[at] = value
        for load in kept:
            self._fields[load] = fields

    def _dents_after(self, load: int, contact: Contact) -> Indentation | None:
        """Return and keep the dents that a load leaves; one memory for all that add none."""
        dents, before = _dents(contact, self._scaled), self._dents[load - 1] if load else None
        if dents is not None and before is not None and dents.equals(before):
            dents = before
        self._dents[load] = dents
        return dents

    def assembled(self, loads: Loads) -> SurfaceCurve:
        """Return the curve over all loads, with what depends on the loads before."""
        curve, scaled = self._curve, self._scaled
        known = curve.status != Status.INTERRUPTED
        if not known.all():  # one may have been interrupted as it was written
            curve = among_loads(at_loads(curve, np.flatnonzero(known)), known)
        curve = _along_the_path(curve)
        # the prescribed value is returned unchanged; its error is part of the residual
        prescribed = curve.force if loads.control == "forces" else curve.depth
        np.copyto(prescribed, loads.values, where=curve.converged)
        law_there, surface = self._law_there, curve.surface
        pull_off_depth, pull_off_force = self._pull_off(curve, law_there)
        return replace(
            curve,
            pull_off_depth=pull_off_depth,
            pull_off_force=pull_off_force,
            residual_of=_where_known(self._residual_of, known, ""),
            fields=_where_known(self._fields, known, None) if self._wanted.loads else (),
            dents=_where_known(self._dents, known, None) if curve.law.memory == "dents" else (),
            facts=(
                *border_doubts(surface),
                *grave_effects(surface),
                *tilt_warnings(surface),
                *_jump_facts(surface, curve.half_space.repeats),
                *border_warnings(surface, curve.force, curve.border_share),
                *facts_of_pull(law_there, float(np.ptp(surface.heights)) / scaled.height),
            ),
        )

    def _pull_off(self, curve: SurfaceCurve, law: ContactLaw) -> tuple[float, float]:
        """Return the depth and the force of the largest pull; NaN unless the grid resolves them.

        Bodies come off at a load on retreat after which they pull less, or between two forces.
        """
        unknown = math.nan, math.nan
        if law.only_pushes or not resolves_pull_off(law):
            return unknown
        known = np.flatnonzero(np.isfinite(curve.depth))
        force, depth, nearer = curve.force[known], curve.depth[known], curve.on_approach[known]
        passed = ~nearer[:-1] & ~nearer[1:] & (force[1:] >= force[:-1]) & (force[:-1] < 0)
        on_retreat = zip(depth[:-1][passed].tolist(), force[:-1][passed].tolist(), strict=True)
        return min([*self._pulls, *on_retreat], key=lambda each: each[1], default=unknown)


def _where_known(kept: Sequence[_Stored], known: Mask, other: _Stored) -> tuple[_Stored, ...]:
    """Return what is kept of loads, where they are known."""
    return tuple(each if is_known else other for each, is_known in zip(kept, known, strict=True))


def _along_the_path(curve: SurfaceCurve) -> SurfaceCurve:
    """Return a curve with what depends on the loads before: branch, and work where bodies stick."""
    curve = replace(curve, on_approach=comes_nearer(curve.depth))
    if curve.law.memory != "path":
        return curve
    stored = curve.work  # of each load by itself: nothing is dented
    work = _work_done(curve.depth, curve.force, stored)
    return replace(curve, work=work, dissipated_work=work - stored)


def _work_done(depth: Real, force: Real, stored: Real) -> Real:
    """Return the work that the loads have done, by cubics between those solved on each way.

    Bodies come to the first load without a jump, as far as is known. The cubics rise and fall where
    the forces do [1]_, so a jump between two loads is a steep line.

    References
    ----------
    .. [1] F. N. Fritsch and R. E. Carlson, "Monotone piecewise cubic interpolation", SIAM J. Numer.
       Anal. 17, 238-246 (1980).
    """
    from scipy.interpolate import PchipInterpolator  # here because it loads slowly

    known, work = np.isfinite(depth), np.full(depth.size, np.nan)
    if not known.any():
        return work
    at, forces = depth[known], force[known]
    steps = np.diff(at)
    moving = np.flatnonzero(steps)
    turns = moving[1:][steps[moving[1:]] * steps[moving[:-1]] < 0]
    done = np.zeros(at.size)
    for first, last in pairwise([0, *turns.tolist(), at.size - 1]):
        way = slice(first, last + 1)
        there, places = np.unique(at[way], return_index=True)
        done[way] = done[first]
        if there.size > 1:
            along = PchipInterpolator(there, forces[way][places]).antiderivative()
            done[way] += along(at[way]) - along(at[first])
    work[known] = stored[known][0] + done
    return work


def _overstated(contact: Contact, scaled: ScaledSurface, law: ContactLaw) -> tuple[float, float]:
    """Return by how many cells the outline overstates the area, at most and as estimated.

    An area that bears at most the hardness does not get below the middle between F / H and that of
    the cells: at F / H itself all of the contact would yield. Where nothing yields, it is that of
    elastic bodies if that is possible.
    """
    most, overstated = overstated_cells(contact, scaled.spacing, scaled.half_space.repeats)
    most_of_cell = float(np.max(law.bounds(None)[1])) * scaled.cell_area
    if math.isfinite(most_of_cell):
        fewest = contact.force * scaled.force / most_of_cell
        possible = max(contact.nodes.size - fewest, 0.0)
        if overstated >= possible or contact.plastic.any():
            overstated = min(overstated, possible / 2)
    return most, overstated


def _elastic_energy(contact: Contact) -> float:
    """Work that the half-space gives back on unloading, in the units of the contact."""
    separation = contact.separation.reshape(-1)[contact.nodes]
    displacement = contact.gap_at(contact.nodes) - separation + contact.depth
    cell_area = contact.problem.operator.cell_area
    return 0.5 * cell_area * float(contact.pressure @ displacement)


def _energy_of_pull(contact: Contact) -> float:
    """Energy of the pull across gaps, in the units of the contact."""
    problem = contact.problem
    if problem.law.only_pushes:
        return 0.0
    return problem.pull.energy(contact.gap.ravel()) * problem.operator.cell_area


def _pulling_nodes(contact: Contact) -> float:
    """Number of the nodes that pull, each as the share of the largest pull that it bears."""
    pulling = contact.pressure[contact.pulling]
    largest = Bounds.of(contact.problem.law).largest_pull
    return float(pulling.sum()) / -largest if pulling.size else 0.0


def _dents(contact: Contact, scaled: ScaledSurface) -> Indentation | None:
    """Return where the surface is lower than it was untouched."""
    lower = contact.separation - scaled.separation()
    nodes = np.flatnonzero(lower)
    return Indentation(nodes, lower.flat[nodes] * scaled.height) if nodes.size else None


def _fields(contact: Contact, scaled: ScaledSurface, dents: Indentation | None) -> Fields:
    shape = contact.gap.shape
    pressure = np.zeros(shape)
    touching, plastic, pulling = np.zeros((3, *shape), dtype=bool)
    pressure.flat[contact.nodes] = contact.pressure * scaled.pressure
    touching.flat[contact.nodes] = ~contact.pulling
    plastic.flat[contact.nodes] = contact.plastic
    pulling.flat[contact.nodes] = contact.pulling
    displacement = contact.gap - contact.separation
    displacement += contact.depth
    displacement *= scaled.height
    indentation: Real = np.zeros(shape)
    if dents is not None:
        indentation.flat[dents.nodes] = dents.depth
    return Fields(
        pressure=pressure,
        displacement=displacement,
        gap=contact.gap * scaled.height,
        contact=touching,
        plastic=plastic,
        pulling=pulling,
        indentation=indentation,
        sizes=scaled.surface.sizes,
        periodic=scaled.half_space.periodic,
    )


def _jump_facts(surface: Surface, repeats: tuple[bool, bool]) -> tuple[Fact, ...]:
    """Say how far a piece of a larger surface jumps at its borders where it is repeated."""
    may_jump = any(each and n > 1 for each, n in zip(repeats, surface.shape, strict=True))
    if not may_jump or not surface.is_cut_out or surface.rms_height == 0:
        return ()
    return (border_jump(surface, repeats).fact(surface.unit),)
