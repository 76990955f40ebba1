"""Fourier sums of even spectra at few lags."""

from __future__ import annotations

from dataclasses import dataclass
from math import gcd

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Integers, Real
from roughline.halfspace.operators import loops


@dataclass(frozen=True, eq=False)
class Lags:
    """Multiples of a block's sides at which a sum is wanted, averaged over the cells of two blocks.

    Attributes
    ----------
    counts : tuple of int
        The multiples are 0 ... count - 1 along each axis.
    sides : tuple of int
        Cells along the sides of a block.
    """

    counts: tuple[int, int]
    sides: tuple[int, int] = (1, 1)


def even_sums(
    spectrum: Real, periods: tuple[int, int], lags: Lags, *, inverse: bool = False
) -> Real:
    """Transform a spectrum, or its inverse, back at the lags that are wanted, block by block.

    The spectrum is even and not negative, and a quarter is given. The inverse is zero where it is.
    """
    x, y = (_axis(*each) for each in zip(periods, lags.counts, lags.sides, strict=True))
    along_y = np.empty((len(spectrum), lags.counts[1]))

    def transform(first: int, last: int) -> None:
        rows = spectrum[first:last]
        if inverse:
            rows = np.divide(1.0, rows, out=np.zeros_like(rows), where=rows > 0)
        along_y[first:last] = y.at_lags(rows)

    fft.share_out_blocks(transform, len(spectrum), fft.LINES_AT_A_TIME)
    return x.at_lags(along_y.T).T


@dataclass(frozen=True, eq=False)
class _Axis:
    """The sum over the modes along an axis.

    Attributes
    ----------
    weights, places : ndarray, shape (modes,)
        Weight of each mode, and its place among those that differ at the lags.
    cosines : ndarray, shape (places, lags)
        Their cosines; with the weights, if all modes differ.
    """

    weights: Real
    places: Integers
    cosines: Real

    def at_lags(self, rows: Real) -> Real:
        """Sum over the modes in each row; those that cannot be told apart are added up first."""
        if len(self.cosines) == len(self.weights):
            return rows @ self.cosines
        sums = np.zeros((len(rows), len(self.cosines)))
        loops.fold_rows(rows, self.weights, self.places, sums)
        return sums @ self.cosines


def _axis(period: int, count: int, side: int) -> _Axis:
    modes = np.arange(period // 2 + 1)
    weights = np.full(modes.size, 2.0)
    weights[0] = 1.0
    if period % 2 == 0:
        weights[-1] = 1.0
    angle = np.pi / period * modes[1:]
    weights[1:] *= (np.sin(side * angle) / (side * np.sin(angle))) ** 2
    # At multiples of the side, modes with the same rest have the same cosines
    rest = period // gcd(period, side)
    places = np.minimum(modes % rest, -modes % rest)
    # Modulo the period, the product and so the angle stay small and exact.
    cosine = np.cos(2 * np.pi / period * np.arange(period))
    turns = np.outer(np.arange(rest // 2 + 1), side * np.arange(count)) % period
    cosines = cosine[turns]
    if rest == period:
        cosines *= weights[:, np.newaxis]
    return _Axis(weights, places, cosines)
