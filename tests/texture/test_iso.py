"""The value that holds the parameters: filters told, causes, remarks, and what shows it."""

import json
import math
import pickle

import numpy as np
import pytest

import roughline as rl
from known_surfaces import cosine, gaussian_field, grid, scattered, surface
from roughline.texture.parameters import PROFILE_PARAMETERS, SURFACE_PARAMETERS


@pytest.fixture(scope="module")
def found():
    return rl.iso(surface(gaussian_field(64, 4.0, 1), is_cut_out=False))


def test_every_declared_parameter_is_there_under_its_names(found):
    assert list(found.values) == list(SURFACE_PARAMETERS)
    for each in SURFACE_PARAMETERS.values():
        value = found.values[each.name]
        assert getattr(found, each.name) == pytest.approx(value, nan_ok=True)
        assert math.isnan(value) == (each.name in found.undefined)
    assert found.Smr1 == found.Smrk1
    assert "Sq" in dir(found)
    with pytest.raises(AttributeError, match="no parameter Sx of this body; there are Sq, Ssk"):
        _ = found.Sx


def test_the_table_of_pandas_has_units_and_causes(found):
    table = found.to_dataframe()
    assert table.loc["Sq", "value"] == found.Sq
    assert table.loc["Sq", "unit"] == "um"
    assert table.loc["Spd", "unit"] == "1/um²"
    assert table.loc["Std", "undefined"].startswith("Str is 0.8")
    assert table.loc["Sal", "clause"] == "ISO 25178-2:2021, 4.3.2"
    assert table.attrs["filters"] == {"F": "none", "S": "none", "L": "none"}


def test_prompt_and_notebook_show_all_of_them(found):
    assert repr(found).startswith("<IsoParameters: Sq ")
    assert "array" not in repr(found)
    html, text = found._repr_html_(), str(found)
    for name in SURFACE_PARAMETERS:
        assert f"<td>{name}</td>" in html
        assert f"\n{name} " in text
    assert "no Std: Str is" in html


def test_it_travels_between_processes(found):
    again = pickle.loads(pickle.dumps(found))
    assert dict(again.values) == pytest.approx(dict(found.values), nan_ok=True)


@pytest.mark.parametrize("steps", [0, 20, 40])  # of which the least hill is 1, 2
def test_values_do_not_depend_on_the_unit(steps):
    heights = gaussian_field(64, 4.0, 2)
    if steps:
        heights = np.round(steps * (heights - heights.min()) / np.ptp(heights)) / 10 - 1
    in_um = rl.iso(rl.Surface(heights, (64.0, 64.0), "um", is_cut_out=True))
    in_m = rl.iso(rl.Surface(1e-6 * heights, (64e-6, 64e-6), "m", is_cut_out=True))
    powers = {"length": 1, "1/length": -1, "1/length²": -2}
    for each in SURFACE_PARAMETERS.values():
        scale = 1e-6 ** powers.get(each.dimension, 0)
        expected = scale * in_um.values[each.name]
        assert in_m.values[each.name] == pytest.approx(expected, rel=1e-6, nan_ok=True), each.name


def test_nothing_is_filtered_unless_asked():
    body = surface(gaussian_field(64, 4.0, 3))
    found = rl.iso(body)
    assert found.body is body
    assert dict(found.filters) == {"F": "none", "S": "none", "L": "none"}


def test_filters_are_told_those_before_too():
    body = surface(gaussian_field(64, 4.0, 3)).detrended()
    body = rl.prepared(body, rl.Preparation(low_pass=4.0))
    found = rl.iso(body, s_filter=5.0, l_filter=30.0)
    assert found.filters["F"] == "tilt, removed before"
    assert found.filters["S"] == (
        "Gaussian (ISO 16610-61), 4 um, when it was prepared, and Gaussian (ISO 16610-61), 5 um"
    )
    assert found.filters["L"] == "Gaussian (ISO 16610-61), 30 um"
    assert "renormalised" in found.filters["borders"]
    periodic = rl.iso(surface(cosine(4), is_cut_out=False), l_filter=64.0)
    assert periodic.filters["borders"] == "none: the body is periodic"
    assert rl.iso(body, trend="curvature").filters["F"] == "curvature"


def test_a_filter_halves_the_wave_of_its_cutoff():
    body = surface(cosine(4), is_cut_out=False)
    assert rl.iso(body, s_filter=32.0).Sq == pytest.approx(np.sqrt(0.5) / 2, rel=1e-9)
    assert rl.iso(body, l_filter=32.0).Sq == pytest.approx(np.sqrt(0.5) / 2, rel=1e-9)


