"""In which ways the body of a case is pressed, and the curves of all of them.

The list is made before anything is pressed, and is an upper bound: what a way needs is known from
the curves before it, which may show that it is needless.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import Final, Literal

import numpy as np

from roughline.assessment.assumptions import broken
from roughline.assessment.case import Case
from roughline.assessment.hardness import Hardness
from roughline.assessment.kinds import nominal_area
from roughline.assessment.loads import LoadCase, LoadProgress, load_with_fields
from roughline.assessment.source import pressed_body
from roughline.assessment.tiles import coarse_shape, coarsened, has_tiles, tiles_of
from roughline.computing.arrays import Mask
from roughline.contact.curve import Curve
from roughline.errors import Interrupted
from roughline.topography.body import Body, Surface
from roughline.topography.missing import Missing

AS_ASKED: Final = "as asked"
UNLOADED = "unloaded"
"""From the largest load, where bodies yield and slip."""

ELASTIC, SOFTEST, HARDEST = "elastic", "softest", "hardest"
AS_HARD = "as hard on half as many points a side"
"""What a large body's softest and hardest are compared with."""

COARSE = "coarse map"
"""Of which the tiles are, where the map has many points."""

_UNLOADING_LOADS = 16
"""Loads on the way back from the largest one, which partial slip follows where bodies yield."""

_LIGHTEST = 1e-3  # of them, over the largest
_RTOL_OF_TILES = 1e-4  # their scatter need not be known better


Purpose = Literal["as asked", "filling", "interface", "larger surface", "hardness", "slip"]
"""What a variant is pressed for."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Curves of the variants that were pressed, by their names.

    Attributes
    ----------
    by_name : mapping of str to Curve
        Without the variants that proved needless.
    stopped : str
        The variant whose curve is not whole, as Ctrl-C came; empty where all is done.
    """

    by_name: Mapping[str, Curve]
    stopped: str = ""

    @property
    def as_asked(self) -> Curve:
        """Curve of the body as it was asked for."""
        return self.by_name[AS_ASKED]

    def get(self, name: str) -> Curve | None:
        """The curve of a variant, whole or as far as it came."""
        return self.by_name.get(name)

    def whole(self, name: str) -> Curve | None:
        """The curve of a variant; None if it is not whole."""
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
class Pressing:
    """What is pressed, and how."""

    body: Body
    loads: LoadCase
    fields: Sequence[int] = ()
    rtol: float = 1e-6


@dataclass(frozen=True, eq=False)
class Variant:
    """One way in which the body of a case is pressed.

    Attributes
    ----------
    name : str
        By which its curve is found.
    purpose : {"as asked", "filling", "interface", "larger surface", "hardness", "slip"}
        What it is pressed for.
    pressing : callable
        What is pressed, from the curves before it; None where they show that it is needless.
    shape : tuple of int
        Points along the sides of a surface, of whose time this takes a share.
    is_periodic : bool
        Whether it is pressed into a periodic half-space.
    share : float, optional
        That share.
    """

    name: str
    purpose: Purpose
    pressing: Callable[[Curves], Pressing | None] = field(repr=False)
    shape: tuple[int, int]
    is_periodic: bool
    share: float = 1.0


class Stopped(KeyboardInterrupt):
    """Ctrl-C came while variants were pressed.

    Attributes
    ----------
    curves : Curves
        Those that are done, and the last one as far as it came.
    """

    def __init__(self, curves: Curves) -> None:
        super().__init__(curves.stopped)
        self.curves = curves


def press_all(variants: Sequence[Variant], loads: int, progress: LoadProgress | None) -> Curves:
    """Press all variants that are needed, in their order, under so many loads.

    Progress is told as (loads done, loads in all), over all variants; those that take a part of the
    time count as that part.

    Raises
    ------
    Stopped
        On Ctrl-C, with the curves that are done.
    """
    done: dict[str, Curve] = {}
    points = max(math.prod(each.shape) for each in variants)
    steps = [math.ceil(loads * each.share * math.prod(each.shape) / points) for each in variants]
    before, total = 0, sum(steps)
    for variant, here in zip(variants, steps, strict=True):
        needed = variant.pressing(Curves(done))
        if needed is not None:
            tell = partial(_tell, progress, before, here, total) if progress else None
            try:
                curve = needed.loads.press(needed.body, needed.fields, tell, needed.rtol)
            except Interrupted as stop:
                raise Stopped(Curves({**done, variant.name: stop.curve}, variant.name)) from stop
            # fields and dents are large, and only those of the first are looked at
            done[variant.name] = replace(curve, fields=(), dents=()) if done else curve
        before += here
    if progress is not None:
        progress(total, total)
    return Curves(done)


