"""The numbers behind the figures: tables for the page, and files to go on working with."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughline.campaign.export import mean_table, write_netcdf
from roughline.paper.claim import Claim
from roughline.paper.exponents import OTHER_WINDOWS_REDUCED, WINDOW_FULL, DimensionSummary
from roughline.paper.results import PaperResults
from roughline.paper.sensitivity import Sensitivity
from roughline.report.page import Table
from roughline.statistics.power_law import fit_power_law, linear_exponent, scaling_exponent

if TYPE_CHECKING:
    import xarray

_GRID_FORCES = (0.01, 0.1, 1.0)


def exponent_table(summaries: list[DimensionSummary]) -> Table:
    """Table of the exponents of both models beside the two predictions."""
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
            f"{s.fractal_dimension:.1f}",
            f"{scaling_exponent(s.fractal_dimension):.3f}",
            f"{linear_exponent(s.fractal_dimension):.3f}",
            _with_interval(s.reduced.exponent, s.reduced.exponent_interval),
            *(f"{law.exponent:.3f}" for law in s.reduced_elsewhere),
            _with_interval(s.full.exponent, s.full.exponent_interval),
            f"{s.unresolved:.0%}",
        )
        for s in summaries
    ]
    return Table(header, rows, numbers=range(len(header)))


def constant_table(summaries: list[DimensionSummary]) -> Table:
    """Table of prefactors, of the models' ratio and of the area law."""
    header = (
        *("D_f", "ζ 1D", "ζ 3D", "k 3D over 1D", "κ", "A ~ F^"),
        *("κ in cells", "A in cells ~ F^", "κ, first to last load"),
    )
    rows = [
        (
            f"{s.fractal_dimension:.1f}",
            _with_interval(s.reduced.prefactor, s.reduced.prefactor_interval),
            _with_interval(s.full.prefactor, s.full.prefactor_interval),
            *(
                _with_interval(number.value, (number.low, number.high))
                for number in (
                    s.agreement,
                    *(s.corrected.kappa, s.corrected.exponent),
                    *(s.cells.kappa, s.cells.exponent),
                )
            ),
            f"{s.corrected.kappa_ends[0]:.2f} to {s.corrected.kappa_ends[1]:.2f}",
        )
        for s in summaries
    ]
    return Table(header, rows, numbers=range(len(header)))


def sensitivity_table(model: str, rows: list[Sensitivity]) -> Table:
    """Table of the exponents of one model by window and averaging."""
    windows = [f"{law.window[0]:g} to {law.window[1]:g}" for law in rows[0].arithmetic]
    header = ["D_f"]
    for window in windows:
        header += [f"α {model}, {window}", "geometric", "fixed level"]
    header += ["automatic window", "α there", "loads left out"]
    body = []
    for row in rows:
        cells = [f"{row.fractal_dimension:.1f}"]
        for law, other, level in zip(row.arithmetic, row.geometric, row.at_level, strict=True):
            cells += [
                _with_interval(law.exponent, law.exponent_interval),
                f"{other.exponent:.3f}",
                "-"
                if np.isnan(level.value)
                else _with_interval(level.value, (level.low, level.high)),
            ]
        found = row.automatic
        cells += (
            [
                f"{found.window[0]:.2g} to {found.window[1]:.2g}",
                _with_interval(found.exponent, found.exponent_interval),
            ]
            if found
            else ["none", "-"]
        )
        body.append([*cells, str(row.unresolved)])
    return Table(header, body, numbers=range(len(header)))


def paper_grid_table(full: xarray.Dataset, fine: xarray.Dataset) -> Table:
    """Table of the same surfaces on the paper's grid and on that of the ensemble."""
    n, n_fine = full.attrs["n"], fine.attrs["n"]
    header = ["D_f", "surfaces"]
    header += [f"k, {n_fine}² over {n}², F̄ = {force:g}" for force in _GRID_FORCES]
    header += [f"α, {n}²", f"α, {n_fine}²", f"A, {n_fine}² over {n}², F̄ = 0.1"]
    rows = []
    for dimension in fine.fractal_dimension.values:
        at = {"fractal_dimension": dimension, "realisation": fine.realisation}
        shared = np.intersect1d(full.force_bar, fine.force_bar)
        coarse = full.sel(at).sel(force_bar=shared)
        best = fine.sel(fractal_dimension=dimension).sel(force_bar=shared)
        cells = [f"{dimension:.1f}", f"{fine.sizes['realisation']}"]
        for force in _GRID_FORCES:
            ratio = best.stiffness / coarse.stiffness
            cells.append(_spread(ratio.sel(force_bar=force, method="nearest").values))
        for data in (coarse, best):
            law = fit_power_law(shared, data.stiffness.values, WINDOW_FULL)
            cells.append(f"{law.exponent:.3f}")
        ratio = best.area_fraction_corrected / coarse.area_fraction_corrected
        cells.append(_spread(ratio.sel(force_bar=0.1, method="nearest").values))
        rows.append(cells)
    return Table(header, rows, numbers=range(len(header)))


def _spread(values: np.ndarray) -> str:
    return f"{values.mean():.3f} ({values.min():.3f}-{values.max():.3f})"


def _with_interval(value: float, interval: tuple[float, float]) -> str:
    return f"{value:.3f} ({interval[0]:.3f}-{interval[1]:.3f})"


def write_data(
    folder: Path,
    results: PaperResults,
    summaries: list[DimensionSummary],
    claims: list[Claim],
) -> None:
    """Write the ensembles and the gallery as NetCDF, mean curves and tables as CSV."""
    import pandas as pd  # here because it loads slowly

    folder.mkdir(parents=True, exist_ok=True)
    ensembles = {"reduced": results.reduced, "matched": results.matched, "full": results.full}
    ensembles |= {f"grid_{n}": data for n, data in results.grids.items()}
    for name, data in ensembles.items():
        write_netcdf(data, folder / f"{name}.nc")
        mean_table(data).to_csv(folder / f"{name}.csv", index=False)
    if results.gallery is not None:
        results.gallery.to_netcdf(folder / "gallery.nc", engine="h5netcdf")
    for name, shown in (
        ("exponents", exponent_table(summaries)),
        ("constants", constant_table(summaries)),
    ):
        frame = pd.DataFrame(shown.rows, columns=list(shown.header))
        frame.to_csv(folder / f"{name}.csv", index=False)
    pd.DataFrame([vars(claim) for claim in claims]).to_csv(folder / "claims.csv", index=False)
