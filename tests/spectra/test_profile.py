"""Line scans: the spectrum of cuts, what a piece shows of it, and the stiffness behind a scan."""

import math

import numpy as np
import pytest

import roughline as rl
from roughline.measurement.scan_bins import ScanBins
from roughline.spectra.isotropic import isotropic_spectrum
from roughline.spectra.leakage import map_leakage
from roughline.spectra.profile import profile_spectrum

Q_0 = 2 * math.pi


def rows(surface, step):
    return [
        rl.Line(heights, surface.sizes[1], kind="profile") for heights in surface.heights[::step]
    ]


def test_the_cut_has_the_variance_of_the_line():
    surface = rl.SelfAffine(hurst=0.6, rms_height=2.0, q_roll=8 * Q_0).surface(512, 1)
    cut = profile_spectrum(rows(surface, 1))
    total = 2 * float(cut.C_profile @ np.diff(cut.edges))
    assert total == pytest.approx(cut.rms_height**2, rel=0.05)
    assert cut.rms_height == pytest.approx(2.0, rel=0.05)


def long_law(hurst, roll, length):
    return rl.SelfAffine(
        hurst=hurst, length=length, C_0=1.0, q_roll=roll * Q_0 * (1 + 1e-12), q_high=60 * Q_0
    )


@pytest.mark.parametrize(("hurst", "roll"), [(0.8, 4.0), (0.8, 1 / 8), (0.2, 1 / 8)])
def test_pieces_of_cuts_have_the_expected_spectrum(hurst, roll):
    """Means over random pieces, tilted, against Abel's integral and the leakage of their ends."""
    n, longer, count = 256, 8, 1500
    spectrum, rng = long_law(hurst, roll, longer), np.random.default_rng(1)
    power = (
        spectrum.continuum.C_profile(np.arange(1, longer * n // 2) * Q_0 / longer) * Q_0 / longer
    )
    modes = rng.normal(size=(count, 2, power.size)) * np.sqrt(power / 2)
    whole = np.zeros((count, longer * n // 2 + 1), dtype=complex)
    whole[:, 1:-1] = modes[:, 0] + 1j * modes[:, 1]
    pieces = (np.fft.irfft(whole, axis=1) * longer * n)[:, :n] + np.linspace(-9, 9, n)
    found = profile_spectrum([rl.Line(piece, 1.0, kind="profile") for piece in pieces])
    cuts = ScanBins.of(found).cuts
    levels = np.where(cuts.edges[1:] < 61, np.maximum(1, cuts.q / roll) ** (-2 * (hurst + 1)), 0)
    inside = found.q < 40 * Q_0  # the end lies within a bin
    expected = (cuts.matrix @ levels)[inside] * Q_0
    chance = np.sqrt(4 / found.modes[inside])  # two modes of a window are about one
    assert (np.abs(found.C_profile[inside] / expected - 1) < 0.03 + 4 * chance).all()
    # few long waves decide the mean square: 4 % is what chance leaves of 1500
    assert found.rms_height**2 == pytest.approx(cuts.mean_square @ levels * Q_0**2, rel=0.12)


@pytest.mark.parametrize(("hurst", "roll"), [(0.8, 4.0), (0.8, 1 / 4), (0.2, 1 / 4)])
def test_pieces_of_surfaces_have_the_expected_spectrum(hurst, roll):
    n, longer, powers = 64, 4, []
    spectrum = rl.SelfAffine(
        hurst=hurst, length=longer, C_0=1.0, q_roll=roll * Q_0 * (1 + 1e-12), q_high=24 * Q_0
    )
    x = np.linspace(-1, 1, n)
    for seed in range(24):
        heights = spectrum.surface(longer * n, seed, "gaussian").heights
        for i in range(0, longer * n, n):
            for j in range(0, longer * n, n):
                tilted = heights[i : i + n, j : j + n] + 3 * x - 2 * x[:, np.newaxis]
                piece = rl.Surface(tilted, (1.0, 1.0), is_cut_out=True)
                powers.append(isotropic_spectrum(piece).C_2d)
    leakage = map_leakage()
    levels = np.maximum(1, leakage.waves / roll) ** (-2.0 * (hurst + 1)) * (leakage.waves < 24)
    expected = (leakage.response @ levels)[:28]
    found = np.mean(powers, axis=0)[:28]
    assert found[:20] == pytest.approx(expected[:20], rel=0.12)
    assert found[20:24] == pytest.approx(expected[20:24], rel=0.3)  # the skirt of the end
    assert found[24:28].max() < 0.2 * found[20]


@pytest.mark.parametrize(("hurst", "roll"), [(0.8, 4.0), (0.8, 1 / 4), (0.3, 4.0)])
def test_one_scan_leads_to_the_stiffness_of_its_surface(hurst, roll):
    """A row of a tilted piece of a Gaussian surface against the full model of the piece."""
    n, longer = 128, 4
    parent = rl.SelfAffine(hurst=hurst, length=longer, C_0=1.0, q_roll=roll * Q_0 * (1 + 1e-12))
    heights = parent.surface(longer * n, 1, "gaussian").heights
    piece = rl.Surface(heights[:n, :n], (1.0, 1.0), is_cut_out=True).detrended()
    forces = np.array([0.01, 0.1, 1.0]) * piece.rms_height
    full = rl.press(piece, E_star=1.0, forces=forces, rtol=1e-3).stiffness
    scan = rl.Line(heights[0, :n] + 5 * np.linspace(-1, 1, n), 1.0, kind="profile")
    found = rl.press_scan(scan, E_star=1.0, forces=forces, gaussian=True, rng=1)
    assert ((found.low < full) & (full < found.high)).all()
    assert (found.low < found.curve.stiffness).all()
    assert (found.curve.stiffness < found.high).all()
    # one scan of few long waves knows the stiffness of its surface to a factor of 1.6
    assert np.abs(np.log(found.curve.stiffness / full)).max() < math.log(1.6)


def test_what_does_not_follow_a_law_is_kept():
    """A spectrum with a bump: half of the variance in waves that no law has."""
    n, rng = 1024, np.random.default_rng(3)
    smooth = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=6 * Q_0, q_high=400 * Q_0)
    heights = smooth.surface(n, 5, "gaussian").heights[0]
    x, extra = np.arange(n) / n, np.zeros(n)
    for m in range(28, 36):
        extra += 0.5 * np.cos(2 * np.pi * m * x + rng.uniform(0, 7))
    forces = [0.1]
    without, having = (
        rl.press_scan(rl.Line(h, 1.0, kind="profile"), E_star=1.0, forces=forces)
        for h in (heights, heights + extra)
    )
    rms = [np.median(each.curve.rms_height) for each in (without, having)]
    assert rms[1] ** 2 - rms[0] ** 2 > 0.5 * extra.var()
    assert having.curve.stiffness[0] < without.curve.stiffness[0]


def test_bad_lines_get_one_line():
    reduced = rl.SelfAffine(hurst=0.5, rms_height=1.0).line(256, 1)
    with pytest.raises(rl.InputError, match="this is a reduced line"):
        profile_spectrum(reduced)
    flat = rl.Line(np.linspace(0, 1, 100), 1.0, kind="profile")
    with pytest.raises(rl.InputError, match="they have no spectrum"):
        profile_spectrum(flat)
    with pytest.raises(rl.InputError, match="a spectrum needs 64"):
        profile_spectrum(rl.Line(np.arange(9.0), 1.0, kind="profile"))
    others = [rl.Line(np.sin(np.arange(n)), 1.0, kind="profile") for n in (100, 101)]
    with pytest.raises(rl.InputError, match="differ in length or points"):
        profile_spectrum(others)
