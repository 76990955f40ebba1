"""What the ensembles say for each fractal dimension: exponents, constants, intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.paper.contact_area import AreaLaw, area_law, saturation
from roughline.paper.results import PaperResults
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import NOTHING, Estimate
from roughline.statistics.power_law import PowerLaw, exponent_weights, fit_power_law, inside_window

if TYPE_CHECKING:
    import xarray

Window = tuple[float, float]

WINDOW_REDUCED: Window = (1e-4, 1e-2)
"""Range of F̄ for alpha of the reduced model."""
WINDOW_FULL: Window = (1e-2, 1e-1)
"""Range of F̄ for alpha of the full model, whose grid resolves no less."""
WINDOW_AGREEMENT: Window = (1e-2, 0.3)
"""Range of F̄ in which the stiffness of the two models is compared."""
OTHER_WINDOWS_REDUCED: tuple[Window, ...] = ((1e-3, 1e-1), (1e-2, 0.3))


WINDOW_SAME: Window = (1e-2, 1e-1)
"""Range of F̄ in which the exponents of the two models with the same waves are compared."""
MEDIUM = 0.1
"""Largest F̄ that counts as medium."""


@dataclass(frozen=True)
class LocalExponents:
    """The exponent at the lowest loads, beside that at higher ones.

    Attributes
    ----------
    lowest : float
        Smallest F̄ at which ten springs or cells touch in every realisation.
    drift : Estimate
        Exponent in the lower end of F̄ = `lowest` to 0.1 less that in its upper end; each end is
        a decade, or half of the range where that is shorter.
    at_lowest : Estimate
        Exponent in the lowest half decade less that in the window of the fit.
    """

    lowest: float
    drift: Estimate
    at_lowest: Estimate


@dataclass(frozen=True)
class DimensionSummary:
    """What the ensembles say for one fractal dimension.

    Attributes
    ----------
    fractal_dimension : float
        D_f.
    reduced, full : PowerLaw
        k̄ over F̄ in the two models' windows; k̄ is raw, k / (E* L).
    reduced_elsewhere : tuple of PowerLaw
        The reduced model's law in other windows.
    reduced_by_window : tuple of Estimate
        Its exponent in the first window less that in each of the others.
    reduced_local, full_local : LocalExponents
        How far each model's exponent changes from the lowest loads to medium ones.
    models_apart : Estimate
        Exponent of the full model less that of the reduced one, same waves and window.
    agreement : Estimate
        Full over reduced raw stiffness at fixed F̄, geometric mean over the window; both models
        have the same waves.
    cells, corrected : AreaLaw
        Of the area counted in cells, and of the area corrected for its perimeter.
    saturation : Estimate
        Real area fraction in cells, at which the mean stiffness is 90 % of the punch's.
    unresolved : float
        Share of the full model's loads in its window with fewer than ten cells in contact.
    left_out : int
        Realisations left out of a fit because a load in its window did not converge.
    """

    fractal_dimension: float
    reduced: PowerLaw
    full: PowerLaw
    reduced_elsewhere: tuple[PowerLaw, ...]
    reduced_by_window: tuple[Estimate, ...]
    reduced_local: LocalExponents
    full_local: LocalExponents
    models_apart: Estimate
    agreement: Estimate
    cells: AreaLaw
    corrected: AreaLaw
    saturation: Estimate
    unresolved: float
    left_out: int


def summarise(results: PaperResults) -> list[DimensionSummary]:
    """Evaluate the ensembles for each fractal dimension of the full model."""
    return [
        _summary(*(data.sel(fractal_dimension=dimension) for data in results.ensembles))
        for dimension in results.full.fractal_dimension.values
    ]


def exponents_of(data: xarray.Dataset, windows: Sequence[Window]) -> xarray.Dataset:
    """Fit the power law for every fractal dimension of an ensemble, in several windows.

    Returns
    -------
    Dataset
        exponent, low, high, prefactor and left_out over (window, fractal_dimension).
    """
    import xarray  # here because it loads slowly

    found: dict[str, list[list[float]]] = {
        name: [[] for _ in windows] for name in ("exponent", "low", "high", "prefactor", "left_out")
    }
    for dimension in data.fractal_dimension.values:
        one = data.sel(fractal_dimension=dimension)
        for i, window in enumerate(windows):
            stiffness, left_out = usable(one, window)
            law = fit_power_law(one.force_bar.values, stiffness, window)
            row = (law.exponent, *law.exponent_interval, law.prefactor, left_out)
            for name, value in zip(found, row, strict=True):
                found[name][i].append(float(value))
    variables = {name: (("window", "fractal_dimension"), table) for name, table in found.items()}
    coordinates = {
        "fractal_dimension": data.fractal_dimension.values,
        "window_low": ("window", [low for low, _ in windows]),
        "window_high": ("window", [high for _, high in windows]),
    }
    kept = ("model", "n", "seed", "roughline_version")
    attrs = {name: data.attrs[name] for name in kept}
    attrs["realisations"] = data.sizes["realisation"]
    return xarray.Dataset(variables, coordinates, attrs)


def _summary(
    reduced: xarray.Dataset, full: xarray.Dataset, matched: xarray.Dataset
) -> DimensionSummary:
    stiffness_1d, left_out_1d = usable(reduced, WINDOW_REDUCED)
    stiffness_3d, left_out_3d = usable(full, WINDOW_FULL)
    force_1d, force_3d = reduced.force_bar.values, full.force_bar.values
    in_window = inside_window(force_3d, WINDOW_FULL)
    return DimensionSummary(
        fractal_dimension=float(full.fractal_dimension),
        reduced=fit_power_law(force_1d, stiffness_1d, WINDOW_REDUCED),
        full=fit_power_law(force_3d, stiffness_3d, WINDOW_FULL),
        reduced_elsewhere=tuple(
            fit_power_law(force_1d, stiffness_1d, window) for window in OTHER_WINDOWS_REDUCED
        ),
        reduced_by_window=tuple(
            _exponents_apart(reduced, WINDOW_REDUCED, window) for window in OTHER_WINDOWS_REDUCED
        ),
        reduced_local=_local_exponents(reduced, WINDOW_REDUCED),
        full_local=_local_exponents(full, WINDOW_FULL),
        models_apart=_models_apart(matched, full),
        agreement=_agreement(matched, full),
        cells=area_law(full, "area_fraction"),
        corrected=area_law(full, "area_fraction_corrected"),
        saturation=saturation(full),
        unresolved=1 - float(full.resolved.values[:, in_window].mean()),
        left_out=left_out_1d + left_out_3d,
    )


def _exponents_apart(data: xarray.Dataset, first: Window, second: Window) -> Estimate:
    """Exponent in one window less that in another, of the same realisations."""
    force = data.force_bar.values
    both = (min(first[0], second[0]), max(first[1], second[1]))
    weights = exponent_weights(force, first) - exponent_weights(force, second)
    if not np.isfinite(weights).all():
        return NOTHING
    return bootstrap.of_log_means(usable(data, both)[0], weights).estimate()


def _local_exponents(data: xarray.Dataset, window: Window) -> LocalExponents:
    force = data.force_bar.values
    certain = (data.resolved.values == 1).all(axis=0)
    lowest = float(force[np.argmax(certain)]) if certain.any() else np.nan
    step = min(10.0, np.sqrt(MEDIUM / lowest))
    ends = (lowest, lowest * step), (MEDIUM / step, MEDIUM)
    return LocalExponents(
        lowest=lowest,
        drift=_exponents_apart(data, *ends),
        at_lowest=_exponents_apart(data, (lowest, lowest * np.sqrt(10)), window),
    )


def _models_apart(matched: xarray.Dataset, full: xarray.Dataset) -> Estimate:
    """Exponent of surfaces less that of lines with the same waves."""
    weights = exponent_weights(full.force_bar.values, WINDOW_SAME)
    surfaces, lines = (
        bootstrap.of_log_means(usable(data, WINDOW_SAME)[0], weights, rng=seed)
        for seed, data in enumerate((full, matched))
    )
    return (surfaces - lines).estimate()


def _agreement(matched: xarray.Dataset, full: xarray.Dataset) -> Estimate:
    """Full over reduced stiffness, of surfaces and of lines with the same waves."""
    inside = inside_window(full.force_bar.values, WINDOW_AGREEMENT)
    weights = inside / np.count_nonzero(inside)
    # the two ensembles are independent: they are resampled apart
    surfaces, lines = (
        bootstrap.of_log_means(usable(data, WINDOW_AGREEMENT)[0], weights, rng=seed)
        for seed, data in enumerate((full, matched))
    )
    return (surfaces - lines).estimate().exp()


def usable(data: xarray.Dataset, window: Window) -> tuple[Real, int]:
    """Raw stiffness of the realisations that converged throughout a window; how many did not."""
    stiffness = data.stiffness.values
    usable = np.isfinite(stiffness[:, inside_window(data.force_bar.values, window)]).all(axis=1)
    if not usable.any():
        raise InputError(
            f"no realisation of D_f = {float(data.fractal_dimension):g} converged throughout "
            f"F̄ = {window[0]:g} to {window[1]:g}: nothing to fit"
        )
    return stiffness[usable], int(np.count_nonzero(~usable))
