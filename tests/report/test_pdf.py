"""The PDF can be printed: nothing is small, and nothing runs off the sheet."""

import base64
import re
import zlib
from io import BytesIO

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text
from reportlab.lib.pagesizes import A4

import roughline as rl
from roughline.plot.style import PAGE, styled
from roughline.report import part_report
from roughline.report.contact_figures import overview
from roughline.report.contact_report import write_contact_report
from roughline.report.page import Headline, KeyFigure, Picture, Section, Table
from roughline.report.part_report import answers_figure, heights_figure
from roughline.report.pdf import _grids, _register_fonts, write_pdf

SMALLEST = 9.0  # of a text on paper [points]
INDEX = 7.0  # of what is set low or high beside a letter [points]
SMALLEST_IN_FIGURES = 8.0
PADDING = 4.0
STREAM = re.compile(rb"<<([^>]*)>>\s*stream\r?\n(.*?)endstream", re.DOTALL)
TOKEN = re.compile(r"\((?:\\.|[^()\\])*\)|\[[^\]]*\]|/\S+|[^\s()\[\]]+")


def sheets(path):
    """Texts of each sheet as (size, x, y), and widths of its pictures, in points."""
    found = []
    for header, data in STREAM.findall(path.read_bytes()):
        if b"ASCII85" not in header or b"/Subtype" in header:
            continue
        content = zlib.decompress(base64.a85decode(data.strip().removesuffix(b"~>")))
        if b" Tf" in content:
            found.append(drawn(content.decode("latin-1")))
    return found


def drawn(content):
    """Follow the operators of a sheet that move, and those that draw."""
    texts, pictures, stack, operands = [], [], [], []
    place, scale, size, at = np.zeros(2), 1.0, 0.0, np.zeros(2)
    for token in TOKEN.findall(content):
        if token == "q":
            stack.append((place, scale))
        elif token == "Q":
            place, scale = stack.pop()
        elif token == "cm":
            a, _, _, _, x, y = map(float, operands[-6:])
            place, scale = place + scale * np.array([x, y]), scale * a
        elif token == "Tm":
            at = np.array([*map(float, operands[-2:])])
        elif token == "Tf":
            size = float(operands[-1])
        elif token in ("Tj", "TJ"):
            texts.append((size * scale, *(place + scale * at)))
        elif token == "Do":
            pictures.append(scale)
        else:
            operands.append(token)
            continue
        operands = []
    return texts, pictures


def check(path):
    """Hold every sheet of a document to what can be read and printed."""
    found = sheets(path)
    assert found
    for texts, pictures in found:
        sizes, x, y = np.array(texts).T
        assert sizes[sizes != INDEX].min() >= SMALLEST
        assert x.min() > 30
        assert x.max() < A4[0] - 30
        assert y.min() > 15
        assert y.max() < A4[1] - 30
        for width in pictures:
            assert width * SMALLEST_IN_FIGURES / (72 * PAGE) >= 0.99 * SMALLEST_IN_FIGURES
    return len(found)


def texts_of(figure):
    return [each for each in figure.findobj(Text) if each.get_text().strip()]


LONG = "a_name_of_a_file_" * 8 + ".x3p"
CELL = "0.01 mm² (0.0191 to 0.0463)"


@pytest.mark.parametrize("loads", [1, 12, 30])
def test_tables_of_any_width_fit_the_sheet_and_no_number_is_broken(tmp_path, loads):
    header = ["", *(f"{i}.25 MPa *" for i in range(loads))]
    rows = [[f"yielded share of the contact A_p/A {i}", *[CELL] * loads] for i in range(70)]
    table = Table(header, rows, numbers=range(1, len(header)))
    words = Table(["map", "why"], [[LONG, "it is refused " * 40], [LONG, LONG]])
    sections = [Section("Answers", [LONG * 3], notes=[LONG], tables=[table, words])]
    headline = Headline([KeyFigure.of("resistance", CELL)] * 5, [f"Not sure. {LONG}"] * 3)
    write_pdf(tmp_path / "report.pdf", f"Contact of {LONG}", "", sections, "", headline)
    assert check(tmp_path / "report.pdf") > 2
    width = A4[0] - 76
    shown = 0
    for grid in (*_grids(table, width), *_grids(words, width)):
        assert sum(grid._colWidths) <= width + 1e-6
        for row in grid._cellvalues:
            for cell, column in zip(row, grid._colWidths, strict=True):
                cell.wrap(column - 2 * PADDING, 1e4)
                for line in cell.blPara.lines:
                    spare = line[0] if isinstance(line, tuple) else line.extraSpace
                    assert spare >= -PADDING  # of the cell, where nothing else stands
        if grid._cellvalues[0][-1].text.endswith("*"):
            shown += len(grid._cellvalues[0]) - 1
            assert grid.repeatRows == 1
            for line in grid._cellvalues[1][1].blPara.lines:
                assert " ".join(line[1]).replace("\u00a0", " ") in CELL
    assert shown == loads


