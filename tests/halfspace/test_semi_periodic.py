"""Strips, which repeat along one axis and are free across."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
import xarray

import roughline as rl
from halfspace.dense_contact import (
    BodyOn,
    DenseContact,
    assert_contacts_are_dense,
    assert_history_is_dense,
)
from halfspace.dense_hardness import History
from halfspace.test_adhesion_oracle import DenseSticking, assert_sticking_is_dense
from halfspace.test_foreign_half_space import Coating, OnRigidBase
from halfspace.test_layered import rough, small
from random_cases import cases, seeds
from random_problems import E_STAR, random_problem
from roughline.contact.patches import find_patches
from roughline.exact import lines
from roughline.halfspace.operators.convolution import displacement_field
from roughline.halfspace.operators.discretisation import coarser_grid, on_grid
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.restricted import RestrictedOperators

RTOL = 1e-9  # so that pressures hold to 1e-6
E = 2.0


# The kernel


def far_modulus(half_space):
    """Contact modulus that long waves feel; infinite on a rigid base, whose sums are finite."""
    if isinstance(half_space, rl.Homogeneous):
        return half_space.E_star
    if isinstance(half_space, Coating):
        return half_space.E_star / (1 - half_space.share)
    return half_space.base_young / (1 - half_space.base_poisson**2)


def datum(half_space, width):
    """How far away across displacements count from."""
    if not isinstance(half_space, rl.Layered):
        return width
    (young,), (poisson,), (thickness,) = (
        half_space.young,
        half_space.poisson,
        half_space.thickness,
    )
    return width + thickness * max(young / (1 - poisson**2) / far_modulus(half_space) - 1, 0)


def images(half_space, n, spacing, width, columns, most=20_000):
    """Sum the free kernel over images one by one, in long doubles, and take off what a line has.

    Rows are lags along the period of n cells, columns those across. What the sum up to m images
    misses falls as 1 / m² and 1 / m^4, which is extrapolated.
    """
    rows = np.empty(((most + 1) * n, columns))
    half_space.kernel(0, spacing, rows)
    rows = rows.astype(np.longdouble)
    of_line = 2 * math.prod(spacing) / (math.pi * far_modulus(half_space) * n * spacing[0])
    table = []
    for lag in range(n // 2 + 1):
        right, left = rows[n + lag :: n][: most - 1], rows[n - lag :: n][: most - 1]
        sums = rows[lag] + np.cumsum(right + left, axis=0)
        parts = [
            sums[m - 1] - of_line * np.log(np.longdouble((2 * m + 1) * n * spacing[0]))
            for m in (most // 4, most // 2, most - 1)
        ]
        once = (4 * parts[1] - parts[0]) / 3, (4 * parts[2] - parts[1]) / 3
        table.append((16 * once[1] - once[0]) / 15 + of_line * math.log(datum(half_space, width)))
    return np.array(table, dtype=float)


def kernel(half_space, shape, spacing):
    """The kernel of the operator on a grid, by lags up to half of the period and the width."""
    pressure = np.zeros(shape)
    pressure[0, 0] = 1.0
    found = displacement_field(on_grid(half_space, shape, spacing), pressure)
    x, y = (
        n // 2 + 1 if repeated else n for n, repeated in zip(shape, half_space.repeats, strict=True)
    )
    return found[:x, :y]


GRIDS = [
    ((6, 9), (1.0, 0.7)),
    ((7, 4), (0.3, 1.0)),
    ((1, 5), (1.0, 1.0)),
    ((2, 3), (2.0, 0.5)),
    ((37, 6), (1.0, 3.0)),
]


@pytest.mark.parametrize(("shape", "spacing"), GRIDS)
def test_the_kernel_is_that_of_all_images(shape, spacing):
    half_space = rl.Homogeneous(E, periodic="x")
    found = kernel(half_space, shape, spacing)
    width = shape[1] * spacing[1]
    wanted = images(half_space, shape[0], spacing, width, shape[1])
    assert np.abs(found - wanted).max() <= 1e-10 * wanted.max()
    across = kernel(replace(half_space, periodic="y"), shape[::-1], spacing[::-1])
    assert np.abs(found - across.T).max() <= 1e-13 * wanted.max()


def test_cells_as_long_as_the_period_are_lines():
    """On the mean over a cell of 2 / (pi E) ln(W / |y|), on a narrow period and a wide one."""
    for length, columns in ((1.0, 400), (50.0, 40)):
        found = kernel(rl.Homogeneous(E, "x"), (1, columns), (length, 0.1))[0]
        edges = np.abs(0.1 * (np.arange(columns + 1) - 0.5))
        integral = edges * (np.log(0.1 * columns / edges) + 1)
        integral[0] *= -1
        wanted = 2 / (math.pi * E) * np.diff(integral)
        assert np.abs(found - wanted).max() <= 1e-10 * wanted.max()


BASES = {"soft on hard": (1e3, 0.3), "hard on soft": (0.05, 0.2), "rigid": (math.inf, 0.0)}


@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("periods_thick", [None, 1.0, 10.0])
def test_the_kernel_of_layers_is_that_of_all_images(base, periods_thick):
    shape, spacing = (3, 4), (1.0, 0.8)
    thickness = max(spacing) if periods_thick is None else periods_thick * 3
    half_space = rl.Layered(1.0, 0.3, thickness, *BASES[base], periodic="x")
    most = 400_000 if base == "hard on soft" else 20_000
    wanted = images(half_space, shape[0], spacing, 3.2, 4, most)
    found = kernel(half_space, shape, spacing)
    assert np.abs(found - wanted).max() <= 1e-8 * np.abs(wanted).max()


def in_plane_strain(half_space, reach, y, dy):
    """Displacement by a line of unit force per length, spread over a width, at a distance.

    It is the mean along the period of what a strip's cell displaces. That of the top material is in
    closed form, and the waves across give the rest by quadrature. What long waves have of it, as if
    on the far modulus alone, ends at exp(-gamma) / reach, which leaves 2 / (pi E) ln(reach / y).
    """
    top, far = half_space.E_star, far_modulus(half_space)

    def integral(t):
        return t * math.log(reach / abs(t)) + t

    of_top = 2 / (math.pi * top) * (integral(y + dy / 2) - integral(y - dy / 2)) / dy
    cut = math.exp(-np.euler_gamma) / reach

    shortest = 25 / half_space.thickness[0]
    turns = np.arange(1.0, shortest * (y + dy), 2.0) / (y + dy)
    ends = np.log(np.unique([*np.geomspace(1e-10 / reach, shortest, 150), cut, *turns]))
    nodes, weights = np.polynomial.legendre.leggauss(16)
    half, middle = np.diff(ends)[:, np.newaxis] / 2, (ends[1:] + ends[:-1])[:, np.newaxis] / 2
    q = np.exp(middle + half * nodes)
    beside = (q * half_space.spectrum(q) - 2 / top) * np.cos(q * y)
    beside *= np.sinc(q * dy / (2 * math.pi))
    beside -= np.where(q < cut, 2 / far - 2 / top, 0.0)
    return of_top + float((half * weights * beside).sum()) / math.pi


@pytest.mark.parametrize(
    ("base", "periods_thick"),
    [*itertools.product([1e3, 1e-3], [0.3, 1.0, 10.0]), (1e-5, 100.0), (3e-5, 1000.0)],
)
def test_the_mean_along_the_period_is_plane_strain(base, periods_thick):
    """Moduli 1 : 1000 both ways and more, without images: this judges the datum itself."""
    shape, spacing = (3, 4), (1.0, 0.8)
    half_space = rl.Layered(1.0, 0.3, periods_thick * 3, base, 0.2, periodic="x")
    table = kernel(half_space, shape, spacing)
    mean = (table[0] + 2 * table[1]) / spacing[1]
    reach = datum(half_space, 3.2)
    wanted = [in_plane_strain(half_space, reach, j * 0.8, 0.8) for j in range(4)]
    np.testing.assert_allclose(mean, wanted, rtol=0, atol=1e-8 * np.abs(wanted).max())


def test_layers_that_spread_a_load_too_far_are_refused_in_one_line():
    half_space = rl.Layered(1.0, 0.3, 1e6, 1e-12, 0.3, periodic="x")
    with pytest.raises(
        rl.InputError, match="spread a load over .* periods of the strip"
    ) as refused:
        kernel(half_space, (3, 4), (1.0, 0.8))
    assert "\n" not in str(refused.value)


# Lines


def cylinder(n, width, radius, points_along=4, length=1.3):
    y = (np.arange(n) + 0.5 - n / 2) * width / n
    return rl.Surface(np.tile(-(y**2) / (2 * radius), (points_along, 1)), (length, width))


def turned(surface):
    return rl.Surface(np.ascontiguousarray(surface.heights.T), surface.sizes[::-1])


WIDTH, RADIUS, HALF = 4.0, 10.0, 0.8  # of the strip, of the cylinder, and of its contact
LINE = lines.Cylinder(RADIUS, math.pi * E * HALF**2 / (4 * RADIUS), E, datum=WIDTH)


def test_a_cylinder_is_hertz_line_contact_with_a_rate():
    """Johnson (1985) §4.2(c): the depth is that of his pressure under (2 / pi E) ln(W / |y|)."""

    def errors(n):  # the place of the edge between cells is chance: rms of some grids
        found = []
        for points in (n, n + 3, n + 7, n + 10):
            surface = cylinder(points, WIDTH, RADIUS)
            length = surface.sizes[0]
            force = LINE.force * length
            curve = rl.press(surface, E_star=E, periodic="x", forces=[force], fields=True)
            (fields,) = curve.fields
            y = (np.arange(points) + 0.5 - points / 2) * WIDTH / points
            hertz, peak = LINE.pressure(y), float(LINE.pressure(0.0))
            found.append(
                [
                    (curve.depth[0] - surface.heights.max()) / LINE.depth - 1,
                    curve.stiffness[0] / (LINE.stiffness * length) - 1,
                    np.abs(fields.pressure - hertz).mean() / peak,
                    fields.pressure.max() / peak - 1,
                ]
            )
        return np.sqrt(np.mean(np.square(found), axis=0))

    coarse, fine = errors(60), errors(240)
    assert (fine < [3e-5, 5e-3, 3e-4, 2e-4]).all()
    assert (fine < coarse * [1 / 8, 1 / 3, 1 / 4, 1 / 4]).all()


def test_the_stiffness_of_a_cylinder_is_the_slope_of_its_forces():
    surface = cylinder(201, WIDTH, RADIUS)
    depths = LINE.depth * np.array([1 - 1e-6, 1, 1 + 1e-6])
    curve = rl.press(surface, E_star=E, periodic="x", depths=depths, rtol=1e-11)
    slope = (curve.force[2] - curve.force[0]) / (depths[2] - depths[0])
    assert curve.stiffness[1] == pytest.approx(slope, rel=1e-6)


def test_a_flat_strip_is_a_rigid_punch_with_a_rate():
    """Its pressure P / (pi sqrt(a² - y²)) lies as deep everywhere: 2 P / (pi E) ln(2 W / a)."""
    depth, errors = 1 / lines.strip_stiffness(E, WIDTH / 2, datum=WIDTH), []
    for n in (50, 100, 200):
        surface = rl.Surface(np.zeros((3, n)), (0.7, WIDTH))
        curve = rl.press(surface, E_star=E, periodic="x", forces=[0.7], fields=True)
        errors.append(curve.depth[0] / depth - 1)
        assert curve.stiffness[0] == pytest.approx(0.7 / curve.depth[0], rel=1e-6)
        y = (np.arange(n) + 0.5 - n / 2) * WIDTH / n
        wanted = lines.strip_pressure(1.0, WIDTH / 2, y)
        inner = slice(n // 5, n - n // 5)
        np.testing.assert_allclose(
            curve.fields[0].pressure[:, inner], np.tile(wanted[inner], (3, 1)), rtol=1 / n
        )
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.05)
    assert errors[1] / errors[2] == pytest.approx(2, rel=0.05)


def test_what_is_even_along_the_strip_is_pressed_evenly():
    curve = rl.press(
        cylinder(64, WIDTH, RADIUS, 6),
        E_star=E,
        periodic="x",
        depths=[LINE.depth],
        fields=True,
        rtol=1e-12,
    )
    pressure = curve.fields[0].pressure
    assert np.ptp(pressure, axis=0).max() <= 1e-11 * pressure.max()
    one = rl.press(
        cylinder(64, WIDTH, RADIUS, 1),
        E_star=E,
        periodic="x",
        depths=[LINE.depth],
        fields=True,
        rtol=1e-12,
    )
    np.testing.assert_allclose(one.fields[0].pressure[0], pressure[0], atol=1e-11 * pressure.max())


LAYER = rl.Layered(1.0, 0.3, 0.07, 20.0, 0.3)


@pytest.mark.parametrize("half_space", [rl.Homogeneous(E), LAYER])
def test_a_strip_along_y_is_that_along_x_turned(half_space):
    body = rl.Surface(rough(64, 3).heights[:, :45], (1.0, 0.6))
    given = {"forces": [1e-3, 2e-2], "fields": True, "rtol": 1e-11}
    one = rl.press(body, half_space=replace(half_space, periodic="x"), **given)
    other = rl.press(turned(body), half_space=replace(half_space, periodic="y"), **given)
    np.testing.assert_allclose(one.depth, other.depth, rtol=1e-11)
    np.testing.assert_allclose(one.stiffness, other.stiffness, rtol=1e-9)
    np.testing.assert_allclose(
        one.area_fraction_corrected, other.area_fraction_corrected, rtol=1e-12
    )
    for here, there in zip(one.fields, other.fields, strict=True):
        pressure = here.pressure
        assert np.abs(pressure - there.pressure.T).max() <= 1e-9 * pressure.max()


# Dense solutions


@dataclass(frozen=True)
class StripOn(BodyOn):
    """Heights over a strip, along x, by images that are summed one by one."""

    @classmethod
    def of(cls, surface, half_space):
        return cls(surface.heights, surface.sizes, half_space.E_star, False, half_space)

    def matrix(self):
        (nx, ny), (length, width) = self.heights.shape, self.sizes
        table = images(self.half_space, nx, (length / nx, width / ny), width, ny, 4000)
        i, j = (each.ravel()[:, np.newaxis] - each.ravel() for each in np.indices((nx, ny)))
        return table[np.minimum(i % nx, -i % nx), np.abs(j)]


STRIPS = [
    rl.Homogeneous(E, periodic="x"),
    rl.Layered(1.0, 0.49, 0.1, 100.0, 0.3, periodic="x"),
    rl.Layered(1.0, 0.3, 0.06, math.inf, periodic="x"),
    rl.Layered(30.0, 0.3, 0.05, 1.0, 0.3, periodic="x"),
]
NAMES = ["homogeneous", "soft on hard", "rigid base", "hard on soft"]


@pytest.mark.parametrize("half_space", STRIPS, ids=NAMES)
def test_contacts_are_those_of_the_dense_solution(half_space):
    body = small(5)
    dense = DenseContact(StripOn.of(body, half_space))
    depths = float(dense.body.separation.mean()) * np.array([0.3, 0.8, 1.5, 4.0])
    curve = rl.press(body, half_space=half_space, depths=depths, fields=True, rtol=RTOL)
    assert_contacts_are_dense(curve, dense, depths)


@pytest.mark.parametrize("half_space", STRIPS, ids=NAMES)
def test_histories_with_a_hardness_are_those_of_the_dense_solution(half_space):
    body, hardness = small(6), 0.2 * half_space.E_star
    history = History(StripOn.of(body, half_space), hardness)
    force = 0.3 * hardness * body.area
    forces = force * np.array([0.1, 0.6, 0.2, 1.0, 0.0, 0.5])
    given = {"forces": forces, "hardness": hardness, "rtol": RTOL}
    curve = rl.press(body, half_space=half_space, fields=True, **given)
    assert_history_is_dense(curve, history, forces)


@pytest.mark.parametrize("law", [rl.Exponential, rl.Dugdale])
@pytest.mark.parametrize("half_space", STRIPS, ids=NAMES)
def test_histories_of_bodies_that_stick_are_those_of_the_dense_solution(half_space, law):
    body = small(7)
    height = float(np.ptp(body.heights))
    law = law(0.02 * half_space.E_star * height, (0.2 if law is rl.Exponential else 0.8) * height)
    dense = DenseSticking(StripOn.of(body, half_space), law)
    depths = height * np.array([-0.2, 0.1, 0.3, 0.5, 0.3, 0.1, -0.1, -0.4])
    curve = rl.press(body, half_space=half_space, law=law, depths=depths, fields=True, rtol=RTOL)
    assert_sticking_is_dense(curve, dense, depths)


# Limits


def test_a_surface_that_is_repeated_twice_is_pressed_alike():
    body = rl.Surface(rough(64, 4).heights[:, :50], (1.0, 0.8))
    twice = rl.Surface(np.tile(body.heights, (2, 1)), (2.0, 0.8))
    given = {"E_star": E, "periodic": "x", "fields": True, "rtol": 1e-11}
    one = rl.press(body, forces=[5e-3, 0.1], **given)
    both = rl.press(twice, forces=[1e-2, 0.2], **given)
    np.testing.assert_allclose(one.depth, both.depth, rtol=1e-9)
    np.testing.assert_allclose(2 * one.stiffness, both.stiffness, rtol=1e-8)
    for here, there in zip(one.fields, both.fields, strict=True):
        tiled = np.tile(here.pressure, (2, 1))
        assert np.abs(tiled - there.pressure).max() <= 1e-8 * tiled.max()


def test_a_ball_far_from_its_images_is_alone_with_a_rate():
    """What images displace is even but for the square of place over distance."""
    radius, force, cell, errors = 1.0, 4 / 3 * E * 0.2**3, 0.025, []
    for n in (64, 128, 256):
        x, y = ((np.arange(m) + 0.5 - m / 2) * cell for m in (n, 32))
        heights = -(x[:, np.newaxis] ** 2 + y**2) / (2 * radius)
        ball = rl.Surface(heights, (n * cell, 32 * cell))
        given = {"E_star": E, "forces": [force], "fields": True, "rtol": 1e-10}
        alone, repeated = (rl.press(ball, periodic=each, **given) for each in (False, "x"))
        pressure = alone.fields[0].pressure
        errors.append(np.abs(repeated.fields[0].pressure - pressure).max() / pressure.max())
    assert errors[2] < 2e-4
    assert errors[1] < errors[0] / 6
    assert errors[2] < errors[1] / 6


def test_layers_of_equal_materials_are_one_material():
    body, forces = rough(48, 3), [1e-3, 3e-2]
    equal = rl.Layered(7.0, 0.2, 0.05, 7.0, 0.2, "x")
    found = rl.press(body, half_space=equal, forces=forces, rtol=1e-11)
    usual = rl.press(body, E_star=7.0 / 0.96, periodic="x", forces=forces, rtol=1e-11)
    np.testing.assert_allclose(found.depth, usual.depth, rtol=1e-10)
    np.testing.assert_allclose(found.stiffness, usual.stiffness, rtol=1e-10)


def test_two_bodies_are_one_of_both_compliances():
    body, forces = rough(48, 3), [1e-3, 3e-2]
    both = rl.Homogeneous(3.0, "x") + rl.Homogeneous(1.5, "x")
    found = rl.press(body, half_space=both, forces=forces)
    usual = rl.press(body, E_star=1.0, periodic="x", forces=forces)
    np.testing.assert_allclose(found.depth, usual.depth, rtol=1e-9)
    softer = rl.press(body, half_space=both + replace(LAYER, periodic="x"), forces=forces)
    assert (softer.depth > found.depth).all()


def test_a_wide_thin_layer_on_a_rigid_base_counts_from_the_base():
    """In full contact it is springs, but near the two sides."""
    layer = rl.Layered(1.0, 0.2, 0.02, math.inf, periodic="x")
    flat = rl.Surface(np.zeros((4, 200)), (0.08, 4.0))
    curve = rl.press(flat, half_space=layer, depths=[0.001])
    spring = 0.8 / (1.2 * 0.6) / 0.02
    assert curve.stiffness[0] == pytest.approx(spring * flat.area, rel=0.01)


@pytest.mark.parametrize("thickness", [0.5, 5.0, 500.0])
@pytest.mark.parametrize("base", [1e-3, 1e3, math.inf])
def test_a_flat_punch_is_pushed_down_on_any_layer(base, thickness):
    """Depths count from so far away that no layer gives a force without depth."""
    layer = rl.Layered(1.0, 0.0, thickness, base, periodic="x")
    for sizes in ((1.0, 1.0), (10.0, 0.5), (0.5, 2.0)):
        flat = rl.Surface(np.zeros((12, 12)), sizes)
        curve = rl.press(flat, half_space=layer, depths=[0.01, 0.02])
        assert (curve.force > 0).all()
        assert curve.stiffness[0] == pytest.approx(curve.force[0] / 0.01, rel=1e-5)


# Everything of a press


def test_a_half_space_of_ones_own_is_a_strip_by_its_kernel():
    """Whose kernel loses digits with the distance, and which says that it is pushed everywhere."""

    class Pushed(Coating):
        is_pushed_everywhere = True

    strip, body = Pushed(2.0, 0.6, 0.05, "x"), small(9)
    dense = DenseContact(StripOn.of(body, strip))
    depth = float(dense.body.separation.mean())
    _, pressure = dense.at_depth(dense.body.separation, depth, 0.0, np.inf)
    curve = rl.press(body, half_space=strip, depths=[depth], fields=True, rtol=RTOL)
    found = curve.fields[0].pressure.ravel()
    assert np.abs(found - pressure).max() <= 1e-6 * pressure.max()


def test_a_half_space_without_a_kernel_is_no_strip():
    class Waves(OnRigidBase):
        periodic = "x"

        def in_units(self, pressure, length):
            return Waves(self.E_star / pressure, self.thickness / length)

    with pytest.raises(rl.InputError, match="Waves has no kernel, which a free half-space needs"):
        rl.press(small(9), half_space=Waves(1.0, 0.1), depths=[0.01])


def test_a_shift_along_the_strip_only_moves_the_answer():
    body = rl.Surface(rough(64, 8).heights[:, :40], (1.0, 0.7))
    moved = rl.Surface(np.roll(body.heights, 21, axis=0), body.sizes)
    given = {"E_star": E, "periodic": "x", "fields": True, "rtol": 1e-11}
    one, other = (rl.press(each, forces=[1e-3, 5e-2], **given) for each in (body, moved))
    np.testing.assert_allclose(one.stiffness, other.stiffness, rtol=1e-9)
    np.testing.assert_allclose(one.area_fraction_most, other.area_fraction_most, rtol=1e-12)
    for here, there in zip(one.fields, other.fields, strict=True):
        pressure = np.roll(here.pressure, 21, axis=0)
        assert np.abs(pressure - there.pressure).max() <= 1e-9 * pressure.max()
        np.testing.assert_allclose(here.patches().areas, there.patches().areas, rtol=1e-12)


@pytest.mark.parametrize("periodic", ["x", "y"])
@seeds(5, cases(200, share=10))
def test_random_problems_on_random_strips_are_certified(periodic, seeds):
    unsolved = []
    for seed in seeds:
        rng = np.random.default_rng([seed, 77])
        problem = random_problem(rng)
        half_space = rl.Homogeneous(E_STAR, periodic)
        if rng.random() < 0.5:
            cell = max(problem.surface.spacing)
            base = math.inf if rng.random() < 0.25 else 1e3 ** rng.uniform(-1, 1)
            thickness = cell * 10 ** rng.uniform(-0.3, 3)
            of_base = rng.uniform(0, 0.5)
            layer = rl.Layered(1.0, rng.uniform(0, 0.499), thickness, base, of_base, periodic)
            half_space = layer.in_units(layer.E_star / E_STAR, 1.0)
        curve = rl.press(problem.surface, half_space=half_space, throw=False, **problem.loads)
        solved = curve.converged
        assert (curve.residual[solved] <= 1e-6).all(), seed
        assert (curve.stiffness[solved] > 0).all(), seed
        unsolved += [] if solved.all() else [seed]
    assert unsolved == []


@pytest.mark.parametrize("shape", [(256, 256), (256, 150), (192, 250)])
@pytest.mark.parametrize("periodic", ["x", "y"])
def test_steps_on_a_restricted_operator_end_as_exact_ones(shape, periodic, monkeypatch):
    whole = rl.SelfAffine(hurst=0.7, rms_height=0.01, q_roll=20.0).surface(256, 5)
    body = rl.Surface(whole.heights[: shape[0], : shape[1]], (shape[0] / 256, shape[1] / 200))
    body = body if periodic == "x" else turned(body)
    given = {"E_star": 1.0, "periodic": periodic, "fields": True, "rtol": 1e-9}
    forces = np.array([1e-4, 3e-3, 0.03]) * body.area
    restricted, made = RestrictedOperators.on, []

    def recorded(self, nodes):
        found = restricted(self, nodes)
        made.append(found is not None)
        return found

    monkeypatch.setattr(RestrictedOperators, "on", recorded)
    found = rl.press(body, forces=forces, **given)
    assert any(made)
    monkeypatch.setattr(RestrictedOperators, "on", lambda self, nodes: None)
    exact = rl.press(body, forces=forces, **given)
    np.testing.assert_allclose(found.depth, exact.depth, rtol=1e-8)
    np.testing.assert_allclose(found.stiffness, exact.stiffness, rtol=1e-6)
    for here, there in zip(found.fields, exact.fields, strict=True):
        assert np.abs(here.pressure - there.pressure).max() <= 1e-6 * there.pressure.max()
        np.testing.assert_array_equal(here.contact, there.contact)


@pytest.mark.parametrize("half_space", [rl.Homogeneous(1.0), LAYER])
@pytest.mark.parametrize("periodic", ["x", "y"])
def test_a_restricted_operator_displaces_about_as_the_exact_one(periodic, half_space):
    shape = (128, 288)
    operator = on_grid(replace(half_space, periodic=periodic), shape, (0.01, 0.013))
    rng = np.random.default_rng(1)
    x, y = rng.integers(0, shape[0], 60), rng.integers(0, shape[1], 60)
    x[:20], y[20:40] = rng.choice([0, 1, 126, 127], 20), rng.choice([0, 1, 286, 287], 20)
    nodes = GridNodes.of(np.unique(x * shape[1] + y), shape)
    margins = 8, 16
    operators = RestrictedOperators(operator, margins)
    restricted = operators.on(nodes)
    pressure = rng.uniform(0, 1, nodes.indices.size)
    for _ in range(2):  # and it leaves its memory as it found it
        found = restricted.displacement(pressure, nodes, nodes)
        wanted = operator.displacement(pressure, nodes, nodes)
        assert np.abs(found - wanted).max() <= 5e-3 * np.abs(wanted).max()
        assert not operators.grid.values.any()


def test_patches_go_on_across_the_borders_that_repeat_alone():
    contact = np.zeros((8, 6), dtype=bool)
    contact[[0, 7], 2] = True  # one patch along x
    contact[4, [0, 5]] = True  # one along y
    contact[0, 5] = contact[7, 0] = True  # one across a corner
    counts = {
        each: find_patches(contact, contact * 1.0, (8.0, 6.0), periodic=each).count
        for each in (False, True, "x", "y")
    }
    assert counts == {False: 6, True: 3, "x": 5, "y": 5}
    along = find_patches(contact, contact * 1.0, (8.0, 6.0), periodic="x")
    turn = find_patches(contact.T, contact.T * 1.0, (6.0, 8.0), periodic="y")
    np.testing.assert_array_equal(along.areas, turn.areas)
    ring = np.zeros((8, 6), dtype=bool)
    ring[:, 3] = True
    (centre,) = find_patches(ring, ring * 1.0, (8.0, 6.0), periodic="x").centroids
    assert np.isnan(centre[0])
    assert centre[1] == 3.5


@pytest.mark.parametrize("n", [32, 64])
def test_a_fluid_meets_the_sides_that_the_strip_has(n):
    body = rl.Surface(rough(n, 2).heights[:, : 3 * n // 4], (1.0, 0.7))
    curve = rl.press(
        body,
        E_star=1.0,
        periodic="x",
        forces=[0.02],
        fields=True,
        measures=[rl.hydraulic_aperture("x"), rl.hydraulic_aperture("y")],
    )
    fields = curve.fields[0]
    assert fields.periodic == "x"
    assert fields.repeats == (True, False)
    assert not fields.is_periodic
    along_x, along_y = rl.flow(fields, along="both")
    assert not along_x.has_ends
    assert along_y.has_ends
    for flow in (along_x, along_y):
        assert flow.sides == "x"
        wanted = rl.flow(
            np.where(fields.contact, 0.0, fields.gap), fields.sizes, along=flow.along, sides="x"
        )
        assert flow.hydraulic_aperture == wanted.hydraulic_aperture
        name = rl.hydraulic_aperture(flow.along).name
        assert curve.measured[name].values[0] == pytest.approx(flow.hydraulic_aperture, rel=1e-9)
    sealed = rl.sealing_pressure(body, half_space=rl.Homogeneous(1.0, "x"), along="y")
    assert 0 < sealed.low < sealed.high


def test_spaced_loads_and_grid_errors_and_files_are_those_of_any_press(tmp_path):
    body = rough(64, 6)
    curve = rl.press(body, E_star=1.0, periodic="x", n_loads=6, grid_error=True)
    assert curve.converged.all()
    assert (np.diff(curve.stiffness) > 0).all()
    assert np.isfinite(curve.stiffness_error).all()
    assert curve.settings["boundary"] == curve.half_space.boundary == "periodic along x"
    assert curve.to_dataset().attrs["boundary"] == "periodic along x"
    curve.write(tmp_path / "curve.nc")
    with xarray.open_dataset(tmp_path / "curve.nc", engine="h5netcdf") as written:
        assert written.attrs["boundary"] == "periodic along x"
        np.testing.assert_array_equal(written["depth"], curve.depth)
    assert "periodic along x half-space" in curve._repr_html_()
    sticking = rl.press(body, E_star=1.0, law=rl.Exponential(1e-5, 5e-3), periodic="y", n_loads=12)
    assert sticking.converged.all()


def test_a_piece_is_warned_of_the_borders_that_it_has():
    heights = rough(64, 3).heights[:48, :48] - np.linspace(0, 0.3, 48)[:, np.newaxis]
    piece = rl.Surface(heights, (1.0, 1.0), is_cut_out=True)
    jumps = {
        each: [text for text in curve.warnings if "the map jumps by" in text]
        for each in ("x", "y")
        for curve in [rl.press(piece, E_star=1.0, periodic=each, forces=[0.05])]
    }
    assert "50 times" not in jumps["y"][0]
    ratios = {each: float(text[0].split("borders, ")[1].split()[0]) for each, text in jumps.items()}
    assert ratios["x"] > 5 * ratios["y"]
    border = rl.press(
        rl.Surface(np.zeros((20, 20)), (1.0, 1.0), is_cut_out=True),
        E_star=1.0,
        periodic="y",
        forces=[0.1],
    )
    assert any("within 5% of the border" in text for text in border.warnings)


def test_coarser_grids_keep_the_period_and_double_cells_across():
    shape, spacing = coarser_grid((9, 7), (0.3, 0.7), periodic="x")
    assert shape == (5, 4)
    assert spacing == pytest.approx((9 * 0.3 / 5, 1.4))
    assert coarser_grid((7, 9), (0.7, 0.3), periodic="y")[1] == pytest.approx(spacing[::-1])


def test_an_estimate_lies_between_those_of_both_boundaries():
    free, strip, periodic = (
        rl.estimate((2048, 2048), 3, periodic=each, area_fraction=0.1).memory
        for each in (False, "x", True)
    )
    assert periodic < strip < free


# What is refused


@pytest.mark.parametrize(
    "call",
    [
        lambda: rl.Homogeneous(1.0, periodic="z"),
        lambda: rl.Layered(1.0, 0.3, 0.1, 2.0, periodic="z"),
        lambda: rl.press(rough(16, 1), E_star=1.0, periodic="z", forces=[1.0]),
        lambda: rl.estimate((64, 64), 1, periodic="z"),
    ],
)
def test_a_boundary_that_is_none_is_refused_in_one_line(call):
    with pytest.raises(rl.InputError, match='^periodic is "z"; True, False, "x" or "y" is needed$'):
        call()


def test_bodies_of_other_boundaries_are_not_added():
    with pytest.raises(
        rl.InputError, match="one half-space is periodic along x and the other is p"
    ):
        rl.Homogeneous(1.0, "x") + rl.Homogeneous(1.0, True)


def test_a_line_does_not_repeat():
    line = rl.SelfAffine(hurst=0.8, rms_height=0.01).line(64, rng=1)
    with pytest.raises(rl.InputError, match="periodic, fields and grid_error belong to the full"):
        rl.press(line, E_star=1.0, depths=[0.1], periodic="x")


def test_a_layer_that_keeps_its_volume_may_be_a_strip_on_a_rigid_base():
    """It moves aside, where it is free across."""
    layer = rl.Layered(1.0, 0.5, 0.1, math.inf, periodic="x")
    curve = rl.press(rl.Surface(np.zeros((4, 64)), (0.1, 1.0)), half_space=layer, depths=[0.01])
    assert curve.force[0] > 0
