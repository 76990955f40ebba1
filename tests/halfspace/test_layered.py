"""Layered half-spaces: waves, the free kernel, spheres, limits, dense solutions and histories."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy import integrate, special

import roughline as rl
from halfspace.dense_contact import (
    BodyOn,
    DenseContact,
    assert_contacts_are_dense,
    assert_history_is_dense,
)
from halfspace.dense_hardness import History
from halfspace.test_adhesion_oracle import DenseSticking, assert_sticking_is_dense
from halfspace.test_foreign_half_space import displaced
from random_cases import cases, seeds
from random_problems import E_STAR, random_problem
from roughline.exact.layered_revolution import LayeredContact
from roughline.exact.layers import BondedLayer
from roughline.halfspace.elasticity.disc import _spherical_bessel

RTOL = 1e-9  # so that pressures hold to 1e-6


def random_layer(rng, ratio=1e3, **others):
    """Thin or thick, soft on hard or hard on soft; every fourth on a rigid base."""
    base = math.inf if rng.random() < 0.25 else ratio ** rng.uniform(-1, 1)
    poisson, of_base = rng.uniform(0, 0.499), rng.uniform(0, 0.5)
    return rl.Layered(1.0, poisson, 10 ** rng.uniform(-2, 1), base, of_base, **others)


def closed(layer):
    """The closed form of a single layer."""
    of_layer = (column[0] for column in (layer.young, layer.poisson, layer.thickness))
    return BondedLayer(*of_layer, layer.base_young, layer.base_poisson)


# Waves


def test_waves_are_those_of_the_closed_form_and_none_yields_work():
    rng = np.random.default_rng(1)
    for _ in range(cases(10_000, 5)):
        layer = random_layer(rng)
        q = 10 ** rng.uniform(-2, 2, 8) / layer.thickness[0]
        found = layer.spectrum(q)
        np.testing.assert_allclose(found, closed(layer).compliance(q), rtol=1e-8)
        assert (found > 0).all()


@pytest.mark.parametrize("base", [3.0, 1e-3, math.inf])
def test_a_layer_cut_into_layers_is_one(base):
    q = np.geomspace(1e-2, 1e2, 50)
    one = rl.Layered(2.0, 0.3, 1.0, base, 0.2)
    cut = rl.Layered([2.0] * 4, [0.3] * 4, [0.1, 0.5, 0.3, 0.1], base, 0.2)
    np.testing.assert_allclose(cut.spectrum(q), one.spectrum(q), rtol=1e-10)
    if math.isfinite(base):
        below = rl.Layered([2.0, base], [0.3, 0.2], [1.0, 0.7], base, 0.2)
        np.testing.assert_allclose(below.spectrum(q), one.spectrum(q), rtol=1e-10)


def test_several_layers_are_those_of_all_conditions_at_their_faces():
    """All terms of all layers at once, by their stresses and displacements at each face."""
    rng = np.random.default_rng(2)
    for _ in range(40):
        count = int(rng.integers(1, 5))
        young, thickness = 10 ** rng.uniform(-1, 1, count), rng.uniform(0.1, 1, count)
        poisson, q = rng.uniform(0, 0.45, count), float(10 ** rng.uniform(-0.7, 0.7))
        layers = rl.Layered(tuple(young), tuple(poisson), tuple(thickness), 2.0, 0.25)
        wanted = by_all_faces(q, [*young, 2.0], [*poisson, 0.25], thickness)
        assert layers.spectrum(np.array([q]))[0] == pytest.approx(wanted, rel=1e-8)


def by_all_faces(q, young, poisson, thickness):
    """Solve Papkovich and Neuber's potentials in all layers for one wave of unit pressure.

    2 G u = 4 (1 - nu) (0, 0, psi) - grad(z psi + phi) with harmonic psi and phi.
    """
    columns, faces = 4 * len(thickness) + 2, np.append(0.0, np.cumsum(thickness))
    rows, right = np.zeros((columns, columns)), np.zeros(columns)

    def state(layer, z):
        """Columns, and u_x, u_z, shear and normal stress of the terms of a layer at a depth."""
        nu, G = poisson[layer], young[layer] / (2 * (1 + poisson[layer]))
        last = layer == len(thickness)
        signs = [-1] if last else [-1, 1]
        first = 4 * layer
        found = []
        for s in signs:
            origin = faces[layer] if s < 0 else faces[layer + 1]
            e = np.exp(s * q * (z - origin))
            # harmonic e cos(q x): phi, then psi, with d/dz = s q
            found.append((q * e / (2 * G), -s * q * e / (2 * G), q * s * q * e, -(q**2) * e))
            u, w = z * q * e / (2 * G), ((3 - 4 * nu) * e - z * s * q * e) / (2 * G)
            shear = -(1 - 2 * nu) * q * e + z * q * s * q * e
            normal = 2 * (1 - nu) * s * q * e - z * q**2 * e
            found.append((u, w, shear, normal))
        return np.arange(first, first + len(found)), np.array(found).T

    at, top = state(0, 0.0)
    rows[0, at], rows[1, at], right[1] = top[2], top[3], -1.0
    for face, z in enumerate(faces[1:]):
        for sign, layer in ((1, face), (-1, face + 1)):
            at, both = state(layer, z)
            rows[2 + 4 * face : 6 + 4 * face, at] += sign * both
    scale = np.abs(rows).max(axis=1)
    terms = np.linalg.solve(rows / scale[:, np.newaxis], right / scale)
    at, top = state(0, 0.0)
    return float(top[1] @ terms[at])


# The free kernel


def by_quadrature(layer, x, y, spacing):
    """Displacement at a place under unit pressure on one cell, beside that of its top layer."""
    E_star = layer.E_star
    wave = closed(layer).compliance if len(layer.young) == 1 else layer.spectrum
    nodes, weights = np.polynomial.legendre.leggauss(16)
    at = [place + side / 2 * nodes for place, side in zip((x, y), spacing, strict=True)]
    r = np.hypot(at[0][:, np.newaxis], at[1]).ravel()
    of_r = np.outer(weights, weights).ravel() * math.prod(spacing) / 4

    def of_wave(q):
        beside = E_star * q / 2 * float(wave(np.array(q))) - 1
        return beside * float(of_r @ special.j0(q * r))

    h = layer.thickness[0]
    ends = np.union1d(np.geomspace(1e-6, 20, 30) / h, np.arange(0, 20 / h, 20 / float(r.max())))
    parts = [
        integrate.quad(of_wave, *each, epsabs=1e-13, epsrel=1e-10)[0] for each in pairwise(ends)
    ]
    return math.fsum(parts) / (math.pi * E_star)


@pytest.mark.parametrize("number", [8, cases(200, 5)])
def test_the_free_kernel_is_that_of_an_independent_quadrature(number):
    rng, spacing = np.random.default_rng(3), (1.0, 0.8)
    for _ in range(number):
        layer = replace(random_layer(rng), thickness=10 ** rng.uniform(0, 2.5))
        if math.isinf(layer.base_young):
            layer = replace(layer, base_young=1e3)
        x, y = (int(10 ** rng.uniform(0, 2)) - 1 for _ in range(2))
        found, top = np.empty((1, y + 1)), np.empty((1, y + 1))
        layer.kernel(x, spacing, found)
        rl.Homogeneous(layer.E_star).kernel(x, spacing, top)
        beside = by_quadrature(layer, x * spacing[0], y * spacing[1], spacing)
        assert found[0, -1] == pytest.approx(top[0, -1] + beside, rel=1e-8)


@pytest.mark.parametrize("places", [(0, 1), (0, 12), (5, 80)])
@pytest.mark.parametrize(
    "layers",
    [
        rl.Layered(1.0, 0.3, 1.0, 1e-3, 0.2),  # a plate, which bends over ten times its thickness
        rl.Layered(1.0, 0.3, 0.5, 3.0, 0.2),
        rl.Layered([20.0, 1.0], [0.2, 0.45], [0.5, 8.0], 5.0, 0.3),
        rl.Layered([1.0, 20.0], [0.45, 0.2], [8.0, 0.5], 5.0, 0.3),
    ],
    ids=str,
)
def test_kernels_of_plates_and_of_several_layers_are_those_of_the_quadrature(layers, places):
    (x, y), spacing = places, (1.0, 0.8)
    found, top = np.empty((1, y + 1)), np.empty((1, y + 1))
    layers.kernel(x, spacing, found)
    rl.Homogeneous(layers.E_star).kernel(x, spacing, top)
    beside = by_quadrature(layers, x * spacing[0], y * spacing[1], spacing)
    assert found[0, -1] == pytest.approx(top[0, -1] + beside, rel=1e-8)


def test_the_modulus_is_that_of_short_waves_in_the_top_layer():
    layers = rl.Layered([2.0, 5.0], [0.3, 0.1], [0.1, 0.2], 7.0, 0.45)
    assert layers.E_star == pytest.approx(2.0 / (1 - 0.3**2))
    q = np.array([1e3])
    np.testing.assert_allclose(layers.spectrum(q), 2 / (layers.E_star * q), rtol=1e-12)


def test_a_layer_thinner_than_cells_still_has_a_kernel():
    """Coarser grids ask for it; many small cells together are a large one."""
    layer, n = rl.Layered(1.0, 0.4, 0.2, 50.0, 0.3), 9
    coarse, fine = np.zeros((3, 3)), np.zeros((3 * n, 3 * n))
    layer.kernel(0, (1.0, 1.0), coarse)
    layer.kernel(0, (1 / n, 1 / n), fine)
    i = np.arange(n) - n // 2
    for x, y in np.ndindex(3, 3):
        small = fine[np.abs(x * n + i)[:, np.newaxis], np.abs(y * n + i)]
        assert coarse[x, y] == pytest.approx(small.sum(), rel=1e-7)


# Spheres and punches


@pytest.mark.parametrize(
    ("poisson", "ratio", "stiffer"),
    # W. C. Hayes et al., J. Biomech. 5, 541 (1972), table 1
    [
        (0.3, 0.4, 1.472),
        (0.3, 1.0, 2.480),
        (0.3, 2.0, 4.336),
        (0.4, 1.0, 2.789),
        (0.5, 0.2, 1.281),
        (0.5, 1.0, 3.609),
        (0.5, 2.0, 9.069),
    ],
)
def test_a_punch_on_a_layer_is_that_of_the_published_table(poisson, ratio, stiffer):
    contact = LayeredContact(BondedLayer(1.0, poisson, 1.0), ratio)
    of_half_space = 2 * contact.E_star * ratio
    assert contact.stiffness / of_half_space == pytest.approx(stiffer, rel=0.01)


@pytest.mark.parametrize("ratio", [0.01, 0.3, 1.0, 4.0, 20.0])
@pytest.mark.parametrize("base", [math.inf, 1e3, 10.0, 0.1, 1e-3])
@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.5])
def test_the_stiffness_of_a_disc_is_that_of_fredholms_equation(poisson, base, ratio):
    """Which has the closed form of the waves, and is solved at Gauss's points."""
    exact = LayeredContact(BondedLayer(1.0, poisson, 1.0, base, 0.3), ratio).stiffness
    found = rl.Layered(1.0, poisson, 1.0, base, 0.3).disc_stiffness(ratio)
    assert found == pytest.approx(exact, rel=1e-11)


