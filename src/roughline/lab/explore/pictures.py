"""What the view "Explore" shows, computed in a process: lines, contacts, curves."""

from __future__ import annotations

import time
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.assessment.question import UNLOADING
from roughline.contact.scaling import stiffness_bar
from roughline.lab.controls import ControlError, as_text
from roughline.lab.explore import adhesion, fluid
from roughline.lab.explore.maps import area_map, contact_maps
from roughline.lab.explore.pressing import borne, pressed_under
from roughline.lab.explore.state import ExploreState, usable_state
from roughline.lab.explore.words import (
    contact_words,
    line_words,
    number_rows,
    status,
    unloading_bar,
)
from roughline.lab.frames import frame
from roughline.lab.maps import Map, flux_map
from roughline.lab.server.tasks import Arguments, Progress
from roughline.report.shading import shaded

_COARSE, _COARSER = 128, 64
"""Points along a side while a slider moves, and when many ask at once."""
_LINES, _FEWER_LINES = 20, 5
"""Lines whose mean stiffness stands for the reduced model, and when many ask at once."""
_SPRINGS_PER_POINT = 32
_FEWEST_SPRINGS = 2**13
_FIRST_STEP = 256  # points along a side that come before the full grid when many ask at once
_LONG_ROLL_OFF = 1 / 16  # down to which the coarser grid carries the spectrum
_MOST_ROWS = 40  # of the spectrum's table
CURVE_POINTS = 256  # along a side of the surface whose whole curve is computed
CURVE_FORCES = np.geomspace(1e-3, 3, 13)
_LINE_FORCES = np.geomspace(1e-4, 10, 41)


def reduced(arguments: Arguments, progress: Progress) -> bytes:
    """Mean stiffness of lines over force, and at the load of the state.

    In a crowd it is that of fewer lines first; the page asks for the others by "refines".
    """
    state, refused = usable_state(arguments)
    count = _FEWER_LINES if _is_first_step(arguments) else _LINES
    found = lines_over_force(state, count)
    forces, mean = found["force_bar"], found["stiffness_bar"]
    here = int(np.searchsorted(forces, state.F))
    return frame(
        {
            **_settled(state, refused),
            "line": found,
            "stiffness_bar_1d": float(mean[here]),
            "table": [[*row, "1D"] for row in number_rows(forces, mean)],
            "strip": line_words(state, float(mean[here]), count),
            "is_coarse": count < _LINES,
        }
    )


def lines_over_force(state: ExploreState, count: int = _LINES) -> dict[str, NDArray[np.float64]]:
    """Mean stiffness and range of lines over force, dimensionless."""
    forces = np.unique([*_LINE_FORCES, state.F])
    lines = _lines_of(state, count)
    stiffness = np.array([_press_bar(line, state, forces).stiffness_bar for line in lines])
    return {
        "force_bar": forces,
        "stiffness_bar": stiffness.mean(axis=0),  # its interval would take as long as all lines
        "low": stiffness.min(axis=0),
        "high": stiffness.max(axis=0),
    }


def coarse(arguments: Arguments, progress: Progress) -> bytes:
    """The contact on a coarse grid, while a slider moves."""
    state, refused = usable_state(arguments)
    crowded = arguments["crowded"] and state.roll_off > _LONG_ROLL_OFF
    n = state.points(_COARSER if crowded else _COARSE)
    return _contact(state, refused, n, progress)


def full(arguments: Arguments, progress: Progress) -> bytes:
    """The contact on the grid of the state.

    In a crowd it is on fewer points first; the page asks for the full grid by "refines".
    """
    state, refused = usable_state(arguments)
    n = state.points(_FIRST_STEP) if _is_first_step(arguments) else state.n
    return _contact(state, refused, n, progress)


def curve(arguments: Arguments, progress: Progress) -> bytes:
    """Stiffness and area over force of the surface, and of theories."""
    state, refused = usable_state(arguments)
    n = state.points(CURVE_POINTS)
    surface = state.surface(n)
    pressed = pressed_under(state, surface, borne(state, CURVE_FORCES), progress)
    return frame(
        {
            **_settled(state, refused),
            "curve": _of_curve(pressed),
            "grid": f"{n}²",
            "theories": [of_theory(name, surface, state) for name in state.theories],
            "stiffness_table": _stiffness_rows(pressed),
            "area_table": _area_rows(pressed),
        }
    )


