"""Laws of the reduced model: exact, convex, reversible, and honest about few springs."""

from functools import partial

import numpy as np
import pytest
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import random_surfaces
import roughline as rl

ROUNDING = 1e-11

laws = partial(random_surfaces.laws, few=15, many=60)

profiles = hnp.arrays(
    np.float64,
    st.integers(2, 200),
    elements=st.floats(-3, 3).map(lambda x: round(x, 2)),  # rounded: heights repeat
).filter(np.ptp)


def brute_force(heights, depth, spring_stiffness):
    pressed = np.maximum(0.0, depth - (heights.max() - heights))
    return spring_stiffness * pressed.sum(), spring_stiffness * np.count_nonzero(pressed)


@laws(profiles, st.floats(1e-3, 10))
def test_the_curve_is_the_sum_over_springs(heights, depth):
    curve = rl.press(rl.Line(heights, length=2.0), E_star=3.0, depths=[depth])
    force, stiffness = brute_force(heights, depth, 3.0 * 2.0 / heights.size)
    assert curve.force[0] == pytest.approx(force, rel=ROUNDING, abs=1e-13)
    assert curve.stiffness[0] == pytest.approx(stiffness, rel=ROUNDING)


@laws(profiles, st.floats(1e-3, 10))
def test_force_control_inverts_depth_control(heights, depth):
    line = rl.Line(heights, length=2.0)
    by_depth = rl.press(line, E_star=3.0, depths=[depth])
    by_force = rl.press(line, E_star=3.0, forces=by_depth.force)
    assert by_force.depth[0] == pytest.approx(depth, rel=1e-9)


@laws(profiles, st.floats(1e-3, 10))
def test_springs_touch_under_a_force_in_the_order_of_their_separations(heights, force):
    """The least count for which one more spring would need a larger force, of all sorted."""
    curve = rl.press(rl.Line(heights, length=2.0), E_star=3.0, forces=[force])
    separations, spring = np.sort(heights.max() - heights), 3.0 * 2.0 / heights.size
    touch_forces = spring * (
        np.arange(heights.size) * separations - separations.cumsum() + separations
    )
    near = np.isclose(touch_forces, force, rtol=1e-9, atol=1e-13)
    fewest = np.count_nonzero((touch_forces < force) & ~near)
    most = np.count_nonzero((touch_forces < force) | near)
    assert fewest <= round(curve.stiffness[0] / spring) <= most


@laws(profiles)
def test_force_is_convex_and_its_slope_is_the_stiffness(heights):
    depths = np.linspace(0.01, 1.5 * np.ptp(heights), 80)
    curve = rl.press(rl.Line(heights, length=2.0), E_star=3.0, depths=depths)
    slopes = np.diff(curve.force) / np.diff(depths)
    slack = 1e-9 * curve.stiffness[-1]
    assert (slopes >= curve.stiffness[:-1] - slack).all()
    assert (slopes <= curve.stiffness[1:] + slack).all()
    assert curve.stiffness[-1] == pytest.approx(3.0 * 2.0)  # all springs


@laws(profiles, st.floats(-9, 9), st.floats(-9, 9), st.floats(-9, 9))
def test_units_mirrors_and_order_do_not_matter(heights, height, length, modulus):
    height, length, modulus = 10.0 ** np.array([height, length, modulus])
    forces = np.array([0.1, 1.0]) * np.ptp(heights)
    one = rl.press(rl.Line(heights, 1.0), E_star=1.0, forces=forces)
    for same in (heights[::-1], np.roll(heights, 3), np.sort(heights)):
        line = rl.Line(same * height + 7 * height, length)
        other = rl.press(line, E_star=modulus, forces=forces * height * length * modulus)
        assert other.depth == pytest.approx(one.depth * height, rel=1e-8)


@pytest.mark.parametrize("n", [2**12, 2**20])
def test_a_long_line_is_exact_too(n):
    line = rl.SelfAffine(hurst=0.8, rms_height=1.0).line(n, 7)
    curve = rl.press(line, E_star=1.0, n_loads=30)
    for depth, force, stiffness in zip(curve.depth, curve.force, curve.stiffness, strict=True):
        expected = brute_force(line.heights, depth, 1 / n)
        assert (force, stiffness) == pytest.approx(expected, rel=1e-9)


def test_fewer_than_ten_springs_are_marked():
    line = rl.SelfAffine(hurst=0.8, rms_height=1.0).line(4096, 7)
    curve = rl.press(line, E_star=1.0, forces=np.geomspace(1e-9, 1, 40))
    springs = np.round(curve.stiffness * 4096)
    assert (curve.resolved == (springs >= 10)).all()
    assert 0 < np.count_nonzero(curve.resolved) < 40


def test_on_a_plateau_all_springs_come_at_once():
    line = rl.Line([1.0, 1.0, 1.0, 0.0], length=4.0)
    curve = rl.press(line, E_star=1.0, depths=[1e-9, 1.0, 1.5])
    assert curve.stiffness.tolist() == [3, 3, 4]
    assert curve.force == pytest.approx([3e-9, 3.0, 5.0])
    assert rl.press(line, E_star=1.0, forces=[3.0, 5.0]).depth == pytest.approx([1.0, 1.5])


def test_a_line_whose_load_is_taken_off_is_where_it_first_touches():
    line = rl.Line([1.0, 0.8, 0.3, 0.0], length=4.0)
    curve = rl.press(line, E_star=1.0, forces=[3.0, 0.0])
    assert curve.depth[1] == curve.force[1] == curve.stiffness[1] == 0


@pytest.mark.parametrize("decimals", [None, 3])  # rounded: thousands of heights repeat
def test_a_long_line_equals_the_sort_of_all_its_springs(decimals):
    line = rl.SelfAffine(hurst=0.6, rms_height=1.0).line(2**18, 5)
    heights = line.heights if decimals is None else np.round(line.heights, decimals)
    line = rl.Line(heights, length=2.0)
    separations = np.sort(heights.max() - heights)
    sums = np.append(0.0, np.cumsum(separations))
    spring = 3.0 * line.spacing
    depths = np.geomspace(1e-4, 1.5 * separations[-1], 300)
    count = np.searchsorted(separations, depths, side="left")
    force = spring * (count * depths - sums[count])
    curve = rl.press(line, E_star=3.0, depths=depths)
    assert (curve.stiffness == spring * count).all()
    assert curve.force == pytest.approx(force, rel=ROUNDING)
    back = rl.press(line, E_star=3.0, forces=force)
    assert back.depth == pytest.approx(depths, rel=1e-10)
    assert back.stiffness == pytest.approx(curve.stiffness, rel=1e-12)


def test_one_spring_and_all_of_them():
    line = rl.Line(np.array([0.0, 1.0, 0.25]), length=3.0)
    curve = rl.press(line, E_star=1.0, forces=[0.5, 1e3])
    assert curve.depth == pytest.approx([0.5, (1e3 + 1.75) / 3])
    assert (curve.stiffness == [1.0, 3.0]).all()
