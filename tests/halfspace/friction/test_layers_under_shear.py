"""Layers under shear: of one material they are that material, thick ones hide their base."""

from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from halfspace.friction.dense_friction import DensePath
from halfspace.friction.dense_layers import beside_top, layered_matrix, top_of
from random_cases import seeds
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.shear import shear_on_grid

Q = np.array([0.01, 0.1, 1.0, 5.0, 40.0])
IMAGES = 3e-11  # to which sums over images are kept, of displacements below one


def parts(body):
    return (*body.shear_spectrum(Q), body.coupling_spectrum(Q), body.spectrum(Q))


def test_layers_of_one_material_are_that_material():
    layered = rl.Layered([2.0, 2.0], [0.3, 0.3], [0.1, 0.5], base_young=2.0, base_poisson=0.3)
    plain = rl.Homogeneous.of(2.0, 0.3)
    for found, expected in zip(parts(layered), parts(plain), strict=True):
        assert found == pytest.approx(expected, rel=1e-13)


def test_short_waves_feel_the_layer_and_long_ones_the_base():
    layered = rl.Layered(2.0, 0.3, 1.0, base_young=5.0, base_poisson=0.1)
    top, base = rl.Homogeneous.of(2.0, 0.3), rl.Homogeneous.of(5.0, 0.1)
    for q, alone, share in ((40.0, top, 1e-12), (1e-5, base, 1e-4)):
        waves = np.array([q])
        for found, expected in zip(
            (*layered.shear_spectrum(waves), layered.coupling_spectrum(waves)),
            (*alone.shear_spectrum(waves), alone.coupling_spectrum(waves)),
            strict=True,
        ):
            assert found == pytest.approx(expected, rel=share)


def test_even_shear_of_a_layer_on_a_rigid_base_shears_it_evenly():
    layered = rl.Layered([2.0, 1.0], [0.3, 0.25], [0.5, 0.2], base_young=np.inf, periodic=True)
    even = 0.5 / (2 / 2.6) + 0.2 / (1 / 2.5)
    for each in layered.shear_spectrum(np.array([0.0, 1e-5])):
        assert each == pytest.approx(even, rel=1e-8)
    assert layered.coupling_spectrum(np.array([0.0]))[0] == 0


def test_friction_on_layers_of_one_material_is_friction_on_it():
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.02).surface(16, rng=3)
    layered = rl.Layered(1.0, 0.3, 0.2, base_young=1.0, base_poisson=0.3, periodic=True)
    asked = {"friction": rl.Friction(0.3), "depths": [0.02, 0.03], "slides": [(0, 0), (1e-3, 5e-4)]}
    curves = [
        rl.press(surface, half_space=body, rtol=1e-8, **asked)
        for body in (layered, rl.Homogeneous.of(1.0, 0.3, periodic=True))
    ]
    assert curves[0].shear_force == pytest.approx(curves[1].shear_force, rel=1e-6, abs=1e-10)
    assert curves[0].force == pytest.approx(curves[1].force, rel=1e-7)


FREE = [
    rl.Layered(1.0, 0.3, 2.0, base_young=5.0, base_poisson=0.2),
    rl.Layered(1.0, 0.0, 3.0, base_young=np.inf),
    rl.Layered([20.0, 1.0], [0.2, 0.45], [1.5, 8.0], 5.0, 0.3),
    rl.Layered(1.0, 0.3, 1.0, 1e-2, 0.2),  # a plate
    rl.Layered(1.0, 0.5, 0.7, base_young=np.inf),  # which keeps its volume
]


def tables(body, rows, columns, spacing, first=0):
    """All five kernels."""
    found = [np.zeros((rows, columns)) for _ in range(5)]
    body.shear_kernel(first, spacing, tuple(found[:3]))
    body.coupling_kernel(first, spacing, tuple(found[3:]))
    return found


@pytest.mark.parametrize("layers", FREE, ids=str)
@pytest.mark.parametrize("place", [(0, 0), (0, 1), (3, 2), (12, 0), (40, 90)])
def test_free_kernels_are_those_of_a_quadrature_over_waves(layers, place):
    (x, y), spacing = place, (1.0, 0.7)
    found = tables(layers, 1, y + 1, spacing, x)
    alone = tables(top_of(layers), 1, y + 1, spacing, x)
    beside = beside_top(layers, (x * spacing[0], y * spacing[1]), spacing, points=12)
    scale = top_of(layers).spectrum(np.ones(1))[0]
    for one, other, added in zip(found, alone, beside, strict=False):
        assert abs(one[0, -1] - other[0, -1] - added) < 5e-12 * scale


def test_free_kernels_far_away_are_those_of_the_base():
    layers = rl.Layered([20.0, 1.0], [0.2, 0.45], [1.5, 8.0], 5.0, 0.3)
    base = rl.Homogeneous.of(5.0, 0.3)
    for far, share in ((1000, 0.03), (10**6, 3e-5), (10**8, 3e-7)):
        found, expected = (
            [each[0, -1] for each in tables(body, 1, 4, (1.0, far / 3), far)]
            for body in (layers, base)
        )
        assert found == pytest.approx(expected, rel=share)


@pytest.mark.parametrize("periodic", [False, "x", "y"])
def test_free_layers_of_one_material_are_pressed_and_sheared_as_it_is(periodic):
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.02).surface(16, rng=3)
    layered = rl.Layered([1.0, 1.0], 2 * [0.3], [0.2, 0.1], 1.0, 0.3, periodic=periodic)
    asked = {"friction": rl.Friction(0.3), "depths": [0.02, 0.03], "slides": [(0, 0), (1e-3, 5e-4)]}
    one, other = (
        rl.press(surface, half_space=body, rtol=1e-10, **asked)
        for body in (layered, rl.Homogeneous.of(1.0, 0.3, periodic=periodic))
    )
    for name in ("force", "shear_force", "shear_stiffness", "shear_stiffness_back"):
        scale = np.abs(getattr(other, name)).max()
        assert getattr(one, name) == pytest.approx(getattr(other, name), abs=1e-8 * scale)


