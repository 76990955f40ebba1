"""What the view "Explore" shows, computed in a process: lines, contacts, curves."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.comparison.trust import trust_map
from roughline.lab.controls import ControlError, as_text
from roughline.lab.explore.controls import CHOICES
from roughline.lab.explore.panels import curve_note, loads, selected_points
from roughline.lab.explore.reading import usable_state
from roughline.lab.explore.state import ExploreState
from roughline.lab.explore.words import (
    LINES,
    contact_words,
    line_words,
    load_rows,
    number_rows,
    status,
    unlike,
)
from roughline.lab.frames import digest, drawn
from roughline.lab.maps import Map, contact_maps, height_map
from roughline.lab.panels import PanelContent, Points, span
from roughline.lab.server.tasks import Arguments, Progress
from roughline.margins.press import facts_on_press
from roughline.question.loading import UNLOADING
from roughline.reduction.springs import Springs
from roughline.report.values import figure
from roughline.theories.theory import ONE_MATERIAL_ONLY, why_not

_COARSE_POINTS = 128  # along a side while a slider moves
_SPRINGS_PER_POINT = 32
_FEWEST_SPRINGS = 2**13
_POINTED_AT = ("height", "area", "gap")  # maps of which points are told; what is shown is sent too
_MOST_ROWS = 40  # of the spectrum's table
_last: dict[tuple[ExploreState, int, bool], tuple[rl.SurfaceCurve, float]] = {}
"""What was pressed last in this process, by state and grid, and how long it took: when another map
is chosen, it is of the same contact. [s]"""
_CURVE_FORCES, _THEORY_FORCES = np.geomspace(1e-3, 3, 13), np.geomspace(1e-3, 3, 31)
_LEAST_AXIS_RANGES = {"stiffness": (1e-3, 2.5), "area": (1e-4, 1.0)}
_LINE_FORCES = np.geomspace(1e-4, 10, 41)


def coarse(arguments: Arguments, progress: Progress) -> bytes:
    """The contact on a coarse grid while a slider moves, and lines with the same waves."""
    return _contact(arguments, progress, is_coarse=True)


def full(arguments: Arguments, progress: Progress) -> bytes:
    """The contact on the grid of the state."""
    return _contact(arguments, progress, is_coarse=False)


def curve(arguments: Arguments, progress: Progress) -> bytes:
    """Stiffness and area over force of the surface, and of theories."""
    state, refused = usable_state(arguments)
    surface = state.surface_of_curves
    pressed = state.press(surface, progress, state.bearable(_CURVE_FORCES))
    forces, note = state.force_bars(pressed), curve_note(pressed, len(surface.heights))
    theories, remarks = _theories(state, surface)
    panels = {
        panel: PanelContent(
            {**loads(forces, values, pressed), **theories[panel]},
            load_rows(forces, values, pressed, "3D"),
            note,
        )
        for panel, values in state.over_force(pressed).items()
    }
    panels["area"].remarks = " ".join(f"{each}." for each in remarks)
    for each in state.added:
        for panel, more in each.beside_curve(pressed, state).items():
            panels[panel].series |= more.series
            panels[panel].rows = [*(panels[panel].rows or []), *(more.rows or [])]
    for panel, (low, high) in _LEAST_AXIS_RANGES.items():
        marks = [each["y"] for name, each in panels[panel].series.items() if "theory" not in name]
        panels[panel].y = span(np.concatenate(marks), low, high)
    return _message(state, refused, {"panels": panels})


def drawn_forces(state: ExploreState) -> NDArray[np.float64]:
    """Dimensionless forces of the curve and the present one; if points yield, those back from it.

    [1]
    """
    rising = np.union1d(state.bearable(_CURVE_FORCES), state.F)
    if not state.yields:
        return rising
    return np.concatenate([rising[rising <= state.F], state.F * np.array(UNLOADING)])


def further(arguments: Arguments, progress: Progress) -> bytes:
    """What comes later than the contact of a physics that is added: `of` is its key."""
    state, refused = usable_state(arguments)
    kind = next((each for each in state.added if each.key == arguments.get("of")), None)
    if kind is None:
        sentence = "this is not computed without its tick: mark it first"
        raise ControlError(sentence, str(arguments.get("of", "")))
    content, maps = kind.further(state, arguments.get("refines") is True, progress)
    return _message(state, refused, content, maps)


def _contact(arguments: Arguments, progress: Progress, *, is_coarse: bool) -> bytes:
    """The contact on a grid: words and maps; unless coarse with what finer grids change."""
    started = time.perf_counter()
    state, refused = usable_state(arguments)
    n = state.points(_COARSE_POINTS) if is_coarse else state.n
    surface, key = state.surface(n), (replace(state, shown=ExploreState.shown), n, is_coarse)
    if key not in _last:
        asked = {"fields": True, "grid_error": not is_coarse, "measures": state.measures}
        pressed = state.press(surface, progress, [state.F], **asked)
        _last.clear()
        _last[key] = pressed, time.perf_counter() - started
    pressed, seconds = _last[key]
    fields, force = pressed.fields[0], state.force_bars(pressed)
    panels = {
        panel: PanelContent({"here": selected_points(force, values, pressed.converged)})
        for panel, values in state.over_force(pressed).items()
    }
    if not is_coarse:
        panels["spectrum"] = _spectrum(surface, state)
    content = {
        **({"line": _line(state)} if is_coarse else {}),
        "points": n,
        "is_coarse": is_coarse,
        "heights": digest((state.spectrum(n), n, state.seed)),
        "panels": panels,
        "strip": list(contact_words(pressed, fields, surface, state)),
        "facts": [x.brief for x in facts_on_press(surface, pressed) if x.weight != "note"],
        "stiffness_bar_3d": float(state.stiffness_bars(pressed.stiffness[0])),
        "scatter": _scatter(state),
        "status": status(pressed, n, seconds, is_coarse=is_coarse),
    }
    maps = {} if fields is None else _maps(state, surface, fields)
    return _message(state, refused, content, maps, arguments.get("heights"))


def _maps(state: ExploreState, surface: rl.Surface, fields: rl.Fields) -> dict[str, Map]:
    """The maps of a contact, by the words that choose them."""
    height = surface.rms_height
    maps = {
        "height": height_map(
            (surface.heights - surface.heights.mean()) / height, "/ h", scale=height / state.length
        ),
        **contact_maps(
            fields,
            pressure=(1 / state.E_star, "/ E*"),
            gap=(1 / height, "/ h"),
            deflection=(1 / height, "/ h"),
            yields=state.yields,
        ),
    }
    for each in state.added:
        maps |= each.added_maps(fields, state)
    shown = state.shown if state.shown in maps and state.shown not in _POINTED_AT else "pressure"
    return {name: maps[name] for name in (*_POINTED_AT, shown)}


def _scatter(state: ExploreState) -> float | None:
    """How far single surfaces scatter about their mean stiffness, where that is known. [1]"""
    if unlike(state) or state.periodic:
        return None
    try:
        return trust_map().at(state.D_f, state.F, 1 / state.roll_off).scatter
    except rl.InputError:
        return None


def _message(
    state: ExploreState,
    refused: Mapping[str, str],
    content: dict[str, Any],
    maps: Mapping[str, Map] | None = None,
    heights_held: object = (),
) -> bytes:
    """An answer, with what the page is told of its controls: what counts, and what does not.

    Heights do not cross the line again if the page has held them, by the key of their surface.
    """
    if state.cutoff not in (ExploreState.cutoff, state.cutoff_used):
        finest = f"{as_text(state.shortest)} sides"
        why = f"{state.n} points carry no waves shorter than {finest}; that is used meanwhile"
        refused = {"cutoff": why, **refused}
    names = ("D_f", "roll_off", "h", "slope", "seed", "n", "F")
    values = {name: getattr(state, name) for name in names} | {"cutoff": state.cutoff_used}
    for each in state.added:
        values |= each.numbers
    header = {
        "state": state.address(),
        "numbers": {name: float(value) for name, value in values.items()},
        "lows": {"cutoff": state.shortest},
        "refused": refused,
        **content,
    }
    maps = maps or {}
    is_held = isinstance(heights_held, list) and content.get("heights") in heights_held
    above = {"gap": "height"} if "gap" in maps else {}  # both together are the other body
    return drawn(header, content.get("panels", {}), maps, above, ["height"] * is_held)


def _line(state: ExploreState) -> dict[str, Any]:
    """Mean stiffness of lines over force, and at the load of the state."""
    spectrum, without = state.spectrum(state.n), unlike(state)
    lines = _lines(spectrum, state.n, state.seed)
    here = float(np.mean([each.stiffness_bars(np.array([state.F]))[0] for each in lines]))
    points, rows = _line_curve(spectrum, state.n, state.seed)
    if state.F not in _LINE_FORCES:
        at, load = np.searchsorted(_LINE_FORCES, state.F), [figure(state.F), figure(here), "1D"]
        rows = [*rows[:at], load, *rows[at:]]
    legend = f"1D {without}, mean and range" if without else "1D, mean and range of lines"
    panel = PanelContent({"line": points}, rows, legends={"line": legend})
    words = [line_words(state, here)]
    return {"panels": {"stiffness": vars(panel)}, "stiffness_bar_1d": here, "strip": words}


@lru_cache(maxsize=2)
def _line_curve(spectrum: rl.SelfAffine, n: int, seed: int) -> tuple[Points, list[list[str]]]:
    """The curve of lines as it is drawn, and the rows of its table; no load moves it."""
    stiffness = np.array([each.stiffness_bars(_LINE_FORCES) for each in _lines(spectrum, n, seed)])
    mean = stiffness.mean(axis=0)  # without its interval, which would take as long as all lines
    ends = {"low": stiffness.min(axis=0), "high": stiffness.max(axis=0)}
    rows = [[*row, "1D"] for row in number_rows(_LINE_FORCES, mean)]
    return {"x": _LINE_FORCES, "y": mean, **ends}, rows


@dataclass(frozen=True)
class _ScaledSprings:
    """A reduced line on springs under E* = 1, which dimensionless numbers do not know."""

    springs: Springs
    unit_force: float  # h L, of F̄ = 1
    length: float

    def stiffness_bars(self, force_bars: NDArray[np.float64]) -> NDArray[np.float64]:
        """Stiffness k / (E* L) under dimensionless forces, scaled with its own rms height."""
        return self.springs.under_forces(force_bars * self.unit_force).stiffness / self.length


@lru_cache(maxsize=2)
def _lines(spectrum: rl.SelfAffine, n: int, seed: int) -> tuple[_ScaledSprings, ...]:
    """Lines of a spectrum, with the waves of a surface on n points along a side."""
    points = max(_FEWEST_SPRINGS, _SPRINGS_PER_POINT * n)
    lines = (spectrum.line(points, seed + i) for i in range(LINES))
    return tuple(
        _ScaledSprings(
            Springs.under(each.heights, each.spacing, 1.0),
            each.rms_height * each.length,
            each.length,
        )
        for each in lines
    )


def _spectrum(surface: rl.Surface, state: ExploreState) -> PanelContent:
    """Spectrum of the surface, and the law that it is drawn from, over waves in the side."""
    measured = rl.isotropic_spectrum(surface)
    known = measured.C_2d > 0
    q, power = measured.q[known], measured.C_2d[known]
    law = state.spectrum(state.n).lattice(state.n).C_2d(q)
    waves = q * state.length / (2 * np.pi)
    thinned = slice(None, None, -(-waves.size // _MOST_ROWS))
    rows = number_rows(waves[thinned], power[thinned], law[thinned])
    series = {"surface": selected_points(waves, power), "law": selected_points(waves, law)}
    return PanelContent(series, rows, x=span(waves), y=span(power))


def _theories(
    state: ExploreState, surface: rl.Surface
) -> tuple[dict[str, dict[str, Points]], list[str]]:
    """Theories for the waves of the surface, as panels draw them, and how far they hold."""
    lines: dict[str, dict[str, Points]] = {"stiffness": {}, "area": {}}
    remarks, pressures = [], state.force(_THEORY_FORCES) / surface.area
    for name in state.theories:
        called = CHOICES["theories"].options[name]
        if name in ONE_MATERIAL_ONLY and (reason := why_not(name, surface, state.half_space)):
            remarks.append(f"{called}: not drawn, {reason}")
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", rl.ContinuumWarning)  # its sentence is in the validity
            found = rl.theory(name, surface, pressure=pressures, half_space=state.half_space)
        remarks.append(f"{called}: {found.validity}")
        lines["area"][f"theory {name}"] = {"x": _THEORY_FORCES, "y": found.area_fraction}
        if found.stiffness is not None:
            values = state.stiffness_bars(found.stiffness * surface.area)
            lines["stiffness"][f"theory {name}"] = {"x": _THEORY_FORCES, "y": values}
    return lines, remarks
