"""A layer in Explore: contact, curves, theories, code and files are those of the library."""

import numpy as np
import pytest

import roughline as rl
from lab.explore_asked import (
    COATED,
    E_STAR,
    LAYERED,
    LENGTH,
    SCALE,
    SMALL,
    answer,
    loads,
    said,
    saved,
)
from roughline.lab.explore import pictures
from roughline.lab.explore.reading import read_state, usable_state


def test_the_strip_says_what_the_layer_is():
    layer = said(answer(pictures.full, COATED)[0])["layer"]
    assert layer["value"] == "3.20 cells"
    assert layer["below"] == "50.0 µm, E*_l 22.0 GPa"


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


def test_a_layer_that_a_coarser_grid_does_not_resolve_is_refused_at_what_was_changed():
    before = {"n": "512", "t": "0.002"}
    asked = {"state": {"t": "0.002", "n": "64"}, "before": before, "session": {}}
    state, refused = usable_state(asked)
    assert list(refused) == ["n"]
    assert "half a cell" in refused["n"]
    assert state.points(64) == 256


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
    assert {"area", "layer"} <= said(header).keys()
    for key in set(more) & {"hardness_bar", "w", "fluid"}:
        assert answer(pictures.further, state, of=key)[0]["panels"]


def test_code_gives_the_same_numbers(ran):
    surface = read_state(SMALL).surface(64)
    pressed = rl.press(surface, half_space=LAYERED, forces=[0.2 * SCALE])
    numbers = [float(line.split()[-1]) for line in ran(COATED, "python")[:2]]
    wanted = pressed.stiffness / (E_STAR * LENGTH)
    assert numbers == pytest.approx([*wanted, *pressed.area_fraction_corrected], rel=1e-9)
    told = ran(COATED, "command")["curve"]["stiffness"]
    assert told == pytest.approx(pressed.stiffness, rel=1e-6)


@pytest.mark.parametrize("name", ["maps.nc", "curve.nc"])
def test_files_can_be_saved(name, tmp_path):
    assert saved(name, COATED, tmp_path).stat().st_size