@seeds(2, 24)
def test_friction_on_free_layers_is_that_node_by_node(seeds):
    for number in seeds:
        rng = np.random.default_rng([5, number])
        shape = tuple(map(int, rng.integers(8, 11, size=2)))
        spacing = 1.0, float(rng.choice([1.0, 0.7]))
        base = np.inf if number % 4 == 3 else 10 ** rng.uniform(-1, 1)
        layers = rl.Layered(0.9, rng.uniform(0, 0.5), rng.uniform(0.6, 4.0), base, 0.3)
        sizes = shape[0] * spacing[0], shape[1] * spacing[1]
        surface = rl.Surface(0.1 * rng.normal(size=shape), sizes=sizes)
        separation, mu = surface.heights.max() - surface.heights, rng.uniform(0.1, 0.8)
        depths = separation.mean() * np.array([0.5, 1.0, 1.0, 1.5, 0.6, 0.6])
        slides = np.cumsum(0.1 * rng.normal(size=(6, 2)), axis=0)
        asked = {"friction": rl.Friction(mu), "depths": depths, "slides": slides, "fields": True}
        curve = rl.press(surface, half_space=layers, rtol=1e-10, **asked)
        matrix = layered_matrix(layers, shape, spacing)
        assert abs(matrix - matrix.T).max() < 1e-14  # energy is symmetric
        path = DensePath(matrix, separation, mu)
        for depth, slide, fields in zip(depths, slides, curve.fields, strict=True):
            x, y, pressure = path.to(depth, slide).traction
            found = fields.shear[..., 0], fields.shear[..., 1], fields.pressure
            for one, other in zip(found, (x, y, pressure), strict=True):
                assert one.ravel() == pytest.approx(other, abs=1e-9 * pressure.max())


@pytest.mark.parametrize("periodic", ["x", "y"])
def test_a_strip_of_layers_is_its_free_kernel_with_all_its_images(periodic):
    """On a rigid base images fall exponentially, so that some are enough."""
    layers, shape, spacing = rl.Layered(1.0, 0.4, 2.0, np.inf), (6, 5), (1.0, 0.8)
    nodes = GridNodes.of(np.arange(30), shape)
    operator = shear_on_grid(replace(layers, periodic=periodic), shape, spacing)
    x, y, one = np.zeros((30, 2)), np.zeros((30, 2)), np.zeros(30)
    x[7, 0] = y[7, 1] = one[7] = 1.0
    found = [operator.displacement(each, nodes, nodes) for each in (x, y)]
    found.append(operator.by_pressure(one, nodes, nodes))
    images = 20
    known = tables(layers, 6 * images, 5 * images, spacing)
    i, j = (each - each[7] for each in np.divmod(np.arange(30), 5))
    expected = np.zeros((3, 30, 2))
    for image in range(1 - images, images):
        k, m = (i + 6 * image, j) if periodic == "x" else (i, j + 5 * image)
        xx, yy, xy, to_x, to_y = (each[abs(k), abs(m)] for each in known)
        across = xy * np.sign(k) * np.sign(m)
        expected[0] += np.transpose([xx, across])
        expected[1] += np.transpose([across, yy])
        expected[2] -= np.transpose([to_x * np.sign(k), to_y * np.sign(m)])
    assert np.array(found) == pytest.approx(expected, abs=IMAGES)


@pytest.mark.parametrize("young", [0.2, 5.0])
def test_a_sphere_on_a_thick_layer_slips_as_on_the_layer_alone(young):
    """Lebedev and Ufliand's correction falls as the thickness grows; so does that of the shear."""
    x = np.linspace(-0.975, 0.975, 40)
    sphere = rl.Surface(-(x[:, np.newaxis] ** 2 + x**2) / 20, sizes=(2.0, 2.0))
    asked = {"friction": rl.Friction(0.3), "forces": [0.03, 0.03], "shear_forces": [0.0, 4e-3]}
    alone = rl.press(sphere, half_space=rl.Homogeneous.of(1.0, 0.3), **asked)
    beside = []
    for thickness in (20.0, 40.0):
        layers = rl.Layered(1.0, 0.3, thickness, young, 0.3)
        curve = rl.press(sphere, half_space=layers, **asked)
        assert np.sign(curve.slide[-1, 0] - alone.slide[-1, 0]) == np.sign(1 - young)
        beside.append(abs(curve.slide[-1, 0] / alone.slide[-1, 0] - 1))
    assert beside[0] < 0.05
    assert beside[1] / beside[0] == pytest.approx(0.5, rel=0.05)


class _Foreign(rl.HalfSpace):
    """Free, and without a kernel of shear."""

    E_star, periodic = 1.0, False

    def spectrum(self, q):
        return 2 / q

    def shear_spectrum(self, q):
        return 2 / q, 2 / q

    def in_units(self, pressure, length):
        return self


def test_a_free_half_space_without_kernels_of_shear_is_refused_in_one_line():
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.02).surface(16, rng=3)
    with pytest.raises(rl.InputError, match="_Foreign has no shear_kernel, which friction"):
        rl.press(surface, half_space=_Foreign(), friction=rl.Friction(0.3), depths=[0.02])
