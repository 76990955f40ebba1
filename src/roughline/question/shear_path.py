"""The loads by which a shear force goes to and fro on the body of a case."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughline.contact.shear_loads import cycle
from roughline.question.case import Case
from roughline.question.kinds import nominal_area
from roughline.question.loads import LoadCase
from roughline.topography.body import Surface

_PER_CYCLE = 16
_CYCLES = {False: 1, True: 3}  # of uncoupled bodies, whose cycles are alike, and of coupled ones
_PRESSING_LOADS = {False: 1, True: 8}  # up to the load


@dataclass(frozen=True)
class ShearPath:
    """Loads that press, under no shear, and then cycles of the shear force under the last one."""

    friction: float  # coefficient [1]
    amplitude: float  # [N]
    pressing: int  # loads up to the normal one
    cycles: int
    per_cycle: int = _PER_CYCLE

    @classmethod
    def of(cls, case: Case) -> ShearPath | None:
        """The path of a case; None where no shear is asked for."""
        question = case.question
        shear, friction = question.shear, question.friction
        body = None if shear is None else question.sheared_half_space
        if shear is None or friction is None or body is None:
            return None
        coupled = body.is_coupled
        cycles = shear.cycles or _CYCLES[coupled]
        amplitude = question.shear_on(nominal_area(case.body))
        return cls(friction, amplitude, _PRESSING_LOADS[coupled], cycles)

    @property
    def in_half_as_many(self) -> ShearPath:
        """The same way in half as many loads."""
        return replace(self, pressing=self.pressing // 2, per_cycle=self.per_cycle // 2)

    @property
    def shear_forces(self) -> list[tuple[float, float]]:
        """Shear forces of all loads. [N]"""
        before = [(0.0, 0.0)] * (self.pressing - 1)
        return before + cycle(self.amplitude, per_cycle=self.per_cycle, cycles=self.cycles)

    def forces(self, force: float) -> list[float]:
        """Forces of all loads, up to a normal one. [N]"""
        rising = np.linspace(0.0, force, self.pressing + 1)[1:-1].tolist()
        return rising + [force] * (len(self.shear_forces) - len(rising))

    def on(self, body: Surface, case: Case, force: float) -> LoadCase | None:
        """The path on a body under a force [N], with the fields of both ends of the last cycle."""
        half_space, last = case.question.sheared_half_space, len(self.shear_forces) - 1
        if half_space is None:
            return None
        alone = case.loads.alone_under(self.forces(force))
        ends = [last - self.per_cycle, last]
        loads = replace(alone, body=body, fields=ends)
        return loads.sheared(half_space, self.friction, self.shear_forces)
