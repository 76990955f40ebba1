"""The numbers of the page: its tables, and files for further work."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughline.campaign.export import mean_table, write_netcdf
from roughline.paper.exponents import exponent_estimate, law_of, prefactor_estimate
from roughline.paper.plan import ENSEMBLE_FULL, ENSEMBLE_MATCHED, ENSEMBLE_REDUCED
from roughline.paper.windows import MEDIUM_FORCE, OTHER_WINDOWS_REDUCED
from roughline.plot.style import dimension_label
from roughline.report.page import Table
from roughline.statistics.averages import relative_difference
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.power_law import (
    PowerLaw,
    linear_exponent,
    scaling_exponent,
)

if TYPE_CHECKING:
    import xarray

    from roughline.contact.comparison.trust import Difference
    from roughline.paper.laws import DimensionLaws
    from roughline.paper.results import PaperResults
    from roughline.paper.sensitivity import Sensitivity
    from roughline.paper.windows import Window
    from roughline.statistics.verdict import Claim

_GRID_FORCES = (0.01, 0.1, 1.0)


def exponent_table(laws: list[DimensionLaws]) -> Table:
    """Return the exponents of both models beside the two predictions."""
    header = (
        "D_f",
        "1/(4 - D_f)",
        "0.2567 D_f",
        "α 1D",
        *(f"α 1D, {low:g} to {high:g}" for low, high in OTHER_WINDOWS_REDUCED),
        "α 3D",
        "3D loads under 10 cells",
    )
    rows = [
        (
            dimension_label(each.fractal_dimension),
            f"{scaling_exponent(each.fractal_dimension):.3f}",
            f"{linear_exponent(each.fractal_dimension):.3f}",
            estimate_cell(exponent_estimate(each.reduced)),
            *(_number_cell(law.exponent) for law in each.reduced_elsewhere),
            estimate_cell(exponent_estimate(each.full)),
            "-" if np.isnan(each.unresolved) else f"{each.unresolved:.0%}",
        )
        for each in laws
    ]
    return Table(header, rows, numbers=range(len(header)))


def constant_table(laws: list[DimensionLaws]) -> Table:
    """Return the prefactors, the ratio of the two models and the constants of the area law."""
    header = (
        *("D_f", "ζ 1D", "ζ 3D", "k 3D over 1D", "κ", "A ~ F^"),
        *("κ in cells", "A in cells ~ F^", "κ, first to last load"),
    )
    rows = []
    for each in laws:
        estimates = (
            prefactor_estimate(each.reduced),
            prefactor_estimate(each.full),
            each.agreement,
            *(each.corrected.kappa, each.corrected.exponent),
            *(each.cells.kappa, each.cells.exponent),
        )
        first, last = each.corrected.kappa_ends
        rows.append(
            (
                dimension_label(each.fractal_dimension),
                *(estimate_cell(estimate) for estimate in estimates),
                "-" if np.isnan(first) else f"{first:.2f} to {last:.2f}",
            )
        )
    return Table(header, rows, numbers=range(len(header)))


def sensitivity_table(model: str, rows: list[Sensitivity]) -> Table:
    """Return the exponents of one model by window and averaging."""
    header = ["D_f"]
    for law, _, _ in rows[0].fits:
        header += [f"α {model}, {law.window[0]:g} to {law.window[1]:g}", "geometric", "fixed level"]
    cells = []
    for row in rows:
        found = [dimension_label(row.fractal_dimension)]
        for arithmetic, geometric, level in row.fits:
            found += [estimate_cell(exponent_estimate(arithmetic))]
            found += [_number_cell(geometric.exponent), estimate_cell(level)]
        cells.append(found)
    return Table(header, cells, numbers=range(len(header)))


def automatic_windows_table(rows: dict[str, list[Sensitivity]]) -> Table:
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


def two_grids_table(full: xarray.Dataset, other: xarray.Dataset, window: Window) -> Table:
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
        laws = [law_of(data, window) for data in (coarser, finer)]
        areas = [data.area_fraction_corrected for data in (finer, coarser)]
        rows.append(
            [
                dimension_label(dimension),
                f"{count}",
                *(_ratio_cell(finer.stiffness, coarser.stiffness, force) for force in forces),
                *(_number_cell(law.exponent) for law in laws),
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


def estimate_cell(number: IntervalEstimate) -> str:
    """Write a number with its interval, as all tables of the study do."""
    if np.isnan(number.low):
        return _number_cell(number.value)
    return f"{number.value:.3f} ({number.low:.3f}-{number.high:.3f})"


def trust_cell(difference: Difference) -> str:
    """Write a difference with its interval; a star stands where the grid decides."""
    if np.isnan(difference.value):
        return "-"
    star = "" if difference.resolved else " *"
    return f"{difference.value:+.0%} ({difference.low:+.0%} to {difference.high:+.0%}){star}"


def _number_cell(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.3f}"


def settings_table(results: PaperResults) -> Table:
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


def write_data(folder: Path, results: PaperResults, claims: list[Claim]) -> None:
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
    pd.DataFrame([vars(claim) for claim in claims]).to_csv(folder / "claims.csv", index=False)
