"""The paper recomputed: figures, data and one page, from the results of a study."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from roughline._version import __version__
from roughline.campaign.progress import EnsembleProgress
from roughline.campaign.run import run
from roughline.campaign.store import Store
from roughline.errors import StoreError
from roughline.paper import comparisons, figures
from roughline.paper.claim import Claim
from roughline.paper.claims import claims_section, judge
from roughline.paper.contact_area import WINDOW_AREA
from roughline.paper.exponents import (
    WINDOW_FULL,
    WINDOW_REDUCED,
    DimensionSummary,
    Window,
    exponents_of,
    summarise,
)
from roughline.paper.plan import LINES, MATCHED, SURFACES, Scale, paper_plan
from roughline.paper.results import ROW_1D, ROW_3D, ROW_MATCHED, PaperResults, row_of
from roughline.paper.sensitivity import (
    WINDOWS_FULL,
    WINDOWS_REDUCED,
    Sensitivity,
    sensitivity,
)
from roughline.paper.tables import (
    constant_table,
    exponent_table,
    paper_grid_table,
    sensitivity_table,
    write_data,
)
from roughline.report.page import Picture, Section, Table, render
from roughline.report.style import save, styled

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
        "Left: real contact area over force, corrected for the steps of its outline, dashed where "
        "fewer than ten cells touch. Right: κ of eq. 4, every load of the shaded window alike, "
        "with 95 % intervals, of the corrected area and of the cells in contact. The slope is "
        "that of the grid (forward differences).",
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


def recompute(
    scale: Scale,
    out: Path,
    seed: int,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: EnsembleProgress | None = None,
    announce: Callable[[str], None] | None = None,
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
    workers, scheduler, progress, announce
        As for :func:`roughline.campaign.run`.

    Returns
    -------
    Path
        The page.

    Raises
    ------
    StoreError
        If the folder cannot be written, or holds another study.
    ClusterError
        If the cluster cannot be used.
    """
    plan = paper_plan(scale, seed)
    place = out / "results.zarr"
    run(plan, place, workers=workers, scheduler=scheduler, progress=progress, announce=announce)
    store = Store(place)
    results = PaperResults(
        name=f"at the {scale} scale",
        command=f"roughline paper --scale {scale} --seed {seed}",
        reduced=store.dataset(LINES),
        full=store.dataset(SURFACES),
        matched=store.dataset(MATCHED),
        exponents=exponents_of(store.dataset(LINES), WINDOWS_REDUCED),
        gallery=store.gallery(),
    )
    try:
        return write_report(results, out)
    except OSError as error:
        raise StoreError(
            f"cannot write the report to {out} ({error}); the results are kept"
        ) from error


def write_report(results: PaperResults, out: Path) -> Path:
    """Write figures, data and ``report.html`` of a finished study.

    Parameters
    ----------
    results : PaperResults
        The study.
    out : Path
        Folder for everything; made if it does not exist.

    Returns
    -------
    Path
        The page.
    """
    title, lead, sections = compose(results, out)
    page = out / "report.html"
    page.write_text(render(title, lead, sections), encoding="utf-8")
    return page


def compose(results: PaperResults, out: Path) -> tuple[str, str, list[Section]]:
    """Draw the figures and write the data of a study; title, lead and sections of its page."""
    summaries = summarise(results)
    claims = judge(summaries, results)
    pictures = _draw(results, summaries, out / "figures")
    write_data(out / "data", results, summaries, claims)
    lead = (
        f"Normal contact of fractal rough surfaces in two models, recomputed with roughline "
        f"{__version__} {results.name}."
    )
    title = "The paper, recomputed: reduction method and 3D boundary elements"
    return title, lead, _sections(results, summaries, claims, pictures)


def _draw(results: PaperResults, summaries: list[DimensionSummary], folder: Path) -> list[Picture]:
    reduced, full, gallery = results.reduced, results.full, results.gallery
    drawings: dict[str, Callable[[], Figure]] = {}
    if gallery is not None:
        drawings["figure_1"] = lambda: figures.figure_1(gallery)
        drawings["figure_2"] = lambda: figures.figure_2(gallery)
    drawings |= {
        "figure_3": lambda: figures.figure_3(reduced, full.fractal_dimension.values),
        "figure_4": lambda: figures.figure_4(full),
        "figure_5": lambda: figures.figure_5(results.exponents, summaries),
        "area_law": lambda: comparisons.area_law(full, summaries),
        "models_compared": lambda: comparisons.models_compared(results.matched, full),
    }
    if results.grids:
        drawings["grid_convergence"] = lambda: comparisons.grid_convergence(results.grids)
    folder.mkdir(parents=True, exist_ok=True)
    force_bar = gallery.attrs["force_bar"] if gallery is not None else 0.0
    pictures = []
    with styled():
        for file_name, draw in drawings.items():
            png, _ = save(draw(), folder, file_name)
            name, caption = _CAPTIONS[file_name]
            pictures.append(Picture(png, name, caption.format(force_bar=force_bar)))
    return pictures