@pytest.mark.parametrize("base", [math.inf, 1e3, 1e-3])
def test_a_disc_on_a_layer_that_is_cut_into_several_is_the_same(base):
    """Be the first of them a hundredth of the whole, and the disc small or large."""
    for radius in (1e-2, 1.0, 300.0):
        whole = rl.Layered(1.0, 0.3, 1.0, base, 0.3).disc_stiffness(radius)
        cut = rl.Layered([1.0] * 3, [0.3] * 3, [0.01, 0.5, 0.49], base, 0.3)
        assert cut.disc_stiffness(radius) == pytest.approx(whole, rel=1e-11)


def test_a_disc_on_a_thin_layer_is_on_its_base_and_on_a_thick_one_on_the_layer():
    """A thin layer adds its thickness times the square of pressures, which grows as log(a / h)."""
    layer = rl.Layered(1.0, 0.3, 1.0, 7.0, 0.3)
    of_base, of_layer = (2 * young / (1 - 0.3**2) for young in (7.0, 1.0))
    radii = np.array([250.0, 500.0, 1000.0])
    thin = radii - np.array([layer.disc_stiffness(radius) for radius in radii]) / of_base
    assert np.diff(thin)[1] == pytest.approx(np.diff(thin)[0], rel=0.01)
    assert 0 < thin[2] < 0.01 * radii[2]
    thick = [layer.disc_stiffness(radius) / (of_layer * radius) - 1 for radius in (2e-3, 1e-3)]
    assert 0 < thick[1] < 1e-3
    assert thick[0] / thick[1] == pytest.approx(2, rel=0.01)
    rigid = BondedLayer(1.0, 0.3, 1.0)
    found = rl.Layered(1.0, 0.3, 1.0, math.inf).disc_stiffness(1e3)
    assert found == pytest.approx(math.pi * 1e6 * rigid.spring, rel=3e-3)


