"""Convolutions of whole fields on a small grid, with few calls and in memory that is kept."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roughline.computing import fft
from roughline.computing.arrays import Indices, Real
from roughline.computing.compiled import compiled


class SmallGrid:
    """Transforms of fields on a grid of few modes, by one thread and in double precision.

    It has two fields, each a row after row of the grid, as long as the period: the source, which is
    zero beyond the columns of the grid, and the result, which is of no meaning there.
    """

    def __init__(self, shape: tuple[int, int], periods: tuple[int, int]) -> None:
        self.shape = shape
        self.width = periods[1]  # of the rows of its fields
        self._modes = np.zeros((periods[0], periods[1] // 2 + 1), dtype=np.complex128)
        self._of_rows = self._modes[: shape[0]]
        self._padding = self._modes[shape[0] :]
        self._rows, self._rows_back = np.zeros((2, shape[0], periods[1]))
        self.source, self.result = self._rows.reshape(-1), self._rows_back.reshape(-1)

    @property
    def nbytes(self) -> int:
        """Memory that it holds. [bytes]"""
        return self._modes.nbytes + 2 * self._rows.nbytes

    def places(self, nodes: Indices) -> Indices:
        """Return where nodes of the grid lie in its fields."""
        columns = self.shape[1]
        return nodes if columns == self.width else _places(nodes, columns, self.width)

    def put(self, values: Real, places: Indices) -> None:
        """Let the source be zero but for some values."""
        _put(values, places, self.source)

    def convolve(self, spectrum: Real) -> None:
        """Convolve the source with the kernel of a spectrum that is even, and given as its quarter.

        The source is left as it is.
        """
        fft.real_rows_forward(self._rows, self._of_rows)
        self._padding[...] = 0
        fft.fft_along(self._modes, 0, forward=True)
        _weigh(self._modes, spectrum)
        fft.fft_along(self._modes, 0, forward=False)
        fft.real_rows_back(self._of_rows, self._rows_back)

    def at(self, places: Indices) -> Real:
        """Return the result at some places."""
        return _at(self.result, places)


@compiled
def _weigh(modes: NDArray[np.complex128], quarter: Real) -> None:
    """Multiply modes, q_y >= 0, by a spectrum that is even along x."""
    period = modes.shape[0]
    for i in range(period):
        row, weights = modes[i], quarter[min(i, period - i)]
        for j in range(row.size):
            row[j] *= weights[j]


@compiled
def _places(nodes: Indices, columns: int, width: int) -> Indices:
    """Return the places of nodes in rows of another width than the grid has columns."""
    places = np.empty(nodes.size, dtype=np.intp)
    for i in range(nodes.size):
        places[i] = nodes[i] + nodes[i] // columns * (width - columns)
    return places


@compiled
def _put(values: Real, places: Indices, field: Real) -> None:
    """Write values into a field, which is zero elsewhere."""
    field[:] = 0.0
    for i in range(places.size):
        field[places[i]] = values[i]


@compiled
def _at(field: Real, places: Indices) -> Real:
    """Return the values of a field at some places."""
    values = np.empty(places.size)
    for i in range(places.size):
        values[i] = field[places[i]]
    return values
