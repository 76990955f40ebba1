"""The page "The paper, recomputed": what it says, section by section."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from roughline.paper.claims import claims_section, judge_claims
from roughline.paper.pictures import draw_pictures
from roughline.paper.roles import departures
from roughline.paper.sensitivity import sensitivities
from roughline.paper.tables import (
    automatic_windows_table,
    constant_table,
    exponent_table,
    sensitivity_table,
    settings_table,
    two_grids_table,
    write_data,
)
from roughline.paper.windows import WINDOW_AREA
from roughline.report.page import Section, render

if TYPE_CHECKING:
    from roughline.paper.results import PaperResults


def write_page(results: PaperResults, out: Path) -> Path:
    """Write figures, data and ``report.html`` of a study into a folder, and return the page."""
    title, lead, sections = compose(results, out)
    page = out / "report.html"
    page.write_text(render(title, lead, sections), encoding="utf-8")
    return page


def compose(results: PaperResults, out: Path) -> tuple[str, str, list[Section]]:
    """Draw the figures and write the data of a study; return title, lead and sections."""
    claims = judge_claims(results)
    pictures = draw_pictures(results, out / "figures")
    write_data(out / "data", results, claims)
    title = "The paper, recomputed: reduction method and 3D boundary elements"
    lead = (
        f"Normal contact of fractal rough surfaces in two models, recomputed with roughline "
        f"{results.version} {results.name}. The paper is R. Pohrt and V. L. Popov, Investigation "
        "of the dry normal contact between fractal rough surfaces using the reduction method, "
        "comparison to 3D simulations, Physical Mesomechanics 15 (2012)."
    )
    sections = [
        claims_section(claims),
        _exponents_section(results),
        _sensitivity_section(results),
        *_other_grid_sections(results),
        Section("Figures", pictures=pictures),
        _methods_section(results),
    ]
    return title, lead, sections


def _exponents_section(results: PaperResults) -> Section:
    windows = results.windows
    return Section(
        "Exponents and constants",
        [
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


def _sensitivity_section(results: PaperResults) -> Section:
    dimensions = results.full.fractal_dimension.values
    found = {
        "1D": sensitivities(results.reduced, dimensions, results.windows.all_reduced),
        "3D": sensitivities(results.full, dimensions, results.windows.all_full),
    }
    return Section(
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
            *(sensitivity_table(model, rows) for model, rows in found.items() if rows),
            automatic_windows_table(found),
        ],
    )


def _other_grid_sections(results: PaperResults) -> list[Section]:
    """Return the section about another grid, if the study has surfaces on one."""
    if results.other_grid is None:
        return []
    return [
        Section(
            "The same surfaces on two grids",
            [
                "The phases are the same, and the finer grid has more detail. Ratios of means with "
                "95 % intervals, from resampled pairs; α of the mean in the window of the full "
                "model."
            ],
            tables=[two_grids_table(results.full, results.other_grid, results.windows.full)],
        )
    ]


def _methods_section(results: PaperResults) -> Section:
    return Section(
        "What was computed, and how",
        [
            "Surfaces are rigid punches, a square with free borders pressed into an elastic "
            "half-space; they are solved with every interaction, the stiffness is the exact "
            "tangent dF/dd, and all residuals are certified below 1e-6. Lines lie on "
            "independent springs and are solved exactly. Spectra fall as q^(-2(H+1)) from "
            "2π/L to the grid (no roll-off), C_1D = π q C_2D; phases are random, moduli fixed; "
            "heights are scaled to rms 1 in both models.",
            *_departures(results),
            *_hours(results),
        ],
        tables=[settings_table(results)],
        note=(
            f"To repeat: {results.command} (these data: version {results.version}). "
            "The numbers behind every figure are in the folder data, as NetCDF and CSV."
        ),
    )


def _departures(results: PaperResults) -> list[str]:
    """Say where the bodies are not as the paper's."""
    bodies = {"surfaces": results.full, "lines": results.reduced}
    words = {name: departures(data.attrs) for name, data in bodies.items()}
    told = [f"the {name} are {', '.join(each)}" for name, each in words.items() if each]
    if not told:
        return []
    return [
        f"Other than in the paper, and as said above, {'; '.join(told)}: the claims are judged on "
        "these bodies."
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
