"""Fourier sums of even spectra, and of odd ones, at few lags."""

from __future__ import annotations

from math import gcd

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Indices, Real


def even_sums(
    quarter: Real,
    periods: tuple[int, int],
    lags: tuple[Real | Indices, Real | Indices],
    sides: tuple[int, int] = (1, 1),
    *,
    inverse: bool = False,
    odd: tuple[bool, bool] = (False, False),
) -> Real:
    """Transform the quarter of an even spectrum, or of one over it, back at lags along x and y.

    Along odd axes sines take the place of cosines.

    Sums are averaged over the cells of two blocks of the given sides, of which the lags are
    multiples then; those of single cells may be at parts of a cell. The inverse is zero where the
    spectrum is.
    """
    x, y = (_modes(*axis) for axis in zip(periods, lags, sides, odd, strict=True))
    along_y = np.empty((len(lags[1]), len(quarter)))

    def transform(first: int, last: int) -> None:
        rows = quarter[first:last]
        if inverse:
            rows = np.divide(1.0, rows, out=np.zeros_like(rows), where=rows > 0)
        along_y[:, first:last] = _summed(rows, *y)

    fft.share_out_blocks(transform, len(quarter), fft.LINES_AT_A_TIME)
    return _summed(along_y, *x)


def _modes(period: int, lags: Real | Indices, side: int, odd: bool) -> tuple[Real, Real]:
    """Return the weights of modes, and the cosines at each lag of those that differ at the lags.

    Where all differ, the cosines come with the weights.
    """
    modes = np.arange(period // 2 + 1)
    weights = np.where((modes == 0) | (2 * modes == period), 1.0, 2.0)
    angle = np.pi / period * modes[1:]
    weights[1:] *= (np.sin(side * angle) / (side * np.sin(angle))) ** 2
    differ = min(period // gcd(period, side), modes.size)
    turns = np.outer(lags, modes[:differ]) % period  # so that angles stay small and exact
    angles = 2 * np.pi / period * turns
    cosines = np.sin(angles) if odd else np.cos(angles)
    return weights, cosines * weights if differ == modes.size else cosines


def _summed(rows: Real, weights: Real, cosines: Real) -> Real:
    """Sum over the modes of rows at each lag; those that cannot be told apart are added first."""
    differ = cosines.shape[1]
    if differ == weights.size:
        return cosines @ rows.T
    complete = weights.size - weights.size % differ
    folded = rows[:, :complete].reshape(-1, complete // differ, differ)
    sums = np.einsum("rij,ij->rj", folded, weights[:complete].reshape(-1, differ))
    sums[:, : weights.size - complete] += rows[:, complete:] * weights[complete:]
    return cosines @ sums.T
