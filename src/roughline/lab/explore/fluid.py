"""A fluid between the two bodies: where it goes, how much comes through, and what theories say."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.lab.explore.panels import curve_note, loads, over_force, selected_points
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
from roughline.lab.maps import Map, flux_map, throttled_at
from roughline.lab.panels import PanelContent, Series, marks, span, theory_lines
from roughline.lab.server.tasks import Progress
from roughline.report.values import figure, up_to_three_digits
from roughline.units import engineering, supported_digits

_APERTURE = rl.hydraulic_aperture("x")
_THEORIES = {"critical-junction": "critical junction", "bruggeman": "Bruggeman"}
# dimensionless; the largest seal most surfaces
_FORCES, _THEORY_FORCES = np.geomspace(1e-3, 9, 14), np.geomspace(1e-3, 9, 27)
_SEALED = "sealed"
_LOWEST_FACTOR = 3  # factor between the smallest aperture and the end of the axis
_IN_PYTHON = """flow = rl.flow(curve.fields[0])
print("hydraulic aperture over rms height", flow.hydraulic_aperture / surface.rms_height)
print("sealed", flow.is_sealed)
"""


def _cross(name: str, legend: str, colour: str) -> Series:
    return marks(name, legend, colour, marker="x", size=9, line_width=2)


@dataclass(frozen=True)
class FluidPhysics(Physics):
    """A fluid that flows through the gap, from left to right."""

    key = "fluid"
    word = "x"
    tick = "a fluid flows from left to right"
    meaning = (
        "A fluid flows where the bodies do not touch: the map shows where it goes, the curve how "
        "much comes through, and at which load the contact seals."
    )
    maps: ClassVar = {"flux": "flux"}
    opens = "flux"
    strip = figures("aperture", "channel")
    panels = (
        over_force(
            key="aperture",
            title="Aperture over force",
            y="hydraulic aperture uₕ / h",
            lines=(
                *theory_lines(_THEORIES),
                _cross("theory sealed", "theory, sealed", "theory"),
                _cross("sealed", "3D, sealed: nothing comes through", "dark-line"),
            ),
            theories=None,
            ranges=((1e-4, 10.0), (1e-2, 10.0)),
            columns=("F̄", "uₕ/h", "model"),
            task="fluid",
            waits="the flow under every load is being computed",
        ),
    )
    follows = "surface"

    def measures(self) -> tuple[rl.Measure, ...]:
        """The hydraulic aperture."""
        return (replace(_APERTURE, value=lambda fields: _flow(fields).hydraulic_aperture),)

    def over_force(self, pressed: rl.SurfaceCurve) -> dict[str, NDArray[np.float64]]:
        """Hydraulic apertures over the rms height, zero where sealed. [1]"""
        measured = pressed.measured.get(_APERTURE.name)
        return {} if measured is None else {"aperture": measured.values / pressed.rms_height}

    def words(self, pressed: rl.SurfaceCurve, fields: rl.Fields, state: ExploreState) -> StripWords:
        """What comes through at the load, and the channel that carries most of it."""
        flow, measured, ends = _flow(fields), pressed.measured[_APERTURE.name], None
        aperture = flow.hydraulic_aperture
        if measured.low is not None and measured.high is not None:
            ends = float(measured.low[0]), float(measured.high[0])
        if flow.is_sealed:
            at_most = f"at most {engineering(ends[1], 'm', 3)}" if ends and ends[1] > 0 else ""
            yield FIGURES["aperture"].in_words(_SEALED, at_most)
            return
        doubt = flow.validity or ("" if flow.converged else "the flow did not converge")
        value = figure(aperture / pressed.rms_height, supported_digits(aperture, ends, 3))
        yield FIGURES["aperture"].in_words(
            f"{value} h{' *' if doubt else ''}",
            up_to_three_digits(aperture, ends, "m"),
            f" But {doubt}." if doubt else "",
        )
        x, y = map(figure, throttled_at(flow))
        gap = figure(float(flow.gap[flow.constriction]) / pressed.rms_height)
        yield FIGURES["channel"].in_words(
            f"{figure(100 * flow.largest_share)}%" if flow.largest_share else "none",
            f"ring: x {x} L, y {y} L, gap {gap} h",
        )

    def added_maps(self, fields: rl.Fields, state: ExploreState) -> dict[str, Map]:
        """Where the fluid goes."""
        return {"flux": flux_map(_flow(fields))}

    def saved_fields(self, fields: rl.Fields) -> dict[str, tuple[NDArray[Any], str, str]]:
        """Both components of the flux."""
        meaning = "flow per width along {}, times 12 viscosity / pressure difference"
        flux = zip("xy", _flow(fields).flux, strict=True)
        return {f"flux_{along}": (each, "m^2", meaning.format(along)) for along, each in flux}

    def further(self, state: ExploreState, refines: bool, progress: Progress) -> PageAnswer:
        """What flows through the gap over force, and what theories of the flow say."""
        surface, forces = state.surface_of_curves, state.bearable(_FORCES)
        pressed = state.press(surface, progress, forces, measures=self.measures())
        apertures = self.over_force(pressed)["aperture"]
        drawn, rows = loads(forces, apertures, pressed), _rows(forces, apertures, "3D")
        drawn["sealed"] = selected_points(forces, apertures, apertures == 0)
        sealed, known, remarks = [], [*apertures], []
        pressures = state.force(_THEORY_FORCES) / surface.area
        for name, called in _THEORIES.items():
            theory = rl.theory(name, surface, pressure=pressures, half_space=state.half_space)
            assert theory.hydraulic_aperture is not None
            found = theory.hydraulic_aperture / surface.rms_height
            drawn[f"theory {name}"] = selected_points(_THEORY_FORCES, found)
            sealed += _THEORY_FORCES[found == 0][:1].tolist()  # the first such load alone
            known.append(found[0])
            rows += _rows(_THEORY_FORCES, found, called)
            remarks.append(f"{called}: {theory.validity}.")
        drawn["theory sealed"] = {"x": sealed, "y": [0] * len(sealed)}
        known.append(apertures[apertures > 0].min(initial=np.inf) / _LOWEST_FACTOR)
        caption = f"{_where_sealed(forces, apertures)}; {curve_note(pressed, len(surface.heights))}"
        filled = PanelContent(drawn, rows, caption, " ".join(remarks), y=span(known))
        return {"panels": {"aperture": filled}}, {}

    def code(self, state: ExploreState) -> AddedCode:
        """The aperture at the load; of a command, nothing, as a leak needs two materials."""
        left_out = "the flow through the gap under a contact modulus has no command"
        return AddedCode(after=_IN_PYTHON, left_out=left_out)


@lru_cache(maxsize=4)
def _flow(fields: rl.Fields) -> rl.Flow:
    """The flow through a gap, once for all that is asked of it."""
    return rl.flow(fields)


def _rows(forces: NDArray[Any], found: NDArray[Any], name: str) -> list[list[str]]:
    return [
        [force, _SEALED if aperture == 0 else text, name]
        for (force, text), aperture in zip(number_rows(forces, found), found, strict=True)
    ]


def _where_sealed(forces: NDArray[Any], apertures: NDArray[Any]) -> str:
    """Say between which loads of a rising curve it seals."""
    is_open = np.flatnonzero(apertures != 0)  # and those that were not solved
    if not is_open.size:
        return "sealed under every load"
    open_until, *sealed_from = map(figure, forces[is_open[-1] :][:2])
    if not sealed_from:
        return f"no load up to F̄ = {open_until} seals"
    return f"seals between F̄ = {open_until} and {sealed_from[0]}: marks at the foot"
