"""Surfaces of known heights and waves, in µm."""

import numpy as np
from scipy.special import ndtri

import roughline as rl


def surface(heights, dx=1.0, dy=1.0, is_cut_out=True):
    sizes = heights.shape[0] * dx, heights.shape[1] * dy
    return rl.Surface(heights, sizes, "um", is_cut_out=is_cut_out)


def grid(nx, ny=None, dy=1.0):
    return np.meshgrid(np.arange(float(nx)), dy * np.arange(float(ny or nx)), indexing="ij")


def cosine(waves, n=128):
    return np.cos(2 * np.pi * waves / n * grid(n)[0])


def stripes(lay, n=128, dy=1.0, wavelength=16.0):
    """Waves across a lay at an angle from x towards y, that is, down the rows. [degree]"""
    x, y = grid(n, dy=dy)
    across = np.radians(lay + 90)
    return np.cos(2 * np.pi / wavelength * (np.cos(across) * x + np.sin(across) * y))


def scattered(heights, seed=0):
    """Heights of a distribution at random places of a square."""
    side = round(heights.size**0.5)
    return np.random.default_rng(seed).permutation(heights).reshape(side, side)


def quantiles(n):
    """Heights in the middles of n equal shares, of a uniform and of a Gaussian distribution."""
    shares = (np.arange(n) + 0.5) / n
    return shares, ndtri(shares)


def gaussian_field(n, length, seed):
    """A periodic Gaussian field of autocorrelation exp(-r² / length²)."""
    q, p = 2 * np.pi * np.fft.fftfreq(n)[:, None], 2 * np.pi * np.fft.rfftfreq(n)
    noise = np.fft.rfft2(np.random.default_rng(seed).normal(size=(n, n)))
    return np.fft.irfft2(noise * np.exp(-(length**2) * (q**2 + p**2) / 8), (n, n))
