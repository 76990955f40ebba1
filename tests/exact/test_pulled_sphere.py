"""The sphere that is pulled before it touches: Bradley's limit, Maugis' end, and its energy."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipe

from roughline.exact.pulled_sphere import PulledSphere

R, E_STAR, WORK = 2.0, 3.0, 0.02


def sphere(transition):
    """A sphere of Maugis' parameter lambda = 2 sigma_0 (R / (pi w K²))^(1/3)."""
    pull = transition / 2 * math.cbrt(math.pi * WORK * (4 * E_STAR / 3) ** 2 / R)
    return PulledSphere(R, WORK, WORK / pull, E_STAR)


def test_a_stiff_sphere_is_pulled_as_bradley_says():
    """F = -2 pi w R (1 + d / h_0), reached as 1 / E*."""
    off = []
    for E_star in (1e4, 1e5):
        body = PulledSphere(R, WORK, 0.01, E_star)
        rigid = -2 * math.pi * WORK * R * (1 - 0.004 / 0.01)
        off.append(body.force(body.reach(-0.004)) / rigid - 1)
    assert 0 < off[1] < 1e-3
    assert off[0] / off[1] == pytest.approx(10, rel=0.05)


@pytest.mark.parametrize("transition", [0.1, 0.5, 0.9])
def test_the_gap_is_the_range_at_the_reach_and_smaller_within(transition):
    """Displacement of an even pressure p on a disc, 4 p c / (pi E*) times E(r / c)."""
    body = sphere(transition)
    c = 0.9 * body.largest_reach
    r = np.linspace(0, c, 40)
    lifted = 4 * body.pull * c / (math.pi * E_STAR) * ellipe((r / c) ** 2)
    gap = r**2 / (2 * R) - body.depth(c) - lifted
    assert gap[0] == pytest.approx(body.gap(c))
    assert gap[-1] == pytest.approx(body.range)
    assert (gap[1:-1] > 0).all()
    assert (gap[1:-1] < body.range).all()


@pytest.mark.parametrize("transition", [0.05, 0.3, 0.6])
def test_it_touches_where_maugis_contact_begins(transition):
    """c, F and d of Maugis' equations in the limit m = c / a of infinity, extrapolated in 1 / m."""
    body = sphere(transition)
    K = 4 * E_STAR / 3
    length = math.cbrt(math.pi * WORK * R**2 / K)
    m = np.array([1e5, 2e5])
    mu = np.sqrt(m**2 - 1)
    square = transition / 2 * (mu + (m**2 - 2) * np.arctan(mu))
    linear = 4 / 3 * transition**2 * (mu * np.arctan(mu) - m + 1)
    a = 2 / (linear + np.sqrt(linear**2 + 4 * square))
    force = a**3 - transition * a**2 * (mu + m**2 * np.arctan(mu))
    depth = a**2 - 4 / 3 * a * transition * mu
    reach, force, depth = (2 * each[1] - each[0] for each in (m * a, force, depth))
    c = body.largest_reach
    assert body.gap(c) == pytest.approx(0, abs=1e-12 * body.range)
    assert c == pytest.approx(reach * length, rel=1e-6)
    assert body.force(c) == pytest.approx(force * math.pi * WORK * R, rel=1e-6)
    assert body.depth(c) == pytest.approx(depth * length**2 / R, rel=1e-6)


def test_the_force_is_the_change_of_the_energy_with_the_depth():
    """Energy of the half-space, and of the pull: sigma_0 (gap - h_0) within the reach."""
    body = sphere(0.5)
    c = 0.8 * body.largest_reach

    def energy(reach):
        lifted = 4 * body.pull * reach / (math.pi * E_STAR)

        def density(r):
            u = lifted * ellipe((r / reach) ** 2)
            gap = r**2 / (2 * R) - body.depth(reach) - u
            return 2 * math.pi * r * body.pull * (u / 2 + gap - body.range)

        return quad(density, 0, reach)[0]

    step = 1e-4 * c
    change = energy(c + step) - energy(c - step)
    depths = body.depth([c - step, c + step])
    assert change / (depths[1] - depths[0]) == pytest.approx(float(body.force(c)), rel=1e-6)


def test_reach_and_depth_belong_together_from_the_jump_to_the_contact():
    body = sphere(0.5)
    assert body.reach(-body.range) == pytest.approx(2 * body.smallest_reach)
    assert body.reach(-body.range) < body.largest_reach
    reaches = np.linspace(1.01 * body.smallest_reach, 0.99 * body.largest_reach, 5)
    depths = body.depth(reaches)
    assert (np.diff(depths) > 0).all()
    assert [body.reach(depth) for depth in depths] == pytest.approx(reaches)
    with pytest.raises(ValueError, match="no pull reaches the sphere"):
        body.reach(1.001 * float(body.depth(body.smallest_reach)))
    with pytest.raises(ValueError, match="the sphere touches"):
        body.reach(0.999 * float(body.depth(body.largest_reach)))


def test_a_soft_sphere_jumps_into_contact_at_once():
    """At d = -h_0 the gap on the axis is h_0 (1 - 32 lambda³ / 9)."""
    limit = (9 / 32) ** (1 / 3)
    for transition, jumps in ((0.999 * limit, False), (1.001 * limit, True)):
        body = sphere(transition)
        gap = float(body.gap(2 * body.smallest_reach))
        assert gap == pytest.approx(body.range * (1 - 32 * transition**3 / 9))
        assert (gap < 0) is jumps
        assert (2 * body.smallest_reach > body.largest_reach) is jumps


@pytest.mark.parametrize(
    "call",
    [
        lambda: PulledSphere(0.0, 1.0, 1.0, 1.0),
        lambda: PulledSphere(1.0, -1.0, 1.0, 1.0),
        lambda: PulledSphere(1.0, 1.0, math.nan, 1.0),
        lambda: PulledSphere(1.0, 1.0, 1.0, math.inf),
        lambda: sphere(0.5).force(0.0),
        lambda: sphere(0.5).depth([0.1, -0.1]),
    ],
)
def test_senseless_quantities_are_refused(call):
    with pytest.raises(ValueError, match="a positive, finite number is needed"):
        call()
