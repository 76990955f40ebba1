"""The figures of the page about the paper, drawn to files, with their captions."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from roughline.paper import added_figures, figures
from roughline.plot.style import save, styled
from roughline.report.page import Picture

if TYPE_CHECKING:
    from roughline.paper.results import PaperResults

_OPEN_MARKS = (
    " Bands are the standard error of the mean; dashed or open where, in at least one realisation, "
    "fewer than ten springs or cells are in contact, so that the grid decides. The shaded range "
    "is the window of the fit."
)
_COUNTS = ("no", "one", "two", "three", "four")
_CAPTIONS = {
    "figure_1": (
        "Figure 1",
        "Fractal surfaces of {bodies}: rough line, topography, real contact area "
        "and deflection of the half-space under the force F̄ = {force_bar:g}. Line and surface of "
        "a row are one realisation each, with random phases that all rows share.",
    ),
    "figure_2": (
        "Figure 2",
        "The indented line. Springs under the parts above the level are in contact (black bars); "
        "their total length gives the stiffness, the shaded area the force.",
    ),
    "figure_3": (
        "Figure 3",
        "Dimensionless stiffness over force in the reduced model, mean at fixed force."
        + _OPEN_MARKS,
    ),
    "figure_4": (
        "Figure 4",
        "Dimensionless stiffness over force in the full model, mean at fixed force, normalised "
        "by the paper's 1.1419." + _OPEN_MARKS,
    ),
    "figure_5": (
        "Figure 5",
        "Exponent α over fractal dimension with 95 % intervals from resampled realisations, and "
        "the two predictions. The windows of the two models differ, as their grids do.",
    ),
    "area_law": (
        "Area law",
        "Left: real contact area over force, corrected for the steps of its outline, dashed where "
        "fewer than ten cells touch. Right: κ of eq. 4 with 95 % intervals, of the corrected "
        "area and of the cells in contact; all loads of the shaded window are weighted equally. "
        "The slope is that of the grid (forward differences).",
    ),
    "models_compared": (
        "Both models",
        "Left: raw stiffness k / (E* L); open marks where fewer than ten cells touch. The lines "
        "have the waves of the surfaces and no shorter ones. Right: relative difference of the "
        "means with 95 % intervals. Near saturation the models must differ, by 15.2 % (dotted).",
    ),
    "grid_convergence": (
        "The influence of the grid",
        "One surface for each fractal dimension, computed on several grids: every grid carries all "
        "waves down to its own spacing, so a finer one shows more roughness as well as less error. "
        "Heights are scaled to rms 1 on each grid.",
    ),
}


def draw_pictures(results: PaperResults, folder: Path) -> list[Picture]:
    """Draw every figure that the results allow, and write it to a folder as PNG and PDF."""
    folder.mkdir(parents=True, exist_ok=True)
    told: dict[str, object] = {}
    if (gallery := results.gallery) is not None:
        count = gallery.sizes["fractal_dimension"]
        told["force_bar"] = gallery.attrs["force_bar"]
        told["bodies"] = f"{_COUNTS[count]} fractal dimension{'s' if count > 1 else ''}"
    pictures = []
    with styled():
        for file_name, draw in _drawings(results).items():
            png, _ = save(draw(), folder, file_name)
            name, caption = _CAPTIONS[file_name]
            pictures.append(Picture(png, name, caption.format(**told)))
    return pictures


def _drawings(results: PaperResults) -> dict[str, Callable[[], Figure]]:
    """How each figure is drawn, by the name of its file and in the order of the page."""
    reduced, full, gallery, laws = results.reduced, results.full, results.gallery, results.laws
    windows = results.windows
    dimensions = full.fractal_dimension.values
    drawings: dict[str, Callable[[], Figure]] = {}
    if gallery is not None:
        drawings["figure_1"] = lambda: figures.figure_1(gallery)
        drawings["figure_2"] = lambda: figures.figure_2(gallery)
    drawings["figure_3"] = lambda: figures.figure_3(reduced, dimensions, windows.reduced)
    drawings["figure_4"] = lambda: figures.figure_4(full, windows.full)
    drawings["figure_5"] = lambda: figures.figure_5(results.exponents, laws, windows.full)
    drawings["area_law"] = lambda: added_figures.area_law_figure(full, laws)
    matched = results.matched
    if matched is not None and np.isin(dimensions, matched.fractal_dimension).any():
        drawings["models_compared"] = lambda: added_figures.both_models_figure(full, matched)
    if results.grids:
        grids = results.grids | {int(full.attrs["n"]): full}
        drawings["grid_convergence"] = lambda: added_figures.grid_convergence_figure(grids)
    return drawings
