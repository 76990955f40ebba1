"""What a report says of its answers comes from what was pressed."""

import numpy as np
import pytest

import roughline as rl
from roughline.report.document import write_document

LENGTH = 1e-4
SPECTRUM = rl.SelfAffine(hurst=0.8, length=LENGTH, rms_height=4e-7, q_roll=8 * np.pi / LENGTH)


@pytest.fixture(scope="module")
def body():
    heights = SPECTRUM.surface(32, rng=3).heights
    return rl.Surface(heights, (LENGTH, LENGTH), unit="m", is_cut_out=True)


def page_of(folder, body, **asked):
    result = rl.assess(rl.Question(body, loads=["1 mN"], fields=False, **asked))
    page, _ = write_document(result, folder, "A contact", [], [])
    return " ".join(page.read_text("utf-8").split())


STICKING = {"materials": "rubber,glass", "ask": (rl.Adhesion("50 mJ/m^2 over 1 um"),)}


@pytest.mark.parametrize(
    ("asked", "said", "unsaid"),
    [
        (STICKING, ["pull each other evenly across gaps"], ["without adhesion"]),
        ({"materials": "steel,copper"}, ["up to the hardness", "without adhesion"], ["pull each"]),
        (
            {"materials": "steel,copper", "elastic": True},
            ["linear elastic, without adhesion"],
            ["hardness of the softer one, where", "scatter of the hardness leave"],
        ),
    ],
    ids=["sticking", "yielding", "elastic"],
)
def test_assumptions_are_those_of_the_law(tmp_path, body, asked, said, unsaid):
    page = page_of(tmp_path, body, **asked)
    for each in said:
        assert each in page
    for each in unsaid:
        assert each not in page


def test_intervals_name_what_they_hold(tmp_path, body):
    asked = {"materials": "steel,copper", "grid_error": True}
    page = page_of(tmp_path, body, **asked)
    assert "hold what the grid and the scatter of the hardness leave open" in page
    assert "filled points" not in page
    page = page_of(tmp_path, body, **asked, hardness="2 GPa")
    assert "hold what the grid leaves open" in page
    assert "scatter of material data" in page
    assert "Intervals, where given" not in page_of(tmp_path, body, materials="steel,copper")
