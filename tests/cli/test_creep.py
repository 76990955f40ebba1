"""Creep and relaxation on the command line, beside what is known of growing contacts."""

import json

import numpy as np
import pytest
import xarray

import roughline as rl
from roughline.creep.question import CreepQuestion, press_with_creep

PRONY = ("--prony", "0.3 10 ms, 20% 1 s")
RUBBER = rl.Creep([0.3, 0.2], [1e-2, 1.0])
MODULUS = ("--modulus", "50 MPa")
TIMES = ("--times", "0 s, 10 ms, 1 min")


@pytest.fixture
def points():
    return 32


@pytest.fixture
def creep(rough, invoke):
    def run(*arguments):
        code, out, errors = invoke("creep", rough, *arguments, "--json")
        assert (code, errors) == (0, "")
        return json.loads(out)

    return run


def test_under_a_held_load_the_contact_is_that_of_a_load_times_the_creep_function(creep, rough):
    found = creep(*PRONY, *MODULUS, *TIMES, "--load", "0.1 MPa")
    forces = 0.1 * RUBBER.compliance([0.0, 0.01, 60.0])  # N on 1 mm²
    elastic = rl.press(rl.read(rough), E_star=50e6, forces=forces)
    assert found["time"] == [0.0, 0.01, 60.0]
    assert found["force"] == pytest.approx([0.1] * 3)
    assert found["elastic_force"] == pytest.approx(forces, rel=1e-9)
    assert found["depth"] == pytest.approx(elastic.depth, rel=1e-6)
    area = elastic.area_fraction_corrected
    assert found["area_fraction_corrected"] == pytest.approx(area, rel=1e-6)
    assert found["relaxed_share"] == pytest.approx(0.5)


def test_at_a_held_depth_the_force_relaxes(creep):
    found = creep(*PRONY, *MODULUS, *TIMES, "--depth", "1 um")
    force = np.array(found["force"])
    relaxation = RUBBER.relaxation([0.0, 0.01, 60.0])
    assert force / force[0] == pytest.approx(relaxation, rel=1e-9)
    assert found["depth"] == [1e-6] * 3


def test_several_loads_are_those_at_the_times(creep):
    loads = ("--load", "0 N", "--load", "50 mN", "--load", "0.1 N")
    found = creep(*PRONY, *MODULUS, *TIMES, *loads)
    assert found["force"] == pytest.approx([0.0, 0.05, 0.1])
    assert found["elastic_force"][1] < 0.05 * RUBBER.compliance(0.01)


def test_without_times_they_reach_from_zero_to_where_all_has_relaxed(creep):
    found = creep(*PRONY, *MODULUS, "--load", "10 mN")
    assert found["time"][:2] == pytest.approx([0.0, 1e-3])
    assert found["elastic_force"][-1] == pytest.approx(0.02, rel=1e-4)


@pytest.mark.parametrize(
    ("materials", "modulus", "note"),
    [
        ("rigid, E=9 MPa nu=0.49", 9e6 / (1 - 0.49**2), ""),
        ("E=9 MPa nu=0.49, E=9 MPa nu=0.49", 4.5e6 / (1 - 0.49**2), "both bodies are taken"),
        ("steel, E=9 MPa nu=0.49", 9e6 / (1 - 0.49**2), "steel is taken to creep as the other"),
        ("E=9 MPa nu=0.49 50 um on rigid, rigid", 9e6 / (1 - 0.49**2), ""),
    ],
)
def test_materials_are_those_at_once(rough, materials, modulus, note):
    asked = CreepQuestion(rough, RUBBER, materials, times="0 s", loads="1 mN")
    found = press_with_creep(asked)
    assert found.curve.elastic.E_star == pytest.approx(modulus, rel=1e-4)
    assert [each[: len(note)] for each in found.notes] == ([note] if note else [])


def test_layers_may_be_repeated(rough):
    layered = {"materials": "E=9 MPa nu=0.49 50 um on rigid, rigid", "depths": "1 um"}
    asked = CreepQuestion(rough, RUBBER, times="0 s", periodic=True, **layered)
    half_space = rl.Layered(9e6, 0.49, 50e-6, np.inf, 0.49, periodic=True)
    by_hand = rl.press(rl.read(rough), half_space=half_space, depths=[1e-6])
    assert press_with_creep(asked).curve.force == pytest.approx(by_hand.force, rel=1e-6)