def _sections(
    results: PaperResults,
    summaries: list[DimensionSummary],
    claims: list[Claim],
    pictures: list[Picture],
) -> list[Section]:
    reduced, full = results.reduced, results.full
    return [
        claims_section(claims),
        Section(
            "Exponents and constants",
            [
                f"k̄ = ζ F̄^α with raw k̄ = k / (E* L); windows F̄ = {WINDOW_REDUCED[0]:g} to "
                f"{WINDOW_REDUCED[1]:g} (1D) and {WINDOW_FULL[0]:g} to {WINDOW_FULL[1]:g} (3D). "
                "Every load of a window counts alike: exponents and prefactors are least squares "
                "of logarithms, ratios and κ geometric means over the loads.",
                f"κ = A E* ∇h / F of eq. 4 from F̄ = {WINDOW_AREA[0]:.3g} to {WINDOW_AREA[1]:.3g}, "
                "with the slope of the grid and two areas: counted in cells, and corrected for "
                "the steps of its outline. In cells κ rises with D_f as the outline gets longer, "
                "which is the grid's doing. κ is no constant: it falls with the load, so that "
                "its value depends on how loads are weighted (the last column).",
                _completeness(reduced, full, summaries),
            ],
            tables=[exponent_table(summaries), constant_table(summaries)],
        ),
        Section(
            "How much α depends on the window and on the averaging",
            [
                "Exponents by least squares of the logarithms: of the arithmetic mean of k at "
                "fixed force, of its geometric mean, and of the means of k and of F at fixed "
                "level of the rigid plane, where the highest realisations dominate. The automatic "
                "window is the longest in which a power law is not rejected: neither a parabola "
                "nor a cubic improves on it beyond the scatter of resampled realisations; loads "
                "with fewer than ten springs or cells in some realisation are not in it."
            ],
            tables=[
                sensitivity_table("1D", _by_dimension(reduced, full, WINDOWS_REDUCED)),
                sensitivity_table("3D", _by_dimension(full, full, WINDOWS_FULL)),
            ],
        ),
        *_grid_sections(results),
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
            tables=[_settings_table(results)],
            note=(
                f"To repeat: {results.command} (version {__version__}). "
                "The numbers behind every figure are in the folder data, as NetCDF and CSV."
            ),
        ),
    ]


def _grid_sections(results: PaperResults) -> list[Section]:
    if results.paper_grid is None:
        return []
    return [
        Section(
            "The paper's grid",
            [
                "The same surfaces (same phases, more detail) on the grid of the ensemble and on "
                "the paper's. Mean, least and greatest of the ratio; α of their mean in the window "
                "of the full model."
            ],
            tables=[paper_grid_table(results.full, results.paper_grid)],
        )
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


def _by_dimension(
    data: xarray.Dataset, full: xarray.Dataset, windows: tuple[Window, ...]
) -> list[Sensitivity]:
    return [
        sensitivity(data.sel(fractal_dimension=dimension), windows)
        for dimension in full.fractal_dimension.values
    ]


def _settings_table(results: PaperResults) -> Table:
    named = [
        (ROW_1D, results.reduced),
        (ROW_MATCHED, results.matched),
        (ROW_3D, results.full),
        *((row_of(n), data) for n, data in sorted(results.grids.items())),
    ]
    rows = []
    for name, data in named:
        # the exponents may be of more lines than are kept
        dimensions = (results.exponents if name == ROW_1D else data).fractal_dimension.values
        n, forces = data.attrs["n"], data.force_bar.values
        each = results.core_seconds.get(name)
        rows.append(
            (
                name,
                f"{dimensions.size}, from {dimensions[0]:g} to {dimensions[-1]:g}",
                f"{data.sizes['realisation']}",
                f"{n}" if data.attrs["model"] == "reduced" else f"{n} × {n}",
                f"{forces.size}, F̄ = {forces[0]:g} to {forces[-1]:g}",
                f"SeedSequence({data.attrs['seed']}, spawn_key=(i,))",
                *([f"{each:.3g} s"] if each else ["-"] if results.core_seconds else []),
            )
        )
    header = ("Model", "Fractal dimensions", "Realisations each", "Points", "Loads", "Seed of i")
    return Table((*header, "One body, one core, at most") if results.core_seconds else header, rows)
