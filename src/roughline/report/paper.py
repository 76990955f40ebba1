"""The paper recomputed: figures, data and one page, from the store of a study."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from roughline._version import __version__
from roughline.campaign.plan import Plan, Scale, paper_plan
from roughline.campaign.run import Progress, run
from roughline.campaign.store import Store
from roughline.errors import StoreError
from roughline.report import comparisons, figures
from roughline.report.claims import Claim, judge
from roughline.report.page import Picture, Section, Table, render
from roughline.report.style import save, styled
from roughline.report.summary import (
    WINDOW_AREA,
    WINDOW_FULL,
    WINDOW_REDUCED,
    DimensionSummary,
    exponents,
    summarise,
)
from roughline.report.tables import constant_table, exponent_table, write_data

if TYPE_CHECKING:
    import xarray

_OPEN_MARKS = (
    " Bands are the standard error of the mean; dashed or open where, in at least one realisation, "
    "fewer than ten springs or cells are in contact, so that the grid shows. The shaded range is "
    "the window of the fit."
)
_CAPTIONS = {
    "figure_1": (
        "Figure 1",
        "Fractal surfaces of four fractal dimensions: rough line, topography, real contact area "
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
        "Left: real contact area over force, dashed where fewer than ten cells touch. Right: κ of "
        "eq. 4 with 95 % intervals. The roughness reaches down to the grid, so κ takes both the "
        "slope (forward differences) and the area (cells in contact) of the grid: towards D_f = 3 "
        "it measures the grid as much as the surface.",
    ),
    "models_compared": (
        "Both models",
        "Left: raw stiffness k / (E* L); open marks where fewer than ten cells touch. Right: their "
        "ratio with the standard error of the 3D mean. Near saturation the models must differ, by "
        "the factor 1.1523 (dotted).",
    ),
}


def recompute(
    scale: Scale, out: Path, seed: int, workers: int | None = None, progress: Progress | None = None
) -> Path:
    """Run the paper's study, or what is left of it, and write its report.

    Parameters
    ----------
    scale : {"quick", "full"}
        Minutes, or the paper's sizes.
    out : Path
        Folder for results and report. One that holds part of the same study is gone on with.
    seed : int
        Root of all seeds.
    workers : int, optional
        Processes; default: one for each core.
    progress : callable, optional
        Called with (stage, batches done, batches in all).

    Returns
    -------
    Path
        The page.

    Raises
    ------
    StoreError
        If the folder cannot be written, or holds another study.
    """
    plan = paper_plan(scale, seed)
    store = Store(out / "results.zarr", plan)
    run(plan, store, workers, progress)
    try:
        return write_report(plan, store, out)
    except OSError as error:
        raise StoreError(
            f"cannot write the report to {out} ({error}); the results are kept"
        ) from error


def write_report(plan: Plan, store: Store, out: Path) -> Path:
    """Write figures, data and ``report.html`` of a finished study.

    Parameters
    ----------
    plan : Plan
        The study.
    store : Store
        Its results, complete.
    out : Path
        Folder for everything; made if it does not exist.

    Returns
    -------
    Path
        The page.
    """
    reduced, full, gallery = store.dataset(plan.reduced), store.dataset(plan.full), store.gallery()
    summaries = summarise(reduced, full)
    claims = judge(summaries, reduced, full)
    laws_1d = exponents(reduced, WINDOW_REDUCED)
    dimensions = full.fractal_dimension.values
    drawings: dict[str, Callable[[], Figure]] = {
        "figure_1": lambda: figures.figure_1(gallery),
        "figure_2": lambda: figures.figure_2(gallery),
        "figure_3": lambda: figures.figure_3(reduced, dimensions),
        "figure_4": lambda: figures.figure_4(full),
        "figure_5": lambda: figures.figure_5(laws_1d, reduced.fractal_dimension.values, summaries),
        "area_law": lambda: comparisons.area_law(full, summaries),
        "models_compared": lambda: comparisons.models_compared(reduced, full),
    }
    (out / "figures").mkdir(parents=True, exist_ok=True)
    pictures = []
    with styled():
        for file_name, draw in drawings.items():
            png, _ = save(draw(), out / "figures", file_name)
            name, caption = _CAPTIONS[file_name]
            pictures.append(Picture(png, name, caption.format(force_bar=plan.gallery.force_bar)))
    write_data(out / "data", reduced, full, gallery, summaries, claims)
    page = out / "report.html"
    sections = _sections(plan, reduced, full, summaries, claims, pictures)
    lead = (
        f"Normal contact of fractal rough surfaces in two models, recomputed with roughline "
        f"{__version__} at the {plan.scale} scale."
    )
    page.write_text(
        render("The paper, recomputed: reduction method and 3D boundary elements", lead, sections),
        encoding="utf-8",
    )
    return page


def _sections(
    plan: Plan,
    reduced: xarray.Dataset,
    full: xarray.Dataset,
    summaries: list[DimensionSummary],
    claims: list[Claim],
    pictures: list[Picture],
) -> list[Section]:
    return [
        Section(
            "The paper's claims",
            tables=[
                Table(
                    ("The paper says", "Found here", "95 % interval", "Window", "Verdict"),
                    [(c.statement, c.found, c.interval, c.window, c.verdict) for c in claims],
                    verdict=4,
                )
            ],
            note=(
                "An exponent counts as confirmed within 0.05, a stiffness within 10 %. Every α "
                "depends on its window and on the averaging (here: arithmetic mean of k at fixed "
                "F̄), which is why both stand beside it. Brackets are 95 % intervals from "
                "resampled realisations."
            ),
        ),
        Section(
            "Exponents and constants",
            [
                f"k̄ = ζ F̄^α with raw k̄ = k / (E* L); windows F̄ = {WINDOW_REDUCED[0]:g} to "
                f"{WINDOW_REDUCED[1]:g} (1D) and {WINDOW_FULL[0]:g} to {WINDOW_FULL[1]:g} (3D). "
                f"κ of eq. 4 from F̄ = {WINDOW_AREA[0]:.3g} to {WINDOW_AREA[1]:.3g}.",
                _completeness(reduced, full, summaries),
            ],
            tables=[exponent_table(summaries), constant_table(summaries)],
        ),
        Section("Figures", pictures=pictures),
        Section(
            "What was computed, and how",
            [
                "Surfaces are rigid punches, a square with free borders pressed into an elastic "
                "half-space; they are solved with every interaction, the stiffness is the exact "
                "tangent dF/dd, and all residuals are certified below 1e-6. Lines lie on "
                "independent springs and are solved exactly. Spectra fall as q^(-2(H+1)) from "
                "2π/L to the grid (no roll-off), C_1D = π q C_2D; phases are random, moduli fixed; "
                "heights are scaled to rms 1 in both models.",
            ],
            tables=[_settings_table(plan)],
            note=(
                f"To repeat: roughline paper --scale {plan.scale} (version {__version__}). "
                "The numbers behind every figure are in the folder data, as NetCDF and CSV."
            ),
        ),
    ]


def _completeness(
    reduced: xarray.Dataset, full: xarray.Dataset, summaries: list[DimensionSummary]
) -> str:
    failed = int((full.status != 0).sum()) + int((reduced.status != 0).sum())
    left_out = sum(s.left_out for s in summaries)
    if not failed:
        return "Every load of every realisation converged; none was left out."
    return (
        f"{failed} loads did not converge: they are missing from the means, and {left_out} "
        "realisations with such a load inside a window were left out of its fit."
    )


def _settings_table(plan: Plan) -> Table:
    rows = []
    for name, ensemble in (("reduced, 1D", plan.reduced), ("full, 3D", plan.full)):
        points = f"{ensemble.n}" if ensemble.model == "reduced" else f"{ensemble.n} × {ensemble.n}"
        dimensions = ensemble.fractal_dimensions
        rows.append(
            (
                name,
                f"{len(dimensions)}, from {dimensions[0]:g} to {dimensions[-1]:g}",
                f"{ensemble.realisations}",
                points,
                f"{len(ensemble.force_bars)}, F̄ = {ensemble.force_bars[0]:g} to "
                f"{ensemble.force_bars[-1]:g}",
                f"SeedSequence({ensemble.seed}, spawn_key=(i,))",
            )
        )
    header = ("Model", "Fractal dimensions", "Realisations each", "Points", "Loads", "Seed of i")
    return Table(header, rows)
