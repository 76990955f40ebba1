"""Writing results: the only writer of data.

Chunks are replaced as a whole and carry checksums. The mark of a case, in ``case_status``, is
written after all its values and their digest, so a case counts only when all of it is on disk. What
was damaged later is found before a campaign goes on, and its cases are computed again.

What xarray looks at first is a copy of all metadata in one file. It is taken away before arrays are
made or enlarged, and made again before anything is computed, so it is never that of smaller arrays.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline._version import __version__
from roughline.campaign.batch import Batch, BatchResult
from roughline.campaign.cost import chunk_shape
from roughline.campaign.digest import digests, lost_cases
from roughline.campaign.layout import (
    CASE_DIGEST,
    CASE_STATUS,
    COORDINATES,
    DONE,
    FAILED,
    FORMAT,
    PENDING,
    Variable,
    codecs,
    stored_variables,
)
from roughline.campaign.plan import BODIES, Ensemble, Plan
from roughline.campaign.store import (
    coordinate_values,
    damaged_or_foreign,
    opened,
    read_filled,
    read_or_none,
)
from roughline.errors import StoreError


class Writer:
    """A store that one campaign has locked for writing; made by :func:`writing`."""

    def __init__(self, path: Path, plan: Plan) -> None:
        self._path = path
        self._root = opened(path, "r+")
        try:
            for ensemble in plan.ensembles:
                _refuse_other_settings(self._root, ensemble, path)
            self._root.update_attributes({})  # writes them without the copy of all metadata
            self._groups = {
                ensemble.name: _prepared_group(self._root, ensemble) for ensemble in plan.ensembles
            }
            gather_metadata(path)
            # kept open: to open an array takes longer than to write a chunk
            self._arrays = {name: dict(group.arrays()) for name, group in self._groups.items()}
            for name, arrays in self._arrays.items():
                _mend(arrays, np.array(self._groups[name].attrs["fractal_dimensions"]))
        except (ValueError, KeyError, TypeError) as error:
            raise damaged_or_foreign(path) from error

    def missing(self, ensemble: Ensemble) -> list[Batch]:
        """List what is not done, a batch for each chunk; cases that failed are tried again."""
        marks = self._arrays[ensemble.name][CASE_STATUS.name]
        stored = self._groups[ensemble.name].attrs["fractal_dimensions"]
        rows = [stored.index(dimension) for dimension in ensemble.fractal_dimensions]
        wanted = np.zeros(marks.shape, dtype=bool)
        wanted[rows, : ensemble.realisations] = True
        wanted &= marks[:] != DONE
        high, wide = marks.chunks
        corners = product(range(0, wanted.shape[1], wide), range(0, wanted.shape[0], high))
        dimensions, batches = np.array(stored), []
        for column, row in corners:
            cells = np.argwhere(wanted[row : row + high, column : column + wide])
            cells += np.array((row, column))
            if len(cells):
                batches.append(Batch(ensemble, cells, dimensions[cells[:, 0]]))
        return batches

    def put(self, batch: Batch, result: BatchResult) -> None:
        """Write a batch: values and digests first, reasons of failures next, marks last."""
        arrays = self._arrays[batch.ensemble.name]
        failed = list(result.failures)
        marks = np.full(len(batch.cells), DONE)
        marks[failed] = FAILED
        values = dict(result.results)
        if values and CASE_DIGEST.name in arrays:
            found = digests(batch.fractal_dimensions, batch.cells[:, 1], values)
            found[failed] = CASE_DIGEST.fill
            values[CASE_DIGEST.name] = found
        try:
            for name, each in values.items():
                _write_cells(arrays[name], batch.cells, each)
            self._write_failures(batch, result.failures)
            _write_cells(arrays[CASE_STATUS.name], batch.cells, marks)
        except OSError as error:
            raise _unwritable(self._path, error) from error

    def _write_failures(self, batch: Batch, failures: dict[int, str]) -> None:
        """Write why cases failed, and forget the reasons of cases that are done now."""
        group = self._groups[batch.ensemble.name]
        before = dict(group.attrs["failures"])
        if not (before or failures):
            return
        names = [
            f"D_f {dimension:g}, realisation {realisation}"
            for dimension, realisation in zip(
                batch.fractal_dimensions, batch.cells[:, 1], strict=True
            )
        ]
        after = {name: why for name, why in before.items() if name not in set(names)}
        after |= {names[i]: why for i, why in failures.items()}
        if after != before:
            group.attrs["failures"] = dict(sorted(after.items()))
            gather_metadata(self._path)


@contextmanager
def writing(path: Path, plan: Plan) -> Iterator[Writer]:
    """Lock a store for writing; it is made, enlarged or repaired as the plan needs."""
    import zarr

    with locked(path):
        if path.is_dir() and any(path.iterdir()):
            for leftover in path.rglob("*.partial"):  # of a writer that was killed
                leftover.unlink()
        if not path.exists() or (path.is_dir() and not any(path.iterdir())):
            marks = {"roughline_store": FORMAT, "roughline_version": __version__}
            zarr.create_group(path, attributes=marks)
        yield Writer(path, plan)


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Lock a store for writing by one process."""
    import filelock

    lock = filelock.FileLock(path.parent / f".{path.name}.lock", timeout=0)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        lock.acquire()
    except filelock.Timeout:
        raise StoreError(
            f"{path} is in use by another campaign: wait for it to end, or choose another folder"
        ) from None
    except OSError as error:
        raise _unwritable(path, error) from error
    try:
        yield
    except OSError as error:
        raise _unwritable(path, error) from error
    finally:
        lock.release()


