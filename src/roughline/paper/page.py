"""The page "The paper, recomputed": what it says, section by section."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughline.campaign.export import mean_table, write_netcdf
from roughline.paper.added_figures import added_drawings, first_drawings
from roughline.paper.claims import judge_claims
from roughline.paper.claims_section import claims_section
from roughline.paper.figures import draw_bodies, draw_pictures, paper_drawings
from roughline.paper.findings import findings, lone_bodies
from roughline.paper.laws import dimension_law
from roughline.paper.plan import ENSEMBLE_FULL, ENSEMBLE_MATCHED, ENSEMBLE_REDUCED
from roughline.paper.results import larger_study
from roughline.paper.roles import departures
from roughline.paper.sensitivity import sensitivity_section
from roughline.paper.tables import constant_table, estimate_cell, exponent_table, number_cell
from roughline.paper.windows import MEDIUM_FORCE, WINDOW_AREA
from roughline.plot.style import dimension_label
from roughline.report.page import Headline, Section, Table, render
from roughline.statistics.averages import relative_difference
from roughline.statistics.bootstrap import IntervalEstimate

if TYPE_CHECKING:
    import xarray

    from roughline.paper.results import PaperResults
    from roughline.paper.windows import ForceWindow
    from roughline.statistics.verdict import Claim

_BODIES = (
    "Rough line, topography, real contact area (dark: cells, or squares of 1/128 of the side, with "
    "some contact) and deflection of the half-space under F̄ = {:g}. In the paper: the same four of "
    "D_f = 2, 7/3, 8/3 and 3. Its phases are random and not given, so that patches are alike in "
    "kind and not in place; here all bodies share their phases."
)
_OTHER_FIGURES = "the area law, and the influence of the grid"
_COLUMNS = ("statement", "found", "interval", "basis", "verdict", "cases", "allowed")  # of claims
_GRID_FORCES = (0.01, 0.1, 1.0)  # at which surfaces on two grids are compared


@dataclass(frozen=True)
class StudyPage:
    """The page of a study, section by section; its figures and data are written."""

    title: str
    lead: str
    sections: Sequence[Section]
    headline: Headline


def write_page(results: PaperResults, out: Path) -> tuple[Path, Headline]:
    """Write figures, data and ``report.html`` of a study into a folder.

    Returns the file, and with what the page begins.
    """
    found = compose(results, out)
    page = out / "report.html"
    text = render(found.title, found.lead, found.sections, headline=found.headline)
    page.write_text(text, encoding="utf-8")
    return page, found.headline


def compose(results: PaperResults, out: Path) -> StudyPage:
    """Draw the figures and write the data of a study; return its page."""
    claims, more = judge_claims(results), larger_study(results)
    folder = out / "figures"
    first = draw_pictures(first_drawings(results), folder)
    of_paper = draw_pictures(paper_drawings(results), folder)
    bodies = []
    if (gallery := results.gallery) is not None:
        words = [_BODIES.format(gallery.attrs["force_bar"])]
        bodies = [Section("Figure 1: bodies", words, abreast=draw_bodies(gallery, folder))]
    others = draw_pictures(added_drawings(results), folder)
    _write_data(out / "data", results, claims)
    return StudyPage(
        title="The paper, recomputed: reduction method and 3D boundary elements",
        lead=(
            f"Normal contact of fractal rough surfaces in two models, recomputed with roughline "
            f"{results.version} {results.name}. The paper is R. Pohrt and V. L. Popov, Physical "
            "Mesomechanics 15 (2012): Investigation of the dry normal contact between fractal "
            "rough surfaces using the reduction method, comparison to 3D simulations."
        ),
        sections=[
            *bodies,
            Section("Figures 2 to 5, beside the paper's", pictures=of_paper),
            claims_section(claims, judge_claims(more) if more else ()),
            _exponents_section(results),
            sensitivity_section(results),
            *_other_grid_sections(results),
            Section("Other figures", pictures=others, behind=_OTHER_FIGURES),
            _methods_section(results),
        ],
        headline=Headline(findings(results, more), lone_bodies(results), pictures=first),
    )


def _exponents_section(results: PaperResults) -> Section:
    windows = results.windows
    return Section(
        "Exponents and constants",
        behind="α, ζ and κ of each fractal dimension, with their intervals",
        paragraphs=[
            f"k̄ = ζ F̄^α with raw k̄ = k / (E* L); windows F̄ = {windows.reduced[0]:g} to "
            f"{windows.reduced[1]:g} (1D) and {windows.full[0]:g} to {windows.full[1]:g} (3D). "
            "All loads of a window are weighted equally: exponents and prefactors are least "
            "squares of logarithms, ratios and κ are geometric means over the loads.",
            f"κ = A E* ∇h / F of eq. 4 from F̄ = {WINDOW_AREA[0]:.3g} to {WINDOW_AREA[1]:.3g}, "
            "with the slope of the grid and two areas: counted in cells, and corrected for "
            "the steps of its outline. In cells κ rises with D_f as the outline gets longer, "
            "which is an effect of the grid. κ is not constant: it falls with the load, so that "
            "its value depends on how loads are weighted (the last column).",
            _completeness(results),
        ],
        tables=[exponent_table(results.laws), constant_table(results.laws)],
    )


def _completeness(results: PaperResults) -> str:
    """Say how many loads did not converge, and what was left out for that."""
    failed = int((results.full.status != 0).sum()) + int((results.reduced.status != 0).sum())
    left_out = sum(laws.left_out for laws in results.laws)
    if not failed:
        return "Every load of every realisation converged; none was left out."
    return (
        f"{failed} loads did not converge: they are missing from the means, and {left_out} "
        "realisations with such a load inside a window were left out of its fit."
    )


def _other_grid_sections(results: PaperResults) -> list[Section]:
    """Return the section about another grid, if the study has surfaces on one."""
    if results.other_grid is None:
        return []
    return [
        Section(
            "The same surfaces on two grids",
            behind="what a finer grid changes",
            paragraphs=[
                "The phases are the same, and the finer grid has more detail. Ratios of means with "
                "95 % intervals, from resampled pairs; α of the mean in the window of the full "
                "model."
            ],
            tables=[_two_grids_table(results.full, results.other_grid, results.windows.full)],
        )
    ]


def _methods_section(results: PaperResults) -> Section:
    return Section(
        "What was computed, and how",
        behind="bodies, seeds, and how to repeat it",
        paragraphs=[
            "Surfaces are rigid punches, a square with free borders pressed into an elastic "
            "half-space; they are solved with every interaction, the stiffness is the exact "
            "tangent dF/dd, and all residuals are certified below 1e-6. Lines lie on "
            "independent springs and are solved exactly. Spectra fall as q^(-2(H+1)) from "
            "2π/L to the grid (no roll-off), C_1D = π q C_2D; phases are random, moduli fixed; "
            "heights are scaled to rms 1 in both models.",
            *_departures(results),
            *_hours(results),
        ],
        tables=[_settings_table(results)],
        note=(
            f"To repeat: {results.command} (these data: version {results.version}). "
            "The numbers behind every figure are in the folder data, as NetCDF and CSV."
        ),
    )


def _departures(results: PaperResults) -> list[str]:
    """Say where the bodies are not as the paper's."""
    bodies = {"surfaces": results.full, "lines": results.reduced}
    words = {name: departures(data.attrs) for name, data in bodies.items()}
    others = [f"the {name} are {', '.join(each)}" for name, each in words.items() if each]
    if not others:
        return []
    return [
        f"Other than in the paper, and as said above, {'; '.join(others)}: the claims are judged "
        "on these bodies."
    ]


