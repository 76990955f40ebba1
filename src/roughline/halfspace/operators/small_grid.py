"""Convolutions of whole fields on a small grid, with few calls and few copies."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roughline.computing import fft
from roughline.computing.arrays import Indices, Real
from roughline.computing.compiled import compiled


class SmallGrid:
    """Transforms of fields on a grid of few modes, by one thread and in double precision."""

    def __init__(self, shape: tuple[int, int], periods: tuple[int, int]) -> None:
        self.shape, self.periods = shape, periods
        self.modes = np.zeros((periods[0], periods[1] // 2 + 1), dtype=np.complex128)

    @property
    def nbytes(self) -> int:
        """Memory that it holds. [bytes]"""
        return self.modes.nbytes

    def fields(self) -> SmallFields:
        """Return memory for the fields of a search."""
        return SmallFields(self)


class SmallFields:
    """What a convolution on a small grid takes, the source, and what it gives, the result.

    Each has the rows of the grid one after the other, as long as the period. What lies beyond the
    columns of the grid is zero in a source, and of no meaning in a result.
    """

    def __init__(self, grid: SmallGrid) -> None:
        (nx, columns), width = grid.shape, grid.periods[1]
        self.width = width  # of the rows
        self._columns, self._modes = columns, grid.modes
        self._of_rows, self._padding = grid.modes[:nx], grid.modes[nx:]
        self._rows, self._rows_back = np.empty((2, nx, width))
        self.source, self.result = self._rows.reshape(-1), self._rows_back.reshape(-1)

    def places(self, nodes: Indices) -> Indices:
        """Return where nodes of the grid lie in the fields."""
        same = self._columns == self.width
        return nodes if same else _places(nodes, self._columns, self.width)

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
