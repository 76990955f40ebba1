"""Writing results: the only writer of data.

Chunks are replaced as a whole and carry checksums. The mark of a case, in ``case_status``, is
written after all its values, so a case counts only when all of it is on disk; chunks that were
damaged later are found and emptied before a campaign goes on, and their cases computed again.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline._version import __version__
from roughline.campaign.batch import Batch, Outcome, Results
from roughline.campaign.cost import chunk_shape
from roughline.campaign.layout import (
    COORDINATES,
    DIMENSIONS,
    DONE,
    FAILED,
    FORMAT,
    GALLERY,
    GALLERY_DIMENSIONS,
    PENDING,
    PER_BODY,
    VARIABLES,
    variables_of,
)
from roughline.campaign.mending import mend, read_or_none
from roughline.campaign.plan import Ensemble, Gallery, Plan
from roughline.campaign.store import Store, damaged_or_foreign
from roughline.errors import StoreError


class Writer(Store):
    """A store that is held, for writing, by one campaign; made by :func:`writing`."""

    def __init__(self, path: Path, plan: Plan) -> None:
        super().__init__(path)
        self.plan = plan
        try:
            for ensemble in plan.ensembles:
                self._refuse_others(ensemble)
            self._groups = {ensemble.name: self._prepared(ensemble) for ensemble in plan.ensembles}
            # kept open: to open an array takes longer than to write a chunk
            self._arrays = {name: dict(group.arrays()) for name, group in self._groups.items()}
            for arrays in self._arrays.values():
                mend(arrays)
            if self.has_gallery and not self._gallery_is_whole(plan.gallery):
                self._root.attrs["gallery_done"] = False
        except (ValueError, KeyError, TypeError) as error:
            raise damaged_or_foreign(path) from error

    def missing(self, ensemble: Ensemble) -> list[Batch]:
        """List what is not done, a batch for each chunk; cases that failed are tried again."""
        marks = self._arrays[ensemble.name]["case_status"]
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

    def put(self, batch: Batch, outcome: Outcome) -> None:
        """Write a batch: values first, reasons of failures next, marks last.

        Raises
        ------
        StoreError
            If the disk is full or the folder cannot be written; what was there stays.
        """
        arrays = self._arrays[batch.ensemble.name]
        marks = np.full(len(batch.cells), DONE)
        marks[list(outcome.failures)] = FAILED
        try:
            for name, values in outcome.results.items():
                _write_cells(arrays[name], batch.cells, values)
            self._note(self._groups[batch.ensemble.name], batch, outcome.failures)
            _write_cells(arrays["case_status"], batch.cells, marks)
        except OSError as error:
            raise _unwritable(self.path, error) from error

    def put_gallery(self, gallery: Gallery, results: Results) -> None:
        """Write the gallery."""
        try:
            group = self._root.require_group(GALLERY)
            group.attrs.update(_gallery_settings(gallery))
            coordinate = np.array(gallery.fractal_dimensions)
            for name, values in {**results, "fractal_dimension": coordinate}.items():
                group.create_array(
                    name,
                    data=values,
                    dimension_names=GALLERY_DIMENSIONS.get(name, ("fractal_dimension",)),
                    overwrite=True,
                    **_codecs(),
                )
            self._root.attrs["gallery_done"] = True
        except OSError as error:
            raise _unwritable(self.path, error) from error

    def consolidate(self) -> None:
        """Gather the metadata of all groups in one place, where xarray looks first."""
        import zarr

        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Consolidated metadata is currently not part")
            zarr.consolidate_metadata(self.path)

    def _note(self, group: Any, batch: Batch, failures: dict[int, str]) -> None:
        before = dict(group.attrs["failures"])
        if not (before or failures):
            return
        named = [
            f"D_f {dimension:g}, realisation {realisation}"
            for dimension, realisation in zip(
                batch.fractal_dimensions, batch.cells[:, 1], strict=True
            )
        ]
        after = {key: why for key, why in before.items() if key not in set(named)}
        after |= {named[i]: why for i, why in failures.items()}
        if after != before:
            group.attrs["failures"] = dict(sorted(after.items()))

    def _refuse_others(self, ensemble: Ensemble) -> None:
        """Raise if the store holds results of that name and other settings.

        Where nothing was computed under the name yet, the settings give way.
        """
        if ensemble.name not in self._root:
            return
        wanted = json.loads(json.dumps(ensemble.identity()))
        group = self._root[ensemble.name]
        found = group.attrs
        if {key: found.get(key) for key in wanted} == wanted:
            return
        if "case_status" not in group or (group["case_status"][:] == PENDING).all():
            del self._root[ensemble.name]
            return
        for key, value in wanted.items():
            if found.get(key) != value:
                raise StoreError(
                    f"{self.path} holds an ensemble {ensemble.name!r} of other settings: its {key} "
                    f"is {_short(found.get(key))}, the plan's is {_short(value)}; rename the "
                    "ensemble, or choose another folder"
                )

    def _prepared(self, ensemble: Ensemble) -> Any:
        """Return the group of an ensemble, made or enlarged; nothing that is there changes."""
        if ensemble.name not in self._root:
            attributes = {
                **json.loads(json.dumps(ensemble.identity())),
                **_descriptions(ensemble),
                "fractal_dimensions": [],
                "failures": {},
            }
            self._root.create_group(ensemble.name, attributes=attributes)
        group = self._root[ensemble.name]
        before = list(group.attrs["fractal_dimensions"])
        known = before + [value for value in ensemble.fractal_dimensions if value not in before]
        if known != before:
            group.attrs["fractal_dimensions"] = known
        there = group["case_status"].shape[1] if "case_status" in group else 0
        realisations = max(ensemble.realisations, there)
        shape = (len(known), realisations, len(ensemble.force_bars))
        chunks = (*chunk_shape(ensemble), len(ensemble.force_bars))
        for name in variables_of(ensemble):
            dtype, fill, meaning = VARIABLES[name]
            rank = 2 if name in PER_BODY else 3
            _array(group, name, shape[:rank], chunks[:rank], dtype, fill, meaning)
        meaning = "0 not done, 1 done, 2 failed (reasons in the group's attribute failures)"
        _array(group, "case_status", shape[:2], chunks[:2], "i1", PENDING, meaning)
        values = (np.array(known), np.arange(realisations), np.array(ensemble.force_bars))
        for name, value in zip(DIMENSIONS, values, strict=True):
            fill = -1 if name == "realisation" else np.nan
            array = _array(group, name, value.shape, (2**16,), value.dtype, fill, COORDINATES[name])
            found_value = read_or_none(array)
            if found_value is None or not np.array_equal(found_value, value):
                array[:] = value
        return group

    def _gallery_is_whole(self, gallery: Gallery | None) -> bool:
        if gallery is None:
            return True
        group = self._root[GALLERY]
        wanted = json.loads(json.dumps(_gallery_settings(gallery)))
        if {key: group.attrs.get(key) for key in wanted} != wanted:
            raise StoreError(
                f"{self.path} holds a gallery of other settings; choose another folder"
            )
        return all(read_or_none(group[name]) is not None for name in GALLERY_DIMENSIONS)


@contextmanager
def writing(path: str | Path, plan: Plan) -> Iterator[Writer]:
    """Hold a store for writing; it is made, enlarged or mended as the plan needs.

    Parameters
    ----------
    path : str or Path
        The folder.
    plan : Plan
        What is to be stored.

    Raises
    ------
    StoreError
        If the folder is held by another campaign, belongs to something else, holds other
        settings or another version, or cannot be written.
    """
    import filelock
    import zarr

    path = Path(path)
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
        if path.is_dir() and any(path.iterdir()):
            for leftover in path.rglob("*.partial"):  # of a writer that was killed
                leftover.unlink()
        if not path.exists() or (path.is_dir() and not any(path.iterdir())):
            marks = {"roughline_store": FORMAT, "roughline_version": __version__}
            zarr.create_group(path, attributes=marks)
        writer = Writer(path, plan)
        yield writer
        writer.consolidate()
    except OSError as error:
        raise _unwritable(path, error) from error
    finally:
        lock.release()


def _array(
    group: Any,
    name: str,
    shape: tuple[int, ...],
    chunks: tuple[int, ...],
    dtype: Any,
    fill: float,
    meaning: str,
) -> Any:
    """Return an array of the group, made or enlarged where needed."""
    if name not in group:
        return group.create_array(
            name,
            shape=shape,
            chunks=tuple(map(min, chunks, shape)) if len(shape) > 1 else shape,
            dtype=dtype,
            fill_value=fill,
            dimension_names=DIMENSIONS[: len(shape)] if name not in COORDINATES else (name,),
            attributes={"long_name": meaning, "units": "1"},
            **_codecs(),
        )
    array = group[name]
    if array.shape != shape:
        array.resize(shape)
    return array


def _codecs() -> dict[str, Any]:
    from zarr.codecs import Crc32cCodec, ZstdCodec

    return {"compressors": (ZstdCodec(level=1), Crc32cCodec())}


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


def _gallery_settings(gallery: Gallery) -> dict[str, Any]:
    return {
        "n": gallery.n,
        "n_line": gallery.n_line,
        "force_bar": gallery.force_bar,
        "seed": gallery.seed,
        "fractal_dimensions": list(gallery.fractal_dimensions),
        "roughline_version": __version__,
    }


def _descriptions(ensemble: Ensemble) -> dict[str, Any]:
    """What a reader wants to know besides the settings themselves."""
    end = "pi / spacing" if ensemble.cutoff_ratio is None else "cutoff_ratio * 2 pi / L"
    return {
        "roughline_version": __version__,
        "heights": "random phases, fixed moduli, scaled to rms 1; length L = 1, E* = 1",
        "spectrum": f"self-affine from roll_off_ratio * 2 pi / L to {end}, flat below",
    }


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _unwritable(path: Path, error: OSError) -> StoreError:
    return StoreError(
        f"cannot write to {path} ({error.strerror or error}): make room or choose another "
        "folder; what is done is kept"
    )
