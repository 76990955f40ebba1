"""Files of curves: NetCDF with all of it, or a table in CSV."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from roughline.computing.disk import write_dataset
from roughline.errors import InputError, StoreError
from roughline.errors.checks import refuse

if TYPE_CHECKING:
    import xarray


def checked_name(path: str | Path) -> Path:
    """Return the name of a file that a curve can be written to."""
    if not isinstance(path, str | os.PathLike):
        refuse("path", path, 'a name that ends in ".nc" or ".csv" is needed')
    path = Path(path)
    if path.suffix not in (".nc", ".csv"):
        raise InputError(f'{path} ends in neither ".nc" (NetCDF) nor ".csv" (a table): rename it')
    return path


def write_curve(data: xarray.Dataset, path: Path) -> None:
    """Write the dataset of a curve; a table leaves fields out and has units in its header."""
    try:
        if path.suffix == ".nc":
            write_dataset(data, path)
            return
        over_loads = data.drop_dims(["field_load", "x", "y"], errors="ignore")
        table = over_loads.to_dataframe().reset_index()
        units = {name: over_loads[name].attrs.get("units") for name in table}
        table.columns = [f"{name} [{units[name]}]" if units[name] else name for name in table]
        table.to_csv(path, index=False)
    except (OSError, ValueError) as error:
        raise StoreError(f"cannot write {path} ({error}): choose another place") from error
