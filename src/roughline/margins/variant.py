"""A variant of a case: one body that is pressed, why, and the curves of all that were."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Literal

import numpy as np

from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.measures import Measure
from roughline.contact.press import press
from roughline.contact.pressing import Pressing
from roughline.engineering.pressed import Sought
from roughline.errors import Interrupted
from roughline.margins.tiles import FEWEST_POINTS, has_few_points
from roughline.question.case import Case
from roughline.question.loads import LoadCase, LoadProgress
from roughline.topography.body import Surface

AS_ASKED = "as asked"
"""Name of the variant that is pressed as it was asked for; those of others begin so."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Curves of the variants that were pressed, by their names, over the loads of the case."""

    by_name: Mapping[str, Curve]  # without the variants that proved needless
    of_pieces: Mapping[str, Sequence[SurfaceCurve]] = field(default_factory=dict)
    """Those of surfaces that are one variant, over loads that press them; only of whole lists."""

    sought: Mapping[str, Sought] = field(default_factory=dict)  # beyond the loads, if asked for
    stopped: str = ""  # whose curve is not whole, as Ctrl-C came; empty where all is done
    missing: Sequence[str] = ()  # purposes of those that were not pressed, as Ctrl-C came

    @property
    def as_asked(self) -> Curve:
        """Curve of the body as it was asked for."""
        return self.by_name[AS_ASKED]

    def get(self, name: str) -> SurfaceCurve | None:
        """The curve of a surface in a variant, whole or as far as it came; None of a line."""
        curve = self.by_name.get(name)
        return curve if isinstance(curve, SurfaceCurve) else None

    def complete(self, name: str) -> SurfaceCurve | None:
        """The curve of a surface in a variant; None if it is not whole."""
        return None if name == self.stopped else self.get(name)


Pressable = LoadCase | Sequence[Pressing] | Curve | None
"""What is pressed: a body, or other surfaces as one; the curve where it is known without that; or
None where it is needless."""


@dataclass(frozen=True, eq=False)
class Variant:
    """One body that is pressed, for the answers or for a cause that leaves them open."""

    name: str
    purpose: str  # "as asked", "interface", "punch", "slip", or the name of a cause
    needed: Callable[[Curves], Pressable]
    """From the curves before it: what is pressed."""

    shape: tuple[int, int]  # points along the sides of a surface, of whose time it takes a share
    periodic: bool | Literal["x", "y"]
    share: float = 1.0
    rubs: bool = False  # whether it is sheared, which takes memory of its own


class Stopped(KeyboardInterrupt):
    """Ctrl-C came while variants were pressed: with curves that are done, and one not whole."""

    def __init__(self, curves: Curves) -> None:
        super().__init__(curves.stopped)
        self.curves = curves


def press_all(
    variants: Sequence[Variant],
    loads: int,
    progress: LoadProgress | None,
    *,
    keep_dents: bool = False,
) -> Curves:
    """Press all variants that are needed, in their order, under so many loads.

    The first curve keeps what its loads leave, which is large; others only if that is asked for,
    and from the largest load on. Progress is told as (loads done, loads in all), over all variants;
    those that take a part of the time count as that part. Ctrl-C raises Stopped.
    """
    done: dict[str, Curve] = {}
    pieces: dict[str, Sequence[SurfaceCurve]] = {}
    solved: list[tuple[Pressing, SurfaceCurve]] = []
    points = max(math.prod(each.shape) for each in variants)
    steps = [math.ceil(loads * each.share * math.prod(each.shape) / points) for each in variants]
    before, total = 0, sum(steps)
    for i, (variant, here) in enumerate(zip(variants, steps, strict=True)):
        report = partial(_report, progress, before, here, total) if progress else None
        found: Pressable = None
        try:
            found = variant.needed(Curves(done, pieces))
            if isinstance(found, LoadCase):
                found = found.spread(_pressed(found, report))
            elif isinstance(found, Sequence):
                pieces[variant.name] = _all_pieces(found, solved, report)
        except KeyboardInterrupt as stop:
            if isinstance(found, LoadCase) and isinstance(stop, Interrupted):
                done[variant.name] = found.spread(stop.curve)
            if not done:
                raise
            missing = tuple(dict.fromkeys(each.purpose for each in variants[i:]))
            raise Stopped(Curves(done, pieces, {}, variant.name, missing)) from stop
        if isinstance(found, Curve):
            if done and isinstance(found, SurfaceCurve) and variant.name not in done:
                found = _with_largest_dents(found) if keep_dents else replace(found, dents=())
            done[variant.name] = found
        before += here
    if progress is not None:
        progress(total, total)
    return Curves(done, pieces)


