"""What a prompt and a notebook show of the values that people meet."""

import re
from dataclasses import replace
from html.parser import HTMLParser

import matplotlib as mpl
import numpy as np
import pytest

import roughline as rl
from reference import patience
from roughline.engineering.intervals import Intervals
from roughline.report.terminal import print_assessment

CELLS = (
    "import roughline as rl\n"
    "line = rl.SelfAffine(hurst=0.7, length=1.0, rms_height=1.0).line(64, 1)\n"
    "curve = rl.press(line, E_star=1.0, n_loads=3)",
    "rl.plot.topography(line);",
    "from matplotlib import pyplot\npyplot.plot([1, 2]);",
    "rl.plot.curve(curve);",
    "pyplot.ioff()\nrl.plot.curve(curve);",
    "pyplot.plot([1, 2]);",
    "pyplot.close('all')\n%matplotlib inline",
    "rl.plot.spectrum(rl.Line(line.heights, 1.0, kind='profile'));",
    "pyplot.plot([1, 2]);",
)
SPECTRUM = rl.SelfAffine(fractal_dimension=2.2, length=1e-3, rms_height=1e-6)


def cells(html):
    """The cells of each row of a table."""
    rows = re.findall(r"<tr>(.*?)</tr>", html)
    return [re.findall(r"<t[dh]>(.*?)</t[dh]>", row) for row in rows]


def in_si(surface):
    return rl.Surface(surface.heights, surface.sizes, "m")


def test_a_body_is_told_in_a_line():
    surface = SPECTRUM.surface(64, 3)
    assert repr(surface) == "<Surface: 64 × 64 points, 0.001 × 0.001, rms height 1e-06, periodic>"
    assert repr(in_si(surface)) == (
        "<Surface: 64 × 64 points, 1 mm × 1 mm, rms height 1 µm, "
        "periodic (opposite borders are 1.1 ordinary steps apart)>"
    )
    assert repr(surface.cropped((0, 32), (0, 64))).endswith(", cut out of a larger one>")
    line = rl.Line(SPECTRUM.line(256, 1).heights, 1e-3, "m", is_cut_out=False)
    assert repr(line) == "<Line: 256 points, 1 mm, rms height 1 µm, periodic>"


@pytest.mark.parametrize(
    ("loads", "told"),
    [
        ({"forces": [1, 10]}, "<SurfaceCurve: 2 loads, force 1 N to 10 N>"),
        ({"forces": [2]}, "<SurfaceCurve: 1 load, force 2 N to 2 N>"),
        (
            {"forces": [1, 10], "solver": rl.Solver(max_iterations=1), "throw": False},
            "<SurfaceCurve: 2 loads, none solved>",
        ),
    ],
)
def test_a_curve_is_told_in_a_line(loads, told):
    assert repr(rl.press(in_si(SPECTRUM.surface(32, 3)), E_star=1e11, **loads)) == told


def test_no_repr_lists_an_array():
    surface = in_si(SPECTRUM.surface(64, 3))
    compared = rl.compare(SPECTRUM, n=16, surfaces=2)
    parameters = rl.roughness(surface)
    assessed = rl.assess(rl.Question(surface, ("steel", "copper"), loads="1 N"))
    for value in (
        *(compared, compared.full, parameters, parameters.spectrum, parameters.fit, assessed),
        *(rl.trust_map(), rl.profile_spectrum(rl.Line(surface.heights[0], 1e-3, kind="profile"))),
        rl.press(surface, E_star=1e11, forces=[1], fields=True).fields[0],
    ):
        assert "array" not in repr(value)
        assert len(repr(value)) < 700, repr(value)
    assert "force_bar=<15 values>" in repr(compared)


def test_a_notebook_shows_a_body_with_its_picture():
    html = in_si(SPECTRUM.surface(64, 3))._repr_html_()
    assert ["sizes", "1 mm × 1 mm"] in cells(html)
    assert ["rms height", "1 µm"] in cells(html)
    assert 'src="data:image/png;base64,' in html
    assert ["unit of lengths", "not stated"] in cells(SPECTRUM.line(64, 1)._repr_html_())
    HTMLParser().feed(html)


def test_a_notebook_shows_the_loads_of_a_curve():
    surface = in_si(SPECTRUM.surface(32, 3))
    curve = rl.press(surface, E_star=1e11, forces=np.geomspace(0.01, 10, 30))
    header, *rows = cells(curve._repr_html_())
    areas = ["raw area", "corrected area A/A_0"]
    assert header == ["load", "depth d", "force F", "stiffness k", *areas, "remark"]
    for column, area in ((4, curve.area_fraction), (5, curve.area_fraction_corrected)):
        assert float(rows[-1][column]) == pytest.approx(area[-1], rel=1e-3)
    assert area[-1] < curve.area_fraction[-1]
    assert [row[0] for row in rows] == [*map(str, range(12)), "…", *map(str, range(26, 30))]
    assert rows[-1][2] == "10 N"
    assert rows[0][-1] == "the grid decides"
    unsolved = rl.press(
        surface, E_star=1e11, forces=[1], solver=rl.Solver(max_iterations=1), throw=False
    )
    _, row = cells(unsolved._repr_html_())
    assert row == ["0", "–", "–", "–", "–", "–", "max_iterations reached above the tolerance"]


