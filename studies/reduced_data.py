"""The data of a study: what its page needs of a finished store, in one NetCDF file."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import xarray

from roughline.campaign import Ensemble, Plan, Store, read_plan
from roughline.campaign.layout import DONE
from roughline.errors import StoreError

_AGAIN = "reduce the study again, or restore its plan"
_SMALL = 8192  # bytes of an array below which packing costs more than it saves
_PACKED = {"zlib": True, "complevel": 9, "shuffle": True}


@dataclass(frozen=True)
class Reduced:
    """What a study keeps of its store: some variables of each ensemble of its plan."""

    folder: Path  # folder of the study, with ``plan.toml`` and ``data.nc``
    variables: tuple[str, ...]  # the variables, as far as an ensemble has them

    @cached_property
    def plan(self) -> Plan:
        """The plan of the study."""
        return read_plan(self.folder / "plan.toml")

    @cached_property
    def data(self) -> dict[str, xarray.Dataset]:
        """The data of the study, by the name of the ensemble."""
        return read_groups(self.folder / "data.nc", self.plan)

    @property
    def version(self) -> str:
        """Version of roughline that computed the data; "a and b" if they were several."""
        return version_of(self.data.values())

    def unsolved_loads(self) -> tuple[int, int]:
        """Return how many loads have no certified solution, and how many there are."""
        status = [each.status.values for each in self.data.values()]
        return sum(int((each != 0).sum()) for each in status), sum(each.size for each in status)

    def reduce(self, store: Path) -> None:
        """Reduce a finished store to the data."""
        write_groups(self.folder / "data.nc", self.plan, Store(store), self.variables)


def finished(store: Store, ensemble: Ensemble) -> xarray.Dataset:
    """Return an ensemble of a store, of the plan's settings, dimensions and realisations.

    A store may hold more than the plan asks for; the rest is left out. An ensemble that is not
    there, has other settings, or is not done is refused.
    """
    store.refuse_lost(ensemble.name)
    data = store.dataset(ensemble.name)
    refuse_other_settings(data.attrs, ensemble, str(store.path))
    there = set(data.fractal_dimension.values.tolist())
    wanted = [each for each in ensemble.fractal_dimensions if each in there]
    data = data.sel(fractal_dimension=wanted).isel(realisation=slice(ensemble.realisations))
    done = int(np.count_nonzero(data.case_status == DONE))
    if done < ensemble.cases:
        failed = store.counts(ensemble.name)[1]
        raise StoreError(
            f"{store.path}: {ensemble.cases - done} of {ensemble.cases} cases of "
            f"{ensemble.name!r} are not done, {failed} have failed; run the campaign again, it "
            "goes on from there"
        )
    return data


def write_groups(path: Path, plan: Plan, store: Store, names: Sequence[str]) -> None:
    """Write variables of all ensembles of a plan, a group for each, in single precision.

    Variables are kept as far as an ensemble has them; the file is written whole or not at all.
    """
    unwritten = path.with_suffix(".part")
    unwritten.unlink(missing_ok=True)
    groups = {each.name: finished(store, each) for each in plan.ensembles}
    xarray.Dataset(attrs={"study": plan.name}).to_netcdf(unwritten, engine="h5netcdf", mode="w")
    for name, data in groups.items():
        kept = data[[each for each in names if each in data]].drop_encoding()
        for variable in kept.data_vars.values():
            if variable.dtype == np.float64:
                attributes = variable.attrs
                kept[variable.name] = variable.astype(np.float32).assign_attrs(attributes)
        packed = {str(name): _PACKED for name in kept if kept[name].nbytes > _SMALL}
        kept.to_netcdf(unwritten, engine="h5netcdf", mode="a", group=name, encoding=packed)
    unwritten.replace(path)


def read_groups(path: Path, plan: Plan) -> dict[str, xarray.Dataset]:
    """Read the data of a study, a Dataset in double precision for each ensemble of its plan."""
    read = {}
    with _readable(path):
        for ensemble in plan.ensembles:
            try:
                with xarray.open_dataset(path, engine="h5netcdf", group=ensemble.name) as data:
                    read[ensemble.name] = data.load()
            except OSError as error:
                if "group not found" not in str(error):
                    raise
                raise StoreError(
                    f"{path} has no ensemble {ensemble.name!r}, which the plan has: {_AGAIN}"
                ) from error
    for ensemble in plan.ensembles:
        refuse_other_settings(read[ensemble.name].attrs, ensemble, str(path))
        _refuse_other_extent(read[ensemble.name], ensemble, str(path))
    return {name: _in_double(data) for name, data in read.items()}


def version_of(data: Iterable[xarray.Dataset]) -> str:
    """Return the version of roughline that computed some data; "a and b" if they were several."""
    return " and ".join(sorted({each.attrs["roughline_version"] for each in data}))


def write_one(path: Path, plan: dict[str, Any], data: xarray.Dataset) -> None:
    """Write data that are no ensembles, with the plan that they are made from."""
    unwritten = path.with_suffix(".part")
    data.assign_attrs(plan=json.dumps(plan)).to_netcdf(unwritten, engine="h5netcdf", mode="w")
    unwritten.replace(path)


def read_one(path: Path, plan: dict[str, Any]) -> xarray.Dataset:
    """Read data that are no ensembles; those that were made from another plan are refused."""
    with _readable(path), xarray.open_dataset(path, engine="h5netcdf") as data:
        read = data.load()
    before = json.loads(read.attrs["plan"])
    for key in sorted({*before, *plan}):
        if before.get(key) != plan.get(key):
            raise _other(str(path), "the study", key, before.get(key), plan.get(key))
    return read


@contextmanager
def _readable(path: Path) -> Iterator[None]:
    """Say in one line why a file of data cannot be read."""
    try:
        yield
    except FileNotFoundError as error:
        raise StoreError(f"{path} does not exist: {_AGAIN}") from error
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} is damaged ({error}): {_AGAIN}") from error


def refuse_other_settings(stored: dict[str, Any], ensemble: Ensemble, place: str) -> None:
    """Refuse attributes of data that are not the settings of an ensemble of the plan."""
    wanted = json.loads(json.dumps(ensemble.identity()))
    for key, value in wanted.items():
        found = stored.get(key)
        found = found.tolist() if isinstance(found, np.ndarray | np.generic) else found
        if found != value:
            raise _other(place, f"the ensemble {ensemble.name!r}", key, found, value)


def _refuse_other_extent(data: xarray.Dataset, ensemble: Ensemble, place: str) -> None:
    extents: Iterable[tuple[str, Any, Any]] = (
        (
            "fractal_dimensions",
            data.fractal_dimension.values.tolist(),
            sorted(ensemble.fractal_dimensions),
        ),
        ("realisations", data.sizes["realisation"], ensemble.realisations),
    )
    for key, found, wanted in extents:
        if found != wanted:
            raise _other(place, f"the ensemble {ensemble.name!r}", key, found, wanted)


def _other(place: str, what: str, key: str, found: Any, wanted: Any) -> StoreError:
    return StoreError(
        f"{place}: {what} has {key} = {_short(found)}, the plan has {_short(wanted)}: {_AGAIN}"
    )


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _in_double(data: xarray.Dataset) -> xarray.Dataset:
    def in_double(each: xarray.DataArray) -> xarray.DataArray:
        return each.astype(np.float64) if each.dtype == np.float32 else each

    return data.map(in_double, keep_attrs=True)
