"""Exact solutions with friction: against quadrature, each other, their limits and known digits."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughline.exact import goodman, indenters, sheared_disc, spence
from roughline.exact.cattaneo_mindlin import CattaneoMindlin
from roughline.exact.mindlin_deresiewicz import CoulombSprings

QUADRATURE = 1e-8
MU, E_STAR, G_STAR, R, DEPTH = 0.3, 3.0, 2.5, 2.0, 0.01
BALL = indenters.paraboloid(R, E_STAR)
PRESSED = CattaneoMindlin(BALL, DEPTH, G_STAR, MU)


def shear_of(lines, r):
    """Shear at r of lines q(x) = sum of f (d - x² / R) for x < c: Hertz's pressures."""
    return sum(f * indenters.hertz_pressure(d, R, 1.0, r) for f, d in lines if d > 0)


# one material, or two that do not move each other


def test_the_disc_in_full_stick_is_the_flat_punch_with_g_star():
    r = np.array([0.0, 0.2, 0.31])
    assert sheared_disc.stuck_stiffness(2.0, 0.3) == 2 * 2.0 * 0.3
    assert sheared_disc.stuck_shear(5.0, 0.3, r)[[0, 2]] == pytest.approx(
        [5 / (2 * math.pi * 0.09), 0.0]
    )


def test_the_disc_of_a_strength_slips_from_its_rim_until_all_of_it_does():
    disc = sheared_disc.disc_of_strength(0.3, G_STAR, strength=0.5)
    c = 0.3 * np.array([1e-6, 0.4, 0.8, 1 - 1e-9])
    tau, a = 0.5, 0.3
    expected = 2 * tau * (a**2 * np.arccos(c / a) + c * np.sqrt(a**2 - c**2))
    assert disc.force(c) == pytest.approx(expected, rel=1e-14)
    assert disc.depth(c) == pytest.approx(2 * tau / G_STAR * np.sqrt(a**2 - c**2), rel=1e-14)
    assert disc.force(c[0]) == pytest.approx(math.pi * a**2 * tau, rel=1e-5)
    near = np.array([0.4 - 1e-6, 0.4 + 1e-6]) * a
    slope = np.diff(disc.force(near)) / np.diff(disc.depth(near))
    assert slope[0] == pytest.approx(2 * G_STAR * 0.4 * a, rel=1e-6)
    ring = quad(lambda r: 2 * math.pi * r * float(disc.pressure(c[1], r)), 0, c[1])[0]
    ring += math.pi * (a**2 - c[1] ** 2) * tau
    assert ring == pytest.approx(disc.force(c[1]), rel=QUADRATURE)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.95])
def test_partial_slip_of_a_sphere_is_sliding_less_a_smaller_contact(share):
    Q = share * PRESSED.largest_force
    c = float(PRESSED.stick_radius(Q))
    assert PRESSED.slide(Q) == pytest.approx(
        MU * E_STAR / G_STAR * DEPTH * (1 - (1 - share) ** (2 / 3)), rel=1e-13
    )
    assert c == pytest.approx(math.sqrt(R * DEPTH) * (1 - share) ** (1 / 3), rel=1e-13)
    # mu p of the contact less that of one of radius c, at its depth c² / R
    lines = [(MU * E_STAR, DEPTH), (-MU * E_STAR, c**2 / R)]
    a = math.sqrt(R * DEPTH)
    total = sum(
        quad(lambda r: 2 * math.pi * r * float(shear_of(lines, r)), *ends)[0]
        for ends in ((0, c), (c, a))
    )
    assert total == pytest.approx(Q, rel=1e-6)  # of a root at the edge
    step = 1e-5 * PRESSED.largest_force
    slope = 2 * step / (PRESSED.slide(Q + step) - PRESSED.slide(Q - step))
    assert PRESSED.stiffness(Q) == pytest.approx(slope, rel=1e-5)


