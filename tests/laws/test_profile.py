"""Line scans: Abel's integral there and back, and the reduced line that a scan leads to."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.isotropic import isotropic_spectrum
from roughline.profile import profile_spectrum

Q_0 = 2 * math.pi


def rows(surface, step):
    return [
        rl.Line(heights, surface.sizes[1], kind="profile") for heights in surface.heights[::step]
    ]


@pytest.mark.parametrize("hurst", [0.1, 0.3, 0.5, 0.8, 1.0])
def test_the_spectrum_behind_an_exact_cut_is_found(hurst):
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_roll=4 * Q_0, q_high=400 * Q_0)
    any_line = rl.Line(np.random.default_rng(0).normal(size=1024), 1.0, kind="profile")
    cut = profile_spectrum(any_line)
    q = np.arange(1, 512) * Q_0
    bins = np.searchsorted(cut.edges, q) - 1
    exact = np.bincount(bins, spectrum.C_profile(q)) / np.bincount(bins)
    found = replace(cut, C_profile=exact).surface()
    ratio = found.C_2d[1:390] / spectrum.C_2d(found.q[1:390])
    assert np.median(ratio) == pytest.approx(1, rel=0.01)
    assert np.percentile(ratio, [5, 95]) == pytest.approx(1, rel=0.06)
    assert found.C_2d[0] == pytest.approx(spectrum.C_2d(Q_0), rel=0.3)  # the widest bin of all


def test_the_cut_has_the_variance_of_the_line():
    surface = rl.SelfAffine(hurst=0.6, rms_height=2.0, q_roll=8 * Q_0).surface(512, 1)
    cut = profile_spectrum(rows(surface, 1))
    total = 2 * float(cut.C_profile @ np.diff(cut.edges))
    assert total == pytest.approx(cut.rms_height**2, rel=0.05)
    assert cut.rms_height == pytest.approx(2.0, rel=0.05)


@pytest.mark.parametrize("hurst", [0.2, 0.5, 0.8])
def test_one_scan_leads_to_the_stiffness_of_the_map_within_its_interval(hurst):
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_roll=6 * Q_0, q_high=200 * Q_0)
    forces = np.array([0.01, 0.1, 1.0])
    held = []
    for seed in range(8):
        surface = spectrum.surface(512, seed, "gaussian")
        whole = isotropic_spectrum(surface)
        scan = profile_spectrum(rows(surface, 512))
        of_map, of_scan = (
            np.array([rl.press(line, E_star=1.0, forces=forces).stiffness for line in lines])
            for lines in (
                [whole.line(2**14, i) for i in range(40)],
                [scan.drawn(1000 + i).surface().line(2**14, i) for i in range(100)],
            )
        )
        low, high = np.percentile(of_scan, [2.5, 97.5], axis=0)
        held.append((low <= of_map.mean(axis=0)) & (of_map.mean(axis=0) <= high))
    assert np.mean(held) >= 0.9


def test_many_scans_lead_to_the_stiffness_of_the_map():
    surface = rl.SelfAffine(hurst=0.5, rms_height=1.0, q_roll=6 * Q_0, q_high=200 * Q_0).surface(
        512, 3, "gaussian"
    )
    forces = np.array([0.01, 0.1, 1.0])
    sources = (isotropic_spectrum(surface), profile_spectrum(rows(surface, 8)).surface())
    means = [
        np.mean(
            [rl.press(s.line(2**14, i), E_star=1.0, forces=forces).stiffness for i in range(100)], 0
        )
        for s in sources
    ]
    assert means[1] == pytest.approx(means[0], rel=0.06)


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
