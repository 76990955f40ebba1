"""Explore: its addresses, and its numbers, which are those of the library."""

import json
import math
import re
import shlex
import subprocess
import sys
from urllib.parse import parse_qsl

import numpy as np
import pytest
import xarray

import roughline as rl
from lab.unpacked import HALF_A_STEP, assert_sent, unpacked
from roughline.lab.controls import ControlError
from roughline.lab.explore import code, downloads, pictures
from roughline.lab.explore.panels import BACK
from roughline.lab.explore.reading import read_state
from roughline.lab.frames import frame, sent_bytes
from roughline.margins.grid import intervals_of_grid
from roughline.margins.press import facts_on_press
from roughline.question.loading import UNLOADING
from roughline.report.values import figure, up_to_three_digits
from roughline.units import supported_digits

SMALL = {"n": "64", "D_f": "2.4", "seed": "3", "F": "0.2", "cutoff": "0.0625"}
LENGTH, E_STAR, HEIGHT = 1e-3, 110e9, 1e-6


def arguments(state, folder=None, **others):
    session = {"folder": str(folder), "names": {}}
    return {"state": state, "session": session, **others}


def answer(task, state, **others):
    return unpacked(task(arguments(state, **others), lambda done, total: None))


def loads(header, panel, *names):
    """Return forces and values of a panel, of some series, by rising force."""
    found = [header["panels"][panel]["series"][name] for name in names or ("curve", "unsure")]
    columns = [np.concatenate([each[axis] for each in found]) for axis in ("x", "y")]
    order = np.argsort(columns[0])
    return columns[0][order], columns[1][order]


def numbers_in(text):
    """Return the numbers of a text."""
    return [float(each) for each in re.findall(r"-?\d+\.?\d*", text)]


@pytest.fixture(scope="module")
def surface():
    q_low = 2 * math.pi / LENGTH
    spectrum = rl.SelfAffine(
        fractal_dimension=2.4, length=LENGTH, rms_height=HEIGHT, q_high=q_low / 0.0625
    )
    return spectrum.surface(64, 3)


@pytest.fixture(scope="module")
def curve(surface):
    force = 0.2 * E_STAR * HEIGHT * LENGTH
    return rl.press(surface, E_star=E_STAR, forces=[force], fields=True, grid_error=True)


def test_a_message_is_read_as_it_was_written():
    arrays = {
        "marks": np.arange(5, dtype=np.uint8),
        "colours": np.array([[2**32 - 1]], dtype=np.uint32),
    }
    header, read = unpacked(frame({"value": math.nan, "text": "k̄"}, arrays))
    assert header["value"] is None
    assert header["text"] == "k̄"
    for name, values in arrays.items():
        np.testing.assert_array_equal(read[name], values.astype(read[name].dtype))
        assert header["arrays"][name]["offset"] % 8 == 0


@pytest.mark.parametrize(
    "values",
    [
        np.random.default_rng(1).normal(size=(7, 5)),
        np.where(np.eye(6) > 0, np.nan, np.arange(36.0).reshape(6, 6)),
        np.full((3, 4), 2.5),
        np.full((2, 2), np.nan),
        np.array([[-1e30, 1e30, 0.0]]),
    ],
    ids=["random", "unknown", "flat", "nothing known", "wide"],
)
def test_numbers_are_sent_to_half_a_step_and_their_ends_are_exact(values):
    message = frame({}, {"map": values, "above": 1 - values}, {"above": "map"})
    header, arrays = unpacked(message)
    assert header["arrays"]["map"]["dtype"] == "packed"
    if np.isfinite(values).any():
        assert_sent(arrays["map"], values)
        assert np.nanmin(arrays["map"]) == np.nanmin(values)
        assert np.nanmax(arrays["map"]) == pytest.approx(np.nanmax(values), rel=1e-12)
        most = 2 * HALF_A_STEP * np.ptp(values[np.isfinite(values)])
        np.testing.assert_allclose(arrays["above"], np.maximum(1 - values, 0), rtol=0, atol=most)
    else:
        assert np.isnan(arrays["map"]).all()


