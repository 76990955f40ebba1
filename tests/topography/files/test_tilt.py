"""The tilt of an instrument: removed when its file is read, and warned of where it is kept."""

import numpy as np
import pytest

import roughline as rl
from roughline.topography.preparation import prepared

SPECTRUM = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)


def tilted_file(folder):
    """An array file of a rough surface on a tilted stage, and the least-squares plane within."""
    surface = SPECTRUM.surface(48, 7)
    x, y = np.meshgrid(np.arange(48.0), np.arange(48.0), indexing="ij")
    heights = surface.heights + 2e-7 * x - 1e-7 * y
    terms = np.stack([np.ones(x.size), x.ravel(), y.ravel()], axis=1)
    plane = terms @ np.linalg.lstsq(terms, heights.ravel(), rcond=None)[0]
    np.save(folder / "stage.npy", heights)
    return folder / "stage.npy", heights, plane.reshape(x.shape)


def test_reading_removes_the_tilt_of_an_instrument_unless_told_not_to(tmp_path):
    path, heights, plane = tilted_file(tmp_path)
    as_given = {"unit": "m", "sizes": 1e-3}
    found = rl.read(path, **as_given)
    assert found.heights == pytest.approx(heights - plane, abs=1e-18)
    assert found.settings["detrended"] == "tilt"
    kept = rl.read(path, **as_given, trend="none")
    assert (kept.heights == heights).all()
    assert "detrended" not in kept.settings
    level = rl.read(path, **as_given, trend="mean")
    assert level.heights == pytest.approx(heights - heights.mean(), abs=1e-18)
    with pytest.raises(rl.InputError, match='trend is "cubic"; allowed are "none", "mean", "tilt"'):
        rl.read(path, **as_given, trend="cubic")


def test_our_own_files_are_read_as_they_were_written(tmp_path):
    path, heights, _ = tilted_file(tmp_path)
    kept = rl.read(path, unit="m", sizes=1e-3, trend="none")
    rl.write(kept, tmp_path / "kept.nc")
    found = rl.read(tmp_path / "kept.nc")
    assert (found.heights == heights).all()
    assert (prepared(found).heights == heights).all()


def test_a_surface_pressed_with_its_tilt_says_so(tmp_path):
    path, heights, plane = tilted_file(tmp_path)
    as_given = {"unit": "m", "sizes": 1e-3}
    force = {"E_star": 1e11, "forces": [1.0]}
    kept = rl.read(path, **as_given, trend="none")
    lower = 1 - np.std(heights - plane) / np.std(heights)
    (said,) = (w for w in rl.press(kept, **force).warnings if "tilted" in w)
    assert f"would be {lower:.0%} lower" in said
    assert "tilted" in rl.press(kept, **force, periodic=True).warnings[0]
    assert "tilted" in rl.press(kept, **force).to_dataset().attrs["warnings"]
    level = rl.press(rl.read(path, **as_given), **force)
    assert not any("tilted" in w for w in level.warnings)
    # made, not measured: its tilt is its shape
    meant = rl.Surface(heights, (1e-3, 1e-3), "m", is_cut_out=False)
    assert rl.press(meant, **force).warnings == ()
    assert any("tilted" in w for w in rl.press(meant.cropped((0, 40), (0, 48)), **force).warnings)


def test_a_comparison_with_a_tilted_body_says_so(tmp_path):
    path, _, _ = tilted_file(tmp_path)
    as_given = {"unit": "m", "sizes": 1e-3}
    tilted = rl.compare(rl.read(path, **as_given, trend="none"), force_bars=[0.3])
    assert "tilted" in tilted.warnings[0]
    level = rl.compare(rl.read(path, **as_given), force_bars=[0.3])
    assert level.warnings == ()
