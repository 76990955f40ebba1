"""A file with a curve: what was pressed and how, and the loads, on the terminal and as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from rich.console import Console

from roughline.report.terminal import MOST_PRINTED, print_rows, print_table
from roughline.units import SI, engineering

if TYPE_CHECKING:
    from roughline.topography.files.curves import CurveInFile

_HEADER = {
    "time": "time",
    "force": "force F",
    "depth": "depth d",
    "stiffness": "stiffness k",
    "instantaneous_stiffness": "k of a fast load",
    "area_fraction_corrected": "corrected A/A_0",
    "area_fraction": "raw A/A_0",
}


def print_curve_file(curve: CurveInFile) -> None:
    """Print what a file with a curve is of, and its loads."""
    console = Console(markup=False)
    print_rows(console, _settings_table(curve))
    header, loads = _loads_table(curve)
    print_table(console, header, loads[:MOST_PRINTED])
    if len(loads) > MOST_PRINTED:
        console.print(f"{len(loads) - MOST_PRINTED} more loads: use --json", highlight=False)
    opened = f'xarray.open_dataset("{curve.file}", engine="h5netcdf")'
    console.print(f"all of it in Python: {opened}", highlight=False, soft_wrap=True)


def _settings_table(curve: CurveInFile) -> list[tuple[str, str]]:
    """Return names and values of what the curve is of."""
    settings = curve.settings
    rows = [
        ("file", f"{curve.file}, a curve that roughline wrote"),
        ("times" if "time" in curve.columns else "loads", str(curve.columns["force"].size)),
        ("E*", _written(settings["E_star"], settings.get("E_star_units", ""))),
    ]
    if "boundary" in settings:
        rows.append(("half-space", str(settings["boundary"])))
    if "hardness" in settings:
        rows.append(("hardness", _written(settings["hardness"], settings.get("E_star_units", ""))))
    rows.append(("rms height", _written(settings["rms_height"], settings.get("length_units", ""))))
    for name in ("file", "origin"):
        if f"body_{name}" in settings:
            rows.append((f"{name} of the body", str(settings[f"body_{name}"])))
    return rows


def _loads_table(curve: CurveInFile) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the loads."""
    names = [name for name in _HEADER if name in curve.columns]
    if "area_fraction_corrected" in names:
        names.remove("area_fraction")
    header = [_HEADER[name] for name in names]
    rows = [
        [_written(float(curve.columns[name][i]), curve.units[name]) for name in names]
        for i in range(curve.columns["force"].size)
    ]
    return header, rows


def as_json(curve: CurveInFile) -> dict[str, Any]:
    """Return the file as numbers and texts."""
    return {
        "file": curve.file,
        "settings": curve.settings,
        "units": curve.units,
        "curve": {name: values.tolist() for name, values in curve.columns.items()},
    }


def _written(value: float, unit: str) -> str:
    if np.isnan(value):
        return "-"
    if unit == "1":
        return f"{value:.4%}"
    return engineering(value, unit) if unit in SI else f"{value:.4g} {unit}".strip()
