"""Coated materials on the command line: numbers, JSON, report and refusals."""

import json
import re

import numpy as np
import pytest

import roughline as rl

PAIR = "gold 20 um on nickel 40 um on copper, steel"
QUESTION = ("--load", "1 N", "--elastic")


def test_answers_and_json_are_those_of_the_library(rough, invoke):
    code, out, errors = invoke("press", rough, "--materials", PAIR, *QUESTION, "--json")
    assert code == 0, errors
    found = json.loads(out)
    assert found["materials"] == ["gold 20 µm on nickel 40 µm on copper", "steel"]
    layers = rl.Layered([78e9, 199.5e9], [0.44, 0.312], [20e-6, 40e-6], 129.8e9, 0.343)
    steel = rl.Homogeneous(211.9e9 / (1 - 0.291**2))
    curve = rl.press(rl.read(rough), half_space=layers + steel, forces=[1.0])
    np.testing.assert_allclose(found["curve"]["stiffness"], curve.stiffness, rtol=1e-9)
    assert found["answers"]["k"]["values"] == found["curve"]["stiffness"]
    assert not {"h_c", "k_t", "R_Holm"} & found["answers"].keys()
    assert {"R", "G"} <= found["answers"].keys()
    assert any("no estimates for comparison" in each for each in found["notes"])
    assert found["measures"]["electrical_spreading"]["unit"] == "m"
    code, out, _ = invoke("press", rough, "--modulus", "110 GPa", *QUESTION, "--json")
    assert json.loads(out)["materials"] is None


def test_words_name_what_lies_at_the_surfaces(rough, invoke):
    code, out, errors = invoke("press", rough, "--materials", PAIR, *QUESTION, "--all")
    assert code == 0, errors
    said = " ".join(out.split())
    E_star = rl.contact_modulus(rl.material("gold"), rl.material("steel"))
    assert f"E* of gold and steel, which lie at the surfaces, = {E_star / 1e9:.2f} GPa" in said
    assert "no tangential stiffness of coated bodies: its ratio to the normal one" in said


def test_a_report_has_the_layers_and_the_command_as_typed(rough, invoke, only_drawn, tmp_path):
    only_drawn()
    folder = tmp_path / "report"
    code, _, errors = invoke("press", rough, *QUESTION, materials=PAIR, report=folder)
    assert code == 0, errors
    page = (folder / "report.html").read_text("utf-8")
    text = " ".join(re.sub(r"<[^>]*>", " ", page).split())
    assert "gold 20 µm on nickel 40 µm on copper: gold (E = 78 GPa, nu = 0.44" in text
    assert "copper (E = 129.8 GPa" in text
    assert "Layers are bonded to each other and to their base" in text
    assert f"--materials &#39;{PAIR}&#39;" in page or f"--materials '{PAIR}'" in page
    assert "Gold 20 µm on nickel 40 µm on copper, against steel under 1 N" in text


@pytest.mark.parametrize(
    ("materials", "message"),
    [
        ("rubber on steel, rigid", '--materials "rubber on steel" cannot be used: "rubber" is no'),
        ("rubber 2 mm on, rigid", '"on" stands between a layer and what it lies on'),
        ("rubber 0 mm on steel, rigid", "the layer of rubber is 0 m thick; a positive"),
        ("rubber nan mm on steel, rigid", "is nan m thick; a positive, finite thickness is"),
        ("rubber 2 on steel, rigid", 'is "2", without a unit'),
        (
            "E=5 MPa nu=0.7 2 mm on steel, rigid",
            "nu of E=5 MPa nu=0.7 is 0.7; allowed is -1 to 0.5",
        ),
        ("rubber 2 mm on steel", "give two with a comma between"),
        (
            "gold 1 um on copper, steel",
            "--materials have a layer of gold, 1 µm, thinner than half a cell",
        ),
    ],
)
def test_layers_that_cannot_be_used_get_one_line(rough, invoke, materials, message):
    code, out, errors = invoke("press", rough, "--materials", materials, *QUESTION)
    assert code == 2
    assert out == ""
    assert message in errors
    assert len(errors.strip().splitlines()) == 1


def test_a_line_scan_refuses_layers(invoke, tmp_path):
    heights = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, 3).heights[0]
    rl.write(rl.Line(heights, 1e-3, "m", kind="profile"), tmp_path / "scan.nc")
    code, _, errors = invoke("press", tmp_path / "scan.nc", "--materials", PAIR, *QUESTION)
    assert code == 2
    assert "is coated, and the springs of a line have one modulus" in errors
    assert len(errors.strip().splitlines()) == 1


def test_theories_that_do_not_hold_are_named(rough, invoke):
    code, out, errors = invoke(
        "press",
        rough,
        *QUESTION,
        materials=PAIR,
        theory=["persson", "greenwood-williamson"],
        json=True,
    )
    assert code == 0, errors
    found = json.loads(out)
    assert "greenwood-williamson" not in found["theories"]
    assert any("no greenwood-williamson: its summits are spheres" in n for n in found["notes"])
