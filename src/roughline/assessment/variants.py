"""In which ways the body of a case is pressed, and the curves of all of them.

The list is made before anything is pressed, and is an upper bound: what a way needs is known from
the curves before it, which may show that it is needless.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cache, partial
from typing import Literal

import numpy as np

from roughline.assessment.assumptions import broken
from roughline.assessment.case import Case
from roughline.assessment.filled import force_on
from roughline.assessment.films import SPOT_RADIUS, find_film, hardness_ends
from roughline.assessment.loads import LoadCase, LoadProgress
from roughline.assessment.tiles import (
    FEWEST_POINTS,
    POINTS_OF_BORDER,
    coarse_shape,
    coarsened,
    cut_tiles,
)
from roughline.computing.arrays import Mask
from roughline.contact.arguments import yielding_law
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.measures import Measure
from roughline.contact.selection import among_loads, at_loads
from roughline.engineering.pressed import Sought, yields
from roughline.errors import Interrupted
from roughline.question.kinds import nominal_area
from roughline.question.source import pressed_body
from roughline.topography.body import Body, Surface


class Way(StrEnum):
    """In which way a body is pressed; the names of variants begin so."""

    AS_ASKED = "as asked"
    UNLOADED = "unloaded"  # from the largest load, where bodies yield and slip
    ELASTIC = "elastic"
    SOFTEST = "softest"
    HARDEST = "hardest"
    AS_HARD = "as hard on half as many points a side"  # for the softest and hardest of large bodies
    COARSE = "coarse map"  # of which the tiles are, where the map has many points
    BORDER = "coarser map"  # that tells what its border does to what flows


_UNLOADING_LOADS = 16
"""Loads on the way back from the largest one, which partial slip follows where bodies yield."""

_LIGHTEST_SHARE = 1e-3  # of them, over the largest
_RTOL_OF_TILES = 1e-4  # their scatter need not be known better


Purpose = Literal["as asked", "filling", "interface", "larger surface", "hardness", "slip"]
"""What a variant is pressed for."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Curves of the variants that were pressed, by their names, over the loads of the case."""

    by_name: Mapping[str, Curve]  # without the variants that proved needless
    sought: Mapping[str, Sought] = field(default_factory=dict)  # beyond the loads, if asked for
    stopped: str = ""  # whose curve is not whole, as Ctrl-C came; empty where all is done

    @property
    def as_asked(self) -> Curve:
        """Curve of the body as it was asked for."""
        return self.by_name[Way.AS_ASKED]

    def get(self, name: str) -> SurfaceCurve | None:
        """The curve of a surface in a variant, whole or as far as it came; None of a line."""
        curve = self.by_name.get(name)
        return curve if isinstance(curve, SurfaceCurve) else None

    def complete(self, name: str) -> SurfaceCurve | None:
        """The curve of a surface in a variant; None if it is not whole."""
        return None if name == self.stopped else self.get(name)


def periodic(name: str) -> str:
    """Name of the variant that is pressed as another, but into a periodic half-space."""
    return f"{name}, periodic"


def filled_otherwise(name: str) -> str:
    """Name of the variant that is pressed as another, but with missing points filled otherwise."""
    return f"{name}, filled otherwise"


def tile(count: int, i: int) -> str:
    """Name of a tile of a map that is cut into so many along each side."""
    return f"tile {i + 1} of {count} x {count}"


@dataclass(frozen=True, eq=False)
class Variant:
    """One way in which the body of a case is pressed."""

    name: str
    purpose: Purpose
    needed: Callable[[Curves], LoadCase | Curve | None]
    """From the curves before it: what is pressed, the curve where it is known without that, or None
    where it is needless."""

    shape: tuple[int, int]  # points along the sides of a surface, of whose time it takes a share
    periodic: bool | Literal["x", "y"]
    share: float = 1.0


class Stopped(KeyboardInterrupt):
    """Ctrl-C came while variants were pressed: with curves that are done, and one not whole."""

    def __init__(self, curves: Curves) -> None:
        super().__init__(curves.stopped)
        self.curves = curves


def press_all(variants: Sequence[Variant], loads: int, progress: LoadProgress | None) -> Curves:
    """Press all variants that are needed, in their order, under so many loads.

    Progress is told as (loads done, loads in all), over all variants; those that take a part of the
    time count as that part. Ctrl-C raises Stopped.
    """
    done: dict[str, Curve] = {}
    points = max(math.prod(each.shape) for each in variants)
    steps = [math.ceil(loads * each.share * math.prod(each.shape) / points) for each in variants]
    before, total = 0, sum(steps)
    for variant, here in zip(variants, steps, strict=True):
        curve = variant.needed(Curves(done))
        if isinstance(curve, LoadCase):
            case = curve
            report = partial(_report, progress, before, here, total) if progress else None
            try:
                curve = case.spread(case.press(report))
            except Interrupted as stop:
                curves = {**done, variant.name: case.spread(stop.curve)}
                raise Stopped(Curves(curves, stopped=variant.name)) from stop
        if curve is not None:
            if done and isinstance(curve, SurfaceCurve):
                curve = replace(curve, dents=())  # large, and only those of the first are looked at
            done[variant.name] = curve
        before += here
    if progress is not None:
        progress(total, total)
    return Curves(done)


