"""Small dense equations, solved by a Cholesky factor."""

from __future__ import annotations

import numpy as np
from scipy.linalg import blas, lapack

from roughline.computing.arrays import Floats, Real


class Cholesky:
    """The factor of a positive definite matrix.

    LAPACK and BLAS are called without detours, for there are many such matrices and most are small.

    Parameters
    ----------
    matrix : ndarray
        Single or double precision. Its upper triangle counts, and is overwritten.
    """

    def __init__(self, matrix: Floats) -> None:
        single = matrix.dtype == np.float32
        factorise = lapack.spotrf if single else lapack.dpotrf
        self._solve = blas.strsv if single else blas.dtrsv
        self._factor, failed = factorise(matrix.T, lower=1, clean=0, overwrite_a=1)
        if failed:
            raise np.linalg.LinAlgError("the matrix is not positive definite")

    def solve(self, right: Real) -> Real:
        """Return the solution of the equations, in the precision of the matrix."""
        if not right.size:
            return right
        half = self._solve(self._factor, right, lower=1)
        return self._solve(self._factor, half, lower=1, trans=1, overwrite_x=1)