def test_a_tilt_that_is_left_is_told_and_levelling_takes_it():
    body = surface(cosine(4) + 0.05 * grid(128)[0])
    assert rl.iso(body).remarks[0].startswith("a tilt is left: without it Sq would be 6")
    level = rl.iso(body, trend="tilt")
    assert not any("tilt" in each for each in level.remarks)
    assert level.Sq == pytest.approx(rl.iso(surface(cosine(4)), trend="tilt").Sq)


def test_heights_in_steps_are_told():
    fine = scattered(np.random.default_rng(0).normal(size=64**2))
    assert rl.iso(surface(fine)).remarks == ()
    (told,) = rl.iso(surface(np.round(fine * 10) / 10)).remarks
    assert "steps of 0.1" in told
    assert "Spk, Svk" in told


def test_flat_surfaces_have_no_shape_and_no_waves():
    found = rl.iso(surface(np.full((16, 16), 3.0)))
    assert found.Sq == found.Sz == found.Sdr == found.Spk == found.Spd == 0
    assert set(found.undefined) == {"Ssk", "Sku", "Sal", "Str", "Std", "Spc"}
    assert set(found.undefined.values()) == {"all heights are equal"}


@pytest.mark.parametrize("shape", [(1, 2), (2, 1), (2, 2), (3, 4), (1, 50), (9, 9)])
@pytest.mark.parametrize("is_cut_out", [True, False])
def test_small_surfaces_have_a_value_or_a_cause(shape, is_cut_out):
    heights = np.random.default_rng(1).normal(size=shape)
    found = rl.iso(surface(heights, is_cut_out=is_cut_out))
    for name, value in found.values.items():
        assert math.isfinite(value) != (name in found.undefined)


def test_the_material_ratio_is_a_share_of_points():
    found = rl.iso(surface(scattered(np.repeat([0.0, 1.0], [48, 16]))))
    assert found.material_ratio(0.5) == 25
    assert found.material_ratio(-0.5) == 100
    assert found.material_ratio(2.0) == 0


def test_a_profile_has_the_parameters_of_profiles():
    line = rl.Line(np.random.default_rng(1).normal(size=200), 2.0, "mm", kind="profile")
    found = rl.iso(line)
    assert list(found.values) == list(PROFILE_PARAMETERS)
    assert next(found.parameters).standard == "ISO 21920-2:2021"
    assert found.Mr1 == found.Rmrk1


def test_info_prints_them_only_where_asked(rough, invoke):
    code, out, _ = invoke("info", rough)
    assert code == 0
    assert "Sal" not in out
    code, out, _ = invoke("info", rough, "--iso", "--l-filter", "0.5 mm")
    assert code == 0
    assert "Parameters of ISO 25178-2:2021" in out
    assert "L: Gaussian (ISO 16610-61), 500 µm" in out
    for name in SURFACE_PARAMETERS:
        assert f"\n{name} " in out


def test_json_has_values_units_and_causes(rough, invoke):
    _, out, _ = invoke("info", rough, "--json")
    assert "iso" not in json.loads(out)
    _, out, _ = invoke("info", rough, "--iso", "--json")
    told = json.loads(out)["iso"]
    assert told["filters"]["F"] == "none"
    assert list(told["parameters"]) == list(SURFACE_PARAMETERS)
    assert told["parameters"]["Sq"]["unit"] == "m"
    for each in told["parameters"].values():
        assert (each["value"] is None) == (each["undefined"] is not None)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--l-filter", "0.5 mm"), "--l-filter is of the parameters of ISO alone; give --iso too"),
        (("--iso", "--l-filter", "2 mm"), "--l-filter is 2 mm; a wavelength from"),
        (("--iso", "--s-filter", "1"), '--s-filter is "1", without a unit'),
        (
            ("--iso", "--s-filter", "0.2 mm", "--l-filter", "0.1 mm"),
            "--s-filter is 200 µm; less than the L-filter, 100 µm, is needed",
        ),
    ],
)
def test_wrong_options_are_refused_in_one_line(rough, invoke, options, said):
    code, out, errors = invoke("info", rough, *options)
    assert (code, out) == (2, "")
    assert said in errors
    assert errors.count("\n") == 1


def test_a_file_without_unit_has_none_yet_and_says_so(tmp_path, invoke):
    np.save(tmp_path / "map.npy", gaussian_field(16, 2.0, 1))
    code, out, _ = invoke("info", tmp_path / "map.npy", "--iso")
    assert code == 0
    assert "note: there are no parameters of ISO until what is missing here is given" in out


def test_a_curve_has_none(tmp_path, invoke):
    body = surface(gaussian_field(16, 2.0, 1))
    rl.press(body, E_star=1.0, n_loads=2).write(tmp_path / "curve.nc")
    code, _, errors = invoke("info", tmp_path / "curve.nc", "--iso")
    assert code == 2
    assert "this file is a curve" in errors
