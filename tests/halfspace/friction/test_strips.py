"""Friction on strips, which repeat along one axis: sums of images, lines, and long periods."""

import numpy as np
import pytest

import roughline as rl
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.shear import shear_on_grid

MU, N_OVER = 0.3, 3 / 7  # nu / (1 - nu) of 0.3
IMAGES = 200
SUMMED = 2e-7  # what images beyond leave of the sums, after one extrapolation


def matrix_of(body, shape, spacing):
    """Return displacements (x, y, z) of all cells under shear and pressure, but zz."""
    operator, count = shear_on_grid(body, shape, spacing), shape[0] * shape[1]
    nodes = GridNodes.of(np.arange(count), shape)
    matrix = np.zeros((3, count, 3, count))
    for i in range(count):
        for axis in range(2):
            shear = np.zeros((count, 2))
            shear[i, axis] = 1.0
            matrix[:2, :, axis, i] = operator.displacement(shear, nodes, nodes).T
            matrix[2, :, axis, i] = operator.into_body(shear, nodes, nodes)
        pressure = np.zeros(count)
        pressure[i] = 1.0
        matrix[:2, :, 2, i] = operator.by_pressure(pressure, nodes, nodes).T
    return matrix


def sums_over_images(body, shape, spacing, along, images):
    """Return the same from the free kernels of cells and so many images on either side."""
    long = [n * (images + 1) if axis == along else n for axis, n in enumerate(shape)]
    tables = [np.empty(long) for _ in range(5)]
    body.shear_kernel(0, spacing, tuple(tables[:3]))
    body.coupling_kernel(0, spacing, tuple(tables[3:]))
    i, j = np.divmod(np.arange(shape[0] * shape[1]), shape[1])
    lags = [np.subtract.outer(each, each) for each in (i, j)]
    odd = (False, False), (False, False), (True, True), (True, False), (False, True)
    sums = [np.zeros(lags[0].shape) for _ in tables]
    for image in range(-images, images + 1):
        x, y = (lag + image * shape[along] * (axis == along) for axis, lag in enumerate(lags))
        for total, table, (odd_x, odd_y) in zip(sums, tables, odd, strict=True):
            sign = (np.sign(x) if odd_x else 1) * (np.sign(y) if odd_y else 1)
            total += sign * table[abs(x), abs(y)]
    return sums


