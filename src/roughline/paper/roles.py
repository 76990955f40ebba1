"""Which ensembles of a plan, or of a store, are the bodies that the paper compares."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughline.errors import InputError
from roughline.paper.plan import ENSEMBLE_FULL, ENSEMBLE_REDUCED

_EnsembleSettings = Mapping[str, Any]
"""Settings of an ensemble, as a plan and the attributes of its results have them."""


@dataclass(frozen=True)
class _Roles:
    """Names of the ensembles that a report is made of."""

    full: str  # surfaces
    reduced: str  # lines
    # lines with the waves and the loads of the surfaces; those of `reduced` if there are no others
    matched: str | None
    other_grid: str | None  # the surfaces on another grid

    @property
    def names(self) -> tuple[str, ...]:
        """All of them, each once."""
        named = (self.reduced, self.matched, self.full, self.other_grid)
        return tuple(dict.fromkeys(name for name in named if name is not None))


def chosen_roles(ensembles: Mapping[str, _EnsembleSettings]) -> _Roles:
    """Choose the ensembles of a report by their settings; both surfaces and lines are needed.

    Of several that fit, those with the names of the paper's own plan are taken, then elastic
    surfaces with free borders and no roll-off, then the finest grid.
    """
    surfaces, lines = (
        {name: each for name, each in ensembles.items() if each["model"] == model}
        for model in ("full", "reduced")
    )
    if not (surfaces and lines):
        there = ", ".join(f"{name} ({each['model']})" for name, each in ensembles.items())
        raise InputError(
            'the report compares surfaces and lines: an ensemble with model = "full" and one with '
            f'model = "reduced" are needed; there is {there or "none"}'
        )
    full = max(surfaces, key=lambda name: _likeness(name, ENSEMBLE_FULL, surfaces[name]))
    matching = [name for name in lines if _has_same_waves(lines[name], surfaces[full])]
    others = {name: lines[name] for name in lines if name not in matching} or lines
    reduced = max(others, key=lambda name: _likeness(name, ENSEMBLE_REDUCED, others[name]))
    grids = [name for name in surfaces if _differs_in_grid(surfaces[name], surfaces[full])]
    return _Roles(
        full,
        reduced,
        matched=max(matching, key=lambda name: lines[name]["n"], default=None),
        other_grid=max(grids, key=lambda name: surfaces[name]["n"], default=None),
    )


def departures(settings: _EnsembleSettings) -> list[str]:
    """Say in words where an ensemble is not as the paper's."""
    words = []
    if settings["boundary"] == "periodic":
        words.append("periodic")
    if settings["roll_off_ratio"] != 1:
        words.append(f"with a roll-off at {settings['roll_off_ratio']:g} q_0")
    if settings["cutoff_ratio"] != "grid":
        words.append(f"with waves down to {settings['cutoff_ratio']:g} q_0")
    if "hardness_bar" in settings:
        words.append(f"yielding at H = {settings['hardness_bar']:g} E* ∇h")
    return words


def _likeness(name: str, paper_name: str, settings: _EnsembleSettings) -> tuple[bool, int, int]:
    """How like the paper's an ensemble is; larger is more like it."""
    return name == paper_name, -len(departures(settings)), settings["n"]


def _cutoff(settings: _EnsembleSettings) -> float:
    """q_high / q_0 of an ensemble."""
    cutoff = settings["cutoff_ratio"]
    return settings["n"] / 2 if cutoff == "grid" else float(cutoff)


def _has_same_waves(line: _EnsembleSettings, surface: _EnsembleSettings) -> bool:
    """Whether lines have the waves and the loads of surfaces."""
    forces = np.array(line["force_bars"]), np.array(surface["force_bars"])
    return (
        math.isclose(_cutoff(line), _cutoff(surface))
        and line["roll_off_ratio"] == surface["roll_off_ratio"]
        and forces[0].shape == forces[1].shape
        and bool(np.allclose(*forces, rtol=1e-9, atol=0))
    )


def _differs_in_grid(one: _EnsembleSettings, other: _EnsembleSettings) -> bool:
    """Whether surfaces differ from others in their grid, and perhaps in their loads, alone."""
    same = ("boundary", "roll_off_ratio", "cutoff_ratio", "seed")
    return (
        one["n"] != other["n"]
        and all(one[key] == other[key] for key in same)
        and one.get("hardness_bar") == other.get("hardness_bar")
    )
