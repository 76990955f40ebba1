"""What is known of a topography, as a table."""

import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.question.description import describe_measurement
from roughline.report.description_table import description_table
from roughline.topography.files.measurement import Measurement


def test_a_roll_off_is_written_as_the_length_of_its_wave(tmp_path, invoke):
    spectrum = rl.SelfAffine(hurst=0.6, length=1e-3, rms_height=1e-6, q_roll=math.tau / 125e-6)
    rl.write(replace(spectrum.surface(128, 7), unit="m"), tmp_path / "map.nc")
    _, out, _ = invoke("info", tmp_path / "map.nc")
    (written,) = re.findall(r"roll-off wavelength +([0-9.]+) µm", out)
    _, out, _ = invoke("info", tmp_path / "map.nc", "--json")
    q_roll = json.loads(out)["self_affine"]["q_roll"]
    assert float(written) == pytest.approx(1e6 * math.tau / q_roll, rel=5e-3)


def test_all_channels_of_a_file_are_listed(tmp_path):
    file = tmp_path / "map.di"
    heights = np.random.default_rng(3).normal(size=(8, 8))
    content = Measurement(
        file.name,
        heights,
        "um",
        (1.0, 1.0),
        "surface",
        channel="Height",
        channels=("0 Height", "1 ZSensor"),
    )
    rows = dict(description_table(describe_measurement(file, content, rl.Reading())))
    assert rows["channels"] == "0 Height, 1 ZSensor"
    alone = replace(content, channels=("0 Height",))
    assert "channels" not in dict(
        description_table(describe_measurement(file, alone, rl.Reading()))
    )


def test_nothing_that_hangs_on_a_refused_law_is_written(tmp_path, invoke):
    """White noise follows no power law, so no exponent, and no Sq of such surfaces, is told."""
    noise = np.random.default_rng(1).normal(0.0, 1e-9, (64, 64))
    rl.write(rl.Surface(noise, (1e-5, 1e-5), "m"), tmp_path / "map.nc")
    _, out, _ = invoke("info", tmp_path / "map.nc")
    assert re.search(r"self-affine +no: ", out)
    for name in ("such surfaces", "Hurst", "fractal", "roll-off wave", "cutoff", "blur"):
        assert name not in out
    _, out, _ = invoke("info", tmp_path / "map.nc", "--json")
    found = json.loads(out)["self_affine"]
    assert found.pop("objections")
    assert found.pop("scatter") >= 0
    assert all(value in (None, [None, None]) for value in found.values())