@pytest.mark.parametrize("count", [1, 9, 40])
def test_the_spherical_bessel_functions_are_those_of_scipy(count):
    x = np.geomspace(1e-6, 3e3, 400)
    wanted = special.spherical_jn(2 * np.arange(count)[:, np.newaxis], x)
    np.testing.assert_allclose(_spherical_bessel(count, x), wanted, rtol=1e-9, atol=1e-14)


@pytest.mark.parametrize("radius", [1e-3, 0.7, 1e4])
def test_a_disc_on_one_material_is_exact(radius):
    """However many layers or bodies it is called."""
    layers = rl.Layered([2.0, 2.0], [0.3, 0.3], [0.1, 0.4], 2.0, 0.3)
    wanted = pytest.approx(2 * 2.0 / (1 - 0.3**2) * radius, rel=1e-15)
    assert layers.disc_stiffness(radius) == wanted
    both = rl.Homogeneous(3.0) + rl.Homogeneous(1.5)
    assert both.disc_stiffness(radius) == pytest.approx(2 * 1.0 * radius, rel=1e-15)


def sphere(points, side, radius):
    x = (np.arange(points) + 0.5 - points / 2) * side / points
    return rl.Surface(-(x[:, np.newaxis] ** 2 + x**2) / (2 * radius), (side, side))