def _with_largest_dents(curve: SurfaceCurve) -> SurfaceCurve:
    """A curve without the dents of loads before its largest one."""
    if not curve.dents:
        return curve
    largest = int(np.argmax(np.where(curve.converged, curve.force, -np.inf)))
    return replace(curve, dents=(*[None] * largest, *curve.dents[largest:]))


def _all_pieces(
    asked: Sequence[Pressing],
    solved: list[tuple[Pressing, SurfaceCurve]],
    progress: LoadProgress | None,
) -> list[SurfaceCurve]:
    """Press surfaces one after the other, each once: one that is solved is not pressed again."""
    curves = []
    for i, each in enumerate(asked):
        curve = next((curve for other, curve in solved if other.tells(each)), None)
        if curve is None:
            curve = each.curve(progress and partial(_report, progress, i, 1, len(asked)))
            solved.append((each, curve))
        curves.append(curve)
    return curves


def _pressed(loads: LoadCase, progress: LoadProgress | None) -> Curve:
    """Press a body under the loads that press it; loads that fail are marked.

    Ctrl-C raises Interrupted.
    """
    if loads.lifted is not None:
        loads = loads.beside_lifted(loads.lifted)
    return press(
        loads.body.detrended() if loads.levelled else loads.body,
        half_space=loads.half_space,
        hardness=loads.hardness,
        law=loads.sticking,
        n_loads=loads.n_loads,
        forces=loads.forces or None,
        depths=loads.depths or None,
        friction=loads.friction,
        shear_forces=loads.shear_forces or None,
        fields=loads.fields if isinstance(loads.body, Surface) else False,
        measures=loads.measures,
        rtol=loads.rtol,
        throw=False,
        progress=progress,
    )


def _report(progress: LoadProgress, before: int, here: int, total: int, done: int, of: int) -> None:
    """Tell of the loads of one variant, which counts as so many here."""
    progress(before + here * done // max(of, 1), total)


def periodic(name: str) -> str:
    """Name of the variant that is pressed as another, but into a periodic half-space."""
    return f"{name}, periodic"


def has_tiles(case: Case) -> bool:
    """Whether tiles of the map are pressed, which tell of the surface that it was cut out of."""
    is_fine = case.map is not None and min(case.map.shape) >= FEWEST_POINTS
    return is_fine and case.loads.grid_error and not case.question.coated


def measures_of_map(case: Case) -> list[Measure]:
    """What is measured as asked: of a map of few points, what its border does as well."""
    is_small = case.map is not None and has_few_points(case.map.shape)
    return [*case.measures, *(case.measures_at_border if is_small and has_tiles(case) else ())]


def larger_name(case: Case, name: str) -> str:
    """Name of the variant that tells of the surface that a map was cut out of: it repeated."""
    return periodic(name) if case.is_repeated_for_interface else name


def repeated(case: Case, variant: Variant) -> Variant:
    """A variant that is pressed into a periodic half-space, under the forces that it bears."""
    purpose = "interface" if variant.name == AS_ASKED else variant.purpose
    return replace(
        variant,
        name=periodic(variant.name),
        purpose=purpose,
        needed=partial(_repeated, case, variant),
        periodic=True,
    )


def _repeated(case: Case, variant: Variant, curves: Curves) -> LoadCase | Curve | None:
    """Press the same body periodically, under the forces that it bears."""
    first, curve = variant.needed(curves), curves.get(variant.name)
    is_as_asked = variant.name == AS_ASKED
    if isinstance(first, Curve):  # as asked, by a law that changes nothing, or under no load
        same = curves.get(periodic(AS_ASKED)) if first.converged.any() else None
        if same is None or not isinstance(first, SurfaceCurve):
            return None
        return replace(same, law=first.law, settings={**same.settings, **first.law.settings})
    if not isinstance(first, LoadCase) or curve is None:
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
    return replace(loads, measures=measures_of_map(case) if is_as_asked else case.measures)
