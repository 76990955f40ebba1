"""The room for files on a disk: how datasets are written where it is short."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    import xarray

_DISK_FULL = (errno.ENOSPC, errno.EFBIG, *([errno.EDQUOT] if hasattr(errno, "EDQUOT") else []))
_ATTRIBUTE_BYTES = 100_000  # of a file, for attributes and names [bytes]


def write_dataset(
    data: xarray.Dataset, path: Path, engine: Literal["h5netcdf", "scipy"] = "h5netcdf"
) -> None:
    """Write a dataset, as NetCDF 4 by h5netcdf or as NetCDF 3 by SciPy.

    Its room is taken first, since HDF5 may end the process if it finds none.
    """
    with path.open("wb") as file:
        try:
            if hasattr(os, "posix_fallocate"):
                os.posix_fallocate(file.fileno(), 0, data.nbytes + _ATTRIBUTE_BYTES)
        except OSError as error:
            if is_full(error):  # others are of file systems that cannot do this
                file.truncate(0)
                raise
    if engine == "scipy":
        complete = {name: {"_FillValue": None} for name in data.variables}
        data.to_netcdf(path, engine="scipy", format="NETCDF3_64BIT", encoding=complete)
    else:
        data.to_netcdf(path, engine="h5netcdf")


def is_full(error: BaseException | None) -> bool:
    """Whether an error, or one that it came from, is of a file that there is no room for."""
    while error is not None:
        if isinstance(error, OSError) and error.errno in _DISK_FULL:
            return True
        if any(os.strerror(number) in str(error) for number in _DISK_FULL):  # as HDF5 says it
            return True
        error = error.__cause__ or error.__context__
    return False
