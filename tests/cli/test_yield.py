"""Hardness, histories and unloading on the command line: numbers, report, figures, refusals."""

import json
import re

import numpy as np
import pytest
import xarray
from attrs import evolve
from matplotlib.figure import Figure

import roughline as rl
from roughline.report.answers import answer_table
from roughline.report.contact_figures import curve_figure, draw_last_contact
from roughline.report.contact_tables import curve_table, formula_table

PAIR = ("--materials", "steel,copper")
H = rl.material("copper").hardness


def test_a_hardness_alone_needs_no_materials(rough, invoke):
    code, out, errors = invoke(
        "press", rough, modulus="110 GPa", hardness="2 GPa", load="10 N", json=True
    )
    assert code == 0, errors
    found = json.loads(out)
    curve = rl.press(rl.read(rough), E_star=110e9, hardness=2e9, forces=[10.0])
    for name in ("stiffness", "unloading_stiffness", "plastic_fraction", "indentation", "work"):
        assert found["curve"][name] == getattr(curve, name).tolist(), name
    low, high = found["unloading_stiffness_interval"]
    assert low[0] < curve.unloading_stiffness[0] < high[0]
    assert found["settings"]["hardness"] == 2e9
    assert found["answers"] == {}


def test_json_has_both_stiffnesses_the_scatter_and_the_elastic_answers(rough, invoke):
    question = ("press", rough, *PAIR, "--load", "10 N", "--json")
    plain, elastic = (json.loads(invoke(*question, *flags)[1]) for flags in ((), ("--elastic",)))
    answers = plain["answers"]
    assert answers["k_u"]["values"] == plain["curve"]["unloading_stiffness"]
    assert answers["A_p/A"]["values"] == plain["curve"]["plastic_fraction"]
    for symbol, answer in elastic["answers"].items():
        assert answers[symbol]["if_elastic"] == answer["values"], symbol
        assert answer["if_elastic"] is None
        assert "hardness" not in [each["cause"] for each in answer["margins"]]
    (margin,) = (each for each in answers["R"]["margins"] if each["cause"] == "hardness")
    assert margin["low"][0] < answers["R"]["values"][0] < margin["high"][0]
    for name in ("unloading_stiffness", "plastic_fraction", "dissipated_work"):
        assert name not in elastic["curve"]


@pytest.mark.parametrize("points", [32, 64])
def test_loads_of_a_history_are_applied_in_the_order_given(rough, invoke, only_drawn, tmp_path):
    only_drawn()
    loads = [each for load in ("5 N", "10 N", "0 N", "7 N") for each in ("--load", load)]
    code, out, errors = invoke("press", rough, *PAIR, *loads, history=True, json=True, out=tmp_path)
    assert code == 0, errors
    found = json.loads(out)
    forces = [5.0, 10.0, 0.0, 7.0]
    curve = rl.press(rl.read(rough), E_star=found["E_star"], hardness=H, forces=forces)
    assert found["loads"] == ["5 N", "10 N", "0 N", "7 N"]
    assert found["curve"]["force"] == forces
    assert found["curve"]["depth"] == curve.depth.tolist()
    assert found["answers"]["R"]["values"][2] is None  # infinite, which JSON has not
    assert not any("load 0 N" in note for note in found["notes"])
    with xarray.open_dataset(tmp_path / "curve.nc", engine="h5netcdf") as data:
        assert data.force.values.tolist() == forces
        assert data.depth.values.tolist() == curve.depth.tolist()
        assert data.unloading_stiffness.attrs["units"] == "N/m"
        assert data.attrs["hardness"] == H
    code, out, _ = invoke("press", rough, *PAIR, *loads[:4], *loads[6:], "--json")
    assert json.loads(out)["curve"]["depth"][2] < found["curve"]["depth"][3]  # none came before


