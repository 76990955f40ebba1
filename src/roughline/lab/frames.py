"""Answers as one binary message: a JSON header, and arrays behind it as the browser reads them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.lab.maps import Map
from roughline.lab.panels import PanelContent
from roughline.report.json_output import plain

_ALIGNMENT = 8  # typed arrays of a browser begin at multiples of their items


def frame(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]] | None = None) -> bytes:
    """Put a header and arrays into one message.

    It is the length of the header (4 bytes, least first), the header as JSON with the type, shape
    and place of each array, padding, and the arrays. Numbers that JSON has not become null; arrays
    other than those of 8-bit or 32-bit unsigned numbers become single precision.
    """
    chunks, places, offset = [], {}, 0
    for name, values in (arrays or {}).items():
        stored = values if values.dtype in (np.uint8, np.uint32) else values.astype(np.float32)
        content = np.ascontiguousarray(stored).tobytes()
        places[name] = {"dtype": str(stored.dtype), "shape": stored.shape, "offset": offset}
        padding = -len(content) % _ALIGNMENT
        chunks.append(content + bytes(padding))
        offset += len(content) + padding
    text = json.dumps(plain({**header, "arrays": places}), allow_nan=False).encode()
    text += b" " * (-(len(text) + 4) % _ALIGNMENT)
    return b"".join([len(text).to_bytes(4, "little"), text, *chunks])


def drawn(
    header: Mapping[str, Any],
    panels: Mapping[str, PanelContent],
    maps: Mapping[str, Map],
    arrays: Mapping[str, NDArray[Any]] | None = None,
) -> bytes:
    """Put what panels and maps show into a message with a header, and further arrays."""
    arrays = {**(arrays or {}), **{name: each.values for name, each in maps.items()}}
    looks = {
        "panels": {key: vars(each) for key, each in panels.items()},
        "maps": {name: each.look for name, each in maps.items()},
    }
    # rows of an image run along x
    return frame({**header, **looks}, {name: values.T for name, values in arrays.items()})
