"""The place: a map is one piece of a larger surface, and its tiles tell how such pieces differ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache, partial

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.measures import Measure
from roughline.contact.pieces import cut
from roughline.contact.pressing import Pressing
from roughline.engineering.intervals import Ends
from roughline.margins.cause import Cause
from roughline.margins.larger_measure import LargerMeasure
from roughline.margins.spread import LOGARITHM, LOGIT, Spread, Values
from roughline.margins.tiles import (
    POINTS_OF_BORDER,
    POINTS_OF_TILES,
    TiledCurves,
    coarse_shape,
    coarsened,
    has_few_points,
)
from roughline.margins.variant import AS_ASKED, Curves, Pressable, Variant, has_tiles, larger_name
from roughline.question.assumptions import broken
from roughline.question.case import Case
from roughline.question.kinds import nominal_area
from roughline.question.loads import LoadCase
from roughline.topography.body import Surface

_COARSE = "coarse map"  # of which the tiles are, where the map has many points
_BORDER = "coarser map"  # that tells what its border does to what flows
_RTOL = 1e-4  # of tiles, whose scatter need not be known better


class OtherPlaces(Cause):
    """Other places of the surface that a map was cut out of are other, and it has longer waves."""

    name = "place"
    title = "what one map does not show"
    remedy = "a larger map"
    takes = "for the surface around the map"
    is_of_larger = True

    def presses(self, case: Case, pressed: Variant) -> Sequence[Variant]:
        """The map on fewer points, and its tiles, under the mean pressures of its curve."""
        body = case.map
        if body is None or pressed.name != larger_name(case, AS_ASKED) or not has_tiles(case):
            return ()
        return _listed(case, pressed.name, body, self.name)

    def opens_shear(self, case: Case) -> bool:
        """Whether a joint is meant, of which the map is a part."""
        return case.question.joint is not None

    def spread(self, case: Case, curves: Curves, variant: str) -> Spread | None:
        """Both ends that the rest of the surface leaves open; None if the map tells of none."""
        curve, tiled = curves.get(variant), tiled_curves(case, curves, variant)
        if curve is None or tiled is None or not case.tells_of_larger:
            return None
        unknown = (np.full_like(curve.force, np.nan),) * 2
        of_stiffness, of_area = (
            each.extrapolated(case.extrapolation) if case.extrapolation.is_supported else unknown
            for each in tiled.stiffness_and_contact()
        )
        of_gap = case.gap_extrapolation
        measures = measures_of_tiles(case, curve, tiled)
        return spread_of_differences(
            Values.of(curve),
            of_stiffness,
            of_area,
            {
                name: each.ends(of_gap) if of_gap.is_supported else unknown
                for name, each in measures.items()
            },
            {name: each.floor for name, each in measures.items()},
        )


def spread_of_differences(
    values: Values,
    of_stiffness: Ends,
    of_area: Ends,
    measures: dict[str, Ends],
    floors: dict[str, Real],
) -> Spread:
    """Ends of values from those of differences of a stiffness's logarithm and an area's logit.

    The stiffness on loading keeps its ratio to that on unloading.
    """
    return Spread(
        LOGARITHM.moved(values.stiffness, of_stiffness),
        LOGARITHM.moved(values.unloading, of_stiffness),
        LOGIT.moved(values.area, of_area),
        measures,
        floors,
    )


def measures_of_tiles(
    case: Case, curve: SurfaceCurve, tiled: TiledCurves
) -> dict[str, LargerMeasure]:
    """What tiles tell of each measure that comes to a number as a surface grows."""
    names = [each.name for each in case.measures if each.intensive]
    return {name: LargerMeasure.of(curve.measured[name].values, name, tiled) for name in names}


def tiled_curves(case: Case, curves: Curves, variant: str) -> TiledCurves | None:
    """Curves of a map and of its tiles, from its periodic curve; None if one is not known."""
    body, curve = case.map, curves.get(variant)
    if body is None or curve is None or not case.loads.grid_error:
        return None
    loads, shape = case.loads.under_forces_from(curve), coarse_shape(body.shape)

    def pieces(name: str) -> list[SurfaceCurve]:
        """Curves over all loads, of which those that were solved were pressed."""
        return [loads.spread(each) for each in curves.of_pieces.get(name, ())]

    of_map = [curve] if shape == body.shape else pieces(_COARSE)
    halves, quarters = pieces(_tiled(2)), pieces(_tiled(4))
    if not of_map or len(halves) < 4 or len(quarters) < 16:
        return None
    whole = curves.complete(variant)
    border = [whole] if has_few_points(body.shape) else pieces(_BORDER)
    points = shape[0] * shape[1]
    return TiledCurves(of_map[0], halves, quarters, points, border[0] if border else None)


def _tiled(count: int) -> str:
    """Name of the tiles of a map that is cut into so many along each side."""
    return f"{count} x {count} tiles"


def _listed(case: Case, map_name: str, body: Surface, purpose: str) -> list[Variant]:
    """The map on fewer points, its tiles, and what tells what its border does."""
    shape = coarse_shape(body.shape)
    measures = [each for each in case.measures if each.intensive]

    @cache
    def coarse(points: int = POINTS_OF_TILES) -> Surface:
        return coarsened(body.detrended(), points)

    def whole(points: int, taken: Sequence[Measure], curves: Curves) -> Pressable:
        loads = _loads_of_pieces(case, curves.get(map_name), taken)
        return None if loads is None else _on_pieces(loads, [coarse(points)])

    def tiles(count: int, curves: Curves) -> Pressable:
        loads = _loads_of_pieces(case, curves.get(map_name), measures)
        return None if loads is None else _on_pieces(loads, cut(coarse(), count))

    found = [Variant(_COARSE, purpose, partial(whole, POINTS_OF_TILES, measures), shape, True)]
    if shape == body.shape:
        found.clear()
    found += [
        Variant(_tiled(count), purpose, partial(tiles, count), shape, True) for count in (2, 4)
    ]
    if case.measures_at_border and not has_few_points(body.shape):
        coarser = coarse_shape(body.shape, POINTS_OF_BORDER)
        taken = [*measures, *case.measures_at_border]
        needed = partial(whole, POINTS_OF_BORDER, taken)
        found.append(Variant(_BORDER, purpose, needed, coarser, True))
    return found


def _loads_of_pieces(
    case: Case, curve: SurfaceCurve | None, measures: Sequence[Measure]
) -> LoadCase | None:
    """The map under the forces of its periodic curve, in a periodic half-space, no better known."""
    if curve is None or curve.stiffness_error is None or broken("grid", case.body):
        return None
    loads = case.loads.under_forces_from(curve)
    if not loads.forces:
        return None
    repeated = replace(loads, half_space=loads.half_space.interface, measures=measures, rtol=_RTOL)
    return replace(repeated, levelled=False)


def _on_pieces(loads: LoadCase, pieces: Sequence[Surface]) -> list[Pressing]:
    """The same mean pressures on pieces, without those whose grid does not resolve a pull."""
    pull, found = loads.attraction, []
    for piece in pieces:
        if pull and not pull.is_resolved(max(piece.spacing), loads.half_space.softest):
            continue
        share = piece.area / nominal_area(loads.body)
        forces = [share * each for each in loads.forces]
        found.append(replace(loads, body=piece, forces=forces).pressing())
    return found
