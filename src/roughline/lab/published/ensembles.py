"""The published ensembles: mean curves and fitted laws, remembered while a page asks again."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.contact import scaling
from roughline.lab.controls import ControlError, Texts, usable
from roughline.lab.published.controls import MODELS, NUMBERS, WINDOWS
from roughline.lab.published.state import PublishedState, read_state
from roughline.lab.server.tasks import Arguments
from roughline.paper.laws import dimension_law
from roughline.paper.mean_curve import MeanCurve, mean_curve
from roughline.paper.results import published_dataset
from roughline.paper.stated import ModelLabel
from roughline.paper.windows import ForceWindow
from roughline.statistics.power_law import PowerLaw, fit_power_law

if TYPE_CHECKING:
    import xarray

_PUNCHES = {"paper": scaling.PAPER_PUNCH, "exact": scaling.EXACT_PUNCH, "raw": 1.0}
_ON_LOAD_WITHIN = 6e-3  # relative difference below which an edge that was typed is that of a load


def usable_state(arguments: Arguments) -> tuple[PublishedState, dict[str, Any]]:
    """The state that a page asks about, and what its controls are told of it."""

    def read(texts: Texts) -> PublishedState:
        state = read_state(texts)
        for model in MODELS:
            fitted_window(state, model)
        return state

    state, refused = usable(arguments, read, PublishedState.address)
    numbers = {key: state[key] for key in NUMBERS}
    return state, {"state": state.address(), "numbers": numbers, "refused": refused}


def ensemble(model: ModelLabel, fractal_dimension: float) -> xarray.Dataset:
    """Lines or surfaces of one fractal dimension, over realisation and load."""
    data = published_dataset("lines" if model == "1D" else "surfaces")
    return data.sel(fractal_dimension=fractal_dimension)


def fitted_window(state: PublishedState, model: ModelLabel) -> ForceWindow:
    """The window of a model, its edges on loads; one with too few loads is refused."""
    force = ensemble(model, 2.0).force_bar.values
    low, high = (_on_load(force, edge) for edge in state.window(model))
    try:
        fit_power_law(force, force, (low, high))
    except rl.InputError as error:
        raise ControlError(str(error), *(edge.key for edge in WINDOWS[model][::-1])) from None
    return low, high


@lru_cache(maxsize=64)
def stiffness_curve(model: ModelLabel, dimension: float, averaging: Any) -> MeanCurve:
    """The mean raw stiffness of one fractal dimension over force."""
    return mean_curve(ensemble(model, dimension), 1.0, averaging)


def normalised_law(state: PublishedState, model: ModelLabel, dimension: float) -> PowerLaw:
    """The power law of one fractal dimension in the window of its model, as it is normalised."""
    law = _law(model, dimension, fitted_window(state, model), state["mean"])
    punch = _PUNCHES[state["punch"]] if model == "3D" else 1.0
    first, last = law.prefactor_interval
    return replace(
        law, prefactor=law.prefactor / punch, prefactor_interval=(first / punch, last / punch)
    )


@lru_cache(maxsize=1024)
def _law(model: ModelLabel, dimension: float, window: ForceWindow, averaging: Any) -> PowerLaw:
    return dimension_law(ensemble(model, dimension), window, averaging)


def _on_load(force: NDArray[np.float64], edge: float) -> float:
    """An edge of a window; one that was rounded to three digits is that of its load again."""
    nearest = float(force[np.argmin(np.abs(np.log(force / edge)))])
    return nearest if abs(nearest / edge - 1) < _ON_LOAD_WITHIN else edge
