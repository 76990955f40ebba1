"""Spectra against quadrature, and against the closed forms of their lattice sums."""

import itertools
import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad

import roughline as rl

QUADRATURE = 1e-9  # what adaptive quadrature delivers here


def banded(**changes):
    settings = {"hurst": 0.7, "length": 3.0, "rms_height": 2.0, "q_roll": 10.0, "q_high": 300.0}
    return rl.SelfAffine(**{**settings, **changes})


def integral(function, *breaks):
    pieces = itertools.pairwise(breaks)
    return sum(quad(function, a, b, epsabs=0, epsrel=1e-11, limit=300)[0] for a, b in pieces)


@pytest.mark.parametrize("order", [0, 2, 4])
@pytest.mark.parametrize("hurst", [0.0, 0.3, 0.5, 1.0])
def test_moments_are_the_integrals_of_both_spectra(hurst, order):
    spectrum = banded(hurst=hurst)
    breaks = (spectrum.q_low, spectrum.q_roll, spectrum.q_high)
    of_surface = integral(lambda q: 2 * np.pi * q ** (1 + order) * spectrum.C_2d(q), *breaks)
    of_line = integral(lambda q: 2 * q**order * spectrum.C_reduced(q), *breaks)
    assert spectrum.moment(order) == pytest.approx(of_surface, rel=QUADRATURE)
    assert spectrum.moment(order) == pytest.approx(of_line, rel=QUADRATURE)
    if order == 0:
        assert spectrum.moment(0) == pytest.approx(spectrum.rms_height**2, rel=1e-13)


@pytest.mark.parametrize("q", [0.0, 1e-9, 1.0, 2.1, 7.0, 10.0, 20.0, 200.0, 299.0, 301.0, -20.0])
def test_a_straight_cut_is_the_abel_transform(q):
    spectrum = banded()
    a = abs(q)

    # with q' = sqrt(q² + t²) the integrand 2 C_2d q' dq' / sqrt(q'² - q²) is 2 C_2d dt
    def reach(limit):
        return math.sqrt(max(0.0, limit**2 - a**2))

    breaks = [reach(x) for x in (spectrum.q_low, spectrum.q_roll, spectrum.q_high)]
    expected = integral(lambda t: 2 * spectrum.C_2d(math.hypot(a, t)), *breaks) if a < 300 else 0
    assert spectrum.C_profile(q) == pytest.approx(expected, rel=1e-8, abs=1e-300)


def test_a_straight_cut_has_the_height_variance_and_half_the_slope_variance():
    spectrum = banded()
    breaks = (0.0, spectrum.q_low, spectrum.q_roll, spectrum.q_high)
    heights = integral(lambda q: 2 * spectrum.C_profile(q), *breaks)
    slopes = integral(lambda q: 2 * q**2 * spectrum.C_profile(q), *breaks)
    assert heights == pytest.approx(spectrum.moment(0), rel=1e-7)
    assert slopes == pytest.approx(spectrum.moment(2) / 2, rel=1e-7)


@pytest.mark.parametrize(("hurst", "ratio"), [(0.2, 1.254), (0.5, 1.571), (0.8, 1.839), (1.0, 2.0)])
def test_the_reduced_spectrum_exceeds_the_cut_by_a_gamma_ratio(hurst, ratio):
    spectrum = rl.SelfAffine(hurst=hurst, C_0=1.0)
    q = spectrum.q_low * np.array([1.5, 4.0, 90.0])
    gamma = math.sqrt(math.pi) * math.gamma(hurst + 1) / math.gamma(hurst + 0.5)
    assert spectrum.C_reduced(q) / spectrum.C_profile(q) == pytest.approx(gamma, rel=1e-12)
    assert gamma == pytest.approx(ratio, abs=5e-4)


@pytest.mark.parametrize(
    ("hurst", "ratio"),
    [(0.2, 1.031), (0.4, 1.058), (0.5, 1.070), (0.6, 1.081), (0.8, 1.101), (1.0, 1.120)],
)
def test_on_the_lattice_a_line_is_rougher_than_its_surface(hurst, ratio):
    def zeta(s):
        return float(mpmath.zeta(s))

    def beta(s):
        return float(mpmath.dirichlet(s, [0, 1, 0, -1]))

    expected = math.sqrt(
        2 * math.pi * zeta(1 + 2 * hurst) / (4 * zeta(1 + hurst) * beta(1 + hurst))
    )
    assert expected == pytest.approx(ratio, abs=6e-4)
    spectrum = rl.SelfAffine(hurst=hurst, C_0=1.0)
    coarse, fine = (lattice_ratio(spectrum, n) for n in (512, 1024))
    # the sums' tails fall as n^(-2H): Richardson in that power, good to a few 1e-3 at H = 0.2
    limit = fine + (fine - coarse) / (2 ** (2 * hurst) - 1)
    assert limit == pytest.approx(expected, rel=4e-3)


