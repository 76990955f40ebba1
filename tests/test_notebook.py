"""What a prompt and a notebook show of the values that people meet."""

import re
from html.parser import HTMLParser

import numpy as np
import pytest

import roughline as rl

SPECTRUM = rl.SelfAffine(fractal_dimension=2.2, length=1e-3, rms_height=1e-6)


def cells(html):
    """The cells of each row of a table."""
    rows = re.findall(r"<tr>(.*?)</tr>", html)
    return [re.findall(r"<t[dh]>(.*?)</t[dh]>", row) for row in rows]


def in_si(surface):
    return rl.Surface(surface.heights, surface.sizes, "m")


def test_a_body_is_told_in_a_line():
    surface = SPECTRUM.surface(64, 3)
    assert repr(surface) == "<Surface: 64 × 64 points, 0.001 × 0.001, rms height 1e-06>"
    assert repr(in_si(surface)) == "<Surface: 64 × 64 points, 1 mm × 1 mm, rms height 1 µm>"
    line = rl.Line(SPECTRUM.line(256, 1).heights, 1e-3, "m")
    assert repr(line) == "<Line: 256 points, 1 mm, rms height 1 µm>"


@pytest.mark.parametrize(
    ("loads", "told"),
    [
        ({"forces": [1, 10]}, "<Curve: 2 loads, force 1 N to 10 N>"),
        ({"forces": [2]}, "<Curve: 1 load, force 2 N to 2 N>"),
        (
            {"forces": [1, 10], "max_iterations": 2, "throw": False},
            "<Curve: 2 loads, none solved>",
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
    assert header == ["load", "depth d", "force F", "stiffness k", "contact area A/A_0", "remark"]
    assert [row[0] for row in rows] == [*map(str, range(12)), "…", *map(str, range(26, 30))]
    assert rows[-1][2] == "10 N"
    assert rows[0][-1] == "the grid decides"
    unsolved = rl.press(surface, E_star=1e11, forces=[1], max_iterations=2, throw=False)
    _, row = cells(unsolved._repr_html_())
    assert row == ["0", "–", "–", "–", "–", "max_iterations reached above the tolerance"]