@pytest.mark.parametrize("n", [1.0, 2.0, 4.0])
def test_the_energy_of_a_cycle_is_the_area_of_the_loop(n):
    body = indenters.PowerLawIndenter(n, 0.7, E_STAR)
    pressed = CattaneoMindlin(body, 0.1, G_STAR, MU)
    Q = 0.7 * pressed.largest_force
    back = quad(lambda force: float(pressed.slide_after(Q, force)), -Q, Q, epsabs=0)[0]
    assert pressed.slide_after(Q, -Q) == pytest.approx(-pressed.slide(Q), rel=1e-13)
    # the way back and the way there are each other's mirror, and their mean is zero
    assert pressed.energy_of_cycle(Q) == pytest.approx(2 * back, rel=QUADRATURE)


@pytest.mark.parametrize("share", [0.01, 0.6, 1.0])
def test_the_energy_of_a_cycle_of_a_sphere_is_mindlins(share):
    muF, a = PRESSED.largest_force, math.sqrt(R * DEPTH)
    bracket = 1 - (1 - share) ** (5 / 3) - 5 / 6 * share * (1 + (1 - share) ** (2 / 3))
    assert PRESSED.energy_of_cycle(share * muF) == pytest.approx(
        3.6 * muF**2 / (G_STAR * a) * bracket, rel=1e-7
    )


# Mindlin and Deresiewicz: forces over the largest, shear forces over mu times that, slides over
# mu (E* / G*) d
HISTORY = np.array(
    [
        (0.5, 0.0, 0.0),
        (0.5, 0.1, 0.08707700),
        (0.5, 0.35, 0.34764972),
        (1.0, 0.35, 0.34764972),
        (1.0, 0.6, 0.52216790),
        (0.8, 0.6, 0.53813625),
        (0.8, -0.2, -0.10404277),
        (1.0, 0.5, 0.41515641),
        (0.6, 0.1, 0.12653507),
    ]
)


def slid(body, depths, shear_forces, count=2**12):
    springs = CoulombSprings(body, float(np.max(depths)), G_STAR, MU, count)
    return np.array(list(springs.under(np.asarray(depths), np.asarray(shear_forces)))).T


@pytest.mark.parametrize("count", [2**8, 2**12, 2**16])
def test_springs_follow_mindlin_and_deresiewicz(count):
    force, shear, expected = HISTORY.T
    most = MU * float(BALL.force(DEPTH))
    slide = slid(BALL, DEPTH * force ** (2 / 3), shear * most, count)[2]
    error = np.abs(slide / (MU * E_STAR / G_STAR * DEPTH) - expected).max()
    assert error < 4 / count**2 + 5e-9  # of which the latter is the rounding of the digits


@pytest.mark.parametrize("n", [1.0, 2.0, 3.0])
def test_springs_slip_turn_and_slip_back_as_closed_forms(n):
    body = indenters.PowerLawIndenter(n, 0.7, E_STAR)
    pressed = CattaneoMindlin(body, 0.1, G_STAR, MU)
    shear = pressed.largest_force * np.array([0.0, 0.3, 0.8, 0.1, -0.5])
    _, _, slide, stick = slid(body, np.full(5, 0.1), shear)
    Q = shear[2]
    assert slide[:3] == pytest.approx(pressed.slide(shear[:3]), rel=1e-5)
    assert slide[3:] == pytest.approx(pressed.slide_after(Q, shear[3:]), rel=1e-5)
    assert stick[:3] == pytest.approx(pressed.stick_radius(shear[:3]), rel=1e-3)


def test_oblique_loading_from_rest_within_the_friction_cone_does_not_slip():
    """Shear is everywhere as much of the pressure as the forces are: u = (E* / G*) theta d."""
    depths = np.linspace(0.01, 0.1, 4)
    theta = 0.7 * MU
    _, _, slide, stick = slid(BALL, depths, theta * BALL.force(depths))
    assert slide == pytest.approx(theta * E_STAR / G_STAR * depths, rel=1e-6)
    assert stick == pytest.approx(BALL.radius(depths), rel=1e-3)


# two materials: the bodies slip as they are pressed

