"""A measure and an answer that the program does not know, defined here: they stand everywhere."""

import json

import numpy as np
import pytest

import roughline as rl
from roughline.report.contact_report import write_contact_report
from roughline.report.json_output import assessment_json, to_json
from roughline.report.terminal import print_assessment

DEEPEST = rl.Measure(
    "deepest_gap", "u_0", "length", "largest gap", lambda fields: float(fields.gap.max())
)
TAKEN = []  # periodic or not, each time that it is taken


def _counted(fields):
    TAKEN.append(fields.is_periodic)
    return DEEPEST.value(fields)


COUNTED = rl.Measure("counted_gap", "u_0", "length", "largest gap", _counted)

VALLEY = rl.Rule(
    key="valley",
    name="deepest valley",
    symbol="u_0",
    unit="m",
    group="sealing",
    formula="largest gap",
    source="Abbott 1933",
    value=lambda pressed: pressed.measure("counted_gap"),
    measures=[COUNTED],
    leads=lambda pressed: True,
)


@pytest.fixture
def valley():
    rl.rules.add(VALLEY)
    TAKEN.clear()
    yield VALLEY
    rl.rules.remove("valley")


@pytest.fixture(scope="module", params=[64, 128])
def surface(request):
    """A periodic surface."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=5e4, q_high=4e5)
    return spectrum.surface(request.param, rng=7)


@pytest.fixture(scope="module")
def piece(surface):
    """A map that was cut out of it."""
    half = len(surface.heights) // 2
    return surface.cropped((0, half), (0, half))


def asked(body, **more):
    return rl.assess(rl.Question(body, "steel,copper", **{"loads": ["3 N", "10 N"]} | more))


def test_its_interval_is_that_of_the_measure(valley, surface):
    result = asked(surface, elastic=True, grid_error=True)
    found = result.answers["valley"]
    curve = rl.press(
        surface,
        E_star=result.curve.E_star,
        forces=[3.0, 10.0],
        measures=[DEEPEST],
        grid_error=True,
    )
    measured = curve.measured["deepest_gap"]
    for own, of_measure in zip((found.values, found.low, found.high), measured.rows, strict=True):
        assert own == pytest.approx(of_measure, rel=1e-12)
    assert (found.low < found.values).all()
    assert (found.values < found.high).all()


def test_the_scatter_of_the_hardness_widens_it(valley, surface):
    result = asked(surface, grid_error=True)
    found, (least, most) = result.answers["valley"], result.hardness_scatter["valley"]
    own = result.measured["counted_gap"]
    assert (least < 1).all()
    assert (most > 1).all()
    assert found.low == pytest.approx(own.low * least, rel=1e-12)
    assert found.high == pytest.approx(own.high * most, rel=1e-12)
    assert (result.elastic["valley"].values > found.values).all()  # harder summits keep it open


def test_of_a_map_it_is_taken_where_the_surface_goes_on(valley, piece):
    """The measure is taken of the map pressed periodically, and nowhere else."""
    result = asked(piece, elastic=True, grid_error=False, ask=rl.Joint("4 mm^2"), loads=["2 MPa"])
    assert set(TAKEN) == {True}
    alone = asked(piece, elastic=True, grid_error=False, loads=["2 MPa"])
    assert set(TAKEN) == {True}
    assert alone.answers["valley"].values == pytest.approx(result.answers["valley"].values)
    assert not alone.curve.measured


def test_another_filling_widens_it(valley, piece, tmp_path):
    heights = piece.heights.copy()
    points = len(heights)
    heights[points // 4 : points // 3, points // 3 : points // 2] = np.nan
    np.save(tmp_path / "map.npy", heights)
    reading = rl.Reading(unit="m", sizes=piece.sizes)
    result = asked(tmp_path / "map.npy", elastic=True, grid_error=True, reading=reading)
    found, own = result.answers["valley"], result.measured["counted_gap"]
    assert (found.high >= own.high).all()
    assert len(TAKEN) == 2 * 4 + 2  # both loads on all grids, and filled otherwise


def test_no_rule_that_is_not_there_costs_anything(surface):
    TAKEN.clear()
    asked(surface, elastic=True, grid_error=False)
    assert not TAKEN


def test_several_maps_have_its_mean_and_scatter(valley, surface):
    half = len(surface.heights) // 2
    maps = [surface.cropped((x, x + half), (0, half)) for x in (0, half)]
    part = asked(maps, elastic=True, loads=["2 MPa"], grid_error=False, fields=False)
    of_maps = [each.answers["valley"].values for each in part.assessments]
    assert part.answers["valley"].mean == pytest.approx(np.sqrt(of_maps[0] * of_maps[1]), rel=1e-12)
    joint = asked(
        maps, elastic=True, loads=["2 MPa"], ask=rl.Joint("4 mm^2"), grid_error=True, fields=False
    )
    assert joint.answers["valley"].low[0] < joint.answers["valley"].mean[0]


def test_it_stands_on_the_terminal_in_json_and_in_the_report(
    valley, surface, tmp_path, only_drawn, capsys
):
    only_drawn()
    result = asked(surface, grid_error=True)
    print_assessment(result)
    assert "deepest valley u_0" in capsys.readouterr().out
    written = json.loads(to_json(assessment_json(result)))
    assert written["answers"]["u_0"]["key"] == "valley"
    measured = written["measures"]["counted_gap"]
    assert (measured["symbol"], measured["unit"]) == ("u_0", "m")
    assert np.all(np.array(measured["low"]) < np.array(measured["values"]))
    page = write_contact_report(result, tmp_path, "")[0].read_text("utf-8")
    assert page.count("eepest valley") >= 3  # headline, table, formulas
    assert "Abbott 1933" in page


def test_a_line_has_no_such_answer(valley):
    line = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).line(256, rng=7)
    assert "valley" not in asked(line).answers
