"""The steps of a path: bodies that pressure and shear move each other follow it load by load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from roughline.facts.fact import Fact
from roughline.margins.cause import Cause
from roughline.margins.sheared import ShearedBody, shear_cycles
from roughline.margins.variant import Curves
from roughline.question.case import Case

_TIMES = 4.0  # of how far half as many loads are away: many more are within it
_WARNED_CHANGE = 0.02  # change of the displacement or of the energy, from which on it is told


class StepsOfShear(Cause):
    """Coupled bodies slip at the edge as their contact grows, so that finer steps have others."""

    name = "steps"
    title = "how finely the way is cut"
    remedy = "a path of more loads (rl.press)"
    takes = "for the shear force in half as many loads"
    is_of_shear = True

    def opens_shear(self, case: Case) -> bool:
        """Whether pressure displaces the bodies along each other."""
        body = case.question.sheared_half_space
        return body is not None and body.is_coupled

    def sheared(self, case: Case, asked: ShearedBody) -> ShearedBody | None:
        """The same way in half as many loads."""
        return replace(asked, path=asked.path.in_half_as_many, times=_TIMES, by_micro_slip=True)

    def spread(self, case: Case, curves: Curves, variant: str) -> None:
        """None: the order of normal loads does not matter."""

    def facts(self, case: Case, curves: Curves) -> Sequence[Fact]:
        """By how much half as many loads change the slide and the loop, where that is much."""
        if (asked := ShearedBody.of(case)) is None or not self.opens_shear(case):
            return ()
        found = shear_cycles(case, curves, {self.name: self.sheared(case, asked)})
        other = None if found is None else found.others[self.name]
        if found is None or other is None:
            return ()
        changes = {
            "displacement": abs(other.displacement / found.displacement - 1),
            "energy": abs(other.energy / found.energy - 1) if found.energy else 0.0,
        }
        return [Fact("steps_matter", **changes)] if max(changes.values()) > _WARNED_CHANGE else ()