PAIRS = {
    (0.3, 2 / 7): (0.9186151489, 0.7437908831, 0.8959447, 1.024297),
    (0.1, 2 / 7): (0.2240469617, 0.0449501721, 0.1998265, 1.010349),
    (0.2, 0.5): (0.3132633785, 0.0786892785, 0.2208566, 1.035950),
    (0.2, 2 / 7): (0.7333831052, 0.4057888349, 0.6982742, 1.019275),
    (0.1, 0.1): (0.9037539643, 0.7071067812, 0.9010056, 1.002874),
}


@pytest.mark.parametrize(("friction", "beta"), PAIRS)
def test_goodmans_ratios(friction, beta):
    disc, plane, *_ = PAIRS[friction, beta]
    assert goodman.disc_stick_ratio(friction, beta) == pytest.approx(disc, abs=1e-10)
    assert goodman.plane_stick_ratio(friction, beta) == pytest.approx(plane, abs=1e-10)


@pytest.mark.parametrize(("friction", "beta"), [(0.3, 2 / 7), (0.2, 0.5), (0.05, 0.2)])
def test_goodmans_shear_of_plane_bodies_is_bounded_where_stick_ends(friction, beta):
    """Shear of a bounded Cauchy equation on |x| < c is orthogonal to 1 / sqrt(c² - x²)."""
    c = goodman.plane_stick_ratio(friction, beta)
    # x = c sin(t), and s² = c² + (1 - c²) sin²(t) of the slip beyond
    drawn = quad(lambda t: 1 / math.sqrt(1 - (c * math.sin(t)) ** 2), 0, math.pi / 2)[0]
    slipped = quad(
        lambda t: 1 / math.sqrt(c**2 * math.cos(t) ** 2 + math.sin(t) ** 2), 0, math.pi / 2
    )[0]
    assert beta * drawn == pytest.approx(friction * slipped, rel=QUADRATURE)


@pytest.mark.parametrize(("friction", "beta"), [(0.3, 2 / 7), (0.2, 0.5), (0.05, 0.2)])
def test_goodmans_line_of_shear_does_not_jump(friction, beta):
    """Both sides by quadrature: the Hilbert transform of a constant, and mu times a disc's p."""
    c = goodman.disc_stick_ratio(friction, beta)
    # psi = 1: -(beta / pi) PV int_-1^1 ds / (s - c)
    stuck = -beta / math.pi * quad(lambda s: 1.0, -1, 1, weight="cauchy", wvar=c)[0]
    slipped = quad(
        lambda t: (
            2 * friction * c / math.pi / math.sqrt(c**2 * math.cos(t) ** 2 + math.sin(t) ** 2)
        ),
        0,
        math.pi / 2,
    )[0]
    assert stuck == pytest.approx(slipped, rel=QUADRATURE)


def test_goodmans_stick_vanishes_and_fills_the_contact():
    for ratio in (goodman.disc_stick_ratio, goodman.plane_stick_ratio):
        assert ratio(5.0, 0.01) == 1.0
    assert goodman.disc_stick_ratio(0.02, 0.4) == pytest.approx(4 * math.exp(-20), rel=1e-12)
    # beta = mu: K = K', of the modulus 1 / sqrt(2)
    assert goodman.plane_stick_ratio(0.2, 0.2) == pytest.approx(math.sqrt(0.5), rel=1e-14)


@pytest.mark.parametrize(
    ("friction", "beta", "refinement"),
    [(0.2, 0.5, 6), *((friction, beta, 14) for friction, beta in PAIRS)],
)
def test_spences_ratios(friction, beta, refinement):
    *_, stick, force = PAIRS[friction, beta]
    disc = spence.StickSlipDisc(friction, beta, refinement)
    resolved = refinement == 14  # to more than is known of them otherwise
    assert disc.stick_ratio == pytest.approx(stick, abs=3e-7 if resolved else 3e-6)
    assert disc.force_ratio == pytest.approx(force, abs=6e-7 if resolved else 3e-6)