def flow(arguments: Arguments, progress: Progress) -> bytes:
    """What flows through the gap over force, and what theories of the flow say."""
    state, refused = usable_state(arguments)
    if not state.fluid:
        raise ControlError("there is no fluid: mark that one flows through the gap", "fluid")
    n = state.points(CURVE_POINTS)
    surface = state.surface(n)
    measures = fluid.measures(state)
    pressed = pressed_under(state, surface, borne(state, fluid.FORCES), progress, measures=measures)
    return frame(
        {
            **_settled(state, refused),
            "curve": _of_curve(pressed),
            "grid": f"{n}²",
            **fluid.of_curve(pressed, state, surface),
        }
    )


def cycle(arguments: Arguments, progress: Progress) -> bytes:
    """Both ways of bodies that stick: beyond the load, back to it, and off."""
    state, refused = usable_state(arguments)
    n = adhesion.points(state, refines=arguments.get("refines") is True)
    found = adhesion.cycle(state, n, progress)
    fields = found.by_forces.fields[adhesion.BACK]
    maps = {} if fields is None else {"retreat": area_map(state, fields)}
    turn = {name: each for name, each in _of_curve(found.by_forces).items() if each is not None}
    return frame(
        {
            **_settled(state, refused),
            **adhesion.of_cycle(found, state, n),
            "curve": _of_curve(found.by_depths),
            "turn": {name: values[1 : adhesion.BACK + 1] for name, values in turn.items()},
            "is_coarse": n < adhesion.points(state),
            "maps": {name: each.look for name, each in maps.items()},
        },
        {name: each.values.T for name, each in maps.items()},
    )


def unloading(arguments: Arguments, progress: Progress) -> bytes:
    """The way back from the load of the state to none."""
    state, refused = usable_state(arguments)
    n = state.points(CURVE_POINTS)
    loads = state.F * np.array([1.0, *UNLOADING])
    measures = fluid.measures(state)
    pressed = pressed_under(state, state.surface(n), loads, progress, measures=measures)
    return frame(
        {
            **_settled(state, refused),
            "curve": _of_curve(pressed),
            "stiffness_table": _unloading_rows(pressed),
            "area_table": _area_rows(pressed),
            "aperture_table": fluid.rows(pressed, "3D, way back"),
        }
    )


def _contact(state: ExploreState, refused: Mapping[str, str], n: int, progress: Progress) -> bytes:
    """The contact on a grid; on the grid of the state, with what finer ones may change."""
    started = time.perf_counter()
    is_coarse = n < state.n
    surface = state.surface(n)
    flows: list[rl.Flow] = []
    pressed = pressed_under(
        *(state, surface, np.array([state.F]), progress),
        fields=True,
        grid_error=not is_coarse,
        measures=fluid.measures(state, flows),
    )
    fields = pressed.fields[0]
    maps: dict[str, Map] = {}
    strip = contact_words(pressed, fields, surface)
    if fields is not None:
        maps = contact_maps(state, surface, fields)
        strip += adhesion.contact_words(pressed, state)
        if flows:
            maps["flux"] = flux_map(flows[0])
            strip += fluid.flow_words(pressed, flows[0])
    seconds = time.perf_counter() - started
    arrays = {"topography": shaded(surface)} | {name: each.values for name, each in maps.items()}
    heights = (surface.heights - surface.heights.mean()) / surface.rms_height
    return frame(
        {
            **_settled(state, refused),
            "points": n,
            "is_coarse": is_coarse,
            "heights": [float(heights.min()), float(heights.max())],
            "curve": _of_curve(pressed),
            **({} if is_coarse else _of_spectrum(surface, state)),
            "maps": {name: each.look for name, each in maps.items()},
            "strip": strip,
            "status": status(pressed, n, seconds, is_coarse=is_coarse),
        },
        {name: values.T for name, values in arrays.items()},  # rows of an image run along x
    )


def _is_first_step(arguments: Arguments) -> bool:
    """Whether many ask at once, and this page has no answer yet."""
    return bool(arguments["crowded"]) and arguments.get("refines") is not True


def _settled(state: ExploreState, refused: Mapping[str, str]) -> dict[str, Any]:
    """What the page is told of its controls: what counts, and what is not used and why."""
    if state.cutoff not in (ExploreState.cutoff, state.cutoff_used):
        finest = f"{as_text(state.shortest)} sides"
        why = f"{state.n} points carry no waves shorter than {finest}; that is used meanwhile"
        refused = {"cutoff": why, **refused}
    names = ("D_f", "roll_off", "cutoff", "h", "slope", "seed", "n", "F", "hardness_bar", "w", "h0")
    values = {name: getattr(state, name) for name in names} | {"cutoff": state.cutoff_used}
    return {
        "state": state.address(),
        "numbers": {name: float(value) for name, value in values.items() if value is not None},
        "lows": {"cutoff": state.shortest},
        "refused": refused,
    }


