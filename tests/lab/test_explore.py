"""Explore: its addresses, and its numbers, which are those of the library."""

import math
import shlex
from urllib.parse import parse_qsl

import numpy as np
import pytest
import xarray

import roughline as rl
from lab.explore_asked import (
    COATED,
    E_STAR,
    HARDNESS,
    HEIGHT,
    LAW,
    LAYERED,
    LENGTH,
    SCALE,
    SHEARED,
    SMALL,
    STICKS,
    YIELDING,
    answer,
    arguments,
    loads,
    numbers_in,
    said,
    saved,
)
from lab.unpacked import HALF_A_STEP, assert_sent, unpacked
from roughline.lab.controls import ControlError
from roughline.lab.explore import code, downloads, pictures
from roughline.lab.explore.panels import BACK
from roughline.lab.explore.reading import read_state, usable_state
from roughline.lab.frames import frame, sent_bytes
from roughline.margins.grid import intervals_of_grid
from roughline.margins.press import facts_on_press
from roughline.question.loading import UNLOADING
from roughline.report.values import figure, up_to_three_digits
from roughline.units import supported_digits


@pytest.fixture(scope="module")
def surface():
    q_low = 2 * math.pi / LENGTH
    spectrum = rl.SelfAffine(
        fractal_dimension=2.4, length=LENGTH, rms_height=HEIGHT, q_high=q_low / 0.0625
    )
    return spectrum.surface(64, 3)


@pytest.fixture(scope="module")
def curve(surface):
    return rl.press(surface, E_star=E_STAR, forces=[0.2 * SCALE], fields=True, grid_error=True)


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


CONTACTS = {
    "elastic": (SMALL, {"E_star": E_STAR}),
    "repeated": ({**SMALL, "boundary": "periodic"}, {"E_star": E_STAR, "periodic": True}),
    "layered": (COATED, {"half_space": LAYERED}),
    "yielding": (YIELDING, {"E_star": E_STAR, "hardness": HARDNESS}),
    "sticking": (STICKS, {"E_star": E_STAR, "law": LAW}),
    "sheared": (SHEARED, {"E_star": E_STAR}),
}


@pytest.mark.parametrize("kind", CONTACTS)
def test_the_contact_is_that_of_the_library(kind):
    state, asked = CONTACTS[kind]
    pressed = rl.press(
        read_state(state).surface(64), forces=[float(state["F"]) * SCALE], fields=True, **asked
    )
    header, arrays = answer(pictures.full, state)
    fields, wanted = pressed.fields[0], pressed.stiffness / (E_STAR * LENGTH)
    assert loads(header, "stiffness", "here")[1] == pytest.approx(wanted, rel=1e-12)
    areas = pressed.area_fraction_corrected
    assert loads(header, "area", "here")[1] == pytest.approx(areas, rel=1e-12)
    marks = 1 * fields.contact + fields.plastic + 2 * fields.pulling
    np.testing.assert_array_equal(arrays["area"].T, marks)
    assert_sent(arrays["pressure"].T, fields.pressure / E_STAR)
    assert "displacement" not in arrays
    _, arrays = answer(pictures.full, {**state, "shown": "displacement"})
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
    strip = said(answer(pictures.full, SMALL)[0])
    k, error = curve.stiffness[0], curve.stiffness_error[0]
    ends = k / (1 + error / k), k + error
    value, _, interval = up_to_three_digits(k, ends, "N/m").partition(" (")
    over_sides = figure(k / (E_STAR * LENGTH), supported_digits(k, ends, 3))
    assert strip["stiffness_3d"]["value"] == value
    assert strip["stiffness_3d"]["below"] == f"({interval}, k / (E* L) {over_sides}"
    assert interval.endswith("MN/m)")
    area = 100 * curve.area_fraction_corrected[0]
    assert float(strip["area"]["value"].rstrip("%")) == pytest.approx(area, rel=0.05)
    in_contact = curve.force[0] / (curve.area_fraction[0] * surface.area)
    low, high = (end[0] for end in intervals_of_grid(curve).area)
    ends = in_contact * area / 100 / high, in_contact * area / 100 / low
    value, _, interval = up_to_three_digits(in_contact, ends, "Pa").partition(" (")
    assert strip["pressure"]["value"] == value
    assert strip["pressure"]["below"] == f"({interval}, {figure(in_contact / E_STAR)} E*"
    assert strip["depth"]["value"] == f"{curve.depth[0] / HEIGHT:#.3g} h"
    assert strip["roughness"]["value"] == "1.00 µm"
    assert strip["roughness"]["below"] == f"slope {surface.rms_slope:.3g}"


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
        stiffness += [*rl.press(line, E_star=E_STAR, forces=[force]).stiffness_bar]
    assert header["line"]["stiffness_bar_1d"] == pytest.approx(np.mean(stiffness), rel=1e-12)
    rows = header["line"]["panels"]["stiffness"]["rows"]
    assert ["0.200", figure(np.mean(stiffness)), "1D"] in rows


