"""The section of the page on how much the exponent depends on the window and the averaging."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.paper.averaging import exponent_of_means
from roughline.paper.laws import at_dimension, dimension_law, exponent_estimate, is_fitted
from roughline.paper.tables import estimate_cell, number_cell
from roughline.plot.style import dimension_label
from roughline.report.page import Section, Table
from roughline.statistics.bootstrap import NO_ESTIMATE
from roughline.statistics.power_law import PowerLaw, fit_power_law
from roughline.statistics.window import find_window

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Real
    from roughline.paper.results import PaperResults
    from roughline.paper.windows import ForceWindow
    from roughline.statistics.bootstrap import IntervalEstimate


@dataclass(frozen=True)
class _Sensitivity:
    """The exponent of one ensemble and fractal dimension, fitted in several ways."""

    fractal_dimension: float  # D_f
    # for each window the law of the arithmetic mean of the stiffness at fixed force, that of the
    # geometric mean, and the exponent of mean stiffness over mean force, both at fixed level
    fits: list[tuple[PowerLaw, PowerLaw, IntervalEstimate]]
    # law of the arithmetic mean in the longest window in which a power law is not rejected
    automatic: PowerLaw | None
    # loads that the automatic window leaves out, because a realisation did not converge or has
    # fewer than ten springs or cells in contact
    unresolved: int


def sensitivity_section(results: PaperResults) -> Section:
    """Return the exponents of both models in several windows, averaged in several ways."""
    ensembles = {
        "1D": (results.reduced, results.windows.all_reduced),
        "3D": (results.full, results.windows.all_full),
    }
    found = {
        model: [
            _fitted(one, windows)
            for dimension in results.full.fractal_dimension.values
            if (one := at_dimension(data, float(dimension))) is not None
        ]
        for model, (data, windows) in ensembles.items()
    }
    return Section(
        "How much α depends on the window and on the averaging",
        behind="three windows, three averages, and the longest window of a power law",
        paragraphs=[
            "Exponents by least squares of the logarithms: of the arithmetic mean of k at "
            "fixed force, of its geometric mean, and of the means of k and of F at fixed "
            "level of the rigid plane, where the highest realisations dominate. The automatic "
            "window is the longest in which a power law is not rejected: neither a parabola "
            "nor a cubic improves on it beyond the scatter of resampled realisations; loads "
            "with fewer than ten springs or cells in some realisation are not in it."
        ],
        tables=[
            *(_table(model, rows) for model, rows in found.items() if rows),
            _automatic_windows_table(found),
        ],
    )


def _fitted(data: xarray.Dataset, windows: tuple[ForceWindow, ...]) -> _Sensitivity:
    """Fit one fractal dimension of an ensemble in several ways."""
    force = data.force_bar.values
    usable = (np.isfinite(data.stiffness.values) & (data.resolved.values == 1)).all(axis=0)
    stiffness = data.stiffness.values[:, usable]
    automatic = find_window(force[usable], stiffness) if _is_enough(stiffness) else None
    return _Sensitivity(
        fractal_dimension=float(data.fractal_dimension),
        fits=[
            (
                dimension_law(data, window),
                dimension_law(data, window, "geometric"),
                _at_level(data, window),
            )
            for window in windows
        ],
        automatic=fit_power_law(force[usable], stiffness, automatic) if automatic else None,
        unresolved=int(np.count_nonzero(~usable)),
    )


def _at_level(data: xarray.Dataset, window: ForceWindow) -> IntervalEstimate:
    """Exponent between means at fixed level."""
    if not is_fitted(data, window):
        return NO_ESTIMATE
    return exponent_of_means(data, window, "level", "arithmetic")


def _is_enough(stiffness: Real) -> bool:
    """Whether two realisations and five loads are there, as the search for a window needs."""
    return stiffness.shape[0] >= 2 and stiffness.shape[1] >= 5


def _table(model: str, rows: list[_Sensitivity]) -> Table:
    """Return the exponents of one model by window and averaging."""
    header = ["D_f"]
    for law, _, _ in rows[0].fits:
        header += [f"α {model}, {law.window[0]:g} to {law.window[1]:g}", "geometric", "fixed level"]
    cells = []
    for row in rows:
        found = [dimension_label(row.fractal_dimension)]
        for arithmetic, geometric, level in row.fits:
            found += [estimate_cell(exponent_estimate(arithmetic))]
            found += [number_cell(geometric.exponent), estimate_cell(level)]
        cells.append(found)
    return Table(header, cells, numbers=range(len(header)))


def _automatic_windows_table(rows: dict[str, list[_Sensitivity]]) -> Table:
    """Return the longest windows in which a power law is not rejected, by model."""
    header = ["D_f"]
    for model in rows:
        header += [f"window {model}", "α there", "loads left out"]
    cells = []
    every = {each.fractal_dimension for of_model in rows.values() for each in of_model}
    for dimension in sorted(every):
        found: list[str] = []
        for of_model in rows.values():
            one = [each for each in of_model if np.isclose(each.fractal_dimension, dimension)]
            found += [*_automatic_cells(one[0].automatic), str(one[0].unresolved)] if one else "---"
        cells.append([dimension_label(dimension), *found])
    return Table(header, cells, numbers=range(len(header)))


def _automatic_cells(law: PowerLaw | None) -> list[str]:
    if law is None:
        return ["none", "-"]
    low, high = law.window
    return [f"{low:.2g} to {high:.2g}", estimate_cell(exponent_estimate(law))]
