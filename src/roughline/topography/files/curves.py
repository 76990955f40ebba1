"""Curves in the NetCDF files that roughline writes, for those who ask what such a file is."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.topography.files.archives import refuse_empty_datasets

_STIFFNESSES = ("stiffness", "instantaneous_stiffness")  # over loads, and over time
_SHOWN = ("time", "depth", "force", *_STIFFNESSES, "area_fraction_corrected", "area_fraction")
"""Quantities of a curve that are shown, as far as it has them."""


@dataclass(frozen=True, eq=False)
class CurveInFile:
    """What a file with a curve holds of it."""

    file: str  # name of the file
    settings: dict[str, Any]  # how the curve was computed
    # shape (loads,): those of the quantities `_SHOWN` that the curve has; NaN where a load was not
    # solved
    columns: dict[str, Real]
    units: dict[str, str]  # unit of each of them


def curve_in(path: Path) -> CurveInFile | None:
    """Return the curve in a file of :meth:`roughline.Curve.write`; None if there is none.

    Those of :meth:`roughline.CreepCurve.write` are over time.
    """
    if path.suffix != ".nc" or not os.path.isfile(path):  # noqa: PTH113 - as in reading
        return None
    refuse_empty_datasets(path, path.name)
    import h5netcdf  # here because it loads slowly; xarray loads even more slowly

    try:
        with h5netcdf.File(path, "r") as file:
            names = set(file.variables)
            is_curve = {"depth", "force"} <= names and not names.isdisjoint(_STIFFNESSES)
            if "E_star" not in file.attrs or not is_curve:
                return None
            found = {name: file[name] for name in _SHOWN if name in file.variables}
            if any(variable.ndim != 1 for variable in found.values()):
                return None
            return CurveInFile(
                file=path.name,
                settings={
                    name: value.item() if isinstance(value, np.generic) else value
                    for name, value in file.attrs.items()
                },
                columns={name: np.asarray(each[:], np.float64) for name, each in found.items()},
                units={name: str(each.attrs.get("units", "")) for name, each in found.items()},
            )
    except (OSError, ValueError, KeyError, AttributeError):  # the last of h5netcdf before 1.7
        return None
