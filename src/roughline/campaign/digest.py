"""The digest of a case, by which values that were lost, or lie in another's place, are seen.

A chunk's own checksum tells that it was cut off or altered, not that it is missing, as a chunk of
fill values may be, or that it is a whole chunk of other cases.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.campaign.layout import CASE_DIGEST, DONE, VARIABLES
from roughline.contact.status import Status


def digests(
    dimensions: NDArray[np.float64], realisations: NDArray[Any], values: Mapping[str, NDArray[Any]]
) -> NDArray[np.int64]:
    """Return the CRC-32 of each case: of which body it is, and of all its values.

    Parameters
    ----------
    dimensions, realisations : ndarray, shape (n,)
        Fractal dimension and realisation of each case.
    values : mapping
        Its variables by name, of shape (n,) or (n, loads).
    """
    parts = [dimensions.astype("<f8"), realisations.astype("<i8")]
    # a chunk in which all is NaN is not written, so bits that differ between NaNs are not kept
    parts += [
        np.where(np.isnan(values[name]), np.nan, values[name]).astype(f"<{variable.dtype}")
        for name, variable in VARIABLES.items()
        if name in values
    ]
    rows = [
        np.ascontiguousarray(part).reshape(len(part), math.prod(part.shape[1:])).view(np.uint8)
        for part in parts
    ]
    return np.array([zlib.crc32(row) for row in np.concatenate(rows, axis=1)], dtype=np.int64)


def lost_cases(
    dimensions: NDArray[np.float64], marks: NDArray[Any], values: Mapping[str, NDArray[Any]]
) -> NDArray[np.bool_]:
    """Return which cases are marked as done and are not what was computed.

    Parameters
    ----------
    dimensions : ndarray, shape (d,)
        Fractal dimensions, in the order of the store.
    marks : ndarray, shape (d, realisations)
        Marks of the cases.
    values : mapping
        Variables and digests by name, over (d, realisations) or (d, realisations, loads). Stores of
        before there were digests have none; in these, only values that are missing are seen.
    """
    lost = (marks == DONE) & ~_complete(values)
    if CASE_DIGEST.name in values:
        row, column = done = np.nonzero(marks == DONE)
        of_done = {name: values[name][done] for name in VARIABLES if name in values}
        found = digests(dimensions[row], column, of_done)
        lost[done] |= found != values[CASE_DIGEST.name][done]
    return lost


def _complete(values: Mapping[str, NDArray[Any]]) -> NDArray[np.bool_]:
    """Return which cases have every value that a finished case has."""
    status = values["status"]
    complete = np.ones(status.shape[:2], dtype=bool)
    for name, variable in VARIABLES.items():
        if name not in values:
            continue
        if variable.per_body:
            complete &= np.isfinite(values[name])
        elif variable.dtype == "f8":
            # a periodic surface in full contact is infinitely stiff
            complete &= (np.isnan(values[name]) != (status == Status.CONVERGED)).all(axis=-1)
        else:
            complete &= (values[name] >= 0).all(axis=-1)
    return complete
