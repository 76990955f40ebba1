"""Coated bodies that are sheared, asked of a measured map: units, order, intervals, refusals."""

import json

import numpy as np
import pytest

import roughline as rl
from halfspace.friction.dense_friction import DensePath
from halfspace.friction.dense_layers import layered_matrix

MU = 0.4
SIDE, LAYER = 2e-4, 40e-6
TOP, BASE = "E=3 GPa nu=0.3", "E=10 GPa nu=0.2"
COATED = f"{TOP} 40 um on {BASE}"


@pytest.fixture
def measured(tmp_path):
    """A file of a map of 8 by 8 points, in metres."""
    heights = 2e-6 * np.random.default_rng(4).normal(size=(8, 8))
    path = tmp_path / "map.nc"
    rl.write(rl.Surface(heights, (SIDE, SIDE), "m"), path)
    return path


def sheared(body, pair, **others):
    ask = [rl.Friction(MU), rl.Shear("50 mN", cycles=1)]
    return rl.assess(rl.Question(body, pair, loads="0.3 N", ask=ask, **others))


@pytest.mark.parametrize("pair", [("rigid", COATED), (COATED, "rigid")], ids=["second", "first"])
def test_a_coated_body_is_sheared_as_node_by_node(measured, pair):
    """Which of the bodies is coated tells how pressure moves them along each other."""
    curve = sheared(measured, pair).sought.sheared.curve
    cell, young = SIDE / 8, 3e9
    layers = rl.Layered(1.0, 0.3, LAYER / cell, 10 / 3, 0.2)
    matrix, count = layered_matrix(layers, (8, 8), (1.0, 1.0)), 64
    if pair[1] == "rigid":  # the first slides, and is seen from the other side
        matrix[: 2 * count, 2 * count :] *= -1
        matrix[2 * count :, : 2 * count] *= -1
    heights = rl.read(measured).heights
    path, force = DensePath(matrix, (heights.max() - heights) / cell, MU), young * cell**2
    for depth, slide, pressing, shear in zip(
        curve.depth, curve.slide, curve.force, curve.shear_force, strict=True
    ):
        x, y, pressure = path.to(depth / cell, slide / cell).traction
        assert force * pressure.sum() == pytest.approx(pressing, rel=1e-5)
        assert force * np.array([x.sum(), y.sum()]) == pytest.approx(shear, abs=2e-5 * 0.05)


@pytest.mark.parametrize("order", [1, -1], ids=["second", "first"])
def test_a_coating_far_thicker_than_the_map_is_wide_is_all_of_the_body(measured, order):
    thick = f"{TOP} 200 mm on {BASE}"
    one, other = (sheared(measured, (each, "rigid")[::order]).answers for each in (thick, TOP))
    for key in ("shear_displacement", "micro_slip", "stiffness_on_return", "cycle_energy"):
        assert one[key].values == pytest.approx(other[key].values, rel=3e-3), key


def test_the_command_line_tells_what_press_does_of_both_half_spaces(measured, invoke):
    options = {"load": "0.3 N", "friction": MU, "shear": "50 mN", "cycles": 1, "json": True}
    code, out, errors = invoke("press", measured, materials=f"{COATED}, E=5 GPa nu=0.4", **options)
    assert code == 0, errors
    told = json.loads(out)
    layers = rl.Layered(3e9, 0.3, LAYER, 10e9, 0.2)
    both = rl.Homogeneous.of(5e9, 0.4) + layers  # the first slides
    shears = rl.cycle(0.05, per_cycle=16, cycles=1)
    forces = [0.3 * i / 8 for i in range(1, 8)] + [0.3] * len(shears)
    curve = rl.press(
        rl.read(measured),
        half_space=both,
        friction=rl.Friction(MU),
        forces=forces,
        shear_forces=[(0, 0)] * 7 + shears,
    )
    answers = {each["key"]: each for each in told["answers"].values()}
    turn = len(forces) - 17
    slide = curve.slide[turn, 0] - curve.slide[7, 0]
    assert answers["shear_displacement"]["values"] == pytest.approx([slide], rel=1e-6)
    energy = curve.dissipated[-16:].sum()
    assert answers["cycle_energy"]["values"] == pytest.approx([energy], rel=1e-6)
    # coarser grids need not resolve the coating, so that there are no intervals, which is said
    assert answers["cycle_energy"]["low"] is None
    assert any("stick and slip it is not known what is left open" in each for each in told["notes"])
