"""What the tiles of a map say of the larger surface behind it."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_surfaces import Make, parent_of, piece_of
from held_measures import held
from roughline.contact.measures import MEAN_GAP, Measured
from roughline.margins.larger_measure import LargerMeasure
from roughline.margins.place import spread_of_differences
from roughline.margins.spread import Spread, Values
from roughline.margins.tiles import TiledCurves, Tiles
from roughline.question.extrapolation import Extrapolation
from told import first_warning

MATERIALS = "E=200 GPa nu=0.3, E=200 GPa nu=0.3"
SEEN, NOT_SEEN = Extrapolation(6.0), Extrapolation(None)


def drawn(rng, of_map=0.0, of_tile=1.0, loads=400):
    """Tiles of many maps: means of quarters that scatter, and of what a map has on its own."""
    quarters = of_map * rng.normal(size=(1, 1, loads)) + of_tile * rng.normal(size=(4, 4, loads))
    halves = quarters.reshape(2, 2, 2, 2, loads).mean(axis=(1, 3))
    return Tiles(halves.mean(axis=(0, 1)), halves, quarters)


def test_the_mean_of_independent_tiles_is_held_in_95_of_100():
    tiles = drawn(np.random.default_rng(1))
    low, high = tiles.extrapolated(SEEN)
    held = np.mean((tiles.of_map + low <= 0) & (tiles.of_map + high >= 0))
    assert 0.95 <= held < 0.995
    width = np.median(high - low) / 2 / 1.96 * 4  # over that which just holds as many
    assert 1.0 < width < 1.4
    assert (tiles.extrapolated(NOT_SEEN)[1] > high).all()


def test_a_lay_makes_tiles_count_for_less():
    """Quarters in a row are alike: there are four, not sixteen."""
    rng = np.random.default_rng(2)
    rows = rng.normal(size=(4, 1, 400)) + 0.1 * rng.normal(size=(4, 4, 400))
    halves = rows.reshape(2, 2, 2, 2, 400).mean(axis=(1, 3))
    tiles = Tiles(halves.mean(axis=(0, 1)), halves, rows)
    low, high = tiles.extrapolated(SEEN)
    assert np.mean((tiles.of_map + low <= 0) & (tiles.of_map + high >= 0)) >= 0.9
    assert np.median(tiles.scatter(SEEN)) > 1.5 * np.median(drawn(rng).scatter(SEEN))


@pytest.mark.parametrize("sign", [-1, 1])
def test_steps_from_tiles_to_the_map_go_on(sign):
    """With a roll-off as much again as the last, without one the larger at each doubling."""
    quarters = np.zeros((4, 4, 1))
    tiles = Tiles(np.array([0.3 * sign]), np.full((2, 2, 1), 0.2 * sign), quarters)
    ends = sorted(abs(np.ravel(tiles.steps(SEEN))))
    assert ends == pytest.approx([0.0, 0.1])  # half of 0.2, and 0.1
    assert sorted(abs(np.ravel(tiles.steps(NOT_SEEN)))) == pytest.approx([0.0, 0.4])
    twice = replace(NOT_SEEN, doublings=4.0)
    assert sorted(abs(np.ravel(tiles.steps(twice)))) == pytest.approx([0.0, 0.8])


def test_full_contact_of_a_tile_leaves_no_upper_end():
    tiles = drawn(np.random.default_rng(3), loads=3)
    tiles.quarters[0, 0, 1] = np.inf
    tiles.quarters[..., 2] = np.nan
    low, high = tiles.extrapolated(SEEN)
    assert np.isinf(high).tolist() == [False, True, True]
    assert np.isfinite(low).tolist() == [True, True, False]


def measure_of(whole, halves, quarters):
    """A measure under one load, of a map, its halves and its quarters."""

    def curve(value):
        return SimpleNamespace(
            measured={"mean_gap": Measured(MEAN_GAP.quantity, np.array([float(value)]))}
        )

    tiled = TiledCurves(curve(whole), list(map(curve, halves)), list(map(curve, quarters)), 64)
    return LargerMeasure.of(np.array([float(whole)]), "mean_gap", tiled)


def with_grid(measure, of_grid=(0.9, 1.1)):
    """Both ends of that of a larger surface, with those of the grid over the value."""
    return held(measure, SEEN, tuple(measure.values * each for each in of_grid))


def test_a_measure_scatters_as_its_tiles_do():
    """Tiles that are alike leave what the grid does; others are combined with that."""
    low, high = with_grid(measure_of(2, [2] * 4, [2] * 16))
    assert [low[0], high[0]] == pytest.approx([1.8, 2.2])
    rng = np.random.default_rng(6)
    quarters = 2 * np.exp(0.3 * rng.normal(size=16))
    low, high = with_grid(measure_of(2, [1.8, 2.2, 2.0, 2.0], quarters))
    assert 0.5 < low[0] < 1.8
    assert 2.2 < high[0] < 4


def test_sealed_tiles_open_an_interval_towards_zero_and_not_to_infinity():
    low, high = with_grid(measure_of(1, [1.2, 0.8, 1, 0], [0] * 6 + [1.5] * 10))
    assert 0 < low[0] < 0.5
    assert 1.1 < high[0] < 20
    low, _ = with_grid(measure_of(0.2, [1.2, 0, 0, 0], [0] * 12 + [1.5] * 4))
    assert low[0] == 0
    low, high = with_grid(measure_of(0, [0, 0.5, 0, 0], [0] * 10 + [0.4] * 6))
    assert low[0] == 0
    assert 0 < high[0] < 5


def test_without_a_roll_off_a_gap_may_go_on_to_either_side():
    """It grows from tiles to the map, and the border that keeps the map open falls away as well."""
    growing = measure_of(2, [1.5] * 4, [1] * 16).tiles
    seen, not_seen = growing.steps(SEEN), growing.steps(NOT_SEEN)
    assert seen[0][0] == 0 < seen[1][0]
    assert not_seen[0][0] == -not_seen[1][0] < 0


def test_where_map_and_tiles_are_sealed_nothing_but_the_grid_leaves_it_open():
    closed = measure_of(0, [0] * 4, [0] * 16)
    assert held(closed, SEEN)[1][0] == 0
    assert held(closed, SEEN, (np.zeros(1), np.array([0.3])))[1][0] == pytest.approx(0.3)


def test_a_map_without_roll_off_tells_of_joints_up_to_sixteen_times_as_long():
    for side, is_supported in ((4, True), (16, True), (17, False)):
        assert Extrapolation.of(None, 1.0, side**2).is_supported == is_supported
    assert Extrapolation.of(5.0, 1.0, 1e6).is_supported
    assert Extrapolation.of(None, 1.0, None).doublings == 2


@pytest.fixture(scope="module", params=[32, 64])
def made(request):
    """A part with a roll-off, and a map of it."""
    make = Make(points=request.param, hurst=0.7, waves=8.0)
    rng = np.random.default_rng(5)
    part = parent_of("sharp roll-off", make, rng)
    return part, piece_of(part, make, rng)


def test_both_uncertainties_are_combined(made):
    _, piece = made
    level = piece.detrended()
    curve = rl.press(level, E_star=1.0, forces=[0.02 * level.rms_slope * level.area], periodic=True)
    values, differences = Values.of(curve), drawn(np.random.default_rng(4), loads=1)
    of_tiles = differences.extrapolated(SEEN)
    of_place = spread_of_differences(values, of_tiles, of_tiles, {}, {})
    k = values.unloading
    of_grid = replace(of_place, unloading=(k / 10, k * 10))
    alone, both = (Spread.together(values, each) for each in ([of_place], [of_place, of_grid]))
    for end, wide in zip(alone.unloading, both.unloading, strict=True):
        own = math.hypot(math.log(10), abs(math.log(end[0] / k[0])))
        assert abs(np.log(wide / k)) == pytest.approx([own])


@pytest.mark.parametrize("points", [32, 64])
@pytest.mark.parametrize(
    ("kind", "waves", "bar"),
    [("sharp roll-off", 6.0, None), ("lognormal pits", 6.0, 0.15), ("no roll-off", 0.0, None)],
)
def test_intervals_of_a_map_hold_its_parent(kind, waves, bar, points):
    """A map of a joint, as it is asked for, and the whole joint in the full model."""
    make, rng = Make(points=points, hurst=0.6, waves=waves), np.random.default_rng(17)
    part = parent_of(kind, make, rng)
    pair = rl.Question(part, MATERIALS).pair
    pressures = np.array([0.003, 0.03, 0.2]) * pair.E_star * part.rms_slope
    hardness = None if bar is None else bar * pair.E_star * part.rms_slope
    if bar is not None:
        pressures = 1 / (1 / pressures + 1 / (0.6 * hardness))
    truth = rl.press(
        part,
        E_star=pair.E_star,
        forces=pressures * part.area,
        hardness=hardness,
        periodic=True,
    )
    question = rl.Question(
        piece_of(part, make, rng),
        MATERIALS,
        loads=(pressures * part.area).tolist(),
        ask=rl.Joint(part.area),
        hardness=hardness,
        elastic=bar is None,
        grid_error=True,
        fields=False,
    )
    answers = rl.assess(question).answers
    for key, true in (
        ("interface_stiffness", truth.unloading_stiffness),
        ("contact_area_fraction", truth.area_fraction_corrected),
    ):
        low, high = answers[key].ends
        assert ((low <= true) & (true <= high)).all(), key


def test_waves_longer_than_the_map_take_down_what_rests_on_the_map_alone(made):
    """The map's own answers keep their intervals."""
    part, piece = made
    n = len(piece.heights)
    x = np.linspace(0, 1, n)[:, np.newaxis] * np.ones(n)
    bowed = replace(piece, heights=piece.heights + 6 * piece.rms_height * x**2)
    asked = {"loads": "200 MPa", "elastic": True, "fields": False, "grid_error": True}
    found = rl.assess(rl.Question(bowed, MATERIALS, **asked))
    assert found.answers["interface_stiffness"].ends is None
    for key in ("contact_stiffness", "contact_area"):
        assert found.answers[key].ends is not None
    assert "waves longer" in first_warning(found)
    joint = rl.assess(rl.Question(bowed, MATERIALS, ask=rl.Joint(part.area), **asked))
    assert joint.answers["contact_area"].ends is None
    assert joint.intervals is None


