"""Conduction through layers: Barber's identity, image series, a disc by Fredholm's equation."""

import math

import numpy as np
import pytest
from scipy import special

import roughline as rl
from roughline.contact.conduction import LayeredConductor, conductance

SURFACE = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
COPPER = ((1.7,), ())
LAYERED = ((1.0, 30.0, 0.2), (0.02, 0.05))


def one_layer(q, top, base, h):
    """The sum of all images of a point in one layer."""
    kappa = (1 / top - 1 / base) / (1 / top + 1 / base)
    images = kappa * np.exp(-2 * q * h)
    return top / q * (1 + images) / (1 - images)


def disc(points, radius):
    x = (np.arange(points) + 0.5) / points - 0.5
    return np.hypot(x[:, np.newaxis], x) < radius


def over_homogeneous(top, base, h, radius, nodes=40):
    """Conductance of a disc at one potential on one layer, over that on the layer's material.

    With the current's transform as the integral of phi(t) cos(q t), the dual integral equations are
    Fredholm's: phi(t) + (1 / pi) int phi(s) (M(s + t) + M(s - t)) ds = 2 / pi, and M(u) is the
    integral of (K(q) - 1) cos(q u), K the potential over that on the layer's material.
    """
    x, w = np.polynomial.legendre.leggauss(nodes)
    t, w = (x + 1) / 2 * radius, w / 2 * radius
    x, v = np.polynomial.legendre.leggauss(400)
    q, v = (x + 1) / 2 * 40 / h, v / 2 * 40 / h
    beside = one_layer(q, top, base, h) * q / top - 1

    def M(u):
        return np.cos(u[..., np.newaxis] * q) @ (beside * v)

    kernel = (M(t[:, np.newaxis] + t) + M(t[:, np.newaxis] - t)) / math.pi
    phi = np.linalg.solve(np.eye(nodes) + kernel * w, np.full(nodes, 2 / math.pi))
    return float(w @ phi) / (2 * radius / math.pi)


def test_waves_are_those_of_all_images_of_one_layer():
    q = np.geomspace(1e-3, 1e3, 50)
    for base in (1e-3, 0.5, 1.0, 40.0):
        found = LayeredConductor((2.0, base), (0.3,)).spectrum(q)
        np.testing.assert_allclose(found, one_layer(q, 2.0, base, 0.3), rtol=1e-12)
    cut = LayeredConductor((2.0, 2.0, 2.0, 40.0), (0.1, 0.15, 0.05))
    np.testing.assert_allclose(cut.spectrum(q), one_layer(q, 2.0, 40.0, 0.3), rtol=1e-12)
    thin = LayeredConductor((2.0, 40.0), (1e-9,)).spectrum(q)
    np.testing.assert_allclose(thin, 40 / q, rtol=1e-4)


@pytest.mark.parametrize(
    ("resistivity", "thickness"),
    [((2.0, 2e3, 2.0), (1.0, 0.3)), ((2.0, 2e2, 0.2), (1.0, 1.0)), ((2.0, 2e-3), (1.0,))],
)
@pytest.mark.parametrize("distance", [3, 100, 400])
def test_far_along_good_layers_the_potential_is_the_integral_of_its_waves(
    resistivity, thickness, distance
):
    body, found = LayeredConductor(resistivity, thickness), np.empty((1, 1))
    body.kernel(10 * distance, (0.1, 0.1), found)
    growing = np.geomspace(1e-9, 1 / distance)
    edges = np.concatenate([[0.0], growing, np.arange(2, 20 * distance) / distance])
    x, w = np.polynomial.legendre.leggauss(12)
    half = np.diff(edges)[:, np.newaxis] / 2
    q, w = (edges[:-1, np.newaxis] + half * (1 + x)).ravel(), (half * w).ravel()
    beside = (q * body.spectrum(q) / 2.0 - 1) * special.j0(q * distance)
    wanted = 2.0 / (2 * math.pi) * (1 / distance + w @ beside)
    assert found[0, 0] / 0.01 == pytest.approx(wanted, rel=0.01 / distance**2)  # a cell is no point


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("layers", [((2.0,), ()), ((2.0, 2.0), (0.03,)), ((2.0,) * 3, (0.1, 0.2))])
def test_of_one_material_it_is_barbers_identity(layers, periodic):
    curve = rl.press(SURFACE, E_star=3.0, forces=[1e-3, 1e-2], periodic=periodic, fields=True)
    for k, fields in zip(curve.stiffness, curve.fields, strict=True):
        found = conductance(fields.contact, fields.sizes, (layers, COPPER), periodic)
        assert found == pytest.approx(2 * k / (3.0 * (2.0 + 1.7)), rel=1e-6)


@pytest.mark.parametrize("base", [1e-3, 0.1, 10.0, 1e3])
@pytest.mark.parametrize("h", [0.1, 0.3])
def test_a_disc_on_one_layer_is_that_of_fredholms_equation(base, h):
    """The staircase of the outline errs with the side of a cell; so the error falls as that."""
    wanted, radius = over_homogeneous(1.0, base, h, 0.4), 0.4
    errors = []
    for points in (64, 128, 256):
        touching = disc(points, radius)
        found = conductance(touching, (1.0, 1.0), (((1.0, base), (h,)),), False)
        errors.append(
            abs(found / (4 * radius * wanted) - 1)
        )  # 4 a of one material of resistivity 1
    assert errors[0] < 0.01
    assert errors[2] < 2.6e-3
    assert errors[2] < 0.5 * errors[0]


def test_two_bodies_add_and_units_are_neutral():
    touching = disc(64, 0.3)
    one = conductance(touching, (1.0, 1.0), (LAYERED, COPPER), True)
    other = conductance(touching, (1.0, 1.0), (COPPER, LAYERED), True)
    assert other == pytest.approx(one, rel=1e-9)
    assert one < conductance(touching, (1.0, 1.0), (LAYERED,), True)
    scaled = tuple(
        (tuple(5 * rho for rho in rhos), tuple(1e-3 * h for h in heights))
        for rhos, heights in (LAYERED, COPPER)
    )
    small = conductance(touching, (1e-3, 1e-3), scaled, True)
    assert small == pytest.approx(one * 1e-3 / 5, rel=1e-9)


def test_a_thick_layer_is_its_material_and_a_thin_one_its_base():
    touching = disc(64, 0.3)
    for periodic in (False, True):
        of_layer, of_base = (
            conductance(touching, (1.0, 1.0), (((rho,), ()),), periodic) for rho in (1.0, 10.0)
        )
        thick, *thin = (
            conductance(touching, (1.0, 1.0), (((1.0, 10.0), (h,)),), periodic)
            for h in (1e4, 2e-4, 1e-4)
        )
        assert thick == pytest.approx(of_layer, rel=1e-3)
        off = [each / of_base - 1 for each in thin]
        assert 0 < off[1] < 0.1
        assert off[0] / off[1] == pytest.approx(2, rel=0.1)


def test_nothing_touches_and_everything_does():
    nothing, everything = np.zeros((8, 8), bool), np.ones((8, 8), bool)
    assert conductance(nothing, (1.0, 1.0), (LAYERED,), True) == 0
    assert math.isinf(conductance(everything, (1.0, 1.0), (LAYERED,), True))
    assert math.isfinite(conductance(everything, (1.0, 1.0), (LAYERED,), False))
