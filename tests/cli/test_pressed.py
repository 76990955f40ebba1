"""What `press` says of loads, of intervals and of what is left out: on screen, JSON, report."""

import json
import re
from datetime import date

import numpy as np
import pytest
import xarray

import roughline as rl
from roughline.facts.listed import listed
from roughline.margins import grid
from roughline.margins import variant as variants
from roughline.question import case
from roughline.report.values import written_scale
from roughline.units import decimal, engineering

PAIR = ("--materials", "steel,copper")
INTERVAL = re.compile(r"± \S+%|\S+ to \S+")


def table_lines(out):
    """Lines of the table on screen."""
    lines = out.splitlines()
    first = next(i for i, line in enumerate(lines) if line.strip().startswith("normal force")) - 1
    after = ("*", "note:", "for comparison, ", "Why it is not known better")
    last = next(i for i, line in enumerate(lines) if line.startswith(after))
    return lines[first:last]


def test_loads_keep_their_order_and_words_and_are_solved_once(rough, invoke, monkeypatch):
    solved = []
    original = variants.press

    def press(*arguments, **named):
        solved.append(named["forces"])
        return original(*arguments, **named)

    monkeypatch.setattr(variants, "press", press)
    loads = ("--load", "10 N", "--load", "2 N", "--load", "2000 mN")
    code, out, errors = invoke("press", rough, *PAIR, *loads, "--json")
    assert code == 0, errors
    found = json.loads(out)
    assert found["loads"] == ["10 N", "2 N", "2000 mN"]
    assert found["curve"]["force"] == [10.0, 2.0, 2.0]
    assert found["answers"]["F"]["values"] == [10.0, 2.0, 2.0]
    assert np.argsort(found["curve"]["depth"])[-1] == 0
    # and again of elastic bodies, and as soft and as hard as copper may be; and a flat punch
    assert solved == [[2.0, 10.0], None, *[[2.0, 10.0]] * 3]
    solved.clear()
    code, out, _ = invoke("press", rough, *PAIR, *loads, "--elastic", "--all")
    assert solved == [[2.0, 10.0], None]
    assert table_lines(out)[0].split() == ["10", "N", "2", "N", "2000", "mN"]


def test_depths_keep_their_order_too(rough, invoke):
    code, out, errors = invoke(
        "press", rough, "--modulus", "1 GPa", "--depth", "1 um", "--depth", "300 nm", "--json"
    )
    assert code == 0, errors
    found = json.loads(out)
    assert (found["loads"], found["curve"]["depth"]) == (["1 um", "300 nm"], [1e-6, 3e-7])


@pytest.mark.parametrize("points", [32, 64])
def test_filling_alone_makes_no_interval(holed, invoke):
    arguments = ("press", *holed, *PAIR, "--load", "10 N")
    code, out, errors = invoke(*arguments, "--no-grid-error", "--all")
    assert code == 0, errors
    assert not INTERVAL.search("\n".join(table_lines(out)))
    assert "grid error not estimated, so values come without intervals" in " ".join(out.split())
    assert "filled by nearest instead, stiffness changes by" in " ".join(out.split())
    code, out, _ = invoke(*arguments, "--no-grid-error", "--json")
    found = json.loads(out)
    assert found["stiffness_interval"] is None
    assert all(each["low"] is None and each["high"] is None for each in found["answers"].values())


def test_the_other_filling_is_pressed_under_the_same_loads(holed, invoke, monkeypatch):
    pressed = []
    original = variants.press

    def press(*arguments, **named):
        pressed.append(original(*arguments, **named))
        return pressed[-1]

    monkeypatch.setattr(variants, "press", press)
    code, _, errors = invoke("press", *holed, "--modulus", "100 GPa", "--loads", "3")
    assert code == 0, errors
    first, other = (curve.force.tolist() for curve in pressed)
    assert first == other