def lattice_ratio(spectrum, n):
    line = spectrum.lattice(n, "line").moment(0)
    return math.sqrt(line / spectrum.lattice(n).moment(0))


@pytest.mark.parametrize("order", [0, 2, 4])
def test_lattice_sums_approach_the_integrals_on_a_dense_lattice(order):
    spectrum = rl.SelfAffine(hurst=0.6, length=400.0, C_0=1.0, q_roll=2.0, q_high=6.0)
    for body, n in (("surface", 1024), ("line", 2**14)):
        # a disc of 400 modes radius: its lattice sum differs by about 1 / 400
        assert spectrum.lattice(n, body).moment(order) == pytest.approx(
            spectrum.moment(order), rel=5e-3
        )


def test_C_0_and_rms_height_are_two_ways_to_say_the_same():
    by_rms = banded()
    by_C_0 = banded(rms_height=None, C_0=by_rms.C_0)
    assert by_C_0.rms_height == pytest.approx(by_rms.rms_height, rel=1e-13)
    assert (by_rms.normalisation, by_C_0.normalisation) == ("rms_height", "C_0")


def test_hurst_and_fractal_dimension_are_one_number():
    by_dimension = rl.SelfAffine(fractal_dimension=2.2, rms_height=1.0)
    by_hurst = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    assert by_dimension == by_hurst
    assert by_hurst.fractal_dimension == 2.2


def test_the_spectrum_is_zero_outside_its_cutoffs():
    spectrum = banded()
    assert spectrum.C_2d([0.0, 0.99 * spectrum.q_low, 1.01 * spectrum.q_high]).tolist() == [0] * 3
    assert spectrum.C_2d(spectrum.q_low) == spectrum.C_0 == spectrum.C_2d(spectrum.q_roll)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (
            {"rms_height": 1.0},
            "give exactly one of hurst= and fractal_dimension=; neither is given",
        ),
        (
            {"hurst": 0.5, "fractal_dimension": 2.5, "rms_height": 1.0},
            "fractal_dimension=; both are given",
        ),
        ({"hurst": 0.5}, "give exactly one of rms_height= and C_0=; neither is given"),
        ({"hurst": 0.5, "rms_height": 1.0, "C_0": 1.0}, "C_0=; both are given"),
        ({"hurst": 1.2, "rms_height": 1.0}, "hurst is 1.2; allowed is 0 to 1"),
        ({"hurst": math.nan, "rms_height": 1.0}, "hurst is nan"),
        ({"fractal_dimension": 1.9, "rms_height": 1.0}, "fractal_dimension is 1.9; allowed is 2"),
        ({"hurst": 0.5, "rms_height": 0.0}, "rms_height is 0.0; a positive"),
        ({"hurst": 0.5, "rms_height": math.inf}, "rms_height is inf"),
        ({"hurst": 0.5, "C_0": -1.0}, "C_0 is -1.0; a positive"),
        ({"hurst": 0.5, "rms_height": 1.0, "length": -2.0}, "length is -2.0; a positive"),
        ({"hurst": 0.5, "rms_height": 1.0, "q_roll": 1.0}, "q_roll is 1.0; at least q_low"),
        ({"hurst": 0.5, "rms_height": 1.0, "q_high": 6.0}, "q_high is 6.0; more than q_roll"),
    ],
)
def test_impossible_spectra_are_refused(settings, message):
    with pytest.raises(rl.InputError, match=message.replace("(", r"\(")):
        rl.SelfAffine(**settings)


def test_moments_that_diverge_say_so():
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    with pytest.raises(rl.InputError, match="moment of order 2 diverges .* give q_high"):
        spectrum.moment(2)
    with pytest.raises(rl.InputError, match="diverges for H = 0"):
        _ = rl.SelfAffine(hurst=0.0, rms_height=1.0).C_0


@pytest.mark.parametrize(
    "given",
    [
        {"hurst": 0.8, "rms_height": 1e-6, "length": 1e-3},
        {"fractal_dimension": 2.3, "C_0": 2e-30},
        {"hurst": 0, "rms_height": 1, "q_roll": 20.0, "q_high": 400.0},
        {"hurst": 1, "rms_height": 0.1, "length": 3, "q_high": 1e5},
    ],
)
def test_what_is_printed_makes_the_spectrum_again(given):
    spectrum = rl.SelfAffine(**given)
    assert eval(repr(spectrum), {"SelfAffine": rl.SelfAffine}) == spectrum