@pytest.mark.parametrize("rows", [31, 34, 36, 40])
def test_no_last_sheet_holds_a_line_alone(tmp_path, rows):
    table = Table(["", "2 MPa"], [[f"answer {i}", "1 MPa"] for i in range(rows)])
    words = [Section("Assumptions", ["small slopes " * 40]), Section("Again", ["press map.nc"])]
    write_pdf(tmp_path / "report.pdf", "Contact", "", [Section("Answers", tables=[table]), *words])
    texts, _ = sheets(tmp_path / "report.pdf")[-1]
    assert len(texts) >= 8  # two headings, what stands below them, and the foot


@pytest.mark.parametrize("rows", [1, 2, 3, 12])
def test_no_sheet_holds_a_row_or_two_of_a_longer_table(rows):
    _register_fonts()
    cells = [[f"answer {i}", "1 MPa"] for i in range(rows)]
    (grid,) = _grids(Table(["", "2 MPa"], cells), 500.0)
    _, whole = grid.wrap(500.0, 1e4)
    for height in np.linspace(20.0, whole, 60):
        parts = grid.split(500.0, height)
        for part in parts:
            assert len(part._cellvalues) - 1 >= min(3, rows)
        shown = sum(len(part._cellvalues) - 1 for part in parts)
        assert shown in (0, rows)  # nothing fits, or all of it is there


@pytest.mark.parametrize(
    "asked", [{"ask": rl.Joint("2 cm^2")}, {"ask": rl.Friction(0.3), "unload": True}]
)
def test_a_report_can_be_printed(rough, loads_of_curve, tmp_path, only_drawn, asked):
    only_drawn()
    loads = ["1 N", "2 N", "5 N", "10 N"]
    question = rl.Question(
        rough, "steel,copper", loads=loads, grid_error=False, whole_curve=True, **asked
    )
    pressed = rl.assess(question)
    write_contact_report(pressed, tmp_path, "roughline press " + LONG)
    assert check(tmp_path / "report.pdf") >= 3
    with styled():
        figure = overview(pressed)
        if loads_of_curve == "few loads":
            figure.set_layout_engine("none")  # which moves texts, and leaves their sizes
        figure.savefig(BytesIO())
    assert min(each.get_fontsize() for each in texts_of(figure)) >= SMALLEST_IN_FIGURES
    assert figure.get_figheight() * 72 <= 600


@pytest.mark.parametrize(("points", "loads"), [(16, ["1 N", "5 N"]), (32, ["1 N", "2 N", "5 N"])])
def test_a_report_on_several_maps_can_be_printed(tmp_path, only_drawn, monkeypatch, points, loads):
    only_drawn()
    monkeypatch.setattr(part_report, "write_contact_report", lambda _, folder, __: [folder])
    spectrum = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6)
    maps = [spectrum.surface(points, seed) for seed in range(3)]
    maps = [rl.Surface(each.heights, each.sizes, "m") for each in maps]
    part = rl.assess(rl.Question(maps, "steel,copper", loads=loads))
    part.names[0] = r"a $\none$.npy"  # no formula
    part_report.write_part_report(part, tmp_path, "roughline press " + LONG)
    assert check(tmp_path / "report.pdf") >= 3
    for draw in (answers_figure, heights_figure):
        with styled():
            figure = draw(part)
            assert isinstance(figure, Figure)
            if points == 16:
                figure.set_layout_engine("none")
            figure.savefig(BytesIO())
        assert min(each.get_fontsize() for each in texts_of(figure)) >= SMALLEST_IN_FIGURES


def test_a_picture_keeps_its_size(tmp_path):
    with styled():
        figure = Figure(figsize=(PAGE, 3))
        figure.subplots().set_xlabel("force")
        figure.savefig(tmp_path / "figure.png", dpi=50)
    picture = Picture(tmp_path / "figure.png", "Overview", "All.")
    write_pdf(tmp_path / "report.pdf", "Contact", "", [Section("Surface", pictures=[picture])])
    check(tmp_path / "report.pdf")
