"""The one door to the FFT library, and the number of threads it uses.

All transforms are unnormalised in both directions. A transform's last bits may depend on the
number of threads, so whatever must be the same bytes everywhere asks for one thread.
"""

from __future__ import annotations

import os

import ducc0.fft
import numpy as np
from numpy.typing import NDArray

from roughline.errors import InputError

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]


def available_cores() -> int:
    """Return the number of cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


_threads = available_cores()


def set_threads(count: int) -> None:
    """Use `count` threads for the transforms of this process from now on.

    Raises
    ------
    InputError
        If `count` is not between 1 and the number of cores of this machine.
    """
    global _threads
    if not 1 <= count <= available_cores():
        raise InputError(
            f"threads is {count}; this machine allows 1 to {available_cores()}: choose one of these"
        )
    _threads = count


def good_size(n: int) -> int:
    """Return the smallest even length of at least `n` that transforms fast."""
    return 2 * ducc0.fft.good_size((n + 1) // 2)


def rfft_rows(rows: Real) -> Complex:
    """Transform each row: real (m, n) to complex (m, n // 2 + 1)."""
    return ducc0.fft.r2c(rows, axes=(1,), nthreads=_threads)


def irfft_rows(rows: Complex, n: int) -> Real:
    """Transform each row back: complex (m, n // 2 + 1) to real (m, n)."""
    return ducc0.fft.c2r(rows, axes=(1,), lastsize=n, forward=False, nthreads=_threads)


def fft_columns(columns: Complex, *, forward: bool) -> Complex:
    """Transform each column in place."""
    return ducc0.fft.c2c(columns, axes=(0,), forward=forward, out=columns, nthreads=_threads)


def cosine_spectrum(quarter: Real) -> Real:
    """Spectrum of an even, periodic array, given and returned as its quarter (DCT-I)."""
    return ducc0.fft.dct(quarter, type=1, nthreads=_threads)


def synthesise(half_spectrum: Complex, n: int) -> Real:
    """Sum a Hermitian spectrum, stored for q >= 0 on the last axis, to real values; one thread."""
    axes = tuple(range(half_spectrum.ndim))
    return ducc0.fft.c2r(half_spectrum, axes=axes, lastsize=n, forward=False, nthreads=1)
