"""Fourier sums at few lags against the whole transform."""

import numpy as np
import pytest

from roughline.computing import fft
from roughline.computing.cores import available_cores
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.even_sums import even_sums

ROUNDING = 1e-14


def whole(quarter, periods):
    """Return all modes of a spectrum that is given by its quarter."""
    i, j = (np.minimum(np.arange(n), -np.arange(n) % n) for n in periods)
    return quarter[i[:, np.newaxis], j]


def block_mean(values, lags, side, axis):
    """Average even, periodic values along an axis over all pairs of cells of two blocks."""
    total = 0.0
    for one in range(side):
        for other in range(side):
            total = total + values.take(lags + one - other, axis=axis, mode="wrap")
    return total / side**2


@pytest.mark.parametrize("periods", [(24, 40), (1, 2), (64, 15), (7, 48)])
@pytest.mark.parametrize("sides", [(1, 1), (4, 6), (16, 3)])
def test_sums_are_those_of_the_whole_transform(periods, sides):
    quarter = np.random.default_rng(0).random([n // 2 + 1 for n in periods])
    quarter[0, 0] = 0.0
    lags = sides[0] * np.arange(3), sides[1] * np.arange(5)
    found = even_sums(quarter, periods, lags, sides)
    found_inverse = even_sums(quarter, periods, (np.arange(2), np.arange(3)), inverse=True)
    near = even_sums(quarter, periods, (np.arange(4), np.arange(2)))
    spectrum = whole(quarter, periods)
    expected = np.fft.fft2(spectrum).real
    close = expected.take(range(4), axis=0, mode="wrap").take(range(2), axis=1, mode="wrap")
    assert np.abs(near - close).max() < ROUNDING * spectrum.sum()
    for axis, side in enumerate(sides):
        expected = block_mean(expected, lags[axis], side, axis)
    assert np.abs(found - expected).max() < ROUNDING * spectrum.sum()
    inverse = np.divide(1, spectrum, out=np.zeros(periods), where=spectrum > 0)
    expected = np.fft.fft2(inverse).real
    expected = expected.take(range(2), axis=0, mode="wrap").take(range(3), axis=1, mode="wrap")
    assert np.abs(found_inverse - expected).max() < ROUNDING * inverse.sum()


def test_the_number_of_threads_changes_no_bit_of_the_approximate_inverse():
    count, found = fft.threads(), []
    try:
        for threads in (1, available_cores()):
            fft.set_threads(threads)
            operator = on_grid(Homogeneous(1.0), (200, 150), (1.0, 0.9))
            inverse = ApproximateInverse.of(operator)
            found.append((operator.spectrum, inverse.taps, inverse.block_kernel))
    finally:
        fft.set_threads(count)
    for one, other in zip(*found, strict=True):
        assert (one == other).all()