@pytest.mark.parametrize("made", [64], indirect=True)  # on fewer points it does not show
def test_roughness_that_drifts_takes_it_down_as_well(made):
    _, piece = made
    x = np.linspace(-1, 1, 64)[:, np.newaxis]
    level = piece.detrended().heights * np.exp(0.6 * x)
    drifting = replace(piece, heights=level)
    asked = {"loads": "200 MPa", "elastic": True, "fields": False, "grid_error": True}
    found = rl.assess(rl.Question(drifting, MATERIALS, **asked))
    assert found.answers["interface_stiffness"].ends is None
    said = next(each for each in found.warnings if "roughness drifts over the map: along x" in each)
    lost = "interface stiffness and mean gap"
    assert said.endswith(f"; {lost} come without an interval")
    joint = rl.assess(rl.Question(drifting, MATERIALS, ask=rl.Joint("4 cm^2"), **asked))
    assert any("; all answers of the joint come without an" in each for each in joint.warnings)


@pytest.mark.parametrize("points", [32, 64])
def test_the_answer_says_for_which_surface_it_is(points):
    make, rng = Make(points=points, hurst=0.8, waves=0.0), np.random.default_rng(8)
    part = parent_of("no roll-off", make, rng)
    piece = piece_of(part, make, rng)
    asked = {"loads": "100 MPa", "elastic": True, "fields": False, "grid_error": True}

    def k_i(**joint):
        return rl.assess(rl.Question(piece, MATERIALS, **asked, **joint)).answers[
            "interface_stiffness"
        ]

    alone = k_i()
    assert alone.validity.startswith("of a surface 4 times as long as the map, which shows no")
    assert "rl.Joint" in alone.validity
    assert k_i(ask=rl.Joint(part.area)).ends is not None
    far = k_i(ask=rl.Joint(1000 * part.area))
    assert far.ends is None
    assert "measure a map at least 1/16 as long" in far.validity
