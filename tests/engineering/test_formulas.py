"""Conductance, tangential loading and reflection against closed forms."""

import math

import numpy as np
import pytest

import roughline as rl
from roughline.engineering import formulas as interface

E_STAR = 80e9
RESISTIVITIES = (1.68e-8, 9.7e-8)
CONDUCTIVITIES = (401.0, 50.0)


def sphere(n, size=1e-3, radius=5e-3):
    x = (np.arange(n) + 0.5) / n * size - size / 2
    heights = -(x[:, np.newaxis] ** 2 + x**2) / (2 * radius)
    return rl.Surface(heights, (size, size), unit="m")


def test_a_disc_has_the_resistance_of_a_disc():
    a = 3e-4
    resistance = interface.electrical_resistance(2 * E_STAR * a, E_STAR, RESISTIVITIES)
    assert resistance == pytest.approx(sum(RESISTIVITIES) / (4 * a), rel=1e-14)
    conductance = interface.thermal_conductance(2 * E_STAR * a, E_STAR, CONDUCTIVITIES)
    kappa = 2 / (1 / CONDUCTIVITIES[0] + 1 / CONDUCTIVITIES[1])
    assert conductance == pytest.approx(2 * kappa * a, rel=1e-14)


def test_a_pressed_sphere_has_the_resistance_of_its_hertzian_circle():
    n, force, radius = 256, 30.0, 5e-3
    curve = rl.press(sphere(n, radius=radius), E_star=E_STAR, forces=[force])
    a = (3 * force * radius / (4 * E_STAR)) ** (1 / 3)
    found = interface.electrical_resistance(curve.stiffness, E_STAR, RESISTIVITIES)
    assert found == pytest.approx(sum(RESISTIVITIES) / (4 * a), rel=2e-3)  # the grid's


def test_holm_is_a_disc_of_the_plastic_area():
    force, hardness = 10.0, 1e9
    a = math.sqrt(force / hardness / math.pi)
    found = interface.holm_resistance(force, hardness, RESISTIVITIES)
    assert found == pytest.approx(sum(RESISTIVITIES) / (4 * a), rel=1e-14)


def test_estimates_of_the_literature():
    """Worked by hand: kappa_s = 2, m = .1 (so rms |grad h| = .1 sqrt(pi)), sigma = 1 um."""
    slope = 0.1 * math.sqrt(math.pi)
    arguments = (1e-6, slope, (2.0, 2.0))
    plastic = interface.yovanovich_conductance(1e6, 1e9, *arguments)
    assert plastic == pytest.approx(1.25 * 2 * 1e5 * 1e-3**0.95, rel=1e-12)
    elastic = interface.mikic_conductance(1e6, 1e11, *arguments)
    assert elastic == pytest.approx(1.55 * 2 * 1e5 * (math.sqrt(2) * 1e-4) ** 0.94, rel=1e-12)


def test_partial_slip_of_a_sphere_is_that_of_cattaneo_and_mindlin():
    """Q / mu F = 1 - (1 - u_x / u_max)^(3/2), u_max = mu E*/G* d (Johnson 1985, eq. 7.42)."""
    radius, friction, G_star = 5e-3, 0.3, 60e9
    depth = np.geomspace(1e-9, 1e-6, 400)
    force = 4 / 3 * E_STAR * math.sqrt(radius) * depth**1.5
    displacement, tangential = interface.partial_slip(depth, force, E_STAR, G_star, friction)
    whole = friction * E_STAR / G_star * depth[-1]
    assert displacement[0] == 0
    assert tangential[0] == 0
    assert displacement[-1] == pytest.approx(whole)
    assert tangential[-1] == pytest.approx(friction * force[-1])
    exact = friction * force[-1] * (1 - (1 - displacement / whole) ** 1.5)
    assert tangential == pytest.approx(exact, rel=1e-9, abs=1e-12 * force[-1])
    # the first step is the stiffness without slip, k_t = G*/E* k
    stiffness = 2 * E_STAR * math.sqrt(radius * depth[-1])
    slope = np.diff(tangential)[0] / np.diff(displacement)[0]
    assert slope == pytest.approx(stiffness * G_star / E_STAR, rel=0.01)


def test_partial_slip_refuses_what_it_cannot_use():
    one = np.ones(2)
    with pytest.raises(rl.InputError, match="friction is 0"):
        interface.partial_slip(one, one, 1.0, 1.0, 0)
    with pytest.raises(rl.InputError, match="were not solved"):
        interface.partial_slip(np.array([1, np.nan]), one, 1.0, 1.0, 0.3)


def test_reflection_between_its_limits():
    steel, water = 46e6, 1.5e6
    stiff = interface.reflection(1e30, 5e6, (steel, water))
    assert stiff == pytest.approx((steel - water) / (steel + water))  # a bonded interface
    assert interface.reflection(1e-3, 5e6, (steel, water)) == pytest.approx(1.0)
    equal = interface.reflection(1e14, 5e6, (steel, steel))
    # |r| = 1 / sqrt(1 + (2 K / (w z))²) for equal bodies (Kendall and Tabor 1971)
    assert equal == pytest.approx(1 / math.hypot(1, 2e14 / (2 * math.pi * 5e6 * steel)))
    with pytest.raises(rl.InputError, match="frequency is 0"):
        interface.reflection(1.0, 0.0, (1.0, 1.0))


def test_the_interface_and_the_body_in_series():
    assert interface.interface_stiffness(2.0, 3.0) == pytest.approx(6.0)
    assert 1 / interface.interface_stiffness(2.0, 3.0) + 1 / 3 == pytest.approx(1 / 2)
