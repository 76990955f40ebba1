"""The numbers behind the figures: tables for the page, and files to go on working with."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughline.power_law import linear_exponent, scaling_exponent
from roughline.report.claims import Claim
from roughline.report.page import Table
from roughline.report.summary import OTHER_WINDOWS_REDUCED, DimensionSummary

if TYPE_CHECKING:
    import xarray


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
    header = ("D_f", "ζ 1D", "ζ 3D", "k 3D over 1D", "κ", "A ~ F^")
    rows = [
        (
            f"{s.fractal_dimension:.1f}",
            _with_interval(s.reduced.prefactor, s.reduced.prefactor_interval),
            _with_interval(s.full.prefactor, s.full.prefactor_interval),
            _with_interval(s.agreement.value, (s.agreement.low, s.agreement.high)),
            _with_interval(s.kappa.value, (s.kappa.low, s.kappa.high)),
            _with_interval(s.area_exponent.value, (s.area_exponent.low, s.area_exponent.high)),
        )
        for s in summaries
    ]
    return Table(header, rows, numbers=range(len(header)))


def _with_interval(value: float, interval: tuple[float, float]) -> str:
    return f"{value:.3f} ({interval[0]:.3f}-{interval[1]:.3f})"


def write_data(
    folder: Path,
    reduced: xarray.Dataset,
    full: xarray.Dataset,
    gallery: xarray.Dataset,
    summaries: list[DimensionSummary],
    claims: list[Claim],
) -> None:
    """Write the ensembles and the gallery as NetCDF, mean curves and tables as CSV."""
    import pandas as pd  # here because it loads slowly

    folder.mkdir(parents=True, exist_ok=True)
    for name, data in (("reduced", reduced), ("full", full), ("gallery", gallery)):
        data.to_netcdf(folder / f"{name}.nc", engine="h5netcdf")
    for name, data in (("reduced", reduced), ("full", full)):
        stiffness = data.stiffness
        table = {
            "stiffness_mean": stiffness.mean("realisation"),
            "stiffness_standard_deviation": stiffness.std("realisation", ddof=1),
            "depth_mean": data.depth.mean("realisation"),
            "realisations_converged": np.isfinite(stiffness).sum("realisation"),
            "realisations_resolved": data.resolved.sum("realisation"),
        }
        if "area_fraction" in data:
            table["area_fraction_mean"] = data.area_fraction.mean("realisation")
        frame = pd.DataFrame({key: value.to_series() for key, value in table.items()})
        frame.to_csv(folder / f"{name}.csv")
    for name, shown in (
        ("exponents", exponent_table(summaries)),
        ("constants", constant_table(summaries)),
    ):
        frame = pd.DataFrame(shown.rows, columns=list(shown.header))
        frame.to_csv(folder / f"{name}.csv", index=False)
    pd.DataFrame([vars(claim) for claim in claims]).to_csv(folder / "claims.csv", index=False)