def test_the_curve_is_printed_written_and_described(rough, tmp_path, invoke):
    path = tmp_path / "new" / "creep.nc"
    held = ("creep", rough, *PRONY, *MODULUS, *TIMES, "--load", "0.1 N")
    code, out, _ = invoke(*held, "--out", path)
    assert code == 0
    assert "E* = 50 MPa at once; 0.5 of it remains in the end" in out
    lines = [
        line for line in out.splitlines() if line.startswith(("time", "0 s", "10 ms", "1 min"))
    ]
    assert lines[0].split()[:5] == ["time", "force", "F", "depth", "d"]
    assert [line.split("  ")[0] for line in lines[1:]] == ["0 s", "10 ms", "1 min"]
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        assert data.time.values == pytest.approx([0.0, 0.01, 60.0])
        assert data.attrs["creep_times"] == pytest.approx([0.01, 1.0])
    described = invoke("info", path)[1]
    assert "times" in described
    assert "k of a fast load" in described
    assert invoke(*held, "--out", tmp_path / "creep.csv")[0] == 0
    header = (tmp_path / "creep.csv").read_text("utf-8").splitlines()[0]
    assert header.startswith("time,force [N],depth [m]")


def test_what_was_filled_is_told(holed, invoke):
    code, out, _ = invoke("creep", *holed, *PRONY, *MODULUS, *TIMES, "--load", "10 mN")
    assert code == 0
    assert "15 missing points" in out


def test_bodies_that_are_strained_far_are_told(rough):
    asked = CreepQuestion(rough, RUBBER, E_star="1 MPa", times="0 s", loads="0.1 MPa")
    assert "strained by about 0.2 in the end" in press_with_creep(asked).warnings[-1]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (PRONY + MODULUS, "give forces, --load '10 N', or depths, --depth '1 um', one of the"),
        ((*PRONY, "--load", "1 N"), "give either a contact modulus (--modulus) or two materials"),
        (
            (*PRONY, "--load", "1 N", "--materials", "steel,copper"),
            "--materials give steel a share of 0.39 in the compliance, and all that gives way has",
        ),
        (
            (*PRONY, "--load", "1 N", "--materials", "E=9 MPa nu=0.49 1 mm on steel,rigid"),
            '--materials is "E=9 MPa nu=0.49 1 mm on steel"; all that gives way has to creep alike',
        ),
        (
            (*PRONY, *MODULUS, "--load", "1 N", "--load", "2 N"),
            "--times are needed with several loads, one for each",
        ),
        (
            (*PRONY, *MODULUS, *TIMES, "--load", "1 N", "--load", "2 N"),
            "--load has 2 values at 3 times",
        ),
        (
            (*PRONY, *MODULUS, *TIMES, "--load", "9 mN", "--load", "1 mN", "--load", "1 mN"),
            "--load falls so fast that the contact recedes from time 0 on",
        ),
        ((*PRONY, *MODULUS, "--load", "1 kN"), '--load is "1 kN"; the bodies are strained by'),
        ((*PRONY, *MODULUS, "--depth", "3 mm"), '--depth is "3 mm"; the bodies are strained by'),
        (
            (*PRONY, *MODULUS, "--load", "1 N", "--times", "1 s, 1 ms"),
            "--times are 1 and then 0.001",
        ),
        ((*PRONY, *MODULUS, "--load", "1 N", "--times", "1 m"), '--times is "1 m", which is no'),
        ((*MODULUS, "--load", "1 N", "--prony", "0.5 s"), '--prony is "0.5 s"; give shares of the'),
        (
            (*MODULUS, "--load", "1 N", "--prony", "0.5 1 s, 0.5 2 s"),
            '--prony is "0.5 1 s, 0.5 2 s": shares add up to 1; less than 1 is needed',
        ),
        ((*MODULUS, "--load", "1 N", "--prony", "0,5 1 s"), '--prony is "0,5 1 s", with a comma'),
    ],
)
def test_what_cannot_be_followed_is_refused_in_one_line(rough, invoke, arguments, told):
    code, out, errors = invoke("creep", rough, *arguments)
    assert (code, out, errors.count("\n")) == (2, "", 1)
    assert errors.startswith(f"roughline: {told}")


def test_a_line_scan_is_refused_and_a_reduced_line_is_not(tmp_path, invoke):
    heights = np.random.default_rng(1).standard_normal(400)
    np.savetxt(tmp_path / "scan.txt", np.c_[np.arange(400.0), heights])
    asked = (*PRONY, *MODULUS, *TIMES, "--load", "1 mN")
    code, _, errors = invoke("creep", tmp_path / "scan.txt", "--unit", "um", *asked)
    assert code == 2
    assert errors.startswith("roughline: this is a line scan across a surface")
    line = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).line(256, 3)
    rl.write(rl.Line(line.heights, line.length, "m"), tmp_path / "line.nc")
    code, out, _ = invoke("creep", tmp_path / "line.nc", *asked)
    assert code == 0
    assert "A/A_0" not in out
