"""Shares of a pull, the ramp over which it ends, and how shares are led to gaps."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

import roughline as rl
from roughline.halfspace.search.pull import Pull, Shares
from roughline.halfspace.search.rounds import Rounds, _RoundHistory

DUGDALE = rl.Dugdale(work_of_adhesion=0.02, range=0.2)
EXPONENTIAL = rl.Exponential(work_of_adhesion=0.02, range=0.2)


def test_a_law_is_its_numbers():
    for law in (rl.Dugdale, rl.Exponential):
        assert list(inspect.signature(law).parameters) == ["work_of_adhesion", "range"]
        assert repr(law(0.5, 2.0)) == f"{law.__name__}(work_of_adhesion=0.5, range=2.0)"
        assert law(0.5, 2.0) == law(0.5, 2.0)
        assert law(0.5, 2.0) != law(0.5, 3.0)
        assert hash(law(0.5, 2.0)) == hash(law(0.5, 2.0))
    assert rl.Dugdale(0.5, 2.0) != rl.Exponential(0.5, 2.0)
    assert list(inspect.signature(rl.Yielding).parameters) == ["hardness"]
    assert repr(rl.Yielding(0.5)) == "Yielding(hardness=0.5)"


def test_a_law_is_asked_for_no_more_than_what_it_is():
    members = {*vars(rl.ContactLaw), *rl.ContactLaw.__annotations__}
    assert len([name for name in members if not name.startswith("_")]) <= 12


def pull(law, shape=(9, 7), repeats=(True, False), compliance=0.01):
    separation = np.random.default_rng(1).uniform(0, 0.3, shape)
    return Pull(law, separation, compliance, repeats)


@pytest.mark.parametrize("repeats", [(True, True), (True, False), (False, False)])
@pytest.mark.parametrize("shape", [(9, 7), (1, 5), (4, 1), (2, 2)])
def test_the_ramp_is_what_the_separation_changes_by_across_half_a_cell(shape, repeats):
    of_body = pull(rl.Dugdale(2e-6, 0.2), shape, repeats)
    steps = np.zeros(shape)
    for axis in (0, 1):
        if shape[axis] == 1:
            continue
        if repeats[axis]:
            before, after = (np.roll(of_body.separation, by, axis) for by in (1, -1))
            steps += np.abs(after - before) / 2
        else:
            steps += np.abs(np.gradient(of_body.separation, axis=axis))
    nodes = np.arange(steps.size)
    expected = np.clip(steps.ravel() / 2, 4 * 1e-5 * 0.01, 0.2)
    np.testing.assert_allclose(of_body._ramp(nodes), expected, rtol=1e-14)


@pytest.mark.parametrize("law", [DUGDALE, EXPONENTIAL])
def test_the_energy_of_a_pull_is_the_integral_of_its_shares(law):
    of_body = pull(law)
    nodes = np.arange(of_body.separation.size)
    gaps = np.linspace(0, 40 * law.range, 200_001)
    shares = np.array([of_body.shares_at(np.full(nodes.size, gap), nodes) for gap in gaps[::10]])
    whole = np.trapezoid(shares, gaps[::10], axis=0) * law.largest_pull
    assert whole == pytest.approx(np.full(nodes.size, law.work_of_adhesion), rel=1e-3)
    for gap in (0.0, 0.5 * law.range, 0.95 * law.range, 1.1 * law.range):
        at = int(np.searchsorted(gaps[::10], gap))
        left = np.trapezoid(shares[at:], gaps[::10][at:], axis=0).sum() * law.largest_pull
        energy = of_body.energy(np.full(nodes.size, gaps[::10][at]))
        assert energy == pytest.approx(-left, rel=2e-3)


def test_shares_are_kept_at_nodes_alone():
    shares = Shares(np.array([1, 4, 5, 90]), np.array([0.1, 0.0, 0.5, 1.0]))
    assert shares.at(np.array([0, 1, 5, 6, 90, 95])).tolist() == [0, 0.1, 0.5, 0, 1.0, 0]
    assert shares.at(np.array([], int)).size == 0
    assert Shares.none().at(np.arange(3)).tolist() == [0, 0, 0]
    assert shares.above_zero.nodes.tolist() == [1, 5, 90]
    assert shares.field(91).nonzero()[0].tolist() == [1, 5, 90]
    assert shares.but(np.array([4]), np.array([0.7])).values.tolist() == [0.1, 0.7, 0.5, 1.0]
    rng = np.random.default_rng(3)
    for few, many in ((3, 400), (400, 3), (200, 300)):
        nodes, wanted = (np.sort(rng.choice(500, size, replace=False)) for size in (few, many))
        found = Shares(nodes, 1.0 + nodes).at(wanted)
        np.testing.assert_array_equal(found, np.where(np.isin(wanted, nodes), 1.0 + wanted, 0.0))


def test_nodes_beyond_reach_are_not_listed():
    of_body = pull(DUGDALE)
    gap = np.full(of_body.separation.size, 3 * DUGDALE.range)
    gap[[4, 7]] = 0.1, 0.0
    rounds = Rounds(of_body, Shares.none()).then(gap)
    assert rounds.shares.nodes.tolist() == [4, 7]
    assert rounds.shares.values[1] == 1.0


@pytest.mark.parametrize("law", [DUGDALE, EXPONENTIAL])
def test_rounds_end_where_shares_are_those_of_their_gap(law):
    """Gaps that fall with the shares of all nodes; plain rounds go on for much longer."""
    of_body, rng = pull(law), np.random.default_rng(2)
    size = of_body.separation.size
    apart, closes = rng.uniform(0.1, 0.3, size), rng.uniform(0, 1, (size, size))
    closes *= 0.12 / closes.sum(axis=1).max()

    def gap_of(shares):
        return apart - closes @ shares.field(size)

    rounds, count = Rounds(of_body, Shares.none()), 0
    while count < 40:
        rounds, count, obeyed = rounds.then(gap_of(rounds.shares)), count + 1, rounds.shares
        if rounds.misfit <= 1e-12:
            break
    assert count < 20
    nodes = np.arange(size)
    expected = of_body.shares_at(gap_of(obeyed), nodes)
    assert obeyed.field(size) == pytest.approx(expected, abs=1e-10)
    plain = Shares.none()
    for _ in range(count):
        plain = of_body.followed(gap_of(plain), plain)[0]
    _, _, misfit = of_body.followed(gap_of(plain), plain)
    assert misfit > 1e-11


def test_nodes_that_join_a_history_have_rested_before():
    """The extrapolation is that of all nodes together, whichever moved first."""
    nodes, rng = np.arange(6), np.random.default_rng(5)
    taken, history, every = Shares(nodes, rng.uniform(0.2, 0.8, 6)), _RoundHistory.none(), []
    for moving in ([0, 1], [0, 1, 3], [1, 3, 4]):
        moved = np.zeros(6)
        moved[moving] = rng.uniform(-0.05, 0.05, len(moving))
        followed = Shares(nodes, taken.values + moved)
        changed = Shares(np.array(moving), moved[moving])
        history = history.joined_by(taken, followed, changed)
        every.append((followed.values, moved))
        taken = history.extrapolated(followed)
    values, moves = (np.array(each) for each in zip(*every, strict=True))
    steps, *_ = np.linalg.lstsq(np.diff(moves, axis=0).T, moves[-1], rcond=1e-10)
    expected = np.clip(values[-1] - steps @ np.diff(values, axis=0), 0, 1)
    assert taken.values[[0, 1, 3, 4]] == pytest.approx(expected[[0, 1, 3, 4]], abs=1e-12)
