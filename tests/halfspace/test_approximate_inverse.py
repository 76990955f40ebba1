"""The approximate inverse of the half-space on a set of nodes."""

import numpy as np
import pytest
from scipy.linalg import eigh

import roughline as rl
from roughline.computing import fft
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.inverse import blocks
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse, preconditioner
from roughline.halfspace.inverse.blocks import without_pulls
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.grid_nodes import GridNodes

SHAPE = 150, 600  # so that blocks are cut at the edges


BODIES = {
    f"{kind} {boundary}": body
    for boundary, periodic in (("free", False), ("periodic", True))
    for kind, body in {
        "homogeneous": Homogeneous(1.0, periodic),
        "hard layer": rl.Layered(1.0, 0.3, 20.0, 0.1, 0.3, periodic),
        "plate": rl.Layered(1.0, 0.3, 4.0, 1e-3, 0.3, periodic),
    }.items()
}


@pytest.fixture(scope="module", params=BODIES.values(), ids=list(BODIES))
def inverse(request):
    return ApproximateInverse.of(on_grid(request.param, SHAPE, (1.0, 1.0)))


def some_nodes(part, seed=0):
    x, y = np.indices(SHAPE)
    height = np.sin(x / 9) * np.cos(y / 23) + np.random.default_rng(seed).normal(size=SHAPE) / 3
    return GridNodes.of(np.flatnonzero(height > np.quantile(height, 1 - part)), SHAPE)


def test_on_few_nodes_it_is_the_inverse(inverse):
    nodes = some_nodes(0.002)
    residual = np.random.default_rng(1).normal(size=nodes.indices.size)
    pressure = preconditioner(inverse, nodes)(residual)
    moved = inverse.operator.displacement(pressure, nodes, nodes)
    if inverse.operator.mean_is_free:  # which takes even pressure for one that displaces
        moved -= (moved - residual).mean()
    assert moved == pytest.approx(residual, abs=1e-4)


@pytest.mark.parametrize("part", [0.01, 0.2, 0.9])
def test_it_is_symmetric_and_positive(inverse, part):
    nodes = some_nodes(part)
    apply = preconditioner(inverse, nodes)
    a, b = np.random.default_rng(2).normal(size=(2, nodes.indices.size))
    norm = np.sqrt((a @ apply(a)) * (b @ apply(b)))
    assert norm > 0
    assert a @ apply(b) == pytest.approx(b @ apply(a), abs=1e-6 * norm)
    assert not inverse.restricted.grid.values.any()


@pytest.mark.parametrize("part", [0.2, 0.9])
def test_it_comes_close(inverse, part):
    nodes = some_nodes(part)
    apply = preconditioner(inverse, nodes)
    pressure = np.random.default_rng(3).normal(size=nodes.indices.size)
    pressure -= pressure.mean()
    moved = inverse.operator.displacement(pressure, nodes, nodes)
    ratio = (moved @ apply(moved)) / (pressure @ moved)
    most = 50 if inverse.is_of_plates else 2
    assert 1 / most < ratio < most


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize(
    ("n", "young", "thickness", "most"),
    [
        *((192, 1.0, 16.0, 8), (192, 0.1, 64.0, 8)),  # shorter ones only, so they differ less
        *((256, 1.0, 16.0, 8), (256, 0.1, 16.0, 8), (256, 0.1, 64.0, 8), (256, 0.01, 64.0, 8)),
        *((192, 1e-3, 4.0, 50), (192, 1e-3, 1.0, 50), (192, 1e-6, 2.0, 50)),  # plates
    ],
)
def test_long_waves_count_about_as_much_as_short_ones(n, young, thickness, most, periodic):
    """The inverse convolution alone counts them 25 to 300 times as much, under plates 1e6."""
    least, largest = extreme_factors(n, rl.Layered(1.0, 0.3, thickness, young, 0.3, periodic), 0.03)
    assert largest < most * least


@pytest.mark.parametrize("periodic", [False, True])
def test_so_do_they_on_blocks_wider_than_a_plate_is_thick(periodic, monkeypatch):
    """With what varies within blocks in full it is 430 and 490 times as much."""
    monkeypatch.setattr(blocks, "_MOST_LARGER", 16)
    body = rl.Layered(1.0, 0.3, 4.0, 1e-3, 0.3, periodic)
    least, largest = extreme_factors(128, body, 0.06)
    assert largest < 200 * least


def extreme_factors(n, body, part):
    """The least and the largest factor by which it exceeds the inverse, on part of a surface."""
    shape = n, n
    operator = on_grid(body, shape, (1.0, 1.0))
    heights = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=25.0).surface(shape[0], 7).heights
    nodes = GridNodes.of(np.flatnonzero(heights > np.quantile(heights, 1 - part)), shape)
    apply = preconditioner(ApproximateInverse.of(operator), nodes)
    x, y = np.divmod(nodes.indices, shape[1])
    corner = GridNodes.of(np.zeros(1, dtype=int), shape)
    kernel = operator.displacement(np.ones(1), corner, None).reshape(shape)
    exact = kernel[abs(x[:, np.newaxis] - x), abs(y[:, np.newaxis] - y)]
    if operator.mean_is_free:
        exact += operator.spectrum.max()
    inverse = np.stack([apply(row) for row in np.eye(x.size)])
    factors = eigh((inverse + inverse.T) / 2, np.linalg.inv(exact), eigvals_only=True)
    return factors[0], factors[-1]


def test_blocks_that_push_keep_their_sums_as_pulls_are_left_out():
    nodes, sides = some_nodes(0.3), (8, 16)
    before = np.random.default_rng(6).normal(0.2, 1.0, nodes.indices.size)
    after = without_pulls(before, nodes, sides)
    x, y = np.divmod(nodes.indices, SHAPE[1])
    _, block = np.unique(x // sides[0] * SHAPE[1] + y // sides[1], return_inverse=True)
    sums = np.bincount(block, before)
    pushes = np.bincount(block, np.maximum(before, 0.0))
    kept = sums > 0.1 * pushes
    assert 10 < kept.sum() < kept.size
    assert np.bincount(block, after)[kept] == pytest.approx(sums[kept])
    assert np.all((after > 0) == (before > 0))
    assert np.all((after >= 0) & (after <= np.maximum(before, 0.0)))


@pytest.mark.parametrize("part", [0.01, 0.9])
def test_an_even_residual_far_above_the_others_does_not_drown_them(inverse, part):
    nodes = some_nodes(part)
    apply = preconditioner(inverse, nodes)
    residual = np.random.default_rng(4).normal(size=nodes.indices.size)
    ones = np.ones_like(residual)
    together = apply(residual + 1e7 * ones) - 1e7 * apply(ones)
    assert together == pytest.approx(apply(residual), abs=1e-5)


def test_its_bits_do_not_depend_on_the_threads(inverse, monkeypatch):
    monkeypatch.setattr(fft, "VALUES_AT_A_TIME", 1000)
    monkeypatch.setattr(fft, "available_cores", lambda: 3)
    nodes, results, before = some_nodes(0.3), [], fft.threads()
    residual = np.random.default_rng(5).normal(size=nodes.indices.size)
    try:
        for threads in (1, 3):
            fft.set_threads(threads)
            results.append(preconditioner(inverse, nodes)(residual))
    finally:
        fft.set_threads(before)
    assert (results[0] == results[1]).all()
