"""Bodies that stick in Explore: both ways, pull-off, maps, code and files are the library's."""

import math

import numpy as np
import pytest
import xarray

import roughline as rl
from lab.explore_asked import E_STAR, HEIGHT, LAW, SCALE, STICKS, answer, loads, said, saved
from roughline.lab.controls import ControlError
from roughline.lab.explore import adhesion, code, pictures
from roughline.lab.explore.reading import read_state

POORLY = {**STICKS, "h0": "0.35"}  # 2.5 cells


@pytest.fixture(scope="module")
def pressed():
    """Return the contact there, beyond, back, and off."""
    forces = 0.08 * SCALE * np.array([1, 2, 1, 0])
    surface = read_state(STICKS).surface(64)
    return rl.press(surface, E_star=E_STAR, law=LAW, forces=forces, fields=[0, 2])


@pytest.fixture(scope="module")
def pull_off(pressed, cycle):
    """Return depth and force of the largest pull on the way back, in small steps about it."""
    surface = read_state(STICKS).surface(64)
    (about,) = of_cycle(cycle[0])["pull-off"]["x"]
    steps = [np.arange(about + 0.2, about - 0.2, -0.02), np.arange(about - 0.2, -1.5, -0.1)]
    first = np.arange(pressed.depth[1] / HEIGHT, about + 0.2, -0.1)
    depths = HEIGHT * np.concatenate([first, *steps])
    back = rl.press(surface, E_star=E_STAR, law=LAW, depths=depths)
    return back.pull_off_depth, back.pull_off_force


@pytest.fixture(scope="module", params=["few depths", "all depths"])
def depths(request):
    """Let both ways have few depths, or all."""
    with pytest.MonkeyPatch.context() as patch:
        if request.param == "few depths":
            patch.setattr(adhesion, "_DEPTHS_IN", 5)
            patch.setattr(adhesion, "_DEPTHS_OUT", 10)
        yield request.param


@pytest.fixture(scope="module")
def cycle(depths):
    return answer(pictures.further, STICKS, of="w")


def of_cycle(header):
    return header["panels"]["cycle"]["series"]


def test_the_strip_says_what_pulls(pressed):
    fields, found = pressed.fields[0], said(answer(pictures.full, STICKS)[0])
    assert fields.contact.any()
    assert fields.pulling.any()
    assert found["pulling"]["value"] == f"{100 * pressed.pulling_fraction[0]:#.3g}%"
    mean = fields.pressure[fields.contact].mean()
    assert f"{mean / E_STAR:#.3g} E*" in found["pressure"]["below"]


def test_the_way_back_and_the_pull_off_are_those_of_the_library(pressed, pull_off, cycle):
    header, arrays = cycle
    fields = pressed.fields[2]
    np.testing.assert_array_equal(arrays["retreat"].T, fields.contact + 2 * fields.pulling)
    assert of_cycle(header)["here"]["x"] == pytest.approx(pressed.depth[[0, 2]] / HEIGHT, rel=1e-5)
    assert of_cycle(header)["here"]["y"] == pytest.approx([0.08, 0.08])
    [pull], [depth] = of_cycle(header)["pull-off"]["y"], of_cycle(header)["pull-off"]["x"]
    assert pull == pytest.approx(pull_off[1] / SCALE, rel=5e-3)
    assert depth == pytest.approx(pull_off[0] / HEIGHT, abs=0.02)
    found = said(header)
    assert found["pull_off"]["value"] == f"{pull:#.3g}"
    assert found["retreat"]["value"] == f"{100 * pressed.area_fraction_corrected[2]:#.3g}%"
    assert pressed.area_fraction[2] > pressed.area_fraction[0]


def test_both_ways_go_from_out_of_reach_to_twice_the_load_and_back(cycle):
    header, _ = cycle
    there, back = (of_cycle(header)[way] for way in ("there", "back"))
    depth, force = (np.array(there[axis] + back[axis]) for axis in ("x", "y"))
    there = np.arange(depth.size) < len(there["x"])
    assert force[0] == force[-1] == 0
    assert force.max() == pytest.approx(0.16, rel=1e-4)
    assert (np.diff(depth[there]) > 0).all()
    assert (np.diff(depth[~there]) < 0).all()
    assert force[~there].min() == pytest.approx(of_cycle(header)["pull-off"]["y"][0], rel=0.1)
    assert {row[-1] for row in header["panels"]["cycle"]["rows"]} == {"there", "back"}


def test_a_zone_of_fewer_than_four_cells_is_told():
    found = said(answer(pictures.full, STICKS)[0])
    assert found["zone"]["value"] == f"{64 * 0.5**2 / math.pi:.2g} cells"
    assert not found["zone"]["below"]
    found = said(answer(pictures.full, POORLY)[0])
    assert found["zone"]["value"] == "2.5 cells *"
    assert "4 are needed" in found["zone"]["below"]


@pytest.mark.usefixtures("depths")
def test_without_a_pull_off_it_says_that_the_grid_does_not_resolve_it():
    header, _ = answer(pictures.further, {**STICKS, "h0": "0.3"}, of="w")
    assert of_cycle(header)["pull-off"] == {"x": [], "y": []}
    assert said(header)["pull_off"]["value"] == "not known"


def test_without_the_tick_nothing_sticks():
    with pytest.raises(ControlError) as error:
        answer(pictures.further, {**STICKS, "w": ""}, of="w")
    assert error.value.at == "w"


def test_grids_of_pictures_resolve_the_pull_where_that_of_the_state_does():
    state = read_state({**STICKS, "n": "1024", "h0": "0.25"})
    assert state.points(64) == 256
    assert state.added[0].zone(state, 256) >= 4 > state.added[0].zone(state, 128)
    assert read_state({**STICKS, "n": "1024", "w": ""}).points(128) == 128


def test_a_fluid_flows_between_bodies_that_stick(pressed):
    header, _ = answer(pictures.full, {**STICKS, "fluid": "x"})
    aperture = rl.flow(pressed.fields[0]).hydraulic_aperture
    assert loads(header, "aperture", "here")[1] == pytest.approx([aperture / HEIGHT], rel=1e-3)


def test_as_python_gives_the_same_and_the_command_presses_bodies_that_stick(cycle, ran):
    *_, there, _, back, pull = ran(STICKS, "python")
    found, way_back = said(answer(pictures.full, STICKS)[0]), said(cycle[0])
    share = float(found["area"]["value"][:-1])
    assert 100 * float(there.split()[-1]) == pytest.approx(share, rel=0.1)
    assert f"{100 * float(back.split()[-1]):#.3g}%" == way_back["retreat"]["value"]
    (wanted,) = of_cycle(cycle[0])["pull-off"]["y"]
    assert float(pull.split()[1]) / SCALE == pytest.approx(wanted, rel=1e-2)
    command = answer(code.code, STICKS, which="command")[0]["text"]
    assert command.splitlines()[-1].startswith("# the way back and the pull-off")
    (told,) = ran(STICKS, "command")["curve"]["area_fraction_corrected"]
    assert 100 * told == pytest.approx(share, rel=0.1)


def test_what_bodies_that_stick_show_can_be_saved(tmp_path, pressed):
    file = saved("maps.nc", STICKS, tmp_path)
    with xarray.open_dataset(file, engine="h5netcdf") as data:
        np.testing.assert_array_equal(data.pulling, pressed.fields[0].pulling)
