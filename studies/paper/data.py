"""The data of the paper's study: those that come with the package, and what only its pages need."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import xarray

from roughline.paper.results import PaperResults, published_dataset, published_results

FOLDER = Path(__file__).parent / "data"
"""What the package does without: bodies of figures, other grids, and what is apart."""
APART = {"lines": ["depth", "rms_slope", "highest"], "coarse": ["area_fraction_corrected"]}
"""Variables of ensembles of the package by which no claim is judged."""
_FINEST = {"zlib": True, "complevel": 9, "shuffle": True}


@cache
def dataset(name: str) -> xarray.Dataset:
    """Return one part of the study, by the name of its file, with all that is kept of it."""
    path = FOLDER / f"{name}.nc"
    if not path.exists():
        return published_dataset(name)
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        kept = data.load().drop_encoding()
    return xarray.merge([published_dataset(name), kept]) if name in APART else kept


@cache
def results() -> PaperResults:
    """Return the whole study, as its page shows it."""
    grids = {n: dataset(f"grid_{n}") for n in (128, 256, 512, 1024)}
    return replace(
        published_results(),
        reduced=dataset("lines"),
        other_grid=dataset("coarse"),
        gallery=dataset("gallery"),
        grids=grids,
    )


def write(data: xarray.Dataset, path: Path) -> None:
    """Write bodies of one ensemble as they are printed: counts whole, all else in single precision.

    The stiffness of a line is the number of its springs in contact, over all of them, and the area
    of a surface the number of its cells; their own powers of two bring them back exactly.
    """
    n = int(data.attrs["n"])
    counted = {"stiffness": n} if data.attrs["model"] == "reduced" else {"area_fraction": n**2}
    encoding = {str(name): _encoding(each, counted) for name, each in data.data_vars.items()}
    data.drop_encoding().to_netcdf(path, engine="h5netcdf", encoding=encoding)


def _encoding(values: xarray.DataArray, counted: Mapping[str, int]) -> dict[str, object]:
    """How one variable is stored."""
    stored: dict[str, object] = {**_FINEST, "chunksizes": values.shape}
    if values.name in counted:
        return stored | {
            "dtype": "int32",
            "scale_factor": 1 / counted[str(values.name)],
            "_FillValue": np.int32(-1),  # loads without a solution
        }
    return stored | ({"dtype": "float32"} if values.dtype == np.float64 else {})
