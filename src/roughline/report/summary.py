"""What the ensembles say for each fractal dimension: exponents, constants, intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from roughline import bootstrap, scaling
from roughline.errors import InputError
from roughline.power_law import PowerLaw, fit_power_law
from roughline.report.results import PaperResults

if TYPE_CHECKING:
    import xarray

Real = NDArray[np.float64]
Window = tuple[float, float]

WINDOW_REDUCED: Window = (1e-4, 1e-2)
"""Range of F̄ for alpha of the reduced model."""
WINDOW_FULL: Window = (1e-2, 1e-1)
"""Range of F̄ for alpha of the full model, whose grid resolves no less."""
WINDOW_AGREEMENT: Window = (1e-2, 0.3)
"""Range of F̄ in which the stiffness of the two models is compared."""
WINDOW_AREA: Window = (10**-1.5, 10**-0.5)
"""Range of F̄ for the area law."""
OTHER_WINDOWS_REDUCED: tuple[Window, ...] = ((1e-3, 1e-1), (1e-2, 0.3))


@dataclass(frozen=True)
class Estimate:
    """A number with its 95 % interval from resampled realisations."""

    value: float
    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.value:.3f} ({self.low:.3f} to {self.high:.3f})"


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
    agreement : Estimate
        Full over reduced raw stiffness at fixed F̄, geometric mean over the window; both models
        have the same waves.
    kappa : Estimate
        A E* slope / F of eq. 4, by least squares through the origin.
    area_exponent : Estimate
        Exponent of the real area over the force.
    unresolved : float
        Share of the full model's loads in its window with fewer than ten cells in contact.
    left_out : int
        Realisations left out of a fit because a load in its window did not converge.
    """

    fractal_dimension: float
    reduced: PowerLaw
    full: PowerLaw
    reduced_elsewhere: tuple[PowerLaw, ...]
    agreement: Estimate
    kappa: Estimate
    area_exponent: Estimate
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


def saturation(full: xarray.Dataset, k_bar: float = 0.9) -> list[float]:
    """Real area fraction at which the mean stiffness reaches k_bar times the exact punch."""
    fractions = []
    for dimension in full.fractal_dimension.values:
        one = full.sel(fractal_dimension=dimension)
        stiffness = np.nanmean(one.stiffness.values, axis=0) / scaling.EXACT_PUNCH
        area = np.nanmean(one.area_fraction.values, axis=0)
        reached = stiffness[-1] >= k_bar
        fractions.append(float(np.interp(k_bar, stiffness, area)) if reached else float("nan"))
    return fractions


def _summary(
    reduced: xarray.Dataset, full: xarray.Dataset, matched: xarray.Dataset
) -> DimensionSummary:
    stiffness_1d, left_out_1d = usable(reduced, WINDOW_REDUCED)
    stiffness_3d, left_out_3d = usable(full, WINDOW_FULL)
    force_1d, force_3d = reduced.force_bar.values, full.force_bar.values
    in_window = inside_window(force_3d, WINDOW_FULL)
    kappa, area_exponent = _area_law(full)
    return DimensionSummary(
        fractal_dimension=float(full.fractal_dimension),
        reduced=fit_power_law(force_1d, stiffness_1d, WINDOW_REDUCED),
        full=fit_power_law(force_3d, stiffness_3d, WINDOW_FULL),
        reduced_elsewhere=tuple(
            fit_power_law(force_1d, stiffness_1d, window) for window in OTHER_WINDOWS_REDUCED
        ),
        agreement=_agreement(matched, full),
        kappa=kappa,
        area_exponent=area_exponent,
        unresolved=1 - float(full.resolved.values[:, in_window].mean()),
        left_out=left_out_1d + left_out_3d,
    )


def _agreement(matched: xarray.Dataset, full: xarray.Dataset) -> Estimate:
    """Full over reduced stiffness, of surfaces and of lines with the same waves."""
    inside = inside_window(full.force_bar.values, WINDOW_AGREEMENT)
    values_3d, values_1d = (
        usable(data, WINDOW_AGREEMENT)[0][:, inside] for data in (full, matched)
    )
    middle = float(np.log(values_3d.mean(axis=0) / values_1d.mean(axis=0)).mean())
    # the two ensembles are independent: they are resampled apart
    resamples = np.log(
        bootstrap.resampled_means(values_3d, 0) / bootstrap.resampled_means(values_1d, 1)
    )
    low, high = bootstrap.percentile_interval(resamples.mean(axis=1))
    return Estimate(*np.exp([middle, float(low), float(high)]).tolist())


def _area_law(full: xarray.Dataset) -> tuple[Estimate, Estimate]:
    """Kappa and the exponent of the real area over the force."""
    inside = inside_window(full.force_bar.values, WINDOW_AREA)
    force = full.force_bar.values[inside]
    area = full.area_fraction.values[:, inside]
    finite = np.isfinite(area).all(axis=1)
    area, slope = area[finite], full.rms_slope.values[finite]
    kappa = (area * force).sum(axis=1) / (force**2).sum() * slope
    kappa_low, kappa_high = bootstrap.interval(kappa, float)
    log_force = np.log(force) - np.log(force).mean()

    def exponent(mean: Real) -> float:
        return float((np.log(mean) * log_force).sum() / (log_force**2).sum())

    low, high = bootstrap.interval(area, exponent)
    return (
        Estimate(float(kappa.mean()), float(kappa_low), float(kappa_high)),
        Estimate(exponent(area.mean(axis=0)), float(low), float(high)),
    )


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


def inside_window(force_bar: Real, window: Window) -> NDArray[np.bool_]:
    """Return which loads are in a window, its edges included."""
    return (force_bar >= window[0] * (1 - 1e-9)) & (force_bar <= window[1] * (1 + 1e-9))
