"""What was put into synthetic topographies is found again, within the intervals."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import ndimage

import roughline as rl
from benchmarks.made_surfaces import Make, measured, parent_of, piece_of
from roughline.measurement.fit import fit_self_affine
from roughline.spectra.isotropic import isotropic_spectrum
from roughline.spectra.profile import profile_spectrum
from roughline.topography.provenance import Instrument, Provenance

Q_0 = 2 * math.pi


def lattice_rms(hurst, roll, cutoff, C_0):
    """Rms height of the waves of a unit square, by the law."""
    m = np.fft.fftfreq(2 * int(cutoff) + 2, 1 / (2 * int(cutoff) + 2))
    q = np.hypot(m[:, np.newaxis], m)
    q = q[(q > 0) & (q <= cutoff)]
    return math.sqrt(C_0 * Q_0**2 * (np.maximum(1, q / roll) ** (-2 * (hurst + 1))).sum())


def found(fit, hurst, roll, cutoff, last, rms=1.0):
    """Whether each parameter lies in its interval; a ring or bin holds all waves up to the next."""
    return (
        fit.hurst_interval[0] <= hurst <= fit.hurst_interval[1],
        fit.q_roll_interval[0] <= roll * Q_0 * (1 + 1e-9) and roll * Q_0 <= fit.q_roll_interval[1],
        fit.q_high_interval[0] <= cutoff * Q_0 <= fit.q_high_interval[1] * last,
        fit.rms_interval[0] <= rms <= fit.rms_interval[1],
    )


def of(pixels=None, blur=None, tip_radius=None):
    """What is known of the instrument."""
    return Provenance(Instrument(pixels, blur, tip_radius))


LAWS = [  # H, roll-off and cutoff, where there are such
    (0.3, 8.0, 64.0),
    (0.6, None, 40.0),
    (0.9, 5.0, 30.0),
]


@pytest.mark.parametrize("amplitudes", ["fixed", "gaussian"])
@pytest.mark.parametrize(("hurst", "roll", "cutoff"), LAWS)
def test_whole_surfaces_are_recovered(amplitudes, hurst, roll, cutoff):
    n, roll = 128, roll or 1.0
    q_high = None if cutoff == n / 2 else cutoff * Q_0
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_roll=roll * Q_0, q_high=q_high)
    fit = fit_self_affine(isotropic_spectrum(spectrum.surface(n, 7, amplitudes)))
    assert all(found(fit, hurst, roll, cutoff, last=1 + 1 / (n / 2 - 1)))
    assert fit.hurst == pytest.approx(hurst, abs=0.06)
    assert fit.rms_height == pytest.approx(1.0, rel=0.02)
    assert not any("off the law" in text for text in fit.objections)


PARENT = 4  # sides of a piece in the surface that it is cut from


@pytest.mark.parametrize(("hurst", "roll", "cutoff"), LAWS)
def test_a_tilted_piece_is_recovered(hurst, roll, cutoff):
    n, roll = 128, roll or 1 / PARENT
    spectrum = rl.SelfAffine(
        hurst=hurst, length=PARENT, C_0=1.0, q_roll=roll * Q_0 * (1 + 1e-12), q_high=cutoff * Q_0
    )
    heights = spectrum.surface(PARENT * n, 9, "gaussian").heights
    x = np.linspace(-1, 1, n)
    tilt = heights.std() * (x - 0.7 * x[:, np.newaxis])  # as an instrument has it
    piece = rl.Surface(heights[n : 2 * n, 60 : 60 + n] + tilt, (1.0, 1.0), is_cut_out=True)
    fit = fit_self_affine(isotropic_spectrum(piece))
    rms = lattice_rms(hurst, roll, cutoff, 1.0)
    assert all(found(fit, hurst, roll, cutoff, last=1 + 1 / (n / 2 - 1), rms=rms))
    assert fit.hurst == pytest.approx(hurst, abs=0.12)


def piece_of_a_cut(rng, n, spectrum, longer):
    """Piece of a cut with independent Gaussian modes of the exact spectrum C_profile."""
    power = (
        spectrum.continuum.C_profile(np.arange(1, longer * n // 2) * Q_0 / longer) * Q_0 / longer
    )
    modes = np.sqrt(power / 2) * (rng.normal(size=power.size) + 1j * rng.normal(size=power.size))
    whole = np.fft.irfft([0, *modes, 0], longer * n) * longer * n
    return whole[:n] + rng.normal() * np.linspace(-1, 1, n)


@pytest.mark.parametrize("n", [256, 2048])
@pytest.mark.parametrize(("hurst", "roll", "share"), [(0.3, 8.0, 1.0), (0.7, None, 0.5)])
def test_a_line_scan_is_recovered(n, hurst, roll, share):
    longer, cutoff = 8, share * n / 2
    roll = roll or 1 / longer
    spectrum = rl.SelfAffine(
        hurst=hurst, length=longer, C_0=1.0, q_roll=roll * Q_0 * (1 + 1e-12), q_high=cutoff * Q_0
    )
    heights = piece_of_a_cut(np.random.default_rng(8), n, spectrum, longer)
    fit = fit_self_affine(profile_spectrum(rl.Line(heights, 1.0, kind="profile")))
    rms = lattice_rms(hurst, roll, cutoff, 1.0)
    assert all(found(fit, hurst, roll, cutoff, last=1.12, rms=rms))  # 20 bins a decade
    assert fit.hurst == pytest.approx(hurst, abs=0.15)


def test_intervals_are_not_idle():
    """On 512² points H is known to a tenth, a roll-off and a cutoff to some rings."""
    spectrum = rl.SelfAffine(hurst=0.6, rms_height=1.0, q_roll=8 * Q_0, q_high=150 * Q_0)
    exact = replace(spectrum.surface(512, 3, "gaussian"), provenance=of("points", 0))
    fit = fit_self_affine(isotropic_spectrum(exact))
    assert fit.hurst == pytest.approx(0.6, abs=0.05)
    assert np.ptp(fit.hurst_interval) < 0.12
    assert np.ptp(fit.q_roll_interval) < 5 * Q_0
    assert np.ptp(fit.q_high_interval) < 10 * Q_0
    assert fit.objections == []
    again = fit.spectrum()
    assert again.hurst == fit.hurst
    assert fit.values(np.array([2 * Q_0, 40 * Q_0])) == pytest.approx(
        spectrum.C_2d([2 * Q_0, 40 * Q_0]), rel=0.15
    )
    assert np.isnan(fit.values(np.array([200 * Q_0]))).all()


def test_what_is_not_self_affine_is_said():
    noise = rl.Surface(np.random.default_rng(1).normal(size=(128, 128)), (1.0, 1.0))
    assert fit_self_affine(isotropic_spectrum(noise)).objections
    x = np.arange(128) / 128
    waves = 0.1 * noise.heights + np.cos(16 * np.pi * x) + np.cos(50 * np.pi * x)[:, np.newaxis]
    assert fit_self_affine(isotropic_spectrum(rl.Surface(waves, (1.0, 1.0)))).objections
    with pytest.raises(rl.InputError, match="a fit needs 12"):
        fit_self_affine(isotropic_spectrum(rl.Surface(noise.heights[:12, :12], (1.0, 1.0))))


def test_a_refused_law_has_no_intervals_and_makes_no_surface():
    """White noise has an rms height of 1; no law with a slope holds it."""
    noise = rl.Surface(np.random.default_rng(1).normal(size=(128, 128)), (1.0, 1.0))
    fit = fit_self_affine(isotropic_spectrum(noise))
    assert not fit.is_judged
    assert np.isnan([*fit.rms_interval, *fit.q_roll_interval, *fit.blur_interval]).all()
    assert fit.without_intervals().objections == fit.objections
    with pytest.raises(rl.InputError, match="no self-affine spectrum like this one: the power law"):
        fit.spectrum()


def off_the_law(spectrum, fit):
    """Rms over tenths of a decade of the logarithm of the spectrum over the fitted law.

    Of those with 40 modes or more, before the instrument's tail: chance leaves less than .1 there.
    """
    law = fit.values(spectrum.q)
    inside = np.isfinite(law) & (spectrum.modes > 0) & (spectrum.q < (fit.q_tail or math.inf))
    tenths = np.unique(np.floor(10 * np.log10(spectrum.q[inside])), return_inverse=True)[1]
    modes, power, expected = (
        np.bincount(tenths, spectrum.modes[inside] * values[inside])
        for values in (np.ones(law.size), spectrum.C_2d, law)
    )
    known = modes >= 40
    return np.sqrt(np.mean(np.log10(power[known] / expected[known]) ** 2))


def binned_hurst(spectrum, fit):
    """H by least squares over tenths of a decade of the power law that the surface shows."""
    inside = (spectrum.q >= 2 * fit.q_roll) & (spectrum.q < fit.q_tail) & (spectrum.modes > 0)
    q, power = spectrum.q[inside], spectrum.C_2d[inside]
    tenths = np.floor(10 * np.log10(q)).astype(int)
    means = [
        [np.log(values[tenths == tenth].mean()) for tenth in np.unique(tenths)]
        for values in (q, power)
    ]
    return -np.polyfit(*means, 1)[0] / 2 - 1


@pytest.mark.parametrize("part", [1 / 2, 1])
def test_all_decades_of_a_measured_map_count(topographies, part):
    whole = rl.read(topographies / "opd-1.opd")
    surface = rl.prepared(whole.cropped(*((0, round(part * n)) for n in whole.shape)))
    spectrum = isotropic_spectrum(surface)
    fit = fit_self_affine(spectrum)
    assert fit.hurst_interval[0] <= binned_hurst(spectrum, fit) <= fit.hurst_interval[1]
    assert off_the_law(spectrum, fit) < 0.2


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("hursts", [(0.1, 0.6), (0.9, 0.4), (0.3, 1.0)])
def test_where_the_slope_changes_the_law_is_near_or_refused(hursts, seed):
    n, (long, short) = 256, hursts
    waves = rl.SelfAffine(hurst=long, rms_height=1.0, q_roll=4 * Q_0).surface(n, seed, "gaussian")
    q = np.hypot(*np.meshgrid(*[np.fft.fftfreq(n, 1 / n)] * 2))
    steeper = np.maximum(1.0, q / 25) ** -(short - long)
    heights = np.fft.ifft2(np.fft.fft2(waves.heights) * steeper).real
    spectrum = isotropic_spectrum(rl.Surface(heights, (1.0, 1.0)))
    fit = fit_self_affine(spectrum)
    assert min(hursts) - 0.1 < fit.hurst < max(hursts) + 0.1
    assert fit.objections or off_the_law(spectrum, fit) < 0.2


def test_units_are_neutral():
    surface = rl.SelfAffine(hurst=0.6, rms_height=1.0, q_roll=8 * Q_0).surface(128, 3)
    one = fit_self_affine(isotropic_spectrum(surface))
    tiny = rl.Surface(surface.heights * 1e-9, (1e-6, 1e-6))
    other = fit_self_affine(isotropic_spectrum(tiny))
    assert other.hurst == one.hurst
    assert other.hurst_interval == one.hurst_interval
    assert other.q_roll == pytest.approx(one.q_roll * 1e6, rel=1e-9)
    assert other.rms_interval == pytest.approx(np.array(one.rms_interval) * 1e-9, rel=1e-9)


def seen(instrument, number, corner="sharp roll-off", **make):
    """A map of 64² pixels as an instrument sees a piece that is four times finer, and its H."""
    rng = np.random.default_rng([17, number])
    made = Make(**{"points": 256, "maps": 2, "hurst": rng.uniform(0.3, 0.9), "waves": 5.0, **make})
    piece = piece_of(parent_of(corner, made, rng), made, rng)
    return rl.Surface(measured(piece, instrument, 4, rng), piece.sizes, "m"), made.hurst


@pytest.mark.parametrize(
    ("instrument", "corner"),
    [
        ("pixel means", "sharp roll-off"),
        ("points of a rougher surface", "sharp roll-off"),
        ("blur of half a pixel", "sharp roll-off"),
        ("noise", "sharp roll-off"),
        ("pixel means", "smooth roll-off"),
    ],
)
def test_the_exponent_is_held_through_every_instrument_and_corner(instrument, corner):
    held = 0
    for number in range(4):
        body, hurst = seen(instrument, number, corner)
        fit = fit_self_affine(isotropic_spectrum(replace(body, is_cut_out=True)))
        held += fit.hurst_interval[0] <= hurst <= fit.hurst_interval[1]
    assert held >= 3


def test_what_is_told_of_the_instrument_narrows_the_interval():
    body, hurst = seen("blur of a pixel", 1)
    told = replace(body, provenance=of("points", body.spacing[0]), is_cut_out=True)
    unknown, known = (
        fit_self_affine(isotropic_spectrum(each)) for each in (replace(body, is_cut_out=True), told)
    )
    assert known.blur == pytest.approx(body.spacing[0])
    assert np.ptp(known.hurst_interval) < np.ptp(unknown.hurst_interval)
    assert known.hurst_interval[0] <= hurst <= known.hurst_interval[1]


def test_a_law_may_end_on_a_map_whose_blur_is_told():
    spectrum = rl.SelfAffine(hurst=0.7, rms_height=1.0, q_roll=6 * Q_0, q_high=30 * Q_0)
    blurred = ndimage.gaussian_filter(spectrum.surface(128, 5, "gaussian").heights, 1, mode="wrap")
    told = rl.Surface(blurred, (1.0, 1.0), is_cut_out=False, provenance=of("points", 1 / 128))
    fit = fit_self_affine(isotropic_spectrum(told))
    assert fit.remarks == ()
    assert fit.hurst_interval[0] <= 0.7 <= fit.hurst_interval[1]
    assert fit.q_high_interval[0] <= 30 * Q_0 <= fit.q_high_interval[1]


def test_a_blurred_map_told_to_be_of_points_is_said():
    body, hurst = seen("blur of a pixel", 2)
    told = replace(body, provenance=of("points", 0.0), is_cut_out=True)
    fit = fit_self_affine(isotropic_spectrum(told))
    assert any("not that of the instrument as it was told" in each for each in fit.objections)
    assert fit.hurst_interval[0] <= hurst <= fit.hurst_interval[1]


def test_a_drawn_out_surface_has_no_interval():
    body, _ = seen("pixel means", 3, "ground, 9")
    fit = fit_self_affine(isotropic_spectrum(replace(body, is_cut_out=True)))
    assert not fit.is_judged
    assert "slopes differ by direction" in fit.objections[0]
    assert fit.hurst_in_words.endswith("(not judged)")


def test_waves_that_a_tip_does_not_follow_are_left_out():
    body, _ = seen("stylus tip", 4)
    told = replace(body, provenance=of(tip_radius=2e-4), is_cut_out=True)
    fit = fit_self_affine(isotropic_spectrum(told))
    assert fit.q_last < isotropic_spectrum(body).q[-1]
    far = replace(told, provenance=of(tip_radius=1.0))
    with pytest.raises(rl.InputError, match="check tip_radius"):
        fit_self_affine(isotropic_spectrum(far))
