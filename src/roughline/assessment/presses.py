"""All that is pressed for a case: the body as asked, repeated, and what its causes need.

The list is made before anything is pressed, and is an upper bound: what a variant needs is known
from the curves before it, which may show that it is needless.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from roughline.margins.causes import HARDNESS, causes
from roughline.margins.filling import force_on
from roughline.margins.larger_surface import flat_punch, punch_name
from roughline.margins.sheared import shear_presses
from roughline.margins.variant import AS_ASKED, Curves, Variant, measures_of_map, repeated
from roughline.question.case import Case
from roughline.question.films import SPOT_RADIUS, find_film
from roughline.question.loading import CURVE_LOADS, LIGHTEST_SHARE
from roughline.question.loads import LoadCase
from roughline.topography.body import Surface

UNLOADED = "unloaded"
"""Name of the variant that is unloaded from the largest load, where bodies yield and slip."""


def list_presses(case: Case) -> list[Variant]:
    """All that may be pressed for a case, in its order."""
    first = [_as_asked(case)]
    if case.is_repeated_for_interface:
        first.append(repeated(case, first[0]))
    listed = [*first, *_punches(case)] + [
        each for cause in causes for pressed in first for each in cause.presses(case, pressed)
    ]
    if case.question.friction is not None and case.hardness is not None:
        share, needed = CURVE_LOADS / case.loads.count, partial(_unloaded, case)
        listed.append(replace(listed[0], name=UNLOADED, purpose="slip", needed=needed, share=share))
    listed += shear_presses(case, listed[0], causes.sheared_otherwise(case))
    return [*listed, *HARDNESS.sheared_presses(case, listed[0])]


def _as_asked(case: Case) -> Variant:
    """The body as it was asked for, with the measures and fields that answers need of it."""
    loads, body = case.loads, case.body
    measures = [] if case.is_repeated_for_interface else measures_of_map(case)
    if case.filled_points is not None:
        measures.append(force_on(case.filled_points))
    if find_film(case.question) is not None:
        measures.append(SPOT_RADIUS)
    if measures:
        loads = replace(loads, measures=measures)
    if case.question.fields:  # of the largest load asked for, or of one at three quarters of them
        loads = replace(loads, fields=[loads.largest if loads.asked else 3 * loads.count // 4])
    shape = body.shape if isinstance(body, Surface) else (1, body.heights.size)
    return Variant(AS_ASKED, "as asked", lambda _: loads, shape, loads.periodic)


def _punches(case: Case) -> list[Variant]:
    """The flat punches that tell the stiffness of the interface of a piece alone, of each grid."""
    question = case.question
    if question.pair is None or question.periodic or case.map is not None:
        return []
    is_scattered = case.hardness is not None and case.hardness.factor != 1
    bodies = [case.body, *([case.scatter_body] if is_scattered else [])]
    of_grids = {each.shape: each for each in bodies if isinstance(each, Surface)}
    return [_punch(case, each) for each in of_grids.values()]


def _punch(case: Case, surface: Surface) -> Variant:
    flat, depth = flat_punch(surface)
    loads = LoadCase(flat, case.loads.half_space, [], [depth], None)
    name, share = punch_name(surface), 1 / max(case.loads.count, 1)
    return Variant(name, "punch", lambda _: loads, surface.shape, False, share)


def _unloaded(case: Case, curves: Curves) -> LoadCase | None:
    """Press the surface that the largest load left, up to that load, as partial slip follows it."""
    curve, largest = curves.get(AS_ASKED), case.loads.largest
    if curve is None or not curve.converged[largest]:
        return None
    forces = float(curve.force[largest]) * np.geomspace(LIGHTEST_SHARE, 1.0, CURVE_LOADS)
    left = curve.surface_after(largest)
    return LoadCase(left, case.loads.half_space, forces.tolist(), [], None)
