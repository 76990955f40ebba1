"""Several maps of one part, and joints, on the command line."""

import json
import math
import re
from dataclasses import replace

import pytest

import roughline as rl

METALS = (
    "E=210 GPa nu=0.3 resistivity=1e-7 ohm m conductivity=50 W/m/K, "
    "E=120 GPa nu=0.3 resistivity=2e-8 ohm m conductivity=400 W/m/K"
)
ASKED = ("--materials", METALS, "--load", "5 MPa", "--no-grid-error")


@pytest.fixture
def points():
    """Points a side of the maps; a test may ask for others, as a parameter."""
    return 32


@pytest.fixture
def scans(tmp_path, points):
    """Files of three maps of one part, and of a fourth that holds none."""
    spectrum = rl.SelfAffine(hurst=0.7, length=3e-4, rms_height=1e-6, q_roll=math.tau / 25e-6)
    part = spectrum.surface(3 * points, 3)
    files = [tmp_path / f"place{i}.nc" for i in range(3)]
    for i, file in enumerate(files):
        piece = part.cropped((points * i, points * (i + 1)), (0, points)).detrended()
        rl.write(replace(piece, unit="m"), file)
    (tmp_path / "bad.txt").write_text("no heights")
    return [*files, tmp_path / "bad.txt"]


def test_a_table_has_mean_scatter_and_interval(scans, invoke, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    code, out, errors = invoke("press", *scans[:3], *ASKED, "--all")
    assert code == 0, errors
    said = " ".join(out.split())
    assert re.search(r"place0.nc 32 x 32 100 µm x 100 µm \S+ [nµ]m \S+ place1.nc", said)
    assert re.search(r"constriction resistance R \S+ mΩ \(\S+ to \S+\) \S+% ", said)
    assert re.search(r"5 MPa( \*)? scatter", said)
    assert "note: interval of the part: 95 % for the mean over all its places" in said


@pytest.mark.parametrize("points", [16, 32])
def test_a_part_begins_with_its_maps_and_counts_what_is_folded(scans, invoke, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    code, out, errors = invoke("press", *scans, *ASKED)
    assert code == 1, errors
    lines = out.splitlines()
    assert lines[0] == "3 maps of 4: place0.nc, place1.nc, place2.nc"
    assert lines[2].startswith("E=210 GPa nu=0.3 on E=120 GPa nu=0.3 under 5 MPa")
    assert any(line.startswith("warning: refused: bad.txt") for line in lines)
    header = next(i for i, line in enumerate(lines) if line.endswith("scatter  further"))
    groups = ["mechanics", "contact", "electrical", "thermal"]
    starts = [line.partition(": ")[0] for line in lines[header:]]
    assert [each for each in starts if each in groups] == groups
    further = re.fullmatch(
        r".* notes, (\d+) further answers and those of each map: --all shows them", lines[-1]
    )
    answers = json.loads(invoke("press", *scans, *ASKED, "--json")[1])["part"]
    assert int(further[1]) == len(answers) - len(groups)
    assert not any(line.startswith("place0.nc") for line in lines)


@pytest.mark.parametrize("points", [16, 32])
def test_json_has_each_map_and_the_part(scans, invoke):
    code, out, _ = invoke("press", *scans, *ASKED, "--json")
    found = json.loads(out)
    assert code == 1  # one was refused, which is no success
    assert list(found["maps"]) == ["place0.nc", "place1.nc", "place2.nc"]
    assert list(found["refused"]) == ["bad.txt"]
    part, single = found["part"]["R"], found["maps"]["place1.nc"]["answers"]["R"]
    assert part["maps"] == [3]
    assert part["low"][0] < part["mean"][0] < part["high"][0]
    assert part["low"][0] < single["values"][0] < part["high"][0] * part["scatter"][0]
    code, out, _ = invoke("press", scans[1], *ASKED, "--json")
    assert json.loads(out)["answers"]["R"]["values"] == single["values"]


@pytest.mark.parametrize(
    ("points", "extent"), [(16, "its page"), (32, "all of it")], indirect=["extent"]
)
def test_a_report_on_a_part_and_its_joint(scans, extent, invoke, only_drawn, tmp_path):
    only_drawn("answers")
    folder = tmp_path / "report"
    code, _, errors = invoke(
        "press",
        *scans[:2],
        scans[3],
        materials=METALS,
        load="1 kN",
        joint_area="2 cm^2",
        report=folder,
    )
    assert code == 1, errors
    page = (folder / "report.html").read_text(encoding="utf-8")
    bare = " ".join(re.sub("<[^>]*>", " ", re.sub("<sub>(.*?)</sub>", r"_\1", page)).split())
    for text in (
        "Contact of a part, 2 maps of 3",
        "under 1 kN on a joint of 200 mm²",
        "interface stiffness",
        "specific contact resistance",
        "Refused: bad.txt",
        "The joint is alike everywhere, and evenly loaded",
        "1 kN on the joint of 200 mm², 5 MPa everywhere",
        "Student's t on logarithms",
    ):
        assert text in bare.replace("&#39;", "'"), text
    assert str(tmp_path) not in page
    if extent == "all of it":
        assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")
    assert (folder / "answers.png").stat().st_size > 10_000
    own = (folder / "map-02-place1" / "report.html").read_text(encoding="utf-8")
    assert "Contact of place1.nc" in own
    assert "interface stiffness" in re.search('<p class="lead">(.*?)<h2>', own, re.DOTALL)[1]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--joint-area", "100 µm^2"), "crop the map, or leave --joint-area out"),
        (("--joint-area", "0 cm^2"), '--joint-area is "0 cm^2"; a positive'),
        (("--joint-area", "2 cm"), "which is no quantity in m^2"),
        (("--joint-area", "2 cm^2", "--depth", "1 um"), "its depth counts from the touch"),
    ],
)
def test_refusals_are_in_flags(scans, invoke, arguments, message):
    code, out, errors = invoke("press", scans[0], *ASKED, *arguments)
    assert (code, out) == (2, "")
    assert message in errors
    assert len(errors.splitlines()) == 1


def test_nothing_pressed_is_one_line(scans, invoke):
    code, out, errors = invoke("press", scans[3], scans[3].with_name("none.nc"), *ASKED)
    assert (code, out) == (2, "")
    assert "none of the 2 maps can be pressed: bad.txt" in errors
    assert len(errors.splitlines()) == 1
    code, _, errors = invoke("press", *scans[:2], "--modulus", "1 GPa", "--load", "1 N")
    assert (code, "which need two materials (--materials)" in errors) == (2, True)
