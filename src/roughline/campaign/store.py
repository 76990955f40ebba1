"""Results on disk, for reading: a Zarr group for each ensemble, which xarray opens directly."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from roughline._version import __version__
from roughline.campaign.layout import CASE_STATUS, DONE, FAILED, FORMAT, VARIABLES
from roughline.errors import StoreError

if TYPE_CHECKING:
    import xarray


class Store:
    """The results of a campaign in one folder, for reading.

    Parameters
    ----------
    path : str or Path
        The folder.

    Raises
    ------
    StoreError
        If it does not exist, was not made by roughline, or is damaged.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self._root = opened(self.path, "r")

    @property
    def names(self) -> list[str]:
        """Names of the ensembles."""
        return sorted(name for name, group in self._root.groups() if CASE_STATUS.name in group)

    def counts(self, name: str) -> tuple[int, int, int]:
        """Return the numbers of cases that are done, that failed, and of all cases."""
        status = self._group(name)[CASE_STATUS.name][:]
        done, failed = (int(np.count_nonzero(status == value)) for value in (DONE, FAILED))
        return done, failed, status.size

    def failures(self, name: str) -> dict[str, str]:
        """Return why cases failed, by the names of the cases."""
        return dict(self._group(name).attrs["failures"])

    def dataset(self, name: str) -> xarray.Dataset:
        """Return an ensemble over (fractal_dimension, realisation, force_bar), sorted.

        Cases that are not done hold NaN, and -1 in status.
        """
        import xarray

        self._group(name)
        data = xarray.open_zarr(self.path, group=name, consolidated=False, chunks=None).load()
        data.attrs["failures"] = json.dumps(data.attrs["failures"])
        names = [key for key in (*VARIABLES, CASE_STATUS.name) if key in data]
        return _in_order(data, names).sortby("fractal_dimension")

    def _group(self, name: str) -> Any:
        if name not in self._root:
            raise StoreError(f"{self.path} has no ensemble {name!r}; it has {self.names}")
        return self._root[name]


def _in_order(data: xarray.Dataset, names: Sequence[str]) -> xarray.Dataset:
    """Return variables in an order, with the coordinates by name.

    Zarr lists them in another order every time, and files of the same bytes need the same.
    """
    import xarray  # here because it loads slowly

    coordinates = {name: data[name].variable for name in sorted(map(str, data.coords))}
    return xarray.Dataset({name: data[name].variable for name in names}, coordinates, data.attrs)


def opened(path: Path, mode: Literal["r", "r+"]) -> Any:
    """Open the root group of a store of this version, for reading or for writing too."""
    import zarr  # here because it loads slowly

    if not path.is_dir():
        raise StoreError(f"{path} does not exist; a store made by a campaign is needed")
    try:
        root = zarr.open_group(path, mode=mode, use_consolidated=False)
        marks = dict(root.attrs)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise damaged_or_foreign(path) from error
    if "roughline_store" not in marks:
        raise StoreError(
            f"{path} is not a store of roughline; choose another folder for the campaign"
        )
    version = marks.get("roughline_version")
    if marks["roughline_store"] != FORMAT or version != __version__:
        raise StoreError(
            f"{path} was made by roughline {version}, this is {__version__}: results of two "
            "versions are not mixed; use that version, or another folder"
        )
    return root


def damaged_or_foreign(path: Path) -> StoreError:
    """Say what is wrong with a folder that cannot be opened."""
    what = (
        "is damaged (its zarr.json cannot be read)"
        if (path / "zarr.json").exists()
        else "is not a store of roughline"
    )
    return StoreError(f"{path} {what}; choose another folder for the campaign")


def read_or_none(array: Any) -> NDArray[Any] | None:
    """Return the values of an array, or None if a chunk is damaged."""
    try:
        return array[:]
    except (OSError, ValueError, RuntimeError):
        return None
