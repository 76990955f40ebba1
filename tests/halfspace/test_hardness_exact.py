"""Bodies that yield, against exact solutions and limits."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

import roughline as rl
from roughline.exact import yielding

pytestmark = pytest.mark.usefixtures("either_search")

R, HARDNESS = 10.0, 0.02  # of a ball on a square of side 1, E* = 1
YIELD_FORCE = yielding.ball_yield_force(R, 1.0, HARDNESS)  # at a_y = 0.314


def centred(n):
    """Distance of each cell from the axis, which runs through a cell of an odd grid."""
    x = (np.arange(n) - (n - 1) / 2) / n
    return np.hypot(x[:, None], x)


def ball(n, radius=R):
    return rl.Surface(-(centred(n) ** 2) / (2 * radius), (1.0, 1.0))


def pressed(surface, forces, hardness=HARDNESS, **options):
    return rl.press(surface, E_star=1.0, forces=forces, hardness=hardness, fields=True, **options)


def rate(sizes, errors):
    return -np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0]


def test_a_ball_yields_first_in_its_middle_under_the_force_of_theory(judged):
    sizes, errors = [17, 33, 65], []
    for n in sizes:
        surface = ball(n)

        def excess(force, surface=surface):
            return (
                rl.press(surface, E_star=1.0, forces=[force], fields=True, rtol=1e-9)
                .fields[0]
                .pressure.max()
                - HARDNESS
            )

        first = brentq(excess, 0.8 * YIELD_FORCE, 1.2 * YIELD_FORCE, rtol=1e-6)
        curve = pressed(surface, [first * (1 - 1e-4), first * (1 + 1e-4)])
        assert not curve.fields[0].plastic.any()
        assert np.argwhere(curve.fields[1].plastic).tolist() == [[n // 2, n // 2]]
        assert curve.indentation[0] == 0 < curve.indentation[1]
        errors.append(first / YIELD_FORCE - 1)
        judged("ball with a hardness", "force of first yield", n, abs(errors[-1]))
    assert rate(sizes, errors) > 1.5
    assert abs(errors[-1]) < 2e-3
    radius = np.sqrt(curve.area_fraction_corrected[1] / np.pi)
    assert radius == pytest.approx(yielding.ball_yield_radius(R, 1.0, HARDNESS), rel=0.02)


def test_a_ball_far_beyond_yield_bears_its_hardness():
    """F / (H A) rises to 1; the contact is where a knife at the plane would cut the ball."""
    surface = ball(129, radius=1.0)
    hardnesses = np.array([0.1, 0.03, 0.01, 0.003])
    shares = []
    for hardness in hardnesses:
        curve = pressed(surface, [0.2 * hardness], hardness)
        shares.append(curve.force[0] / (hardness * curve.area_fraction[0]))
        assert shares[-1] <= 1
    assert (np.diff(shares) >= 0).all()
    assert shares[-1] > 0.98
    assert curve.plastic_fraction[0] > 0.97
    # d = r² / 2 R of the rim, sprung by about H a / E*
    assert curve.depth[0] == pytest.approx(0.2 / (2 * np.pi), rel=0.05)


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_a_disc_that_yields_at_its_rim(share, judged):
    disc = yielding.YieldingDisc(0.3, 1.0, HARDNESS)
    c, sizes = share * disc.radius, [33, 65, 129]
    errors = []
    for n in sizes:
        r = centred(n)
        drawn = r <= disc.radius
        surface = rl.Surface(np.where(drawn, 0.0, -10.0), (1.0, 1.0))
        # the disc is drawn by whole cells: it bears as much as its area does
        scale = drawn.mean() / (np.pi * disc.radius**2)
        curve = pressed(surface, [scale * disc.force(c)])
        errors.append(
            [
                curve.depth[0] / disc.depth(c) - 1,
                curve.stiffness[0] / disc.stiffness(c) - 1,
                curve.unloading_stiffness[0] / disc.unloading_stiffness - 1,
                curve.work[0] / disc.work(c) - 1,
                curve.plastic_fraction[0] / (1 - share**2) - 1,
            ]
        )
    errors = np.abs(errors)
    solution = f"disc with a hardness, elastic within {share} of its radius"
    quantities = ("depth", "stiffness", "unloading stiffness", "work", "yielded share")
    for n, row in zip(sizes, errors, strict=True):
        for quantity, error in zip(quantities, row, strict=True):
            judged(solution, quantity, n, error)
    inner = r < 0.8 * c
    expected = disc.pressure(c, r)
    assert np.abs(curve.fields[0].pressure - expected)[inner].max() < 0.03 * HARDNESS
    assert curve.fields[0].plastic[drawn & (r > c + 1.5 / n)].all()
    assert not curve.fields[0].plastic[r < c - 1.5 / n].any()
    assert rate(sizes, errors[:, 0]) > 1
    assert (errors[-1, :4] < 5e-3).all()
    assert errors[-1, 4] < 0.03  # a ring of whole cells


@pytest.mark.parametrize("periodic", [False, True])
def test_a_square_punch_yields_from_its_corners_inwards(periodic):
    n = 24
    heights = np.full((32, 32), -1.0)
    heights[4:28, 4:28] = 0.0
    surface = rl.Surface(heights, (32.0, 32.0))
    most = HARDNESS * n**2
    curve = pressed(surface, most * np.append(np.linspace(0.1, 0.9, 17), 0.999), periodic=periodic)
    plastic = [fields.plastic[4:28, 4:28] for fields in curve.fields if fields.plastic.any()]
    corners = np.zeros((n, n), dtype=bool)
    corners[[0, 0, -1, -1], [0, -1, 0, -1]] = True
    assert (plastic[0] == corners).all()
    x = np.abs(np.arange(n) - (n - 1) / 2)
    inside = np.maximum.outer(x, x)
    for lighter, heavier in pairwise(plastic):
        assert (heavier | ~lighter).all()
        assert inside[heavier].min() <= inside[lighter].min()
    assert plastic[-1].mean() > 0.9
    assert (curve.area_fraction == (n / 32) ** 2).all()
    assert (np.diff(curve.stiffness) < 1e-9 * curve.stiffness[0]).all()
    assert np.ptp(curve.unloading_stiffness) < 1e-6 * curve.unloading_stiffness[0]
    # beyond what it bears, the surroundings have to
    beyond = pressed(surface, [1.1 * most], periodic=periodic)
    assert beyond.indentation[0] > 0.9
    assert beyond.fields[0].contact[4:28, 4:28].all()
    assert beyond.area_fraction[0] > (n / 32) ** 2


def test_very_soft_bodies_touch_over_the_bearing_area():
    """As H goes to zero nothing springs: what is higher than the plane bears H."""
    surface = rl.SelfAffine(hurst=0.6, rms_height=1.0).surface(24, 3)
    for periodic in (False, True):
        hardness = 1e-4 * surface.rms_slope
        cells = 100.4  # the last one bears what is left
        force = cells / 24**2 * hardness * surface.area
        curve = rl.press(
            surface, E_star=1.0, hardness=hardness, forces=[force], periodic=periodic, fields=True
        )
        highest = np.sort(surface.heights, axis=None)[::-1]
        assert (curve.fields[0].contact == (surface.heights >= highest[100])).all()
        assert curve.plastic_fraction[0] == pytest.approx(100 / 101)
        dents = curve.fields[0].indentation
        expected = np.maximum(surface.heights - highest[100], 0)
        assert dents == pytest.approx(expected, abs=1e-3)  # of the rms height, elastic


@pytest.mark.parametrize(("n", "counts"), [(16, (4, 16, 64)), (32, (8, 32, 128))])
def test_work_is_the_integral_of_the_force(n, counts):
    """The force is a line between changes of the sets: trapezia err by the square of the steps."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 3)
    hardness = 0.3 * surface.rms_slope
    force = 0.3 * hardness * surface.area
    errors = []
    for count in counts:
        up = np.linspace(0, force, count + 1)[1:]
        curve = rl.press(surface, E_star=1.0, hardness=hardness, forces=[*up, *up[-2::-1], 0.0])
        depth, load = np.append(0, curve.depth), np.append(0, curve.force)
        done = np.append(0, np.cumsum((load[1:] + load[:-1]) / 2 * np.diff(depth)))[1:]
        errors.append(np.abs(done - curve.work).max() / curve.work.max())
    assert np.polyfit(np.log(counts), np.log(errors), 1)[0] < -1.5
    assert errors[-1] < 3e-4
    assert curve.dissipated_work[-1] > 0.2 * curve.work.max()


