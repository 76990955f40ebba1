"""Points that yield at a hardness, and are permanently indented."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

import roughline as rl
from roughline.lab.controls import as_code
from roughline.lab.explore.controls import DECLARED
from roughline.lab.explore.panels import BACK, selected_points
from roughline.lab.explore.state import (
    FIGURES,
    AddedCode,
    ExploreState,
    FilledPanels,
    PageAnswer,
    Physics,
    StripWords,
    figures,
)
from roughline.lab.explore.words import first, load_rows, stiffness_with_ends
from roughline.lab.panels import PanelContent, marks
from roughline.lab.server.tasks import Progress
from roughline.margins.grid import intervals_of_grid
from roughline.question.loading import UNLOADING
from roughline.report.values import figure, up_to_three_digits

_IN_PYTHON = """print("unloading_stiffness", curve.unloading_stiffness[0], "N/m")
print("plastic_fraction", curve.plastic_fraction[0])
print("largest indentation over rms height", curve.indentation[0] / surface.rms_height)
"""


@dataclass(frozen=True)
class YieldingPhysics(Physics):
    """Points that bear no more than the hardness."""

    hardness_bar: float

    key = "hardness_bar"
    tick = "points yield at a hardness"
    meaning = (
        "Points at which the pressure reaches the hardness bear no more and are permanently "
        "indented; without a hardness both bodies are elastic."
    )
    controls = (DECLARED["hardness_bar"],)
    unlike = "without yield"
    strip = figures("unloading", "plastic", "indentation")
    series: ClassVar = {
        "stiffness": (
            marks("unloading", "3D, on unloading", "mark", marker="triangle", size=7, fill_alpha=0),
            BACK,
        ),
        "area": (BACK,),
        "aperture": (BACK,),
    }
    follows = "load"

    def hardness(self, state: ExploreState) -> float:
        """Hardness, the same on every grid. [Pa]"""
        return self.in_si("hardness_bar", state)

    def law(self, state: ExploreState) -> rl.ContactLaw:
        """No more than the hardness."""
        return rl.Yielding(self.hardness(state))

    def beside_curve(self, pressed: rl.SurfaceCurve, state: ExploreState) -> FilledPanels:
        """The stiffness on unloading of every load."""
        forces = state.force_bars(pressed)
        values = state.stiffness_bars(pressed.unloading_stiffness)
        rows = load_rows(forces, values, pressed, "3D, on unloading")
        return {"stiffness": PanelContent({"unloading": selected_points(forces, values)}, rows)}

    def words(self, pressed: rl.SurfaceCurve, fields: rl.Fields, state: ExploreState) -> StripWords:
        """Stiffness on unloading, share of the contact that yields, and indentation."""
        intervals, unloading = intervals_of_grid(pressed), float(pressed.unloading_stiffness[0])
        ends = first(intervals.unloading) if intervals else None
        yield FIGURES["unloading"].in_words(*stiffness_with_ends(unloading, ends, state))
        plastic, hardness = float(pressed.plastic_fraction[0]), self.hardness(state)
        in_unit = up_to_three_digits(hardness, None, "Pa")
        yield FIGURES["plastic"].in_words(f"{figure(100 * plastic)}%", f"H {in_unit}")
        indentation = float(pressed.indentation[0])
        in_unit = up_to_three_digits(indentation, None, "m")
        yield FIGURES["indentation"].in_words(
            f"{figure(indentation / pressed.rms_height)} h", in_unit
        )

    def further(self, state: ExploreState, refines: bool, progress: Progress) -> PageAnswer:
        """Follow the way back from the load to none."""
        forces = state.F * np.array([1.0, *UNLOADING])
        pressed = state.press(state.surface_of_curves, progress, forces, measures=state.measures)
        values = state.over_force(pressed)
        values["stiffness"] = state.stiffness_bars(pressed.unloading_stiffness)
        panels = {
            panel: PanelContent(
                {"back": selected_points(forces, each)},
                load_rows(forces, each, pressed, BACK.legend),
            )
            for panel, each in values.items()
        }
        return {"panels": panels}, {}

    def code(self, state: ExploreState) -> AddedCode:
        """The hardness, and the way back."""
        over = f"{as_code(self.hardness_bar)} * E_star * surface.rms_slope"
        path = f"[force * share for share in {(1.0, *UNLOADING)}]"  # the last ones unload
        in_words = state.in_words("hardness_bar", "Pa", self.hardness(state))
        return AddedCode(
            before=f"hardness = {state.in_python('hardness_bar', 'Pa', over)}  # Pa\n",
            arguments=f"hardness=hardness, forces={path}",
            after=_IN_PYTHON,
            command=("--hardness", in_words, "--unload"),
        )
