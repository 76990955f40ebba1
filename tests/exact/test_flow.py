"""Exact permeances against quadrature, each other and published numbers."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughline.exact import flow

QUADRATURE = 1e-8
PUBLISHED = 5e-4  # half a unit of the last digit of Perrins' table, relative


def test_strips_of_one_gap_are_flat_plates():
    gaps = np.full(7, 0.3)
    assert flow.uniform(0.3) == pytest.approx(0.027)
    assert flow.in_series(gaps) == pytest.approx(flow.uniform(0.3))
    assert flow.in_parallel(gaps) == pytest.approx(flow.uniform(0.3))


def test_waves_and_wedges_are_strips_by_quadrature():
    mean, amplitude = 0.7, 0.6
    wave = lambda t: mean * (1 + amplitude * math.cos(t))  # noqa: E731
    cubes = quad(lambda t: wave(t) ** 3, 0, 2 * math.pi)[0] / (2 * math.pi)
    inverses = quad(lambda t: wave(t) ** -3, 0, 2 * math.pi)[0] / (2 * math.pi)
    assert flow.along_a_wave(mean, amplitude) == pytest.approx(cubes, rel=QUADRATURE)
    assert flow.across_a_wave(mean, amplitude) == pytest.approx(1 / inverses, rel=QUADRATURE)
    falling = quad(lambda s: (0.9 - 0.6 * s) ** -3, 0, 1)[0]
    assert flow.wedge(0.9, 0.3) == pytest.approx(1 / falling, rel=QUADRATURE)
    assert flow.wedge(0.3, 0.9) == flow.wedge(0.9, 0.3)
    assert flow.wedge(0.5, 0.5) == pytest.approx(flow.uniform(0.5))


@pytest.mark.parametrize(
    ("radius", "permeance"), [(0.1, 0.939082), (0.2, 0.776714), (0.3, 0.558485), (0.4, 0.322092)]
)
def test_discs_in_a_square_cell(radius, permeance):
    found = flow.disc_in_a_square_cell(radius, 1.0)
    assert found == pytest.approx(permeance, abs=6e-7)
    assert flow.disc_in_a_square_cell(radius, 2.0) == pytest.approx(8 * found)
    assert flow.disc_in_a_square_cell(radius, 1.0, terms=60) == pytest.approx(found, rel=1e-13)


@pytest.mark.parametrize(
    ("share", "conductance"),
    [(0.1, 1.222), (0.2, 1.500), (0.3, 1.860), (0.4, 2.351), (0.5, 3.080), (0.6, 4.342)],
)
def test_discs_that_bar_the_flow_are_dual_to_perfect_conductors(share, conductance):
    """Perrins, McKenzie and McPhedran's table of perfectly conducting cylinders."""
    barred = flow.disc_in_a_square_cell(math.sqrt(share / math.pi), 1.0)
    assert 1 / barred == pytest.approx(conductance, rel=PUBLISHED)


def test_small_discs_bar_twice_their_area():
    radius = 1e-3
    assert 1 - flow.disc_in_a_square_cell(radius, 1.0) == pytest.approx(
        2 * math.pi * radius**2, rel=1e-5
    )


def test_discs_that_nearly_touch_leave_the_gap_between_two_of_them():
    """The neck resists as int dx / (2 (1/2 - sqrt(R² - x²))), pi sqrt(2 R / (1/2 - R)) / 2."""
    necks = [math.pi / 2 * math.sqrt(2 * (0.5 - room) / room) for room in (4e-3, 1e-3)]
    found = [1 / flow.disc_in_a_square_cell(0.5 - room, 1.0, terms=120) for room in (4e-3, 1e-3)]
    assert np.diff(found) == pytest.approx(np.diff(necks), rel=1e-3)


def test_the_dual_of_strips_in_series_is_strips_in_parallel():
    gaps = np.random.default_rng(3).uniform(0.2, 2.0, 9)
    dual = flow.dual_gap(gaps, 0.7)
    assert flow.dual_permeance(flow.in_series(gaps), 0.7) == pytest.approx(flow.in_parallel(dual))
    assert flow.dual_gap(dual, 0.7) == pytest.approx(gaps)


def test_a_gap_that_is_its_own_dual():
    chessboard = np.array([[0.2, 0.8], [0.8, 0.2]])
    assert flow.self_dual(chessboard) == pytest.approx(0.4**3)
    reference = 0.4  # its dual is the same chessboard, moved by one field
    assert flow.dual_permeance(flow.self_dual(chessboard), reference) == pytest.approx(0.4**3)


def test_bounds_hold_between_series_and_parallel():
    gap = np.random.default_rng(5).lognormal(0.0, 0.5, (6, 8))
    low, high = flow.bounds(gap)
    assert flow.in_series(gap) < low < flow.self_dual(gap) < high < flow.in_parallel(gap)
    strips = np.repeat([[0.3], [0.5]], 4, axis=1)
    assert flow.bounds(strips) == pytest.approx([flow.in_series([0.3, 0.5])] * 2)
    assert flow.bounds(strips.T) == pytest.approx([flow.in_parallel([0.3, 0.5])] * 2)
    walled = gap.copy()
    walled[2] = 0.0
    assert flow.bounds(walled) == (0.0, 0.0)


@pytest.mark.parametrize(
    "call",
    [
        lambda: flow.uniform(0.0),
        lambda: flow.in_series([1.0, -1.0]),
        lambda: flow.along_a_wave(1.0, 1.0),
        lambda: flow.across_a_wave(math.nan, 0.1),
        lambda: flow.wedge(1.0, math.inf),
        lambda: flow.disc_in_a_square_cell(0.5, 1.0),
        lambda: flow.dual_gap(0.0, 1.0),
    ],
)
def test_senseless_gaps_are_refused(call):
    with pytest.raises(ValueError, match="a positive, finite number is needed"):
        call()
