"""Messages of the lab as the page reads them."""

import json

import numpy as np

HALF_A_STEP = 0.5001 / (2**16 - 1)  # of a small map, over its range: that far numbers may be off


def unpacked(message, **held):
    """The header of a message, and its arrays by name; some were held before."""
    length = int.from_bytes(message[:4], "little")
    header = json.loads(message[4 : 4 + length])
    places = header["arrays"]
    arrays = held | {
        name: _array(message, place, 4 + length + place["offset"]) for name, place in places.items()
    }
    for name, place in places.items():
        if place.get("above"):
            # as the page has them, in single precision
            both, below = (arrays[each].astype(np.float32) for each in (name, place["above"]))
            arrays[name] = np.maximum(both.astype(float) - below, 0)
    return header, arrays


def _array(message, place, start):
    shape, count = place["shape"], int(np.prod(place["shape"]))
    if place["dtype"] != "packed":
        return np.frombuffer(message, place["dtype"], count, start).reshape(shape)
    content = np.frombuffer(message, np.uint8, 2 * count + -(-count // 8), start)
    upper, lower = content[: 2 * count].reshape(2, *shape).astype(int)
    turned = 256 * upper + lower
    steps = np.cumsum(np.cumsum(turned >> 1 ^ -(turned & 1), axis=0), axis=1) % 2**16
    is_unknown = np.unpackbits(content[2 * count :], count=count).reshape(shape)
    return np.where(is_unknown, np.nan, place["low"] + place["step"] * steps)


def assert_sent(array, wanted):
    """Check that an array is what is wanted, to half a step of its range."""
    np.testing.assert_array_equal(np.isfinite(array), np.isfinite(wanted))
    most = HALF_A_STEP * (np.nanmax(wanted) - np.nanmin(wanted))
    np.testing.assert_allclose(array, wanted, rtol=1e-12, atol=most)