@pytest.mark.parametrize(
    "state",
    [
        {"shown": "pressure"},
        {"shown": "pressure", "F": "8"},
        {"shown": "displacement", "F": "3", "D_f": "3"},
        {"shown": "flux", "fluid": "x"},
    ],
    ids=["as it opens", "near saturation", "rough", "flux"],
)
@pytest.mark.parametrize("n", ["128", "512"])
def test_a_rest_crosses_the_line_in_six_hundred_kilobytes(n, state):
    message = pictures.full(arguments({"n": n, **state}), lambda done, total: None)
    assert sent_bytes(message) < 600_000 * (int(n) / 512) ** 2 + 60_000 * (n == "128")
    header, arrays = unpacked(message)
    for name, place in header["arrays"].items():
        if "step" in place and not place["above"]:
            assert place["step"] < np.ptp(arrays[name][np.isfinite(arrays[name])]) / 1000


def test_heights_that_the_page_holds_are_not_sent_again():
    message = pictures.full(arguments({"n": "128"}), lambda done, total: None)
    header, arrays = unpacked(message)
    again = arguments({"n": "128", "F": "0.3"}, heights=[header["heights"]])
    again = pictures.full(again, lambda done, total: None)
    assert sent_bytes(again) < 0.6 * sent_bytes(message)
    other, _ = unpacked(again, height=arrays["height"])
    assert other["heights"] == header["heights"]
    assert "height" in other["maps"]


def test_the_contact_is_that_of_the_library(curve):
    header, arrays = answer(pictures.full, SMALL)
    fields = curve.fields[0]
    wanted = curve.stiffness / (E_STAR * LENGTH)
    assert loads(header, "stiffness", "here")[1] == pytest.approx(wanted, rel=1e-12)
    assert loads(header, "area", "here")[1].tolist() == curve.area_fraction_corrected.tolist()
    np.testing.assert_array_equal(arrays["area"], fields.contact.T)
    assert_sent(arrays["pressure"].T, fields.pressure / E_STAR)
    assert "displacement" not in arrays
    _, arrays = answer(pictures.full, {**SMALL, "shown": "displacement"})
    assert_sent(arrays["displacement"].T, fields.displacement / HEIGHT)


def test_heights_and_the_gap_above_them_are_those_of_the_library(curve, surface):
    _, arrays = answer(pictures.full, SMALL)
    fields, heights = curve.fields[0], (surface.heights - surface.heights.mean()) / HEIGHT
    assert_sent(arrays["height"].T, heights)
    gap = np.where(fields.contact, np.nan, fields.gap / HEIGHT)  # as what is told of a point
    np.testing.assert_array_equal(np.isnan(arrays["gap"].T), fields.contact)
    most = HALF_A_STEP * (np.ptp(heights) + np.nanmax(heights + gap) - np.nanmin(heights + gap))
    np.testing.assert_allclose(arrays["gap"].T, gap, rtol=1e-12, atol=most)


def test_the_answer_strip_says_what_the_library_says(curve, surface):
    header, _ = answer(pictures.full, SMALL)
    said = {item["key"]: item for item in header["strip"]}
    k, error = curve.stiffness[0], curve.stiffness_error[0]
    ends = k / (1 + error / k), k + error
    value, _, interval = up_to_three_digits(k, ends, "N/m").partition(" (")
    over_sides = figure(k / (E_STAR * LENGTH), supported_digits(k, ends, 3))
    assert said["stiffness_3d"]["value"] == value
    assert said["stiffness_3d"]["below"] == f"({interval}, k / (E* L) {over_sides}"
    assert interval.endswith("MN/m)")
    area = 100 * curve.area_fraction_corrected[0]
    assert float(said["area"]["value"].rstrip("%")) == pytest.approx(area, rel=0.05)
    in_contact = curve.force[0] / (curve.area_fraction[0] * surface.area)
    low, high = (end[0] for end in intervals_of_grid(curve).area)
    ends = in_contact * area / 100 / high, in_contact * area / 100 / low
    value, _, interval = up_to_three_digits(in_contact, ends, "Pa").partition(" (")
    assert said["pressure"]["value"] == value
    assert said["pressure"]["below"] == f"({interval}, {figure(in_contact / E_STAR)} E*"
    assert said["depth"]["value"] == f"{curve.depth[0] / HEIGHT:#.3g} h"
    assert said["roughness"]["value"] == "1.00 µm"
    assert said["roughness"]["below"] == f"slope {surface.rms_slope:.3g}"


