"""Bodies that stick: both ways through a contact, what pulls them apart, and how it is resolved."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

import roughline as rl
from roughline.halfspace.laws.pulling_zone import RESOLVED_FROM
from roughline.halfspace.operators.cell import cell_compliance
from roughline.lab.controls import ControlError, as_code
from roughline.lab.explore.controls import DECLARED
from roughline.lab.explore.panels import BACK, selected_points
from roughline.lab.explore.state import (
    FIGURES,
    SURFACE_KEYS,
    AddedCode,
    ExploreState,
    PageAnswer,
    Physics,
    StripWords,
    figures,
)
from roughline.lab.explore.words import number_rows
from roughline.lab.maps import Map
from roughline.lab.panels import FORCE, Panel, PanelContent, Series, joined, linear_span, marks
from roughline.lab.server.tasks import Progress
from roughline.report.values import figure, up_to_three_digits

_LOAD_HISTORY = 1.0, 2.0, 1.0, 0.0  # over the present load: beyond it, back to it, to none
_LOAD_BACK = 2  # number of the load of the history that comes back to the present one
_DEPTHS_IN, _DEPTHS_OUT = 25, 35
_PULL_FACTOR = 1.5  # times the largest pull of the depths: more than is borne
_ALL_LOADS = 69  # a few of which the forces add

_IN_PYTHON = """print("area_fraction_corrected, way back", curve.area_fraction_corrected[2])

