"""A repeated body has no place where it is cut: its gap has the same measures wherever that is.

The gap of a contact is rolled, mirrored, turned over its diagonal, and repeated by hand.
"""

from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.fluid.measures import (
    LIQUID,
    equivalent_aperture,
    flow_factor,
    hydraulic_aperture,
    inverse_gap,
    largest_share,
    measures_at_border,
    slope_of_flow,
)
from roughline.fluid.rarefied import Rarefied
from roughline.fluid.sealing_pressure import CHANNEL
from roughline.question.films import SPOT_RADIUS

SAME = 1e-9
SHAPE, SIZES = (24, 18), (4.0, 3.0)
ROLLED = (7, 11)
FLUIDS = {"liquid": LIQUID, "gas": Rarefied(1e-3, 0.2), "into a vacuum": Rarefied(1e-2, 1.0)}
OF_FLOW = equivalent_aperture, flow_factor, slope_of_flow, largest_share
KEPT = {
    "rolled": lambda field: np.roll(field, ROLLED, (0, 1)),
    "mirrored along x": lambda field: field[::-1],
    "mirrored along y": lambda field: field[:, ::-1],
    "exchanged": lambda field: field.T,
}
REPEATED = {"2 x 2": (2, 2), "4 x 1": (4, 1), "1 x 8": (1, 8)}
TURNED = {"x": "y", "y": "x", "both": "both"}


def rough(q_high=100.0):
    waves = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=30.0, q_high=q_high)
    return np.array(waves.surface(SHAPE[0], rng=4).heights)[:, : SHAPE[1]]


@pytest.fixture(scope="module")
def fields():
    """At 23 % contact, with yield."""
    surface = rl.Surface(rough(), SIZES, is_cut_out=False)
    given = {"E_star": 1.0, "hardness": 0.01, "periodic": True, "fields": True}
    return rl.press(surface, forces=[0.0014 * surface.area], **given).fields[0]


def moved(fields, move, sizes):
    names = ["pressure", "displacement", "gap", "contact", "plastic", "pulling", "indentation"]
    return replace(fields, **{name: move(getattr(fields, name)) for name in names}, sizes=sizes)


def turned_over(fields, name):
    sizes = SIZES[::-1] if name == "exchanged" else SIZES
    return moved(fields, KEPT[name], sizes), TURNED if name == "exchanged" else {
        a: a for a in TURNED
    }


def by_hand(fields, times):
    sizes = SIZES[0] * times[0], SIZES[1] * times[1]
    return moved(fields, lambda field: np.tile(field, times), sizes)


def test_the_gap_is_open_and_in_contact(fields):
    assert 0.1 < fields.contact.mean() < 0.35
    assert fields.plastic.any()
    assert all(CHANNEL[along].of(fields) > 0 for along in ("x", "y", "both"))


@pytest.mark.parametrize("fluid", FLUIDS)
@pytest.mark.parametrize("name", KEPT)
def test_measures_of_a_flow_do_not_see_where_the_map_begins(fields, fluid, name):
    there, along = turned_over(fields, name)
    for of in OF_FLOW:
        for side in "xy":
            expected = of(FLUIDS[fluid], side).of(fields)
            assert expected > 0
            found = of(FLUIDS[fluid], along[side]).of(there)
            assert found == pytest.approx(expected, rel=SAME), of.__name__


@pytest.mark.parametrize("fluid", FLUIDS)
@pytest.mark.parametrize("times", REPEATED.values(), ids=REPEATED)
def test_measures_of_a_flow_do_not_see_how_often_the_map_is_repeated(fields, fluid, times):
    there = by_hand(fields, times)
    for of in (equivalent_aperture, flow_factor, slope_of_flow):
        for side in "xy":
            expected = of(FLUIDS[fluid], side).of(fields)
            assert of(FLUIDS[fluid], side).of(there) == pytest.approx(expected, rel=SAME)


def test_a_channel_has_its_share_in_each_repetition(fields):
    """Of a map that is repeated along the flow it is the same, and across it a part."""
    expected = largest_share(LIQUID, "x").of(fields)
    along, across = by_hand(fields, (4, 1)), by_hand(fields, (1, 4))
    assert largest_share(LIQUID, "x").of(along) == pytest.approx(expected, rel=SAME)
    assert largest_share(LIQUID, "x").of(across) >= expected / 4 * (1 - SAME)  # wider ones count


@pytest.mark.parametrize("place", [*KEPT, *REPEATED])
def test_other_measures_of_the_gap_do_not_either(fields, place):
    there = by_hand(fields, REPEATED[place]) if place in REPEATED else turned_over(fields, place)[0]
    for measure in (rl.MEAN_GAP, SPOT_RADIUS, inverse_gap(1e-3)):
        assert measure.of(there) == pytest.approx(measure.of(fields), rel=SAME), measure.name
    slipping = hydraulic_aperture("x", 1e-3), hydraulic_aperture("y", 1e-3)
    turn = 1 if place == "exchanged" else 0
    for k in (0, 1):
        expected = slipping[k].of(fields)
        assert slipping[(k + turn) % 2].of(there) == pytest.approx(expected, rel=SAME)
    turns = {"x": "y", "y": "x", "both": "both"} if turn else {}
    for along in "both", "x", "y":
        expected = CHANNEL[along].of(fields)
        assert CHANNEL[turns.get(along, along)].of(there) == pytest.approx(expected, rel=SAME)


