"""Bodies that stick: both ways through a contact, what pulls them apart, and how it is resolved."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import roughline as rl
from roughline.lab.controls import ControlError
from roughline.lab.explore.pressing import pressed_under
from roughline.lab.explore.state import ExploreState
from roughline.lab.explore.words import item, number_rows
from roughline.lab.server.tasks import Progress
from roughline.units import decimal, engineering

_DIGITS = 3
_COARSE, _FINER = 128, 256  # points along a side of the surface that is followed, at first and then
_HISTORY = 1.0, 2.0, 1.0, 0.0  # over the present load: beyond it, back to it, to none
BACK = 2
"""Number of the load of the history that comes back to the present one."""
_THERE, _AWAY = 25, 35  # depths on both ways
_BEYOND = 1.5  # times the largest pull of the depths: more than is borne
_LOADS = 69  # of all, a few of which the forces add


def points(state: ExploreState, *, refines: bool = True) -> int:
    """Points along a side of the surface that is followed."""
    return state.points(_FINER if refines else _COARSE)


@dataclass(frozen=True, eq=False)
class Cycle:
    """Bodies that stick: to a load, beyond, back and off."""

    by_forces: rl.Curve  # to the load, beyond, back to it, and to none
    by_depths: rl.Curve  # from out of reach and back to it, over all that forces jump over
    pull_off: tuple[float, float]  # depth and force; NaN where the grid does not resolve them


def cycle(
    state: ExploreState, n: int, progress: Progress, measures: Sequence[rl.Measure] = ()
) -> Cycle:
    """Follow the surface on so many points along a side."""
    if state.w is None:
        raise ControlError("the bodies do not stick: mark that they do", "w")
    surface = state.surface(n)
    done_before = 0

    def step(done: int, total: int) -> None:
        progress(done_before + done, _LOADS)

    forces = state.F * np.array(_HISTORY)
    by_forces = pressed_under(state, surface, forces, step, fields=[0, BACK])
    depth = by_forces.depth
    if not np.isfinite(depth).all():
        raise ControlError("a load was not solved, so that no way back is known", "F")
    height, deepest = state.rms_height, float(depth[1])
    reach = 2 * state.h0 * height
    drawn = height * math.sqrt(2 * math.sqrt(math.pi) * state.w)  # a disc as wide as the surface
    there = np.union1d(np.linspace(-reach, deepest, _THERE), depth[0])
    back = np.union1d(np.linspace(deepest, -reach - drawn, _AWAY + 1)[1:], depth[BACK:])
    done_before = depth.size
    by_depths = rl.press(
        surface,
        E_star=state.E_star,
        law=state.law,
        depths=np.append(there, back[::-1]),
        periodic=state.periodic,
        measures=measures,
        throw=False,
        progress=step,
    )
    found = by_depths.pull_off_depth, by_depths.pull_off_force
    if math.isfinite(found[1]):  # to the tolerance, by a pull that is not much more
        done_before += by_depths.depth.size
        pulls = np.array([_HISTORY[1] * state.F, _BEYOND * found[1] / state.force(1.0)])
        off = pressed_under(state, surface, pulls, step)
        ends = found, (off.pull_off_depth, off.pull_off_force)
        found = min(ends, key=lambda each: math.inf if math.isnan(each[1]) else each[1])
    return Cycle(by_forces, by_depths, found)


def contact_words(pressed: rl.Curve, state: ExploreState) -> list[dict[str, str]]:
    """Where bodies that stick pull each other at the load, and how well the grid resolves that."""
    if state.w is None:
        return []
    assert pressed.pulling_fraction is not None
    cells, needed = float(pressed.settings["pulling_zone_cells"]), rl.Dugdale.resolved_zone
    is_resolved = cells >= needed
    return [
        item(
            *("pulling", "pulled", f"{decimal(100 * float(pressed.pulling_fraction[0]), 3)}%"),
            "Share of the nominal area across whose gap the bodies pull each other, on the way to "
            "this load.",
        ),
        item(
            *("zone", "pulling zone", f"{decimal(cells, 2)} cells{'' if is_resolved else ' *'}"),
            "Width of the zone that pulls about a contact, E* w / (π σ_0²) with σ_0 = w / h_0, in "
            f"cells of this grid; {needed:g} resolve it.",
            "" if is_resolved else f"{needed:g} are needed: a longer range, or a finer grid",
        ),
    ]


def of_cycle(found: Cycle, state: ExploreState, n: int) -> dict[str, Any]:
    """What the page draws and says of both ways, on so many points along a side."""
    by_forces, by_depths, (depth, pull) = found.by_forces, found.by_depths, found.pull_off
    assert by_depths.on_approach is not None
    assert by_depths.area_fraction is not None
    assert by_forces.area_fraction_corrected is not None
    height, here = by_forces.rms_height, [0, BACK]
    area = by_forces.area_fraction_corrected[BACK]
    is_known = math.isfinite(pull)
    pressure = engineering(pull / by_forces.length**2, "Pa", _DIGITS)
    return {
        "grid": f"{n}²",
        "on_approach": by_depths.on_approach,
        "here": {"x": by_forces.depth[here] / height, "y": by_forces.force_bar[here]},
        "pull_off": {"x": [depth / height] * is_known, "y": [pull / state.force(1.0)] * is_known},
        "strip": [
            item(
                *("retreat", "contact, way back", f"{decimal(100 * float(area), _DIGITS)}%"),
                "Real contact area at this load on the way back from twice as much, beside that on "
                "the way there.",
                f"on {n}² points",
            ),
            item(
                *("pull_off", "pull-off"),
                decimal(pull / state.force(1.0), _DIGITS) if is_known else "not known",
                "Largest pull F / (E* h L) that the contact bears on the way back; below it with "
                "its unit, and over the nominal area.",
                f"{engineering(pull, 'N', _DIGITS)}, {pressure}, on {n}² points"
                if is_known
                else "the grid does not resolve the pull",
            ),
        ],
        "table": [
            [*row, "there" if nearer else "back"]
            for row, nearer in zip(
                number_rows(
                    by_depths.depth / height,
                    by_depths.force_bar,
                    by_depths.area_fraction,
                    by_depths.stiffness_bar,
                ),
                by_depths.on_approach,
                strict=True,
            )
        ],
    }


LAW = """work = {work}  # J/m²
h_0 = {reach}  # m
law = rl.Dugdale(work_of_adhesion=work, range=h_0)
"""
"""Lines of Python that define the law."""
FORCES = "law=law, forces=[force, 2 * force, force, 0.0]"
"""Arguments of a press in Python, with the same history."""
ANSWERS = """print("area_fraction_corrected, way back", curve.area_fraction_corrected[2])

apart = -2 * h_0 - math.sqrt(2 * math.sqrt(math.pi) * work * length / E_star)
depths = [curve.depth[1] + i / 35 * (apart - curve.depth[1]) for i in range(36)]
back = rl.press(surface, E_star=E_star, law=law, depths=depths{periodic})
forces = [2 * force, 1.5 * back.pull_off_force]  # the second is more than is borne
off = rl.press(surface, E_star=E_star, law=law, forces=forces{periodic}, throw=False)
print("pull_off_force", off.pull_off_force, "N")
"""
"""Lines that print what it gives."""
