"""The Gaussian filter of ISO 16610-21 and -61, with a kernel renormalised at the borders.

A wave as long as the cutoff keeps half of its amplitude. Beyond a border nothing is made up: the
weights of the points that there are add up to one, also beside it. So what is level stays level,
and a crest of a wave of the cutoff that lies on the border keeps about its half. Periodic heights
have no border.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.fft import convolved, good_size

_ALPHA = math.sqrt(math.log(2) / math.pi)
_REACH = 1.5  # of the cutoff, beyond which the weights are below 1e-13 of the largest


def smoothed(heights: Real, spacings: Sequence[float], cutoff: float, *, is_periodic: bool) -> Real:
    """Return the waves of a line or a surface that are longer than the cutoff wavelength.

    Parameters
    ----------
    heights : ndarray, shape (n,) or (nx, ny)
        Heights. [length]
    spacings : sequence of float
        Distances of points along each side. [length]
    cutoff : float
        Wavelength of which half of the amplitude passes. [length]
    is_periodic : bool
        Whether the heights repeat beyond their sides.
    """
    plane = heights.reshape(len(heights), -1)
    steps = (*spacings, 1.0)[:2]
    periods, kernels = [], []
    for n, step in zip(plane.shape, steps, strict=True):
        reach = 0 if is_periodic or n == 1 else min(n, math.ceil(_REACH * cutoff / step))
        periods.append(n if is_periodic or n == 1 else good_size(n + reach))
        kernels.append(_spectrum(periods[-1], step, cutoff) if n > 1 else np.ones(1))
    across = kernels[1][: periods[1] // 2 + 1]
    mean = float(plane.mean())
    area = math.prod(periods)
    passed = convolved(plane - mean, np.outer(kernels[0], across) / area, (periods[0], periods[1]))
    if not is_periodic:
        for axis in range(2):
            column = np.ones((plane.shape[axis], 1))
            kernel = kernels[axis][:, None] / periods[axis]
            weights = convolved(column, kernel, (periods[axis], 1))
            passed = passed / np.moveaxis(weights, 0, axis)
    return (passed + mean).reshape(heights.shape)


def _spectrum(period: int, spacing: float, cutoff: float) -> Real:
    """Transform of the weights over a period, those of the repetitions added."""
    lags = np.arange(period)
    images = range(-2, 3)  # of a cutoff that is no longer than the period
    weights = sum(
        np.exp(-math.pi * ((lags + image * period) * spacing / (_ALPHA * cutoff)) ** 2)
        for image in images
    )
    return np.asarray(np.fft.fft(weights / np.sum(weights)).real)