def test_the_line_is_the_mean_of_lines_with_the_same_waves():
    header, _ = answer(pictures.coarse, SMALL)
    spectrum = rl.SelfAffine(
        fractal_dimension=2.4,
        length=LENGTH,
        rms_height=HEIGHT,
        q_high=2 * math.pi / LENGTH / 0.0625,
    )
    stiffness = []
    for seed in range(3, 23):
        line = spectrum.line(2**13, seed)
        force = 0.2 * E_STAR * line.rms_height * LENGTH
        pressed = rl.press(line, E_star=E_STAR, forces=[force])
        stiffness.append(pressed.stiffness[0] / (E_STAR * LENGTH))
    assert header["line"]["stiffness_bar_1d"] == pytest.approx(np.mean(stiffness), rel=1e-12)


def test_the_curve_is_that_of_the_library(surface):
    header, _ = answer(pictures.curve, {**SMALL, "theories": "persson"})
    forces, stiffness = loads(header, "stiffness")
    pressed = rl.press(surface, E_star=E_STAR, forces=forces * (E_STAR * HEIGHT * LENGTH))
    np.testing.assert_allclose(stiffness, pressed.stiffness / (E_STAR * LENGTH), rtol=1e-9)
    given, areas = loads(header, "area", "theory persson")
    pressures = given * E_STAR * HEIGHT * LENGTH / surface.area
    wanted = rl.theory("persson", surface, E_STAR, pressures)
    np.testing.assert_allclose(areas, wanted.area_fraction, rtol=1e-12)


def test_a_coarse_answer_has_the_waves_of_its_grid():
    state = {"n": "256", "seed": "3"}
    header, arrays = answer(pictures.coarse, state)
    assert header["points"] == 128
    assert header["is_coarse"]
    assert arrays["height"].shape == (128, 128)


def test_periodic_contacts_are_those_of_the_library(surface):
    header, _ = answer(pictures.full, {**SMALL, "boundary": "periodic"})
    force = 0.2 * E_STAR * HEIGHT * LENGTH
    pressed = rl.press(surface, E_star=E_STAR, forces=[force], periodic=True)
    wanted = pressed.stiffness / (E_STAR * LENGTH)
    assert loads(header, "stiffness", "here")[1] == pytest.approx(wanted)


def test_an_rms_slope_is_that_of_the_surface():
    header, _ = answer(pictures.full, {**SMALL, "rms": "slope", "slope": "0.05"})
    said = {item["key"]: item["below"] for item in header["strip"]}
    assert said["roughness"] == "slope 0.0500"


@pytest.mark.parametrize(
    ("said", "name", "value"),
    [
        ({"D_f": "H = 0.8"}, "D_f", 2.2),
        ({"H": "0.3"}, "D_f", 2.7),
        ({"roll_off": "0.2 mm"}, "roll_off", 0.2),
        ({"h": "0.3 um"}, "h", 3e-4),
        ({"F": "11 N"}, "F", 0.1),
        ({"F": "11 MPa"}, "F", 0.1),
        ({"F": "11 N", "h": "2 um"}, "F", 0.05),
        ({"L": "2 mm", "roll_off": "1 mm"}, "roll_off", 0.5),
        ({"hardness_bar": "0.3"}, "hardness_bar", 0.3),
        ({"rms": "slope", "slope": "0.05", "hardness_bar": "2.75 GPa"}, "hardness_bar", 0.5),
        ({"hardness_bar": ""}, "hardness_bar", None),
        ({}, "hardness_bar", None),
    ],
)
def test_numbers_may_have_units(said, name, value):
    state = read_state(said)
    found = {key: value for each in state.added for key, value in each.numbers.items()}
    assert (found | vars(state)).get(name) == pytest.approx(value)