@pytest.mark.parametrize("points", [32, 64])
def test_an_interval_holds_the_grids_error_and_the_fillings(holed, invoke):
    code, out, errors = invoke("press", *holed, *PAIR, "--load", "10 N", "--grid-error", "--json")
    assert code == 0, errors
    found = json.loads(out)
    low, high = (end[0] for end in found["stiffness_interval"])
    value, error = found["curve"]["stiffness"][0], found["curve"]["stiffness_error"][0]
    assert error > 1e-3 * value  # 64 points a side leave more open
    assert low <= value / (1 + error / value) * (1 + 1e-12)
    unloading, its_error = (
        found["curve"][name][0] for name in ("unloading_stiffness", "unloading_stiffness_error")
    )
    assert high >= min(value + error, unloading + its_error)  # never above that on unloading


def test_no_interval_is_of_width_nothing(tmp_path, invoke):
    np.save(tmp_path / "flat.npy", np.zeros((64, 64)))  # its area is the same on every grid
    code, out, errors = invoke(
        "press", tmp_path / "flat.npy", unit="m", size="1 mm", modulus="100 GPa", load="1 N"
    )
    assert code == 0, errors
    assert "100% (99.99 to 100%)" in " ".join(out.split())  # not beyond all of it
    half_widths = [float(each) for each in re.findall(r"± (\S+)%", out)]
    assert min(half_widths) >= 0.01


@pytest.mark.parametrize("points", [32, 64])
@pytest.mark.parametrize("arguments", [("--load", "10 N"), ("--loads", "5")])
def test_the_grids_error_is_estimated_unasked_where_it_is_cheap(
    rough, points, invoke, monkeypatch, arguments
):
    for room in (case, grid):
        monkeypatch.setattr(room, "COARSENED_FROM", points)
    code, out, errors = invoke("press", rough, *PAIR, *arguments)
    assert code == 0, errors
    assert INTERVAL.search(out)
    assert "the error of the grid is not known" not in out
    monkeypatch.setattr(case, "_CHEAP", 10)
    code, out, _ = invoke("press", rough, *PAIR, *arguments)
    assert "no intervals, as the error of the grid is not known (--grid-error, twice as" in out
    code, out, _ = invoke("press", rough, *PAIR, *arguments, "--all")
    assert "grid error not estimated" in out
    assert "twice as long; with --grid-error it is estimated" in " ".join(out.split())
    code, out, _ = invoke("press", rough, *PAIR, *arguments, "--grid-error")
    assert "the error of the grid is not known" not in out


def test_few_points_have_no_interval_unasked(tmp_path, invoke):
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(33, 3)
    rl.write(rl.Surface(surface.heights, surface.sizes, "m"), tmp_path / "few.nc")
    code, out, _ = invoke("press", tmp_path / "few.nc", *PAIR, "--load", "10 N", "--all")
    assert code == 0
    assert (
        "fewer than 64 points a side; with --grid-error it is estimated nevertheless"
        in " ".join(out.split())
    )
    code, out, errors = invoke(
        "press", tmp_path / "few.nc", *PAIR, "--load", "10 N", "--grid-error", "--all"
    )
    assert code == 0, errors
    assert INTERVAL.search("\n".join(table_lines(out)))


def test_the_first_screen_is_what_was_asked_and_a_line_for_each_group(rough, invoke, monkeypatch):
    loads = ["--load", "10 N", "--load", "2 N"]
    assert_first_screen(rough, invoke, monkeypatch, loads, ["10 N", "2 N"])


def notes(told):
    """Notes of an answer in JSON, which are no warnings."""
    return [each for each in told["facts"] if each["weight"] == "note"]


@pytest.mark.parametrize("points", [32, 64])
def test_the_first_screen_of_a_whole_curve_has_its_ends(rough, invoke, monkeypatch):
    assert_first_screen(rough, invoke, monkeypatch, ["--loads", "12"], None)


