"""Prepared topographies as files of the formats that other programs read."""

import json

import numpy as np
import pytest
from SurfaceTopography import read_topography

import roughline as rl


@pytest.mark.parametrize("suffix", ["nc", "x3p", "gsf"])
def test_what_is_prepared_is_written(holed, invoke, tmp_path, suffix):
    path = tmp_path / "new" / f"prepared.{suffix}"
    code, out, errors = invoke("info", *holed, "--prepared", path, "--json")
    assert code == 0, errors
    assert json.loads(out)["files"] == [str(path)]
    expected = rl.read(holed[0], unit="m", sizes=1e-3).heights
    if suffix == "gsf":
        heights = np.frombuffer(path.read_bytes()[-4 * expected.size :], "<f4")
        np.testing.assert_allclose(heights, expected.T.ravel(), rtol=1e-7)
    else:
        np.testing.assert_array_equal(read_topography(str(path)).heights(), expected)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("map.npy", 'does not end in ".nc", ".x3p" or ".gsf"; bodies are written as NetCDF, X3P'),
        ("map.x3p", "states no unit; give the unit of its lengths, such as --unit um"),
    ],
)
def test_what_cannot_be_written_is_said_in_one_line(invoke, tmp_path, name, message):
    np.save(tmp_path / "bare.npy", np.random.default_rng(0).normal(size=(16, 16)))
    code, _, errors = invoke("info", tmp_path / "bare.npy", "--prepared", tmp_path / name)
    assert code == 2
    assert message in errors
    assert len(errors.splitlines()) == 1
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize("suffix", ["nc", "x3p", "gsf"])
def test_what_is_generated_is_written(invoke, tmp_path, suffix):
    path = tmp_path / f"map.{suffix}"
    asked = ("--hurst", 0.8, "--length", "1 mm", "--rms-height", "1 um", "-n", 16)
    code, out, errors = invoke("generate", *asked, "--out", path)
    assert code == 0, errors
    assert f"wrote {path}" in out.replace("\n", "")
    assert path.stat().st_size > 16 * 16 * 4
