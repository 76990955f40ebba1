"""Working memory of operators."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

MUCH_MEMORY = 2**26
"""Bytes from which on memory that is not needed for a while is given back.

Less is kept: to touch new memory for the first time can take longer than the work on it.
"""


class Workspace:
    """Memory that operators work in, which have none of their own.

    It has parts, by name. An operator takes those that it needs for one product; after it, they are
    free for other operators and other grids. Parts stay until they are given up.
    """

    def __init__(self) -> None:
        self._parts: dict[str, NDArray[np.uint8]] = {}

    @property
    def nbytes(self) -> int:
        """What it holds. [bytes]"""
        return sum(part.nbytes for part in self._parts.values())

    def array(self, part: str, shape: tuple[int, ...], dtype: Any) -> Any:
        """Return the beginning of a part: zeros at first, then what its last user has left."""
        size = math.prod(shape) * np.dtype(dtype).itemsize
        if part not in self._parts or self._parts[part].nbytes < size:
            self._parts.pop(part, None)  # before there is a larger one
            self._parts[part] = np.zeros(size, dtype=np.uint8)
        return self._parts[part][:size].view(dtype).reshape(shape)

    def give_up(self) -> None:
        """Give the memory back."""
        self._parts.clear()

    def rest(self) -> None:
        """Give back what is much, as it is not needed for a while."""
        for part in [part for part, memory in self._parts.items() if memory.nbytes > MUCH_MEMORY]:
            del self._parts[part]
