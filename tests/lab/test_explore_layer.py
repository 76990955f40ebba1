"""A layer in Explore: contact, curves, theories, code and files are those of the library."""

import json
import shlex

import numpy as np
import pytest

import roughline as rl
from lab.test_explore import E_STAR, HEIGHT, LENGTH, SMALL, answer, loads
from lab.unpacked import assert_sent
from roughline.lab.controls import ControlError
from roughline.lab.explore import code, downloads, pictures
from roughline.lab.explore.reading import read_state, usable_state

COATED = {**SMALL, "t": "0.05", "E_l": "0.2", "nu_l": "0.45"}
SCALE = E_STAR * HEIGHT * LENGTH


@pytest.fixture(scope="module")
def pressed():
    half_space = rl.Layered(
        young=0.2 * E_STAR * (1 - 0.45**2),
        poisson=0.45,
        thickness=0.05 * LENGTH,
        base_young=E_STAR * (1 - 0.3**2),
        base_poisson=0.3,
    )
    surface = read_state(SMALL).surface(64)
    return rl.press(
        surface, half_space=half_space, forces=[0.2 * SCALE], fields=True, grid_error=True
    )


def test_numbers_are_over_the_modulus_of_the_base(pressed):
    header, arrays = answer(pictures.full, COATED)
    wanted = pressed.stiffness / (E_STAR * LENGTH)
    force, found = loads(header, "stiffness", "here")
    assert force == pytest.approx([0.2])
    assert found == pytest.approx(wanted, rel=1e-9)
    np.testing.assert_array_equal(arrays["area"], pressed.fields[0].contact.T)
    assert_sent(arrays["pressure"].T, pressed.fields[0].pressure / E_STAR)
    said = {item["key"]: item for item in header["strip"]}
    assert said["layer"]["value"] == "3.20 cells"
    assert said["layer"]["below"] == "50.0 µm, E*_l 22.0 GPa"


def test_a_layer_as_hard_as_its_base_is_no_layer():
    plain, coated = (
        loads(answer(pictures.curve, SMALL | more)[0], "stiffness")
        for more in ({}, {"t": "0.05", "E_l": "1"})
    )
    np.testing.assert_allclose(coated, plain, rtol=1e-5)


def test_the_reduced_model_says_that_it_knows_no_layer():
    header = answer(pictures.coarse, COATED)[0]["line"]
    assert "homogeneous base" in header["panels"]["stiffness"]["legends"]["line"]
    assert header["strip"][0]["below"] == "on the homogeneous base"
    assert answer(pictures.coarse, SMALL)[0]["line"]["strip"][0]["below"] == ""


def test_theories_of_one_material_are_not_drawn_and_say_why():
    header, _ = answer(pictures.curve, COATED | {"theories": "persson,greenwood-williamson"})
    area = header["panels"]["area"]
    assert {name for name in area["series"] if "theory" in name} == {"theory persson"}
    assert "Greenwood, Williamson: not drawn, its summits are spheres" in area["remarks"]
    assert "times as stiffly" in area["remarks"]


@pytest.mark.parametrize(
    ("said", "at"),
    [
        ({"t": "0.005"}, "t"),
        ({"t": "2 m"}, "t"),
        ({"E_l": "3 mm"}, "E_l"),
        ({"nu_b": "0.6"}, "nu_b"),
    ],
)
def test_what_cannot_be_used_is_refused_where_it_stands(said, at):
    with pytest.raises(ControlError) as refused:
        read_state(COATED | said)
    assert refused.value.at == at


def test_a_layer_that_a_coarser_grid_does_not_resolve_is_refused_at_what_was_changed():
    before = {"n": "512", "t": "0.002"}
    asked = {"state": {"t": "0.002", "n": "64"}, "before": before, "session": {}}
    state, refused = usable_state(asked)
    assert list(refused) == ["n"]
    assert "half a cell" in refused["n"]
    assert state.points(64) == 256


def test_its_numbers_may_have_units():
    state = read_state(SMALL | {"t": "50 um", "E_l": "22 GPa"})
    assert state.added[0].numbers == pytest.approx(
        {"t": 0.05, "E_l": 0.2, "nu_l": 0.3, "nu_b": 0.3}
    )


@pytest.mark.parametrize(
    "more",
    [
        {"hardness_bar": "0.3"},
        {"w": "1", "F": "0.08", "E_l": "2"},
        {"fluid": "x"},
        {"boundary": "periodic"},
    ],
)
def test_it_goes_with_all_others(more):
    state = {**COATED, "D_f": "2.2", **more}
    header, _ = answer(pictures.full, state)
    assert header["refused"] == {}
    assert {"area", "layer"} <= {item["key"] for item in header["strip"]}
    for key in set(more) & {"hardness_bar", "w", "fluid"}:
        assert answer(pictures.further, state, of=key)[0]["panels"]


def test_code_gives_the_same_numbers(pressed, invoke, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    exec(answer(code.code, COATED, which="python")[0]["text"], {})
    out = capsys.readouterr().out.splitlines()
    numbers = [float(line.split()[-1]) for line in out[:2]]
    wanted = pressed.stiffness / (E_STAR * LENGTH)
    assert numbers == pytest.approx([*wanted, *pressed.area_fraction_corrected], rel=1e-9)
    for line in answer(code.code, COATED, which="command")[0]["text"].splitlines():
        done, told, errors = invoke(*shlex.split(line)[1:], *["--json"] * line.count("press"))
        assert done == 0, errors
    assert json.loads(told)["curve"]["stiffness"] == pytest.approx(pressed.stiffness, rel=1e-6)


@pytest.mark.parametrize("name", ["maps.nc", "curve.nc"])
def test_files_can_be_saved(name, tmp_path):
    header, _ = answer(downloads.download, COATED, folder=tmp_path, name=name)
    assert (tmp_path / "results" / header["file"]).stat().st_size