@pytest.mark.parametrize(("points", "drawn"), [(32, []), (64, ["curve"])], ids=["32", "64"])
def test_unloading_is_printed_in_words_and_drawn(rough, invoke, only_drawn, tmp_path, drawn):
    only_drawn(*drawn)
    code, out, errors = invoke(
        "press", rough, *PAIR, load="10 N", unload=True, out=tmp_path, all=True
    )
    assert code == 0, errors
    lines = [" ".join(line.split()) for line in out.splitlines()]
    assert any(line.startswith("unloaded to 25% ") for line in lines)
    last = [line for line in lines if line.startswith("unloaded ") and " to " not in line]
    assert last[0].startswith("unloaded 0 N/m 0 N/m 0% infinite")
    assert any(re.search(r"0 N 0 Pa \S+ [nµ]m", line) for line in last)  # a depth is left
    assert (tmp_path / "curve.png").stat().st_size > (10_000 if drawn else 0)


@pytest.mark.parametrize(
    ("points", "extent"), [(32, "its page"), (64, "all of it")], indirect=["extent"]
)
def test_a_report_of_metals_that_yield(holed, points, extent, invoke, only_drawn, tmp_path):
    only_drawn()
    file, *options = holed
    # the first of them that yield changes by more than its interval
    changed = "contact area fraction" if points == 64 else "unloading stiffness"
    code, _, errors = invoke(
        "press",
        file,
        *options,
        *PAIR,
        load="10 N",
        unload=True,
        friction="0.3",
        grid_error=True,
        report=tmp_path / "report",
    )
    assert code == 0, errors
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    bare = " ".join(
        re.sub("<[^>]*>", " ", re.sub("<sub>(.*?)</sub>", r"_\1", page)).split()
    ).replace("&#39;", "'")
    lead = re.search('<p class="lead">(.*?)<h2>', page, re.DOTALL)[1]
    order = [
        "Steel on copper under 10 N",
        "contact stiffness",
        "unloading stiffness",
        "contact area fraction",
        "constriction resistance",
        f"For comparison, if nothing yielded: {changed}",
    ]
    places = [lead.index(words) for words in order]
    assert places == sorted(places)
    for text in (
        "H = 370 MPa to a factor of 1.5",
        "perfectly plastic",
        "dashed: on unloading; blue: after a larger load",
        "red: at the hardness",
        "unloaded to 75%",
        "the scatter of the hardness",
        "E* (ρ_1 + ρ_2) / (2 k_u)",
    ):
        assert text in bare, text
    assert "not solved" not in bare
    assert "nan" not in bare.lower()


@pytest.fixture(scope="module")
def unloaded():
    """Pressed, with a whole curve, and unloaded again."""
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3)
    body = rl.Surface(surface.heights, surface.sizes, "m")
    question = rl.Question(body, "steel,copper", loads="10 N", unload=True, whole_curve=True)
    return rl.assess(question)


def test_points_at_the_hardness_are_marked(unloaded):
    axes = Figure().subplots()
    draw_last_contact(axes, unloaded.body, unloaded)
    (picture,) = axes.images
    shown = np.asarray(picture.get_array())
    fields = unloaded.fields
    assert ((shown == 2) == fields.plastic.T).all()
    assert ((shown == 1) == (fields.contact & ~fields.plastic).T).all()
    assert (shown == 2).any()
    assert (shown == 1).any()


def test_both_branches_are_drawn(unloaded):
    """Force over depth on linear scales, where the dent that is left shows as well."""
    left, right = curve_figure(unloaded).axes
    for axes, scale, falling in ((left, "linear", 5), (right, "log", 4)):
        assert (axes.get_xscale(), axes.get_yscale()) == (scale, scale)
        marks = [line for line in axes.lines if line.get_marker() == "o"]
        drawn = {line.get_color(): 0 for line in marks}
        for line in marks:
            drawn[line.get_color()] += line.get_xdata().size
        # of five steps the last has no place in a logarithm
        assert drawn["tab:blue"] == falling
        assert drawn["k"] == unloaded.curve.force.size - 5
    for axes, told in ((left, "after a larger load"), (right, "unloading $k_u$")):
        legend = [text.get_text() for text in axes.get_legend().get_texts()]
        assert told in legend
        left_out = [text for text in legend if "not shown" in text]
        assert left_out == (
            ["1 of 21 loads not shown, at zero or infinite"] if axes is right else []
        )


