"""The full model's curve: a surface pressed into the half-space under given loads."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set
from dataclasses import replace

import numpy as np

from roughline._version import __version__
from roughline.computing import linear_algebra
from roughline.contact.border import border_warnings, jump_warnings
from roughline.contact.curve import Curve
from roughline.contact.fields import Indentation
from roughline.contact.load_result import LoadResult, columns
from roughline.contact.loads import Loads
from roughline.contact.scaled_surface import ScaledSurface
from roughline.contact.status import Status
from roughline.errors import Interrupted
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.inverse.kept import working_memory
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.halfspace.laws.yielding import Yielding
from roughline.halfspace.search.path import solve_path
from roughline.halfspace.search.problem import Grid, Load, Method, Problem
from roughline.topography.body import Surface
from roughline.topography.borders import border_doubts
from roughline.topography.effects import grave_effects
from roughline.topography.preparation import tilt_warnings
from roughline.topography.settings import as_body


def press_surface(
    surface: Surface,
    loads: Loads,
    law: ContactLaw,
    *,
    half_space: HalfSpace,
    method: Method,
    kept: frozenset[int] = frozenset(),
    progress: Callable[[int, int], None] | None = None,
) -> Curve:
    """Press a surface as :func:`roughline.press` does; keep fields of loads by their numbers."""
    # where the order of loads does not matter, each is solved once, as they rise
    values, places = loads.values, np.arange(loads.values.size)
    if law.memory == "none":
        values, places = np.unique(loads.values, return_inverse=True)
    results: list[LoadResult] = []
    interrupted = False
    try:
        # the transforms have the cores; threads of the linear algebra would wait in busy loops
        with linear_algebra.on_one_thread():
            path, kept_there = replace(loads, values=values), {int(places[i]) for i in kept}
            for result in _results(surface, half_space, path, method, law, kept_there):
                results.append(result)
                if progress is not None:
                    progress(len(results), values.size)
    except KeyboardInterrupt:
        interrupted = True
    results += [LoadResult()] * (values.size - len(results))
    results = _in_order(results, places.tolist())
    curve = _curve(surface, half_space, loads, method, results, law)
    if kept:
        fields = [each.fields if i in kept else None for i, each in enumerate(results)]
        curve = replace(curve, fields=tuple(fields))
    if interrupted:
        raise Interrupted(curve)
    return curve


def _in_order(results: Sequence[LoadResult], places: Sequence[int]) -> list[LoadResult]:
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
) -> Iterator[LoadResult]:
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
            result = LoadResult.of(*next(solved), scaled, law, with_fields=i in with_fields)
            if dents is not None and result.dents is not None and result.dents.equals(dents):
                result = replace(result, dents=dents)  # one memory for all loads that add none
            dents = result.dents
            yield result


def _problem(scaled: ScaledSurface, law: ContactLaw, method: Method) -> Problem:
    """Return the untouched bodies, in the units of `scaled`."""
    grid = Grid(scaled.half_space, scaled.surface.shape, scaled.spacing)
    return Problem(
        grid,
        scaled.separation(),
        scaled.surface.rms_height / scaled.height,
        method.resolution(grid),
        law.scaled(scaled.pressure, scaled.height),
    )


def _curve(
    surface: Surface,
    half_space: HalfSpace,
    loads: Loads,
    method: Method,
    results: Sequence[LoadResult],
    law: ContactLaw,
) -> Curve:
    """Put the results of all loads together, without fields."""
    values = columns(results)
    # the prescribed value is returned unchanged; its error is part of the residual
    prescribed = values[loads.control.removesuffix("s")]
    np.copyto(prescribed, loads.values, where=values["status"] == Status.CONVERGED)
    shares = np.array([result.border_share for result in results])
    at_the_border = (
        jump_warnings(surface)
        if half_space.periodic
        else border_warnings(surface, values["force"], shares)
    )
    return Curve(
        **values,
        half_space=half_space,
        rms_height=surface.rms_height,
        length=surface.length,
        unit=surface.unit,
        settings={
            "roughline_version": __version__,
            "model": "full",
            "boundary": "periodic" if half_space.periodic else "free",
            "control": loads.control,
            "rtol": method.rtol,
            "max_iterations": method.max_iterations,
            "precision": method.precision,
            **({} if isinstance(half_space, Homogeneous) else {"half_space": repr(half_space)}),
            **_in_words(law),
            **as_body(surface.settings),
        },
        warnings=(
            *border_doubts(surface),
            *grave_effects(surface),
            *tilt_warnings(surface),
            *at_the_border,
        ),
        residual_of=tuple(result.residual_of for result in results),
        surface=surface,
        dents=tuple(result.dents for result in results) if law.memory == "dents" else (),
        law=law,
    )


def _in_words(law: ContactLaw) -> dict[str, str | float]:
    """Return what settings tell of a law; that of elastic bodies goes without saying."""
    if isinstance(law, Unilateral):
        return {}
    return {"hardness": law.hardness} if isinstance(law, Yielding) else {"law": type(law).__name__}
