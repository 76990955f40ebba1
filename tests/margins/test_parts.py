"""What several maps say together of the part behind them."""

import math
import re

import numpy as np
import pytest
from scipy.optimize import brentq

import roughline as rl
from benchmarks.made_surfaces import SIDE, Make, parent_of
from roughline.margins.parts import shared_load
from roughline.topography.provenance import Provenance, Tilt
from told import first_warning

MATERIALS = "E=200 GPa nu=0.3 resistivity=1e-7 ohm m, E=200 GPa nu=0.3 resistivity=1e-7 ohm m"
E_STAR = 200e9 / (1 - 0.3**2) / 2


def part_of(kind, *, maps, points=32, waves=4, grid_error=False, joint=True, **named):
    """A part of five by five maps, the answers from some of them, and the pressure."""
    parent = parent_of(kind, Make(points, 5, 0.7, waves), np.random.default_rng(3))
    places = [(0, 0), (1, 3), (3, 1), (4, 4), (2, 2), (0, 3), (3, 4)][:maps]
    bodies = [
        rl.Surface(
            parent.heights[x * points : (x + 1) * points, y * points : (y + 1) * points].copy(),
            (SIDE, SIDE),
            unit="m",
            is_cut_out=True,
            **named,
        )
        for x, y in places
    ]
    pressure = 0.03 * E_STAR * parent.rms_slope
    question = rl.Question(
        bodies,
        MATERIALS,
        loads=f"{pressure} Pa",
        ask=rl.Joint(parent.area) if joint else (),
        grid_error=grid_error,
        elastic=True,
        fields=False,
    )
    return parent, rl.assess(question), pressure


@pytest.mark.parametrize("scatter", [0.05, 0.2, 0.4])
@pytest.mark.parametrize("log_pressure", [2.0, 4.0, 6.0])
def test_rougher_places_bear_more_of_a_load_at_equal_distance(scatter, log_pressure):
    """Places p_0 exp(-u / u_0) under one mean pressure, and at one distance u."""
    rng = np.random.default_rng(1)
    u_0 = np.exp(scatter * rng.standard_normal(4000))
    pressure = math.exp(-log_pressure)

    def excess(u):
        return np.exp(-u / u_0).mean() - pressure

    shares = np.exp(-brentq(excess, 0.0, 100.0) / u_0)
    whole = np.mean(shares / u_0)
    k = pressure / u_0[:, np.newaxis]
    # bodies that do not give way; as large a share of the area as of p_0
    low, high = shared_load(k, np.full_like(k, pressure), 1.0, 1e9).stiffness
    found = math.log(whole) - np.log(k).mean()
    assert low[0] <= found <= high[0]
    assert low[0] > 3 * found


def test_bodies_that_give_way_leave_the_harmonic_mean():
    rng = np.random.default_rng(2)
    k = np.exp(0.3 * rng.standard_normal((2000, 1)))
    low, high = shared_load(k, np.full_like(k, 0.01), 1.0, 1e-9).stiffness
    assert low[0] == pytest.approx(-np.log(np.mean(1 / k)) - np.log(k).mean(), rel=0.1)
    assert high[0] == 0


def test_bodies_as_stiff_as_their_places_give_way_by_half():
    """To waves twice as long as a map: E* q / 2 = k over its area."""
    side, E_star, area, scatter = 2.0, 3.0, 1e-4, 0.01
    k = math.pi * E_star * side / 2 * np.exp(scatter * np.array([[-1.0], [0.0], [1.0]]))
    low, _ = shared_load(k, np.full_like(k, area), side, E_star).stiffness
    assert low[0] == pytest.approx(math.log(area) / 2 * scatter**2)


def test_maps_that_are_alike_share_their_load_alike():
    k, a = np.ones((3, 2)), np.full((3, 2), 0.1)
    found = shared_load(k, a, 1.0, 1.0)
    for ends in (found.stiffness, found.area):
        assert np.abs(ends).max() == 0


@pytest.mark.parametrize("maps", [2, 3])
def test_a_part_of_alike_places_is_told_and_its_maps_agree(maps):
    parent, part, pressure = part_of("sharp roll-off", maps=maps, grid_error=True)
    whole = rl.press(parent, E_star=E_STAR, forces=pressure * parent.area, periodic=True)
    for key, truth in (
        ("interface_stiffness", whole.stiffness[0]),
        ("contact_area_fraction", whole.area_fraction_corrected[0]),
    ):
        answer = part.answers[key]
        assert answer.low[0] < truth < answer.high[0]
    assert any(text.startswith("the maps agree: rms heights scatter") for text in part.notes)
    assert not any("do not agree" in text for text in part.warnings)


def test_places_that_differ_in_roughness_are_named_and_widen_what_is_said_of_the_joint():
    parent, part, pressure = part_of("uneven roughness", maps=5, grid_error=True)
    assert re.match(r"the maps do not agree: rms heights scatter by a factor of", part.warnings[0])
    whole = rl.press(parent, E_star=E_STAR, forces=pressure * parent.area, periodic=True)
    k = part.answers["interface_stiffness"]
    assert k.low[0] < whole.stiffness[0] < k.high[0]
    assert k.mean[0] / k.low[0] > k.high[0] / k.mean[0]  # the part is softer than its mean place


@pytest.mark.parametrize("maps", [3, 5])
@pytest.mark.parametrize("joint", [True, False])
def test_waves_longer_than_all_maps_take_down_what_is_said_of_the_part(joint, maps):
    _, part, _ = part_of("waviness of 4 maps", maps=maps, points=64, joint=joint)
    said = first_warning(part)
    assert re.match(r"the maps are (tilted differently|bowed), by an rms height of", said)
    assert "come without an interval" in said
    assert np.isnan(part.answers["interface_stiffness"].low).all()
    assert np.isfinite(part.answers["interface_stiffness"].mean).all()
    if not joint:  # the mean over all places of the maps' own
        assert np.isfinite(part.answers["contact_stiffness"].low).all()


@pytest.mark.parametrize("maps", [4, 7])
def test_bows_tell_of_longer_waves_where_the_tilt_is_the_mountings(maps):
    mounted = Provenance(tilt=Tilt(is_of_mounting=True))
    _, part, _ = part_of("waviness of 4 maps", maps=maps, points=64, waves=8, provenance=mounted)
    assert first_warning(part).startswith("the maps are bowed")


def test_a_joint_much_longer_than_maps_without_a_roll_off_is_not_told():
    _, part, _ = part_of("no roll-off", maps=2, points=32, joint=False)
    bodies = [each.body for each in part.assessments]
    question = rl.Question(
        bodies, MATERIALS, loads="1 MPa", ask=rl.Joint(1e4 * SIDE**2), elastic=True, fields=False
    )
    found = rl.assess(question)
    assert first_warning(found).startswith(
        "the maps show no roll-off together, and the joint is 100 "
    )
    assert np.isnan(found.answers["interface_stiffness"].low).all()
