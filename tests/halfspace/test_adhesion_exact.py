"""Bodies that stick, against exact solutions: spheres of every range, discs and waves."""

from __future__ import annotations

import numpy as np
import pytest

import roughline as rl
from roughline.exact import adhesion
from roughline.exact.pulled_sphere import PulledSphere

# A sphere in the units of JKR: pi w R = 1, lengths over (pi w R² / K)^(1/3) = 1, K = 4 E* / 3 = 1.
E_STAR, WORK = 0.75, 1 / np.pi


def maugis(transition):
    """The exact sphere of this transition parameter."""
    return adhesion.MaugisSphere(1.0, WORK, 2 * WORK / transition, E_STAR)


def sphere(points, side):
    x = side / points / 2 * (2 * np.arange(points) + 1 - points)
    return rl.Surface(-(x[:, None] ** 2 + x**2) / 2, (side, side))


def pulled_off(transition, points, side, law=rl.Dugdale):
    """The curve of a sphere that is brought to rest and pulled off."""
    of_body = law(WORK, 2 * WORK / transition)
    body = sphere(points, side)
    return rl.press(body, E_star=E_STAR, law=of_body, forces=[0.0, -3.0], throw=False)


# Side that holds the reach, and the error of the pull-off on 72 points.
SPHERES = {
    0.05: (12.0, 2e-3),
    0.1: (8.4, 1e-3),
    0.2: (6.4, 1e-3),
    0.5: (4.6, 2e-3),
    1.0: (3.6, 2e-3),
}


@pytest.mark.parametrize("transition", SPHERES)
def test_a_sphere_is_pulled_off_as_maugis_has_it(transition):
    side, most = SPHERES[transition]
    exact = maugis(transition).pull_off_force
    error = pulled_off(transition, 72, side).pull_off_force / exact - 1
    assert abs(error) < most


@pytest.mark.parametrize(
    ("points", "most"),
    [((24, 36, 72), 4e-3), ((36, 72, 144), 1e-3)],  # of the second order, so four times as much
)
def test_the_pull_off_is_within_half_a_per_cent_at_forty_cells(points, most):
    exact = maugis(1.0).pull_off_force
    errors = [pulled_off(1.0, n, 3.4).pull_off_force / exact - 1 for n in points]
    assert abs(errors[2]) < most  # 19 and 38 cells per contact radius; asked are 5e-3
    rate = np.polyfit(np.log(points), np.log(np.abs(errors)), 1)[0]
    assert rate < -1.5


@pytest.mark.parametrize("points", [96, 144])
def test_two_ranges_extrapolate_to_jkr(points):
    """As the square of the range, which halves from the first to the second."""
    first, second = (pulled_off(t, points, 3.45).pull_off_force for t in (1.0, 2.0))
    assert (4 * second - first) / 3 == pytest.approx(-1.5, rel=0.015)


@pytest.mark.parametrize("transition", [0.2, 0.5, 1.0])
def test_force_and_radii_are_maugiss_on_both_branches(transition):
    exact, side = maugis(transition), 1.2 * SPHERES[transition][0]
    depths = np.array([0.4, 1.0, 0.4, 0.0, -0.2])
    off = {}
    for n in (36, 72):
        law = rl.Dugdale(WORK, 2 * WORK / transition)
        curve = rl.press(sphere(n, side), E_star=E_STAR, law=law, depths=depths)
        touching = np.sqrt(curve.area_fraction_corrected / np.pi) * side
        reach = np.sqrt((curve.area_fraction + curve.pulling_fraction) / np.pi) * side
        found = []
        for i, depth in enumerate(depths):
            m = exact.at_depth(depth)
            a = exact.radius(m)
            found.append([curve.force[i] - exact.force(m), touching[i] - a, reach[i] - m * a])
        off[n] = np.abs(found).max(axis=0)
        # nothing jumps here: the grid alone would make two branches
        assert abs(curve.force[0] - curve.force[2]) < 3e-6
    force, touching, reach = off[72]
    cell = side / 72
    assert force < 5e-3
    assert touching < 0.25 * cell  # of the outline, in cells
    assert reach < 0.15 * cell
    assert force < off[36][0] / 2


