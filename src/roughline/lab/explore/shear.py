"""A shear force that goes to and fro on the pressed bodies, with friction between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

import roughline as rl
from roughline.contact.sliding import SlidingCurve
from roughline.engineering.slip import ShearCycles
from roughline.lab.controls import ControlError, as_code
from roughline.lab.explore.controls import DECLARED
from roughline.lab.explore.state import (
    FIGURES,
    AddedCode,
    ExploreState,
    PageAnswer,
    Physics,
    StripWords,
    figures,
)
from roughline.lab.explore.words import number_rows
from roughline.lab.maps import Map
from roughline.lab.panels import Panel, PanelContent, joined, linear_span, marks
from roughline.lab.server.tasks import Progress
from roughline.report.values import figure, up_to_three_digits

_PER_CYCLE = 16
_MOST_SHARE = 1 - 1e-6  # of what friction bears

_IN_PYTHON = f"""turned = len(shear) - {_PER_CYCLE + 1}  # where the shear force is largest first
print("slide over rms height", curve.slide[turned, 0] / surface.rms_height)
print("dissipated in a cycle", curve.dissipated[turned + 1 :].sum(), "J")
"""


@dataclass(frozen=True)
class ShearPhysics(Physics):
    """A shear force along x, less than what friction bears."""

    mu: float
    Q: float
    nu: float

    key = "mu"
    tick = "shear goes to and fro"
    meaning = (
        "With friction, a shear force from left to right first moves the bodies while spots slip "
        "one by one; as it goes to and fro, force over slide makes a loop. Both bodies are elastic "
        "and without adhesion, and of one material unless a layer lies on one."
    )
    controls = (DECLARED["mu"], DECLARED["Q"], DECLARED["nu"])
    excludes: ClassVar = {
        "hardness_bar": "bodies that yield are not sheared here: take the hardness away, or the "
        "shear",
        "w": "shear of bodies that stick is not solved: take the adhesion away, or the shear",
    }
    maps: ClassVar = {"stick": "stick and slip"}
    strip = figures("slide", "tangential", "lost", "stuck")
    panels = (
        Panel(
            key="loop",
            title="Shear over slide",
            x="slide u / h",
            y="shear force Q / F",
            ranges=((-1, 1), (-1, 1)),
            series=(
                joined("rising", "from no shear", "dark-line", size=4, marker="circle"),
                joined("loop", "a cycle", "here", size=4, marker="square"),
                marks("here", "", "mark", size=13, marker="circle"),
            ),
            columns=("u/h", "Q/F", "sticks", "way"),
            task="mu",
            waits="the shear force goes to and fro",
            is_logarithmic=False,
            cursor="width",
            drags="Q",
        ),
    )
    follows = "load"

    def half_space(self, state: ExploreState) -> rl.HalfSpace:
        """That of the contact modulus, with Poisson's ratio; one with a layer comes before it."""
        return rl.Homogeneous(state.E_star, periodic=state.periodic, poisson=self.nu)

    def check(self, state: ExploreState) -> None:
        """Refuse a force under which the bodies slide."""
        if self.mu * _MOST_SHARE < self.Q:
            raise ControlError(
                f"shear of {self.Q:.4g} F is not less than μ F = {self.mu:.4g} F, under which the "
                "bodies slide: give less, or more friction",
                "Q",
                "mu",
                "F",
            )

    def further(self, state: ExploreState, refines: bool, progress: Progress) -> PageAnswer:
        """Follow a cycle of the shear force, under the load."""
        n, is_coarse = state.staged(refines)
        shear = rl.cycle(self.in_si("Q", state), per_cycle=_PER_CYCLE, cycles=1)
        curve = state.press(
            state.surface(n),
            progress,
            [state.F] * len(shear),
            friction=rl.Friction(self.mu),
            shear_forces=shear,
            fields=[len(shear) - 1 - _PER_CYCLE, len(shear) - 1],
        )
        if not isinstance(curve, SlidingCurve) or not curve.converged.all():
            raise ControlError("a load of the cycle was not solved, so that no loop is known", "Q")
        cycle = ShearCycles(curve, self.mu, 0, _PER_CYCLE, 1)
        content = {
            "panels": {"loop": _loop(cycle, n)},
            "strip": list(_words(cycle, n)),
            "is_coarse": is_coarse,
        }
        return content, {"stick": _stick_map(cycle)}

    def code(self, state: ExploreState) -> AddedCode:
        """The cycle; of a command, two bodies of the same material."""
        poisson, typed = as_code(self.nu), state.typed("Q")
        most = (
            f"load_in_newtons({typed!r}, surface.area)" if typed else f"{as_code(self.Q)} * force"
        )
        periodic = ", periodic=True" if state.periodic else ""
        material = f"E={as_code(2 * state.E_star * (1 - self.nu**2))} Pa nu={poisson}"
        in_words = state.in_words("Q", "N", self.in_si("Q", state))
        friction = f"friction=rl.Friction({as_code(self.mu)})"
        return AddedCode(
            half_space=f"half_space = rl.Homogeneous(E_star, poisson={poisson}{periodic})\n",
            before=f"shear = rl.cycle({most}, per_cycle={_PER_CYCLE}, cycles=1)\n",
            arguments=f"{friction}, forces=[force] * len(shear), shear_forces=shear",
            after=_IN_PYTHON,
            materials=f"{material}, {material}",
            command=("--friction", as_code(self.mu), "--shear", in_words, "--cycles", "1"),
        )