@pytest.mark.parametrize(
    "typed",
    [
        {"F": "2 MPa"},
        {"F": "10 N", "h": "2 um"},
        {"D_f": "H = 0.7", "roll_off": "0.5 mm", "cutoff": "20 um"},
        {"rms": "slope", "hardness_bar": "2 GPa"},
        {"w": "50 mJ/m^2", "h0": "30 nm", "h": "0.02 um", "D_f": "2.2"},
    ],
)
def test_what_is_typed_is_what_the_address_keeps(typed):
    kept = answer(pictures.coarse, {**SMALL, **typed})[0]["state"]
    assert kept.items() >= typed.items()
    assert read_state(kept) == read_state({**SMALL, **typed})


def test_a_pressure_stays_that_pressure_when_a_link_is_opened_and_the_height_changes():
    kept = answer(pictures.coarse, {**SMALL, "F": "2 MPa"})[0]["state"]
    lower = read_state({**kept, "h": "2 um"})
    assert lower.force(lower.F) == pytest.approx(2e6 * lower.length**2)
    assert pytest.approx(read_state(kept).F / 2) == lower.F


@pytest.mark.parametrize(
    ("said", "at"),
    [
        ({"D_f": "5"}, "D_f"),
        ({"D_f": "2,2"}, "D_f"),
        ({"D_f": "H = 2"}, "D_f"),
        ({"F": "10 apples"}, "F"),
        ({"F": "1e9 N"}, "F"),
        ({"F": "nan"}, "F"),
        ({"F": ""}, "F"),
        ({"h": "1 m"}, "h"),
        ({"h": "0"}, "h"),
        ({"seed": "1.5"}, "seed"),
        ({"n": "77"}, "n"),
        ({"L": "3"}, "L"),
        ({"E": "-1 GPa"}, "E"),
        ({"cutoff": "0.5", "roll_off": "0.2"}, "cutoff"),
        ({"theories": "hertz"}, "theories"),
        ({"hardness_bar": "9"}, "hardness_bar"),
        ({"hardness_bar": "soft"}, "hardness_bar"),
        ({"hardness_bar": "1 kPa"}, "hardness_bar"),
        ({"hardness_bar": "0.05", "F": "9"}, "F"),
        ({"boundary": "open"}, "boundary"),
        ({"v": "2"}, "v"),
        ({"colour": "red"}, "v"),
    ],
)
def test_what_cannot_be_used_is_refused_where_it_stands(said, at):
    with pytest.raises(ControlError) as refused:
        read_state(said)
    assert refused.value.at == at
    assert "\n" not in str(refused.value)


def test_a_cutoff_that_the_grid_does_not_carry_is_told_at_its_control():
    def told(**state):
        header, _ = answer(pictures.coarse, {"n": "64", **state})
        return header["refused"], header["numbers"]["cutoff"]

    refused, used = told(cutoff="0.005")
    assert used == 2 / 64
    assert refused == {
        "cutoff": "64 points carry no waves shorter than 0.03125 sides; that is used meanwhile"
    }
    assert told(cutoff="0.1") == ({}, 0.1)
    assert told() == ({}, 2 / 64)
    assert told(cutoff="0.00195312") == ({}, 2 / 64)  # the default, which follows the grid


def test_as_python_gives_the_same_numbers(curve):
    header, _ = answer(code.code, SMALL, which="python")
    done = subprocess.run(
        [sys.executable, "-c", header["text"]], capture_output=True, text=True, check=True
    )
    numbers = [float(line.split()[-1]) for line in done.stdout.splitlines()]
    k = curve.stiffness[0] / (E_STAR * LENGTH)
    wanted = [k, curve.area_fraction_corrected[0], curve.depth[0] / HEIGHT]
    np.testing.assert_allclose(numbers, wanted, rtol=1e-9)