def assert_first_screen(rough, invoke, monkeypatch, loads, shown):
    monkeypatch.setenv("COLUMNS", "200")  # no line is broken
    asked = ("press", rough, *PAIR, *loads, "--no-grid-error")
    code, out, errors = invoke(*asked)
    assert code == 0, errors
    lines = out.splitlines()
    told = json.loads(invoke(*asked, "--json")[1])
    assert lines[3].startswith("Steel on copper under ")
    figures = lines[4 : lines.index("", 4)]
    assert 3 <= len(figures) <= 5
    header = next(i for i, line in enumerate(lines) if line.endswith("  further"))
    first_warning = next(i for i, line in enumerate(lines) if line.startswith("warning: "))
    assert 4 + len(figures) < first_warning < header
    force = told["answers"]["F"]["values"]
    ends = [engineering(each, "N") for each in (force[0], force[-1])]
    assert [" ".join(each.split()) for each in re.split("  +", lines[header].strip(" *"))[:-1]] == [
        *(shown or [f"{ends[0]} *", ends[1]])
    ]
    rows = lines[header + 1 : header + 5]
    names = ["mechanics", "contact", "electrical", "thermal"]
    assert [row.partition(": ")[0] for row in rows] == names
    assert not any(line.startswith(name) for name in names for line in lines[header + 5 :])
    further = len(told["answers"]) - len(rows)
    assert sum(int(row.split()[-1]) for row in rows) == further
    folded = [f"{len(notes(told))} notes", f"{further} further answers"]
    folded += [] if shown else ["10 further loads"]
    assert lines[-1] == f"{listed(folded)}: --all shows them"