def _loop(cycle: ShearCycles, n: int) -> PanelContent:
    """Shear force over slide, on so many points along a side."""
    curve, first = cycle.curve, cycle.curve.status.size - 1 - _PER_CYCLE
    slides, shears = curve.slide[:, 0] / curve.rms_height, curve.shear_force[:, 0] / curve.force
    ways = ["from no shear"] * first + ["a cycle"] * (1 + _PER_CYCLE)
    rows = number_rows(slides, shears, curve.stick_fraction)
    series = {
        name: {"x": slides[some], "y": shears[some]}
        for name, some in {
            "rising": slice(0, first + 1),
            "loop": slice(first, None),
            "here": slice(first, first + 1),
        }.items()
    }
    return PanelContent(
        series=series,
        rows=[[*row, way] for row, way in zip(rows, ways, strict=True)],
        caption=f"{_which(curve)} in {_PER_CYCLE} steps under this load, on {n}² points",
        x=linear_span(slides),
        y=linear_span(shears),
    )


def _which(curve: SlidingCurve) -> str:
    """Which cycle it is: where pressure moves bodies along each other, they differ."""
    if not curve.half_space.is_coupled:
        return "a cycle"
    return "the first cycle, of bodies pressed in one load (later ones differ),"


def _words(cycle: ShearCycles, n: int) -> StripWords:
    """What the shear force does, and what is lost."""

    def written(value: float, unit: str) -> str:
        return up_to_three_digits(value, None, unit)

    slide = f"{figure(cycle.displacement / cycle.curve.rms_height)} h"
    slip = f"of it {written(cycle.micro_slip, 'm')} slip"
    yield FIGURES["slide"].in_words(
        slide, f"{written(cycle.displacement, 'm')}, {slip}, on {n}² points"
    )
    going_on = f"on more shear {written(cycle.stiffness_on, 'N/m')}"
    yield FIGURES["tangential"].in_words(written(cycle.stiffness_before, "N/m"), going_on)
    yield FIGURES["lost"].in_words(
        written(cycle.energy, "J"), f"loss factor {figure(cycle.loss_factor)}"
    )
    share, limit = cycle.sticking_share, f"slides under {written(cycle.limit, 'N')}"
    assert share is not None
    yield FIGURES["stuck"].in_words(f"{figure(100 * share)}%", limit)


def _stick_map(cycle: ShearCycles) -> Map:
    """Where the contact sticks throughout a cycle, and where it slips."""
    fields, never = cycle.fields, cycle.never_slips
    assert fields is not None
    assert never is not None
    marked = np.where(fields.contact, 2 - never.astype(np.uint8), 0).astype(np.uint8)
    called = {"ink": "never slips", "plastic": "slips in a cycle"}
    return Map(marked, ("paper", "ink", "plastic"), 0, 2, called=called)
