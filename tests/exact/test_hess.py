"""Heß's rule for bodies of revolution, against closed forms and a balance of energy."""

import math

import numpy as np
import pytest

from roughline.exact import hess, indenters, punch

E_STAR, WORK = 3.0, 0.02
RADII = np.array([0.05, 0.1, 0.3])
QUADRATURE = 1e-6  # of a profile with a fractional exponent; the others do better
LEAST = 1e-6  # of the place of a minimum, at which the quantity itself is exact to its square


def power_law(n, c=0.7, largest=10.0):
    return hess.StickingBody(lambda r: c * n * r ** (n - 1), largest, E_STAR, WORK)


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0, 4.0])
def test_depth_and_force_are_those_without_adhesion_less_the_springs(n):
    plain, sticking = indenters.PowerLawIndenter(n, 0.7, E_STAR), power_law(n)
    elongation = np.sqrt(2 * math.pi * RADII * WORK / E_STAR)
    depth = plain.depth(RADII)
    assert sticking.depth(RADII) == pytest.approx(depth - elongation, rel=QUADRATURE)
    closed = plain.force(depth) - 2 * E_STAR * RADII * elongation
    assert sticking.force(RADII) == pytest.approx(closed, rel=QUADRATURE)


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0, 4.0])
def test_pull_off_of_a_power_law_in_closed_form(n):
    """With g = kappa c x^n, dF/da = 0 is 2 n g = 3 Delta l, and dd/da = 0 is 2 n g = Delta l."""
    plain, sticking = indenters.PowerLawIndenter(n, 0.7, E_STAR), power_law(n)
    moved = math.sqrt(2 * math.pi * WORK / E_STAR) / (2 * n * plain.stretch * 0.7)
    under_force, at_depth = ((part * moved) ** (1 / (n - 0.5)) for part in (3, 1))
    assert sticking.pull_off_radius == pytest.approx(under_force, rel=LEAST)
    assert sticking.lift_off_radius == pytest.approx(at_depth, rel=LEAST)
    elongation = math.sqrt(2 * math.pi * under_force * WORK / E_STAR)
    closed = -(2 * n - 1) / (n + 1) * E_STAR * under_force * elongation
    assert sticking.pull_off_force == pytest.approx(closed, rel=QUADRATURE)


def test_a_paraboloid_is_the_sphere_of_johnson_kendall_and_roberts():
    R = 2.0
    ball = hess.StickingBody(lambda r: r / R, 5.0, E_STAR, WORK)
    K = 4 * E_STAR / 3
    unit = math.pi * WORK * R
    a = RADII / (unit * R / K) ** (1 / 3)
    assert ball.force(RADII) == pytest.approx(unit * (a**3 - np.sqrt(6 * a**3)), rel=1e-10)
    depth = (a**2 - 2 / 3 * np.sqrt(6 * a)) * (unit * R / K) ** (2 / 3) / R
    assert ball.depth(RADII) == pytest.approx(depth, rel=1e-10)
    assert ball.pull_off_force == pytest.approx(-1.5 * unit, rel=1e-10)
    assert ball.force(ball.lift_off_radius) == pytest.approx(-5 / 6 * unit, rel=LEAST)


def test_a_cone_comes_off_as_maugis_and_barquins_say():
    """A cone of slope t comes off at -54 w² / (pi E* t³)."""
    tip = hess.StickingBody(lambda r: np.full_like(r, 0.3), 10.0, E_STAR, WORK)
    closed = -54 * WORK**2 / (math.pi * E_STAR * 0.3**3)
    assert tip.pull_off_force == pytest.approx(closed, rel=1e-10)


def test_a_flat_disc_comes_off_as_kendall_says():
    disc = hess.StickingBody(np.zeros_like, 0.4, E_STAR, WORK)
    force = float(disc.force(0.4))
    assert force == pytest.approx(-math.sqrt(8 * math.pi * E_STAR * WORK * 0.4**3))
    assert force / float(disc.depth(0.4)) == pytest.approx(punch.disc_stiffness(E_STAR, 0.4))


