"""The laws of stiffness and contact area that the ensembles show, for each fractal dimension."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from roughline.errors import InputError
from roughline.paper.contact_area import AreaLaw, area_law, saturation
from roughline.paper.windows import (
    MEDIUM_FORCE,
    OTHER_WINDOWS_REDUCED,
    WINDOW_AGREEMENT,
    ForceWindow,
    Windows,
    covers,
)
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import NO_ESTIMATE, IntervalEstimate
from roughline.statistics.power_law import PowerLaw, exponent_weights, fit_power_law
from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Mask, Real
    from roughline.statistics.averages import Averaging


@dataclass(frozen=True)
class LocalExponents:
    """The exponent at the lowest loads, compared with the exponent at higher ones."""

    lowest: float  # smallest F̄ at which ten springs or cells touch in every realisation
    # exponent in the lower end of the range from `lowest` to F̄ = 0.1, less that in its upper end;
    # each end is a decade, or half of a range shorter than two decades
    drift: IntervalEstimate
    # exponent in the lowest half decade, less that in the window of the fit
    at_lowest: IntervalEstimate


@dataclass(frozen=True)
class DimensionLaws:
    """The laws of stiffness and contact area for one fractal dimension."""

    fractal_dimension: float  # D_f
    # k̄ over F̄ in the two models' windows; k̄ is raw, k / (E* L); NaN where it is not known
    reduced: PowerLaw
    full: PowerLaw
    reduced_elsewhere: tuple[PowerLaw, ...]  # the law of the reduced model in other windows
    # exponent of the reduced model in its window, less that in the last of the other windows
    reduced_by_window: IntervalEstimate
    # how far the exponent of each model changes from the lowest loads to medium ones
    reduced_local: LocalExponents
    full_local: LocalExponents
    # exponent of the full model less that of the reduced one, with the same waves and window
    models_difference: IntervalEstimate
    # raw stiffness of the full model over that of the reduced one at fixed F̄, geometric mean
    # over the window; both models have the same waves
    agreement: IntervalEstimate
    # the law of the area counted in cells, and of the area corrected for its perimeter
    cells: AreaLaw
    corrected: AreaLaw
    # real area fraction, in cells, at which the mean stiffness is 90 % of the punch's
    saturation: IntervalEstimate
    # share of the full model's loads in its window with fewer than ten cells in contact
    unresolved: float
    left_out: int  # realisations left out of a fit because a load in its window did not converge


def dimension_laws(
    reduced: xarray.Dataset | None,
    full: xarray.Dataset,
    matched: xarray.Dataset | None,
    windows: Windows,
) -> DimensionLaws:
    """Evaluate the lines, the surfaces and the lines with their waves of one fractal dimension.

    Where there are no such lines, or loads do not cover a window, numbers are NaN.
    """
    flags = full.resolved.values[:, inside_window(full.force_bar.values, windows.full)]
    return DimensionLaws(
        fractal_dimension=float(full.fractal_dimension),
        reduced=dimension_law(reduced, windows.reduced),
        full=dimension_law(full, windows.full),
        reduced_elsewhere=tuple(dimension_law(reduced, window) for window in OTHER_WINDOWS_REDUCED),
        reduced_by_window=_difference_between_windows(
            reduced, windows.reduced, OTHER_WINDOWS_REDUCED[-1]
        ),
        reduced_local=_local_exponents(reduced, windows.reduced),
        full_local=_local_exponents(full, windows.full),
        models_difference=_surfaces_less_lines(
            full, matched, windows.full, exponent_weights(full.force_bar.values, windows.full)
        ),
        agreement=_stiffness_ratio(full, matched),
        cells=area_law(full, "area_fraction"),
        corrected=area_law(full, "area_fraction_corrected"),
        saturation=saturation(full),
        unresolved=1 - float(flags.mean()) if flags.size else np.nan,
        left_out=_left_out(reduced, windows.reduced) + _left_out(full, windows.full),
    )


def _stiffness_ratio(full: xarray.Dataset, matched: xarray.Dataset | None) -> IntervalEstimate:
    """Stiffness of surfaces over that of lines with the same waves, geometric mean over loads."""
    inside = inside_window(full.force_bar.values, WINDOW_AGREEMENT)
    weights = inside / max(int(np.count_nonzero(inside)), 1)
    return _surfaces_less_lines(full, matched, WINDOW_AGREEMENT, weights).exp()


def exponent_table(data: xarray.Dataset, windows: Sequence[ForceWindow]) -> xarray.Dataset:
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
            law, missing = dimension_law(one, window), _left_out(one, window)
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


def converged_stiffness(data: xarray.Dataset, window: ForceWindow) -> Real:
    """Return k / (E* L) at all loads, of the realisations that converged throughout a window."""
    converged = _converged(data, window)
    if not converged.any():
        raise InputError(
            f"no realisation of D_f = {float(data.fractal_dimension):g} converged throughout "
            f"F̄ = {window[0]:g} to {window[1]:g}: nothing to fit"
        )
    return data.stiffness.values[converged]


def _converged(data: xarray.Dataset, window: ForceWindow) -> Mask:
    """Which realisations converged throughout a window."""
    inside = inside_window(data.force_bar.values, window)
    return np.isfinite(data.stiffness.values[:, inside]).all(axis=1)


def is_fitted(data: xarray.Dataset, window: ForceWindow) -> bool:
    """Whether the loads cover a window, in which a realisation converged throughout."""
    return covers(data.force_bar.values, window) and bool(_converged(data, window).any())


def _left_out(data: xarray.Dataset | None, window: ForceWindow) -> int:
    """Count the realisations that a fit leaves out."""
    if data is None or not is_fitted(data, window):
        return 0
    return int(np.count_nonzero(~_converged(data, window)))


def dimension_law(
    data: xarray.Dataset | None, window: ForceWindow, averaging: Averaging = "arithmetic"
) -> PowerLaw:
    """Return the power law of one fractal dimension; all NaN where there is nothing to fit.

    That of one realisation has no intervals: it does not tell how far another would differ.
    """
    none = (np.nan, np.nan)
    if data is None or not is_fitted(data, window):
        return PowerLaw(np.nan, np.nan, none, none, window, 0, 0, 0.95, "nothing", averaging)
    stiffness = converged_stiffness(data, window)
    law = fit_power_law(data.force_bar.values, stiffness, window, averaging=averaging)
    if law.realisations == 1:
        return replace(law, exponent_interval=none, prefactor_interval=none)
    return law


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


def _local_exponents(data: xarray.Dataset | None, window: ForceWindow) -> LocalExponents:
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
        drift=_difference_between_windows(data, lower_end, upper_end),
        at_lowest=_difference_between_windows(data, half_decade, window),
    )


def _difference_between_windows(
    data: xarray.Dataset | None, first: ForceWindow, second: ForceWindow
) -> IntervalEstimate:
    """Return the exponent in one window less that in another, of the same realisations."""
    if data is None:
        return NO_ESTIMATE
    force = data.force_bar.values
    both = (min(first[0], second[0]), max(first[1], second[1]))
    if not (covers(force, first) and covers(force, second) and is_fitted(data, both)):
        return NO_ESTIMATE
    weights = exponent_weights(force, first) - exponent_weights(force, second)
    return bootstrap.sum_of_log_means(converged_stiffness(data, both), weights).interval_estimate()


def _surfaces_less_lines(
    full: xarray.Dataset, matched: xarray.Dataset | None, window: ForceWindow, weights: Real
) -> IntervalEstimate:
    """Return a weighted sum over loads of the logarithm of the mean stiffness, 3D less 1D.

    The two ensembles are independent, so that they are resampled with two seeds.
    """
    if matched is None or not (is_fitted(full, window) and is_fitted(matched, window)):
        return NO_ESTIMATE
    surfaces, lines = (
        bootstrap.sum_of_log_means(converged_stiffness(data, window), weights, rng=seed)
        for seed, data in enumerate((full, matched))
    )
    return (surfaces - lines).interval_estimate()
