"""The published ensembles: mean curves and fitted laws, remembered while a page asks again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.contact import scaling
from roughline.lab.controls import ControlError, Texts, usable
from roughline.lab.published.controls import MODELS, WINDOWS, ModelLabel
from roughline.lab.published.state import PublishedState, Window, state_of
from roughline.lab.server.tasks import Arguments
from roughline.paper.laws import converged_stiffness
from roughline.paper.mean_curve import MeanCurve, mean_curve
from roughline.paper.results import published_dataset
from roughline.statistics.averages import Averaging
from roughline.statistics.power_law import PowerLaw, fit_power_law
from roughline.statistics.window import inside_window
from roughline.units import decimal

if TYPE_CHECKING:
    import xarray

_PUNCHES = {"paper": scaling.PAPER_PUNCH, "exact": scaling.EXACT_PUNCH, "raw": 1.0}
_SAME = 1e-3  # relative difference below which an edge that was typed is that of a load


def model_of(said: object) -> ModelLabel:
    """Read which model is asked about."""
    if said not in MODELS:
        raise ControlError("there is no such model; there are 1D and 3D")
    return "1D" if said == "1D" else "3D"


def usable_state(arguments: Arguments) -> tuple[PublishedState, dict[str, Any]]:
    """The state that a page asks about, and what its controls are told of it."""

    def read(texts: Texts) -> PublishedState:
        state = state_of(texts)
        for model in MODELS:
            _window(state, model_of(model))
        return state

    state, refused = usable(arguments, read, PublishedState.address)
    return state, {"state": state.address(), "numbers": state.numbers(), "refused": refused}


def ensemble(model: ModelLabel) -> xarray.Dataset:
    """Lines or surfaces over fractal dimension, realisation and load."""
    return published_dataset("lines" if model == "1D" else "surfaces")


def one_dimension(model: ModelLabel, fractal_dimension: float) -> xarray.Dataset:
    """Lines or surfaces of one fractal dimension."""
    return ensemble(model).sel(fractal_dimension=fractal_dimension)


def punch_of(state: PublishedState, model: ModelLabel) -> float:
    """What the stiffness k / (E* L) of a model is divided by; nothing for lines."""
    return _PUNCHES[state.punch] if model == "3D" else 1.0


@lru_cache(maxsize=64)
def curve_of(
    model: ModelLabel, fractal_dimension: float, punch: float, averaging: Averaging
) -> MeanCurve:
    """The mean stiffness of one fractal dimension over force."""
    return mean_curve(one_dimension(model, fractal_dimension), punch, averaging)


def table_of(symbol: str, curves: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Means over force of some fractal dimensions in a table; a star is where the grid decides."""
    cells = [[decimal(float(force), 3) for force in curves[0]["force_bar"]]]
    cells += [
        [
            decimal(float(value), 3) + ("" if sure else " *")
            for value, sure in zip(each["mean"], each["resolved"], strict=True)
        ]
        for each in curves
    ]
    return {
        "header": ["F̄", *(f"{symbol}, D_f = {each['D_f']}" for each in curves)],
        "rows": [list(row) for row in zip(*cells, strict=True)],
    }


def law_of(state: PublishedState, model: ModelLabel, fractal_dimension: float) -> PowerLaw:
    """Fit the power law of one fractal dimension in the window of its model.

    Raises
    ------
    ControlError
        If the window holds too few loads.
    """
    law = _law(model, fractal_dimension, _window(state, model), state.mean)
    punch = punch_of(state, model)
    first, last = law.prefactor_interval
    return replace(
        law, prefactor=law.prefactor / punch, prefactor_interval=(first / punch, last / punch)
    )


def unresolved_in_window(model: ModelLabel, fractal_dimension: float, window: Window) -> bool:
    """Whether the grid decides at some load of a window."""
    curve = curve_of(model, fractal_dimension, 1.0, "arithmetic")
    return not curve.resolved[inside_window(curve.force_bar, window)].all()


def _window(state: PublishedState, model: ModelLabel) -> Window:
    """The window of a model, its edges on loads; one with too few loads is refused."""
    force = ensemble(model).force_bar.values
    low, high = (_on_load(force, edge) for edge in state.windows[model])
    try:
        fit_power_law(force, force, (low, high))
    except rl.InputError as error:
        low_edge, high_edge = WINDOWS[model]
        raise ControlError(str(error), *(high_edge.key, low_edge.key)) from None
    return low, high


@lru_cache(maxsize=1024)
def _law(
    model: ModelLabel, fractal_dimension: float, window: Window, averaging: Averaging
) -> PowerLaw:
    one = one_dimension(model, fractal_dimension)
    stiffness = converged_stiffness(one, window)
    return fit_power_law(one.force_bar.values, stiffness, window, averaging=averaging)


def _on_load(force: NDArray[np.float64], edge: float) -> float:
    """An edge of a window; one that was rounded for the address is that of its load again."""
    nearest = float(force[np.argmin(np.abs(np.log(force / edge)))])
    return nearest if abs(nearest / edge - 1) < _SAME else edge