def test_without_falling_loads_the_scales_are_logarithmic(unloaded):
    alone = rl.assess(evolve(unloaded.question, unload=False))
    left, _ = curve_figure(alone).axes
    assert (left.get_xscale(), left.get_legend()) == ("log", None)


def test_an_unloading_is_answered_at_every_load(rough, invoke, monkeypatch):
    monkeypatch.setenv("COLUMNS", "600")  # all answers beside each other
    asked = ("press", rough, *PAIR, "--load", "10 N", "--unload")
    code, out, errors = invoke(*asked)
    assert code == 0, errors
    assert "constriction resistance R" in out
    for load in ("10 N", "unloaded to 75%", "unloaded to 10%"):
        (row,) = (line for line in out.splitlines() if line.startswith(f"{load}  "))
        assert re.search(r"[µm]Ω \(", row)
        assert "kW/(m² K) (" in row
    assert "for comparison, " not in out
    _, out, _ = invoke(*asked, "--all")
    assert "for comparison, if nothing yielded: " in out
    assert "(at the largest load)" in out


def test_tables_of_an_unloading_have_a_value_in_every_cell(unloaded):
    for header, rows in (
        curve_table(unloaded),
        answer_table(unloaded, with_elastic=True),
        formula_table(unloaded),
    ):
        assert all(len(row) == len(header) for row in rows)
        assert not [row for row in rows if "not solved" in row or "nan" in " ".join(row)]
    rows = {row[0]: row[1:] for row in answer_table(unloaded)[1]}
    assert rows["constriction resistance R"][-1] == "infinite"
    assert rows["mean contact pressure p_c"][-1] == "0 Pa"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--hardness", "0 GPa"), 'hardness is "0 GPa"; a positive pressure is needed'),
        (("--hardness", "-2 GPa"), 'hardness is "-2 GPa"; a positive pressure'),
        (("--hardness", "nan GPa"), 'hardness is "nan GPa"; a positive pressure'),
        (("--hardness", "5 N"), 'hardness is "5 N", which is no quantity in Pa'),
        (("--hardness", "2"), 'without a unit; give one, such as "2 GPa"'),
        (("--hardness", "200 HV"), "1 HV is 10.6 MPa on the projected indent"),
        (("--hardness", "2 GPa", "--elastic"), "--hardness and --elastic contradict each other"),
        (("--load", "380 MPa"), "bears less than 370 N on the map (H A_0): give smaller loads"),
        (
            ("--joint-area", "2 cm^2", "--load", "80 kN"),
            "bears less than 74 kN on the joint (H A_0)",
        ),
        (("--load", "0 N"), '--load is "0 N"; give positive ones'),
        (("--load", "0 N", "--load", "1 N", "--history"), "and zero only to unload after others"),
        (("--history",), "--history needs --load or --depth in the order of the history"),
        (("--depth", "1 um", "--unload"), "--unload takes off the largest of the loads (--load)"),
        (("--load", "1 N", "--history", "--unload"), "write the falling values yourself"),
    ],
)
def test_what_cannot_be_is_one_line_in_flags(rough, invoke, arguments, message):
    code, out, errors = invoke("press", rough, *PAIR, *arguments)
    assert (code, out) == (2, "")
    assert message in errors
    assert len(errors.splitlines()) == 1


def test_a_line_scan_has_no_hardness(tmp_path, invoke):
    heights = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3).heights
    np.save(tmp_path / "scan.npy", heights[0])
    scan = ("press", tmp_path / "scan.npy", "--unit", "m", "--size", "1 mm", *PAIR)
    code, out, errors = invoke(*scan, "--load", "1 N", "--hardness", "1 GPa")
    assert (code, out) == (2, "")
    assert "belong to a surface; the reduced model of a line has no yield: it can be" in errors
    assert "used while mean contact pressures stay below about 0.4 of the hardness" in errors
    assert "leave --hardness out, or press a map\n" in errors
    assert len(errors.splitlines()) == 1
    code, out, errors = invoke(*scan, "--load", "1 N", "--all")
    assert code == 0, errors
    assert "the reduced model has no yield" in out