def _tell(progress: LoadProgress, before: int, here: int, total: int, done: int, of: int) -> None:
    """Tell of the loads of one variant, which counts as so many here."""
    progress(before + here * done // max(of, 1), total)


def variants_of(case: Case) -> list[Variant]:
    """All ways in which the body of a case may be pressed, in their order."""
    kept = [load_with_fields(case.loads)] if case.question.fields else []
    body = case.body
    first = Pressing(body, case.loads, kept)
    if not isinstance(body, Surface):
        shape = 1, body.heights.size
        return [Variant(AS_ASKED, AS_ASKED, lambda _: first, shape, case.loads.periodic)]
    listed = [Variant(AS_ASKED, AS_ASKED, lambda _: first, body.shape, case.loads.periodic)]
    if case.filled:
        listed.append(_filled_otherwise(case, listed[0], body))
    listed += _of_the_larger_surface(case, listed[0], with_tiles=True)
    listed += _of_other_hardness(case)
    if case.question.friction is not None and case.hardness is not None:
        share = _UNLOADING_LOADS / case.loads.count
        pressing = partial(_unloaded, case)
        listed.append(Variant(UNLOADED, "slip", pressing, body.shape, case.loads.periodic, share))
    return listed


def _unloaded(case: Case, curves: Curves) -> Pressing | None:
    """Press the surface that the largest load left, up to that load."""
    curve, largest = curves.as_asked, case.loads.largest
    if not curve.converged[largest]:
        return None
    forces = float(curve.force[largest]) * np.geomspace(_LIGHTEST, 1.0, _UNLOADING_LOADS)
    loads = LoadCase(curve.E_star, forces.tolist(), [], (), None, case.loads.periodic)
    return Pressing(curve.surface_after(largest), loads)


def _filled_otherwise(case: Case, variant: Variant, body: Surface) -> Variant:
    """The same with missing points filled by the other method, if that changes something."""

    def pressing(curves: Curves) -> Pressing | None:
        first = variant.pressing(curves)
        curve = curves.get(variant.name)
        if first is None or curve is None:
            return None
        other = _with_other_filling(case)
        if np.array_equal(other.heights, body.heights):
            return None
        again = replace(first.loads, grid_error=False)
        if again.n_loads is not None and curve.converged.all():
            again = again.under_forces_of(curve)  # the same forces, not new ones
        return Pressing(other, again)

    name = filled_otherwise(variant.name)
    return replace(variant, name=name, purpose="filling", pressing=pressing)


def _with_other_filling(case: Case) -> Body:
    method = Missing(case.parts[0].reading.missing).other
    return pressed_body([each.filled_by(method) for each in case.filled])


def _of_other_hardness(case: Case) -> list[Variant]:
    """The body without yield, and as soft and as hard as it may be."""
    hardness, body = case.hardness, case.body
    if hardness is None or case.pair is None or not isinstance(body, Surface):
        return []
    listed = []
    for name, value, judged in ways(case, hardness):
        pressing = partial(_as_hard, case, name, value, judged)
        share = judged.heights.size / body.heights.size
        variant = Variant(name, "hardness", pressing, body.shape, case.loads.periodic, share)
        listed += [variant, *_of_the_larger_surface(case, variant)]
    return listed


def ways(case: Case, hardness: Hardness) -> list[tuple[str, float | None, Body]]:
    """Names of the variants of the hardness, their hardness, None of elastic ones, and bodies."""
    listed: list[tuple[str, float | None, Body]] = [(ELASTIC, None, case.body)]
    if hardness.factor != 1:
        softest, hardest = hardness.ends
        if case.judged is not case.body:
            listed.append((AS_HARD, hardness.value, case.judged))
        listed += [(SOFTEST, softest, case.judged), (HARDEST, hardest, case.judged)]
    return listed


def _as_hard(
    case: Case, name: str, hardness: float | None, judged: Body, curves: Curves
) -> Pressing | None:
    """Press the body with another hardness, under the loads that it bears then."""
    curve = curves.as_asked
    if name == ELASTIC and not yields(curve):
        return None
    loads = borne_by(case, curve, hardness)
    if is_same(case, curve, hardness, judged) or not loads.any():
        return None
    return Pressing(judged, case.loads.of_hardness(hardness, loads, curve))


def is_same(case: Case, curve: Curve, hardness: float | None, judged: Body) -> bool:
    """Whether the curve as asked is that of a harder body as well, as nothing yields."""
    if hardness is None or judged is not case.body or yields(curve):
        return False
    return hardness >= (curve.hardness or 0)


def yields(curve: Curve) -> bool:
    """Whether some of the contact is at the hardness, under any load."""
    return curve.plastic_fraction is not None and bool(np.nan_to_num(curve.plastic_fraction).any())


def borne_by(case: Case, curve: Curve, hardness: float | None) -> Mask:
    """Which loads of the curve as asked were solved, and are borne by a body of a hardness.

    What a load leaves that is too large is not known, nor are those after it.
    """
    if hardness is None or case.loads.depths:
        return curve.converged
    largest = np.maximum.accumulate(np.nan_to_num(curve.force))
    return curve.converged & (largest < hardness * nominal_area(case.body))


def _of_the_larger_surface(
    case: Case, variant: Variant, *, with_tiles: bool = False
) -> list[Variant]:
    """The same into a periodic half-space, and the tiles of the map, for what it is a piece of."""
    body = case.map
    if body is None:
        return []
    listed: list[Variant] = []
    repeated = variant
    if not case.loads.periodic:
        repeated = replace(
            variant,
            name=periodic(variant.name),
            purpose="interface" if variant.name == AS_ASKED else variant.purpose,
            pressing=partial(_repeated, variant),
            is_periodic=True,
        )
        listed.append(repeated)
        if with_tiles and case.filled:
            listed.append(_filled_otherwise(case, repeated, body))
    return listed + (_tiles(case, repeated.name, body) if with_tiles else [])


def _repeated(variant: Variant, curves: Curves) -> Pressing | None:
    """Press the same body periodically, under the forces that it bears."""
    first, curve = variant.pressing(curves), curves.get(variant.name)
    if first is None or curve is None or not first.loads.borne(curve).any():
        return None
    again = first.loads.under_forces_of(curve)
    return Pressing(first.body, replace(again, periodic=True, levelled=True))


def _tiles(case: Case, whole: str, body: Surface) -> list[Variant]:
    """The map on fewer points, and its tiles, under the mean pressures of its periodic curve."""
    if not case.loads.grid_error or not has_tiles(body):
        return []
    shape = coarse_shape(body.shape)
    of_larger: Purpose = "larger surface"

    @cache
    def coarse() -> Surface:
        return coarsened(body.detrended())

    @cache
    def cut(count: int) -> list[Surface]:
        return tiles_of(coarse(), count)

    def pressing(of: Callable[[], Surface], curves: Curves) -> Pressing | None:
        curve = curves.get(whole)
        if curve is None or curve.stiffness_error is None or broken("grid", body):
            return None
        borne = case.loads.borne(curve)
        if not borne.any():
            return None
        tile = of()
        forces = curve.force[borne] / body.area * tile.area
        settings = replace(
            case.loads, forces=forces.tolist(), depths=[], n_loads=None, periodic=True
        )
        return Pressing(
            tile, replace(settings, levelled=False, grid_error=False), rtol=_RTOL_OF_TILES
        )

    listed = []
    if shape != body.shape:
        listed.append(Variant(COARSE, of_larger, partial(pressing, coarse), shape, True))
    for count in (2, 4):
        for i in range(count**2):
            of = partial(lambda count, i: cut(count)[i], count, i)
            part = 1 / count**2
            listed.append(
                Variant(tile(count, i), of_larger, partial(pressing, of), shape, True, part)
            )
    return listed