@pytest.mark.parametrize("points", [32, 64])
def test_under_one_load_the_large_figures_are_not_repeated_in_a_table(rough, invoke, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    for load in ("10 N", "1 mN"):  # the grid decides the lighter one
        asked = ("press", rough, *PAIR, "--load", load, "--no-grid-error")
        code, out, errors = invoke(*asked)
        assert code == 0, errors
        lines = out.splitlines()
        assert ("fewer than ten points" in lines[3]) == (load == "1 mN")
        assert "\n*" not in out
        figures = lines[4 : lines.index("", 4)]
        for figure in figures:
            name, value = re.split("  +", figure.strip())[:2]
            assert sum(line.strip().startswith(name) and value in line for line in lines) == 1
        told = json.loads(invoke(*asked, "--json")[1])
        further = len(told["answers"]) - len(figures)
        said = f"{len(notes(told))} notes and {further} further answers: --all shows them"
        assert lines[-1] == said


def test_nothing_is_folded_that_is_no_answer(rough, invoke):
    code, out, errors = invoke("press", rough, "--modulus", "1 GPa", "--load", "10 N")
    assert code == 0, errors
    assert "--all" not in out
    assert invoke("press", rough, "--modulus", "1 GPa", "--load", "10 N", "--all")[1] == out


def test_named_loads_have_a_row_each(rough, invoke, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    typed = [f"{i} N" for i in range(2, 8)]
    asked = ("press", rough, *PAIR, *(f"--load={each}" for each in typed), "--no-grid-error")
    code, out, errors = invoke(*asked)
    assert code == 0, errors
    rows = [line for line in out.splitlines() if re.match(r"\d N ", line)]
    assert [" ".join(row.split()[:2]) for row in rows] == typed
    assert all(len(re.split("  +", row)) == 1 + 4 for row in rows)  # a column for each group
    assert out.splitlines()[-1] == "10 notes and 17 further answers: --all shows them"


def test_a_star_stands_at_the_load_that_the_grid_decides(rough, invoke):
    code, out, errors = invoke("press", rough, *PAIR, "--load", "10 N", "--load", "1 mN", "--all")
    assert code == 0, errors
    assert table_lines(out)[0].split() == ["10", "N", "1", "mN", "*"]
    assert "* fewer than ten points in contact" in out


@pytest.mark.parametrize("count", [1, 4, 30])
def test_any_number_of_loads_prints_resistance_and_conductance(
    tmp_path, invoke, monkeypatch, count
):
    monkeypatch.setenv("COLUMNS", "1000")  # all answers beside each other
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(16, 3)
    rl.write(rl.Surface(surface.heights, surface.sizes, "m"), tmp_path / "few.nc")
    typed = [f"{10 + i} N" for i in range(count)]
    question = ("press", tmp_path / "few.nc", *PAIR, *(f"--load={load}" for load in typed))
    code, out, errors = invoke(*question, "--all")
    assert code == 0, errors
    answers = json.loads(invoke(*question, "--json")[1])["answers"]
    for symbol in ("R", "h_c", "G", "k", "k_u", "A/A_0"):
        each = answers[symbol]
        assert out.count(f"{each['name']} {symbol}") == 1
        for value in {each["values"][0], each["values"][-1]}:
            factor, unit = written_scale(value, "%" if symbol == "A/A_0" else each["unit"])
            assert f"{decimal(value * factor, 4)}{unit}" in out, (symbol, value)
    assert answers["R"]["if_elastic"] is not None
    told = out.index("constriction resistance R")
    assert told < out.index("for comparison, if nothing yielded: ")
    if count > 3:
        rows = [line for line in out.splitlines() if re.match(r"\d+ N ", line)]
        assert [" ".join(row.split()[:2]) for row in rows] == typed


@pytest.mark.parametrize("points", [32, 64])
def test_three_loads_with_intervals_fit_80_columns(holed, invoke, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    asked = ("press", *holed, *PAIR, "--grid-error", "--all")
    loads = ("--load", "10 N", "--load", "2 MPa", "--load", "0.1 N")
    code, out, errors = invoke(*asked, *loads)
    assert code == 0, errors
    lines = table_lines(out)
    assert max(map(len, lines)) <= 80
    assert len(lines) - 1 <= 2 * 21  # two lines a quantity at most
    code, out, _ = invoke(*asked, *loads[:2])
    assert len(table_lines(out)) == 1 + 21 + 3  # one load: one line a quantity, and names of groups
    assert (
        sum(line.startswith("for comparison, if nothing yielded: ") for line in out.splitlines())
        == 1
    )
    code, out, _ = invoke(*asked, *loads[:2], "--elastic")
    assert len(table_lines(out)) == 1 + 18 + 3
    assert "if nothing yielded" not in out


@pytest.mark.parametrize(
    ("points", "extent"), [(32, "its page"), (64, "all of it")], indirect=["extent"]
)
def test_thermal_conductances_are_said_to_be_in_vacuum_wherever_they_stand(
    rough, extent, invoke, only_drawn, tmp_path
):
    only_drawn()
    asked = ("press", rough, *PAIR, "--load", "10 N")
    _, screen, _ = invoke(*asked, "--all")
    rows = [line for line in table_lines(screen) if " h_c " in line or " G " in line]
    assert len(rows) == 2
    assert all("in vacuum" in row for row in rows)
    assert "note: thermal conductances are those of the solid spots alone" in screen
    _, out, _ = invoke(*asked, "--json", "--report", tmp_path / "report")
    told = json.loads(out)
    for symbol in ("G", "h_c", "h_Mikic", "h_CMY"):
        assert "as in vacuum: gas in the gap adds to it" in told["answers"][symbol]["validity"]
    assert any("air may carry several times what the spots do" in note for note in told["notes"])
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    lead = re.search('<p class="lead">(.*?)<h2>', page, re.DOTALL)[1]
    assert "thermal conductance per area in vacuum" in lead
    assert "air may carry several times what the spots do" in page


@pytest.mark.parametrize(
    ("points", "extent"), [(32, "its page"), (64, "all of it")], indirect=["extent"]
)
def test_a_report_speaks_to_a_client(holed, points, extent, invoke, only_drawn, tmp_path):
    only_drawn()
    file, *options = holed
    second = "1 N" if points == 64 else "5 N"  # more than ten points in contact
    code, _, errors = invoke(
        "press",
        file,
        *options,
        *PAIR,
        load=["10 N", second, "1 mN"],
        grid_error=True,
        report=tmp_path / "report",
    )
    assert code == 0, errors
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    page = re.sub("<sub>(.*?)</sub>", r"_\1", page)
    assert date.today().isoformat() in page
    assert str(tmp_path) not in page
    assert "roughline press holed.npy --unit m" in page
    assert "periodic=True" not in page
    headings = "".join(f"<th class=.number.>{each}</th>" for each in ("10 N", second, r"1 mN \*"))
    assert re.search(headings, page)
    lead = re.search('<p class="lead">(.*?)<h2>', page, re.DOTALL)[1]
    names = re.findall("<td>([^<]*)</td><td class=.number", page)
    for name in (
        *("contact stiffness", "unloading stiffness", "contact area fraction"),
        "thermal conductance per area",
    ):
        assert name in lead
        assert sum(each.startswith(name) for each in names) == 1
    assert re.search("For comparison, if nothing yielded: .*contact area fraction", lead)
    assert names.count("if nothing yielded") >= 2  # below what yield changes
    items = re.findall("<li>(.*?)</li>", page)
    told = (
        "The interface stiffness k_i is",  # below the answer that it concerns
        "Warning: at forces of",
        "15 missing points",
        "of the contact yields at the largest load: it bears the hardness, 370 MPa",
        "known to a factor of 1.5",
        "Load 10 N",
    )
    assert "<p>A star after a load: fewer than ten points" in page
    order = [next(i for i, item in enumerate(items) if words in item) for words in told]
    assert order == sorted(order)  # gravest first
    assert "all of the load on one plastic spot" in page  # why Holm's resistance differs


def test_what_is_left_out_is_named_with_the_reason(rough, invoke):
    code, out, errors = invoke(
        "press",
        rough,
        materials="E=70 GPa nu=0.33, glass",
        load="1 N",
        frequency="5 MHz",
        json=True,
    )
    assert code == 0, errors
    notes = json.loads(out)["notes"]
    assert (
        "the hardness of the first body (E=70 GPa nu=0.33) is not known; that of the other is "
        "taken as the softer's"
    ) in notes
    for answer, quantity_, lacking in (
        (
            "no constriction resistance",
            "resistivity",
            "the first body (E=70 GPa nu=0.33) and of the second",
        ),
        ("no thermal conductance", "conductivity", "the first body (E=70 GPa nu=0.33)"),
        ("no reflection", "density", "the first body (E=70 GPa nu=0.33)"),
    ):
        (note,) = [note for note in notes if note.startswith(answer)]
        assert f"the {quantity_} of {lacking}" in note
        assert f'"{quantity_}=..."' in note
    code, out, _ = invoke("press", rough, *PAIR, load="1 N", json=True)
    assert not [note for note in json.loads(out)["notes"] if note.startswith("no ")]
    code, out, _ = invoke(
        "press", rough, materials="steel,rigid", load="1 N", frequency="5 MHz", json=True
    )
    notes = json.loads(out)["notes"]
    assert not [note for note in notes if "hardness of the second" in note]  # rigid: needs none
    assert [note for note in notes if note.startswith("no reflection: a rigid")]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--materials", "E=70 GPa nu=0,33, copper", "--load", "1 N"), 'a comma in "0,33"'),
        ((*PAIR, "--load", "1,5 N"), 'a comma in "1,5"'),
        ((*PAIR, "--load", "1 N", "--crop", "0,5 um, 5 um, 0 um, 5 um"), 'a comma in "0,5"'),
    ],
)
def test_a_decimal_comma_is_blamed(rough, invoke, arguments, message):
    code, _, errors = invoke("press", rough, *arguments)
    assert code == 2
    assert message in errors
    assert "numbers take a decimal point" in errors


def test_units_as_they_stand_in_tables(rough, invoke):
    code, out, errors = invoke(
        "press", rough, materials="steel conductivity=20 W/(m K), copper", load="2 N/mm2", json=True
    )
    assert code == 0, errors
    found = json.loads(out)
    assert found["curve"]["force"] == [pytest.approx(2.0)]  # on a square millimetre
    kappa = 2 * 20 * 401 / (20 + 401)
    stiffness = found["curve"]["unloading_stiffness"][0]
    assert found["answers"]["G"]["values"][0] == pytest.approx(
        kappa * stiffness / found["E_star"], rel=1e-12
    )


def test_a_curve_in_a_file_is_shown_and_is_no_topography(tmp_path, invoke, only_drawn, rough):
    """As press wrote it, and as it is read in Python."""
    only_drawn()
    code, _, errors = invoke(
        "press", rough, modulus="110 GPa", load=["1 N", "2 N"], out=tmp_path / "out"
    )
    assert code == 0, errors
    file = tmp_path / "out" / "curve.nc"
    code, out, _ = invoke("info", file)
    assert code == 0
    assert "curve.nc, a curve that roughline wrote" in out
    data = xarray.load_dataset(file, engine="h5netcdf")
    for i, force in enumerate(("1 N", "2 N")):
        (line,) = (each for each in out.splitlines() if each.startswith(force))
        assert engineering(float(data.stiffness[i]), "N/m") in line
    code, out, _ = invoke("info", file, "--json")
    found = json.loads(out)
    assert found["curve"]["stiffness"] == data.stiffness.values.tolist()
    assert found["settings"]["E_star"] == 110e9
    code, _, errors = invoke("press", file, "--modulus", "110 GPa")
    assert code == 2
    assert "curve.nc holds a curve that roughline wrote, and no topography" in errors
    line = rl.SelfAffine(hurst=0.7, length=1.0, rms_height=1.0).line(64, 1)
    rl.press(line, E_star=1.0, depths=[1e-9, 0.1]).write(tmp_path / "of_line.nc")  # without units
    assert "0.1" in invoke("info", tmp_path / "of_line.nc")[1]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--low-pass", "5 mm"), "--low-pass is 5 mm, longer than the topography, 1 mm"),
        (("--low-pass", "0 m"), '--low-pass is "0 m"; a positive, finite length'),
        (("--low-pass", ""), 'is ""'),
        (("--crop", ""), 'is ""'),
        (("--resample", "1000000"), "resampling to 1000000 x 1000000 points needs about"),
        (("--resample", "0"), "--resample is 0; whole numbers of at least 2"),
    ],
)
def test_a_preparation_that_cannot_be_is_refused_in_a_line(rough, invoke, arguments, message):
    for command in (("press", rough, "--modulus", "110 GPa"), ("info", rough)):
        code, out, errors = invoke(*command, *arguments)
        assert (code, out) == (2, "")
        assert message in errors
        assert errors.count("\n") == 1


