"""Force and stiffness at fixed levels of the rigid plane and at fixed depths since touch."""

import numpy as np
import pytest

import roughline as rl
from roughline.statistics.planes import at_depths, at_levels

LAW = {"force": (0.7, 1.6), "stiffness": (1.1, 0.6)}
"""Prefactor and exponent over the depth."""


@pytest.fixture
def power_laws():
    """Forces, and depths and stiffnesses of realisations that follow power laws of the depth."""
    forces = np.geomspace(1e-3, 1, 13)
    factors = np.array([0.5, 1.0, 2.0])[:, np.newaxis]
    depth = (forces / (factors * LAW["force"][0])) ** (1 / LAW["force"][1])
    stiffness = LAW["stiffness"][0] * depth ** LAW["stiffness"][1]
    return forces, depth, stiffness, factors


def test_power_laws_go_on_below_the_smallest_load(power_laws):
    forces, depth, stiffness, factors = power_laws
    force, found = at_depths(forces, depth, stiffness, 40)
    common = np.geomspace(depth[:, 0].min(), depth[:, -1].min(), 40)
    assert force == pytest.approx(factors * LAW["force"][0] * common ** LAW["force"][1])
    assert found == pytest.approx(
        np.tile(LAW["stiffness"][0] * common ** LAW["stiffness"][1], (3, 1))
    )
    assert force.min() < forces[0] / 2


def test_realisations_that_do_not_touch_carry_nothing(power_laws):
    forces, depth, stiffness, factors = power_laws
    highest = np.array([1.0, 1.1, 1.3])
    force, found = at_levels(forces, depth, stiffness, highest, 60)
    planes = highest[:, np.newaxis] - depth
    levels = np.linspace(planes[:, 0].max(), planes[:, -1].max(), 60)
    since_touch = np.maximum(highest[:, np.newaxis] - levels, 0)
    assert force == pytest.approx(factors * LAW["force"][0] * since_touch ** LAW["force"][1])
    assert ((found == 0) == (since_touch == 0)).all()


@pytest.mark.parametrize("n", [32, 64])
def test_loads_that_are_left_out_change_little(n):
    """Surfaces without their lighter loads have nearly the forces at fixed level that they have."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    forces = np.geomspace(1e-4, 1, 33)
    surfaces = [spectrum.surface(n, i) for i in range(8)]
    curves = [rl.press(each, E_star=1.0, forces=forces) for each in surfaces]
    highest = [each.heights.max() - each.heights.mean() for each in surfaces]
    depth, stiffness = (
        np.array([getattr(curve, name) for curve in curves]) for name in ("depth", "stiffness")
    )
    light = 16  # from F = 1e-2 on
    force, found = at_levels(forces[light:], depth[:, light:], stiffness[:, light:], highest, 50)
    planes = np.array(highest)[:, np.newaxis] - depth[:, light:]
    levels = np.linspace(planes[:, 0].max(), planes[:, -1].max(), 50)
    off, exact = [], []
    for i in range(8):
        x = highest[i] - levels
        here = (x > depth[i, 0]) & (x < depth[i, light])  # over up to two decades of the load
        known = np.exp(np.interp(np.log(x[here]), np.log(depth[i]), np.log(forces)))
        exact += known.tolist()
        off += (force[i, here] - known).tolist()
    # a single surface is up to half off, many surfaces a tenth; without them all would be lost
    assert abs(np.sum(off)) < 0.1 * np.sum(exact)
    assert np.sum(np.abs(off)) < 0.25 * np.sum(exact)
    assert np.isfinite(found).all()


def test_levels_are_those_of_the_plane():
    """Lines of springs at a fixed level, found from curves at fixed force."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    forces = np.geomspace(1e-5, 3, 111)
    lines = [spectrum.line(2**14, i) for i in range(8)]
    curves = [rl.press(line, E_star=1.0, forces=forces) for line in lines]
    highest = [line.heights.max() - line.heights.mean() for line in lines]
    depth, stiffness = ([getattr(c, name) for c in curves] for name in ("depth", "stiffness"))
    force, found = at_levels(forces, depth, stiffness, highest, 50)
    assert force.shape == found.shape == (8, 50)
    planes = np.array(highest)[:, np.newaxis] - np.array(depth)
    levels = np.linspace(planes[:, 0].max(), planes[:, -1].max(), 50)
    for i, line in enumerate(lines):
        above = np.maximum(line.heights - line.heights.mean() - levels[:, np.newaxis], 0)
        exact = above.sum(axis=1) / line.heights.size
        sure = exact > 2e-5
        assert force[i][sure] == pytest.approx(exact[sure], rel=0.02)
        share = np.count_nonzero(above, axis=1) / line.heights.size
        assert found[i][sure] == pytest.approx(share[sure], rel=0.05)
    assert (force[:, 0] == 0).sum() == 7
