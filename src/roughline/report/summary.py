"""What the ensembles say for each fractal dimension: exponents, constants, intervals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from roughline import bootstrap, scaling
from roughline.errors import InputError
from roughline.power_law import PowerLaw, fit_power_law

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
        Full over reduced raw stiffness at fixed F̄, geometric mean over the window.
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


def summarise(reduced: xarray.Dataset, full: xarray.Dataset) -> list[DimensionSummary]:
    """Evaluate both ensembles for each fractal dimension that both have."""
    return [
        _summary(reduced.sel(fractal_dimension=dimension), full.sel(fractal_dimension=dimension))
        for dimension in full.fractal_dimension.values
    ]


def exponents(data: xarray.Dataset, window: Window) -> list[PowerLaw]:
    """Fit the power law for every fractal dimension of an ensemble."""
    laws = []
    for dimension in data.fractal_dimension.values:
        one = data.sel(fractal_dimension=dimension)
        laws.append(fit_power_law(one.force_bar.values, _usable(one, window)[0], window))
    return laws


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


def _summary(reduced: xarray.Dataset, full: xarray.Dataset) -> DimensionSummary:
    stiffness_1d, left_out_1d = _usable(reduced, WINDOW_REDUCED)
    stiffness_3d, left_out_3d = _usable(full, WINDOW_FULL)
    force_1d, force_3d = reduced.force_bar.values, full.force_bar.values
    in_window = _inside(force_3d, WINDOW_FULL)
    kappa, area_exponent = _area_law(full)
    return DimensionSummary(
        fractal_dimension=float(full.fractal_dimension),
        reduced=fit_power_law(force_1d, stiffness_1d, WINDOW_REDUCED),
        full=fit_power_law(force_3d, stiffness_3d, WINDOW_FULL),
        reduced_elsewhere=tuple(
            fit_power_law(force_1d, stiffness_1d, window) for window in OTHER_WINDOWS_REDUCED
        ),
        agreement=_agreement(reduced, full),
        kappa=kappa,
        area_exponent=area_exponent,
        unresolved=1 - float(full.resolved.values[:, in_window].mean()),
        left_out=left_out_1d + left_out_3d,
    )


def _agreement(reduced: xarray.Dataset, full: xarray.Dataset) -> Estimate:
    """Full over reduced stiffness; the reduced mean curve is read between its dense loads."""
    inside = _inside(full.force_bar.values, WINDOW_AGREEMENT)
    log_force = np.log(full.force_bar.values[inside])
    mean_1d = _usable(reduced, WINDOW_AGREEMENT)[0].mean(axis=0)
    log_1d = np.interp(log_force, np.log(reduced.force_bar.values), np.log(mean_1d))
    values_3d = _usable(full, WINDOW_AGREEMENT)[0][:, inside]
    log_ratio = np.log(values_3d.mean(axis=0)) - log_1d
    # the two ensembles are independent: their half-widths add in quadrature
    ends_3d = bootstrap.interval(values_3d, lambda mean: float(np.log(mean).mean()))
    inside_1d = _inside(reduced.force_bar.values, WINDOW_AGREEMENT)
    values_1d = _usable(reduced, WINDOW_AGREEMENT)[0][:, inside_1d]
    ends_1d = bootstrap.interval(values_1d, lambda mean: float(np.log(mean).mean()))
    half_width = float(np.hypot(np.ptp(ends_3d), np.ptp(ends_1d))) / 2
    middle = float(log_ratio.mean())
    return Estimate(*np.exp([middle, middle - half_width, middle + half_width]).tolist())


def _area_law(full: xarray.Dataset) -> tuple[Estimate, Estimate]:
    """Kappa and the exponent of the real area over the force."""
    inside = _inside(full.force_bar.values, WINDOW_AREA)
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


def _usable(data: xarray.Dataset, window: Window) -> tuple[Real, int]:
    """Raw stiffness of the realisations that converged throughout a window; how many did not."""
    stiffness = data.stiffness.values
    usable = np.isfinite(stiffness[:, _inside(data.force_bar.values, window)]).all(axis=1)
    if not usable.any():
        raise InputError(
            f"no realisation of D_f = {float(data.fractal_dimension):g} converged throughout "
            f"F̄ = {window[0]:g} to {window[1]:g}: nothing to fit"
        )
    return stiffness[usable], int(np.count_nonzero(~usable))


def _inside(force_bar: Real, window: Window) -> NDArray[np.bool_]:
    return (force_bar >= window[0] * (1 - 1e-9)) & (force_bar <= window[1] * (1 + 1e-9))
