"""Pieces of larger self-affine surfaces and cuts, whose spectrum and rms height are known.

Lengths are in units of the piece's, wavenumbers in units of 2 pi over it where not said otherwise.
"""

import math

import numpy as np

import roughline as rl

Q_LOW = math.tau


def of_parent(hurst, roll, cut, longer):
    """Spectrum of a parent that is longer than the piece; a roll-off of 0 is none."""
    roll = max(roll, 1 / longer)
    return rl.SelfAffine(
        hurst=hurst, length=longer, C_0=1.0, q_roll=Q_LOW * roll, q_high=Q_LOW * cut
    )


def of_piece(parent, q_high=None):
    """Its waves up to the length of the piece."""
    q_roll = max(parent.q_roll, Q_LOW)
    C_0 = float(parent.continuum.C_2d([q_roll])[0])
    q_high = q_high or parent.q_high
    return rl.SelfAffine(hurst=parent.hurst, length=1.0, C_0=C_0, q_roll=q_roll, q_high=q_high)


def rms_of_piece(parent):
    """Their rms height: on the lattice of wavevectors, and in the continuum beyond 128 waves."""
    counted = 128
    whole = of_piece(parent)
    square = whole.lattice(2 * counted).moment(0)
    if parent.q_high > counted * Q_LOW:
        less = of_piece(parent, counted * Q_LOW)
        square += whole.continuum.moment(0) - less.continuum.moment(0)
    return math.sqrt(square)


def cropped(parent, points, rng, amplitudes):
    """Return a square piece at a random place of a surface."""
    n = points * round(parent.length)
    surface = parent.surface(n, rng, amplitudes)
    x, y = (int(first) for first in rng.integers(0, n - points + 1, 2))
    return surface.cropped((x, x + points), (y, y + points))


def cut_out(parent, points, rng):
    """Return the heights of a piece of a straight Gaussian cut, without its surface."""
    n = points * round(parent.length)
    power = parent.continuum.C_profile(parent.q_low * np.arange(1, n // 2)) * parent.q_low
    modes = np.sqrt(power / 2) * (rng.normal(size=power.size) + 1j * rng.normal(size=power.size))
    first = rng.integers(0, n - points + 1)
    return np.fft.irfft([0, *modes, 0], n)[first : first + points] * n


def tilted(heights, rng):
    """Add a random tilt, about as high as the heights."""
    height = heights.std()
    for axis, points in enumerate(heights.shape):
        rise = rng.normal() * height * np.linspace(-1, 1, points)
        heights = heights + np.expand_dims(rise, [i for i in range(heights.ndim) if i != axis])
    return heights