def test_the_energy_of_the_springs_is_what_the_edge_gives_up():
    """At a given depth d(U - w pi a²)/da = 0, where U is the energy of the springs."""
    body, a = power_law(2.5), 0.3
    depth = float(body.depth(a))
    nodes, weights = np.polynomial.legendre.leggauss(80)

    def energy(radius):
        x, dx = radius * (nodes + 1) / 2, radius * weights / 2
        line = 0.7 * indenters.PowerLawIndenter(2.5, 0.7, E_STAR).stretch * x**2.5
        return E_STAR * ((depth - line) ** 2 @ dx) - WORK * math.pi * radius**2

    step = 1e-4
    slope = (energy(a + step) - energy(a - step)) / (2 * step)
    assert slope == pytest.approx(0, abs=1e-6 * 2 * math.pi * a * WORK)


@pytest.mark.parametrize("slope", [lambda r: r / 2, lambda r: np.full_like(r, 0.3)])
def test_a_body_that_is_drawn_back_follows_the_stable_branch_to_its_end(slope):
    body = hess.StickingBody(slope, 3.0, E_STAR, WORK)
    for radius, quantity, where in (
        (body.pull_off_radius, body.force, body.radius_under),
        (body.lift_off_radius, body.depth, body.radius_at),
    ):
        radii = np.linspace(radius * 1.01, 2.9, 5)
        values = quantity(radii)
        assert (np.diff(values) > 0).all()
        assert [where(value) for value in values] == pytest.approx(radii, rel=1e-9)
        least = float(quantity(radius))
        assert where(least * (1 - 1e-12)) == pytest.approx(radius, rel=1e-4)
        with pytest.raises(ValueError, match="where the body comes off"):
            where(least - 0.01 * abs(least))
        with pytest.raises(ValueError, match="at the largest radius"):
            where(2 * float(quantity(3.0)))
    assert body.lift_off_radius < body.pull_off_radius


def test_a_wavy_tip_comes_off_at_the_last_of_its_ridges_that_holds():
    """Ridges make several branches; the body that is drawn back is on the outermost of them."""
    wavy = hess.StickingBody(lambda r: r / 2 + 0.15 * np.sin(20 * r), 3.0, E_STAR, WORK)
    radii = np.linspace(0.05, 2.9, 400)
    force = wavy.force(radii)
    assert (np.diff(np.sign(np.diff(force))) > 0).sum() > 1
    assert wavy.pull_off_force == pytest.approx(force.min(), rel=1e-3)
    assert wavy.pull_off_force <= force.min() * (1 - 1e-9)
    of_force = wavy.radius_under(float(force[200]))
    assert of_force == pytest.approx(radii[np.flatnonzero(force <= force[200])[-1]], abs=0.01)


def test_units_are_neutral():
    length, pressure = 1e-6, 1e9
    one = hess.StickingBody(lambda r: r / 2, 3.0, E_STAR, WORK)
    other = hess.StickingBody(
        lambda r: r / length / 2, 3.0 * length, E_STAR * pressure, WORK * pressure * length
    )
    assert other.pull_off_force == pytest.approx(one.pull_off_force * pressure * length**2)
    assert other.pull_off_radius == pytest.approx(one.pull_off_radius * length, rel=LEAST)
    assert other.depth(0.3 * length) == pytest.approx(one.depth(0.3) * length)


@pytest.mark.parametrize(
    "call",
    [
        lambda: hess.StickingBody(np.zeros_like, 0.0, 1.0, 1.0),
        lambda: hess.StickingBody(np.zeros_like, 1.0, -1.0, 1.0),
        lambda: hess.StickingBody(np.zeros_like, 1.0, 1.0, math.nan),
        lambda: power_law(2.0).depth(-0.1),
        lambda: power_law(2.0).force([0.1, math.inf]),
    ],
)
def test_senseless_quantities_are_refused(call):
    with pytest.raises(ValueError, match="a positive, finite number is needed"):
        call()
