"""Rounds near the contact of bodies that pull, and looks at all of the grid."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.computing.arrays import InRegion
from roughline.halfspace.search import near_rounds, pull
from roughline.halfspace.search.active_set import Search
from roughline.halfspace.search.carriers import Carriers
from roughline.halfspace.search.near_rounds import NearRounds
from roughline.halfspace.search.problem import Grid, Load, Method, Problem
from roughline.halfspace.search.pull import Pull, Shares
from roughline.halfspace.search.region import Region


@pytest.fixture(autouse=True)
def _on_few_points(monkeypatch):
    monkeypatch.setattr(near_rounds, "_FEW_POINTS", 0)


LAWS = [
    rl.Dugdale(work_of_adhesion=0.5, range=0.3),
    rl.Exponential(work_of_adhesion=0.5, range=0.3),
]
MIXED = Method(1e-6, 1000)


def rough(n, periodic=False):
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=8 * np.pi, q_high=n / 5 * 2 * np.pi)
    return spectrum.surface(n, rng=5), rl.Homogeneous(1.0, periodic=periodic)


def problem(law, n=48, periodic=True):
    surface, half_space = rough(n, periodic)
    separation = surface.heights.max() - surface.heights
    grid = Grid(half_space, surface.shape, surface.spacing)
    return Problem(grid, separation, 1.0, MIXED.resolution(grid), law)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("loads", [{"depths": [0.5, 0.8, 0.6]}, {"forces": [0.01, 0.03, 0.0]}])
def test_rounds_near_the_contact_lead_to_where_rounds_of_all_of_it_do(law, loads, monkeypatch):
    surface, half_space = rough(160)

    def pressed() -> rl.Curve:
        return rl.press(surface, half_space=half_space, law=law, **loads)

    found = pressed()
    monkeypatch.setattr(NearRounds, "contact", lambda _: None)
    everywhere = pressed()
    np.testing.assert_allclose(found.force, everywhere.force, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(found.depth, everywhere.depth, rtol=1e-6)
    assert np.array_equal(found.area_fraction, everywhere.area_fraction)
    assert found.convolutions.sum() < 0.6 * everywhere.convolutions.sum()


@pytest.mark.parametrize("law", LAWS)
def test_what_is_led_in_rounds_and_what_follows_from_look_to_look_is_the_same(law, monkeypatch):
    surface, half_space = rough(64, periodic=True)
    found = []
    for few in (1.0, 0.0):
        monkeypatch.setattr(near_rounds, "_FEW_NODES", few)
        found.append(rl.press(surface, half_space=half_space, law=law, depths=[0.5, 0.8, 0.6]))
    np.testing.assert_allclose(found[0].force, found[1].force, rtol=1e-6)
    assert np.array_equal(found[0].area_fraction, found[1].area_fraction)


@pytest.mark.parametrize("load", [Load(depth=0.8), Load(force=0.02)])
def test_the_gap_that_conjugate_gradients_foresee_is_that_of_their_pressures(load):
    plain = problem(rl.Unilateral())
    region = Region.everywhere(plain)
    nodes = InRegion(np.flatnonzero(plain.separation < 0.5))
    start = Carriers(nodes, 0.5 - plain.separation.flat[nodes])
    found = Search(region, start, load, replace(MIXED, rtol=1e-3, precision="float64")).foreseen()
    assert found.error <= 1e-3
    trial = region.trial(load, found.carriers, "float64")
    assert found.gap == pytest.approx(trial.gap, abs=3e-3 * trial.length_scale)
    assert found.gap[found.carriers.places] == pytest.approx(0.0, abs=1e-3 * trial.length_scale)


def test_surroundings_bear_the_force_less_what_others_bear():
    pulled = problem(LAWS[1])
    nodes = np.arange(pulled.separation.size)
    pulled = replace(pulled, shares=Shares(nodes, np.exp(-pulled.separation.ravel() / 0.3)))
    region = Region.everywhere(pulled)
    touching = InRegion(np.flatnonzero(pulled.separation < 0.5))
    carriers = region.bearing(Carriers(touching, np.ones(touching.size)))
    assert carriers.places.size == nodes.size
    trial = region.trial(Load(force=0.02), carriers, "float64")
    near = np.flatnonzero(pulled.separation < 1.0)
    around, load, found = region.around(trial, near)
    assert np.array_equal(near[found.places], touching)
    others = np.setdiff1d(nodes, near)
    beyond = trial.carriers.pressure[others].sum() * pulled.grid.cell_area
    assert load.force == pytest.approx(0.02 - beyond, rel=1e-12)
    again = around.trial(load, around.bearing(found), "float64")
    assert again.gap == pytest.approx(trial.gap[near], abs=1e-9)
    assert again.depth == pytest.approx(trial.depth, rel=1e-9)


@pytest.mark.parametrize("law", LAWS)
def test_shares_and_energies_in_blocks_are_those_of_all_nodes(law, monkeypatch):
    separation, rng = np.random.default_rng(1).uniform(0, 0.7, (9, 7)), np.random.default_rng(2)
    of_body, gap = Pull(law, separation, 0.01, (True, False)), rng.uniform(-0.1, 0.7, 63)
    taken = Shares(np.arange(0, 63, 3), rng.uniform(0, 1, 21))
    followed, _, gap_change = of_body.followed(gap, taken)
    energy = of_body.energy(gap)
    monkeypatch.setattr(pull, "_BLOCK_NODES", 10)
    in_blocks, change_in_blocks = of_body.followed_everywhere(gap, taken)
    assert np.array_equal(in_blocks.nodes, followed.nodes)
    assert np.array_equal(in_blocks.values, followed.values)
    assert change_in_blocks == gap_change
    assert of_body.energy(gap) == pytest.approx(energy, rel=1e-14)
    knowing = of_body.knowing(in_blocks.nodes)
    some = gap[in_blocks.nodes]
    assert np.array_equal(knowing.shares_at(some, in_blocks.nodes), followed.values)


def test_shares_take_others_at_nodes_that_are_not_listed():
    shares = Shares(np.array([1, 4, 5]), np.array([0.1, 0.2, 0.5]))
    changed = shares.but(np.array([0, 4, 9]), np.array([0.6, 0.7, 0.8]))
    assert changed.nodes.tolist() == [0, 1, 4, 5, 9]
    assert changed.values.tolist() == [0.6, 0.1, 0.7, 0.5, 0.8]
    assert Shares.none().but(np.array([3]), np.array([0.5])).values.tolist() == [0.5]
