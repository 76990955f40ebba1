"""The inverse on few nodes: dense equations, solved directly."""

from __future__ import annotations

import numpy as np
from scipy.linalg import blas, lapack

from roughline.computing.arrays import Floats, Integers, Real
from roughline.computing.compiled import compiled
from roughline.halfspace.operators.grid_nodes import GridNodes

_RIDGE = 1 + 1e-6  # factor on the diagonal, as the kernel comes in single precision


class Direct:
    """The equations of some nodes of a grid, by a Cholesky factor.

    LAPACK and BLAS are called without detours, for there are many such matrices and most are small.

    Parameters
    ----------
    kernel : ndarray
        Displacement under unit pressure on one node, by the distance from it in cells.
        [length / pressure]
    nodes : GridNodes
        The nodes.
    """

    def __init__(self, kernel: Floats, nodes: GridNodes) -> None:
        rows = np.repeat(nodes.rows, np.diff(nodes.starts))
        matrix = np.empty((rows.size, rows.size))
        _fill_triangle(kernel, rows, nodes.columns, matrix)
        self._factor, failed = lapack.dpotrf(matrix.T, lower=1, clean=0, overwrite_a=1)
        if failed:
            raise np.linalg.LinAlgError("the matrix is not positive definite")

    def __call__(self, residual: Real) -> Real:
        """Return the change of pressure that causes the displacement `residual`."""
        if not residual.size:
            return residual
        half = blas.dtrsv(self._factor, residual, lower=1)
        return blas.dtrsv(self._factor, half, lower=1, trans=1, overwrite_x=1)


@compiled
def _fill_triangle(kernel: Floats, rows: Integers, columns: Integers, matrix: Real) -> None:
    """Fill the upper triangle with the kernel at the distances of nodes."""
    for i in range(rows.size):
        for j in range(i + 1, rows.size):
            matrix[i, j] = kernel[abs(rows[i] - rows[j]), abs(columns[i] - columns[j])]
        matrix[i, i] = _RIDGE * kernel[0, 0]