def test_the_curve_is_that_of_the_library(surface):
    header, _ = answer(pictures.curve, {**SMALL, "theories": "persson"})
    forces, stiffness = loads(header, "stiffness")
    pressed = rl.press(surface, E_star=E_STAR, forces=forces * SCALE)
    np.testing.assert_allclose(stiffness, pressed.stiffness / (E_STAR * LENGTH), rtol=1e-9)
    marks = ["" if each else " *" for each in pressed.resolved]
    for panel, values in (
        ("stiffness", pressed.stiffness / (E_STAR * LENGTH)),
        ("area", pressed.area_fraction_corrected),
    ):
        wanted = [
            [figure(x), figure(y) + z, "3D"]
            for x, y, z in zip(pressed.force_bar, values, marks, strict=True)
        ]
        assert header["panels"][panel]["rows"][: len(wanted)] == wanted
    given, areas = loads(header, "area", "theory persson")
    pressures = given * SCALE / surface.area
    wanted = rl.theory("persson", surface, E_STAR, pressures)
    np.testing.assert_allclose(areas, wanted.area_fraction, rtol=1e-12)


def test_the_spectrum_is_that_of_the_surface(surface):
    header, _ = answer(pictures.full, SMALL)
    known = rl.isotropic_spectrum(surface).C_2d
    known = known[known > 0]
    rows = header["panels"]["spectrum"]["rows"]
    assert [row[1] for row in rows] == [figure(x) for x in known[:: -(-known.size // 40)]]


def test_a_coarse_answer_has_the_waves_of_its_grid():
    header, arrays = answer(pictures.coarse, {"n": "256", "seed": "3"})
    assert header["points"] == 128
    assert header["is_coarse"]
    assert arrays["height"].shape == (128, 128)


def test_an_rms_slope_is_that_of_the_surface():
    header, _ = answer(pictures.full, {**SMALL, "rms": "slope", "slope": "0.05"})
    assert said(header)["roughness"]["below"] == "slope 0.0500"


@pytest.mark.parametrize(
    ("typed", "wanted"),
    [
        ({"D_f": "H = 0.8"}, {"D_f": 2.2}),
        ({"H": "0.3"}, {"D_f": 2.7}),
        ({"roll_off": "0.2 mm"}, {"roll_off": 0.2}),
        ({"h": "0.3 um"}, {"h": 3e-4}),
        ({"F": "11 N"}, {"F": 0.1}),
        ({"F": "11 MPa"}, {"F": 0.1}),
        ({"F": "11 N", "h": "2 um"}, {"F": 0.05}),
        ({"L": "2 mm", "roll_off": "1 mm"}, {"roll_off": 0.5}),
        ({"hardness_bar": "0.3"}, {"hardness_bar": 0.3}),
        ({"rms": "slope", "slope": "0.05", "hardness_bar": "2.75 GPa"}, {"hardness_bar": 0.5}),
        ({"hardness_bar": ""}, {}),
        ({}, {}),
        ({"t": "50 um", "E_l": "22 GPa"}, {"t": 0.05, "E_l": 0.2, "nu_l": 0.3, "nu_b": 0.3}),
        ({**STICKS, "w": "110 J/m^2", "h0": "400 nm"}, {"w": 1, "h0": 0.4}),
    ],
)
def test_numbers_may_have_units(typed, wanted):
    state = read_state(typed)
    added = {key: value for each in state.added for key, value in each.numbers.items()}
    assert {key: (added | vars(state))[key] for key in wanted} == pytest.approx(wanted)
    assert added.keys() <= wanted.keys()


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


ALONE = {
    **{"D_f": ("5", "2,2", "H = 2"), "F": ("10 apples", "1e9 N", "nan", ""), "h": ("1 m", "0")},
    **{"seed": ("1.5",), "n": ("77",), "L": ("3",), "E": ("-1 GPa",), "theories": ("hertz",)},
    **{"hardness_bar": ("9", "soft", "1 kPa"), "boundary": ("open",), "fluid": ("z",)},
}
"""Texts that cannot be used, whatever the others are."""
BESIDE = [
    (COATED, {"t": "0.005"}, "t", "half a cell"),
    (COATED, {"t": "2 m"}, "t", "from 2 µm to 1 mm"),
    (COATED, {"E_l": "3 mm"}, "E_l", "no quantity in Pa"),
    (COATED, {"nu_b": "0.6"}, "nu_b", "from 0 to 0.5"),
    (SHEARED, {"Q": "0.3"}, "Q", "not less than μ F"),
    (SHEARED, {"Q": "8 N"}, "Q", "not less than μ F"),
    (SHEARED, {"mu": "0.1"}, "Q", "under which the bodies slide"),
    (SHEARED, {"Q": "3 m"}, "Q", 'shear force is "3 m"'),
    (SHEARED, {"nu": "0.6"}, "nu", "from 0 to 0.5"),
    (SHEARED, {"mu": "0"}, "mu", "from 0.01 to 2"),
    (SHEARED, {"hardness_bar": "0.3"}, "mu", "take the hardness away"),
    (STICKS, {"h0": "0.2"}, "h0", "too short for the grid"),
    (STICKS, {"w": "4"}, "h0", "too short for the grid"),
    (STICKS, {"w": "50 Pa"}, "w", "J/m"),
    (STICKS, {"w": "-1"}, "w", "from 0.0001 to 10"),
    (STICKS, {"h0": "5 m"}, "h0", "range of the pull"),
    (STICKS, {"hardness_bar": "0.3"}, "w", "stick and yield"),
]
TOGETHER = [
    ({"cutoff": "0.5", "roll_off": "0.2"}, "cutoff", "not shorter than the roll-off"),
    ({"hardness_bar": "0.05", "F": "9"}, "F", "bears less than its hardness"),
    ({"mu": "0.3", "w": "1", "D_f": "2.2"}, "mu", "take the adhesion away"),
    ({"v": "2"}, "v", "reads version 1"),
    ({"colour": "red"}, "v", 'sets "colour"'),
]


def refuse(typed, at, why):
    """Check that texts are refused at a control, in one line."""
    with pytest.raises(ControlError) as refused:
        read_state(typed)
    assert refused.value.at == at
    assert why in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(("typed", "at", "why"), TOGETHER)
def test_what_cannot_be_used_together_is_refused(typed, at, why):
    refuse(typed, at, why)


@pytest.mark.parametrize(
    ("before", "typed", "at", "why"),
    [*BESIDE, *(({}, {key: text}, key, "") for key, texts in ALONE.items() for text in texts)],
)
def test_what_cannot_be_used_is_refused_where_it_stands_and_the_one_before_counts(
    before, typed, at, why
):
    refuse({**before, **typed}, at, why)
    state, refused = usable_state({"state": {**before, **typed}, "before": before})
    assert state == read_state(before)
    assert list(refused) == list(typed)
    assert why in refused[next(iter(typed))]


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


def test_code_gives_the_same_numbers(curve, ran):
    numbers = [float(line.split()[-1]) for line in ran(SMALL, "python")]
    k = curve.stiffness[0] / (E_STAR * LENGTH)
    wanted = [k, curve.area_fraction_corrected[0], curve.depth[0] / HEIGHT]
    np.testing.assert_allclose(numbers, wanted, rtol=1e-9)
    intervals_are_those_of(SMALL, ran(SMALL, "command"), "stiffness", "area_fraction")


SHOWN = {
    "stiffness": ("stiffness_3d", "N/m"),
    "unloading_stiffness": ("unloading", "N/m"),
    "area_fraction": ("area", "%"),
}


def intervals_are_those_of(state, report, *names):
    """Check that the strip has the intervals of a report."""
    page = said(answer(pictures.full, state)[0])
    for name in names:
        key, unit = SHOWN[name]
        ends = [end[0] for end in report[f"{name}_interval"]]
        of = {"area_fraction": "area_fraction_corrected"}.get(name, name)
        wanted = up_to_three_digits(report["curve"][of][0], ends, unit).partition(" (")[2]
        assert wanted
        assert f"({wanted}" in page[key]["below"]


def test_what_stands_against_a_press_is_told_by_the_page_and_by_the_code_alike(ran):
    steep = {"n": "64", "D_f": "2.9", "h": "0.1", "F": "10"}
    header, _ = answer(pictures.full, steep)
    surface = read_state(steep).surface(64)
    force = 10 * E_STAR * surface.rms_height * LENGTH
    pressed = rl.press(surface, E_star=E_STAR, forces=[force], throw=False)
    facts = facts_on_press(surface, pressed)
    assert [fact.kind for fact in facts if fact.is_grave] == ["steep", "strained"]
    assert header["facts"] == [fact.brief for fact in facts if fact.weight != "note"]
    assert ran(steep, "python")[3:] == [str(fact) for fact in facts]
    assert answer(pictures.full, SMALL)[0]["facts"] == []


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
    forces = 0.2 * SCALE * np.array([1, *UNLOADING])
    return rl.press(surface, E_star=E_STAR, hardness=HARDNESS, forces=forces, fields=[0])


def test_the_strip_says_what_yields(yielding):
    fields, strip = yielding.fields[0], said(answer(pictures.full, YIELDING)[0])
    assert 0 < fields.plastic.sum() < fields.contact.sum()
    assert strip["plastic"]["value"] == f"{100 * yielding.plastic_fraction[0]:#.3g}%"
    assert strip["indentation"]["value"] == f"{yielding.indentation[0] / HEIGHT:#.3g} h"
    k_u = yielding.unloading_stiffness[0] / 1e6
    assert float(strip["unloading"]["value"].split(" MN/m")[0]) == pytest.approx(k_u, rel=0.05)
    elastic = said(answer(pictures.full, SMALL)[0])
    assert strip.keys() - elastic.keys() == {"unloading", "plastic", "indentation"}


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


def test_code_with_a_hardness_gives_the_same_numbers(yielding, ran, invoke):
    numbers = [float(line.split()[1]) for line in ran(YIELDING, "python")[3:5]]
    wanted = [yielding.unloading_stiffness[0], yielding.plastic_fraction[0]]
    np.testing.assert_allclose(numbers, wanted, rtol=1e-9)
    # values and intervals of the page, where loads that follow have no part in the interval
    names = ("stiffness", "unloading_stiffness", "area_fraction")
    intervals_are_those_of(YIELDING, ran(YIELDING, "command"), *names)
    *_, press = answer(code.code, YIELDING, which="command")[0]["text"].splitlines()
    assert "unloaded to 75%" in invoke(*shlex.split(press)[1:])[1]