def test_a_notebook_tells_once_that_loads_were_interrupted():
    def stopping(done, total):
        if done == 2:
            raise KeyboardInterrupt

    surface = SPECTRUM.surface(32, 3)
    with pytest.raises(rl.Interrupted) as stopped:
        rl.press(surface, E_star=1.0, n_loads=12, progress=stopping)
    _, *rows = cells(stopped.value.curve._repr_html_())
    assert [row[0] for row in rows] == ["0", "1", "10 of 12"]
    assert rows[-1][-1] == "not solved: interrupted before"


def pictures_below(cells):
    """The number of pictures below each cell of a notebook, which a kernel of its own runs."""
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.v4.new_notebook(cells=[*map(nbformat.v4.new_code_cell, cells)])
    with pytest.MonkeyPatch.context() as environment:
        environment.delenv("MPLBACKEND", raising=False)
        NotebookClient(notebook, kernel_name="python3", timeout=round(patience())).execute()
    return [
        sum("image/png" in output.get("data", {}) for output in cell.outputs)
        for cell in notebook.cells
    ]


def test_every_picture_of_a_notebook_appears_below_its_cell():
    assert pictures_below(CELLS) == [0, 1, 1, 1, 0, 0, 0, 1, 1]


def test_a_picture_leaves_the_settings_of_matplotlib_as_they_were():
    mpl.get_backend()  # chooses one, which is a setting too
    with mpl.rc_context({"font.size": 13, "interactive": False}):
        before = dict(mpl.rcParams)
        rl.plot.topography(SPECTRUM.surface(16, 3), mpl.figure.Figure().subplots())
        assert dict(mpl.rcParams) == before


@pytest.fixture(scope="module")
def assessed():
    surface = in_si(rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(16, rng=1))
    return {
        "of materials": rl.assess(rl.Question(surface, "steel,copper", loads="1 N", elastic=True)),
        "of a modulus": rl.assess(rl.Question(surface, E_star="100 GPa", loads=["1 N", "2 N"])),
    }


@pytest.mark.parametrize("which", ["of materials", "of a modulus"])
def test_an_assessment_prints_what_the_terminal_says(assessed, which, capsys):
    print_assessment(assessed[which])
    assert str(assessed[which]) == capsys.readouterr().out.rstrip()
    assert repr(assessed[which]).startswith("Assessment(")


def test_a_notebook_shows_the_answers_of_an_assessment(assessed):
    html = assessed["of materials"]._repr_html_()
    rows = {row[0]: row[1:] for row in cells(html)}
    assert rows["normal force F"] == ["1 N"]
    assert "contact stiffness k" in rows
    assert 'src="data:image/png;base64,' in html
    assert "warning: grid error not estimated" in html
    header, *rows = cells(assessed["of a modulus"]._repr_html_())
    assert header[:4] == ["load", "depth", "force", "stiffness k"]
    assert [row[2] for row in rows] == ["1 N", "2 N"]


def test_an_assessment_is_a_table_of_pandas(assessed):
    table = assessed["of materials"].to_dataframe()
    answers = assessed["of materials"].answers
    assert table.index.tolist() == ["1 N"]
    assert list(table.columns) == list(answers)
    assert table["contact_stiffness"].tolist() == answers["contact_stiffness"].values.tolist()
    assert table.attrs["units"]["contact_stiffness"] == "N/m"
    found = assessed["of a modulus"]
    known = replace(found, intervals=Intervals(*[(np.ones(2), np.full(2, 3.0))] * 2))
    table = known.to_dataframe()
    assert table.columns[2:5].tolist() == ["stiffness", "stiffness_low", "stiffness_high"]
    assert table["stiffness_high"].tolist() == [3.0, 3.0]
    assert table["force"].tolist() == pytest.approx([1.0, 2.0])


def test_a_notebook_shows_flows_fields_searches_and_creep():
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0)
    surface = spectrum.surface(16, rng=7)
    curve = rl.press(surface, E_star=1.0, forces=[0.01], periodic=True, fields=True)
    creep = rl.press_creep(
        spectrum.line(64, rng=1),
        rl.Creep([0.5], [1.0]),
        times=[0.1, 1.0],
        force=1e-3,
        half_space=rl.Homogeneous(1.0),
    )
    flow = rl.flow(curve.fields[0])
    for value, named, number in (
        (flow, "hydraulic aperture u_h", flow.hydraulic_aperture),
        (curve.fields[0], "mean pressure", 0.01),
        (rl.sealing_pressure(surface, half_space=curve.half_space, interval=False), "found", None),
        (rl.reopening(curve, times=1.5), "found", None),
        (creep, "0.1", creep.depth[0]),
    ):
        html = value._repr_html_()
        HTMLParser().feed(html)
        assert 'src="data:image/png;base64,' in html
        shown = {row[0]: row[1:] for row in cells(html) if row}[named]
        assert number is None or float(shown[0]) == pytest.approx(number, rel=1e-3)
