"""Mending a store that something damaged: what cannot be read is emptied, to be computed again."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.campaign.layout import DONE, PENDING, PER_BODY, VARIABLES


def mend(arrays: Mapping[str, Any]) -> None:
    """Empty chunks that cannot be read, and take back the marks of all that is not whole."""
    values = {name: _read_mended(array) for name, array in arrays.items()}
    status = values["case_status"]
    whole = np.ones(status.shape, dtype=bool)
    for name in VARIABLES:
        if name not in arrays:
            continue
        if name in ("status", "resolved"):
            whole &= (values[name] >= 0).all(axis=-1)
        elif name in PER_BODY:
            whole &= np.isfinite(values[name])
        else:
            whole &= (np.isfinite(values[name]) == (values["status"] == 0)).all(axis=-1)
    lost = (status == DONE) & ~whole
    if lost.any():
        status[lost] = PENDING
        arrays["case_status"][:] = status


def _read_mended(array: Any) -> NDArray[Any]:
    """Values of an array; chunks that cannot be read get their fill value again."""
    found = read_or_none(array)
    if found is not None:
        return found
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
    """Values of an array, or None if a chunk is damaged."""
    try:
        return array[:]
    except (OSError, ValueError, RuntimeError):
        return None