def _hours(results: PaperResults) -> list[str]:
    """Say how long the whole study took, if that is known."""
    computing = results.computing
    if computing is None:
        return []
    return [
        f"All this, and the map of the two models, took {computing.hours:.1f} hours on "
        f"{computing.cores} cores of a machine with the processor {computing.processor}; the "
        "founding paper speaks of several weeks."
    ]


def _two_grids_table(full: xarray.Dataset, other: xarray.Dataset, window: ForceWindow) -> Table:
    """Return ratios of the same surfaces on two grids, the finer over the coarser."""
    coarse, fine = sorted((full, other), key=lambda data: int(data.attrs["n"]))
    n, n_fine = (data.attrs["n"] for data in (coarse, fine))
    header = ["D_f", "surfaces"]
    shared = np.intersect1d(coarse.force_bar, fine.force_bar)
    forces = [force for force in _GRID_FORCES if np.isclose(force, shared, rtol=1e-3).any()]
    of_area = [force for force in forces if force == MEDIUM_FORCE]
    header += [f"k, {n_fine}² over {n}², F̄ = {force:g}" for force in forces]
    header += [f"α, {n}²", f"α, {n_fine}²"]
    header += [f"A, {n_fine}² over {n}², F̄ = {force:g}" for force in of_area]
    rows = []
    for dimension in np.intersect1d(coarse.fractal_dimension, fine.fractal_dimension):
        count = min(coarse.sizes["realisation"], fine.sizes["realisation"])
        finer, coarser = (
            data.sel(fractal_dimension=dimension, force_bar=shared).isel(realisation=slice(count))
            for data in (fine, coarse)
        )
        laws = [dimension_law(data, window) for data in (coarser, finer)]
        areas = [data.area_fraction_corrected for data in (finer, coarser)]
        rows.append(
            [
                dimension_label(dimension),
                f"{count}",
                *(_ratio_cell(finer.stiffness, coarser.stiffness, force) for force in forces),
                *(number_cell(law.exponent) for law in laws),
                *(_ratio_cell(areas[0], areas[1], force) for force in of_area),
            ]
        )
    return Table(header, rows, numbers=range(len(header)))


