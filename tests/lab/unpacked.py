"""Messages of the lab as the page reads them."""

import json

import numpy as np


def unpacked(message):
    """The header of a message, and its arrays by name."""
    length = int.from_bytes(message[:4], "little")
    header = json.loads(message[4 : 4 + length])
    arrays = {
        name: np.frombuffer(
            message, place["dtype"], np.prod(place["shape"]), 4 + length + place["offset"]
        ).reshape(place["shape"])
        for name, place in header["arrays"].items()
    }
    return header, arrays
