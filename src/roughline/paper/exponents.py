"""Exponents of an ensemble: in a window, in several windows, and at the lowest loads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.errors import InputError
from roughline.paper.windows import MEDIUM_FORCE, Window
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import NO_ESTIMATE, IntervalEstimate
from roughline.statistics.power_law import PowerLaw, exponent_weights, fit_power_law
from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Real
    from roughline.statistics.averages import Averaging


@dataclass(frozen=True)
class LocalExponents:
    """The exponent at the lowest loads, compared with the exponent at higher ones.

    Attributes
    ----------
    lowest : float
        Smallest F̄ at which ten springs or cells touch in every realisation.
    drift : IntervalEstimate
        Exponent in the lower end of the range from `lowest` to F̄ = 0.1, less that in its upper
        end. Each end is a decade, or half of the range if the range is shorter than two decades.
    at_lowest : IntervalEstimate
        Exponent in the lowest half decade, less that in the window of the fit.
    """

    lowest: float
    drift: IntervalEstimate
    at_lowest: IntervalEstimate


def exponents_of(data: xarray.Dataset, windows: Sequence[Window]) -> xarray.Dataset:
    """Fit the power law for every fractal dimension of an ensemble, in several windows.

    The result has exponent, low, high, prefactor and left_out over (window, fractal_dimension).
    """
    import xarray  # here because it loads slowly

    names = ("exponent", "low", "high", "prefactor", "left_out")
    dimensions = data.fractal_dimension.values
    fitted = np.empty((len(names), len(windows), dimensions.size))
    for j, dimension in enumerate(dimensions):
        one = data.sel(fractal_dimension=dimension)
        for i, window in enumerate(windows):
            law, missing = law_of(one, window), left_out(one, window)
            fitted[:, i, j] = (law.exponent, *law.exponent_interval, law.prefactor, missing)
    variables = {
        name: (("window", "fractal_dimension"), values)
        for name, values in zip(names, fitted, strict=True)
    }
    coordinates = {
        "fractal_dimension": dimensions,
        "window_low": ("window", [low for low, _ in windows]),
        "window_high": ("window", [high for _, high in windows]),
    }
    attrs = {name: data.attrs[name] for name in ("model", "n", "seed", "roughline_version")}
    attrs["realisations"] = data.sizes["realisation"]
    return xarray.Dataset(variables, coordinates, attrs)


def converged_stiffness(data: xarray.Dataset, window: Window) -> tuple[Real, int]:
    """Return the stiffness of the realisations that converged throughout a window.

    It is k / (E* L) at all loads; beside it stands the number of realisations that are left out.
    """
    stiffness = data.stiffness.values
    inside = inside_window(data.force_bar.values, window)
    converged = np.isfinite(stiffness[:, inside]).all(axis=1)
    if not converged.any():
        raise InputError(
            f"no realisation of D_f = {float(data.fractal_dimension):g} converged throughout "
            f"F̄ = {window[0]:g} to {window[1]:g}: nothing to fit"
        )
    return stiffness[converged], int(np.count_nonzero(~converged))


def covers(force_bar: Real, window: Window) -> bool:
    """Whether loads reach both ends of a window, and three of them or more lie in it."""
    inside = np.count_nonzero(inside_window(force_bar, window))
    reached = inside_window(np.array(window), (float(force_bar[0]), float(force_bar[-1])))
    return bool(inside >= 3 and reached.all())


def is_fitted(data: xarray.Dataset, window: Window) -> bool:
    """Whether the loads cover a window, in which a realisation converged throughout."""
    inside = inside_window(data.force_bar.values, window)
    converged = np.isfinite(data.stiffness.values[:, inside]).all(axis=1)
    return covers(data.force_bar.values, window) and bool(converged.any())


def left_out(data: xarray.Dataset | None, window: Window) -> int:
    """Count the realisations that a fit leaves out."""
    if data is None or not is_fitted(data, window):
        return 0
    return converged_stiffness(data, window)[1]


def law_of(
    data: xarray.Dataset | None, window: Window, averaging: Averaging = "arithmetic"
) -> PowerLaw:
    """Return the power law of one fractal dimension; all NaN where there is nothing to fit."""
    if data is None or not is_fitted(data, window):
        none = (np.nan, np.nan)
        return PowerLaw(np.nan, np.nan, none, none, window, 0, 0, 0.95, "nothing", averaging)
    stiffness, _ = converged_stiffness(data, window)
    return fit_power_law(data.force_bar.values, stiffness, window, averaging=averaging)


def at_dimension(data: xarray.Dataset | None, dimension: float) -> xarray.Dataset | None:
    """Return an ensemble at one fractal dimension; None where it does not have that one."""
    if data is None:
        return None
    (found,) = np.nonzero(np.isclose(data.fractal_dimension.values, dimension, rtol=0, atol=1e-9))
    return data.isel(fractal_dimension=int(found[0])) if found.size else None


def exponent_estimate(law: PowerLaw) -> IntervalEstimate:
    """Return the exponent of a power law with its interval."""
    return IntervalEstimate(law.exponent, *law.exponent_interval)


def prefactor_estimate(law: PowerLaw) -> IntervalEstimate:
    """Return the prefactor of a power law with its interval."""
    return IntervalEstimate(law.prefactor, *law.prefactor_interval)


def local_exponents(data: xarray.Dataset | None, window: Window) -> LocalExponents:
    """Compare the exponent at the lowest loads with those at medium loads and in a window."""
    if data is None:
        return LocalExponents(np.nan, NO_ESTIMATE, NO_ESTIMATE)
    force = data.force_bar.values
    resolved = (data.resolved.values == 1).all(axis=0)
    lowest = float(force[np.argmax(resolved)]) if resolved.any() else np.nan
    if not lowest < MEDIUM_FORCE:
        return LocalExponents(lowest, NO_ESTIMATE, NO_ESTIMATE)
    step = min(10.0, np.sqrt(MEDIUM_FORCE / lowest))
    lower_end, upper_end = (lowest, lowest * step), (MEDIUM_FORCE / step, MEDIUM_FORCE)
    half_decade = (lowest, lowest * np.sqrt(10))
    return LocalExponents(
        lowest=lowest,
        drift=difference_between_windows(data, lower_end, upper_end),
        at_lowest=difference_between_windows(data, half_decade, window),
    )


def difference_between_windows(
    data: xarray.Dataset | None, first: Window, second: Window
) -> IntervalEstimate:
    """Return the exponent in one window less that in another, of the same realisations."""
    if data is None:
        return NO_ESTIMATE
    force = data.force_bar.values
    both = (min(first[0], second[0]), max(first[1], second[1]))
    if not (covers(force, first) and covers(force, second) and is_fitted(data, both)):
        return NO_ESTIMATE
    weights = exponent_weights(force, first) - exponent_weights(force, second)
    stiffness, _ = converged_stiffness(data, both)
    return bootstrap.sum_of_log_means(stiffness, weights).interval_estimate()


def difference_between_models(
    full: xarray.Dataset, matched: xarray.Dataset | None, window: Window
) -> IntervalEstimate:
    """Return the exponent of surfaces less that of lines with the same waves."""
    weights = exponent_weights(full.force_bar.values, window)
    return surfaces_less_lines(full, matched, window, weights)


def surfaces_less_lines(
    full: xarray.Dataset, matched: xarray.Dataset | None, window: Window, weights: Real
) -> IntervalEstimate:
    """Return a weighted sum over loads of the logarithm of the mean stiffness, 3D less 1D.

    The two ensembles are independent, so that they are resampled with two seeds.
    """
    if matched is None or not (is_fitted(full, window) and is_fitted(matched, window)):
        return NO_ESTIMATE
    surfaces, lines = (
        bootstrap.sum_of_log_means(converged_stiffness(data, window)[0], weights, rng=seed)
        for seed, data in enumerate((full, matched))
    )
    return (surfaces - lines).interval_estimate()