@pytest.mark.parametrize(
    ("points", "extent"), [(32, "its page"), (64, "all of it")], indirect=["extent"]
)
def test_the_same_is_said_of_a_preparation_wherever_it_is_read(
    rough, points, extent, invoke, only_drawn, tmp_path
):
    only_drawn()
    steps = ("--low-pass", "0.95 mm", "--resample", points)
    said = "most of the roughness is gone, and answers are those of what is left"
    idle = f"esampling to {points} x {points} points changes neither rms height nor rms slope"
    press = ("press", rough, "--materials", "steel,copper", "--load", "1 N", "--no-grid-error")
    code, out, _ = invoke(*press, *steps, "--all", "--report", tmp_path / "report")
    assert code == 0
    _, described, _ = invoke("info", rough, *steps)
    page = (tmp_path / "report" / "report.html").read_text("utf-8")
    for text in (" ".join(out.split()), " ".join(described.split()), page):
        assert said in text
        assert idle in text


@pytest.mark.parametrize("points", [32, 64])
@pytest.mark.parametrize("along", ["x", "y"])
def test_a_strip_is_that_of_the_library(rough, invoke, only_drawn, along, tmp_path):
    only_drawn()
    asked = ("--modulus", "1 GPa", "--load", "0.1 N", "--periodic-along", along)
    code, out, errors = invoke("press", rough, *asked, "--json", "--out", tmp_path / "out")
    assert code == 0, errors
    found = json.loads(out)
    curve = rl.press(rl.read(rough), E_star=1e9, periodic=along, forces=[0.1])
    assert found["settings"]["boundary"] == curve.settings["boundary"] == f"periodic along {along}"
    assert found["curve"]["depth"] == pytest.approx(curve.depth, rel=1e-12)
    assert found["curve"]["stiffness"] == pytest.approx(curve.stiffness, rel=1e-12)
    with xarray.open_dataset(tmp_path / "out" / "curve.nc") as kept:
        assert kept.attrs["boundary"] == f"periodic along {along}"
    _, out, _ = invoke("press", rough, *asked)
    assert f"periodic along {along}" in out