def _ratio_cell(fine: xarray.DataArray, coarse: xarray.DataArray, force_bar: float) -> str:
    """Write the ratio of the means of pairs at a load, with its interval."""
    nearest = {"force_bar": [force_bar]}
    values = (each.sel(nearest, method="nearest").values for each in (fine, coarse))
    (ratio,), (low,), (high,) = relative_difference(*values, paired=True)
    return estimate_cell(IntervalEstimate(1 + ratio, 1 + low, 1 + high))


def _settings_table(results: PaperResults) -> Table:
    """Return what was computed: an ensemble in each row."""
    reduced, matched, computing = results.reduced, results.matched, results.computing
    ensembles = [
        (ENSEMBLE_REDUCED, "reduced", reduced),
        (ENSEMBLE_MATCHED, "reduced, with the waves of the surfaces", matched),
        (ENSEMBLE_FULL, "full", results.full),
        ("coarse-surfaces", "full, on another grid", results.other_grid),
        *((f"grids-n{n}", f"full, {n}²", data) for n, data in sorted(results.grids.items())),
    ]
    rows = []
    for ensemble, name, data in ensembles:
        if data is None or (ensemble == ENSEMBLE_MATCHED and matched is reduced):
            continue
        # the exponents may come from more fractal dimensions than the lines that are kept
        dimensions = (results.exponents if data is reduced else data).fractal_dimension.values
        n, forces = data.attrs["n"], data.force_bar.values
        rows.append(
            (
                name,
                f"{dimensions.size}, from {dimensions[0]:g} to {dimensions[-1]:g}",
                f"{data.sizes['realisation']}",
                f"{n}" if data.attrs["model"] == "reduced" else f"{n} × {n}",
                f"{forces.size}, F̄ = {forces[0]:g} to {forces[-1]:g}",
                f"SeedSequence({data.attrs['seed']}, spawn_key=(i,))",
                *([f"{computing.core_seconds[ensemble]:.3g} s"] if computing else []),
            )
        )
    header = ("Model", "Fractal dimensions", "Realisations each", "Points", "Loads", "Seed of i")
    return Table((*header, "One body, one core") if computing else header, rows)


def _write_data(folder: Path, results: PaperResults, claims: list[Claim]) -> None:
    """Write the ensembles and the gallery as NetCDF, mean curves and tables as CSV."""
    import pandas as pd  # here because it loads slowly

    folder.mkdir(parents=True, exist_ok=True)
    ensembles = {
        "reduced": results.reduced,
        "full": results.full,
        "matched": results.matched,
        "other_grid": results.other_grid,
        **{f"grid_{n}": data for n, data in results.grids.items()},
    }
    for name, data in ensembles.items():
        if data is None:
            continue
        write_netcdf(data, folder / f"{name}.nc")
        mean_table(data).to_csv(folder / f"{name}.csv", index=False)
    if results.gallery is not None:
        results.gallery.to_netcdf(folder / "gallery.nc", engine="h5netcdf")
    for name, table in (
        ("exponents", exponent_table(results.laws)),
        ("constants", constant_table(results.laws)),
    ):
        frame = pd.DataFrame(table.rows, columns=list(table.header))
        frame.to_csv(folder / f"{name}.csv", index=False)
    pd.DataFrame(map(vars, claims), columns=list(_COLUMNS)).to_csv(
        folder / "claims.csv", index=False
    )
