"""Repairing a damaged store: chunks that cannot be read are emptied, to be computed again."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.campaign.layout import CASE_STATUS, DONE, PENDING, VARIABLES
from roughline.contact.status import Status


def mend(arrays: Mapping[str, Any]) -> None:
    """Empty chunks that cannot be read, and mark all cases that are not whole as not done."""
    values = {name: _read_mended(array) for name, array in arrays.items()}
    marks = values[CASE_STATUS.name]
    whole = np.ones(marks.shape, dtype=bool)
    for name, variable in VARIABLES.items():
        if name not in arrays:
            continue
        if variable.per_body:
            whole &= np.isfinite(values[name])
        elif variable.dtype == "f8":
            solved = values["status"] == Status.CONVERGED
            # a periodic surface in full contact is infinitely stiff
            whole &= (np.isnan(values[name]) != solved).all(axis=-1)
        else:
            whole &= (values[name] >= 0).all(axis=-1)
    lost = (marks == DONE) & ~whole
    if lost.any():
        marks[lost] = PENDING
        arrays[CASE_STATUS.name][:] = marks


def _read_mended(array: Any) -> NDArray[Any]:
    """Return the values of an array; chunks that cannot be read get their fill value again."""
    values = read_or_none(array)
    if values is not None:
        return values
    steps = [range(0, size, chunk) for size, chunk in zip(array.shape, array.chunks, strict=True)]
    for corner in product(*steps):
        region = tuple(slice(a, a + b) for a, b in zip(corner, array.chunks, strict=True))
        try:
            array[region]
        except (OSError, ValueError, RuntimeError):
            shape = [
                min(chunk, size - start)
                for start, chunk, size in zip(corner, array.chunks, array.shape, strict=True)
            ]
            array[region] = np.full(shape, array.fill_value, dtype=array.dtype)
    return array[:]


def read_or_none(array: Any) -> NDArray[Any] | None:
    """Return the values of an array, or None if a chunk is damaged."""
    try:
        return array[:]
    except (OSError, ValueError, RuntimeError):
        return None
