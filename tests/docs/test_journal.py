"""The paper for a journal: its numbers are those of the handbook, its sources are cited."""

import csv
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAPER = (ROOT / "paper" / "paper.md").read_text("utf-8").partition("\n---\n")[2]
WORDS = " ".join(PAPER.split())


def rows_of(name):
    with (ROOT / "docs" / "data" / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(re.search(r"[\d.]+", text)[0])


def ratios(name):
    return [number(row["over roughline (ASPHER)"]) for row in rows_of(name)]


def told_by_tables():
    """What the paper says with a number, as the tables have it."""
    large, small = (
        ratios("peers/one-cold-load"),
        ratios("small-peers/one-cold-load-on-a-small-grid"),
    )
    yield f"took {min(large):.1f} to {max(large):.0f} times as long as `roughline`"
    yield "for a cold load on grids of 512² to 2048²"
    slower = sum(each < 1 for each in small)
    yield f"of 64² to 256² `roughline` was the slower one in {slower} of {len(small)} loads"
    path = rows_of("speed/full-model-20-loads-from-first-touch-to-saturation")
    times = [number(row["per load"]) for row in path if row["grid"] == "2048²"]
    yield "On the grid of 2048² points a path of 20 loads"
    yield f"took {min(times):.1f} to {max(times):.1f} s a load on two cores"
    whole = next(row for row in rows_of("robustness") if row["bodies"] == "all")
    assert (whole["problems"], whole["refused"]) == (whole["certified"], "0")
    yield f"Of {whole['problems']} random problems"
    yield f"with {whole['loads']} loads, all were certified"
    grid = next(row for row in rows_of("intervals/the-grid") if row["surfaces"] == "all")
    yield f"of {grid['intervals']} intervals of the grid {grid['held'].replace('%', ' %')} hold"
    place = rows_of("intervals/the-larger-surface-behind-one-map")[0]
    yield f"of {place['intervals']} intervals of one map {place['held'].replace('%', ' %')} hold"
    yield f"the answer says so ({place['silent'].replace('%', ' %')} of these)"
    throats = rows_of("permeance/near-sealing")
    least = min(float(row["gap of the throat"]) for row in throats)
    yield f"down to {least:.0e}".replace("e-08", "e-8") + " of the gap beside them"
    assert max(float(row["roughline"]) for row in throats) < 2e-15
    assert max(float(row["SuperLU, inlet"]) for row in throats) > 1
    yield "the flow is exact to 2e-15"


def told_by_pages():
    """What it says with a number, and the sentence of a page that it is from."""
    yield "60 surfaces and 500 lines", "paper", "the mean of 500 lines"
    yield "for each of six", "paper", "| full | 6, from 2 to 3 | 60 | 2048 × 2048 |"
    yield "of the full model, 0.520 to 0.780", "paper", "surfaces is α = 0.520"
    yield (
        "for $D_f$ from 2 to 3",
        "paper",
        "at D_f = 2.0 and 0.780 (95 %: 0.768 to 0.790) at D_f = 3.0",
    )
    yield "reach 0.908 and refute it at $D_f = 3$", "paper", "and 0.908 (95 %: 0.906 to 0.909) at"
    yield "a ball agrees to 6e-9", "how-to/friction", "by another program | 6e-9, all its digits"
    yield "A study of 855 rough bodies", "friction", "Of 855 bodies 0 had a load that was not"
    yield (
        "is off Jäger's by -0.3 to -0.0 % in the mean at a Poisson's ratio of 0.3",
        "friction",
        "their micro-slip is off it by -0.3% to -0.0% at ν = 0.3",
    )
    yield (
        "it is 8 % larger at 0.8 of the largest shear",
        "friction",
        "at 0.8 μF bodies have slid 8% further than Jäger says at μ/β = 1.05",
    )
    yield "where friction is 1.05 times Dundurs' constant", "friction", "says at μ/β = 1.05"
    yield "Intervals promise 95 %", "check_us", "hold the true value in 95 of 100 cases"
    yield "written in Python (3.11 or newer)", "start", "Python 3.11"


def test_every_number_of_the_paper_is_that_of_a_table_or_of_a_page():
    left = re.sub(r"\[?@\w+;?\]?|\(\w+\.png\)|BSD-3-Clause|K_\{CC\}\\,q = 1", "", WORDS)
    for sentence in told_by_tables():
        assert sentence in WORDS
        left = left.replace(sentence, "")
    for sentence, page, source in told_by_pages():
        assert sentence in WORDS
        assert source in " ".join((ROOT / "docs" / f"{page}.md").read_text("utf-8").split())
        left = left.replace(sentence, "")
    assert re.findall(r"[^ ]*\d[^ ]*", left) == []


def test_what_is_cited_stands_in_the_list_and_the_other_way_round():
    listed = set(
        re.findall(r"^@\w+\{(\w+),", (ROOT / "paper" / "paper.bib").read_text("utf-8"), re.M)
    )
    assert set(re.findall(r"@(\w+)", PAPER)) == listed
    assert len(listed) > 9


def test_its_figures_are_those_of_one_command():
    figures = re.findall(r"\]\((\w+)\.png\)", PAPER)
    program = (ROOT / "paper" / "draw.py").read_text("utf-8")
    assert len(figures) == 2
    for name in figures:
        assert (ROOT / "paper" / f"{name}.png").is_file()
        assert f'{name}().savefig(FOLDER / "{name}.png"' in program
    assert "paper/draw.py" in (ROOT / "Makefile").read_text("utf-8")