LAYERS = [(0.3, math.inf), (0.45, math.inf), (0.5, 100.0), (0.3, 100.0), (0.3, 0.01)]


@pytest.mark.parametrize(("poisson", "base"), LAYERS)
@pytest.mark.parametrize("ratio", [0.3, 1.0, 4.0])
def test_a_sphere_on_a_layer_is_lebedev_and_ufliands(poisson, base, ratio):
    radius, layer = 10.0, BondedLayer(1.0, poisson, 1.0, base, 0.3)
    contact = LayeredContact(layer, ratio)
    depth, force = contact.sphere(radius)
    half_space = rl.Layered(1.0, poisson, 1.0, base, 0.3)

    def error(n):  # the place of the rim between cells is chance: rms of some grids
        errors = []
        for points in (n, n + 3, n + 7, n + 10):
            body = sphere(points, 2.6 * ratio, radius)
            deepest = depth + float(body.heights.max())
            curve = rl.press(body, half_space=half_space, depths=[deepest])
            errors.append(curve.force[0] / force - 1)
            assert curve.stiffness[0] == pytest.approx(contact.stiffness, rel=1 / points)
        return float(np.sqrt(np.mean(np.square(errors))))

    coarse, fine = error(40), error(90)
    assert fine < 2e-4
    assert fine < 0.45 * coarse  # of rate one at least


# Limits


def rough(n, seed, sizes=(1.0, 1.0)):
    heights = rl.SelfAffine(hurst=0.8, rms_height=0.02, q_roll=20.0).surface(n, seed).heights
    return rl.Surface(heights, sizes)


@pytest.mark.parametrize("periodic", [False, True])
def test_thick_thin_and_equal_layers_are_the_half_spaces_that_they_are(periodic):
    body, forces = rough(64, 3), [1e-4, 3e-3]
    of_base = rl.Homogeneous(7.0 / (1 - 0.2**2), periodic)
    equal = rl.Layered(7.0, 0.2, 0.05, 7.0, 0.2, periodic)
    of_layer, thick = (
        rl.Homogeneous(1 / 0.91, periodic),
        rl.Layered(1.0, 0.3, 1e3, 7.0, 0.2, periodic),
    )
    for one, other, rtol in ((equal, of_base, 1e-10), (thick, of_layer, 1e-3)):
        found = rl.press(body, half_space=one, forces=forces, rtol=1e-11)
        usual = rl.press(body, half_space=other, forces=forces, rtol=1e-11)
        np.testing.assert_allclose(found.depth, usual.depth, rtol=rtol)
        np.testing.assert_allclose(found.stiffness, usual.stiffness, rtol=rtol)
    q = np.array([0.5, 5.0])  # a layer far thinner than these waves
    thin = rl.Layered(1.0, 0.3, 1e-6, 7.0, 0.2).spectrum(q)
    np.testing.assert_allclose(thin, of_base.spectrum(q), rtol=1e-4)