def _report(progress: LoadProgress, before: int, here: int, total: int, done: int, of: int) -> None:
    """Tell of the loads of one variant, which counts as so many here."""
    progress(before + here * done // max(of, 1), total)


def list_variants(case: Case) -> list[Variant]:
    """All ways in which the body of a case may be pressed, in their order."""
    loads, body = case.loads, case.body
    if not case.is_repeated_for_interface:
        loads = replace(loads, measures=case.measures)
    if case.filled_points is not None:
        loads = replace(loads, measures=[*loads.measures, force_on(case.filled_points)])
    if find_film(case.question) is not None:
        loads = replace(loads, measures=[*loads.measures, SPOT_RADIUS])
    if case.question.fields:  # of the largest load asked for, or of one at three quarters of them
        loads = replace(loads, fields=[loads.largest if loads.asked else 3 * loads.count // 4])
    shape = body.shape if isinstance(body, Surface) else (1, body.heights.size)
    listed = [Variant(Way.AS_ASKED, "as asked", lambda _: loads, shape, loads.periodic)]
    if not isinstance(body, Surface):
        return listed
    if case.filled:
        listed.append(_filled_otherwise(case, listed[0], body))
    listed += _larger_surface_variants(case, listed[0], with_tiles=True)
    listed += _hardness_variants(case)
    if case.question.friction is not None and case.hardness is not None:
        share = _UNLOADING_LOADS / loads.count
        needed = partial(_unloaded, case)
        listed.append(Variant(Way.UNLOADED, "slip", needed, shape, loads.periodic, share))
    return listed


def _unloaded(case: Case, curves: Curves) -> LoadCase | None:
    """Press the surface that the largest load left, up to that load."""
    curve, largest = curves.get(Way.AS_ASKED), case.loads.largest
    if curve is None or not curve.converged[largest]:
        return None
    forces = float(curve.force[largest]) * np.geomspace(_LIGHTEST_SHARE, 1.0, _UNLOADING_LOADS)
    left = curve.surface_after(largest)
    return LoadCase(left, case.loads.half_space, forces.tolist(), [], None)


def _filled_otherwise(case: Case, variant: Variant, body: Surface) -> Variant:
    """Press with missing points filled by the other method, if that changes something."""

    def needed(curves: Curves) -> LoadCase | None:
        first, curve = variant.needed(curves), curves.get(variant.name)
        if not isinstance(first, LoadCase) or curve is None:
            return None
        method = case.parts[0].reading.missing.other
        other = pressed_body([each.filled_by(method) for each in case.filled])
        if np.array_equal(other.heights, body.heights):
            return None
        if first.n_loads is not None and curve.converged.all():
            first = first.under_forces_from(curve)  # the same forces, not new ones
        return replace(first, body=other, fields=(), grid_error=False)

    name = filled_otherwise(variant.name)
    return replace(variant, name=name, purpose="filling", needed=needed)


def _hardness_variants(case: Case) -> list[Variant]:
    """The body without yield, and as soft and as hard as it may be."""
    hardness, body = case.hardness, case.body
    if hardness is None or case.pair is None or not isinstance(body, Surface):
        return []
    ways: list[tuple[Way, Body]] = [(Way.ELASTIC, body)]
    if hardness.factor != 1:
        scatter_body = case.scatter_body
        if scatter_body is not body:
            ways.append((Way.AS_HARD, scatter_body))
        ways += [(Way.SOFTEST, scatter_body), (Way.HARDEST, scatter_body)]
    listed = []
    for name, pressed in ways:
        needed = partial(_as_hard, case, name, pressed)
        share = pressed.heights.size / body.heights.size
        variant = Variant(name, "hardness", needed, body.shape, case.loads.periodic, share)
        listed += [variant, *_larger_surface_variants(case, variant)]
    return listed


def hardness_in(case: Case, way: Way, curve: Curve) -> float | None:
    """The hardness in a way, from the curve as asked; None if bodies are elastic. [Pa]"""
    ends = hardness_ends(case.question, curve)
    if ends is None or case.hardness is None or way == Way.ELASTIC:
        return None
    return {Way.AS_HARD: case.hardness.value, Way.SOFTEST: ends[0], Way.HARDEST: ends[1]}[way]


def _as_hard(case: Case, way: Way, body: Body, curves: Curves) -> LoadCase | Curve | None:
    """Press the body with another hardness, under the loads that it bears then.

    As long as nothing yields, the curve as asked is that of a harder body as well.
    """
    curve = curves.as_asked
    hardness = hardness_in(case, way, curve)
    if not yields(curve):
        if hardness is None:
            return None
        if body is case.body and hardness >= (curve.hardness or 0):
            settings = {**curve.settings, "hardness": hardness}
            return replace(curve, law=yielding_law(hardness), settings=settings)
    loads = _loads_below(case, curve, hardness)
    if not loads.any():
        return among_loads(at_loads(curve, np.flatnonzero(loads)), loads)
    measures = () if case.is_repeated_for_interface else case.measures
    of_hardness = case.loads.with_hardness(hardness, loads, curve)
    return replace(of_hardness, body=body, measures=measures)


def _loads_below(case: Case, curve: Curve, hardness: float | None) -> Mask:
    """Which loads of the curve as asked were solved, and are borne by a body of a hardness.

    What a load leaves that is too large is not known, nor are those after it.
    """
    if hardness is None or case.loads.depths:
        return curve.converged
    largest = np.maximum.accumulate(np.nan_to_num(curve.force))
    return curve.converged & (largest < hardness * nominal_area(case.body))


def _larger_surface_variants(
    case: Case, variant: Variant, *, with_tiles: bool = False
) -> list[Variant]:
    """A variant in a periodic half-space, and the tiles of the map, for what it is a piece of."""
    body = case.map
    if body is None:
        return []
    listed: list[Variant] = []
    repeated = variant
    if case.is_repeated_for_interface:
        repeated = replace(
            variant,
            name=periodic(variant.name),
            purpose="interface" if variant.name == Way.AS_ASKED else variant.purpose,
            needed=partial(_repeated, case, variant),
            periodic=True,
        )
        listed.append(repeated)
        if with_tiles and case.filled:
            listed.append(_filled_otherwise(case, repeated, body))
    return listed + (_tiles(case, repeated.name, body) if with_tiles else [])


def _repeated(case: Case, variant: Variant, curves: Curves) -> LoadCase | Curve | None:
    """Press the same body periodically, under the forces that it bears."""
    first, curve = variant.needed(curves), curves.get(variant.name)
    if isinstance(first, Curve):  # as asked, or under no load
        return curves.get(periodic(Way.AS_ASKED)) if first.converged.any() else None
    if first is None or curve is None:
        return None
    if first.lifted is not None and first.lifted.all():  # what seals is known nevertheless
        interface = first.half_space.interface
        return replace(
            first, half_space=interface, levelled=True, fields=(), measures=case.measures
        )
    if not first.solved_loads(curve).any():
        return None
    under = first.under_forces_from(curve)
    loads = replace(under, half_space=under.half_space.interface, levelled=True)
    if case.question.sealing is None:
        loads = replace(loads, fields=())  # nobody looks into its gap
    return replace(loads, measures=case.measures)


def _tiles(case: Case, map_name: str, body: Surface) -> list[Variant]:
    """The map on fewer points, and its tiles, under the mean pressures of its periodic curve."""
    if not case.loads.grid_error or min(body.shape) < FEWEST_POINTS or case.question.coated:
        return []
    shape = coarse_shape(body.shape)
    measures = [each for each in case.measures if each.intensive]

    @cache
    def pieces(count: int) -> list[Surface]:
        return cut_tiles(pieces(1)[0], count) if count > 1 else [coarsened(body.detrended())]

    def needed(count: int, i: int, curves: Curves) -> LoadCase | None:
        return _press_piece(case, curves.get(map_name), lambda: pieces(count)[i], measures)

    def needed_for_border(curves: Curves) -> LoadCase | None:
        taken = [*measures, *case.measures_at_border]
        return _press_piece(
            case, curves.get(map_name), lambda: coarsened(pieces(1)[0], POINTS_OF_BORDER), taken
        )

    listed = [
        Variant(
            tile(count, i) if count > 1 else Way.COARSE,
            "larger surface",
            partial(needed, count, i),
            shape,
            periodic=True,
            share=1 / count**2,
        )
        for count in ((2, 4) if shape == body.shape else (1, 2, 4))
        for i in range(count**2)
    ]
    if case.measures_at_border:
        coarser = coarse_shape(body.shape, POINTS_OF_BORDER)
        listed.append(Variant(Way.BORDER, "larger surface", needed_for_border, coarser, True))
    return listed


def _press_piece(
    case: Case,
    curve: SurfaceCurve | None,
    piece: Callable[[], Surface],
    measures: Sequence[Measure],
) -> LoadCase | None:
    """Press a piece, or the map on fewer points, periodically as the map was: no better known."""
    body = case.body
    if curve is None or curve.stiffness_error is None or broken("grid", body):
        return None
    loads = case.loads.under_forces_from(curve)
    if not loads.forces:
        return None
    pressed, attraction = piece(), loads.attraction
    if attraction and not attraction.is_resolved(max(pressed.spacing), loads.half_space.softest):
        return None
    forces = (np.array(loads.forces) / nominal_area(body) * pressed.area).tolist()
    loads = replace(loads, body=pressed, forces=forces, half_space=loads.half_space.interface)
    loads = replace(loads, measures=measures, rtol=_RTOL_OF_TILES)
    return replace(loads, levelled=False, grid_error=False)
