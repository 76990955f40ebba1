"""An approximate inverse of the half-space on any set of contact nodes.

Neighbours within two cells are undone by a stencil, the inverse convolution cut short; what is
smooth over blocks of 16 cells by small dense systems for the mean pressure of each block, block by
block on ever coarser lattices. The spaces are split by zero means, so each level adds only what
the coarser ones cannot represent; the splitting is stable for operators of this order [1]_ [2]_.

References
----------
.. [1] P. Oswald, "Multilevel norms for H^(-1/2)", Computing 61, 235-255 (1998).
.. [2] M. Hahne and E. P. Stephan, "Schwarz iterations for the efficient solution of screen problems
   with boundary elements", Computing 56, 61-85 (1996).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from roughline.halfspace import loops
from roughline.halfspace.lattices import GROUP, Lattices, set_diagonal
from roughline.halfspace.operator import Operator, Places

Field = NDArray[np.float64]
Indices = NDArray[np.integer] | NDArray[np.floating]

_RADIUS = 2  # of the stencil, in cells where these are square
_BLOCK = 16  # cells along the side of a block, where they are square
_FEW = 300  # nodes whose equations are solved directly
_STRETCH = 4.0  # stencil and blocks follow the shape of oblong cells up to here
_COARSEST = 32  # blocks along a side of the lattice that is solved directly
_ROUNDED = 1 + 1e-6  # on the diagonal, where the kernel is in single precision


@dataclass(frozen=True, eq=False)
class Approximation:
    """What the preconditioner knows of an operator.

    Attributes
    ----------
    operator : Operator
        The half-space.
    offsets : ndarray of int, shape (taps, 2)
        Cells from the centre of the stencil.
    taps : ndarray, shape (taps,)
        Its coefficients. All but the central one are negative and together weigh less than it, so
        the stencil cut to any set of nodes is positive definite. [pressure / length]
    margins : tuple of int
        Cells that the stencil reaches along x and y.
    sides : tuple of int
        Cells along the sides of the smallest blocks.
    own : float
        Displacement of a node by its own pressure. [length / pressure]
    between : tuple of ndarray
        For each lattice, displacement of a node by the pressure on another, averaged over their
        blocks, by the distance of these. A positive definite function, as the kernel is.
        [length / pressure]
    """

    operator: Operator
    offsets: NDArray[np.intp]
    taps: Field
    margins: tuple[int, int]
    sides: tuple[int, int]
    own: float
    between: tuple[Field, ...]

    @classmethod
    def of(cls, operator: Operator) -> Approximation:
        """Derive it from the operator's spectrum."""
        # even pressure displaces nothing in a periodic half-space: let it displace as the rest does
        raised = float(operator.spectrum.max()) if operator.is_periodic else 0.0
        own = _even_sum(operator, operator.spectrum, [np.zeros(1)] * 2)[0, 0] + raised
        dx, dy = operator.spacing
        stretch = float(np.clip(np.sqrt(dy / dx), 1 / _STRETCH, _STRETCH))
        nx, ny = operator.shape
        smallest = (
            min(max(1, round(_BLOCK * stretch)), nx),
            min(max(1, round(_BLOCK / stretch)), ny),
        )
        between = []
        sides = smallest
        while True:
            lags = [
                side * np.arange(-(-n // side))
                for side, n in zip(sides, operator.shape, strict=True)
            ]
            between.append(_even_sum(operator, operator.spectrum, lags, sides) + raised)
            if max(between[-1].shape) <= _COARSEST:
                break
            sides = GROUP * sides[0], GROUP * sides[1]
        offsets, taps = _stencil(operator, stretch)
        margins = int(abs(offsets[:, 0]).max()), int(abs(offsets[:, 1]).max())
        return cls(operator, offsets, taps, margins, smallest, own, tuple(between))

    @cached_property
    def kernel(self) -> NDArray[np.float32]:
        """Displacement by the distance in cells from unit pressure on one node."""
        pressure = np.ones(1)
        corner = Places.of(np.zeros(1, dtype=np.intp), self.operator.shape)
        kernel = self.operator.convolve(pressure, corner, None, "float32")
        if self.operator.is_periodic:
            kernel += self.operator.spectrum.max()
        return kernel.astype(np.float32)

    @cached_property
    def grid(self) -> NDArray[np.float32]:
        """Room for the grid and the stencil's margin; zero whenever it is not in use."""
        nx, ny = self.operator.shape
        room = (nx + 2 * self.margins[0]) * (ny + 2 * self.margins[1])
        return np.zeros(room, dtype=np.float32)


def _stencil(operator: Operator, stretch: float) -> tuple[NDArray[np.intp], Field]:
    scale = operator.periods[0] * operator.periods[1]
    inverse = np.zeros_like(operator.spectrum)
    np.divide(1 / scale**2, operator.spectrum, out=inverse, where=operator.spectrum > 0)
    radii = _RADIUS * stretch, _RADIUS / stretch
    reach = [
        np.arange(-min(int(radius), (period - 1) // 2), min(int(radius), (period - 1) // 2) + 1)
        for radius, period in zip(radii, operator.periods, strict=True)
    ]
    x, y = (lag.ravel() for lag in np.meshgrid(*reach, indexing="ij"))
    within = (x / radii[0]) ** 2 + (y / radii[1]) ** 2 <= 1
    offsets = np.stack([x[within], y[within]], axis=1)
    lags = [np.arange(axis.max() + 1) for axis in reach]
    taps = _even_sum(operator, inverse, lags)[abs(offsets[:, 0]), abs(offsets[:, 1])]
    centre = (offsets == 0).all(axis=1)
    around = np.minimum(taps, 0.0)
    around *= min(1.0, 0.99 * taps[centre].item() / max(-around.sum(), 1e-300))
    return offsets, np.where(centre, taps, around)


def _even_sum(
    operator: Operator, quarter: Field, lags: Sequence[Indices], sides: Sequence[int] = (1, 1)
) -> Field:
    """Transform an even spectrum given by its quarter, at the lags wanted only.

    With `sides`, the result is averaged over all pairs of cells of two blocks at these lags.
    """
    result = quarter
    for axis, period in enumerate(operator.periods):
        modes = np.arange(period // 2 + 1)
        weights = np.full(modes.size, 2.0)
        weights[0] = 1.0
        if period % 2 == 0:
            weights[-1] = 1.0
        angle = np.pi / period * modes[1:]
        weights[1:] *= (np.sin(sides[axis] * angle) / (sides[axis] * np.sin(angle))) ** 2
        # the product modulo the period keeps the angle small and exact
        cosines = weights * np.cos(2 * np.pi / period * (np.outer(lags[axis], modes) % period))
        result = np.moveaxis(np.tensordot(cosines, result, axes=(1, axis)), 0, axis)
    return result


Preconditioner = Callable[[Field], Field]
"""Returns the pressure change that would undo a residual, were the inverse exact."""


def preconditioner(approximation: Approximation, places: Places) -> Preconditioner:
    """Return the approximate inverse on a set of contact nodes; for few nodes it is the inverse."""
    if places.nodes.size > _FEW:
        return _Multilevel(approximation, places)
    rows = np.repeat(places.rows, np.diff(places.starts))
    columns = places.columns
    matrix = approximation.kernel[
        abs(rows[:, np.newaxis] - rows), abs(columns[:, np.newaxis] - columns)
    ].astype(np.float64)
    set_diagonal(matrix, matrix.diagonal() * _ROUNDED)
    factor = cho_factor(matrix, overwrite_a=True, check_finite=False)
    return lambda residual: cho_solve(factor, residual, check_finite=False)


class _Multilevel:
    """The approximate inverse on many contact nodes."""

    def __init__(self, approximation: Approximation, places: Places) -> None:
        margins, sides = approximation.margins, approximation.sides
        rows = np.repeat(places.rows, np.diff(places.starts))
        width = approximation.operator.shape[1] + 2 * margins[1]
        self._taps = approximation.taps
        self._offsets = approximation.offsets @ np.array([width, 1])
        self._grid = approximation.grid
        index: type[np.integer] = np.int32 if self._grid.size < 2**31 else np.int64
        self._places = ((rows + margins[0]) * width + places.columns + margins[1]).astype(index)
        lattice = approximation.between[0].shape
        self._lattice = lattice
        block = (rows // sides[0]) * lattice[1] + places.columns // sides[1]
        self._block = block.astype(np.int32)
        count = np.bincount(self._block, minlength=lattice[0] * lattice[1]).astype(np.float64)
        self._per_node = 1 / np.maximum(count, 1.0)
        energy = count**2 * approximation.between[0][0, 0]
        # nodes at random in a block of so many cells
        energy += (
            count
            * (1 - count / (sides[0] * sides[1]))
            * (approximation.own - approximation.between[0][0, 0])
        )
        self._coarse = Lattices(
            approximation.between, count.reshape(lattice), energy.reshape(lattice)
        )

    def __call__(self, residual: Field) -> Field:
        """Return the pressure change that would undo `residual`, were the inverse exact."""
        result = np.empty_like(residual)
        sums, sums_of_result = np.empty((2, self._per_node.size))
        loops.sum_blocks(residual, self._block, sums)
        loops.undo_details(
            residual,
            self._places,
            self._block,
            sums * self._per_node,
            self._grid,
            self._offsets,
            self._taps,
            result,
            sums_of_result,
        )
        means = self._coarse(sums.reshape(self._lattice)).ravel()
        means -= sums_of_result * self._per_node
        loops.add_blocks(means, self._block, result)
        return result