def gather_metadata(path: Path) -> None:
    """Copy the metadata of all groups to where xarray looks first."""
    import zarr

    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Consolidated metadata is currently not part")
        zarr.consolidate_metadata(path)


def _write_cells(array: Any, cells: NDArray[np.intp], values: NDArray[Any]) -> None:
    """Write cells of one chunk, leaving the others as they are."""
    low, high = cells.min(axis=0), cells.max(axis=0) + 1
    region = tuple(slice(a, b) for a, b in zip(low.tolist(), high.tolist(), strict=True))
    if len(cells) == np.prod(high - low):
        block = np.empty((*(high - low), *values.shape[1:]), dtype=array.dtype)
    else:
        block = array[region]
    block[tuple((cells - low).T)] = values
    array[region] = block


def _unwritable(path: Path, error: OSError) -> StoreError:
    return StoreError(
        f"cannot write to {path} ({error.strerror or error}): make room or choose another "
        "folder; what is done is kept"
    )


def _refuse_other_settings(root: Any, ensemble: Ensemble, path: Path) -> None:
    """Refuse a store that holds results under an ensemble's name but with other settings.

    Where nothing was computed under that name yet, its group is removed instead.
    """
    if ensemble.name not in root:
        return
    # of elastic bodies of one material, neither the settings nor what is stored names more
    wanted = {**dict.fromkeys(BODIES), **json.loads(json.dumps(ensemble.identity()))}
    group = root[ensemble.name]
    stored = _with_law(dict(group.attrs))
    if {key: stored.get(key) for key in wanted} == wanted:
        return
    if CASE_STATUS.name not in group or (group[CASE_STATUS.name][:] == PENDING).all():
        del root[ensemble.name]
        return
    for key, value in wanted.items():
        if stored.get(key) != value:
            raise StoreError(
                f"{path} holds an ensemble {ensemble.name!r} with other settings: its {key} "
                f"is {_short(stored.get(key))}, the plan's is {_short(value)}; rename the "
                "ensemble, or choose another folder"
            )


def _with_law(stored: dict[str, Any]) -> dict[str, Any]:
    """Return settings with the law of bodies that stick, of which 0.3 stored the numbers."""
    if "attraction" not in stored:
        return stored
    name = stored["attraction"].capitalize()
    numbers = {"work_of_adhesion": stored["work_bar"], "range": stored["range_bar"]}
    return {**stored, "law": {"name": name, **numbers}}


def _prepared_group(root: Any, ensemble: Ensemble) -> Any:
    """Return the group of an ensemble, made or enlarged; nothing that is there changes."""
    if ensemble.name not in root:
        attributes = {
            **json.loads(json.dumps(ensemble.identity())),
            **_descriptions(ensemble),
            "fractal_dimensions": [],
            "failures": {},
        }
        root.create_group(ensemble.name, attributes=attributes)
    group = root[ensemble.name]
    before = list(group.attrs["fractal_dimensions"])
    known = before + [value for value in ensemble.fractal_dimensions if value not in before]
    if known != before:
        group.attrs["fractal_dimensions"] = known
    before_digests = CASE_STATUS.name in group and CASE_DIGEST.name not in group
    stored = group[CASE_STATUS.name].shape[1] if CASE_STATUS.name in group else 0
    realisations = max(ensemble.realisations, stored)
    for name, value in coordinate_values(group, (len(known), realisations)).items():
        array = _prepared_array(group, COORDINATES[name], value.shape, value.shape)
        stored_value = read_or_none(array)
        if stored_value is None or not np.array_equal(stored_value, value):
            array[:] = value
    shape = (len(known), realisations, len(ensemble.force_bars))
    chunks = (*chunk_shape(ensemble), len(ensemble.force_bars))
    of_cases = (CASE_STATUS,) if before_digests else (CASE_DIGEST, CASE_STATUS)
    # marks last: who reads meanwhile finds all else as large as they are
    for variable in (*stored_variables(ensemble), *of_cases):
        rank = len(variable.dims)
        _prepared_array(group, variable, shape[:rank], tuple(map(min, chunks, shape[:rank])))
    return group


def _prepared_array(
    group: Any, variable: Variable, shape: tuple[int, ...], chunks: tuple[int, ...]
) -> Any:
    """Return an array of the group, made or enlarged where needed."""
    if variable.name not in group:
        return group.create_array(
            variable.name,
            shape=shape,
            chunks=chunks,
            dtype=variable.dtype,
            fill_value=variable.fill,
            dimension_names=variable.dims,
            attributes=variable.attributes,
            **codecs(),
        )
    array = group[variable.name]
    if array.shape != shape:
        array.resize(shape)
    return array


def _descriptions(ensemble: Ensemble) -> dict[str, Any]:
    """Return what a reader wants to know besides the settings themselves."""
    end = "pi / spacing" if ensemble.cutoff_ratio is None else "cutoff_ratio * 2 pi / L"
    return {
        "roughline_version": __version__,
        "heights": "random phases, fixed moduli, scaled to rms 1; length L = 1, E* = 1",
        "spectrum": f"self-affine from roll_off_ratio * 2 pi / L to {end}, flat below",
    }


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _mend(arrays: Mapping[str, Any], dimensions: NDArray[np.float64]) -> None:
    """Empty chunks that cannot be read, and mark cases that are lost as not done."""
    values = {}
    for name, array in arrays.items():
        values[name], unreadable = read_filled(array)
        for region in unreadable:
            array[region] = values[name][region]
    marks = values[CASE_STATUS.name]
    lost = lost_cases(dimensions, marks, values)
    if lost.any():
        marks[lost] = PENDING
        arrays[CASE_STATUS.name][:] = marks
