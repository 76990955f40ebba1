"""The half-space's kernel and convolution against high precision and dense matrices."""

from math import cos, pi, sin

import mpmath
import numpy as np
import pytest

from halfspace.dense_contact import love_matrix
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.elasticity.kernel import love
from roughline.halfspace.operators.convolution import displacement_field
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.grid_nodes import GridNodes

KERNEL = 4e-15  # relative


def love_to_50_digits(x, y, dx, dy):
    with mpmath.workdps(50):
        x, y, dx, dy = map(mpmath.mpf, (x, y, dx, dy))

        def corner(a, b):
            if a == 0 or b == 0:
                return mpmath.mpf(0)
            return a * mpmath.asinh(b / abs(a)) + b * mpmath.asinh(a / abs(b))

        right, left, top, bottom = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
        total = corner(right, top) - corner(left, top) - corner(right, bottom)
        return float((total + corner(left, bottom)) / mpmath.pi)


cells = pytest.mark.parametrize(
    ("dx", "dy"),
    [
        *((1.0, 1.0), (1.0, 0.7), (1.0, 0.1), (0.1, 1.0), (1e-9, 3e-9), (1e6, 2e6)),
        *((1.0, 0.01), (1.0, 0.001), (0.001, 1.0)),
    ],
)


@cells
def test_the_kernel_is_exact_from_0_to_16384_cells(dx, dy):
    rng = np.random.default_rng(0)
    near = [(i, j) for i in range(8) for j in range(8)]
    far = (2 ** rng.uniform(0, 14, size=(300, 2))).astype(int).tolist()
    edges = [(0, 16384), (16384, 0), (16384, 16384), (3, 16), (16, 3), (64, 1), (1, 64), (0, 65)]
    for i, j in [*near, *far, *edges]:
        expected = love_to_50_digits(i * dx, j * dy, dx, dy)
        assert love([i], [j], dx, dy) == pytest.approx(expected, rel=KERNEL)


@cells
def test_the_kernel_is_exact_where_its_formulas_meet(dx, dy):
    """At the distances, in shorter and in longer sides, where one formula follows another."""
    rng, short, long = np.random.default_rng(1), min(dx, dy), max(dx, dy)
    for side, distances in ((short, (2.4, 2.5, 2.6)), (long, (0.5, 15.9, 16.0, 16.1))):
        for distance in side * np.repeat(distances, 20):
            angle = rng.uniform(0, pi / 2)
            ends = [(dx / 2, dy / 2), (0.0, 0.0)]  # seen from the cell's corner and its centre
            for x, y in ends:
                x, y = x + distance * cos(angle), y + distance * sin(angle)
                for i, j in ((x, y), (round(x / dx) * dx, round(y / dy) * dy)):
                    expected = love_to_50_digits(i, j, dx, dy)
                    assert love([i / dx], [j / dy], dx, dy) == pytest.approx(expected, rel=KERNEL)


@cells
def test_a_table_holds_the_kernel(dx, dy):
    table = np.full((60, 70), np.nan)
    Homogeneous(2.0).kernel(3, (dx, dy), table)
    expected = [[0.5 * love([i], [j], dx, dy).item() for j in range(70)] for i in range(3, 63)]
    assert table == pytest.approx(np.array(expected), rel=1e-15)


def test_the_kernel_swaps_with_its_axes():
    x, y = np.array([0.0, 1.0, 5.0, 40.0, 500.0]), np.array([0.0, 2.0, 3.0, 7.0, 90.0])
    assert love(x, y, 1.0, 2.0) == pytest.approx(love(y, x, 2.0, 1.0).T, rel=1e-14)


@pytest.mark.parametrize("shape", [(2, 2), (7, 9), (16, 16), (5, 12), (13, 2), (31, 17)])
@pytest.mark.parametrize("spacing", [(0.3, 0.7), (1.0, 0.1)])
def test_the_convolution_equals_the_dense_matrix(shape, spacing):
    rng = np.random.default_rng(1)
    matrix = love_matrix(shape, spacing) / 2.0
    operator = on_grid(Homogeneous(2.0), shape, spacing)
    pressure = rng.normal(size=shape)
    expected = (matrix @ pressure.ravel()).reshape(shape)
    found = displacement_field(operator, pressure)
    assert np.abs(found - expected).max() < 1e-12 * np.abs(expected).max()
    sources, targets = (np.flatnonzero(rng.random(shape) < part) for part in (0.3, 0.6))
    expected = (matrix[:, sources] @ pressure.flat[sources])[targets]
    for precision, tolerance in (("float64", 1e-12), ("float32", 2e-6)):
        found = operator.displacement(
            pressure.flat[sources],
            GridNodes.of(sources, shape),
            GridNodes.of(targets, shape),
            precision,
        )
        scale = np.abs(expected).max(initial=0)
        assert np.abs(found - expected).max(initial=0) <= tolerance * scale


@pytest.mark.parametrize("shape", [(2, 2), (7, 9), (8, 6), (5, 12)])
def test_the_periodic_operator_is_the_fourier_sum(shape):
    spacing = (0.3, 0.7)
    pressure = np.random.default_rng(1).normal(size=shape)
    q = [2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(shape, spacing, strict=True)]
    magnitude = np.hypot(q[0][:, None], q[1])
    magnitude[0, 0] = np.inf
    expected = np.fft.ifft2(2 / (2.0 * magnitude) * np.fft.fft2(pressure)).real
    found = displacement_field(on_grid(Homogeneous(2.0, periodic=True), shape, spacing), pressure)
    assert np.abs(found - expected).max() < 1e-13 * np.abs(expected).max()
    assert abs(found.mean()) < 1e-13 * np.abs(found).max()


@pytest.mark.parametrize("n", [64, 65, 97, 128, 1023])
def test_long_periods_can_be_halved_three_times(n):
    operator = on_grid(Homogeneous(1.0), (n, 1), (1.0, 1.0))
    assert operator.periods[0] % 8 == 0
    assert 2 * n <= operator.periods[0] < 2 * n + 16


def test_the_spectrum_is_positive():
    shapes = ((32, 32), (1.0, 1.0)), ((17, 40), (1.0, 0.1)), ((90, 130), (1.0, 0.001))
    for shape, spacing in shapes:
        assert on_grid(Homogeneous(1.0), shape, spacing).spectrum.min() > 0