def test_a_sphere_jumps_in_at_its_range_and_is_let_go_later():
    """It is pulled across a gap after that, and on the way back where it was not before."""
    transition = 0.5
    reach = 2 * WORK / transition
    exact = PulledSphere(1.0, WORK, reach, E_STAR)
    let_go = float(exact.depth(exact.smallest_reach))
    between, pulled = (let_go - reach) / 2, np.array([-0.97, -0.9, -0.97]) * reach
    depths = np.array([1.05 * let_go, between, *pulled, between, 1.05 * let_go])
    law = rl.Dugdale(WORK, reach)
    force = rl.press(sphere(128, 4.0), E_star=E_STAR, law=law, depths=depths).force
    there = np.array([float(exact.force(exact.reach(depth))) for depth in depths[2:6]])
    # the ramp lets a few cells be pulled before the range is reached
    assert abs(force[:2]).max() < 1e-3 * abs(there).min()
    np.testing.assert_allclose(force[2:6], there, rtol=5e-3)
    assert force[6] == 0


def test_the_limit_of_a_long_range_is_bradleys_for_every_pull():
    """A sphere that hardly deforms: -2 pi w R, whatever the law."""
    for law, transition, side in ((rl.Dugdale, 0.02, 18.0), (rl.Exponential, 0.02, 46.0)):
        curve = pulled_off(transition, 96, side, law)
        assert curve.pull_off_force == pytest.approx(-2, rel=0.03), law


def test_an_exponential_pull_lies_between_bradleys_and_jkrs_limit():
    forces = [
        pulled_off(t, 72, s, rl.Exponential).pull_off_force for t, s in ((0.2, 8.0), (0.5, 6.0))
    ]
    assert -2.0 < forces[0] < forces[1] < -1.5
    # at an equal largest pull and work, the tail of the pull holds on for longer
    assert forces[1] == pytest.approx(maugis(0.5).pull_off_force, rel=0.05)


@pytest.mark.parametrize("zone", [16.0, 8.0])  # cells of the coarser grid
def test_a_disc_is_pulled_off_as_its_range_has_it(zone):
    law, errors = rl.Dugdale(0.01, np.sqrt(np.pi * 0.01 * zone * 2.4 / 96)), []
    for n in (96, 192):
        x = 1.2 * (2 * np.arange(n) + 1 - n) / n
        disc = rl.Surface(np.where(x[:, None] ** 2 + x**2 < 1, 0.0, -10.0), (2.4, 2.4))
        curve = rl.press(disc, E_star=1.0, law=law, forces=[1.0, -10.0], throw=False)
        radius = curve.stiffness[0] / 2  # of the disc that the cells are
        exact = adhesion.ranged_punch_pull_off(radius, 0.01, law.range, 1.0)
        errors.append(curve.pull_off_force / exact - 1)
    assert abs(errors[1]) < 0.015
    # cells err at a rim by their size: this is the first order
    assert abs(2 * errors[1] - errors[0]) < 3e-3


def test_a_wave_comes_to_johnsons_as_the_range_falls():
    """Least mean pressure of a wave that sticks, by extrapolation in the range."""
    amplitude, work, n = 0.02, 2e-4, 512
    half_widths = np.linspace(0.02, 0.2, 2000)
    exact = adhesion.wave_mean_pressure(half_widths, amplitude, 1.0, work, 1.0).min()
    heights = amplitude * np.cos(2 * np.pi * np.arange(n) / n)[:, None]
    wave = rl.Surface(heights, (1.0, 1.0 / n))
    found = []
    for zone in (16.0, 8.0):
        law = rl.Dugdale(work, np.sqrt(np.pi * work * zone / n))
        forces = np.array([0.3 * np.pi * amplitude, -1.0]) * wave.area
        half_space = rl.Homogeneous(1.0, periodic=True)
        curve = rl.press(wave, half_space=half_space, law=law, forces=forces, throw=False)
        found.append(curve.pull_off_force / wave.area)
    assert found[1] == pytest.approx(exact, rel=0.01)
    # the error falls as the square of the range, which is as the zone
    assert 2 * found[1] - found[0] == pytest.approx(exact, rel=4e-3)
