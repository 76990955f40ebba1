"""A shear force to and fro: the body and its path, and the same as causes follow it otherwise."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from roughline.contact.curve import SurfaceCurve
from roughline.contact.estimates import TIMES_WITH_FRICTION
from roughline.contact.sliding import SlidingCurve
from roughline.engineering.slip import ShearCycles
from roughline.margins.variant import AS_ASKED, Curves, Pressable, Variant
from roughline.question.case import Case
from roughline.question.loads import LoadCase
from roughline.question.shear_path import ShearPath
from roughline.topography.body import Surface

SHEARED = "sheared"
"""Name of the variant that is sheared under the load, to and fro; those of others begin so."""

_PLAIN = "without shear"  # under the forces of Jäger's stick areas


def _always(curves: Curves) -> bool:
    return True


@dataclass(frozen=True, eq=False)
class ShearedBody:
    """A body, and the path along which it is sheared."""

    body: Surface
    path: ShearPath
    times: float = 1.0
    """The path as asked may be off by so many times its distance from this one."""

    by_micro_slip: bool = False  # and what follows from slip at least by that of the micro-slip
    tells: Callable[[Curves], bool] = _always  # whether it does, as the curves of its load say

    @classmethod
    def of(cls, case: Case) -> ShearedBody | None:
        """The body and the path of a case; None where no shear is asked for."""
        path = ShearPath.of(case)
        return cls(case.body, path) if path is not None and isinstance(case.body, Surface) else None


def shear_presses(
    case: Case, as_asked: Variant, otherwise: Mapping[str, ShearedBody | None]
) -> list[Variant]:
    """What is pressed where a shear is asked for: its path, as causes follow it, and without it.

    `otherwise` is what each cause that leaves its answers open follows; None where it is not known.
    """
    asked = ShearedBody.of(case)
    if asked is None:
        return []
    listed = [_variant(case, as_asked, SHEARED, "shear", asked)]
    for name, other in otherwise.items():
        if other is not None:
            listed.append(_variant(case, as_asked, _named(name), name, other))
    if not case.question.coated:
        plain = len(_plain_forces(asked.path, 1.0)) / case.loads.count
        needed = partial(_without_shear, case, asked.path)
        listed.append(replace(as_asked, name=_PLAIN, purpose="slip", needed=needed, share=plain))
    return listed


def sheared_as(
    case: Case,
    as_asked: Variant,
    way: str,
    body: Surface,
    needed: Callable[[Callable[[Curves], LoadCase | None], Curves], Pressable],
) -> Variant | None:
    """The path on a body of another hardness, if a shear is asked for.

    `needed` is told what is pressed of the body as hard as asked.
    """
    if (asked := ShearedBody.of(case)) is None:
        return None
    other = replace(asked, body=body)
    along = partial(_along, case, other)
    variant = _variant(case, as_asked, _named(way), "hardness", other)
    return replace(variant, needed=partial(needed, along))


def cycles_as(case: Case, curves: Curves, way: str) -> ShearCycles | None:
    """What the path gave of a body of another hardness; None where not all of it was solved."""
    asked = ShearedBody.of(case)
    return None if asked is None else _cycles(asked, curves.complete(_named(way)))


def shear_cycles(
    case: Case, curves: Curves, otherwise: Mapping[str, ShearedBody | None]
) -> ShearCycles | None:
    """What the path of a case gave; None without one, and where not all of it was solved."""
    asked, pair = ShearedBody.of(case), case.pair
    found = None if asked is None else _cycles(asked, curves.complete(SHEARED))
    if found is None or pair is None:
        return None
    others = {
        name: None if each is None else _cycles(each, curves.complete(_named(name)))
        for name, each in otherwise.items()
    }
    ratio = None if pair.coated else pair.E_star / pair.G_star
    return replace(found, plain=curves.complete(_PLAIN), ratio=ratio, others=others)


def _named(cause: str) -> str:
    return f"{SHEARED}, {cause}"


def _variant(
    case: Case, as_asked: Variant, name: str, purpose: str, sheared: ShearedBody
) -> Variant:
    """A body that is sheared, as one entry of the list of presses."""
    half_space = case.question.sheared_half_space
    coupled = half_space is not None and half_space.is_coupled
    loads = len(sheared.path.shear_forces)
    return replace(
        as_asked,
        name=name,
        purpose=purpose,
        needed=partial(_along, case, sheared),
        shape=sheared.body.shape,
        share=TIMES_WITH_FRICTION[coupled] * loads / case.loads.count,
        rubs=True,
    )


def _along(case: Case, sheared: ShearedBody, curves: Curves) -> LoadCase | None:
    """A body along its path; None where the load was not solved, or where it tells nothing."""
    force = _force(case, curves)
    if force is None or not sheared.tells(curves):
        return None
    return sheared.path.on(sheared.body, case, force)


def _without_shear(case: Case, path: ShearPath, curves: Curves) -> LoadCase | None:
    """The body under the forces of its stick areas; None where its load was not solved."""
    force = _force(case, curves)
    return None if force is None else case.loads.alone_under(_plain_forces(path, force))


def _plain_forces(path: ShearPath, force: float) -> list[float]:
    """Forces of Jäger's stick areas, on unloading to that at the largest shear force. [N]"""
    least = force - path.amplitude / path.friction
    return np.linspace(force, least, path.per_cycle + 1).tolist()  # an odd number, for Simpson


def _force(case: Case, curves: Curves) -> float | None:
    """The force that presses the body; None if that was not solved. [N]"""
    curve, largest = curves.by_name[AS_ASKED], case.loads.largest
    return float(curve.force[largest]) if curve.converged[largest] else None


def _cycles(sheared: ShearedBody, curve: SurfaceCurve | None) -> ShearCycles | None:
    """What a path gave; None where not all of it was solved."""
    if not isinstance(curve, SlidingCurve) or not curve.converged.all():
        return None
    path = sheared.path
    of_path = curve, path.friction, path.pressing - 1, path.per_cycle, path.cycles
    return ShearCycles(*of_path, times=sheared.times, by_micro_slip=sheared.by_micro_slip)