def test_a_thin_layer_on_a_rigid_base_is_springs_with_a_rate():
    """Waves feel springs up to the square of wavenumber and thickness."""
    radius, depth, errors = 2.0, 0.02, []
    for thickness in (0.04, 0.02):
        layer = rl.Layered(1.0, 0.2, thickness, math.inf)
        body = sphere(256, 0.7, radius)
        curve = rl.press(body, half_space=layer, depths=[depth])
        spring = closed(layer).spring
        of_springs = spring * math.pi * radius * depth**2
        errors.append(curve.force[0] / of_springs - 1)
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.15)
    assert abs(errors[1]) < 0.02


def test_even_pressure_displaces_a_periodic_layer_on_a_rigid_base_as_a_spring():
    layer = rl.Layered(1.0, 0.3, 0.05, math.inf, periodic=True)
    assert layer.spectrum(np.zeros(1))[0] == pytest.approx(1 / closed(layer).spring)
    body = rough(32, 1)
    deep = 4 * float(np.ptp(body.heights))
    curve = rl.press(body, half_space=layer, depths=[deep])
    assert curve.area_fraction[0] == 1
    assert curve.stiffness[0] == pytest.approx(closed(layer).spring, rel=1e-6)


def test_displacements_of_a_periodic_layer_on_an_elastic_base_count_from_their_mean():
    layer, body = rl.Layered(1.0, 0.3, 0.05, 20.0, 0.3, periodic=True), rough(32, 1)
    assert layer.mean_is_free
    assert not replace(layer, periodic=False).mean_is_free
    assert not replace(layer, base_young=math.inf).mean_is_free
    mean = float(np.mean(body.heights.max() - body.heights))
    curve = rl.press(body, half_space=layer, depths=[0.5 * mean], fields=True)
    moved = curve.fields[0].displacement
    assert abs(moved.mean()) < 1e-9 * np.abs(moved).max()
    with pytest.raises(rl.InputError, match="beyond reach: .* full contact at"):
        rl.press(body, half_space=layer, depths=[1.01 * mean])


# Dense solutions


STACKS = [
    rl.Layered(1.0, 0.49, 0.1, 100.0, 0.3),
    rl.Layered(1.0, 0.3, 0.06, math.inf),
    rl.Layered(30.0, 0.3, 0.05, 1.0, 0.3),
    rl.Layered([5.0, 0.5], [0.2, 0.4], [0.05, 0.1], 20.0, 0.3),
]
ALL = [replace(each, periodic=periodic) for each in STACKS for periodic in (False, True)]
NAMES = [f"{each.young}-{each.base_young}-{each.periodic}" for each in ALL]
# the layer bulges beside what presses it, and touches where the bodies do not overlap
FACING = [rl.Layered(1.0, 0.5, 0.05, math.inf) + rl.Homogeneous(50.0)]
FACING += [rl.Layered(1.0, 0.49, 0.05, math.inf, periodic=True) + rl.Homogeneous(50.0, True)]


def small(seed):
    return rl.Surface(rough(64, seed).heights[:16, :14], (0.6, 0.5))


@pytest.mark.parametrize("half_space", [*ALL, *FACING], ids=[*NAMES, "two", "two-periodic"])
def test_contacts_are_those_of_the_dense_solution(half_space):
    body = small(5)
    dense = DenseContact(BodyOn.of(body, half_space))
    depths = float(dense.body.separation.mean()) * np.array([0.2, 0.5, 0.9])
    curve = rl.press(body, half_space=half_space, depths=depths, fields=True, rtol=RTOL)
    assert_contacts_are_dense(curve, dense, depths)


@pytest.mark.parametrize("half_space", ALL, ids=NAMES)
def test_histories_with_a_hardness_are_those_of_the_dense_solution(half_space):
    body, hardness = small(6), 0.2 * half_space.E_star
    history = History(BodyOn.of(body, half_space), hardness)
    force = 0.3 * hardness * body.area
    forces = force * np.array([0.1, 0.6, 0.2, 1.0, 0.0, 0.5])
    given = {"forces": forces, "hardness": hardness, "rtol": RTOL}
    curve = rl.press(body, half_space=half_space, fields=True, **given)
    assert_history_is_dense(curve, history, forces)


