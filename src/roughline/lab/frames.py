"""Answers as one binary message: a JSON header, and arrays behind it as the browser reads them."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from hashlib import sha256
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.lab.maps import Map
from roughline.lab.panels import PanelContent
from roughline.report.json_output import plain

_ALIGNMENT = 8  # typed arrays of a browser begin at multiples of their items
_STEPS = 2**16 - 2  # from the lowest number of a map to the highest


def frame(
    header: Mapping[str, Any],
    arrays: Mapping[str, NDArray[Any]] | None = None,
    above: Mapping[str, str] | None = None,
    held: Collection[str] = (),
) -> bytes:
    """Put a header and arrays into one message, without those that are held already.

    It is the length of the header (4 bytes, least first), the header as JSON with the type, shape
    and place of each array, padding, and the arrays. Numbers that JSON has not become null; arrays
    other than those of 8-bit or 32-bit unsigned numbers are :func:`packed` in 16 bits. One that is
    counted `above` another, by their names, is packed as the sum of both, where that is smoother.
    """
    above = above or {}
    chunks, places, offset = [], {}, 0
    arrays = arrays or {}
    for name in [each for each in arrays if each not in held]:
        values = arrays[name]
        place: dict[str, Any] = {"dtype": str(values.dtype), "shape": values.shape}
        if values.dtype in (np.uint8, np.uint32):
            content = np.ascontiguousarray(values).tobytes()
        else:
            below = arrays[above[name]] if name in above else 0.0
            low, step, content = packed(values + below)
            place |= {"dtype": "packed", "low": low, "step": step, "above": above.get(name, "")}
        places[name] = {**place, "offset": offset}
        padding = -len(content) % _ALIGNMENT
        chunks.append(content + bytes(padding))
        offset += len(content) + padding
    text = json.dumps(plain({**header, "arrays": places}), allow_nan=False).encode()
    text += b" " * (-(len(text) + 4) % _ALIGNMENT)
    return b"".join([len(text).to_bytes(4, "little"), text, *chunks])


def packed(values: NDArray[np.floating[Any]]) -> tuple[float, float, bytes]:
    """A map in steps from its lowest number, 16 bits each, so that little is left to compress.

    A number is `low` + `step` (q - 1) with a whole number q from 1 on, and q = 0 where none is
    known. Of q the second differences along both axes are written, modulo 2^16, the positive and
    the negative by turns from zero on, first all upper bytes, then all lower ones: neighbours on a
    surface are alike, so that most upper bytes are zero.
    """
    known = np.isfinite(values)
    some = values[known]
    low, high = (float(some.min()), float(some.max())) if some.size else (0.0, 0.0)
    step = (high - low) / _STEPS or 1.0
    q = np.zeros(values.shape, np.uint16)
    q[known] = np.rint((some - low) / step) + 1
    for axis in (1, 0):
        q = np.diff(q, axis=axis, prepend=np.uint16(0))
    signed = q.astype(np.int16)
    turned = ((signed << 1) ^ (signed >> 15)).astype(np.uint16)
    return low, step, (turned >> 8).astype(np.uint8).tobytes() + turned.astype(np.uint8).tobytes()


def drawn(
    header: Mapping[str, Any],
    panels: Mapping[str, PanelContent],
    maps: Mapping[str, Map],
    above: Mapping[str, str] | None = None,
    held: Collection[str] = (),
) -> bytes:
    """Put what panels and maps show into a message with a header.

    Numbers of maps are packed as sums if they are counted `above` those of another, and are left
    out of maps that the page has `held`, by their names.
    """
    looks = {
        "panels": {key: vars(each) for key, each in panels.items()},
        "maps": {name: each.look for name, each in maps.items()},
    }
    # rows of an image run along x
    arrays = {name: each.values.T for name, each in maps.items()}
    return frame({**header, **looks}, arrays, above, held)


def digest(asked: object) -> str:
    """A short name for what is asked."""
    return sha256(repr(asked).encode()).hexdigest()[:12]
