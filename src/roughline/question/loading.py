"""How bodies are loaded: by forces, depths or a number of loads, and in which order."""

from __future__ import annotations

import math
import operator
from collections.abc import Sequence

import numpy as np
from attrs import frozen

from roughline.errors import InputError
from roughline.errors.checks import number, refuse, whole_number
from roughline.errors.words import called
from roughline.facts.fact import Fact
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.question.arguments import called_by
from roughline.question.kinds import nominal_area
from roughline.topography.body import Body, side_lengths
from roughline.units import as_si, load_in_newtons

DEFAULT_LOADS = 20

UNLOADING = (0.75, 0.5, 0.25, 0.1, 0.0)
"""Loads over the largest one, on the way back to none."""

LIGHTEST_SHARE = 1e-3
"""Share of the largest load where a whole curve begins."""

CURVE_LOADS = 16
"""Loads of a whole curve."""


@frozen
class Loading:
    """Loads or depths as they were typed, or how many; and in which order they are applied."""

    loads: tuple[float | str, ...] = ()
    depths: tuple[float | str, ...] = ()
    count: int | None = None  # of loads from first touch to saturation
    history: bool = False
    unload: bool = False
    whole_curve: bool = False
    joint: float | None = None  # nominal area that forces act on; None for the body's own [m²]

    def __attrs_post_init__(self) -> None:
        loads, depths = called("loads"), called("depths")
        if self.joint is not None and self.depths:
            raise InputError(
                f"a joint ({called('rl.Joint')}) is pressed by loads ({loads}): its depth counts "
                "from the touch of its highest point, which a map does not show"
            )
        given = (self.count, self.loads or None, self.depths or None)
        if sum(each is not None for each in given) > 1:
            raise InputError(f"give one of {loads}, {depths} and {called('n_loads')}")
        if self.count is not None:
            whole_number("n_loads", self.count, 2, "a whole number of at least 2 is needed")
        if self.unload and (not self.loads or self.history):
            raise InputError(
                f"{called('unload', True)} takes off the largest of the loads ({loads}); in a "
                "history, and for depths, write the falling values yourself"
            )
        if self.history and not (self.loads or self.depths):
            text = f"needs {loads} or {depths} in the order of the history"
            raise InputError(f"{called('history', True)} {text}")
        self.forces(1.0)  # reads and checks them; a pressure waits for its area
        self.heights()

    def refuse_unless_one_load(self) -> None:
        """Refuse all but a single load, under which bodies are sheared."""
        is_one = len(self.loads) == 1 and not (self.depths or self.unload or self.history)
        if not is_one:
            given = len(self.loads) + len(self.depths) or "none"
            raise InputError(
                f"bodies are sheared ({called('rl.Shear')}) under one load, which stays, and there "
                f"are {given}: give one ({called('loads', '10 N')}), and neither depths nor "
                f"{called('unload', True)}",
                None,
                "shear",
                "loads",
            )

    @property
    def n_loads(self) -> int | None:
        """How many loads there are from first touch to saturation; None where they are given."""
        return self.count or (None if self.loads or self.depths else DEFAULT_LOADS)

    @property
    def headings(self) -> list[str]:
        """What each load or depth is called, in its order: as it was typed, or with its unit."""
        headings = called_by(self.loads, "N") + called_by(self.depths, "m")
        falling = UNLOADING if self.unload else ()
        return headings + [f"unloaded to {each:.0%}" if each else "unloaded" for each in falling]

    def names_of_loads(self, asked: Sequence[int]) -> list[str]:
        """What loads that were asked for are called: as they were typed, or their numbers."""
        return self.headings or [str(i + 1) for i in asked]

    def scale(self, area: float) -> float:
        """How many times larger the joint is than a body of a nominal area [m²]; 1 without one."""
        return 1.0 if self.joint is None else self.joint / area

    def forces(self, area: float) -> list[float]:
        """Total forces on a body of a nominal area, in the order of the loads. [N]

        Of a joint the body carries as much as its share of the area.
        """
        scale = self.scale(area)
        forces = [
            load_in_newtons(load, area * scale)
            if isinstance(load, str)
            else number("loads", load, 'a force in N, or a text such as "2 MPa", is needed')
            for load in self.loads
        ]
        for i, (load, force) in enumerate(zip(self.loads, forces, strict=True)):
            if not (0 < force < math.inf or (force == 0 and self.history and i)):
                to_unload = ", and zero only to unload after others" if self.history else ""
                refuse("loads", load, f"give positive ones{to_unload}")
        if self.unload:
            forces += [share * max(forces) for share in UNLOADING]
        return [force / scale for force in forces]

    def heights(self) -> list[float]:
        """Depths, in their order. [m]"""
        return [as_si(depth, "m", "depths") for depth in self.depths]

    def path(self, values: Sequence[float]) -> tuple[list[float], tuple[int, ...]]:
        """Forces or depths in the order in which they are applied, and where those asked stand.

        Forces may be less than those that were asked for, by what a fluid carries.
        """
        loads = list(values)
        if not loads:
            return [], ()
        has_curve = self.whole_curve and bool(self.loads)
        if self.history:
            before = _with_curve(loads[:1])[:-1] if has_curve else []
            return before + loads, tuple(range(len(before), len(before) + len(loads)))
        typed = loads[: -len(UNLOADING)] if self.unload else loads
        rising = _with_curve(typed) if has_curve else sorted({*typed})
        falling = loads[len(typed) :]
        places = [rising.index(load) for load in typed]
        return rising + falling, (*places, *range(len(rising), len(rising) + len(falling)))

    def strains(
        self, body: Body, half_space: HalfSpace, pressing: Sequence[float], *, is_layered: bool
    ) -> list[tuple[float, Fact]]:
        """Return how far each load strains a body, of what it presses with, and the fact.

        A fluid that carries a part of the load acts on all of the surface, and deforms little.
        """
        area, side = nominal_area(body), min(side_lengths(body))
        of, is_beside_fluid = "layers" if is_layered else "pressure", False
        if depths := self.heights():
            of, ratios = "depth", [depth / side for depth in depths]
        else:
            is_beside_fluid = any(map(operator.lt, pressing, self.forces(area)))
            side = math.inf if half_space.periodic is True else side
            ratios = [half_space.strain(max(force, 0.0) / area, side) for force in pressing]
        numbers = {"of": of, "is_beside_fluid": is_beside_fluid}
        return [
            (ratio, Fact("strain_of_load", load=heading, ratio=ratio, **numbers))
            for heading, ratio in zip(self.headings, ratios, strict=False)
        ]


def _with_curve(loads: list[float]) -> list[float]:
    """Loads for a whole curve up to the largest, those asked for among them, rising."""
    if max(loads) <= 0:  # a fluid lifts the body under all of them
        return sorted({*loads})
    curve = np.geomspace(LIGHTEST_SHARE * max(loads), max(loads), CURVE_LOADS)
    others = [f for f in curve if not np.isclose(f, loads, rtol=0.02).any()]
    return sorted({*loads, *others})
