"""The study's numbers: the exponent of every window and every mean, and what it reproduces."""

from __future__ import annotations

import itertools
import json
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray

from roughline.paper.averaging import Fixed, exponent_of_means
from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.paper.windows import ForceWindow
from roughline.statistics.averages import Averaging
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.power_law import linear_exponent, scaling_exponent
from roughline.statistics.verdict import ClaimCase, around
from studies.judged import Found
from studies.paper.data import dataset
from studies.reduced_data import read_one, write_one

HERE = Path(__file__).parent
DATA = HERE / "data.nc"

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


@cache
def plan() -> dict[str, Any]:
    """Return the study's plan."""
    return tomllib.loads((HERE / "plan.toml").read_text(encoding="utf-8"))


def choices() -> list[Choice]:
    """Return all ways to average."""
    return [Choice(fixed, mean) for fixed in plan()["fixed"] for mean in plan()["means"]]


def windows(bodies: str) -> list[ForceWindow]:
    """Return the windows of surfaces or lines."""
    return [(low, high) for low, high in plan()["windows"][bodies]]


@cache
def data() -> xarray.Dataset:
    """Return exponents over (bodies, window, fixed, averaging, fractal_dimension, end)."""
    return read_one(DATA, plan())


def exponent(
    bodies: str, window: ForceWindow, choice: Choice, dimension: float
) -> IntervalEstimate:
    """Return one exponent with its interval; NaN where the means do not cover the window."""
    values = data().exponent.sel(
        bodies=bodies, fixed=choice.fixed, averaging=choice.averaging, fractal_dimension=dimension
    )
    return IntervalEstimate(*map(float, values.isel(window=windows(bodies).index(window))))


def count(bodies: str) -> int:
    """Return the number of realisations of surfaces or lines."""
    return int(json.loads(data().attrs["realisations"])[bodies])


def reproductions(
    bodies: str, window: ForceWindow, choice: Choice, law: str
) -> dict[float, ClaimCase]:
    """Judge, for each fractal dimension, whether a choice shows a published exponent.

    The tolerance is 0.05, as everywhere. Empty where the means do not cover the window.
    """
    found = {each: exponent(bodies, window, choice, each) for each in DIMENSIONS}
    return {
        dimension: Found.of(each, count(bodies)).judged(
            f"at D_f = {dimension}", around(PUBLISHED[law](dimension), EXPONENT_TOLERANCE)
        )
        for dimension, each in found.items()
        if not np.isnan(each.value)
    }


def fit() -> None:
    """Fit the exponents of every window and mean to the bodies that come with the package."""
    fixed, means = plan()["fixed"], plan()["means"]
    names = ("bodies", "window", "fixed", "averaging", "fractal_dimension", "end")
    sizes = [len(each) for each in (BODIES, windows("surfaces"), fixed, means, DIMENSIONS)]
    found = np.empty((*sizes, 3))
    for place in itertools.product(*map(range, sizes)):
        bodies, window, what, mean, dimension = place
        one = dataset(BODIES[bodies]).sel(fractal_dimension=DIMENSIONS[dimension])
        estimate = exponent_of_means(one, windows(BODIES[bodies])[window], fixed[what], means[mean])
        found[place] = (estimate.value, estimate.low, estimate.high)
    counts = {name: dataset(name).sizes["realisation"] for name in BODIES}
    coordinates = {
        "bodies": list(BODIES),
        "fixed": fixed,
        "averaging": means,
        "fractal_dimension": list(DIMENSIONS),
        "end": ["value", "low", "high"],
    }
    data = xarray.Dataset(
        {"exponent": (names, found)}, coordinates, {"realisations": json.dumps(counts)}
    )
    write_one(DATA, plan(), data)
