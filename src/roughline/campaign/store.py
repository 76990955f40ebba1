"""Results on disk, for reading: a Zarr group for each ensemble, which xarray opens directly."""

from __future__ import annotations

import json
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from roughline._version import __version__
from roughline.campaign.digest import lost_cases
from roughline.campaign.layout import (
    CASE_DIGEST,
    CASE_STATUS,
    COORDINATES,
    DONE,
    FAILED,
    FORMAT,
    PENDING,
    VARIABLES,
)
from roughline.errors import LostCasesWarning, StoreError

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
        """Return the numbers of cases that are done, that failed, and of all cases.

        Cases that were lost do not count as done.
        """
        status = self._read(name).marks
        done, failed = (int(np.count_nonzero(status == value)) for value in (DONE, FAILED))
        return done, failed, status.size

    def failures(self, name: str) -> dict[str, str]:
        """Return why cases failed, by the names of the cases."""
        return dict(self._group(name).attrs["failures"])

    def lost(self, name: str) -> list[str]:
        """Name what was done and is not on disk as it was computed; a further run computes it.

        A chunk may be missing, cut off, altered, or in another's place. These are cases, such as
        "D_f 2.4, realisations 3 to 5", and coordinates.
        """
        return self._read(name).lost

    def refuse_lost(self, name: str) -> None:
        """Refuse an ensemble of which something was lost, for readers that need all of it.

        Raises
        ------
        StoreError
            With what was lost.
        """
        if lost := self.lost(name):
            raise StoreError(f"{self.path}: {described_loss(name, lost)}")

    def dataset(self, name: str) -> xarray.Dataset:
        """Return an ensemble over (fractal_dimension, realisation, force_bar), sorted.

        Cases that are not done hold NaN, and -1 in status. So do cases that were lost, of which it
        warns (:class:`roughline.LostCasesWarning`).
        """
        import xarray  # here because it loads slowly

        group, read = self._group(name), self._read(name)
        if read.lost:
            warnings.warn(described_loss(name, read.lost), LostCasesWarning, stacklevel=2)
        values = {**read.values, CASE_STATUS.name: read.marks}
        variables = {
            key: (group[key].metadata.dimension_names, values[key], dict(group[key].attrs))
            for key in (*VARIABLES, CASE_STATUS.name)
            if key in values
        }
        coordinates = {
            key: (COORDINATES[key].dims, value, COORDINATES[key].attributes)
            for key, value in sorted(coordinate_values(group, read.marks.shape).items())
        }
        attributes = {
            key: json.dumps(each) if isinstance(each, dict) else each
            for key, each in group.attrs.items()
        }
        data = xarray.Dataset(variables, coordinates, attributes)
        return data.sortby("fractal_dimension")

    def _read(self, name: str) -> _StoredEnsemble:
        """Read an ensemble; marks first, because a campaign that goes on writes them last."""
        group = self._group(name)
        marks, unreadable = read_filled(group[CASE_STATUS.name])
        high, wide = marks.shape
        values = {}
        for key in (*VARIABLES, CASE_DIGEST.name):
            if key in group:
                values[key] = read_filled(group[key])[0][:high, :wide]
        coordinates = coordinate_values(group, marks.shape)
        lost = lost_cases(coordinates["fractal_dimension"], marks, values)
        marks[lost] = PENDING
        for key, each in values.items():
            each[marks != DONE] = group[key].fill_value
        for region in unreadable:
            lost[region] = True
        named = _named(lost, coordinates["fractal_dimension"])
        for key, value in coordinates.items():
            if not _holds(group, key, value):
                named.append(f"the coordinate {key}")
        return _StoredEnsemble(values, marks, named)

    def _group(self, name: str) -> Any:
        if name not in self._root:
            raise StoreError(f"{self.path} has no ensemble {name!r}; it has {self.names}")
        return self._root[name]


@dataclass(frozen=True)
class _StoredEnsemble:
    """An ensemble as it is on disk."""

    values: dict[str, NDArray[Any]]  # of cases that are done; fill values elsewhere
    marks: NDArray[Any]  # of the cases, shape (fractal dimensions, realisations)
    lost: list[str]  # what was done and is not there


def described_loss(name: str, lost: Sequence[str]) -> str:
    """Say in a line what of an ensemble was lost, and what brings it back."""
    return (
        f"{name}: values that were computed are lost or damaged on disk: {'; '.join(lost)}; "
        "`roughline campaign run` with the same plan computes them again"
    )


def _named(cases: NDArray[np.bool_], dimensions: NDArray[np.float64]) -> list[str]:
    """Name the cases that are marked in an array, neighbouring realisations together."""
    names = []
    for i in np.argsort(dimensions):
        marked = np.flatnonzero(cases[i])
        for run in np.split(marked, np.flatnonzero(np.diff(marked) > 1) + 1):
            if run.size == 1:
                names.append(f"D_f {dimensions[i]:g}, realisation {run[0]}")
            elif run.size:
                names.append(f"D_f {dimensions[i]:g}, realisations {run[0]} to {run[-1]}")
    return names


def coordinate_values(group: Any, cases: tuple[int, int]) -> dict[str, NDArray[Any]]:
    """Return what the arrays of an ensemble of so many cases are over, as its attributes say."""
    found = {
        "fractal_dimension": np.array(group.attrs["fractal_dimensions"][: cases[0]]),
        "realisation": np.arange(cases[1]),
        "force_bar": np.array(group.attrs["force_bars"]),
    }
    if "shear_bars" in group.attrs:
        found["shear_bar"] = np.array(group.attrs["shear_bars"])
    return found


def _holds(group: Any, name: str, value: NDArray[Any]) -> bool:
    """Whether a coordinate is in a group and has these values; or more, if it has just grown."""
    stored = read_or_none(group[name]) if name in group else None
    return stored is not None and np.array_equal(stored[: len(value)], value)


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


def read_filled(array: Any) -> tuple[NDArray[Any], list[tuple[slice, ...]]]:
    """Return the values of an array, and the chunks that cannot be read, which hold fill values."""
    values = read_or_none(array)
    if values is not None:
        return values, []
    values = np.full(array.shape, array.fill_value, dtype=array.dtype)
    unreadable = []
    steps = [range(0, size, chunk) for size, chunk in zip(array.shape, array.chunks, strict=True)]
    for corner in product(*steps):
        region = tuple(
            slice(start, min(start + chunk, size))
            for start, chunk, size in zip(corner, array.chunks, array.shape, strict=True)
        )
        try:
            values[region] = array[region]
        except (OSError, ValueError, RuntimeError):
            unreadable.append(region)
    return values, unreadable
