"""The laws of stiffness and contact area that the ensembles show, for each fractal dimension."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.paper.contact_area import AreaLaw, area_law, saturation
from roughline.paper.exponents import (
    LocalExponents,
    converged_stiffness,
    difference_between_models,
    difference_between_windows,
    local_exponents,
    surfaces_less_lines,
)
from roughline.paper.windows import (
    OTHER_WINDOWS_REDUCED,
    WINDOW_AGREEMENT,
    WINDOW_FULL,
    WINDOW_REDUCED,
)
from roughline.statistics.power_law import PowerLaw, fit_power_law
from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    import xarray

    from roughline.statistics.bootstrap import IntervalEstimate


@dataclass(frozen=True)
class DimensionLaws:
    """The laws of stiffness and contact area for one fractal dimension.

    Attributes
    ----------
    fractal_dimension : float
        D_f.
    reduced, full : PowerLaw
        k̄ over F̄ in the two models' windows; k̄ is raw, k / (E* L).
    reduced_elsewhere : tuple of PowerLaw
        The law of the reduced model in other windows.
    reduced_by_window : tuple of IntervalEstimate
        Exponent of the reduced model in its window, less that in each of the other windows.
    reduced_local, full_local : LocalExponents
        How far the exponent of each model changes from the lowest loads to medium ones.
    models_apart : IntervalEstimate
        Exponent of the full model less that of the reduced one, with the same waves and window.
    agreement : IntervalEstimate
        Raw stiffness of the full model over that of the reduced one at fixed F̄, geometric mean
        over the window; both models have the same waves.
    cells, corrected : AreaLaw
        The law of the area counted in cells, and of the area corrected for its perimeter.
    saturation : IntervalEstimate
        Real area fraction, in cells, at which the mean stiffness is 90 % of the punch's.
    unresolved : float
        Share of the full model's loads in its window with fewer than ten cells in contact.
    left_out : int
        Realisations left out of a fit because a load in its window did not converge.
    """

    fractal_dimension: float
    reduced: PowerLaw
    full: PowerLaw
    reduced_elsewhere: tuple[PowerLaw, ...]
    reduced_by_window: tuple[IntervalEstimate, ...]
    reduced_local: LocalExponents
    full_local: LocalExponents
    models_apart: IntervalEstimate
    agreement: IntervalEstimate
    cells: AreaLaw
    corrected: AreaLaw
    saturation: IntervalEstimate
    unresolved: float
    left_out: int


def dimension_laws(
    reduced: xarray.Dataset, full: xarray.Dataset, matched: xarray.Dataset
) -> DimensionLaws:
    """Evaluate the three ensembles of one fractal dimension.

    Parameters
    ----------
    reduced, full, matched : Dataset
        Lines, surfaces, and lines with the waves of the surfaces, of this fractal dimension.
    """
    stiffness_1d, left_out_1d = converged_stiffness(reduced, WINDOW_REDUCED)
    stiffness_3d, left_out_3d = converged_stiffness(full, WINDOW_FULL)
    force_1d, force_3d = reduced.force_bar.values, full.force_bar.values
    in_window = inside_window(force_3d, WINDOW_FULL)
    return DimensionLaws(
        fractal_dimension=float(full.fractal_dimension),
        reduced=fit_power_law(force_1d, stiffness_1d, WINDOW_REDUCED),
        full=fit_power_law(force_3d, stiffness_3d, WINDOW_FULL),
        reduced_elsewhere=tuple(
            fit_power_law(force_1d, stiffness_1d, window) for window in OTHER_WINDOWS_REDUCED
        ),
        reduced_by_window=tuple(
            difference_between_windows(reduced, WINDOW_REDUCED, window)
            for window in OTHER_WINDOWS_REDUCED
        ),
        reduced_local=local_exponents(reduced, WINDOW_REDUCED),
        full_local=local_exponents(full, WINDOW_FULL),
        models_apart=difference_between_models(full, matched),
        agreement=_stiffness_ratio(full, matched),
        cells=area_law(full, "area_fraction"),
        corrected=area_law(full, "area_fraction_corrected"),
        saturation=saturation(full),
        unresolved=1 - float(full.resolved.values[:, in_window].mean()),
        left_out=left_out_1d + left_out_3d,
    )


def _stiffness_ratio(full: xarray.Dataset, matched: xarray.Dataset) -> IntervalEstimate:
    """Stiffness of surfaces over that of lines with the same waves, geometric mean over loads."""
    inside = inside_window(full.force_bar.values, WINDOW_AGREEMENT)
    weights = inside / np.count_nonzero(inside)
    return surfaces_less_lines(full, matched, WINDOW_AGREEMENT, weights).exp()