@pytest.mark.parametrize("name", ["mirrored along x", "mirrored along y", "exchanged"])
def test_the_border_of_a_map_is_turned_with_it(fields, name):
    """Where it is cut elsewhere, it is another."""
    there, along = turned_over(fields, name)
    for side in "xy":
        pairs = measures_at_border(LIQUID, side), measures_at_border(LIQUID, along[side])
        for measure, other in zip(*pairs, strict=True):
            assert other.of(there) == pytest.approx(measure.of(fields), rel=SAME)


ANGLES = {
    "rolled": lambda angle: angle,
    "mirrored along x": lambda angle: -angle,
    "mirrored along y": lambda angle: -angle,
    "exchanged": lambda angle: 90 - angle,
}


@pytest.mark.parametrize("name", KEPT)
def test_directions_and_the_narrowest_place_are_turned_with_the_map(fields, name):
    there, along = turned_over(fields, name)
    for flow in rl.flow(fields, along="both"):
        other = rl.flow(there, along=along[flow.along])
        assert other.principal_permeances == pytest.approx(flow.principal_permeances, rel=SAME)
        expected = ANGLES[name](flow.easiest_direction)
        assert (other.easiest_direction - expected + 90) % 180 - 90 == pytest.approx(0, abs=1e-6)
        marked = np.zeros(SHAPE)
        marked[flow.constriction] = 1
        assert other.constriction == np.unravel_index(KEPT[name](marked).argmax(), other.gap.shape)
        assert other.dissipation == pytest.approx(flow.dissipation, rel=SAME)


@pytest.mark.parametrize("times", [*REPEATED.values(), (8, 8)], ids=[*REPEATED, "8 x 8"])
def test_the_tensor_of_a_map_is_that_of_its_repetitions(fields, times):
    once, there = rl.flow(fields), rl.flow(by_hand(fields, times))
    scale = SAME * once.tensor.max()
    assert there.tensor == pytest.approx(once.tensor, rel=SAME, abs=scale)
    assert there.principal_permeances == pytest.approx(once.principal_permeances, rel=SAME)
    assert there.easiest_direction == pytest.approx(once.easiest_direction, abs=1e-6)
    i, j = there.constriction
    assert (i % SHAPE[0], j % SHAPE[1]) == once.constriction


def sought(heights, sizes, along, hardness, rtol=0.01):
    surface = rl.Surface(np.ascontiguousarray(heights), sizes, is_cut_out=False)
    given = {"half_space": rl.Homogeneous(1.0, periodic=True), "along": along, "rtol": rtol}
    law = None if hardness is None else rl.Yielding(hardness)
    found = rl.sealing_pressure(surface, law=law, interval=False, **given)
    return found.low, found.high, found.area_fractions


@pytest.mark.parametrize("hardness", [None, 0.005])
@pytest.mark.parametrize("along", ["x", "y", "both"])
def test_a_surface_seals_at_the_same_pressure_wherever_it_is_cut_to_the_bit(along, hardness):
    """The same loads are tried, and the last channel closes between the same two of them."""
    heights = rough()
    expected = sought(heights, SIZES, along, hardness)
    assert 0.3 < expected[2][1] < 0.7
    for name, move in KEPT.items():
        sizes = SIZES[::-1] if name == "exchanged" else SIZES
        side = TURNED[along] if name == "exchanged" else along
        assert sought(move(heights), sizes, side, hardness) == expected, name
    for times in ((2, 1), (2, 2)):
        sizes = SIZES[0] * times[0], SIZES[1] * times[1]
        assert sought(np.tile(heights, times), sizes, along, hardness) == expected, times


def test_that_pressure_is_the_same_however_near_its_ends_have_to_be():
    """Contacts are solved as much more accurately, so that none of them decides it by chance."""
    waves = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=30.0, q_high=60.0)
    heights = np.array(waves.surface(16, rng=11).heights)
    expected = sought(heights, (1.0, 1.0), "both", None, rtol=1e-6)
    assert expected[1] == pytest.approx(expected[0], rel=1e-6)
    for name in "rolled", "mirrored along x", "exchanged":
        assert sought(KEPT[name](heights), (1.0, 1.0), "both", None, rtol=1e-6) == expected, name


@pytest.mark.parametrize("hardness", [None, 0.01])
def test_a_load_may_be_taken_off_as_far_wherever_the_surface_is_cut_to_the_bit(hardness):
    found = {}
    for name, move in {"as it is": lambda field: field, **KEPT, "2 x 2": None}.items():
        times = (2, 2) if move is None else (1, 1)
        heights = np.tile(rough(), times) if move is None else np.ascontiguousarray(move(rough()))
        sizes = SIZES[::-1] if name == "exchanged" else (SIZES[0] * times[0], SIZES[1] * times[1])
        surface = rl.Surface(heights, sizes, is_cut_out=False)
        given = {"E_star": 1.0, "periodic": True, "hardness": hardness, "rtol": 1e-9}
        curve = rl.press(surface, forces=[0.0014 * surface.area], **given)
        found[name] = rl.reopening(curve, times=2.0)
    expected = found["as it is"]
    assert 0 < expected.low < 1
    for name, each in found.items():
        assert (each.low, each.high) == (expected.low, expected.high), name
        assert each.apertures == pytest.approx(expected.apertures, rel=1e-6), name