@pytest.mark.parametrize(
    ("shape", "periodic"), [((6, 4), "x"), ((5, 4), "x"), ((3, 6), "y"), ((4, 5), "y")]
)
def test_a_strip_is_displaced_as_by_all_images_of_a_load(shape, periodic):
    spacing, asked = (1.0, 0.7), {"poisson": 0.3, "beta": 0.2}
    found = matrix_of(rl.Homogeneous(2.0, periodic, **asked), shape, spacing)
    whole = found.reshape(3 * shape[0] * shape[1], -1)
    assert abs(whole - whole.T).max() < 1e-15  # energy is symmetric
    parts = found[0, :, 0], found[1, :, 1], found[0, :, 1], -found[0, :, 2], -found[1, :, 2]
    along, free = "xy".index(periodic), rl.Homogeneous(2.0, **asked)
    few, more = (
        sums_over_images(free, shape, spacing, along, images) for images in (IMAGES // 2, IMAGES)
    )
    for number, (part, one, two) in enumerate(zip(parts, few, more, strict=True)):
        # what is left falls as the inverse of the images, or as its square but for a constant
        rest = 2 if number < 3 else 1
        ends = (IMAGES + 0.5) ** rest, (IMAGES // 2 + 0.5) ** rest
        expected = (ends[0] * two - ends[1] * one) / (ends[0] - ends[1])
        off = part - expected
        off -= off.mean() if number < 2 else 0.0
        assert abs(off).max() < SUMMED


@pytest.mark.parametrize("shape", [(16, 24), (9, 24)])
@pytest.mark.parametrize("along", [0, 1])
def test_a_ridge_slips_as_the_difference_of_two_normal_contacts(shape, along):
    """Of lines, shear along and across displaces as pressure does, so that Jäger is exact."""
    rng = np.random.default_rng(3)
    ridge = -(np.linspace(-1, 1, shape[1]) ** 2) + 0.1 * rng.normal(size=shape[1])
    surface = rl.Surface(np.tile(0.1 * ridge, (shape[0], 1)), sizes=(shape[0], shape[1]))
    body = rl.Homogeneous(1.0, "x", poisson=0.3)
    force = 2.0
    shear = 0.6 * MU * force * np.eye(2)[along]
    plain = rl.press(surface, half_space=body, forces=[force, 0.4 * force], fields=True, rtol=1e-9)
    curve = rl.press(
        surface,
        half_space=body,
        friction=rl.Friction(MU),
        forces=[force] * 2,
        shear_forces=[(0.0, 0.0), shear],
        fields=True,
        rtol=1e-9,
    )
    traction = MU * (plain.fields[0].pressure - plain.fields[1].pressure)
    largest = MU * plain.fields[0].pressure.max()
    assert curve.fields[1].shear[..., along] == pytest.approx(traction, abs=1e-6 * largest)
    assert curve.fields[1].shear[..., 1 - along] == pytest.approx(0.0, abs=1e-6 * largest)
    both = (plain.fields[1].contact & ~curve.fields[1].stick).sum()
    assert both <= 0.1 * curve.fields[1].contact.sum()


@pytest.mark.parametrize("beta", [0.0, 2 / 7])
def test_a_strip_is_a_periodic_body_whose_other_period_is_long(beta):
    """Up to what cells and waves differ by on a grid; two materials come to it as its inverse."""
    n = 24
    x = (np.arange(n) + 0.5) / n - 0.5
    heights = -(x[:, np.newaxis] ** 2 + x**2) / 2
    asked = {
        "friction": rl.Friction(MU),
        "forces": [0.03, 0.03],
        "shear_forces": [(0.0, 0.0), (4e-3, 2e-3)],
        "fields": True,
    }
    strip = rl.Homogeneous(1.0, "x", poisson=0.3, beta=beta)
    periodic = rl.Homogeneous(1.0, True, poisson=0.3, beta=beta)
    found = rl.press(rl.Surface(heights, sizes=(1.0, 1.0)), half_space=strip, **asked)
    long = []
    for times in (4, 16):
        wide = np.full((n, n * times), heights.min() - 1.0)
        wide[:, :n] = heights
        curve = rl.press(rl.Surface(wide, sizes=(1.0, times)), half_space=periodic, **asked)
        long.append(curve.fields[1].shear[:, :n])
    expected = (4 * long[1] - long[0]) / 3
    scale = abs(expected).max()
    assert np.sqrt(((found.fields[1].shear - expected) ** 2).mean()) < 0.01 * scale
    assert found.fields[1].shear == pytest.approx(expected, abs=0.06 * scale)


@pytest.mark.parametrize("beta", [0.0, 2 / 7])
def test_a_strip_that_is_transposed_answers_alike(beta):
    heights = rl.SelfAffine(hurst=0.8, rms_height=0.02).surface(16, rng=3).heights[:, :12]
    slides = np.array([(2e-4, 1e-4), (5e-4, -2e-4)])
    asked = {"friction": rl.Friction(MU), "depths": [0.02, 0.03], "rtol": 1e-9}
    one = rl.press(
        rl.Surface(heights, sizes=(1.0, 0.7)),
        half_space=rl.Homogeneous(1.0, "x", poisson=0.3, beta=beta),
        slides=slides,
        **asked,
    )
    other = rl.press(
        rl.Surface(np.ascontiguousarray(heights.T), sizes=(0.7, 1.0)),
        half_space=rl.Homogeneous(1.0, "y", poisson=0.3, beta=beta),
        slides=slides[:, ::-1],
        **asked,
    )
    scale = abs(one.shear_force).max()
    assert other.shear_force == pytest.approx(one.shear_force[:, ::-1], abs=1e-7 * scale)
    assert other.force == pytest.approx(one.force, rel=1e-7)
