"""Random bodies: their spectrum, their seeds, and that more points mean more detail."""

import numpy as np
import pytest

import roughline as rl

ROUNDING = 1e-12


def by_rms(hurst=0.7, **settings):
    return rl.SelfAffine(hurst=hurst, length=3.0, rms_height=2.0, **settings)


def by_C_0(hurst=0.7, **settings):
    return rl.SelfAffine(hurst=hurst, length=3.0, C_0=2.0, **settings)


def modes(body):
    return np.fft.fftn(body.heights) / body.heights.size


@pytest.mark.parametrize("n", [3, 4, 31, 32, 97, 128])
def test_the_rms_is_met_exactly(n):
    assert by_rms().surface(n, 7).rms_height == pytest.approx(2.0, rel=ROUNDING)
    assert by_rms().line(n, 7).rms_height == pytest.approx(2.0, rel=ROUNDING)


@pytest.mark.parametrize("n", [4, 31, 32, 97])
@pytest.mark.parametrize("hurst", [0.0, 0.5, 1.0])
def test_every_mode_has_the_modulus_of_the_spectrum(n, hurst):
    spectrum = by_C_0(hurst)
    m = np.fft.fftfreq(n, 1 / n)
    radius = np.hypot(m[:, None], m)
    inside = (radius > 0) & (radius < n / 2)
    expected = np.zeros((n, n))
    q = spectrum.q_low * radius[inside]
    expected[inside] = spectrum.q_low * np.sqrt(spectrum.C_2d(q))
    found = np.abs(modes(spectrum.surface(n, 7)))
    assert np.abs(found - expected).max() < ROUNDING * expected.max()
    q = spectrum.q_low * np.arange(1, (n - 1) // 2 + 1)
    found = np.abs(modes(spectrum.line(n, 7)))[1 : q.size + 1]
    assert found == pytest.approx(np.sqrt(spectrum.q_low * spectrum.C_reduced(q)), rel=1e-10)


@pytest.mark.parametrize("body", ["surface", "line"])
def test_heights_have_the_moments_of_the_lattice_sum(body):
    spectrum = by_C_0(q_roll=9.0, q_high=40.0)
    heights = getattr(spectrum, body)(64, 7).heights
    assert np.mean(heights**2) == pytest.approx(spectrum.lattice(64, body).moment(0), rel=1e-12)
    q = 2 * np.pi * np.fft.fftfreq(64, 3.0 / 64)
    spectrum_2 = np.abs(np.fft.fftn(heights) / heights.size) ** 2
    q2 = q**2 if body == "line" else q[:, None] ** 2 + q**2
    for order in (2, 4):
        assert (spectrum_2 * q2 ** (order / 2)).sum() == pytest.approx(
            spectrum.lattice(64, body).moment(order), rel=1e-10
        )


@pytest.mark.parametrize(("coarse", "fine"), [(32, 64), (31, 64), (64, 65), (32, 255)])
def test_a_finer_grid_is_the_same_surface_with_more_detail(coarse, fine):
    spectrum = by_C_0()
    half = (coarse - 1) // 2
    kept = np.r_[0 : half + 1, -half:0]
    a = modes(spectrum.surface(coarse, 5))[np.ix_(kept, kept)]
    b = modes(spectrum.surface(fine, 5))[np.ix_(kept, kept)]
    inside = np.hypot(kept[:, None], kept) < coarse / 2
    assert np.abs(a - b)[inside].max() < ROUNDING * np.abs(a).max()
    a, b = modes(spectrum.line(coarse, 5))[kept], modes(spectrum.line(fine, 5))[kept]
    assert np.abs(a - b).max() < ROUNDING * np.abs(a).max()


def test_a_finer_grid_scaled_to_the_rms_is_the_same_up_to_one_factor():
    coarse, fine = (by_rms(0.2).surface(n, 5) for n in (32, 64))
    half = np.arange(1, 15)
    ratio = modes(fine)[half, half[:10, None]] / modes(coarse)[half, half[:10, None]]
    inside = np.hypot(half, half[:10, None]) < 16
    assert np.ptp(ratio[inside].real) < 1e-10
    assert np.abs(ratio[inside].imag).max() < 1e-10


@pytest.mark.parametrize("body", ["surface", "line"])
def test_phases_are_shared_across_fractal_dimensions(body):
    phases = [np.angle(modes(getattr(by_rms(hurst), body)(32, 3))) for hurst in (0.0, 0.5, 1.0)]
    inner = (slice(1, 8),) * phases[0].ndim
    assert phases[0][inner] == pytest.approx(phases[1][inner], abs=1e-10)
    assert phases[0][inner] == pytest.approx(phases[2][inner], abs=1e-10)


@pytest.mark.parametrize("body", ["surface", "line"])
def test_gaussian_amplitudes_keep_the_phases_and_the_mean_spectrum(body):
    spectrum = by_C_0()
    make = getattr(spectrum, body)
    inner = (slice(1, 8),) * (2 if body == "surface" else 1)
    fixed, gaussian = modes(make(32, 3)), modes(make(32, 3, "gaussian"))
    assert np.angle(fixed[inner]) == pytest.approx(np.angle(gaussian[inner]), abs=1e-10)
    powers = [np.mean(make(32, i, "gaussian").heights ** 2) for i in range(400)]
    standard_error = np.std(powers) / 20
    assert abs(np.mean(powers) - spectrum.lattice(32, body).moment(0)) < 4 * standard_error
    # a single mode's power is exponential: its deviation equals its mean
    first = [np.abs(modes(make(8, i, "gaussian")).flat[1]) ** 2 for i in range(1000)]
    assert np.std(first) / np.mean(first) == pytest.approx(1.0, abs=0.15)


def test_the_same_seed_gives_the_same_bytes():
    for body in ("surface", "line"):
        make = getattr(by_rms(), body)
        assert make(33, 7).heights.tobytes() == make(33, np.int64(7)).heights.tobytes()
        assert (
            make(33, 7).heights.tobytes() == make(33, np.random.SeedSequence(7)).heights.tobytes()
        )
        assert make(33, 7).heights.tobytes() != make(33, 8).heights.tobytes()


def test_a_realisation_does_not_depend_on_how_many_there_are():
    few, many = (np.random.SeedSequence(1).spawn(count) for count in (3, 30))
    alone = np.random.SeedSequence(1, spawn_key=(2,))
    heights = [by_rms().surface(16, seed).heights for seed in (few[2], many[2], alone)]
    assert heights[0].tobytes() == heights[1].tobytes() == heights[2].tobytes()


def test_settings_travel_with_the_body():
    settings = by_rms(q_roll=9.0).surface(16, 7).settings
    assert settings["normalisation"] == "rms_height"
    assert settings["seed"] == "entropy 7, spawn key ()"
    assert (settings["hurst"], settings["n"], settings["q_roll"]) == (0.7, 16, 9.0)
    assert by_C_0().line(16, 7).settings["C_0"] == 2.0


def test_q_high_cuts_the_heights_too():
    found = np.abs(modes(by_C_0(q_high=10.0).surface(32, 7)))
    radius = 2 * np.pi / 3 * np.hypot(*np.meshgrid(*[np.fft.fftfreq(32, 1 / 32)] * 2))
    assert found[radius > 10.1].max() < 1e-12 * found.max()


@pytest.mark.parametrize("points", [2**18, 2**24])
def test_the_longest_line_works(points):
    assert by_rms().line(points, 7).rms_height == pytest.approx(2.0, rel=1e-9)


@pytest.mark.parametrize(
    ("n", "rng", "amplitudes", "message"),
    [
        (2, 1, "fixed", "n is 2; a whole number of points from 3"),
        (8.5, 1, "fixed", "n is 8.5"),
        (10**6, 1, "fixed", "n is 1000000; a whole number of points from 3 to 32768"),
        (8, -1, "fixed", "rng is -1; a seed is a non-negative integer"),
        (8, "seven", "fixed", "rng is 'seven'"),
        (8, 1, "uniform", 'amplitudes is "uniform"'),
    ],
)
def test_impossible_bodies_are_refused(n, rng, amplitudes, message):
    with pytest.raises(rl.InputError, match=message):
        by_rms().surface(n, rng, amplitudes)


def test_a_seed_sequence_may_be_used_again():
    seed = np.random.SeedSequence(7)
    first, second = (by_rms().surface(16, seed, "gaussian").heights for _ in range(2))
    assert first.tobytes() == second.tobytes()
    assert first.tobytes() == by_rms().surface(16, 7, "gaussian").heights.tobytes()


def test_a_generator_moves_on():
    rng = np.random.default_rng(7)
    first, second = (by_rms().surface(16, rng) for _ in range(2))
    assert first.heights.tobytes() == by_rms().surface(16, 7).heights.tobytes()
    assert first.heights.tobytes() != second.heights.tobytes()
    assert first.settings["seed"] == "a generator in an unknown state"
