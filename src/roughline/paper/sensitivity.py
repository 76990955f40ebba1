"""How much the exponent depends on the window of loads and on the averaging."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.paper.averaging import exponent_of_means
from roughline.paper.exponents import at_dimension, is_fitted, law_of
from roughline.statistics.bootstrap import NO_ESTIMATE
from roughline.statistics.power_law import PowerLaw, fit_power_law
from roughline.statistics.window import find_window

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Real
    from roughline.paper.windows import Window
    from roughline.statistics.bootstrap import IntervalEstimate


@dataclass(frozen=True)
class Sensitivity:
    """The exponent of one ensemble and fractal dimension, fitted in several ways.

    Attributes
    ----------
    fractal_dimension : float
        D_f.
    fits : list of tuple
        For each window the law of the arithmetic mean of the stiffness at fixed force, that of the
        geometric mean, and the exponent of mean stiffness over mean force, both at fixed level.
    automatic : PowerLaw or None
        Law of the arithmetic mean in the longest window in which a power law is not rejected.
    unresolved : int
        Loads that the automatic window leaves out, because a realisation did not converge or
        has fewer than ten springs or cells in contact.
    """

    fractal_dimension: float
    fits: list[tuple[PowerLaw, PowerLaw, IntervalEstimate]]
    automatic: PowerLaw | None
    unresolved: int


def sensitivity(data: xarray.Dataset, windows: tuple[Window, ...]) -> Sensitivity:
    """Fit one fractal dimension of an ensemble in several ways."""
    force = data.force_bar.values
    usable = (np.isfinite(data.stiffness.values) & (data.resolved.values == 1)).all(axis=0)
    stiffness = data.stiffness.values[:, usable]
    automatic = find_window(force[usable], stiffness) if _is_enough(stiffness) else None
    return Sensitivity(
        fractal_dimension=float(data.fractal_dimension),
        fits=[
            (law_of(data, window), law_of(data, window, "geometric"), _at_level(data, window))
            for window in windows
        ],
        automatic=fit_power_law(force[usable], stiffness, automatic) if automatic else None,
        unresolved=int(np.count_nonzero(~usable)),
    )


def sensitivities(
    data: xarray.Dataset, dimensions: Real, windows: tuple[Window, ...]
) -> list[Sensitivity]:
    """Fit each of several fractal dimensions that an ensemble has in several ways."""
    found = (at_dimension(data, float(each)) for each in dimensions)
    return [sensitivity(one, windows) for one in found if one is not None]


def _at_level(data: xarray.Dataset, window: Window) -> IntervalEstimate:
    """Exponent between means at fixed level."""
    if not is_fitted(data, window):
        return NO_ESTIMATE
    return exponent_of_means(data, window, "level", "arithmetic")


def _is_enough(stiffness: Real) -> bool:
    """Whether two realisations and five loads are there, as the search for a window needs."""
    return stiffness.shape[0] >= 2 and stiffness.shape[1] >= 5
