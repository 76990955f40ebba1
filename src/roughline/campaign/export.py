"""A store's ensembles as files that other programs read."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughline.campaign.layout import CASE_STATUS, DONE, VARIABLES
from roughline.campaign.store import Store
from roughline.contact.status import Status
from roughline.errors import InputError, StoreError
from roughline.statistics.averages import average

if TYPE_CHECKING:
    import pandas as pd
    import xarray


def export(
    store: Store, folder: str | Path, formats: Sequence[str] = ("netcdf", "csv")
) -> list[Path]:
    """Write every ensemble of a store to a folder, and return the files; what is not done is NaN.

    So is what was lost or damaged on disk, and a warning (:class:`roughline.LostCasesWarning`)
    names it.

    "netcdf" is ``NAME.nc``, everything, with units and settings. "csv" is ``NAME.csv``, a row for
    each load of each case, and ``NAME_mean.csv``, a row for each load of each fractal dimension
    with means, their intervals, and of how many realisations each of them is.
    """
    for wanted in formats:
        if wanted not in ("netcdf", "csv"):
            raise InputError(f'format is {wanted!r}; allowed are "netcdf" and "csv"')
    folder = Path(folder)
    written = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in store.names:
            data = store.dataset(name)
            if "netcdf" in formats:
                written.append(folder / f"{name}.nc")
                write_netcdf(data, written[-1])
            if "csv" in formats:
                written += [folder / f"{name}.csv", folder / f"{name}_mean.csv"]
                data.to_dataframe().to_csv(written[-2])
                mean_table(data).to_csv(written[-1], index=False)
    except OSError as error:
        raise StoreError(f"cannot write to {folder} ({error}): choose another folder") from error
    return written


def write_netcdf(data: xarray.Dataset, path: Path) -> None:
    """Write an ensemble to a NetCDF file, compressed without loss."""
    packed = {"zlib": True, "complevel": 6, "shuffle": True}
    data.to_netcdf(path, engine="h5netcdf", encoding=dict.fromkeys(map(str, data), packed))


def mean_table(data: xarray.Dataset) -> pd.DataFrame:
    """Return means over realisations with 95 % intervals, a row for each D_f and load."""
    import pandas as pd  # here because it loads slowly

    names = [each.name for each in VARIABLES.values() if each.averaged and each.name in data]
    tables = []
    for dimension in data.fractal_dimension.values:
        one = data.sel(fractal_dimension=dimension)
        force = one.force_bar.values
        columns = {"fractal_dimension": np.full(force.size, dimension), "force_bar": force}
        if "shear_bar" in one.coords:
            columns["shear_bar"] = one.shear_bar.values
        for name in names:
            mean = average(one[name].values)
            columns |= {
                f"{name}_mean": mean.mean,
                f"{name}_low": mean.low,
                f"{name}_high": mean.high,
                f"{name}_standard_deviation": mean.scatter,
                f"{name}_realisations": mean.count,
            }
        columns["realisations_converged"] = (one.status.values == Status.CONVERGED).sum(axis=0)
        columns["realisations_resolved"] = (one.resolved.values == 1).sum(axis=0)
        done = int((one[CASE_STATUS.name].values == DONE).sum())
        columns["realisations_done"] = np.full(force.size, done)
        tables.append(pd.DataFrame(columns))
    return pd.concat(tables, ignore_index=True)
