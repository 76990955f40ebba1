"""Whether a body is periodic or a piece of a larger one, where only its heights tell."""

from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.topography.borders import border_doubts, decided

HURSTS = (0.2, 0.5, 0.8, 1.0)


def generated(n, hurst, seed, *, longer=1, roll=1.0, cutoff=None):
    """Heights of a random surface, whose unit of length is the side of a piece of n points."""
    spectrum = rl.SelfAffine(
        hurst=hurst,
        length=longer,
        C_0=1.0,
        q_roll=2 * np.pi * roll * (1 + 1e-12),
        q_high=None if cutoff is None else 2 * np.pi * cutoff,
    )
    return spectrum.surface(longer * n, seed, "gaussian").heights


def rough(n, kind, seed):
    """Heights that are periodic, a piece, or tilted, of a spectrum that the seed chooses."""
    rng = np.random.default_rng(seed)
    roll = rng.choice([1.0, 2.0, n / 16])
    cutoff = rng.choice([n / 2, n / 4])
    hurst = HURSTS[seed % len(HURSTS)]
    longer = 2 if kind == "piece" else 1
    heights = generated(n, hurst, seed, longer=longer, roll=roll, cutoff=cutoff)
    if kind == "piece":
        i, j = rng.integers(0, n, 2)
        return heights[i : i + n, j : j + n]
    if kind == "tilted":
        slope = rng.choice([-1, 1]) * rng.uniform(1, 3)
        return heights + slope * heights.std() * np.linspace(0, 1, n)[:, np.newaxis]
    return heights


def surface(heights):
    return rl.Surface(heights, (1.0, heights.shape[1] / heights.shape[0]))


# docs/decisions/0018-borders.md has 0.7, 0.2 and 2.8 % of 1200 surfaces each
@pytest.mark.parametrize(
    ("kind", "is_cut_out", "most_wrong"),
    [("periodic", False, 0.02), ("piece", True, 0.02), ("tilted", True, 0.05)],
)
def test_the_heights_tell_a_piece_from_a_periodic_surface(kind, is_cut_out, most_wrong):
    found = [surface(rough(64, kind, seed)) for seed in range(200)]
    wrong = [each for each in found if each.is_cut_out != is_cut_out]
    assert len(wrong) <= most_wrong * len(found)
    if kind != "tilted":  # a faint tilt of much shorter waves is seen by nobody
        assert all(decided(each).are_unclear for each in wrong)
    assert np.mean([decided(each).are_unclear for each in found]) < 0.08


@pytest.mark.parametrize("hurst", [0.9, 0.7])
@pytest.mark.parametrize("tilt", [0.0, 1.0])
def test_the_interval_of_a_loaded_map_holds_its_exponent(hurst, tilt):
    n = 64
    for seed in range(3):
        heights = generated(n, hurst, seed, longer=4, roll=1 / 2)[n : 2 * n, :n]
        heights = heights + tilt * heights.std() * np.linspace(-1, 1, n)
        found = surface(heights)
        assert found.is_cut_out
        low, high = rl.fit_self_affine(rl.isotropic_spectrum(found)).hurst_interval
        assert low <= hurst <= high


