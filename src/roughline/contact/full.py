"""The full model's curve: a surface pressed into the half-space under given loads."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from roughline._version import __version__
from roughline.computing import linear_algebra
from roughline.computing.arrays import Real
from roughline.contact.borders import border_warnings, share_at_border
from roughline.contact.curve import Curve
from roughline.contact.fields import Fields, Indentation
from roughline.contact.loads import Loads, comes_nearer
from roughline.contact.measures import Measure, all_measured
from roughline.contact.quantities import OVER_LOADS, QUANTITIES, RESOLVED_FROM
from roughline.contact.scaled_surface import ScaledSurface
from roughline.contact.status import Status
from roughline.errors import Interrupted
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.inverse.kept import working_memory
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.pulling_zone import remarks, resolution, resolves_pull_off
from roughline.halfspace.search.outline import overstated_cells
from roughline.halfspace.search.path import solve_path
from roughline.halfspace.search.problem import Contact, Grid, Load, Method, Outcome, Problem
from roughline.halfspace.search.tangent import Response
from roughline.topography.body import Surface
from roughline.topography.borders import border_doubts
from roughline.topography.effects import grave_effects
from roughline.topography.preparation import tilt_warnings
from roughline.topography.repetition import border_jump
from roughline.topography.settings import as_body


def press_surface(
    surface: Surface,
    loads: Loads,
    law: ContactLaw,
    *,
    half_space: HalfSpace,
    method: Method,
    kept: frozenset[int] = frozenset(),
    measures: Sequence[Measure] = (),
    progress: Callable[[int, int], None] | None = None,
) -> Curve:
    """Press a surface as :func:`roughline.press` does; keep fields of loads by their numbers."""
    # where the order of loads does not matter, each is solved once, as they rise
    values, places = loads.values, np.arange(loads.values.size)
    if law.memory == "none":
        values, places = np.unique(loads.values, return_inverse=True)
    results: list[_LoadResult] = []
    interrupted = False
    try:
        # the transforms have the cores; threads of the linear algebra would wait in busy loops
        with linear_algebra.on_one_thread():
            path, kept_there = replace(loads, values=values), {int(places[i]) for i in kept}
            solved = _results(surface, half_space, path, method, law, kept_there, measures)
            for result in solved:
                results.append(result)
                if progress is not None:
                    progress(len(results), values.size)
    except KeyboardInterrupt:
        interrupted = True
    results += [_LoadResult()] * (values.size - len(results))
    results = _in_order(results, places.tolist())
    curve = _curve(surface, half_space, loads, method, results, law)
    if measures:
        unknown = [math.nan] * len(measures)
        taken = [each.measures or unknown for each in results]
        curve = replace(curve, measured=all_measured(measures, taken))
    if kept:
        fields = [each.fields if i in kept else None for i, each in enumerate(results)]
        curve = replace(curve, fields=tuple(fields))
    if interrupted:
        raise Interrupted(curve)
    return curve


def _in_order(results: Sequence[_LoadResult], places: Sequence[int]) -> list[_LoadResult]:
    """Return the result under each load; an equal load later on takes no convolutions."""
    ordered, met = [], set()
    for place in places:
        result = results[place]
        ordered.append(replace(result, convolutions=0) if place in met else result)
        met.add(place)
    return ordered


def _results(
    surface: Surface,
    half_space: HalfSpace,
    loads: Loads,
    method: Method,
    law: ContactLaw,
    with_fields: Set[int],
    measures: Sequence[Measure],
) -> Iterator[_LoadResult]:
    """Solve the contact under each load in turn."""
    scaled = ScaledSurface.of(surface, half_space, loads)
    if loads.control == "forces":
        path = [Load(force=value) for value in (loads.values / scaled.force).tolist()]
    else:
        path = [Load(depth=value) for value in (loads.values / scaled.height).tolist()]
    with working_memory():
        solved = solve_path(_problem(scaled, law, method), path, method)
        dents: Indentation | None = None
        for i in range(len(path)):  # no contact is held while the next is solved
            with_these = i in with_fields
            result = _LoadResult.of(
                *next(solved), scaled, law, with_fields=with_these, measures=measures
            )
            if dents is not None and result.dents is not None and result.dents.equals(dents):
                result = replace(result, dents=dents)  # one memory for all loads that add none
            dents = result.dents
            yield result


def _problem(scaled: ScaledSurface, law: ContactLaw, method: Method) -> Problem:
    """Return the untouched bodies, in the units of `scaled`."""
    grid = Grid(scaled.half_space, scaled.surface.shape, scaled.spacing)
    bodies = Problem(
        grid,
        scaled.separation(),
        scaled.surface.rms_height / scaled.height,
        method.resolution(grid),
        scaled.law(law),
    )
    return replace(bodies, law=bodies.pull.at_hand())


def _curve(
    surface: Surface,
    half_space: HalfSpace,
    loads: Loads,
    method: Method,
    results: Sequence[_LoadResult],
    law: ContactLaw,
) -> Curve:
    """Put the results of all loads together, without fields."""
    values = _columns(results)
    values |= _along_the_path(values["depth"], values["force"], results, law)
    # the prescribed value is returned unchanged; its error is part of the residual
    prescribed = values[loads.control.removesuffix("s")]
    np.copyto(prescribed, loads.values, where=values["status"] == Status.CONVERGED)
    shares = np.array([result.border_share for result in results])
    scaled = ScaledSurface.of(surface, half_space, loads)
    law_there = scaled.law(law)
    at_the_border = (
        *_jump_warnings(surface, half_space.repeats),
        *border_warnings(surface, values["force"], shares),
    )
    pull_off_depth, pull_off_force = _pull_off(results, values, law_there)
    return Curve(
        **values,
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
        warnings=(
            *border_doubts(surface),
            *grave_effects(surface),
            *tilt_warnings(surface),
            *at_the_border,
            *remarks(law_there, scaled.separation()),
        ),
        pull_off_depth=pull_off_depth,
        pull_off_force=pull_off_force,
        border_share=shares,
        residual_of=tuple(result.residual_of for result in results),
        surface=surface,
        dents=tuple(result.dents for result in results) if law.memory == "dents" else (),
        law=law,
        control=loads.control,
    )


@dataclass(frozen=True, eq=False)
class _LoadResult:
    """Quantities of the curve under one load by their names, and more.

    The defaults are those of a load that was not solved.
    """

    status: Status = Status.INTERRUPTED
    residual: float = math.nan
    residual_of: str = ""
    convolutions: int = 0
    resolved: bool = False
    depth: float = math.nan
    force: float = math.nan
    stiffness: float = math.nan
    unloading_stiffness: float = math.nan
    area_fraction: float = math.nan
    area_fraction_corrected: float = math.nan
    area_fraction_most: float = math.nan
    plastic_fraction: float = math.nan
    indentation: float = math.nan
    work: float = math.nan
    dissipated_work: float = math.nan
    pulling_fraction: float = math.nan
    on_approach: bool = False
    stored_work: float = math.nan  # that bodies give back if they come apart slowly
    border_share: float = math.nan  # of the force
    fields: Fields | None = None  # if they are kept
    measures: Sequence[float] = ()
    dents: Indentation | None = None  # if the surface is indented
    pull_off: tuple[float, float] | None = None  # depth and force, if bodies came off

    @classmethod
    def of(
        cls,
        contact: Contact,
        response: Response | None,
        scaled: ScaledSurface,
        law: ContactLaw,
        *,
        with_fields: bool,
        measures: Sequence[Measure],
    ) -> _LoadResult:
        """Return what one load gives, by the contact in the units of a scaled, untouched surface.

        There is no response where the contact was not certified.
        """
        worst, of = contact.residuals.worst, contact.residuals.worst_is_of
        if contact.outcome is Outcome.UNKNOWN_SURFACE:
            return cls(Status.UNKNOWN_SURFACE)
        if contact.outcome is Outcome.PULLED_OFF:
            pull = contact.depth * scaled.height, contact.force * scaled.force
            return cls(Status.PULLED_OFF, convolutions=contact.convolutions, pull_off=pull)
        if response is None:
            return cls(Status[contact.outcome.name], worst, of, contact.convolutions)
        if not response.converged:
            return cls(Status.NO_TANGENT, worst, of, contact.convolutions)
        cells, nodes = int(np.count_nonzero(~contact.pulling)), contact.separation.size
        most, overstated = _overstated(contact, scaled, law)
        dents = _dents(contact, scaled) if law.memory == "dents" else None
        dissipated = indented = 0.0
        if dents is not None:
            work = law.bounds(dents.nodes)[1] * dents.depth
            dissipated, indented = scaled.cell_area * float(work.sum()), float(dents.depth.max())
        fields = _fields(contact, scaled, dents) if with_fields or measures else None
        k = scaled.force / scaled.height
        stored = _elastic_energy(contact) + _energy_of_pull(contact)
        return cls(
            status=Status.CONVERGED,
            residual=worst,
            residual_of=of,
            convolutions=contact.convolutions,
            resolved=cells >= RESOLVED_FROM,
            depth=contact.depth * scaled.height,
            force=contact.force * scaled.force,
            stiffness=response.loading.stiffness * k,
            unloading_stiffness=response.unloading.stiffness * k,
            area_fraction=cells / nodes,
            area_fraction_corrected=cells / nodes - overstated / nodes,
            area_fraction_most=(cells + most - overstated) / nodes,
            plastic_fraction=float(contact.plastic.sum()) / cells if cells else 0.0,
            indentation=indented,
            work=stored * scaled.force * scaled.height + dissipated,
            dissipated_work=dissipated,
            stored_work=stored * scaled.force * scaled.height,
            pulling_fraction=_pulling_nodes(contact) / nodes,
            border_share=share_at_border(contact),
            fields=fields if with_fields else None,
            measures=[] if fields is None else [each.of(fields) for each in measures],
            dents=dents,
        )


def _columns(results: Sequence[_LoadResult]) -> dict[str, Any]:
    """Return each quantity of the results as an array over the loads, by its name."""
    return {
        each.name: np.array(
            [getattr(result, each.name) for result in results], QUANTITIES[each.name].dtype
        )
        for each in dataclasses.fields(_LoadResult)
        if each.name in QUANTITIES and QUANTITIES[each.name].dims == OVER_LOADS
    }


def _along_the_path(
    depth: Real, force: Real, results: Sequence[_LoadResult], law: ContactLaw
) -> dict[str, Any]:
    """Return what depends on the loads before: the branch, and the work of bodies that stick."""
    nearer = {"on_approach": comes_nearer(depth)}
    if law.memory != "path":
        return nearer
    stored = np.array([result.stored_work for result in results])
    work = _work_done(depth, force, stored)
    return {**nearer, "work": work, "dissipated_work": work - stored}


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
    at, borne = depth[known], force[known]
    steps = np.diff(at)
    moving = np.flatnonzero(steps)
    turns = moving[1:][steps[moving[1:]] * steps[moving[:-1]] < 0]
    done = np.zeros(at.size)
    for first, last in pairwise([0, *turns.tolist(), at.size - 1]):
        way = slice(first, last + 1)
        there, places = np.unique(at[way], return_index=True)
        done[way] = done[first]
        if there.size > 1:
            along = PchipInterpolator(there, borne[way][places]).antiderivative()
            done[way] += along(at[way]) - along(at[first])
    work[known] = stored[known][0] + done
    return work


def _pull_off(
    results: Sequence[_LoadResult], values: Mapping[str, Any], law: ContactLaw
) -> tuple[float, float]:
    """Return the depth and the force of the largest pull; NaN unless the grid resolves them.

    Bodies come off at a load on retreat after which they pull less, or between two forces.
    """
    unknown = math.nan, math.nan
    if law.only_pushes or not resolves_pull_off(law):
        return unknown
    pulls = [each.pull_off for each in results if each.pull_off is not None]
    known = np.flatnonzero(np.isfinite(values["depth"]))
    force, depth = values["force"][known], values["depth"][known]
    nearer = values["on_approach"][known]
    passed = ~nearer[:-1] & ~nearer[1:] & (force[1:] >= force[:-1]) & (force[:-1] < 0)
    pulls += zip(depth[:-1][passed].tolist(), force[:-1][passed].tolist(), strict=True)
    return min(pulls, key=lambda each: each[1]) if pulls else unknown


def _overstated(contact: Contact, scaled: ScaledSurface, law: ContactLaw) -> tuple[float, float]:
    """Return by how many cells the outline overstates the area, at most and as estimated.

    An area that bears at most the hardness does not get below the middle between F / H and that of
    the cells: at F / H itself all of the contact would yield. Where nothing yields, it is that of
    elastic bodies if that is possible.
    """
    most, overstated = overstated_cells(contact, scaled.spacing, scaled.half_space.repeats)
    most_of_cell = float(np.max(law.bounds(None)[1])) * scaled.cell_area
    if math.isfinite(most_of_cell):
        borne = contact.force * scaled.force / most_of_cell
        possible = max(contact.nodes.size - borne, 0.0)
        if overstated >= possible or contact.plastic.any():
            overstated = min(overstated, possible / 2)
    return most, overstated


def _elastic_energy(contact: Contact) -> float:
    """Work that the half-space gives back on unloading, in the units of the contact."""
    separation = contact.separation.flat[contact.nodes]
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


def _jump_warnings(surface: Surface, repeats: tuple[bool, bool]) -> tuple[str, ...]:
    """Say how far a piece of a larger surface jumps at its borders where it is repeated."""
    may_jump = any(each and n > 1 for each, n in zip(repeats, surface.shape, strict=True))
    if not may_jump or not surface.is_cut_out or surface.rms_height == 0:
        return ()
    return (border_jump(surface, repeats).in_words(surface.unit),)