@pytest.mark.parametrize("half_space", ALL, ids=NAMES)
def test_histories_of_bodies_that_stick_are_those_of_the_dense_solution(half_space):
    body = small(7)
    height = float(np.ptp(body.heights))
    law = rl.Exponential(0.02 * half_space.E_star * height, 0.2 * height)
    dense = DenseSticking(BodyOn.of(body, half_space), law)
    depths = height * np.array([-0.2, 0.1, 0.3, 0.5, 0.3, 0.1, -0.1, -0.4])
    curve = rl.press(body, half_space=half_space, law=law, depths=depths, fields=True, rtol=RTOL)
    assert_sticking_is_dense(curve, dense, depths)


@seeds(10, cases(1_000, share=10))
def test_random_problems_on_random_layers_are_certified(seeds):
    unsolved = []
    for seed in seeds:
        rng = np.random.default_rng([seed, 42])
        problem, layer = random_problem(rng), random_layer(rng)
        cell = max(problem.surface.spacing)
        thickness = cell * 10 ** rng.uniform(-0.3, 3)
        half_space = replace(
            layer.in_units(layer.E_star / E_STAR, layer.thickness[0] / thickness),
            periodic=problem.periodic,
        )
        curve = rl.press(problem.surface, half_space=half_space, throw=False, **problem.loads)
        solved = curve.converged
        assert (curve.residual[solved] <= 1e-6).all(), seed
        assert (curve.stiffness[solved] > 0).all(), seed
        assert np.isnan(curve.force[~solved]).all(), seed
        unsolved += [] if solved.all() else [seed]
    assert not unsolved


@seeds(5, cases(900, share=60))
def test_random_loads_on_plates_are_certified(seeds):
    """Noise and roughness; layers of 1 to 20 cells, 100 to 1e6 times as hard as their base."""
    for seed in seeds:
        rng = np.random.default_rng([seed, 7])
        shape, cell = rng.integers(48, 110, 2), rng.choice([1.0, 10.0])
        heights = rng.normal(size=shape)
        if rng.random() < 0.5:
            heights = rough(128, seed).heights[: shape[0], : shape[1]]
        plate = rl.Layered(
            young=1.0,
            poisson=rng.uniform(0, 0.49),
            thickness=cell * 10 ** rng.uniform(0, 1.3),
            base_young=10 ** rng.uniform(-6, -2),
            base_poisson=rng.uniform(0, 0.5),
            periodic=bool(rng.random() < 0.6),
        )
        depth = (heights.max() - heights.mean()) * rng.uniform(0.3, 0.9)
        body = rl.Surface(heights, (shape[0], shape[1] * cell))
        assert rl.press(body, half_space=plate, depths=[depth]).residual.max() <= 1e-6, seed


@pytest.mark.parametrize("seed", [0, 7, 16])
def test_noise_on_plates_is_found_though_those_that_join_lift_the_others(seed):
    """Where all overlaps join at once, their number rises and falls, and 5000 are not enough."""
    noise = rl.Surface(np.random.default_rng(seed).normal(size=(96, 96)), (1.0, 10.0))
    plate = rl.Layered(1.0, 0.3, 0.2, 1e-3, 0.3, periodic=True)
    depth = 0.6 * float(noise.heights.max() - noise.heights.mean())
    assert rl.press(noise, half_space=plate, depths=[depth]).convolutions.max() < 700


@pytest.mark.parametrize("seed", [3, 4])
def test_plates_are_found_in_some_hundred_convolutions(seed):
    """With the inverse convolution, cut to the contact, they take two hundred to a thousand."""
    plate, body = rl.Layered(1.0, 0.3, 0.05, 1e-3, 0.3, periodic=True), rough(64, seed)
    most = rl.press(body, half_space=plate, n_loads=2, throw=False).force[-1]
    curve = rl.press(body, half_space=plate, forces=most * np.array([0.05, 0.5]))
    assert curve.convolutions.max() < 100


# Two bodies, and what is refused


