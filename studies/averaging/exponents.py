"""The study's numbers: the exponent of every window and every mean, and what it reproduces."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughline.paper.averaging import Fixed
from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.paper.windows import Window
from roughline.statistics.averages import Averaging
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.power_law import linear_exponent, scaling_exponent
from studies.judged import Judgement, WidenedInterval, judged
from studies.reduced_data import read_one

if TYPE_CHECKING:
    import xarray

HERE = Path(__file__).parent
PLAN, DATA = HERE / "plan.toml", HERE / "data.nc"

DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
BODIES = ("surfaces", "lines")

PUBLISHED: dict[str, Callable[[float], float]] = {
    "1/(4 − D_f)": scaling_exponent,
    "0.2567 D_f": linear_exponent,
    "1": lambda dimension: 1.0,
}
"""Exponents that were published: the scaling argument, the paper's fit, and the linear law."""

HELD_AT_LEVEL = 0.88
"""Share of intervals at fixed level that held a known exponent, of 200 samples of 40 bodies."""


@dataclass(frozen=True)
class Choice:
    """One way to average: what realisations have in common, and which mean is taken of them."""

    fixed: Fixed
    averaging: Averaging

    @property
    def name(self) -> str:
        """What it is called in tables."""
        return f"{self.averaging}, at fixed {self.fixed}"


@cache
def plan() -> dict[str, Any]:
    """Return the study's plan."""
    return tomllib.loads(PLAN.read_text(encoding="utf-8"))


def choices() -> list[Choice]:
    """Return all ways to average."""
    return [Choice(fixed, mean) for fixed in plan()["fixed"] for mean in plan()["means"]]


def windows(bodies: str) -> list[Window]:
    """Return the windows of surfaces or lines."""
    return [(low, high) for low, high in plan()["windows"][bodies]]


@cache
def data() -> xarray.Dataset:
    """Return exponents over (bodies, window, fixed, averaging, fractal_dimension, end)."""
    return read_one(DATA, plan())


def exponent(bodies: str, window: Window, choice: Choice, dimension: float) -> IntervalEstimate:
    """Return one exponent with its interval; NaN where the means do not cover the window."""
    values = data().exponent.sel(
        bodies=bodies, fixed=choice.fixed, averaging=choice.averaging, fractal_dimension=dimension
    )
    return IntervalEstimate(*map(float, values.isel(window=windows(bodies).index(window))))


def count(bodies: str) -> int:
    """Return the number of realisations of surfaces or lines."""
    return int(json.loads(data().attrs["realisations"])[bodies])


def reproductions(bodies: str, window: Window, choice: Choice, law: str) -> dict[float, Judgement]:
    """Judge, for each fractal dimension, whether a choice shows a published exponent.

    The tolerance is 0.05, as everywhere. Empty where the means do not cover the window.
    """
    found = {each: exponent(bodies, window, choice, each) for each in DIMENSIONS}
    return {
        dimension: judged(
            WidenedInterval.of(each),
            count(bodies),
            PUBLISHED[law](dimension) - EXPONENT_TOLERANCE,
            PUBLISHED[law](dimension) + EXPONENT_TOLERANCE,
        )
        for dimension, each in found.items()
        if not np.isnan(each.value)
    }


def spread(bodies: str, dimension: float) -> tuple[float, float]:
    """Return the smallest and the largest exponent that any window and mean shows."""
    values = [
        exponent(bodies, window, choice, dimension).value
        for window in windows(bodies)
        for choice in choices()
    ]
    return float(np.nanmin(values)), float(np.nanmax(values))
