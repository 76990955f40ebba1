"""Pictures of exponents over the fractal dimension, beside what the paper states."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, TypeGuard, cast

import numpy as np
from matplotlib.axes import Axes

from roughline.errors import InputError
from roughline.errors.public import public
from roughline.plot.style import MARKERS, dimension_label, drawing_on
from roughline.statistics.power_law import (
    PowerLaw,
    fit_power_law,
    linear_exponent,
    scaling_exponent,
)
from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    import xarray

_COLOURS = ("tab:blue", "tab:red", "tab:green", "tab:purple", "tab:orange", "tab:brown")


@public
def exponents(
    laws: xarray.Dataset | Mapping[float, PowerLaw] | Iterable[tuple[float, PowerLaw]],
    window: tuple[float, float] | None = None,
    axes: Axes | None = None,
    *,
    label: str | None = None,
) -> Axes:
    """Draw the exponent of power laws over the fractal dimension.

    Parameters
    ----------
    laws : Dataset, or PowerLaw by fractal dimension
        An ensemble of a campaign, as ``Store.dataset`` gives it, or laws by their fractal
        dimensions: ``{2.2: law, 2.6: another}``, or pairs of both.
    window : tuple of float, optional
        Smallest and largest force_bar to fit; needed for an ensemble, and for that alone.
        Realisations in which a load of the window did not converge are left out.
    axes : Axes, optional
        Where to draw, such as those of an exponent plot before; default: those of a new figure.
    label : str, optional
        What the legend says; default: which model, and the window.

    Returns
    -------
    Axes
        The axes that were drawn on, with the intervals of the laws and, dashed and dotted, the two
        formulas of the paper: 1 / (4 - D_f), and 0.2567 D_f.

    Raises
    ------
    InputError
        If an ensemble comes without a window, or laws with one, or an ensemble does not have the
        loads of the window.
    """
    if _is_ensemble(laws):
        if window is None:
            raise InputError("an ensemble is fitted first: give a window, such as (1e-2, 1e-1)")
        found = _fitted(laws, window)
        name = "lines" if laws.attrs.get("model") == "reduced" else "surfaces"
    else:
        if window is not None:
            raise InputError("laws have windows of their own: leave the window out")
        found = dict(cast("Mapping[float, PowerLaw]", laws))
        name = "power law"
    if not found:
        raise InputError("there is no law to draw: give at least one")
    with drawing_on(axes) as drawn:
        if not drawn.containers:
            fine = np.linspace(2, 3, 101)
            drawn.plot(fine, scaling_exponent(fine), "k--", linewidth=1, label="$1/(4 - D_f)$")
            drawn.plot(fine, linear_exponent(fine), "k:", linewidth=1.2, label=r"$0.2567\,D_f$")
        _draw(drawn, found, label or f"{name}{_in_window(found.values())}")
        drawn.set(xlabel="fractal dimension $D_f$", ylabel=r"exponent $\alpha$", xlim=(1.97, 3.03))
        drawn.legend()
    return drawn


def _is_ensemble(
    laws: xarray.Dataset | Mapping[float, PowerLaw] | Iterable[tuple[float, PowerLaw]],
) -> TypeGuard[xarray.Dataset]:
    return hasattr(laws, "data_vars")


def _fitted(data: xarray.Dataset, window: tuple[float, float]) -> dict[float, PowerLaw]:
    """Fit every fractal dimension of an ensemble."""
    force = data.force_bar.values
    inside = inside_window(force, window)
    found = {}
    for dimension in data.fractal_dimension.values.tolist():
        stiffness = data.stiffness.sel(fractal_dimension=dimension).values
        converged = np.isfinite(stiffness[:, inside]).all(axis=1)
        if not converged.any():
            raise InputError(
                f"no realisation of D_f = {dimension_label(dimension)} converged throughout "
                f"{window[0]:g} to {window[1]:g}: nothing to fit"
            )
        found[dimension] = fit_power_law(force, stiffness[converged], window)
    return found


def _draw(axes: Axes, laws: Mapping[float, PowerLaw], label: str) -> None:
    """Draw exponents with their intervals, unlike those that were drawn before."""
    dimensions, number = sorted(laws), len(axes.containers)
    alpha = np.array([laws[each].exponent for each in dimensions])
    ends = np.array([laws[each].exponent_interval for each in dimensions]).T
    axes.errorbar(
        dimensions,
        alpha,
        yerr=np.abs(ends - alpha),
        fmt=MARKERS[number % len(MARKERS)],
        color=_COLOURS[number % len(_COLOURS)],
        capsize=2,
        linewidth=1,
        label=label,
    )


def _in_window(laws: Iterable[PowerLaw]) -> str:
    """The window of laws that have one in common."""
    windows = {law.window for law in laws}
    if len(windows) > 1:
        return ""
    ((low, high),) = windows
    return rf", $\bar F$ = {low:g} to {high:g}"
