"""Answers as one binary message: a JSON header, and arrays behind it as the browser reads them."""

from __future__ import annotations

import json
import zlib
from collections.abc import Collection, Mapping
from hashlib import sha256
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.lab.maps import Map
from roughline.lab.panels import PanelContent
from roughline.lab.server.tasks import PACKING
from roughline.report.json_output import plain

MOST_SENT = 600_000  # of an answer with maps, unless the coarsest steps need more [bytes]
_ALIGNMENT = 8  # typed arrays of a browser begin at multiples of their items
_STEPS = (2**16 - 1, 2**13 - 1, 2**11 - 1, 2**10 - 1)
"""In how many steps maps are sent: the most with which the line takes the answer. A page tells no
digit that is finer than a step, and shows 256 colours."""


def frame(
    header: Mapping[str, Any],
    arrays: Mapping[str, NDArray[Any]] | None = None,
    above: Mapping[str, str] | None = None,
    held: Collection[str] = (),
    steps: int = _STEPS[0],
) -> bytes:
    """Put a header and arrays into one message, without those that are held already.

    It is the length of the header (4 bytes, least first), the header as JSON with the type, shape
    and place of each array, padding, and the arrays. Numbers that JSON has not become null; arrays
    other than those of 8-bit or 32-bit unsigned numbers are :func:`packed` in so many `steps`. One
    that is counted `above` another, by their names, is packed as the sum of both, where that is
    smoother.
    """
    above, arrays = above or {}, arrays or {}
    chunks, places, offset = [], {}, 0
    for name in [each for each in arrays if each not in held]:
        values = arrays[name]
        place: dict[str, Any] = {"dtype": str(values.dtype), "shape": values.shape}
        if values.dtype in (np.uint8, np.uint32):
            content = np.ascontiguousarray(values).tobytes()
        else:
            below = arrays[above[name]] if name in above else 0.0
            low, step, content = packed(values + below, steps)
            place |= {"dtype": "packed", "low": low, "step": step, "above": above.get(name, "")}
        places[name] = {**place, "offset": offset}
        padding = -len(content) % _ALIGNMENT
        chunks.append(content + bytes(padding))
        offset += len(content) + padding
    text = json.dumps(plain({**header, "arrays": places}), allow_nan=False).encode()
    text += b" " * (-(len(text) + 4) % _ALIGNMENT)
    return b"".join([len(text).to_bytes(4, "little"), text, *chunks])


def packed(values: NDArray[np.floating[Any]], steps: int) -> tuple[float, float, bytes]:
    """A map in some `steps` from its lowest number to its highest, so that little is left to send.

    A number is `low` + `step` q with a whole number q. Of q the second differences along both axes
    are written, modulo 2^16, the positive and the negative by turns from zero on, first all upper
    bytes, then all lower ones: neighbours on a surface are alike, so that most upper bytes are
    zero. Then comes a bit for each number, eight in a byte, the first the highest: set where none
    is known. There q goes on along the rows from one known number to the next, which costs least.
    """
    known = np.isfinite(values)
    some, places = values[known], np.flatnonzero(known)
    low, high = (float(some.min()), float(some.max())) if some.size else (0.0, 0.0)
    step = (high - low) / steps
    filled = np.zeros(values.size)
    if some.size:
        filled = np.interp(np.arange(values.size), places, (some - low) / (step or 1.0))
    q = np.rint(filled).astype(np.uint16).reshape(values.shape)
    for axis in (1, 0):
        q = np.diff(q, axis=axis, prepend=np.uint16(0))
    signed = q.astype(np.int16)
    turned = ((signed << 1) ^ (signed >> 15)).astype(np.uint16)
    upper, lower = (turned >> 8).astype(np.uint8), turned.astype(np.uint8)
    return low, step, upper.tobytes() + lower.tobytes() + np.packbits(~known).tobytes()


def drawn(
    header: Mapping[str, Any],
    panels: Mapping[str, PanelContent],
    maps: Mapping[str, Map],
    above: Mapping[str, str] | None = None,
    held: Collection[str] = (),
) -> bytes:
    """Put what panels and maps show into a message with a header.

    Numbers of maps are packed as sums if they are counted `above` those of another, and are left
    out of maps that the page has `held`, by their names. Their steps are as fine as `MOST_SENT`
    allows.
    """
    looks = {
        "panels": {key: vars(each) for key, each in panels.items()},
        "maps": {name: each.look for name, each in maps.items()},
    }
    # rows of an image run along x
    arrays = {name: each.values.T for name, each in maps.items()}
    for steps in _STEPS:
        message = frame({**header, **looks}, arrays, above, held, steps)
        if len(message) <= MOST_SENT or sent_bytes(message) <= MOST_SENT:
            break
    return message


def sent_bytes(message: bytes) -> int:
    """How many bytes of a message cross the line, as a websocket packs them."""
    packing = zlib.compressobj(PACKING, zlib.DEFLATED, -zlib.MAX_WBITS)
    return len(packing.compress(message)) + len(packing.flush())


def digest(asked: object) -> str:
    """A short name for what is asked."""
    return sha256(repr(asked).encode()).hexdigest()[:12]