@pytest.mark.parametrize("n", [16, 65])
@pytest.mark.parametrize("offset", [0.0, 0.5])
def test_shapes_that_meet_by_symmetry_are_periodic(n, offset):
    x = (np.arange(n) + offset) / n - 0.5
    r = np.hypot(x[:, np.newaxis], x)
    for heights in (-(r**2), -r, np.sqrt(4 - r**2), np.where(r < 0.3, 0.0, -1.0), np.zeros((n, n))):
        assert not surface(heights).is_cut_out
        assert not rl.Line(heights[n // 2], 1.0).is_cut_out


@pytest.mark.parametrize(("waves", "is_cut_out"), [(1, False), (3, False), (1.5, True)])
def test_waves_are_periodic_where_they_fit_in(waves, is_cut_out):
    x = np.arange(96) / 96
    wave = np.cos(2 * np.pi * waves * x)
    for heights in (
        wave[:, np.newaxis] * np.ones(32),
        np.ones((32, 1)) * wave,
        wave[:, np.newaxis],
    ):
        assert surface(heights).is_cut_out is is_cut_out
    assert surface(np.outer(wave, np.cos(2 * np.pi * x))).is_cut_out is is_cut_out


def test_walls_that_stand_at_the_border_too_are_ordinary_steps():
    x = np.arange(96) / 96
    for profile in ((4 * x) % 1, np.where((4 * x) % 1 < 0.5, 1.0, 0.0)):
        assert not surface(profile[:, np.newaxis] * np.ones(64)).is_cut_out


@pytest.mark.parametrize("kind", ["periodic", "piece"])
def test_neither_spikes_nor_scratches_nor_digits_decide(kind):
    for seed in range(8):
        heights = generated(64, 0.8, seed, longer=2)
        heights = heights[:64, :64] if kind == "piece" else generated(64, 0.8, seed)
        rms, rng = heights.std(), np.random.default_rng(seed)
        scratch = np.where(np.arange(64) == 20, 3 * rms, 0.0)
        for changed in (
            heights + 40 * rms * (rng.random(heights.shape) < 1e-3),
            heights + scratch,
            np.round(heights * 4 / rms),
            np.minimum(heights, 0.5 * rms),
        ):
            found = surface(changed)
            assert found.is_cut_out == (kind == "piece") or decided(found).are_unclear


@pytest.mark.parametrize("scale", [1e-140, 1.0, 1e140])
@pytest.mark.parametrize("offset", [0.0, 1e6])
def test_unit_and_level_decide_nothing(scale, offset):
    for kind in ("periodic", "piece"):
        heights = rough(32, kind, 3)
        same = surface((heights / heights.std() + offset) * scale)
        assert same.is_cut_out == surface(heights).is_cut_out == (kind == "piece")
    flat = surface(np.full((16, 16), 0.1) + np.spacing(0.1) * (np.arange(16) == 15))
    assert not flat.is_cut_out  # rounding is no jump


def test_what_is_told_or_recorded_is_not_decided():
    heights = rough(64, "piece", 1)
    for told in (True, False, np.True_):
        found = rl.Surface(heights, (1.0, 1.0), is_cut_out=told)
        assert found.is_cut_out is bool(told)
        assert decided(found) is None
        assert "border_step" not in found.settings
    whole = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    for made in (whole.surface(32, 1), whole.line(64, 1)):
        assert not made.is_cut_out
        assert decided(made) is None
    assert rl.Line(heights[0], 1.0, is_cut_out=True).is_cut_out


def test_a_decision_stays_with_the_body_and_is_recorded(tmp_path):
    piece = surface(rough(64, "piece", 1))
    level = piece.detrended("curvature").scaled(2.0)
    assert level.is_cut_out
    assert decided(level) == decided(piece)
    assert level.settings["border_step"] == decided(piece).step > 5
    rl.write(replace(piece, unit="m"), tmp_path / "piece.nc")
    again = rl.read(tmp_path / "piece.nc")
    assert again.is_cut_out
    assert decided(again) == decided(piece)
    whole = surface(rough(64, "periodic", 1))
    assert decided(whole.cropped((0, 32), (0, 32))) is None  # its borders are others
    assert rl.press(piece, E_star=1.0, depths=[1e-3]).settings["body_border_step"] > 5


def test_a_body_says_what_was_decided():
    piece, whole = surface(rough(64, "piece", 1)), surface(rough(64, "periodic", 1))
    assert "cut out of a larger one (opposite borders are" in repr(piece)
    assert "periodic (opposite borders are" in repr(whole)
    assert "<td>borders</td><td>cut out of a larger one (opposite" in piece._repr_html_()
    line = rl.Line(np.linspace(0.0, 1.0, 64), 1.0)
    assert repr(line).endswith("cut out of a larger one (its ends are 63 ordinary steps apart)>")


def unclear():
    """A surface whose borders are further apart than neighbours mostly are, and not clearly so."""
    heights = np.array(rough(64, "periodic", 0))
    for step in np.geomspace(0.01, 10, 200):
        found = surface(heights + step * heights.std() * (np.arange(64) > 62)[:, np.newaxis])
        if decided(found).are_unclear:
            return found
    raise AssertionError


def test_what_the_heights_leave_open_is_said_where_it_matters():
    found = unclear()
    (said,) = map(str, border_doubts(found))
    assert "it is unclear whether these heights are periodic" in said
    assert "(is_cut_out=True or False)" in said
    assert said in rl.press(found, E_star=1.0, depths=[1e-3]).warnings
    assert said in rl.roughness(found).remarks
    assert "(unclear: opposite borders" in repr(found)
    assert not border_doubts(surface(rough(64, "piece", 1)))


def test_a_press_says_what_a_loaded_map_does_at_its_borders():
    piece = surface(rough(64, "piece", 1))
    free = rl.press(piece, E_star=1.0, depths=[piece.rms_height])
    assert any("where this surface was cut out of a larger one" in each for each in free.warnings)
    repeated = rl.press(piece, E_star=1.0, depths=[piece.rms_height], periodic=True)
    assert any("repeated periodically, the map jumps by" in each for each in repeated.warnings)
    whole = surface(rough(64, "periodic", 1))
    for periodic in (False, True):
        assert rl.press(whole, E_star=1.0, depths=[1e-3], periodic=periodic).warnings == ()


def test_a_scan_that_is_pressed_as_a_reduced_line_is_warned_of():
    scan = rl.Line(np.cumsum(np.random.default_rng(2).normal(size=512)), 1.0)
    (said,) = rl.press(scan, E_star=1.0, depths=[0.1]).warnings
    assert 'a measured scan is no reduced line (kind="profile")' in said
    assert not rl.press(replace(scan, is_cut_out=False), E_star=1.0, depths=[0.1]).warnings


def test_two_surfaces_that_do_not_fit_are_a_piece():
    large, small = (
        rl.Surface(rough(n, "periodic", 1), (n / 64, n / 64), is_cut_out=False) for n in (64, 48)
    )
    assert rl.facing(large, small).is_cut_out
    assert not rl.facing(large, large).is_cut_out