FURTHER = (
    *("--friction", "0.3", "--frequency", "5 MHz", "--joint-area", "1 cm^2", "--sealing-pressure"),
)
"""Asks for answers."""


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (
            (*PAIR, "--load", "1 N", "--periodic-along", "x"),
            "alone; for its curve, give a contact modulus (--modulus) in place of --materials",
        ),
        (  # each says all that has to go, so that none leads to the next
            (*PAIR, "--load", "1 N", "--periodic-along", "x", "--fluid", "water"),
            "(--modulus) in place of --materials and leave --fluid out",
        ),
        (
            ("--modulus", "1 GPa", "--load", "1 N", "--periodic-along", "x", "--fluid", "water"),
            "along x alone; for its curve, leave --fluid out",
        ),
        (
            ("--modulus", "1 GPa", "--load", "1 N", "--periodic-along", "x", *FURTHER),
            "for its curve, leave --joint-area and --friction and --frequency and "
            "--sealing-pressure out",
        ),
        (
            ("--modulus", "1 GPa", "--load", "1 N", "--periodic-along", "z"),
            '--periodic-along is "z"; allowed are "x", "y"',
        ),
    ],
)
def test_strips_without_answers_are_refused_in_one_line(rough, invoke, asked, message):
    code, out, errors = invoke("press", rough, *asked)
    assert (code, out) == (2, "")
    assert message in errors
    assert errors.count("\n") == 1


