"""The continuum and the lattice are two things, and a body has the lattice's."""

import math
import warnings

import numpy as np
import pytest
from scipy import integrate, special

import roughline as rl
from roughline.spectra.moments import bands, moments

Q_0 = 2 * math.pi
N = 128
HURSTS = (0.2, 0.4, 0.6, 0.8, 1.0)
STEPS = 50  # through the waves of one wavenumber, in the judge of Persson's theory
CLOSE = 0.05  # what a theory of a spectrum may be off that of its surfaces
ROUNDING = 1e-9  # sums over thousands of modes, and of the band's upper end


def rough(hurst, roll=1.0, waves=32.0, **height):
    height = height or {"rms_height": 2.0}
    return rl.SelfAffine(hurst=hurst, q_roll=roll * Q_0, q_high=waves * Q_0, **height)


def measured(heights):
    """Wavenumbers and powers of all modes but the mean, by NumPy's transform."""
    along = [Q_0 * np.fft.fftfreq(n, 1 / n) for n in heights.shape]
    q = np.hypot(along[0][:, None], along[1]) if heights.ndim == 2 else np.abs(along[0])
    return q.ravel()[1:], (np.abs(np.fft.fftn(heights)) ** 2 / heights.size**2).ravel()[1:]


@pytest.mark.parametrize("roll", [1.0, 4.0])
@pytest.mark.parametrize("hurst", HURSTS)
@pytest.mark.parametrize("height", [{"rms_height": 2.0}, {"C_0": 0.3}])
def test_bodies_have_the_spectrum_and_the_moments_of_their_lattice(hurst, roll, height):
    spectrum = rough(hurst, roll, **height)
    for body in ("surface", "line"):
        q, power = measured(getattr(spectrum, body)(N, 3).heights)
        lattice = spectrum.lattice(N, body)
        carried = (q < 32.5 * Q_0) & (q > 0)
        if body == "surface":
            found = power / Q_0**2
            expected = lattice.C_2d(q)
        else:
            found = power / Q_0
            expected = lattice.C_reduced(q)
        assert found[carried] == pytest.approx(expected[carried], rel=1e-6, abs=1e-20)
        for order in (0, 2, 4):
            assert lattice.moment(order) == pytest.approx((power * q**order).sum(), rel=ROUNDING)
        assert lattice.rms_slope == pytest.approx(math.sqrt((power * q**2).sum()), rel=ROUNDING)


@pytest.mark.parametrize(("hurst", "factor"), [(0.2, 1.208), (0.6, 1.535), (1.0, 1.919)])
def test_without_a_roll_off_the_continuum_is_another_spectrum_and_says_so(hurst, factor):
    spectrum = rough(hurst, waves=64)
    q, power = measured(spectrum.surface(256, 1).heights)
    ring = np.abs(q - 20 * Q_0) < 0.5 * Q_0
    fits = power[ring] / Q_0**2 / spectrum.continuum.C_2d(q[ring])
    assert 1 / np.median(fits) == pytest.approx(factor, rel=0.01)
    for ask in (
        lambda: spectrum.C_2d(q),
        lambda: spectrum.C_0,
        lambda: spectrum.C_profile(q),
        lambda: spectrum.moment(2),
    ):
        with pytest.warns(rl.ContinuumWarning, match=r"of the surfaces .* Take lattice\(n\)\."):
            ask()
    with pytest.warns(rl.ContinuumWarning, match=r'of the lines .* Take lattice\(n, "line"\)'):
        spectrum.C_reduced(q)
    given = rough(hurst, waves=64, C_0=1.0)
    with pytest.warns(rl.ContinuumWarning, match=r"rms_height is that of the continuum"):
        _ = given.rms_height
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        given.C_2d(q)  # both are made from it
        assert spectrum.moment(0) == pytest.approx(spectrum.rms_height**2)


@pytest.mark.parametrize("hurst", HURSTS)
def test_silence_means_less_than_5_per_cent(hurst):
    for roll in (1.0, 1.5, 2.0, 3.0, 4.0, 8.0):
        spectrum = rough(hurst, roll, waves=64)
        surface, line = (spectrum.lattice(256, body) for body in ("surface", "line"))
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            far = (
                abs(spectrum.C_0 / surface.C_0 - 1),
                abs(spectrum.C_reduced(30.0) / line.C_reduced(30.0) - 1),
            )
        told = ["C_0 is" in str(each.message) for each in said]
        assert (far[0] > 0.05) == (True in told)
        assert (far[1] > 0.05) == (False in told)