@pytest.mark.parametrize("periodic", [False, True])
def test_under_a_given_depth_all_of_the_contact_may_be_plastic(periodic):
    """Whatever the rounding of the first guess, of which no node is plastic yet."""
    heights = np.ones((3, 3))
    heights[1, 1] = 0.0
    surface = rl.Surface(heights, (1.0, 1.0))
    for hardness in np.linspace(1.0, 2.0, 20) / 20:
        curve = rl.press(surface, E_star=1.0, hardness=hardness, depths=[0.5], periodic=periodic)
        assert curve.plastic_fraction[0] == 1
        assert curve.force[0] == pytest.approx(hardness * 8 / 9, rel=1e-12)
        assert curve.stiffness[0] == 0 < curve.unloading_stiffness[0]


@pytest.mark.parametrize("share", [1e-6, 1e-12, 1e-17, 1e-60])
def test_dented_bodies_all_but_apart(share):
    """What is left of a force by rounding, too, is a force."""
    surface = rl.SelfAffine(hurst=0.6, rms_height=1.0).surface(24, 3)
    hardness = 0.1 * surface.rms_slope
    force = 0.2 * hardness * surface.area
    curve = rl.press(surface, E_star=1.0, hardness=hardness, forces=[force, share * force, 0.0])
    assert (curve.force == [force, share * force, 0.0]).all()
    assert curve.depth[1] == pytest.approx(curve.depth[2], abs=10 * share)
