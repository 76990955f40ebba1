"""What is known of a topography, as a table."""

import json
import math
import re
from dataclasses import replace

import pytest

import roughline as rl


def test_a_roll_off_is_written_as_the_length_of_its_wave(tmp_path, invoke):
    spectrum = rl.SelfAffine(hurst=0.6, length=1e-3, rms_height=1e-6, q_roll=math.tau / 125e-6)
    rl.write(replace(spectrum.surface(128, 7), unit="m"), tmp_path / "map.nc")
    _, out, _ = invoke("info", tmp_path / "map.nc")
    (written,) = re.findall(r"roll-off wavelength +([0-9.]+) µm", out)
    _, out, _ = invoke("info", tmp_path / "map.nc", "--json")
    q_roll = json.loads(out)["self_affine"]["q_roll"]
    assert float(written) == pytest.approx(1e6 * math.tau / q_roll, rel=5e-3)
