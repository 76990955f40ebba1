"""Files with faults, and instruments told wrongly: an answer that says so, or one line."""

from __future__ import annotations

import re

import numpy as np
import pytest

import roughline as rl

SURFACE = rl.SelfAffine(hurst=0.8, length=4e-3, rms_height=1e-6, q_roll=25e3).surface(256, 7)
MAP = SURFACE.heights[:64, :64]
SIZE = ("--unit", "m", "--size", "1 mm")
PRESSED = (*SIZE, "--materials", "steel,steel", "--load", "10 MPa")
STEP, STRIPE = MAP.copy(), MAP.copy()
STEP[32:] += 3e-6
STRIPE[40] -= 3e-6
FAULTY = {
    "constant": (np.full((64, 64), 1.234e-6), "all heights are equal"),
    "plane": (np.arange(64.0)[:, np.newaxis] * np.ones(64) * 1e-7, "all heights are equal"),
    "step": (STEP, "all heights beyond stand"),
    "half a plateau": (np.minimum(MAP, np.median(MAP)), "50% of the heights are equal"),
    "saturated": (np.minimum(MAP, np.quantile(MAP, 0.98)), "2% of the heights are equal"),
    "stripe": (STRIPE, "a whole row stands"),
}


def saved(heights, folder):
    np.save(folder / "map.npy", heights)
    return folder / "map.npy"


def refused(invoke, *arguments):
    code, out, told = invoke(*arguments)
    assert (code, out, told.count("\n")) == (2, "", 1)
    return told


def answered(invoke, *arguments):
    code, out, told = invoke(*arguments)
    assert (code, "Warning" in told) == (0, False)
    return out


@pytest.mark.parametrize("fault", FAULTY)
def test_a_fault_of_a_map_is_the_first_remark_above_its_answers(fault, invoke, tmp_path):
    heights, remark = FAULTY[fault]
    file = saved(heights, tmp_path)
    for command in (("info", file, *SIZE), ("press", file, *PRESSED, "--all")):
        text = " ".join(answered(invoke, *command).split())
        assert remark in text
        if command[0] == "press":
            first, *_ = re.split("warning:|note:|for comparison", text.partition("warning:")[2])
            assert remark in first


@pytest.mark.parametrize("points", [32, 64])
def test_what_is_told_of_an_instrument_against_the_data_is_refused_or_leaves_the_answer(
    invoke, tmp_path, points
):
    file = saved(MAP[:points, :points], tmp_path)
    size = ("--unit", "m", "--size", f"{points / 64} mm")
    pressed = (*size, *PRESSED[len(SIZE) :])
    for wrong in (("--blur", "2 mm"), ("--tip-radius=-2 um",), ("--pixels", "nonsense")):
        for command in (("info", *size), ("press", *pressed), ("compare", *size)):
            told = refused(invoke, command[0], file, *command[1:], *wrong)
            assert told.startswith(f"roughline: {wrong[0].partition('=')[0]} is ")
    for told in (("--pixels", "points"), ("--pixels", "means"), ("--blur", "100 um")):
        assert answered(invoke, "press", file, *pressed, *told)
    out = answered(invoke, "info", file, *size, "--blur", f"{500 * points / 64} um")
    assert "the spectrum's tail is not that of the instrument" in " ".join(out.split())


def test_a_scan_of_twenty_points_is_described_and_not_pressed(invoke, tmp_path):
    file, size = saved(MAP[0, :20], tmp_path), ("--unit", "m", "--size", "39 um")
    code, out, _ = invoke("info", file, *size)
    assert (code, "the line has 20 points; a spectrum needs 64 or more" in out) == (0, True)
    told = refused(invoke, "press", file, *size, "--modulus", "1 GPa", "--load", "1 mN")
    assert told == "roughline: the line has 20 points; a spectrum needs 64 or more\n"


@pytest.mark.parametrize(
    ("option", "value"),
    [
        *(("--tilt", "mounting"), ("--pixels", "means"), ("--blur", "1 um")),
        *(("--tip-radius", "2 um"), ("--unit", "um"), ("--fill", "nearest")),
    ],
)
def test_models_are_compared_on_files_read_like_any_other(option, value, invoke, tmp_path):
    spectrum = ("--hurst", "0.8", "--points", "16", "--surfaces", "2")
    told = refused(invoke, "compare", *spectrum, option, value)
    assert told.startswith(f"roughline: {option} is ")
    assert "it says how a FILE is read, and there is none" in told
    size = ("--size", "1 mm", *(() if option == "--unit" else ("--unit", "m")))
    file = saved(1e6 * MAP if option == "--unit" else MAP, tmp_path)
    assert answered(invoke, "compare", file, *size, "--force-bar", "0.1", option, value)