@pytest.mark.parametrize("periodic", [False, True])
def test_two_bodies_are_one_of_both_compliances(periodic):
    body, forces = rough(64, 3), [1e-4, 3e-3]
    one, other = (rl.Homogeneous(E_star, periodic) for E_star in (3.0, 1.5))
    assert (one + other).E_star == pytest.approx(1.0)
    found = rl.press(body, half_space=one + other, forces=forces, rtol=1e-11)
    usual = rl.press(body, E_star=1.0, periodic=periodic, forces=forces, rtol=1e-11)
    np.testing.assert_allclose(found.depth, usual.depth, rtol=1e-9)
    np.testing.assert_allclose(found.stiffness, usual.stiffness, rtol=1e-9)
    layer = rl.Layered(1.0, 0.3, 0.1, 20.0, 0.3, periodic)
    q = np.array([1.0, 10.0, 100.0])
    np.testing.assert_allclose((layer + one).spectrum(q), layer.spectrum(q) + one.spectrum(q))
    softer = rl.press(body, half_space=layer + one, forces=forces)
    assert (softer.depth > rl.press(body, half_space=layer, forces=forces).depth).all()


def test_what_bulges_beside_a_punch_touches_an_island_that_the_punch_does_not_reach():
    """Of two bodies one bulges; the gap is recomputed by plain transforms."""
    x, depth = (np.arange(64) + 0.5) / 64 - 0.5, 0.01
    r = np.hypot(x[:, np.newaxis], x)
    island = (r > 0.25) & (r < 0.33)
    body = rl.Surface(np.where(r < 0.2, 0.0, np.where(island, -1.06 * depth, -1.0)), (1.0, 1.0))
    both = rl.Layered(1.0, 0.5, 0.1, math.inf) + rl.Homogeneous(50.0)
    for half_space in (both, both.second + both.first):
        curve = rl.press(body, half_space=half_space, depths=[depth], fields=True)
        found = curve.fields[0]
        gap = displaced(half_space, found.pressure, body.spacing) - body.heights - depth
        assert found.contact[island].mean() > 0.4
        assert np.abs(gap[found.contact]).max() < 1e-5 * depth
        assert gap.min() > -1e-5 * depth


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"thickness": 0.0}, "thickness is 0.0; a positive, finite number is needed"),
        ({"thickness": -1.0}, "thickness is -1.0; a positive, finite number is needed"),
        ({"thickness": math.nan}, "thickness is nan; a positive, finite number is needed"),
        ({"young": "soft"}, 'young is "soft"; a positive, finite number is needed'),
        ({"young": math.inf}, "young is inf; a positive, finite number is needed"),
        (
            {"base_young": 0.0},
            "base_young is 0.0; a positive, finite number is needed, or math.inf",
        ),
        ({"poisson": 0.6}, "poisson is 0.6; a number from 0 to 0.5 is needed"),
        ({"poisson": -0.1}, "poisson is -0.1; a number from 0 to 0.5 is needed"),
        ({"base_poisson": 0.51}, "base_poisson is 0.51; a number from 0 to 0.5 is needed"),
        ({"young": [1.0, 2.0]}, "layers have 2 of young, 1 of poisson and 1 of thickness; as many"),
        (
            {"poisson": 0.5, "base_young": math.inf, "periodic": True},
            "a periodic layer of poisson 0.5 on a rigid base locks",
        ),
    ],
)
def test_layers_that_are_none_are_refused_in_one_line(given, message):
    usual = {"young": 1.0, "poisson": 0.3, "thickness": 0.1, "base_young": 2.0}
    with pytest.raises(rl.InputError, match=message):
        rl.Layered(**(usual | given))


def test_a_layer_thinner_than_half_a_cell_is_refused():
    layer, homogeneous = rl.Layered(1.0, 0.3, 0.4 / 64, 2.0), rl.Homogeneous(1.0)
    long_cells = rough(64, 1, sizes=(1.0, 0.25))
    for half_space in (layer, layer + homogeneous, homogeneous + layer):
        for body in (rough(64, 1), long_cells):
            with pytest.raises(rl.InputError, match="for the top layer, less than half a cell"):
                rl.press(body, half_space=half_space, forces=[1e-3])


def test_no_modulus_is_given_beside_layers():
    layer = rl.Layered(1.0, 0.3, 0.1, 2.0)
    with pytest.raises(rl.InputError, match="half_space and E_star are given"):
        rl.press(rough(64, 1), half_space=layer, E_star=1.0, forces=[1e-3])
