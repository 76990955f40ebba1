"""Shear on the contact alone: how much the restricted operator errs, near and far."""

import numpy as np
import pytest

import roughline as rl
from roughline.computing.krylov import least_residual
from roughline.halfspace.inverse import cache
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.operators import convolution
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.restricted import RestrictedOperators
from roughline.halfspace.operators.restricted_shear import RestrictedShear
from roughline.halfspace.operators.shear import shear_on_grid


@pytest.fixture(autouse=True)
def _on_small_grids(monkeypatch):
    """Restrict the operator of small grids as well."""
    monkeypatch.setattr(convolution, "FEW_MODES", 0)
    monkeypatch.setattr(cache._cache, "inverses", {})


def both(shape, spacing, ratios, periodic, layers=None):
    """Return both exact operators, the restricted one, and the nodes of a contact."""
    half_space = layers or rl.Homogeneous(1.0, periodic, poisson=0.5, beta=0.4)
    pressed = on_grid(half_space, shape, spacing)
    exact = shear_on_grid(half_space, shape, spacing)
    margins = ApproximateInverse.of(pressed).restricted.margins
    rough = RestrictedShear.of(exact, pressed, ratios, margins)
    n = 2 ** int(np.ceil(np.log2(max(shape))))
    heights = np.asarray(rl.SelfAffine(hurst=0.5, rms_height=1.0).surface(n, 3).heights)
    heights = heights[: shape[0], : shape[1]]
    nodes = np.flatnonzero(heights > np.quantile(heights, 0.92))
    return pressed, exact, rough, GridNodes.of(nodes, shape)


@pytest.mark.parametrize(
    ("shape", "spacing", "ratios", "periodic"),
    [
        ((64, 64), (1.0, 1.0), (4, 4), False),
        ((64, 64), (1.0, 1.0), (4, 4), True),
        ((67, 101), (1.0, 1.3), (4, 4), False),
        ((64, 128), (2.0, 1.0), (2, 4), False),
        ((96, 80), (1.0, 1.0), (8, 8), False),
    ],
)
def test_shear_displaces_as_exactly_to_a_hundredth(shape, spacing, ratios, periodic):
    """That is of any shear, and of pressure on coupled bodies to a twentieth."""
    pressed, exact, rough, nodes = both(shape, spacing, ratios, periodic)
    rng = np.random.default_rng(1)
    shear = rng.standard_normal((nodes.indices.size, 2))
    for each in (shear, np.ones_like(shear) * (1.0, 0.5)):
        expected = exact.displacement(each, nodes, nodes)
        found = rough.displacement(each, nodes, nodes)
        assert np.abs(found - expected).max() <= 0.01 * np.abs(expected).max()
    pressure, nothing = shear[:, 0].copy(), np.zeros_like(shear)
    expected = (
        pressed.displacement(pressure, nodes, nodes),
        exact.by_pressure(pressure, nodes, nodes),
    )
    found = rough.displaced(pressure, nothing, nodes, nodes)
    for here, there, error in zip(found, expected, (0.01, 0.06), strict=True):
        assert np.abs(here - there).max() <= error * np.abs(there).max()
    expected = exact.into_body(shear, nodes, nodes)
    found, along = rough.displaced(nothing[:, 0], shear, nodes, nodes)
    assert np.abs(found - expected).max() <= 0.06 * np.abs(expected).max()
    moved = rough.displacement(shear, nodes, nodes)
    assert along == pytest.approx(moved, rel=0, abs=1e-5 * np.abs(moved).max())


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("base_young", [0.1, 10.0, np.inf])
@pytest.mark.parametrize(("ratio", "thickness"), [(4, 100.0), (4, 6.0), (2, 3.0), (8, 16.0)])
def test_it_is_as_near_for_layers_that_the_coarse_grid_resolves(
    ratio, thickness, base_young, periodic
):
    """Pressure moves rough places along by little, of which a tenth is missed at most."""
    layers = rl.Layered(1.0, 0.3, thickness, base_young, 0.3, periodic)
    pressed, exact, rough, nodes = both((64, 64), (1.0, 1.0), (ratio, ratio), periodic, layers)
    rng = np.random.default_rng(1)
    shear = rng.standard_normal((nodes.indices.size, 2))
    for each in (shear, np.ones_like(shear) * (1.0, 0.5)):
        expected = exact.displacement(each, nodes, nodes)
        found = rough.displacement(each, nodes, nodes)
        assert np.abs(found - expected).max() <= 0.01 * np.abs(expected).max()
    pressure, nothing = shear[:, 0].copy(), np.zeros_like(shear)
    into, along = rough.displaced(pressure, nothing, nodes, nodes)
    expected = pressed.displacement(pressure, nodes, nodes)
    assert np.abs(into - expected).max() <= 0.01 * np.abs(expected).max()
    expected = exact.by_pressure(pressure, nodes, nodes)
    assert np.abs(along - expected).max() <= 0.1 * np.abs(expected).max()


@pytest.mark.parametrize("periodic", [False, True])
def test_friction_on_layers_is_the_same_without_it(monkeypatch, periodic):
    """And it takes less than half of the exact products."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01).surface(64, rng=7)
    layers = rl.Layered(1.0, 0.3, 0.1, base_young=3.0, base_poisson=0.3, periodic=periodic)
    shears = {"forces": [2e-3, 2e-3], "shear_forces": [0.0, 3e-4]}
    asked = {"half_space": layers, "friction": rl.Friction(0.3), **shears, "rtol": 1e-8}
    by_both = rl.press(surface, **asked)
    monkeypatch.setattr(RestrictedOperators, "ratios", lambda self, nodes: None)
    exact = rl.press(surface, **asked)
    assert by_both.convolutions.sum() < 0.5 * exact.convolutions.sum()
    for name in ("depth", "slide", "shear_stiffness", "shear_stiffness_back"):
        size = np.abs(getattr(exact, name)).max()
        assert getattr(by_both, name) == pytest.approx(getattr(exact, name), abs=1e-6 * size)


@pytest.mark.parametrize("periodic", [False, True])
def test_work_of_one_shear_on_the_displacements_of_another_is_mutual(periodic):
    *_, rough, nodes = both((64, 64), (1.0, 1.0), (4, 4), periodic)
    rng = np.random.default_rng(2)
    one, other = rng.standard_normal((2, nodes.indices.size, 2))
    pressure = np.ascontiguousarray(other[:, 0])
    first = np.vdot(one, rough.displacement(other, nodes, nodes))
    second = np.vdot(other, rough.displacement(one, nodes, nodes))
    size = np.sqrt(np.vdot(one, one) * np.vdot(other, other))
    assert abs(first - second) <= 1e-5 * size
    nothing = np.zeros_like(one)
    along = np.vdot(one, rough.displaced(pressure, nothing, nodes, nodes)[1])
    into = np.vdot(pressure, rough.displaced(nothing[:, 0], one, nodes, nodes)[0])
    assert abs(along - into) <= 1e-5 * size


def test_equations_that_are_not_symmetric_are_solved_to_the_least_residual():
    rng = np.random.default_rng(3)
    matrix = np.eye(40) * 5 + rng.standard_normal((40, 40)) / 2
    target = rng.standard_normal(40)
    found, left = least_residual(lambda v: matrix @ v, lambda v: v / 5, target, 1e-12)
    assert left <= 1e-12
    assert found == pytest.approx(np.linalg.solve(matrix, target), rel=1e-10)
