"""Pages of measurements are those of their benchmarks, and of the present code where it decides.

Times are never held. Counts, contacts, estimates and cases depend on the code alone, so that a
table which was not measured again after they changed fails here.
"""

import csv
import importlib
import json
import re
from pathlib import Path

import numpy as np
import pytest

import roughline as rl
from random_problems import random_problem
from roughline.contact.estimates import bytes_at_a_point, expected_area_fraction
from roughline.contact.loads import Loads
from studies.averaging.measure import HELD_AT_LEVEL

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
WRITTEN = [
    (page, *found)
    for page in sorted(DOCS.glob("*.md"))
    for found in re.findall(
        r"<!-- ([\w-]+): `make ([\w-]+)` writes this -->", page.read_text("utf-8")
    )
]
NUMBER = re.compile(r"[\d.]+(?:e[+-]?\d+)?")
MAKEFILE = (ROOT / "Makefile").read_text("utf-8")


def rows_of(part, section=""):
    """The rows of a table as dictionaries."""
    name = re.sub(r"[^a-z0-9]+", "-", section.lower()).strip("-")
    with (DOCS / "data" / part / name).with_suffix(".csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def said_on(page):
    """The words of a page, each a space apart."""
    return " ".join((DOCS / f"{page}.md").read_text("utf-8").split())


def number(text):
    """The first number in a cell; a share where it is a percentage."""
    found = re.search(r"[\d.]+", text)[0]
    return float(found) / (100 if f"{found}%" in text else 1)


def ohms(text):
    """The resistance in a cell. [ohm]"""
    value, unit = text.split()[:2]
    return float(value) * {"Ω": 1.0, "mΩ": 1e-3}[unit]


def surface_of(row):
    n = int(row["grid"].removesuffix("²"))
    return rl.SelfAffine(hurst=float(row.get("H", 0.8)), rms_height=1.0).surface(n, 7)


@pytest.mark.parametrize(
    ("page", "part", "target"), WRITTEN, ids=lambda each: getattr(each, "name", each)
)
def test_a_part_names_the_command_that_writes_it(page, part, target):
    written = page.read_text("utf-8").partition(f"<!-- {part}: ")[2]
    written = written.partition(f"<!-- end of {part} -->")[0]
    assert f"\n\nWritten by `make {target}`: roughline" in written
    recipe = MAKEFILE.partition(f"\n{target}: ")[2].partition("\n\n")[0]
    (program,) = re.findall(r"benchmarks/\w+\.py", recipe)
    text = (ROOT / program).read_text("utf-8")
    assert f'"{part}"' in text
    assert f'"{page.name}"' in text or "peer_table" in text


def test_every_file_of_data_is_linked():
    linked = {
        (page.parent / link).resolve()
        for page in DOCS.rglob("*.md")
        for link in re.findall(r"\]\(([^)\s]+\.csv)\)", page.read_text("utf-8"))
    }
    assert set((DOCS / "data").rglob("*.csv")) <= linked


def test_random_problems_are_those_of_the_table():
    rows = {row["bodies"]: row for row in rows_of("robustness")}
    problems = [random_problem(np.random.default_rng([0, i])) for i in range(3000)]
    for kind in {problem.kind for problem in problems}:
        loads = [len(next(iter(each.loads.values()))) for each in problems if each.kind == kind]
        assert (int(rows[kind]["problems"]), int(rows[kind]["loads"])) == (len(loads), sum(loads))
    for row in rows.values():
        assert (row["certified"], row["refused"]) == (row["problems"], "0")


def test_kills_add_up():
    kills = sum(int(row["times"]) for row in rows_of("soak"))
    assert f"Of seed 1: {kills} kills in " in said_on("measured")


def test_the_lab_is_measured_as_its_benchmark_does():
    program = (ROOT / "benchmarks" / "lab_moves.py").read_text("utf-8")
    for row in rows_of("lab"):
        assert f'"{row["from, to"]}"' in program


@pytest.mark.parametrize("hurst", ["0.2", "0.5", "0.8"])
def test_paths_of_loads_are_those_of_the_table(hurst):
    rows = rows_of("speed", "Full model: 20 loads from first touch to saturation")
    (row,) = (each for each in rows if (each["grid"], each["H"]) == ("512²", hurst))
    curve = rl.press(surface_of(row), E_star=1.0, n_loads=20)
    assert curve.stiffness_bar[-1] == pytest.approx(number(row["last k"]), abs=0.005)
    assert curve.convolutions.mean() == pytest.approx(number(row["own convolutions"]), abs=1)


@pytest.mark.parametrize("hurst", ["0.2", "0.8"])
def test_contacts_beside_other_programs_are_those_of_the_table(hurst):
    rows = rows_of("peers", "Contact areas of these loads")
    rows = [row for row in rows if (row["grid"], row["H"]) == ("512²", hurst)]
    forces = [float(row["F̄"]) for row in rows]
    curve = rl.press(surface_of(rows[0]), E_star=1.0, forces=forces)
    found = [number(row["roughline"]) for row in rows]
    assert len(found) == 4
    assert curve.area_fraction == pytest.approx(found, abs=6e-7)


@pytest.mark.parametrize("grid", ["64²", "128²", "256²"])
def test_contacts_on_small_grids_beside_other_programs_are_those_of_the_table(grid):
    rows = rows_of("small-peers", "Contact areas of these loads on small grids")
    rows = [row for row in rows if row["grid"] == grid]
    forces = [float(row["F̄"]) for row in rows]
    curve = rl.press(surface_of(rows[0]), E_star=1.0, forces=forces)
    found = [number(row["roughline"]) for row in rows]
    assert len(found) == 5
    assert curve.area_fraction == pytest.approx(found, abs=6e-7)


def test_memory_is_estimated_as_the_table_says():
    rows = [row for row in rows_of("memory") if row["grid"] == "1024²"]
    surface = surface_of(rows[0])
    for row in rows:
        periodic, forces = row["half-space"] == "periodic", json.loads(f"[{row['F̄']}]")
        loads = Loads("forces", np.array(forces))
        share = expected_area_fraction(
            surface, rl.Homogeneous(1.0, periodic), loads, rl.Unilateral()
        )
        several = len(forces) > 1
        held = bytes_at_a_point(surface.shape, periodic, share, yielding=False, several=several)
        assert round(held) + 8 == int(row["estimated"])
        told = rl.estimate(surface.shape, len(forces), periodic=periodic, area_fraction=share)
        assert told.memory > 1e9 * float(row["peak"].removesuffix(" GB"))
    assert len(rows) == 12


@pytest.mark.parametrize("hurst", ["0.2", "0.8"])
def test_what_yields_is_what_the_table_says(hurst):
    rows = rows_of("yielding", "Time, the best of 5")
    case = ("one load", "512²", hurst)
    (row,) = (each for each in rows if (each["loads"], each["grid"], each["H"]) == case)
    surface = surface_of(row)
    elastic = rl.press(surface, E_star=1.0, forces=[0.4])
    hardness = elastic.force[0] / (elastic.area_fraction[0] * surface.area) / 3
    curve = rl.press(surface, E_star=1.0, forces=[0.4], hardness=hardness)
    assert curve.plastic_fraction[0] == pytest.approx(
        number(row["of the contact yields"]), abs=0.006
    )


@pytest.mark.parametrize("loads", [1, 3])
def test_measured_maps_yield_as_the_table_says(topographies, monkeypatch, loads):
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    import yield_of_maps

    told = [list(row.values()) for row in rows_of("yield-of-maps")]
    assert len(told) == sum(len(loads) for _, _, loads in yield_of_maps.CASES)
    case = ("al3d-1.al3d", "steel,steel", ("1 MPa", "10 MPa", "100 MPa"))
    assert case in yield_of_maps.CASES
    found = list(yield_of_maps.rows(topographies, *case[:2], case[2][:loads]))
    told = [row for row in told if row[0].startswith(case[0])][:loads]
    for row, again in zip(told, found, strict=True):
        assert row[:3] == again[:3]
        for cell, other in zip(row[3:], again[3:], strict=True):
            numbers, others = (list(map(float, NUMBER.findall(each))) for each in (cell, other))
            assert numbers == pytest.approx(others, rel=0.02)


def test_the_page_of_engineering_quotes_the_maps():
    page = said_on("engineering")
    told = {
        "10 MPa on al3d-1 the elastic area is {:.1f} times too small and the elastic resistance "
        "{:.1f} times too large": ("al3d-1.al3d", "10 MPa"),
        "they are off by factors of {:.0f} and {:.0f}": ("di-1.di", "1 uN"),
    }
    for sentence, (name, load) in told.items():
        (row,) = (
            each
            for each in rows_of("yield-of-maps")
            if each["map, rms slope"].startswith(name) and each["load"] == load
        )
        area = number(row["$A/A_0$ with yield"]) / number(row["$A/A_0$ elastic"])
        resistance = ohms(row["$R$ elastic"]) / ohms(row["$R$ with yield"])
        assert sentence.format(area, resistance) in page


def test_the_page_of_speed_quotes_its_tables():
    page = said_on("measured")
    paths = rows_of("speed", "Full model: 20 loads from first touch to saturation")
    times = [number(row["per load"]) for row in paths if row["grid"] == "2048²"]
    span = f"{min(times):.1f} to {max(times):.1f} s a load"
    assert span in page.replace("**", "")
    assert span in " ".join((ROOT / "README.md").read_text("utf-8").split())
    (plain,) = (row for row in rows_of("speed", "One convolution") if row["grid"] == "2048²")
    cold_ones = rows_of("speed", "Full model: one cold load, H = 0.8")
    (cold,) = (row for row in cold_ones if row["grid"] == "2048²")
    assert f"a plain convolution takes {number(plain['plain, zero-padded']) / 1e3:.2f} s" in page
    told = f"{100 * number(cold['contact']):.0f} % contact takes {number(cold['time']):.1f} s"
    assert f"a cold load at {told}" in page
    cold = rows_of("peers", "One cold load")
    ratios = [number(row["over roughline (ASPHER)"]) for row in cold]
    contact = [number(row["contact"]) for row in cold]
    assert len(ratios) == len(contact) == 24
    heavy = [ratio for ratio, share in zip(ratios, contact, strict=True) if share > 0.06]
    assert f"takes {min(heavy):.1f} to {max(heavy):.0f} times as long" in page
    lightest = [ratio for ratio, row in zip(ratios, cold, strict=True) if row["F̄"] == "0.03"]
    assert f"it takes {min(lightest):.1f} to {max(lightest):.1f} times as long" in page
    assert f"at {sum(ratio > 1 for ratio in ratios)} of the 24 cold loads" in page
    of_paths = rows_of("peers", "A path of loads from first touch to saturation")
    cold = [number(row["cold over roughline"]) for row in of_paths]
    assert f"ASPHER's cold loads take {min(cold):.1f} to {max(cold):.1f} times as long" in page
    warm = {n: [] for n in ("512²", "1024²", "2048²")}
    for row in of_paths:
        warm[row["grid"]].append(number(row["warm over roughline"]))
    coarse, fine = warm["512²"], min(warm["2048²"])
    said = f"{min(coarse):.1f} to {max(coarse):.1f} times at 512², {fine:.0f} times and more at"
    assert f"its warm ones {said} 2048²" in page
    made = re.search(r"`make peers`: (roughline [\d.]+), (ASPHER [\w.]+),", page)
    ours, theirs = made.groups()
    assert f"These rows are of {ours} and {theirs};" in page


def test_the_page_of_friction_quotes_what_it_costs():
    page, rows = said_on("how-to/friction"), rows_of("friction-speed")

    def spans(kind, of):
        of_kind = [row for row in rows if row["grid"] == "512²" and row["bodies"] == kind]
        return [float(row[of]) for row in of_kind if "cycle" not in row["load"]]

    one, two = (spans(kind, "over a normal load") for kind in ("uncoupled", "coupled"))
    assert f"takes {min(one):.1f} to {max(one):.1f} times as long as without friction" in page
    assert f"one of two materials {min(two):.0f} to {max(two):.0f} times" in page
    most = [max(spans(kind, "both tangents")) for kind in ("uncoupled", "coupled")]
    assert f"adds up to {most[0]:.1f} and {most[1]:.0f} times as long" in page


@pytest.fixture
def permeance(monkeypatch):
    """The benchmark."""
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    return importlib.import_module("permeance")


@pytest.mark.parametrize("grids", [(32,), (64, 128)])
def test_permeances_are_those_of_the_table(permeance, grids):
    rows = rows_of("permeance", "Beside exact values")
    for radius, row in zip(permeance.RADII, rows, strict=False):
        found = [permeance.disc(n, radius) for n in grids]
        told = [float(row[f"{n}²"]) for n in grids]
        assert found == pytest.approx(told, rel=0.06)


@pytest.mark.parametrize("shape", [(5, 4), (9, 8)])
def test_near_sealing_what_flows_is_exact(permeance, shape):
    """To the rounding of the table, whose gaps have 9 x 8 cells."""
    for throat, row in zip(permeance.THROATS, rows_of("permeance", "Near sealing"), strict=True):
        gap = permeance.throttled(throat, shape)
        exact = float(permeance.in_fractions(gap))
        flow = rl.flow(gap, tuple(map(float, shape)), sides="y")
        assert flow.inflow == pytest.approx(exact, rel=2e-15)
        assert float(row["roughline"]) < 2e-15


def test_the_page_of_the_flow_quotes_its_table():
    page = said_on("flow")
    exact = {row["gap"]: row["128²"] for row in rows_of("permeance", "Beside exact values")}
    wedge, dual = float(exact["wedge"]), float(exact["dual of a rough gap"])
    disc = abs(float(exact["disc of contact, R = 0.2 of the cell"]))
    assert f"a wedge is off by {wedge:.0e} on 128²".replace("e-05", "e-5") in page
    assert f"by {abs(dual):.0e}".replace("e-03", "e-3") in page
    assert f"off by {100 * disc:.1f} % on 128²" in page
    grid = rows_of("permeance", "The grid")
    short = [100 * (1 - number(row["4 cells"])) for row in grid[:3]]
    assert f"aperture {min(short):.0f} to {max(short):.0f} % too small" in page
    cubed = [100 * (1 - number(row["4 cells"]) ** 3) for row in grid[:3]]
    assert f"its cube, {min(cubed):.0f} to {max(cubed):.0f} %" in page
    places = rows_of("permeance", "One map is one place")
    quarter = [row for row in places if row["p/(E*∇h)"] == "0.12"]
    factors = [float(row["factor of the flow"]) for row in quarter]
    assert f"a factor of {factors[0]:.0f} of their middle" in page
    assert f"of {factors[1]:.1f} with four, and of {factors[2]:.0f} with eight" in page
    closed = [number(row["closed sides over periodic"]) for row in quarter]
    assert max(abs(each - 1) for each in closed) < 0.0105
    assert "in the middle, within 1 % of that of the cell up to a quarter in contact" in page
    gas, _ = rows_of("permeance", "A rare gas")
    near, one, two, rare = (float(gas[path]) for path in ("0.1", "1", "2", "20"))
    assert f"{near:.1f} times as much through" in page
    assert f"{one:.1f} times at 1, {two:.1f} times at 2 and {rare:.1f} times at 20" in page


@pytest.mark.parametrize(
    ("part", "section", "quantities", "counted"),
    [
        (
            "leak-coverage",
            "What flows through a part, from one map",
            ("hydraulic_aperture_x", "hydraulic_aperture_y", "mean_gap"),
            "answers from one map",
        ),
        ("seal-coverage", "The seal behind one map", ("p_s",), "parts"),
    ],
)
def test_the_page_of_the_counts_says_how_often_intervals_of_flow_and_seal_hold(
    part, section, quantities, counted
):
    rows = [row for row in rows_of(part, section) if row["quantity"] in quantities]
    rows = [row for row in rows if NUMBER.search(row["held"])]  # a dash where all are silent
    of_all = [row for row in rows if row["surfaces"] == "all"]
    held = sorted({f"{100 * number(row['held']):.0f}" for row in of_all})
    short = {row["surfaces"] for row in rows if number(row["held"]) < 0.9}
    begins = f"| {int(of_all[0]['intervals']):,} {counted} | {' to '.join(held)} % | "
    told = said_on("intervals_hold").partition(begins)[2].partition(" |")[0]
    assert {each.replace("two maps long", "of 2 maps") for each in told.split(", ")} == short


def test_promises_are_kept_in_the_table_and_by_the_present_code(monkeypatch):
    """Of all studies as the table says; kappa of few surfaces is counted again."""
    rows = rows_of("coverage")
    assert len({row["study"] for row in rows}) == 12
    for row in rows:
        ends = [float(each) for each in NUMBER.findall(row["promised"])]
        assert ends[0] <= float(row["held"].rstrip("%")) <= (*ends, 100.0)[1], row
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    found = importlib.import_module("trials_of_laws").KAPPA
    counted = [row for seed in range(200) for row in found.rows_of("curves", "20", seed)]
    for row in rows:
        if (row["study"], row["bodies"]) == (found.heading, "20"):
            some = [each for each in counted if each["quantity"] == row["quantity"]]
            held = np.mean([each["low"] <= each["truth"] <= each["high"] for each in some])
            assert (f"{len(some)}", f"{held:.1%}") == (row["intervals"], row["held"])


def test_the_page_of_averages_quotes_how_often_intervals_at_fixed_level_hold():
    rows = [row for row in rows_of("coverage") if row["study"] == "Exponents of means"]
    held = {row["bodies"]: number(row["held"]) for row in rows}
    assert pytest.approx(HELD_AT_LEVEL, abs=0.03) == held["level"]
    page = said_on("averaging")
    assert f"contain a known exponent in {HELD_AT_LEVEL:.0%} of samples of 40 bodies" in page


def test_the_page_of_the_counts_begins_with_what_they_found():
    page = said_on("intervals_hold")
    grid = {
        number(row["held"]) for row in rows_of("intervals", "The grid") if row["surfaces"] == "all"
    }
    assert f"| {100 * min(grid):.0f} to {100 * max(grid):.0f} % | no kind |" in page
    sections = ("The larger surface behind one map", "A line scan")
    for section in sections:
        row = next(each for each in rows_of("intervals", section) if each["surfaces"] == "all")
        assert f"{int(row['intervals']):,} " in page
        assert f"| {row['held'].replace('%', ' %')}" in page
