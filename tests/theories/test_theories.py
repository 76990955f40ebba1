"""Theories: their own limits, and the numbers they are built from."""

import math

import numpy as np
import pytest
from scipy import integrate

import roughline as rl
from roughline.spectra.isotropic import isotropic_spectrum
from roughline.spectra.moments import moments
from roughline.theories import bush_gibson_thomas, persson
from roughline.theories.theory import THEORIES, theory

SPECTRUM = rl.SelfAffine(hurst=0.7, rms_height=1.0, q_roll=4 * 2 * math.pi, q_high=64 * 2 * math.pi)
FOUND = moments(SPECTRUM)
SLOPE = FOUND.rms_slope
IN_OTHER_UNITS = rl.SelfAffine(
    hurst=0.7,
    length=1e6,
    rms_height=1e6,
    q_roll=SPECTRUM.q_roll * 1e-6,
    q_high=SPECTRUM.q_high * 1e-6,
)
"""The spectrum, with lengths in millionths of its unit."""


def test_moments_are_those_of_the_continuum():
    assert FOUND.m0 == pytest.approx(SPECTRUM.moment(0), rel=1e-4)
    assert pytest.approx(SPECTRUM.moment(2), rel=1e-4) == SLOPE**2
    assert FOUND.m4 * 8 / 3 == pytest.approx(SPECTRUM.moment(4), rel=1e-4)


def test_moments_of_a_surface_are_those_of_its_heights():
    surface = SPECTRUM.surface(512, 3)
    found = moments(isotropic_spectrum(surface))
    assert found.m0 == pytest.approx(surface.rms_height**2, rel=0.02)
    assert found.rms_slope == pytest.approx(surface.rms_slope, rel=0.03)


def test_summits_are_as_dense_as_nayak_says():
    """Count the local maxima of finely resolved Gaussian surfaces."""
    smooth = rl.SelfAffine(hurst=0.7, rms_height=1.0, q_high=24 * 2 * math.pi, q_roll=12 * math.pi)
    counted = []
    for seed in range(4):
        h = smooth.surface(512, seed, "gaussian").heights
        neighbours = [
            np.roll(h, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)
        ]
        summits = np.all([h > other for other in neighbours], axis=0)
        counted.append(summits.sum())
    found = moments(smooth)
    assert np.mean(counted) == pytest.approx(found.summit_density, rel=0.05)


def test_persson_at_its_ends():
    p = np.geomspace(1e-6, 10, 30) * SLOPE
    curve = theory("persson", SPECTRUM, 1.0, p)
    assert curve.area_fraction[0] == pytest.approx(math.sqrt(8 / math.pi) * p[0] / SLOPE, rel=1e-6)
    assert curve.area_fraction[-1] == pytest.approx(1.0)
    assert (np.diff(curve.mean_gap) <= 0).all()
    assert curve.mean_gap[-1] == pytest.approx(0, abs=1e-6)


def test_areas_at_light_loads_are_in_proportion_to_the_pressure():
    p = 1e-6 * SLOPE
    for module, name in ((persson, "persson"), (bush_gibson_thomas, "bush-gibson-thomas")):
        share = theory(name, SPECTRUM, 1.0, p).area_fraction[0]
        assert share == pytest.approx(module.KAPPA * p / SLOPE, rel=1e-6)


def test_persson_stiffness_is_the_slope_of_its_gap():
    p = np.geomspace(1e-4, 0.5, 400) * SLOPE
    curve = theory("persson", SPECTRUM, 1.0, p)
    slope = -np.gradient(p, curve.mean_gap)
    assert curve.stiffness[5:-5] == pytest.approx(slope[5:-5], rel=2e-3)


def test_persson_at_light_loads_is_exponential():
    """P = beta E* exp(-u / u_0) and K = p / u_0, with u_0 from .4 to .6 rms heights."""
    p = np.array([1e-6, 1e-5]) * SLOPE
    curve = theory("persson", SPECTRUM, 1.0, p)
    lengths = p / curve.stiffness
    assert lengths[0] == pytest.approx(lengths[1], rel=1e-3)
    assert -np.diff(curve.mean_gap)[0] / math.log(10) == pytest.approx(lengths[0], rel=1e-3)
    assert 0.35 < lengths[0] < 0.65


def test_persson_gap_against_a_plain_double_integral():
    """The definition, eq. 10 of Persson 2007 with Yang and Persson's factor, by quadrature."""
    q0, qr, q1, p = SPECTRUM.q_low, SPECTRUM.q_roll, SPECTRUM.q_high, 0.05 * SLOPE

    def cumulated(q):
        c, h = SPECTRUM.C_0, SPECTRUM.hurst
        if q <= qr:
            return math.pi * c * (q**4 - q0**4) / 4
        low = math.pi * c * (qr**4 - q0**4) / 4
        return low + math.pi * c * qr ** (2 + 2 * h) * (q ** (2 - 2 * h) - qr ** (2 - 2 * h)) / (
            2 - 2 * h
        )

    def inner(w):
        def integrand(t):
            share = 0.45 + 3 * 0.55 * math.erf(w * t) ** 2
            return share * math.exp(-((w * t) ** 2)) / t

        return integrate.quad(integrand, p, max(8 / w, 2 * p), limit=200)[0]

    def outer(q):
        w = 1 / math.sqrt(cumulated(q))
        return q**2 * float(SPECTRUM.C_2d(q)) * w * inner(w)

    expected = math.sqrt(math.pi) * sum(
        integrate.quad(outer, a, b, limit=200)[0] for a, b in ((q0 * (1 + 1e-9), qr), (qr, q1))
    )
    found = theory("persson", SPECTRUM, 1.0, p)
    assert found.mean_gap[0] == pytest.approx(expected, rel=2e-3)


