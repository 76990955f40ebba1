"""A shear force that goes to and fro: the path that is pressed for it, and what it gave."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from roughline.contact.curve import SurfaceCurve
from roughline.contact.shear_loads import cycle
from roughline.contact.sliding import SlidingCurve
from roughline.engineering.margin import Margin
from roughline.engineering.rule import Answer
from roughline.engineering.rules.friction import SHEAR_ANSWERS
from roughline.engineering.slip import ShearCycles
from roughline.margins.causes import causes
from roughline.margins.variant import AS_ASKED, Curves, Variant
from roughline.question.assumptions import broken
from roughline.question.case import Case
from roughline.question.kinds import nominal_area
from roughline.question.loads import LoadCase
from roughline.topography.body import Surface

SHEARED = "sheared"
"""Name of the variant that is sheared under the load, to and fro."""

_COARSER = "sheared, on half as many points"
_PLAIN = "without shear"  # under the forces of Jäger's stick areas
_PLAIN_LOADS = 17  # of them, even; an odd number for Simpson's rule
_PER_CYCLE = 16
_CYCLES = {False: 1, True: 3}  # of uncoupled bodies, whose cycles are alike, and of coupled ones
_PRESSING_LOADS = {False: 1, True: 8}  # up to the load
_STEPS = "steps", "how finely the way is cut", "a path of more loads, as rl.press takes it"
_TAKES = {False: 6, True: 60}  # times as long as a load without friction, in exact convolutions


@dataclass(frozen=True)
class _ShearPath:
    """The loads by which a case is sheared, of its body."""

    friction: float  # coefficient [1]
    amplitude: float  # [N]
    pressing: int  # loads up to the normal one
    cycles: int
    takes: int  # times as long as a load without friction

    @classmethod
    def of(cls, case: Case) -> _ShearPath | None:
        """The path of a case; None where no shear is asked for."""
        question = case.question
        shear, friction = question.shear, question.friction
        body = None if shear is None else question.sheared_half_space
        if shear is None or friction is None or body is None:
            return None
        coupled = body.is_coupled
        cycles = shear.cycles or _CYCLES[coupled]
        amplitude = question.shear_on(nominal_area(case.body))
        return cls(friction, amplitude, _PRESSING_LOADS[coupled], cycles, _TAKES[coupled])

    @property
    def shear_forces(self) -> list[tuple[float, float]]:
        """Shear forces of all loads. [N]"""
        before = [(0.0, 0.0)] * (self.pressing - 1)
        return before + cycle(self.amplitude, per_cycle=_PER_CYCLE, cycles=self.cycles)

    def forces(self, force: float) -> list[float]:
        """Forces of all loads, up to a normal one. [N]"""
        rising = np.linspace(0.0, force, self.pressing + 1)[1:-1].tolist()
        return rising + [force] * (len(self.shear_forces) - len(rising))


def shear_presses(case: Case, as_asked: Variant) -> list[Variant]:
    """What is pressed where a shear force is asked for: its path, and what compares with it."""
    path = _ShearPath.of(case)
    if path is None:
        return []
    count = case.loads.count
    share = path.takes * len(path.shear_forces) / count
    loads = partial(_loads_of_path, case, path)
    of_path = replace(as_asked, name=SHEARED, purpose="shear", needed=loads, share=share)
    listed = [of_path]
    if _has_grid_error(case):
        shape = as_asked.shape[0] // 2, as_asked.shape[1] // 2
        coarser = partial(_loads_on_half_the_points, case, path)
        listed.append(replace(of_path, name=_COARSER, needed=coarser, shape=shape))
    if not case.question.coated:
        needed = partial(_loads_without_shear, case, path)
        share = _PLAIN_LOADS / count
        listed.append(replace(as_asked, name=_PLAIN, purpose="slip", needed=needed, share=share))
    return listed


def _loads_of_path(case: Case, path: _ShearPath, curves: Curves) -> LoadCase | None:
    """The body along the path; None where its load was not solved."""
    force, body = _force(case, curves), case.question.sheared_half_space
    if force is None or body is None:
        return None
    last = len(path.shear_forces) - 1
    loads = replace(_alone(case, path.forces(force)), fields=[last - _PER_CYCLE, last])
    return loads.sheared(body, path.friction, path.shear_forces)


def _has_grid_error(case: Case) -> bool:
    """Whether the path is followed on a coarser grid as well.

    Other places of a joint, and other fillings, leave its answers open as well, and are not known.
    Half as many points need not resolve a layer.
    """
    body = case.body
    if not isinstance(body, Surface) or body.shape[0] % 2 or body.shape[1] % 2:
        return False
    question = case.question
    is_alone = question.joint is None and not question.coated and not case.filled
    return case.loads.grid_error and is_alone and not broken("grid", body)


def _loads_on_half_the_points(case: Case, path: _ShearPath, curves: Curves) -> LoadCase | None:
    """The path of the body on half as many points a side."""
    loads = _loads_of_path(case, path, curves)
    if loads is None or not isinstance(loads.body, Surface):
        return None
    return replace(loads, body=loads.body.coarsened())


def _loads_without_shear(case: Case, path: _ShearPath, curves: Curves) -> LoadCase | None:
    """The body under the forces of its stick areas; None where its load was not solved."""
    force = _force(case, curves)
    if force is None:
        return None
    least = force - path.amplitude / path.friction
    return _alone(case, np.linspace(least, force, _PLAIN_LOADS).tolist())


def _alone(case: Case, forces: list[float]) -> LoadCase:
    """The body of a case under other forces, without all that is found beside."""
    return replace(
        case.loads,
        forces=forces,
        asked=(),
        fields=(),
        measures=(),
        grid_error=False,
        lifted=None,
    )


def _force(case: Case, curves: Curves) -> float | None:
    """The force that presses the body; None if that was not solved. [N]"""
    curve, largest = curves.by_name[AS_ASKED], case.loads.largest
    return float(curve.force[largest]) if curve.converged[largest] else None


def sheared(case: Case, curves: Curves) -> ShearCycles | None:
    """What the path of a case gave; None without one, and where not all of it was solved."""
    found, coarser = (_sheared(case, curves.complete(name)) for name in (SHEARED, _COARSER))
    pair = case.pair
    if found is None or pair is None:
        return None
    ratio = None if pair.coated else pair.E_star / pair.G_star
    return replace(found, plain=curves.complete(_PLAIN), ratio=ratio, coarser=coarser)


def margins_of_shear(
    case: Case, found: ShearCycles | None, answers: Mapping[str, Answer]
) -> Mapping[str, Sequence[Margin]]:
    """How far each cause leaves open what a shear force does; most of that is not known."""
    if found is None:
        return {}
    is_known = {
        "grid": found.coarser is not None,
        **({"filling": False} if case.filled else {}),
        **({"place": False} if case.question.joint is not None else {}),
    }
    texts = {
        each.name: (each.name, each.title, each.remedy) for each in causes if each.name in is_known
    }
    margins: dict[str, list[Margin]] = {}
    for key, answer in answers.items():
        if answer.rule not in SHEAR_ANSWERS:
            continue
        unknown = np.full_like(answer.values, np.nan), np.full_like(answer.values, np.nan)
        ends = {name: answer.ends if is_known[name] else None for name in texts}
        margins[key] = [Margin(*texts[name], *(each or unknown)) for name, each in ends.items()]
        if found.curve.half_space.is_coupled:
            margins[key].append(Margin(*_STEPS, *unknown))
    return margins


def _sheared(case: Case, curve: SurfaceCurve | None) -> ShearCycles | None:
    """What a path of a case gave on one grid; None where not all of it was solved."""
    path = _ShearPath.of(case)
    if path is None or not isinstance(curve, SlidingCurve) or not curve.converged.all():
        return None
    return ShearCycles(curve, path.friction, path.pressing - 1, _PER_CYCLE, path.cycles)
