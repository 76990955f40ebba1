"""The exact solutions against each other, by quadrature and in their limits."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j1

import roughline as rl
from roughline.exact import indenters, mdr, punch, westergaard, yielding

QUADRATURE = 1e-8


@pytest.mark.parametrize("n", [1.0, 2.0, 2.5, 3.0, 4.0])
def test_the_line_profile_in_closed_form_and_by_quadrature(n):
    body = indenters.PowerLawIndenter(n, 0.7, E_star=3.0)
    x = np.array([-0.4, 0.1, 0.3])
    found = mdr.line_profile(lambda r: 0.7 * n * r ** (n - 1), x)
    assert found == pytest.approx(body.stretch * 0.7 * np.abs(x) ** n, rel=QUADRATURE)


@pytest.mark.parametrize(("n", "kappa"), [(1, math.pi / 2), (2, 2.0), (4, 8 / 3)])
def test_the_stretch_of_cone_paraboloid_and_quartic(n, kappa):
    assert indenters.PowerLawIndenter(n, 1.0, 1.0).stretch == pytest.approx(kappa, rel=1e-14)


@pytest.mark.parametrize("n", [1.0, 2.0, 2.5, 4.0])
def test_force_and_stiffness_follow_from_the_line(n):
    body = indenters.PowerLawIndenter(n, 0.7, E_star=3.0)
    depth = body.depth(0.3)
    assert body.radius(depth) == pytest.approx(0.3)
    by_line = mdr.force(lambda r: 0.7 * n * r ** (n - 1), 0.3, 3.0)
    assert body.force(depth) == pytest.approx(by_line, rel=1e-6)
    step = 1e-6 * depth
    slope = (body.force(depth + step) - body.force(depth - step)) / (2 * step)
    assert body.stiffness(depth) == pytest.approx(slope, rel=1e-8)


def test_hertz_and_cone_are_the_textbooks():
    ball = indenters.paraboloid(2.0, E_star=3.0)
    assert ball.force(0.01) == pytest.approx(4 / 3 * 3 * math.sqrt(2) * 0.01**1.5)
    radius = ball.radius(0.01)
    assert radius == pytest.approx(math.sqrt(2 * 0.01))
    total = quad(
        lambda r: 2 * math.pi * r * indenters.hertz_pressure(0.01, 2.0, 3.0, np.array(r)), 0, radius
    )[0]
    assert total == pytest.approx(ball.force(0.01), rel=QUADRATURE)
    tip = indenters.cone(0.2, E_star=3.0)
    assert tip.depth(0.3) == pytest.approx(math.pi / 2 * 0.3 * math.tan(0.2))
    assert tip.force(tip.depth(0.3)) == pytest.approx(math.pi / 2 * 3 * 0.09 * math.tan(0.2))


def test_indenters_take_arrays():
    depths = np.geomspace(1e-3, 1e-1, 5)
    ball, tip = indenters.paraboloid(2.0, E_star=3.0), indenters.cone(0.2, E_star=3.0)
    assert ball.force(depths) == pytest.approx(4 / 3 * 3 * np.sqrt(2) * depths**1.5)
    assert ball.stiffness(depths) == pytest.approx(6 * np.sqrt(2 * depths))
    assert ball.depth(ball.radius(depths)) == pytest.approx(depths)
    radii = 2 * depths / (np.pi * np.tan(0.2))
    assert tip.force(depths) == pytest.approx(np.pi / 2 * 3 * radii**2 * np.tan(0.2))
    middle = indenters.hertz_pressure(depths, 2.0, 3.0, 0.0)
    assert middle == pytest.approx(1.5 * ball.force(depths) / (np.pi * ball.radius(depths) ** 2))
    with pytest.raises(ValueError, match=r"depth is -1\.0; a positive"):
        ball.force([1.0, -1.0])


def test_flat_punches():
    assert punch.square_stiffness(2.0, 3.0) == pytest.approx(rl.EXACT_PUNCH * 6, rel=2e-6)
    assert math.isclose(rl.PAPER_PUNCH, 1.012 * 2 / math.sqrt(math.pi), abs_tol=5e-5)
    assert pytest.approx(0.991, abs=5e-4) == rl.PAPER_PUNCH / rl.EXACT_PUNCH
    assert punch.ellipse_stiffness(2.0, 0.3, 0.3) == pytest.approx(punch.disc_stiffness(2.0, 0.3))
    assert punch.ellipse_stiffness(2.0, 0.3, 0.1) == punch.ellipse_stiffness(2.0, 0.1, 0.3)
    # K(e) = int_0^(pi/2) dt / sqrt(1 - e² sin² t)
    K = quad(lambda t: 1 / math.sqrt(1 - (8 / 9) * math.sin(t) ** 2), 0, math.pi / 2)[0]
    assert punch.ellipse_stiffness(2.0, 0.3, 0.1) == pytest.approx(math.pi * 2 * 0.3 / K)
    # with r = a sin(t) the pressure's root at the rim goes away
    total = quad(
        lambda t: (
            2
            * math.pi
            * 0.09
            * math.sin(t)
            * math.cos(t)
            * float(punch.disc_pressure(5.0, 0.3, np.array(0.3 * math.sin(t))))
        ),
        0,
        math.pi / 2,
    )[0]
    assert total == pytest.approx(5.0, rel=1e-6)
    assert punch.disc_pressure(5.0, 0.3, np.array([0.31]))[0] == 0


def test_waves():
    full = westergaard.full_contact_pressure(0.01, 2.0, 3.0)
    assert full == pytest.approx(math.pi * 3 * 0.01 / 2)
    half_widths = np.array([0.2, 0.7, 1.0])
    means = westergaard.mean_pressure(half_widths, 0.01, 2.0, 3.0)
    assert means[-1] == pytest.approx(full)
    for half_width, mean in zip(half_widths, means, strict=True):
        total = quad(
            lambda x, a=half_width: float(westergaard.pressure(np.array(x), a, 0.01, 2.0, 3.0)),
            -half_width,
            half_width,
            limit=200,
        )[0]
        assert total / 2.0 == pytest.approx(mean, rel=1e-6)
    crossed = westergaard.crossed_full_contact_pressure(0.01, 2.0, 3.0)
    assert crossed == pytest.approx(math.sqrt(2) * full)


def test_the_reduced_spectrum_is_the_mdr_transform_of_the_structure_function():
    """S_1(x) = |x| int_0^x S_2'(r) / sqrt(x² - r²) dr, with S(x) = <(h(x) - h(0))²>."""
    spectrum = rl.SelfAffine(hurst=0.6, length=1.0, C_0=1.0, q_high=60.0)
    nodes, weights = np.polynomial.legendre.leggauss(400)
    q = spectrum.q_low + (60.0 - spectrum.q_low) * (nodes + 1) / 2
    weights = weights * (60.0 - spectrum.q_low) / 2
    C_2d, C_reduced = spectrum.C_2d(q), spectrum.C_reduced(q)

    def slope(r):  # S_2(r) = 4 pi int q C_2d (1 - J0(q r)) dq
        return 4 * np.pi * (j1(q * r[..., np.newaxis]) @ (weights * q**2 * C_2d))

    x = np.array([0.01, 0.1, 0.4])
    S_1 = 4 * (1 - np.cos(q * x[:, np.newaxis])) @ (weights * C_reduced)
    assert mdr.line_profile(slope, x) == pytest.approx(S_1, rel=QUADRATURE)


