"""Fourier transforms, all by one library, and the number of threads.

All transforms are unnormalised in both directions. Each is done by one thread, so its last bits do
not depend on how many there are; the threads share out the blocks of a large transform instead.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any

import ducc0.fft
import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Real
from roughline.computing.cores import available_cores
from roughline.errors.checks import refuse
from roughline.errors.public import public

_Complex = NDArray[np.complex128]
_ComplexFloats = NDArray[np.complexfloating]  # in single or double precision

_threads = available_cores()

LINES_AT_A_TIME = 64  # columns, rows, or pairs of these, that fit into a core's cache
VALUES_AT_A_TIME = 2**15
"""Values that a thread works on: they fit into a cache; for fewer, to start it costs more."""


@public
def set_threads(count: int) -> None:
    """Use `count` threads for the work of this process from now on.

    Raises
    ------
    InputError
        If `count` is not between 1 and the number of cores of this machine.
    """
    global _threads
    if not 1 <= count <= available_cores():
        refuse("threads", count, f"this machine allows 1 to {available_cores()}")
    _threads = count


def threads() -> int:
    """Return the number of threads in use."""
    return _threads


def _share_out(work: Callable[[int], None], count: int) -> None:
    """Call ``work(i)`` for i = 0 ... count - 1, the calls shared out over the threads."""
    workers = min(_threads, count)
    if workers <= 1:
        for i in range(count):
            work(i)
        return

    def every_nth(first: int) -> None:
        for i in range(first, count, workers):
            work(i)

    others = [_pool(_threads).submit(every_nth, first) for first in range(1, workers)]
    every_nth(0)
    for other in others:
        other.result()


def share_out_blocks(work: Callable[[int, int], None], count: int, size: int) -> None:
    """Call ``work(first, last)`` for blocks of 0 ... count - 1, shared out over the threads.

    The blocks are the same whatever the number of threads.
    """
    if 0 < count <= size:
        work(0, count)
    else:
        _share_out(lambda i: work(i * size, min((i + 1) * size, count)), -(-count // size))


@cache
def _pool(workers: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(workers, thread_name_prefix="roughline")


if hasattr(os, "register_at_fork"):  # a forked process has none of its parent's threads
    os.register_at_fork(after_in_child=_pool.cache_clear)


def good_size(n: int, factor: int = 2) -> int:
    """Return the smallest multiple of a factor, at least `n`, that transforms fast."""
    return factor * ducc0.fft.good_size(-(-n // factor))


# Of short rows a call by names takes as long as the transform, so the next three go by position:
# axes, the length of rows, forward, no normalisation, where to, threads.


def fft_along(lines: _ComplexFloats, axis: int, *, forward: bool) -> None:
    """Transform each line along an axis in place."""
    ducc0.fft.c2c(lines, (axis,), forward, 0, lines, 1)


def real_rows_forward(rows: Real, modes: _Complex) -> None:
    """Transform real rows into their modes with q >= 0, by one thread."""
    ducc0.fft.r2c(rows, (1,), True, 0, modes, 1)


def real_rows_back(modes: _Complex, rows: Real) -> None:
    """Transform modes with q >= 0 back into real rows, by one thread."""
    ducc0.fft.c2r(modes, (1,), rows.shape[1], False, 0, rows, 1)


def cosine_spectrum(quarter: Real, periods: tuple[int, int] = (0, 0)) -> None:
    """Turn an even, periodic array, given as its quarter, into its spectrum in place.

    It is a cosine transform (DCT-I) along even periods, which are taken for granted, and that of
    the whole period along odd ones.
    """

    def transform(lines: Real, axis: int) -> None:
        if periods[axis] % 2 == 0:
            ducc0.fft.dct(lines, axes=(axis,), type=1, out=lines, nthreads=1)
        else:
            lags = np.arange(periods[axis])
            whole = np.take(lines, np.minimum(lags, periods[axis] - lags), axis)
            lines[:] = ducc0.fft.r2c(whole, axes=(axis,), nthreads=1).real

    nx, ny = quarter.shape
    share_out_blocks(lambda a, b: transform(quarter[a:b], 1), nx, LINES_AT_A_TIME)
    share_out_blocks(lambda a, b: transform(quarter[:, a:b], 0), ny, LINES_AT_A_TIME)


def sine_spectrum(quarter: Real, odd: tuple[bool, bool], periods: tuple[int, int] = (0, 0)) -> None:
    """Turn a periodic array that is even or odd along each axis, given as its quarter, in place.

    Along odd axes it is a sine transform (DST-I), and what stands where such an array is its own
    opposite is taken as zero. The spectrum is what comes out, times -i for each odd axis. Periods
    are even, which is taken for granted, or odd as that of :func:`cosine_spectrum`.
    """

    def transform(lines: Real, axis: int) -> None:
        if periods[axis] % 2 == 1:
            lags = np.arange(periods[axis])
            whole = np.take(lines, np.minimum(lags, periods[axis] - lags), axis)
            if odd[axis]:
                sign = np.where(2 * lags > periods[axis], -1.0, np.where(lags == 0, 0.0, 1.0))
                whole *= sign[:, np.newaxis] if axis == 0 else sign
            found = ducc0.fft.r2c(whole, axes=(axis,), nthreads=1)
            lines[:] = -found.imag if odd[axis] else found.real
        elif odd[axis]:
            inner = lines[1:-1] if axis == 0 else lines[:, 1:-1]
            found = ducc0.fft.dst(np.ascontiguousarray(inner), axes=(axis,), type=1, nthreads=1)
            lines[:] = 0.0
            inner[:] = found
        else:
            ducc0.fft.dct(lines, axes=(axis,), type=1, out=lines, nthreads=1)

    nx, ny = quarter.shape
    share_out_blocks(lambda a, b: transform(quarter[a:b], 1), nx, LINES_AT_A_TIME)
    share_out_blocks(lambda a, b: transform(quarter[:, a:b], 0), ny, LINES_AT_A_TIME)


def analyse(values: Real) -> _Complex:
    """Return the full spectrum of real values over a plane."""
    return ducc0.fft.c2c(values.astype(np.complex128), axes=(0, 1), forward=True, nthreads=1)


def half_spectrum(values: Real) -> _Complex:
    """Return the spectrum of real values over a plane, for q >= 0 on the last axis."""
    return ducc0.fft.r2c(values, axes=(0, 1), nthreads=1)


def synthesise(half_spectrum: _Complex, n: int) -> Real:
    """Return the real values of a Hermitian spectrum that is stored for q >= 0 on the last axis."""
    axes = tuple(range(half_spectrum.ndim))
    return ducc0.fft.c2r(half_spectrum, axes=axes, lastsize=n, forward=False, nthreads=1)


def convolved(values: Any, half_spectrum: Any, periods: tuple[int, int]) -> Any:
    """Convolve real values over a plane, and crop the result to them, by one thread.

    Values are padded with zeros up to the periods; rows of zeros are not transformed. The spectrum
    is that of the kernel, for q >= 0 on the last axis, over the product of the periods.
    """
    (nx, ny), (mx, my) = values.shape, periods
    rows = np.zeros((nx, my), dtype=values.dtype)
    rows[:, :ny] = values
    modes = np.zeros((mx, my // 2 + 1), dtype=np.result_type(values.dtype, np.complex64))
    ducc0.fft.r2c(rows, axes=(1,), out=modes[:nx], nthreads=1)
    fft_along(modes, 0, forward=True)
    modes *= half_spectrum
    fft_along(modes, 0, forward=False)
    ducc0.fft.c2r(modes[:nx], axes=(1,), lastsize=my, forward=False, out=rows, nthreads=1)
    return rows[:, :ny]


def convolved_together(values: Any, half_spectra: Any, periods: tuple[int, int]) -> Any:
    """Convolve fields with a matrix of kernels: each result is the sum of what all fields give.

    The shape is (fields, nx, ny), and that of the spectra (results, fields, ...). Else it is as
    :func:`convolved`.
    """
    (count, nx, ny), (mx, my) = values.shape, periods
    rows = np.zeros((count, nx, my), dtype=values.dtype)
    rows[:, :, :ny] = values
    modes = np.zeros((count, mx, my // 2 + 1), dtype=np.result_type(values.dtype, np.complex64))
    ducc0.fft.r2c(rows, axes=(2,), out=modes[:, :nx], nthreads=1)
    fft_along(modes, 1, forward=True)
    weighed = half_spectra[:, 0] * modes[0]
    for field in range(1, count):
        weighed += half_spectra[:, field] * modes[field]
    fft_along(weighed, 1, forward=False)
    return ducc0.fft.c2r(weighed[:, :nx], axes=(2,), lastsize=my, forward=False, nthreads=1)[
        :, :, :ny
    ]


def synthesise_line(line: Real) -> None:
    """Turn a Hermitian spectrum (mean, real, imaginary, ...) into its real values in place."""
    ducc0.fft.r2r_fftpack(
        line, axes=(0,), real2hermitian=False, forward=False, out=line, nthreads=1
    )