@pytest.mark.parametrize("roll", [1.0, 2.0, 4.0])
@pytest.mark.parametrize("hurst", [0.2, 0.6, 1.0])
def test_theories_of_a_spectrum_are_those_of_its_surfaces(hurst, roll):
    spectrum, n = rough(hurst, roll, waves=16), 64
    surface = spectrum.surface(n, 3)
    q, power = measured(surface.heights)
    slope = math.sqrt((power * q**2).sum())
    p = np.array([0.002, 0.02, 0.1]) * slope
    gap, stiffness = persson(q, power, p)
    for roughness in (surface, spectrum.lattice(n), rl.isotropic_spectrum(surface)):
        found = moments(roughness)
        for moment, order, factor in ((found.m0, 0, 1), (found.m2, 2, 2), (found.m4, 4, 8 / 3)):
            assert moment * factor == pytest.approx((power * q**order).sum(), rel=CLOSE)
        theory = rl.theory("persson", roughness, 1.0, p)
        assert theory.mean_gap == pytest.approx(gap, rel=CLOSE)
        assert theory.stiffness == pytest.approx(stiffness, rel=CLOSE)
        assert theory.area_fraction == pytest.approx(special.erf(np.sqrt(2) * p / slope), rel=CLOSE)


def persson(q, power, pressures):
    """Gap and stiffness of discrete waves, E* = 1: Persson's integrals (2007, eqs. 10 to 13).

    Waves of one wavenumber are passed in many steps, in the order of their wavenumbers; the gap is
    the integral of dp / K from p to full contact.
    """
    shells, index = np.unique(np.round(q, 9), return_inverse=True)
    carried = np.bincount(index, weights=power)
    there = carried > 1e-12 * carried.max()
    fine_q = np.repeat(shells[there], STEPS)
    fine = np.repeat(carried[there] / STEPS, STEPS)  # 2 pi q C dq
    w = 1 / np.sqrt(np.cumsum(fine_q**2 * fine / 2) - fine_q**2 * fine / 4)
    kernel = fine_q * fine * w / (2 * math.sqrt(math.pi))  # sqrt(pi) q² C w dq

    def compliance(p):
        share = 0.45 + 3 * 0.55 * special.erf(w * p) ** 2
        return (kernel * share * np.exp(-((w * p) ** 2))).sum() / p

    gaps = []
    for p in pressures:
        to = np.geomspace(p, 20 * pressures[-1], 100)
        gaps.append(integrate.trapezoid([each * compliance(each) for each in to], np.log(to)))
    return np.array(gaps), np.array([1 / compliance(p) for p in pressures])


def test_a_theory_of_a_spectrum_itself_says_what_it_is_of():
    p = 0.1
    validity = rl.theory("persson", rough(0.8), 1.0, p).validity
    q, power = measured(rough(0.8).surface(N, 1).heights)
    factor = rough(0.8).continuum.C_2d(q[9]) * Q_0**2 / power[9]
    assert f"of the continuum, with {factor:.2f} times the C_2d of the surfaces" in validity
    given = rough(0.8, C_0=1.0)
    factor = given.continuum.rms_height / given.surface(N, 1).rms_height
    validity = rl.theory("persson", given, 1.0, p).validity
    assert f"of the continuum, with {factor:.2f} times the rms height of the surfaces" in validity
    assert "spectrum.lattice(n)" in validity
    for quiet in (rough(0.8).continuum, rough(0.8).lattice(N), rough(0.8, 4.0)):
        assert "continuum" not in rl.theory("persson", quiet, 1.0, p).validity


def test_a_surface_that_was_cut_out_keeps_its_window():
    cut = rough(0.6, 8.0).surface(256, 1).cropped((10, 138), (20, 148))
    averaged = rl.isotropic_spectrum(cut)
    assert averaged.windowed
    assert bands(cut).power == pytest.approx(bands(averaged).power)


def test_a_line_and_a_spectrum_without_an_end_have_no_theory():
    with pytest.raises(rl.InputError, match="lattice of a line"):
        rl.theory("persson", rough(0.8).lattice(N, "line"), 1.0, 1.0)
    endless = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    with pytest.raises(rl.InputError, match=r"no upper end.*lattice\(n\)"):
        rl.theory("persson", endless, 1.0, 1.0)
    assert rl.theory("persson", endless.lattice(64), 1.0, 1.0).stiffness > 0
    with pytest.raises(rl.InputError, match='body is "profile"'):
        endless.lattice(64, "profile")
    with pytest.raises(rl.InputError, match="n is 2; a whole number"):
        endless.lattice(2)