apart = -2 * h_0 - math.sqrt(2 * math.sqrt(math.pi) * work * length / E_star)
depths = [curve.depth[1] + i / 35 * (apart - curve.depth[1]) for i in range(36)]
back = rl.press(surface, half_space=half_space, law=law, depths=depths)
forces = [2 * force, 1.5 * back.pull_off_force]  # the second is more than is borne
off = rl.press(surface, half_space=half_space, law=law, forces=forces, throw=False)
print("pull_off_force", off.pull_off_force, "N")
"""


def _large(name: str, legend: str, colour: str, marker: str, edge: str) -> Series:
    return replace(marks(name, legend, colour, marker=marker, size=13), edge=edge)


@dataclass(frozen=True)
class AdhesionPhysics(Physics):
    """Bodies that pull each other across small gaps."""

    w: float
    h0: float

    key = "w"
    tick = "bodies stick"
    meaning = (
        "The bodies pull each other across small gaps: they jump together, hold each other on the "
        "way back, and come off under a pull. Without a hardness alone."
    )
    controls = (DECLARED["w"], DECLARED["h0"])
    unlike = "without adhesion"
    excludes: ClassVar = {
        "hardness_bar": "bodies that stick and yield have no law here: take the hardness away, or "
        "the adhesion"
    }
    maps: ClassVar = {"retreat": "area, way back"}
    strip = figures("retreat", "pull_off", "pulling", "zone")
    panels = (
        Panel(
            key="cycle",
            title="Force over depth",
            x="depth d / h",
            y=FORCE,
            ranges=((-1, 1), (-1, 1)),
            series=(
                joined("there", "there", "dark-line", size=4, marker="circle"),
                joined("back", "back", "here", size=4, marker="square"),
                _large("here", "this load on both ways", "mark", "circle", "paper"),
                _large("pull-off", "pull-off", "pull", "inverted_triangle", "text"),
            ),
            columns=("d/h", "F̄", "A/A₀", "k / (E* L)", "way"),
            task="w",
            waits="both ways are being followed",
            is_logarithmic=False,
            cursor="width",
        ),
    )
    series: ClassVar = {"stiffness": (BACK,), "area": (BACK,)}
    follows = "load"

    def law(self, state: ExploreState) -> rl.Dugdale:
        """An even pull up to a range."""
        return rl.Dugdale(work_of_adhesion=self.in_si("w", state), range=self.in_si("h0", state))

    def check(self, state: ExploreState) -> None:
        """Refuse a grid that does not resolve the pull."""
        side = state.length / state.n
        compliance = cell_compliance(state.half_space, (state.n, state.n), (side, side))
        try:
            self.law(state).refuse_grid(compliance)
        except rl.InputError as error:
            raise ControlError(str(error), "h0", "w", "n", *SURFACE_KEYS) from None

    def zone(self, state: ExploreState, n: int) -> float:
        """Cells across the zone that pulls about a contact, with so many along a side. [1]"""
        at_surface = state.half_space.E_star / state.E_star
        return n * at_surface * self.h0**2 / (math.pi * self.w)

    def is_resolved(self, state: ExploreState, n: int) -> bool:
        """Whether the zone that pulls has enough cells."""
        return self.zone(state, n) >= RESOLVED_FROM

    def words(self, pressed: rl.SurfaceCurve, fields: rl.Fields, state: ExploreState) -> StripWords:
        """Where bodies pull each other at the load, and how well the grid resolves that."""
        yield FIGURES["pulling"].in_words(f"{figure(100 * float(pressed.pulling_fraction[0]))}%")
        value, below = f"{figure(self.zone(state, len(fields.gap)), 2)} cells", ""
        if not self.is_resolved(state, len(fields.gap)):
            value += " *"
            below = f"{RESOLVED_FROM:g} are needed: a longer range, or a finer grid"
        yield FIGURES["zone"].in_words(value, below, f" {RESOLVED_FROM:g} resolve it.")

    def added_maps(self, fields: rl.Fields, state: ExploreState) -> dict[str, Map]:
        """Where bodies touch, and where they pull each other."""
        return {"area": _area_map(fields)}

    def further(self, state: ExploreState, refines: bool, progress: Progress) -> PageAnswer:
        """Follow both ways: beyond the load, back to it, and off."""
        n, is_coarse = state.staged(refines)
        found = _both_ways(state, self, n, progress)
        fields = found.by_forces.fields[_LOAD_BACK]
        content = {
            "panels": _panels(found, state, n),
            "strip": list(_words_of_the_way_back(found, state, n)),
            "is_coarse": is_coarse,
        }
        return content, {} if fields is None else {"retreat": _area_map(fields)}

    def code(self, state: ExploreState) -> AddedCode:
        """The law, the way back, and what pulls the bodies apart."""
        law = self.law(state)
        work = f"{as_code(self.w)} * E_star * surface.rms_height**2 / length"
        reach = f"{as_code(self.h0)} * surface.rms_height"
        in_words = state.in_words("w", "J/m^2", law.work_of_adhesion)
        return AddedCode(
            before=f"work = {state.in_python('w', 'J/m**2', work)}  # J/m²\n"
            f"h_0 = {state.in_python('h0', 'm', reach)}  # m\n"
            "law = rl.Dugdale(work_of_adhesion=work, range=h_0)\n",
            arguments="law=law, forces=[force, 2 * force, force, 0.0]",
            after=_IN_PYTHON,
            command=("--adhesion", f"{in_words} over {state.in_words('h0', 'm', law.range)}"),
            left_out="the way back and the pull-off need two materials",
        )


@dataclass(frozen=True, eq=False)
class _BothWays:
    """Bodies that stick: to a load, beyond, back and off."""

    by_forces: rl.SurfaceCurve  # to the load, beyond, back to it, and to none
    by_depths: rl.SurfaceCurve  # from out of reach and back to it, over all that forces jump over
    depth: float  # of the pull-off [m]
    pull: float  # its force; NaN where the grid does not resolve it [N]


def _both_ways(state: ExploreState, pull: AdhesionPhysics, n: int, progress: Progress) -> _BothWays:
    """Follow the surface on so many points along a side."""
    surface, done_before = state.surface(n), 0

    def step(done: int, total: int) -> None:
        progress(done_before + done, _ALL_LOADS)

    forces = state.F * np.array(_LOAD_HISTORY)
    by_forces = state.press(surface, step, forces, fields=[0, _LOAD_BACK])
    depth = by_forces.depth
    if not np.isfinite(depth).all():
        raise ControlError("a load was not solved, so that no way back is known", "F")
    height, deepest = state.rms_height, float(depth[1])
    reach = 2 * pull.h0 * height
    softest = min(state.half_space.E_star / state.E_star, 1.0)  # of a layer and its base
    # a disc as wide as the surface
    drawn = height * math.sqrt(2 * math.sqrt(math.pi) * pull.w / softest)
    there = np.union1d(np.linspace(-reach, deepest, _DEPTHS_IN), depth[0])
    back = np.union1d(np.linspace(deepest, -reach - drawn, _DEPTHS_OUT + 1)[1:], depth[_LOAD_BACK:])
    done_before = depth.size
    by_depths = state.press(surface, step, depths=np.append(there, back[::-1]))
    found = by_depths.pull_off_depth, by_depths.pull_off_force
    if math.isfinite(found[1]):  # to the tolerance, by a pull that is not much more
        done_before += by_depths.depth.size
        pulls = [_LOAD_HISTORY[1] * state.F, _PULL_FACTOR * found[1] / state.force(1.0)]
        off = state.press(surface, step, pulls)
        if off.pull_off_force < found[1]:
            found = off.pull_off_depth, off.pull_off_force
    return _BothWays(by_forces, by_depths, *found)


def _area_map(fields: rl.Fields) -> Map:
    touching_and_pulling = fields.contact + 2 * fields.pulling.astype(np.uint8)
    return Map(touching_and_pulling, ("paper", "ink", "pull"), 0, 2)


def _panels(found: _BothWays, state: ExploreState, n: int) -> dict[str, PanelContent]:
    """What the page draws of both ways, on so many points along a side."""
    by_forces, by_depths = found.by_forces, found.by_depths
    height, there, known = by_forces.rms_height, by_depths.on_approach, by_depths.converged
    depths, forces = by_depths.depth / height, state.force_bars(by_depths)
    here, loads, turned = [0, _LOAD_BACK], state.force_bars(by_forces), slice(1, _LOAD_BACK + 1)
    is_known = math.isfinite(found.pull)
    off = {"x": [found.depth / height] * is_known, "y": [found.pull / state.force(1.0)] * is_known}
    columns = number_rows(
        depths, forces, by_depths.area_fraction, state.stiffness_bars(by_depths.stiffness)
    )
    ways = ["there" if nearer else "back" for nearer in there]
    is_loaded = (forces != 0) & known
    of_cycle = PanelContent(
        series={
            "there": selected_points(depths, forces, there & known),
            "back": selected_points(depths, forces, ~there & known),
            "here": {"x": by_forces.depth[here] / height, "y": loads[here]},
            "pull-off": off,
        },
        rows=[[*row, way] for row, way in zip(columns, ways, strict=True)],
        caption=f"by depths to twice this load and back, on {n}² points; under a force bodies jump "
        "where it falls",
        x=linear_span(depths[is_loaded]),
        y=linear_span(forces[is_loaded]),
        legends={"pull-off": f"pull-off, {_pull_off(found, state)}"},
    )
    of_turn = {
        panel: PanelContent({"back": selected_points(loads[turned], values[turned])})
        for panel, values in state.over_force(by_forces).items()
        if panel in AdhesionPhysics.series
    }
    return of_turn | {"cycle": of_cycle}


def _pull_off(found: _BothWays, state: ExploreState) -> str:
    return figure(found.pull / state.force(1.0)) if math.isfinite(found.pull) else "not known"


def _words_of_the_way_back(found: _BothWays, state: ExploreState, n: int) -> StripWords:
    """The contact on the way back, and the pull-off."""
    area = float(found.by_forces.area_fraction_corrected[_LOAD_BACK])
    yield FIGURES["retreat"].in_words(f"{figure(100 * area)}%", f"on {n}² points")
    below = "the grid does not resolve the pull"
    if math.isfinite(found.pull):
        pressure = up_to_three_digits(found.pull / state.length**2, None, "Pa")
        below = f"{up_to_three_digits(found.pull, None, 'N')}, {pressure}, on {n}² points"
    yield FIGURES["pull_off"].in_words(_pull_off(found, state), below)
