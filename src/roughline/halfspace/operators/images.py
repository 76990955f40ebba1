"""The kernel of a strip: a half-space that repeats along one axis and is free across.

A load displaces as all its images do. Far away these displace as forces on the base do, by one over
their distance, so that their sum grows as a logarithm. What is left of it once displacements count
from a place far away is finite. Far across from a line of images it is

    2 / (pi E*) ln(datum / distance)

for each force per length, with the modulus of the base. The datum is the width of the surface
across, and how far a hard layer spreads a load beside it. On a rigid base the sum is finite.

The nearest images are summed as they are. What the others displace varies slowly over the period,
and from one to the next, the more slowly the farther they are. So few distances are enough along
the period, and few images of each stretch, which is twice as long as the one before [1]_.

References
----------
.. [1] A. Brandt and A. A. Lubrecht, "Multilevel matrix multiplication and fast solution of integral
   equations", J. Comput. Phys. 90, 348-370 (1990), for smooth kernels on few points.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from roughline.computing import fft
from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.errors.words import called
from roughline.halfspace.elasticity.half_space import HalfSpace

_NEAREST_IMAGES = 2  # images on either side that are summed as they are
_KNOWN_LAGS = 8  # distances along the period at which the others are summed
_FIRST_STRETCHED = 32  # image with which the stretches begin; half as many of each are summed
_MOST_STRETCHES = 32  # enough for layers that spread a load as far as is allowed
_LARGEST_SPREAD = 1e8  # of a load by layers, in periods: sums are good to 1e-11 up to there
_STRETCH_TOLERANCE = 3e-11  # of the images beyond the last stretch, over the largest displacement


@dataclass(frozen=True)
class Summed:
    """A kernel of which images are summed, and how it falls along the period."""

    fill: Callable[[int, Real], None]  # rows of the table, from a distance along the period on
    is_odd: bool = False  # along the period
    power: int = 1  # a pair of images falls with their distance to the minus this; 1, 2 or 3


def fill_with_images(
    half_space: HalfSpace,
    period: int,
    spacing: tuple[float, float],
    width: float,
    table: Real,
    kernel: Summed | None = None,
) -> None:
    """Fill the table of displacements under unit pressure on one cell and all its images.

    Parameters
    ----------
    half_space : HalfSpace
        Its free kernel is summed.
    period : int
        Cells from one image to the next.
    spacing : tuple of float
        Sides of a cell, along the period and across. [length]
    width : float
        Width of the surface across, from which displacements count. [length]
    table : ndarray, shape (period // 2 + 1, columns)
        Overwritten, by the distances along the period and across, in cells. [length / pressure]
    kernel : Summed, optional
        What is summed in place of the displacements under pressure.

    Raises
    ------
    InputError
        If layers spread a load over so many periods that the sum is not known.
    """
    if (periods := half_space.spread / (period * spacing[0])) > _LARGEST_SPREAD:
        raise InputError(
            f"the layers spread a load over {periods:.2g} periods of the strip, and the sum over "
            f"its images is known up to {_LARGEST_SPREAD:.0e}: give thinner or softer layers, or a "
            f"surface that repeats along both axes ({called('periodic', True)})"
        )
    if kernel is None:
        kernel = Summed(lambda first, rows: half_space.kernel(first, spacing, rows))
    lengths = period * spacing[0], half_space.has_base
    images, sign = _Images(kernel, period, lengths, table.shape[1]), -1.0 if kernel.is_odd else 1.0
    farther = images.farther_images(width + half_space.spread)

    def fill(first: int, last: int) -> None:
        rows = table[first:last]
        kernel.fill(first, rows)
        image = np.empty_like(rows)
        for place in range(period, (_NEAREST_IMAGES + 1) * period, period):
            kernel.fill(place + first, image)
            rows += image
            kernel.fill(place - last + 1, image)
            rows += sign * image[::-1]
        rows += images.interpolation(np.arange(first, last)) @ farther

    fft.share_out_blocks(fill, len(table), 1 + fft.VALUES_AT_A_TIME // table.shape[1])


class _Images:
    """Pairs of images, one on either side, seen from some lags along the period."""

    def __init__(
        self, kernel: Summed, period: int, lengths: tuple[float, bool], columns: int
    ) -> None:
        self._kernel, self._period, self._columns = kernel, period, columns
        (self._length, self._has_base), half = lengths, period // 2
        roots = np.sin(
            np.pi / 4 * (2 * np.arange(_KNOWN_LAGS) + 1) / _KNOWN_LAGS
        )  # Chebyshev's, of squares
        lags = np.arange(half + 1) if half < _KNOWN_LAGS else np.unique(np.round(half * roots))
        self._lags = lags.astype(np.intp)
        if kernel.is_odd and half:
            self._lags = self._lags[self._lags > 0]

    def _row(self, place: int) -> Real:
        """Return the kernel at a distance along the period, in cells."""
        row = np.empty((1, self._columns))
        self._kernel.fill(place, row)
        return row[0]

    def _pair(self, image: int) -> Real:
        """Return what the two images so many periods away displace, at each lag."""
        place, sign = image * self._period, -1.0 if self._kernel.is_odd else 1.0
        return np.array(
            [self._row(place + i) + sign * self._row(place - i) for i in self._lags.tolist()]
        )

    def interpolation(self, lags: Indices) -> Real:
        """Return the weights of the values at the known lags, for each lag.

        Both images of a pair together are an even function of the lag, or the lag times one.
        """
        half, known = max(self._period // 2, 1), self._lags
        of_known, of_lags = (
            chebvander(2 * (each / half) ** 2 - 1.0, known.size - 1) for each in (known, lags)
        )
        weights = np.asarray(np.linalg.solve(of_known.T, of_lags.T).T, dtype=np.float64)
        if self._kernel.is_odd:
            weights *= np.divide.outer(lags, np.maximum(known, 1))
        return weights

    def farther_images(self, datum: float) -> Real:
        """Return the sum over all pairs of images beyond the nearest ones, at the known lags.

        Stretches are added until the sum with what lies beyond them no longer changes.
        """
        total = sum(
            (self._pair(m) for m in range(_NEAREST_IMAGES + 1, _FIRST_STRETCHED)), np.zeros(())
        )
        scale = float(np.abs([self._row(0), self._row(1)]).max())
        at, pairs = (
            _FIRST_STRETCHED,
            [self._pair(_FIRST_STRETCHED), self._pair(2 * _FIRST_STRETCHED)],
        )
        before, best, least = np.full_like(total, np.inf), total, math.inf
        for _ in range(_MOST_STRETCHES):
            pairs.append(self._pair(4 * at))
            sums = total + self._rest(at, np.array(pairs[-3:]), datum)
            changed = float(np.abs(sums - before).max())
            if changed < least:
                best, least = sums, changed
            if changed <= _STRETCH_TOLERANCE * max(scale, float(np.abs(sums).max())):
                break
            before = sums
            images, weights = _stretch(at)
            for image, weight in zip(images.tolist(), weights.tolist(), strict=True):
                total = total + weight * self._pair(image)
            at *= 2
        return best

    def _rest(self, at: int, pairs: Real, datum: float) -> Real:
        """Return the sum over pairs from some place on, less the one over all of a line.

        A pair that is m periods away displaces by a / m + b / m³ + c / m^5 there, or by another
        power and the second and fourth ones after it. Those at this place, and at twice and four
        times as many periods, tell a, b and c. Only 1 / m has no sum by itself.
        """
        from scipy import special  # here because it loads slowly

        if self._has_base:
            return np.zeros_like(pairs[0])
        far, power = np.array([1.0, 2.0, 4.0]), self._kernel.power
        times = pairs * ((at * far) ** power)[:, np.newaxis, np.newaxis]
        if power == 1:
            first = math.log(datum / (2 * self._length)) - special.digamma(at)
        else:
            first = special.zeta(power, at)
        sums = first, at**2 * special.zeta(power + 2, at), at**4 * special.zeta(power + 4, at)
        terms = np.tensordot(np.linalg.inv(np.vander(far**-2, increasing=True)), times, 1)
        if power == 1:
            terms[0] = terms[0].mean()  # one for all places: so rounding moves none of them alone
        rest: Real = np.tensordot(sums, terms, 1)
        return rest


def _stretch(first: int) -> tuple[Indices, Real]:
    """Return some of the images from the first one up to twice as far, and their weights.

    With these the sum over all of them is exact for polynomials, but for what Euler and Maclaurin's
    formula leaves out after the fifth derivative.
    """
    half = first / 2
    angles = np.pi * (np.arange(_FIRST_STRETCHED // 2) + 0.5) / (_FIRST_STRETCHED // 2)
    images = np.unique(np.round(1.5 * first - half * np.cos(angles)).astype(np.int64))
    images = images[images < 2 * first]
    k = np.arange(images.size, dtype=float)
    # derivatives of Chebyshev polynomials at one
    slope = k**2
    third = slope * (k**2 - 1) * (k**2 - 4) / 15
    fifth = third * (k**2 - 9) * (k**2 - 16) / 63
    ends = slope / (12 * half) - third / (720 * half**3) + fifth / (30240 * half**5)
    with np.errstate(divide="ignore"):
        sums = np.where(k % 2 == 0, 2 * half / (1 - k**2) + 2 * ends, -1.0)
    return images, np.linalg.solve(chebvander((images - 1.5 * first) / half, k.size - 1).T, sums)
