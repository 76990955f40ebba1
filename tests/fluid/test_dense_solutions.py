"""Random gaps of 12 x 12 cells against dense solutions: mazes, islands, dead ends, chessboards."""

import numpy as np
import pytest

import roughline as rl
from random_cases import cases, seeds

N = 12
ALL = 5000
DENSE = 1e-8  # of the inflow: what rounding may leave in a dense solution of such gaps
SPREAD = 0.7  # deviation of the logarithms of open gaps


def scattered(rng, closed):
    """Closed cells here and there."""
    return rng.random((N, N)) >= rng.uniform(0.0, closed)


def chessboard(rng):
    """A chessboard, some fields of which are turned."""
    return (np.indices((N, N)).sum(axis=0) % 2 == 0) ^ (rng.random((N, N)) < rng.uniform(0.0, 0.5))


def islands(rng):
    """Rectangles of contact, some with a lake."""
    is_open = np.ones((N, N), bool)
    for _ in range(rng.integers(1, 9)):
        i, j, height, width = *rng.integers(0, N, 2), *rng.integers(1, 6, 2)
        is_open[i : i + height, j : j + width] = False
        is_open[i + 1 : i + height - 1, j + 1 : j + width - 1] = rng.random() < 0.5
    return is_open


def maze(rng):
    """Channels of one cell that wander, most of which end nowhere."""
    is_open = np.zeros((N, N), bool)
    for _ in range(rng.integers(1, 6)):
        i, j = rng.integers(0, 2), rng.integers(0, N)
        for _ in range(rng.integers(10, 60)):
            is_open[i, j] = True
            step = [(1, 0), (1, 0), (0, 1), (0, -1), (-1, 0)][rng.integers(5)]
            i, j = min(max(i + step[0], 0), N - 1), (j + step[1]) % N
    return is_open


def comb(rng):
    """Dead ends beside one another, joined at one side, with a hole or none at the other."""
    is_open = np.ones((N, N), bool)
    is_open[rng.integers(1, 5) :, 1::2] = False
    is_open[-rng.integers(1, 3) :] = False
    is_open[-3:, rng.integers(0, N)] = True
    return is_open if rng.random() < 0.7 else is_open.T


def gaps(first, number):
    """Random gaps, each of its own seed."""
    found = np.empty((number, N, N))
    for place, seed in enumerate(range(first, first + number)):
        rng = np.random.default_rng([40, seed])
        kinds = (lambda r: scattered(r, 0.45), chessboard, islands, maze, comb)
        is_open = kinds[seed % len(kinds)](rng)
        found[place] = np.where(is_open, np.exp(SPREAD * rng.normal(size=(N, N))), 0.0)
    return found


def inflows(gap, square, periodic):
    """Flow into many gaps at a time, along their second axis, from dense systems of equations.

    `square` is the width of a cell over its length.
    """
    many = len(gap)
    k = np.where(reached(gap > 0, periodic), gap**3, 0.0)
    matrix = np.zeros((many, N * N, N * N))
    here = np.arange(N * N).reshape(N, N)
    faces = [(k[:, :-1], k[:, 1:], here[:-1], here[1:], square)]
    faces.append((k[:, :, :-1], k[:, :, 1:], here[:, :-1], here[:, 1:], 1 / square))
    if periodic:
        faces.append((k[:, :, -1:], k[:, :, :1], here[:, -1:], here[:, :1], 1 / square))
    for first, second, i, j, ratio in faces:
        joined = (first > 0) & (second > 0)
        g = np.where(joined, 2 * ratio * first * second / np.where(joined, first + second, 1), 0.0)
        g, i, j = g.reshape(many, -1), i.ravel(), j.ravel()
        for a, b in ((i, j), (j, i)):
            matrix[:, a, a] += g
            matrix[:, a, b] -= g
    inlet, outlet = 2 * square * k[:, 0], 2 * square * k[:, -1]
    matrix[:, here[0], here[0]] += inlet
    matrix[:, here[-1], here[-1]] += outlet
    matrix[:, here.ravel(), here.ravel()] += (k == 0).reshape(many, -1)  # no fluid, no equation
    sources = np.zeros((many, N * N, 1))
    sources[:, here[-1], 0] = outlet
    return (np.linalg.solve(matrix, sources)[:, here[0], 0] * inlet).sum(axis=1)


def reached(is_open, periodic):
    """Cells from which fluid can come to the inlet or the outlet."""
    reach = np.zeros_like(is_open)
    reach[:, 0], reach[:, -1] = is_open[:, 0], is_open[:, -1]
    while True:
        wider = reach.copy()
        wider[:, 1:] |= reach[:, :-1]
        wider[:, :-1] |= reach[:, 1:]
        wider[:, :, 1:] |= reach[:, :, :-1]
        wider[:, :, :-1] |= reach[:, :, 1:]
        if periodic:
            wider[:, :, 0] |= reach[:, :, -1]
            wider[:, :, -1] |= reach[:, :, 0]
        wider &= is_open
        if (wider == reach).all():
            return reach
        reach = wider


def flowing(gap, periodic):
    """Whether there is a path from the inlet to the outlet, of many gaps."""
    only_inlet = np.concatenate([gap > 0, np.zeros((len(gap), 1, N), bool)], axis=1)
    return reached(only_inlet, periodic)[:, N - 1].any(axis=1)


@pytest.mark.parametrize("repeats", [True, False])
@pytest.mark.parametrize("along", ["x", "y"])
@seeds(50, cases(ALL, 20))
def test_dense_solutions_find_the_same(repeats, along, seeds):
    """Between ends, of gaps that repeat across the flow or not."""
    across, lengths = "y" if along == "x" else "x", (1.3, 0.7)
    square = 0.7 / 1.3 if along == "x" else 1.3 / 0.7
    sealed = 0
    for first in seeds[::500]:
        some = gaps(first, min(500, seeds.stop - first))
        turned = some if along == "x" else some.swapaxes(1, 2)
        expected = inflows(turned, square, repeats)
        for gap, inflow, flows in zip(some, expected, flowing(turned, repeats), strict=True):
            sides = across if repeats else "closed"
            found = rl.flow(gap, lengths, along=along, sides=sides)
            assert found.is_sealed != flows
            assert found.inflow == pytest.approx(inflow, rel=DENSE, abs=1e-12)
            assert found.imbalance < 1e-10
            sealed += not flows
    assert 0.2 < sealed / len(seeds) < 0.8


@seeds(50, ALL)
def test_five_thousand_gaps_beside_one_another(seeds):
    """All of them as one wide gap, 50 at a time, with a closed line between."""
    for first in seeds[::50]:
        some = gaps(first, 50)
        row = np.zeros((N, 50, N + 1))
        row[:, :, :N] = some.swapaxes(0, 1)
        flow = rl.flow(row.reshape(N, -1), (1.0, 50 * (N + 1) / N), sides="closed")
        inflow = flow.rates_x[0].reshape(50, N + 1).sum(axis=1)
        expected = inflows(some, 1.0, periodic=False)
        is_open = flowing(some, periodic=False)
        assert ((inflow > 0) == is_open).all()
        assert inflow == pytest.approx(np.where(is_open, expected, 0.0), rel=DENSE, abs=1e-12)
