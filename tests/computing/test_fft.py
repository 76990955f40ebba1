"""Transforms: what they are, and that threads do not change them."""

import numpy as np
import pytest

from roughline.computing import fft
from roughline.computing.cores import available_cores


@pytest.fixture
def as_before():
    """Use as many threads again after a test."""
    count = fft.threads()
    yield
    fft.set_threads(count)


def cosine_sum(quarter):
    """Transform the even array whose quarter this is."""
    whole = quarter
    for axis, n in enumerate(quarter.shape):
        mirror = np.arange(n - 2, 0, -1)
        whole = np.concatenate([whole, whole.take(mirror, axis=axis)], axis=axis)
    return np.fft.fft2(whole).real[: quarter.shape[0], : quarter.shape[1]]


@pytest.mark.parametrize("shape", [(2, 2), (2, 9), (65, 33), (129, 300)])
def test_the_cosine_spectrum_is_that_of_the_even_array(shape):
    quarter = np.random.default_rng(0).random(shape)
    expected = cosine_sum(quarter)
    fft.cosine_spectrum(quarter)
    assert np.abs(quarter - expected).max() < 1e-14 * np.abs(expected).max()


@pytest.mark.usefixtures("as_before")
def test_the_number_of_threads_changes_no_bit_of_the_cosine_spectrum():
    values, spectra = np.random.default_rng(0).random((130, 300)), []
    for count in (1, available_cores()):
        fft.set_threads(count)
        spectra.append(values.copy())
        fft.cosine_spectrum(spectra[-1])
    assert (spectra[0] == spectra[-1]).all()


def test_good_sizes_are_multiples():
    for n, factor in ((1, 2), (7, 2), (129, 8), (2047, 8)):
        size = fft.good_size(n, factor)
        assert size % factor == 0
        assert n <= size < 1.1 * n + factor