def test_a_modulus_alone_says_why_there_is_no_pull_off(rough, invoke):
    asked = ("--modulus", "1 GPa", "--load", "0.1 N", "--adhesion", "50 mJ/m^2")
    code, out, errors = invoke("press", rough, *asked)
    assert code == 0, errors
    assert (
        "note: what it takes to draw the bodies apart is one of the answers, which need two "
        "materials (--materials)" in out
    )
    _, out, _ = invoke("press", rough, *asked, "--periodic-along", "x")
    assert "note: what it takes to draw a body apart that is repeated along one side" in out


FLOWS = (*PAIR, "--load", "1 N", "--fluid", "helium", "--seal", "1 mm x 1 mm")


@pytest.mark.parametrize("pressure", ["6 bar", "6 bar abs", "6bara", "6 bar(a)", "600 kPa (abs.)"])
def test_pressures_of_a_fluid_are_repeated_as_absolute_ones(rough, invoke, pressure):
    code, out, errors = invoke("press", rough, *FLOWS, "--inlet", pressure, "--all")
    assert code == 0, errors
    assert "note: helium enters at 600 kPa and leaves at 101.3 kPa, both absolute pressures" in out


@pytest.mark.parametrize("pressure", ["6 barg", "6 bar(g)", "6 bar gauge", "90 psig"])
@pytest.mark.parametrize("option", ["--inlet", "--outlet"])
def test_a_gauge_pressure_is_refused_with_what_to_add(rough, invoke, option, pressure):
    code, _, errors = invoke("press", rough, *FLOWS, option, pressure)
    assert code == 2
    needed = "an absolute pressure is needed: add that of the air, 1.013 bar"
    assert errors == f'roughline: {option} is "{pressure}"; {needed}\n'


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (("--unit", "um"), "states its unit, m; leave --unit um out"),
        (("--fluid", "helium at 150 C"), 'temperature is "150 °C", where the table does not know'),
        (("--fluid", "helium temperature=400 K"), 'temperature is "400 K", where the table'),
    ],
)
def test_values_are_repeated_as_they_were_typed(rough, invoke, asked, message):
    code, _, errors = invoke("press", rough, *PAIR, "--load", "1 N", *asked)
    assert code == 2
    assert message in errors


def test_a_flat_body_is_refused_in_the_words_of_the_command(invoke, tmp_path):
    np.save(tmp_path / "flat.npy", np.zeros((8, 8)))
    asked = ("--unit", "um", "--size", "1 mm", "--modulus", "1 GPa")
    code, _, errors = invoke("press", tmp_path / "flat.npy", *asked)
    assert code == 2
    assert "a flat punch has no range of loads to choose from; give --depth or --load" in errors
