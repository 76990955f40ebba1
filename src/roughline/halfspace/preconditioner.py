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
from roughline.halfspace.operator import Operator, Places

Field = NDArray[np.float64]
Indices = NDArray[np.integer] | NDArray[np.floating]

_RADIUS = 2  # of the stencil, in cells where these are square
_BLOCK = 16  # cells along the side of a block, where they are square
_FEW = 300  # nodes whose equations are solved directly
_STRETCH = 4.0  # stencil and blocks follow the shape of oblong cells up to here
_COARSEST = 32  # blocks along a side of the lattice that is solved directly
_RIDGE = 1 + 1e-9  # on diagonals, against rounding
_ROUNDED = 1 + 1e-6  # the same, where the kernel is in single precision
_GROUP = 4  # blocks along a side of a group, which makes one block of the next lattice


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
            sides = _GROUP * sides[0], _GROUP * sides[1]
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
    _set_diagonal(matrix, matrix.diagonal() * _ROUNDED)
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
        self._coarse = _Lattices(
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


class _Lattices:
    """Equations for even pressures on blocks, on a lattice of blocks and ever coarser ones.

    The energies are those of the averaged kernel, and at least these on the diagonal, so all
    matrices are positive definite.
    """

    def __init__(self, between: tuple[Field, ...], count: Field, energy: Field) -> None:
        self._groups: list[_Groups] = []
        for kernel in between[:-1]:
            self._groups.append(_Groups(kernel, count, energy))
            count, energy = self._groups[-1].count, self._groups[-1].energy
        self._occupied = np.flatnonzero(count)
        x, y = np.divmod(self._occupied, count.shape[1])
        matrix = between[-1][abs(x[:, np.newaxis] - x), abs(y[:, np.newaxis] - y)]
        weights = count.ravel()[self._occupied]
        matrix *= weights[:, np.newaxis] * weights
        _set_diagonal(matrix, energy.ravel()[self._occupied])
        self._factor = cho_factor(matrix, overwrite_a=True, check_finite=False)
        self._shape = count.shape

    def __call__(self, sums: Field) -> Field:
        """Return the pressure on the nodes of each block from the sum of their residuals."""
        levels = []
        for groups in self._groups:
            levels.append(groups.details(sums))
            sums = groups.sums(sums)
        pressure = np.zeros(self._shape)
        pressure.flat[self._occupied] = cho_solve(
            self._factor, sums.ravel()[self._occupied], check_finite=False
        )
        for details in reversed(levels):
            nx, ny = details.shape
            pressure = np.repeat(np.repeat(pressure, _GROUP, axis=0), _GROUP, axis=1)[:nx, :ny]
            pressure = pressure + details
        return pressure


class _Groups:
    """Groups of the blocks of a lattice, in each of which pressures sum to zero."""

    def __init__(self, kernel: Field, count: Field, energy: Field) -> None:
        self._shape = count.shape
        self._lattice = tuple(-(-n // _GROUP) for n in count.shape)
        counts, energies = self._grouped(count), self._grouped(energy)
        near = np.zeros((_GROUP, _GROUP))
        near[: kernel.shape[0], : kernel.shape[1]] = kernel[:_GROUP, :_GROUP]
        x, y = np.divmod(np.arange(_GROUP**2), _GROUP)
        matrices = counts[:, :, np.newaxis] * counts[:, np.newaxis, :]
        matrices *= near[abs(x[:, np.newaxis] - x), abs(y[:, np.newaxis] - y)]
        _set_diagonal(matrices, energies)
        self.count = counts.sum(axis=1).reshape(self._lattice)
        self.energy = matrices.sum(axis=(1, 2)).reshape(self._lattice)
        _set_diagonal(matrices, np.where(counts == 0, 1.0, energies))  # any number will do
        self._inverses = np.linalg.inv(matrices)
        even = np.einsum("gij,gj->gi", self._inverses, counts)
        total = np.maximum(np.einsum("gi,gi->g", even, counts), 1e-300)
        even /= np.sqrt(total)[:, np.newaxis]
        self._inverses -= even[:, :, np.newaxis] * even[:, np.newaxis, :]

    def _grouped(self, values: Field) -> Field:
        """Rearrange a lattice to groups, zero where they reach beyond it."""
        padding = [(0, m * _GROUP - n) for m, n in zip(self._lattice, self._shape, strict=True)]
        padded = np.pad(values, padding)
        split = padded.reshape(self._lattice[0], _GROUP, self._lattice[1], _GROUP)
        return split.transpose(0, 2, 1, 3).reshape(-1, _GROUP**2)

    def sums(self, values: Field) -> Field:
        """Sum over each group."""
        return self._grouped(values).sum(axis=1).reshape(self._lattice)

    def details(self, sums: Field) -> Field:
        """Return the pressures that sum to zero in each group."""
        pressure = np.einsum("gij,gj->gi", self._inverses, self._grouped(sums))
        (mx, my), (nx, ny) = self._lattice, self._shape
        split = pressure.reshape(mx, my, _GROUP, _GROUP).transpose(0, 2, 1, 3)
        return split.reshape(mx * _GROUP, my * _GROUP)[:nx, :ny]


def _set_diagonal(matrices: Field, energies: Field) -> None:
    """Set the last two axes' diagonal to the energies, or to what is there where that is more."""
    diagonal = np.arange(matrices.shape[-1])
    matrices[..., diagonal, diagonal] = _RIDGE * np.maximum(
        matrices[..., diagonal, diagonal], energies
    )
