"""What the border of a map that was cut out does to what flows: a part of the interval."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import roughline as rl
from held_measures import held
from roughline.contact.measures import Measured
from roughline.fluid import border
from roughline.fluid.measures import LIQUID, equivalent_aperture, names_at_border
from roughline.margins.border_of_flow import what_borders_do
from roughline.margins.larger_measure import LargerMeasure
from roughline.margins.parts import behind_maps
from roughline.margins.tiles import POINTS_OF_BORDER, TiledCurves, coarse_shape
from roughline.question.extrapolation import Extrapolation

SEEN = Extrapolation(6.0)
APERTURE = "hydraulic_aperture_x"
SEALED = {"inlet": "6 bar", "seal": "1 mm x 1 mm"}
WATER = rl.Fluid("water", **SEALED)
ALONG_X = rl.Fluid("water", along="x", **SEALED)


def measure_of(whole, tiles, at_border):
    """An aperture of a map, of its tiles, all alike, and as its border is held; a load each."""
    quantity = equivalent_aperture(LIQUID, "x").quantity
    names = APERTURE, *names_at_border(APERTURE)

    def curve(*values):
        of_each = zip(names[: len(values)], values, strict=True)
        measured = {name: Measured(quantity, np.array(each, float)) for name, each in of_each}
        return SimpleNamespace(measured=measured)

    tiled = TiledCurves(curve(whole), [curve(tiles)] * 4, [curve(tiles)] * 16, 64)
    tiled = replace(tiled, border=curve(*at_border))
    return LargerMeasure.of(np.array(whole, float), APERTURE, tiled)


def test_nothing_but_the_border_leaves_open_what_lies_between_both():
    """Were map and tiles alike, and the grid exact; in the second load the flow given is more."""
    low, high = held(measure_of([2, 2], [2, 2], ([2, 2], [1, 3], [4, 5])), SEEN)
    assert low == pytest.approx([1, 2])
    assert high == pytest.approx([4, 5])


def test_it_lies_within_an_interval_that_holds_more():
    """Tiles have borders, too: both together leave open what the wider one does."""
    rest = held(measure_of([2], [1.8], ([2], [2], [2])), SEEN)
    narrower = held(measure_of([2], [1.8], ([2], [1.99], [2.01])), SEEN)
    assert narrower[0] == pytest.approx(rest[0])
    assert narrower[1] == pytest.approx(np.maximum(rest[1], 2.01))
    wider = held(measure_of([2], [1.8], ([2], [1], [4])), SEEN)
    assert wider == (pytest.approx(1), pytest.approx(4))


def test_a_sealed_map_that_its_border_opens_may_leak_so_much():
    low, high = held(measure_of([0, 0], [0, 0], ([0, 0], [0.4, 0], [0.5, 0])), SEEN)
    assert low.tolist() == [0, 0]
    assert high == pytest.approx([0.5, 0])


def test_a_border_that_was_not_solved_leaves_all_open():
    found = held(measure_of([2], [2], ([np.nan], [np.nan], [np.nan])), SEEN)
    assert found == (0, np.inf)


def asked(body, load="50 MPa", ask=WATER, **more):
    given = {"loads": load, "elastic": True, "grid_error": True, **more}
    return rl.assess(rl.Question(body, "steel,steel", ask=ask, **given))


@pytest.fixture(scope="module")
def parent():
    spectrum = rl.SelfAffine(hurst=0.8, length=6e-4, rms_height=1e-6, q_roll=1e5, q_high=6e5)
    return spectrum.surface(96, rng=5)


@pytest.fixture(scope="module")
def piece(parent):
    return parent.cropped((0, 48), (0, 32))


@pytest.fixture(scope="module")
def assessment(piece):
    return asked(piece)


def test_it_is_that_of_the_flow_through_the_map(piece, assessment):
    """The map has few points, so that nothing is coarsened."""
    level, E_star = piece.detrended(), assessment.curve.E_star
    forces = [50e6 * piece.area]
    fields = rl.press(level, E_star=E_star, forces=forces, periodic=True, fields=True).fields[0]
    for flow in rl.flow(fields, along="both"):
        measure = assessment.larger.measures[f"hydraulic_aperture_{flow.along}"]
        expected = np.cbrt(flow.border_permeances)
        assert np.ravel(measure.values_at_border) == pytest.approx(expected, rel=1e-3)
        factor = assessment.larger.measures[f"pressure_flow_factor_{flow.along}"]
        share = np.array(flow.border_permeances) / flow.permeance
        expected = factor.values * share
        assert np.ravel(factor.values_at_border) == pytest.approx(expected, rel=1e-2)


def test_it_is_in_the_interval_of_the_leak(assessment):
    for name in (APERTURE, "hydraulic_aperture_y"):
        measure, answer = assessment.larger.measures[name], assessment.answers[name]
        bare = replace(measure, at_border=None)
        without, whole = (held(each, Extrapolation(2.5)) for each in (bare, measure))
        given, with_pressure = measure.values_at_border
        assert whole[0] == pytest.approx(np.minimum(without[0], given))
        assert whole[1] == pytest.approx(np.maximum(without[1], with_pressure))
        assert (answer.low <= given * (1 + 1e-9)).all()


def test_only_a_map_that_was_cut_out_has_such_a_border(parent, piece, monkeypatch):
    """And only what flows asks for it, on few points, once for each load and direction."""
    solved, real = [], border.permeances_of_border

    def counted(gap, along):
        solved.append((gap.distances.shape, along))
        return real(gap, along)

    monkeypatch.setattr(border, "permeances_of_border", counted)
    whole = rl.Surface(piece.heights, piece.sizes, "m", is_cut_out=False)
    asked(whole, periodic=True)
    asked(piece, grid_error=False)
    assert not solved
    rl.assess(rl.Question(piece, "steel,steel", loads="50 MPa", elastic=True, grid_error=True))
    assert not solved
    asked(piece, ask=ALONG_X, elastic=False, hardness="5 GPa")
    assert solved == [(piece.shape, "x")]


def test_a_map_of_many_points_is_judged_on_few():
    assert coarse_shape((200, 296), POINTS_OF_BORDER) == (100, 148)
    assert coarse_shape((1024, 1024), POINTS_OF_BORDER) == (128, 128)
    assert coarse_shape((64, 2048), POINTS_OF_BORDER) == (64, 2048)


def said_of_borders(result):
    return what_borders_do(result.question.sealing, result.larger, result.answers, result.headings)


def test_both_are_told_where_one_is_an_end_of_the_interval(assessment):
    values = dict(zip("xy", ((0.8, 1.4), (0.99, 1.01)), strict=True))
    measures, answers = dict(assessment.larger.measures), dict(assessment.answers)
    for along, at_border in values.items():
        name = f"hydraulic_aperture_{along}"
        logs = [np.log((np.array([each]) * 1e-6 + 1e-7) / 1.1e-6) for each in at_border]
        one = {"values": np.array([1e-6]), "floor": np.array([1e-7]), "at_border": logs}
        measures[name] = replace(measures[name], **one)
        ends = {"low": np.array([0.8e-6]), "high": np.array([1.5e-6])}
        answers[name] = replace(answers[name], values=np.array([1e-6]), **ends)
    larger = replace(assessment.larger, measures=measures)
    result = replace(assessment, larger=larger, answers=answers)
    assert list(map(str, said_of_borders(result))) == [
        "under 50 MPa the border of the map leaves open more than all else does: along x "
        "u_h is 1 µm as the map repeats, 1.4 µm with the pressure held even along the border, "
        "and 800 nm with the flow given there"
    ]
    beside = replace(
        measures[APERTURE], at_border=[np.log(np.array([each])) for each in (1.5, 1.6)]
    )
    (told,) = said_of_borders(
        replace(result, larger=replace(larger, measures={**measures, APERTURE: beside}))
    )
    assert "1 µm as the map repeats, 1.66 µm with the pressure held" in str(
        told
    )  # alike, and far off
    wide = {APERTURE: replace(answers[APERTURE], low=np.array([0.5e-6]))}
    assert said_of_borders(replace(result, answers={**answers, **wide})) == []
    assert said_of_borders(assessment) == []
    bare = {APERTURE: answers[APERTURE].without_interval}
    (told,) = said_of_borders(replace(result, answers={**answers, **bare}))
    assert str(told).startswith(
        "under 50 MPa the border of the map moves what flows, and no interval"
    )


def test_of_many_maps_the_mean_of_their_borders_is_left_open(parent):
    pieces = [parent.cropped((x, x + 32), (0, 32)) for x in (0, 64)]
    maps = [asked(each, ask=ALONG_X) for each in pieces]
    without = []
    for each in maps:
        measures = {
            name: replace(measure, at_border=None) for name, measure in each.larger.measures.items()
        }
        without.append(replace(each, larger=replace(each.larger, measures=measures)))
    borders = [each.larger.measures[APERTURE].border for each in maps]
    mean = np.mean(borders, axis=0)
    found, bare = (behind_maps(each).common.measures[APERTURE] for each in (maps, without))
    assert found[0] == pytest.approx(np.minimum(bare[0], mean[0]))
    assert found[1] == pytest.approx(np.maximum(bare[1], mean[1]))
    assert abs(mean).max() > 0