def test_as_command_gives_the_same_numbers(invoke, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    generate, press = answer(code.code, SMALL, which="command")[0]["text"].splitlines()
    for line in (generate, f"{press} --json"):
        exit_code, out, errors = invoke(*shlex.split(line)[1:])
        assert exit_code == 0, errors
    intervals_are_those_of(SMALL, json.loads(out), "stiffness", "area_fraction")


SHOWN = {
    "stiffness": ("stiffness_3d", "N/m"),
    "unloading_stiffness": ("unloading", "N/m"),
    "area_fraction": ("area", "%"),
}


def intervals_are_those_of(state, report, *names):
    """Check that the strip has the intervals of a report."""
    page = {item["key"]: item for item in answer(pictures.full, state)[0]["strip"]}
    for name in names:
        key, unit = SHOWN[name]
        ends = [end[0] for end in report[f"{name}_interval"]]
        of = {"area_fraction": "area_fraction_corrected"}.get(name, name)
        wanted = up_to_three_digits(report["curve"][of][0], ends, unit).partition(" (")[2]
        assert wanted
        assert f"({wanted}" in page[key]["below"]


def test_what_stands_against_a_press_is_told_by_the_page_and_by_the_code_alike():
    steep = {"n": "64", "D_f": "2.9", "h": "0.1", "F": "10"}
    header, _ = answer(pictures.full, steep)
    surface = read_state(steep).surface(64)
    force = 10 * E_STAR * surface.rms_height * LENGTH
    pressed = rl.press(surface, E_star=E_STAR, forces=[force], throw=False)
    facts = facts_on_press(surface, pressed)
    assert [fact.kind for fact in facts if fact.is_grave] == ["steep", "strained"]
    assert header["facts"] == [fact.brief for fact in facts if fact.weight != "note"]
    text = answer(code.code, steep, which="python")[0]["text"]
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[3:] == [str(fact) for fact in facts]
    assert answer(pictures.full, SMALL)[0]["facts"] == []


def saved(name, state, tmp_path, **others):
    """Save a file as the page does, and return where it is."""
    header, _ = answer(downloads.download, state, folder=tmp_path, name=name, **others)
    return tmp_path / "results" / header["file"]


@pytest.mark.parametrize("name", downloads.FILES)
def test_every_file_can_be_saved_and_opened(name, tmp_path, surface):
    file = saved(name, SMALL, tmp_path)
    if name in ("surface.nc", "surface.x3p", "maps.nc"):
        np.testing.assert_allclose(rl.read(file, trend="none").heights, surface.heights, rtol=1e-12)
    elif file.suffix == ".gsf":
        heights = np.frombuffer(file.read_bytes()[-4 * surface.heights.size :], "<f4")
        np.testing.assert_allclose(heights, surface.heights.T.ravel(), rtol=1e-7)
    else:
        with xarray.open_dataset(file, engine="h5netcdf") as data:
            assert np.isfinite(data.stiffness).all()


def test_no_other_file_can_be_saved(tmp_path):
    for others in ({"name": "../../surface.nc"}, {"name": "maps.nc", "points": 65}):
        with pytest.raises(ControlError):
            answer(downloads.download, SMALL, folder=tmp_path, **others)


def test_saved_loads_have_all_quantities_with_units(tmp_path):
    file = saved("curve.nc", {**YIELDING, "fluid": "x"}, tmp_path)
    with xarray.open_dataset(file, engine="h5netcdf") as data:
        assert "entropy 3," in data.attrs["body_seed"]
        link = dict(parse_qsl(data.attrs["lab_link"].removeprefix("?")))
        assert read_state(link) == read_state({**YIELDING, "fluid": "x"})
        for name, unit in (("stiffness", "N/m"), ("unloading_stiffness", "N/m"), ("depth", "m")):
            assert data[name].attrs["units"] == unit
            assert np.isfinite(data[name]).all()
        assert data.force[-1] == 0  # the way back
        assert data.hydraulic_aperture_x.attrs["units"] == "m"


def test_saved_maps_are_those_that_are_shown(tmp_path, surface, curve):
    with xarray.open_dataset(saved("maps.nc", SMALL, tmp_path), engine="h5netcdf") as data:
        units = {"heights": "m", "pressure": "Pa", "gap": "m", "contact": "1", "x": "m"}
        assert {name: data[name].attrs["units"] for name in units} == units
        for name in ("pressure", "gap", "contact"):
            np.testing.assert_array_equal(data[name], getattr(curve.fields[0], name))
        np.testing.assert_array_equal(data.heights, surface.heights)
    coarse = saved("maps.nc", {**SMALL, "n": "128", "fluid": "x"}, tmp_path, points=64)
    assert rl.read(coarse).shape == (64, 64)
    with xarray.open_dataset(coarse, engine="h5netcdf") as data:
        assert data.sizes["x"] == 64
        assert data.attrs["E_star"] == E_STAR
        flow = rl.flow(curve.fields[0])
        np.testing.assert_allclose(np.stack([data.flux_x, data.flux_y]), flow.flux, rtol=1e-9)
        assert data.flux_x.attrs["units"] == "m^2"


@pytest.fixture(scope="module")
def yielding(surface):
    """The way up to the load and back, with a hardness that most of the contact reaches."""
    shares = np.array([1, *UNLOADING])
    return rl.press(
        surface,
        E_star=E_STAR,
        hardness=0.3 * E_STAR * surface.rms_slope,
        forces=0.2 * E_STAR * HEIGHT * LENGTH * shares,
        fields=[0],
    )


YIELDING = {**SMALL, "hardness_bar": "0.3"}


def test_plastic_spots_are_those_of_the_library(yielding):
    header, arrays = answer(pictures.full, YIELDING)
    fields = yielding.fields[0]
    assert 0 < fields.plastic.sum() < fields.contact.sum()
    np.testing.assert_array_equal(arrays["area"], (fields.contact.astype(int) + fields.plastic).T)
    said = {item["key"]: item for item in header["strip"]}
    assert said["plastic"]["value"] == f"{100 * yielding.plastic_fraction[0]:#.3g}%"
    assert said["indentation"]["value"] == f"{yielding.indentation[0] / HEIGHT:#.3g} h"
    k_u = yielding.unloading_stiffness[0] / 1e6
    assert float(said["unloading"]["value"].split(" MN/m")[0]) == pytest.approx(k_u, rel=0.05)
    elastic = {item["key"] for item in answer(pictures.full, SMALL)[0]["strip"]}
    assert said.keys() - elastic == {"unloading", "plastic", "indentation"}


def test_the_way_back_is_that_of_the_library(yielding):
    header, _ = answer(pictures.further, YIELDING, of="hardness_bar")
    ratio = yielding.unloading_stiffness / yielding.stiffness[0]
    _, found = loads(header, "stiffness", "back")
    first = loads(answer(pictures.full, YIELDING)[0], "stiffness", "here")[1][0]
    np.testing.assert_allclose(found[::-1], (ratio * first)[:-1], rtol=1e-9)
    assert header["panels"]["stiffness"]["rows"][-1] == ["0", "0", BACK.legend]
    curve, _ = answer(pictures.curve, YIELDING)
    assert {row[2] for row in curve["panels"]["stiffness"]["rows"]} == {"3D", "3D, on unloading"}


def test_loads_of_the_curve_are_borne():
    soft = {**SMALL, "hardness_bar": "0.02", "F": "0.01"}
    header, _ = answer(pictures.curve, soft)
    rows = [row for row in header["panels"]["area"]["rows"] if row[2] == "3D"]
    assert all(numbers_in(row[1]) for row in rows)
    assert len(rows) < 13


def test_code_with_a_hardness_gives_the_same_numbers(
    yielding, invoke, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    exec(answer(code.code, YIELDING, which="python")[0]["text"], {})
    numbers = [float(line.split()[1]) for line in capsys.readouterr().out.splitlines()[3:5]]
    wanted = [yielding.unloading_stiffness[0], yielding.plastic_fraction[0]]
    np.testing.assert_allclose(numbers, wanted, rtol=1e-9)
    generate, press = answer(code.code, YIELDING, which="command")[0]["text"].splitlines()
    for line in (generate, press, f"{press} --json"):
        exit_code, out, errors = invoke(*shlex.split(line)[1:])
        assert exit_code == 0, errors
        assert "unloaded to 75%" in out or line != press
    # values and intervals of the page, where loads that follow have no part in the interval
    names = ("stiffness", "unloading_stiffness", "area_fraction")
    intervals_are_those_of(YIELDING, json.loads(out), *names)