def _lines_of(state: ExploreState, count: int) -> tuple[rl.Line, ...]:
    """Lines of the spectrum of a state, with the waves of its surface. [m]"""
    springs = max(_FEWEST_SPRINGS, _SPRINGS_PER_POINT * state.n)
    return _lines(state.spectrum(state.n), springs, state.seed, count)


@lru_cache(maxsize=2)
def _lines(spectrum: rl.SelfAffine, springs: int, seed: int, count: int) -> tuple[rl.Line, ...]:
    return tuple(spectrum.line(springs, seed + i) for i in range(count))


def _press_bar(line: rl.Line, state: ExploreState, force_bars: NDArray[np.float64]) -> rl.Curve:
    """Press a line under dimensionless forces, scaled with its own rms height."""
    scale = state.E_star * line.rms_height * line.length
    return rl.press(line, E_star=state.E_star, forces=force_bars * scale)


def _of_curve(pressed: rl.Curve) -> dict[str, Any]:
    """What the page draws of a curve; a load that was not solved is left out there."""
    return {
        "force_bar": pressed.force_bar,
        "stiffness_bar": pressed.stiffness_bar,
        "unloading_bar": None if pressed.hardness is None else unloading_bar(pressed),
        "area": pressed.area_fraction_corrected,
        "aperture": fluid.apertures(pressed),
        "depth": pressed.depth / pressed.rms_height,
        "resolved": pressed.resolved,
        "converged": pressed.converged,
    }


def _of_spectrum(surface: rl.Surface, state: ExploreState) -> dict[str, Any]:
    """Spectrum of the surface, and the law that it is drawn from, over waves in the side."""
    measured = rl.isotropic_spectrum(surface)
    known = measured.C_2d > 0
    q, power = measured.q[known], measured.C_2d[known]
    law = state.spectrum(state.n).lattice(state.n).C_2d(q)
    waves = q * state.length / (2 * np.pi)
    shown = slice(None, None, -(-waves.size // _MOST_ROWS))
    return {
        "spectrum": {"waves": waves, "C_2d": power, "law": np.where(law > 0, law, np.nan)},
        "spectrum_table": number_rows(waves[shown], power[shown], law[shown]),
    }


def of_theory(name: str, surface: rl.Surface, state: ExploreState) -> dict[str, Any]:
    """A theory for the waves of the surface, dimensionless like the curve."""
    import warnings

    forces = np.geomspace(1e-3, 3, 31)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", rl.ContinuumWarning)  # its sentence is in the validity
        found = rl.theory(name, surface, state.E_star, state.force(forces) / surface.area)
    stiffness = None
    if found.stiffness is not None:
        stiffness = stiffness_bar(found.stiffness * surface.area, state.E_star, surface.length)
    return {
        "name": found.name,
        "force_bar": forces,
        "area": found.area_fraction,
        "stiffness_bar": stiffness,
        "validity": found.validity,
    }


def _stiffness_rows(pressed: rl.Curve) -> list[list[str]]:
    """Rows of the table below the curve of the stiffness: F̄, k̄ and the model."""
    rows = [[*row, "3D"] for row in _rows(pressed, pressed.stiffness_bar)]
    if pressed.hardness is not None:
        rows += [[*row, "3D, k_u"] for row in _rows(pressed, unloading_bar(pressed))]
    return rows


def _unloading_rows(pressed: rl.Curve) -> list[list[str]]:
    """The same of the way back from a load, which is the first."""
    return [[*row, "3D, way back"] for row in _rows(pressed, unloading_bar(pressed))]


def _area_rows(pressed: rl.Curve) -> list[list[str]]:
    """Rows of the table below the curve of the area: F̄ and A / A_0."""
    assert pressed.area_fraction_corrected is not None
    return _rows(pressed, pressed.area_fraction_corrected)


def _rows(pressed: rl.Curve, values: NDArray[np.float64]) -> list[list[str]]:
    """Rows of a quantity over force; a star marks loads with too few cells in contact."""
    rows = number_rows(pressed.force_bar, values)
    for i, row in enumerate(rows):
        if not pressed.converged[i]:
            row[1] = rl.Status(pressed.status[i]).reason
        elif not pressed.resolved[i] and pressed.force[i] > 0:
            row[1] += " *"
    return rows