def test_greenwood_and_williamson_by_quadrature():
    p = theory("greenwood-williamson", SPECTRUM, 1.0, [1e-4 * SLOPE])
    d = (p.mean_gap[0] - FOUND.summit_mean) / FOUND.summit_deviation

    def tail(power):
        return integrate.quad(
            lambda s: (s - d) ** power * math.exp(-(s**2) / 2) / math.sqrt(2 * math.pi), d, 12
        )[0]

    eta, radius, sigma = FOUND.summit_density, FOUND.summit_radius, FOUND.summit_deviation
    force = 4 / 3 * eta * math.sqrt(radius) * sigma**1.5 * tail(1.5)
    assert force == pytest.approx(1e-4 * SLOPE, rel=1e-4)
    assert p.area_fraction[0] == pytest.approx(math.pi * eta * radius * sigma * tail(1), rel=1e-4)
    assert p.stiffness[0] == pytest.approx(
        2 * eta * math.sqrt(radius * sigma) * tail(0.5), rel=1e-4
    )


def test_bush_gibson_and_thomas_bound_persson_and_numerics_lie_between():
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-3, q_roll=16 * math.pi, q_high=128 * math.pi)
    surface = spectrum.surface(512, 5)
    own = isotropic_spectrum(surface)
    p = 0.02 * moments(own).rms_slope
    curve = rl.press(surface, E_star=1.0, forces=[p], periodic=True)
    low = theory("persson", own, 1.0, p).area_fraction[0]
    high = theory("bush-gibson-thomas", own, 1.0, p).area_fraction[0]
    assert low < curve.area_fraction_corrected[0] < high
    # and the full model's stiffness is within a quarter of Persson's on a periodic surface
    of_persson = theory("persson", own, 1.0, p)
    assert curve.stiffness[0] == pytest.approx(of_persson.stiffness[0], rel=0.25)


@pytest.mark.parametrize("name", THEORIES)
def test_units_are_neutral(name):
    p = np.geomspace(1e-5, 1e-3, 5) * SLOPE
    one, other = theory(name, SPECTRUM, 1.0, p), theory(name, IN_OTHER_UNITS, 1e9, p * 1e9)
    assert other.area_fraction == pytest.approx(one.area_fraction, rel=1e-9)
    if one.stiffness is not None:
        assert other.stiffness == pytest.approx(one.stiffness * 1e9 / 1e6, rel=1e-9)
        assert other.mean_gap == pytest.approx(one.mean_gap * 1e6, rel=1e-9)
    if one.hydraulic_aperture is not None:
        assert other.hydraulic_aperture == pytest.approx(one.hydraulic_aperture * 1e6, rel=1e-9)


def test_bad_questions_get_one_line():
    with pytest.raises(rl.InputError, match='name is "hertz"; allowed are "persson"'):
        theory("hertz", SPECTRUM, 1.0, 1.0)
    with pytest.raises(rl.InputError, match="must be positive"):
        theory("persson", SPECTRUM, 1.0, [0.0, 1.0])
    with pytest.raises(rl.InputError, match="has no upper end"):
        theory("persson", rl.SelfAffine(hurst=0.8, rms_height=1.0), 1.0, 1.0)
    with pytest.raises(rl.InputError, match="mean planes cross"):
        theory("greenwood-williamson", SPECTRUM, 1.0, 100.0)


@pytest.mark.parametrize("hurst", [0.5, 0.8])
@pytest.mark.parametrize("roll", [2, 8, 16])
def test_persson_against_the_full_model_with_a_roll_off_at_2_waves_or_more(hurst, roll):
    """From 4 to 60 % contact."""
    spectrum = rl.SelfAffine(
        hurst=hurst, rms_height=1e-3, q_roll=math.tau * roll, q_high=math.tau * 48
    )
    surface = spectrum.surface(256, 3)
    p = surface.rms_slope * np.array([0.02, 0.05, 0.1, 0.2, 0.4])
    curve = rl.press(surface, E_star=1.0, forces=p, periodic=True)
    of_persson = rl.theory("persson", surface, 1.0, p)
    assert 0.04 < curve.area_fraction_corrected[0] < 0.05
    assert 0.6 < curve.area_fraction_corrected[-1] < 0.66
    ratio = of_persson.stiffness / curve.stiffness
    assert ((ratio > 0.8) & (ratio < 1.2)).all()
    area = of_persson.area_fraction / curve.area_fraction_corrected
    assert ((area > 0.68) & (area < 0.93)).all()
    assert area[-1] > area[0] + 0.1  # it comes nearer towards full contact


def test_without_a_roll_off_persson_holds_for_the_mean_of_surfaces_only():
    spectrum = rl.SelfAffine(hurst=1.0, rms_height=1e-3, q_high=math.tau * 24)
    p = spectrum.lattice(96).rms_slope * np.array([0.02, 0.05, 0.1, 0.17])  # 4 to 32 % contact
    logs = []
    for seed in range(8):
        surface = spectrum.surface(96, seed)
        curve = rl.press(surface, E_star=1.0, forces=p, periodic=True, rtol=1e-4)
        theory = rl.theory("persson", surface, 1.0, p)
        logs.append(np.log(curve.stiffness / theory.stiffness))
    assert (np.abs(np.mean(logs, axis=0)) < math.log(1.3)).all()
    assert np.abs(logs).max() > math.log(1.3)
    # with integrals in the place of the sums it is too compliant by much
    with_integrals = rl.theory("persson", spectrum, 1.0, p)
    further = np.log(theory.stiffness / with_integrals.stiffness) + np.mean(logs, axis=0)
    assert further.max() > math.log(1.15)
    assert "if the roll-off is at 2 q_0 or more; without one" in theory.validity
