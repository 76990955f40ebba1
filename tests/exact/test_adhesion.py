"""Exact solutions of bodies that stick: published values, limits, and each by another."""

import math

import numpy as np
import pytest

from roughline.exact import adhesion, hess

# Least forces over pi w R (Maugis 1992), to the digits given.
PULL_OFF = {
    0.05: -1.98144,
    0.1: -1.95059,
    0.2: -1.88047,
    0.5: -1.71825,
    1.0: -1.60073,
    2.0: -1.53460,
    5.0: -1.50635,
}


def sphere(transition, R=1.0, w=1 / math.pi, E_star=0.75):
    """A sphere of this transition parameter."""
    K = 4 * E_star / 3
    pull = transition / 2 * np.cbrt(math.pi * w * K**2 / R)
    return adhesion.MaugisSphere(R, w, w / pull, E_star)


@pytest.mark.parametrize(("transition", "force"), PULL_OFF.items())
def test_the_pull_off_of_maugis(transition, force):
    body = sphere(transition)
    assert body.transition == pytest.approx(transition, rel=1e-12)
    assert body.pull_off_force == pytest.approx(force, abs=6e-6)


def test_the_limits_of_long_and_short_ranges():
    """Bradley's and JKR's, and how fast they are reached."""
    long = [-2 - sphere(t).pull_off_force for t in (0.02, 0.01)]
    assert all(each < 0 for each in long)
    assert long[1] > long[0] > -0.02
    short = [sphere(t).pull_off_force + 1.5 for t in (5.0, 10.0, 20.0)]
    assert all(each < 0 for each in short)
    assert short[1] / short[2] == pytest.approx(4, rel=0.25)  # as 1 / lambda²


def test_units_do_not_matter():
    one, other = sphere(0.7), sphere(0.7, R=3e-6, w=0.05, E_star=4e7)
    unit = math.pi * 0.05 * 3e-6
    assert other.pull_off_force == pytest.approx(one.pull_off_force * unit, rel=1e-10)


def test_a_sphere_of_short_range_is_jkrs():
    jkr = hess.StickingBody(lambda r: r, 4.0, 0.75, 1 / math.pi)
    body = sphere(200.0)
    m = body.at_depth(-0.3)
    radius = body.radius(m)
    assert float(jkr.depth(radius)) == pytest.approx(-0.3, abs=3e-3)
    assert float(jkr.force(radius)) == pytest.approx(body.force(m), abs=3e-3)
    assert body.pull_off_force == pytest.approx(jkr.pull_off_force, rel=1e-4)


def test_a_disc_is_pulled_off_as_kendall_has_it():
    a, w, E_star = 0.3, 0.02, 5.0
    # at the pull-off, the springs of the disc are elongated by Delta l: F = 2 E* a Delta l
    elongation = math.sqrt(2 * math.pi * a * w / E_star)
    assert adhesion.punch_pull_off(a, w, E_star) == pytest.approx(-2 * E_star * a * elongation)


def test_a_disc_of_short_range_is_kendalls_and_of_a_long_one_is_pulled_evenly():
    a, w, E_star = 0.3, 0.02, 5.0
    kendall = adhesion.punch_pull_off(a, w, E_star)
    off = [1 - adhesion.ranged_punch_pull_off(a, w, h, E_star) / kendall for h in (4e-4, 2e-4)]
    assert 0 < off[1] < 1e-3
    assert off[0] / off[1] == pytest.approx(4, rel=0.05)  # as the width of the zone
    assert adhesion.ranged_punch_pull_off(a, w, 0.5, E_star) == pytest.approx(
        -math.pi * a**2 * w / 0.5
    )


def test_a_wave_of_little_work_is_westergaards():
    from roughline.exact import westergaard

    a = np.linspace(0.05, 0.4, 5)
    pushed = westergaard.mean_pressure(a, 0.01, 1.0, 2.0)
    sticks = adhesion.wave_mean_pressure(a, 0.01, 1.0, 1e-16, 2.0)
    assert sticks == pytest.approx(pushed, rel=1e-4)
    # near the crest it is a cylinder that sticks: F = pi E* a² / (4 R) - sqrt(2 pi E* a w)
    R, w, small = 1.0 / (4 * math.pi**2 * 0.01), 1e-9, np.array([1e-3])
    line = math.pi * 2.0 * small**2 / (4 * R) - np.sqrt(2 * math.pi * 2.0 * small * w)
    assert adhesion.wave_mean_pressure(small, 0.01, 1.0, w, 2.0) == pytest.approx(line, rel=1e-4)


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: adhesion.MaugisSphere(1.0, 0.0, 1.0, 1.0),
        lambda: sphere(1.0).force(1.0),
        lambda: sphere(1.0).at_depth(-1e3),
        lambda: adhesion.punch_pull_off(1.0, np.nan, 1.0),
        lambda: adhesion.bradley_pull_off(np.inf, 1.0),
    ],
)
def test_what_is_no_such_body_is_refused(wrong):
    with pytest.raises(ValueError, match="needed|known"):
        wrong()