@pytest.mark.parametrize(
    ("friction", "beta", "last"), [(0.1, 2 / 7, 8), (0.3, 2 / 7, 16), (0.2, 0.5, 16)]
)
def test_spences_ratios_converge_as_panels_narrow(friction, beta, last):
    """Two panels more make the narrowest 0.4² times as wide, and errors too."""
    discs = [spence.StickSlipDisc(friction, beta, each) for each in range(4, last + 1, 2)]
    for name in ("stick_ratio", "force_ratio", "sphere_force_ratio"):
        steps = np.abs(np.diff([getattr(each, name) for each in discs]))
        assert (steps[1:] < 0.25 * steps[:-1]).all()


@pytest.mark.parametrize("refinement", [6, 14])
def test_spences_lines_obey_their_equations_between_the_nodes(refinement):
    friction, beta = 0.2, 0.5
    disc = spence.StickSlipDisc(friction, beta, refinement)
    c = disc.stick_ratio
    within = 1e-4 if refinement == 6 else 1e-7

    def hilbert(line, sign, t):
        def integrand(s):
            return float(line(np.array([s]))[0])

        breaks = [c, *(1 - 10.0**-k for k in range(2, 6))]
        ends = [0.0, *sorted({*breaks, t - min(t, abs(c - t), 1 - t) / 2}), 1.0]
        ends = sorted({*ends, t + min(t, abs(c - t), 1 - t) / 2})
        ahead = 0.0
        for a, b in itertools.pairwise(ends):
            if a < t < b:
                ahead += quad(integrand, a, b, weight="cauchy", wvar=t, limit=200)[0]
            else:
                ahead += quad(lambda s: integrand(s) / (s - t), a, b, limit=200)[0]
        behind = sum(
            quad(lambda s: integrand(s) / (s + t), a, b, limit=200)[0]
            for a, b in itertools.pairwise(ends)
        )
        return (ahead + sign * behind) / math.pi

    for t in (0.4 * c, c + 0.3 * (1 - c), 0.9):
        psi = float(disc.line_of_pressure(np.array([t]))[0])
        assert psi - beta * hilbert(disc.line_of_shear, 1, t) == pytest.approx(1.0, abs=within)
    phi = float(disc.line_of_shear(np.array([0.4 * c]))[0])
    assert phi + beta * hilbert(disc.line_of_pressure, -1, 0.4 * c) == pytest.approx(0, abs=within)


def test_a_sphere_touches_less_and_bears_more_than_hertz():
    """What boundary elements gave: 1.0147, with grids of 128² and 16 steps from a quarter on."""
    disc = spence.StickSlipDisc(0.3, 2 / 7, 6)
    assert disc.sphere_force_ratio == pytest.approx(1.0147, abs=4e-4)
    assert disc.sphere_area_ratio < 1 < disc.sphere_force_ratio < disc.force_ratio


def test_spence_is_goodman_where_coupling_is_small():
    ratios = []
    for beta in (0.04, 0.02, 0.01):
        disc = spence.StickSlipDisc(0.8 * beta, beta, 6)
        ratios.append(1 - disc.stick_ratio / goodman.disc_stick_ratio(0.8 * beta, beta))
    assert np.polyfit(np.log([4, 2, 1]), np.log(ratios), 1)[0] == pytest.approx(2, abs=0.1)


def test_spence_sticks_wholly_where_friction_is_large():
    assert spence.stuck_force_ratio(0.5) == pytest.approx(1.098612289, abs=1e-9)
    assert spence.stuck_force_ratio(2 / 7) == pytest.approx(1.028626664, abs=1e-9)
    missing = [
        spence.stuck_force_ratio(0.3) - spence.StickSlipDisc(mu, 0.3, 6).force_ratio
        for mu in (0.3, 0.6, 0.9)
    ]
    assert missing[0] > 4 * missing[1] > 16 * missing[2] > 0
    with pytest.raises(ValueError, match="the ring that slips is too narrow"):
        spence.StickSlipDisc(3.0, 0.1)


def test_bad_input_is_refused():
    with pytest.raises(ValueError, match=r"friction is 0\.0; a positive"):
        goodman.disc_stick_ratio(0.0, 0.2)
    with pytest.raises(ValueError, match="beta is -0"):
        spence.stuck_force_ratio(-0.1)
    with pytest.raises(ValueError, match="depth is nan"):
        CattaneoMindlin(BALL, math.nan, G_STAR, MU)
