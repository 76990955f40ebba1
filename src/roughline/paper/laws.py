"""The laws of stiffness and contact area that the ensembles show, for each fractal dimension."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.paper.contact_area import AreaLaw, area_law, saturation
from roughline.paper.exponents import (
    LocalExponents,
    difference_between_models,
    difference_between_windows,
    law_of,
    left_out,
    local_exponents,
    surfaces_less_lines,
)
from roughline.paper.windows import OTHER_WINDOWS_REDUCED, WINDOW_AGREEMENT
from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    import xarray

    from roughline.paper.windows import Windows
    from roughline.statistics.bootstrap import IntervalEstimate
    from roughline.statistics.power_law import PowerLaw


@dataclass(frozen=True)
class DimensionLaws:
    """The laws of stiffness and contact area for one fractal dimension.

    Attributes
    ----------
    fractal_dimension : float
        D_f.
    reduced, full : PowerLaw
        k̄ over F̄ in the two models' windows; k̄ is raw, k / (E* L). NaN where it is not known.
    reduced_elsewhere : tuple of PowerLaw
        The law of the reduced model in other windows.
    reduced_by_window : IntervalEstimate
        Exponent of the reduced model in its window, less that in the last of the other windows.
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
    reduced_by_window: IntervalEstimate
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
        reduced=law_of(reduced, windows.reduced),
        full=law_of(full, windows.full),
        reduced_elsewhere=tuple(law_of(reduced, window) for window in OTHER_WINDOWS_REDUCED),
        reduced_by_window=difference_between_windows(
            reduced, windows.reduced, OTHER_WINDOWS_REDUCED[-1]
        ),
        reduced_local=local_exponents(reduced, windows.reduced),
        full_local=local_exponents(full, windows.full),
        models_apart=difference_between_models(full, matched, windows.full),
        agreement=_stiffness_ratio(full, matched),
        cells=area_law(full, "area_fraction"),
        corrected=area_law(full, "area_fraction_corrected"),
        saturation=saturation(full),
        unresolved=1 - float(flags.mean()) if flags.size else np.nan,
        left_out=left_out(reduced, windows.reduced) + left_out(full, windows.full),
    )


def _stiffness_ratio(full: xarray.Dataset, matched: xarray.Dataset | None) -> IntervalEstimate:
    """Stiffness of surfaces over that of lines with the same waves, geometric mean over loads."""
    inside = inside_window(full.force_bar.values, WINDOW_AGREEMENT)
    weights = inside / max(int(np.count_nonzero(inside)), 1)
    return surfaces_less_lines(full, matched, WINDOW_AGREEMENT, weights).exp()