def test_a_ball_yields_where_hertzs_largest_pressure_is_the_hardness():
    ball = indenters.paraboloid(2.0, E_star=3.0)
    radius = yielding.ball_yield_radius(2.0, 3.0, hardness=0.5)
    depth = ball.depth(radius)
    assert indenters.hertz_pressure(depth, 2.0, 3.0, 0.0) == pytest.approx(0.5)
    assert ball.force(depth) == pytest.approx(yielding.ball_yield_force(2.0, 3.0, hardness=0.5))


def test_the_disc_that_yields_at_its_rim():
    disc = yielding.YieldingDisc(0.3, E_star=3.0, hardness=0.5)
    radii = 0.3 * np.array([1e-6, 0.3, 0.9, 1 - 1e-9])
    full = math.pi * 0.09 * 0.5
    assert disc.force(radii)[[0, -1]] == pytest.approx([full, 0.0], abs=1e-4 * full)
    # all plastic: the middle sinks by 2 H a / E*; all elastic: the rigid disc
    assert disc.depth(radii)[0] == pytest.approx(2 * 0.5 * 0.3 / 3.0)
    light = disc.force(radii)[-1] / disc.depth(radii)[-1]
    assert light == pytest.approx(punch.disc_stiffness(3.0, 0.3), rel=1e-6)
    assert disc.unloading_stiffness == punch.disc_stiffness(3.0, 0.3)


@pytest.mark.parametrize("c", [0.03, 0.15, 0.27])
def test_the_yielding_disc_by_quadrature(c):
    disc = yielding.YieldingDisc(0.3, E_star=3.0, hardness=0.5)
    pressure = [disc.pressure(c, r) for r in (0.0, c / 2, c, 0.29, 0.31)]
    assert (np.diff(pressure[:3]) > 0).all()
    assert pressure[2:] == pytest.approx([0.5, 0.5, 0.0])
    total = quad(lambda r: 2 * math.pi * r * disc.pressure(c, r), 0, 0.3, points=[c], limit=200)[0]
    assert total == pytest.approx(disc.force(c), rel=QUADRATURE)
    # u(0) = (2 / E*) int p dr, the potential of rings at their centre
    sunk = 2 / 3.0 * quad(lambda r: disc.pressure(c, r), 0, 0.3, points=[c], limit=200)[0]
    assert sunk == pytest.approx(disc.depth(c), rel=QUADRATURE)
    step = 1e-6
    slope = np.diff(disc.force([c - step, c + step])) / np.diff(disc.depth([c - step, c + step]))
    assert disc.stiffness(c) == pytest.approx(slope[0], rel=1e-6)
    # F dd = F d'(c) dc, with d' = -(2 H / E*) c / sqrt(a² - c²) and c = a sin t
    work = quad(
        lambda t: disc.force(0.3 * math.sin(t)) * (2 * 0.5 * 0.3 / 3.0) * math.sin(t),
        math.asin(c / 0.3),
        math.pi / 2,
    )[0]
    assert disc.work(c) == pytest.approx(work, rel=QUADRATURE)


@pytest.mark.parametrize(
    "call",
    [
        lambda: punch.square_stiffness(0.0, 1.0),
        lambda: punch.disc_stiffness(1.0, -1.0),
        lambda: punch.ellipse_stiffness(1.0, 1.0, math.nan),
        lambda: indenters.paraboloid(-1.0, 1.0),
        lambda: indenters.cone(0.1, math.inf),
        lambda: indenters.paraboloid(1.0, 1.0).force(-0.1),
        lambda: westergaard.full_contact_pressure(1.0, 0.0, 1.0),
        lambda: yielding.ball_yield_force(1.0, 1.0, 0.0),
        lambda: yielding.YieldingDisc(1.0, 1.0, -1.0),
    ],
)
def test_senseless_quantities_are_refused(call):
    with pytest.raises(ValueError, match="a positive, finite number is needed"):
        call()
