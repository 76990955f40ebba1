"""A repeated body has no place where it begins, and no side that is its first.

Rolled, mirrored or with its sides exchanged, a rough one gives the same answers under every law, by
depths and by forces; its fields are rolled, mirrored and exchanged with it.
"""

import numpy as np
import pytest

import roughline as rl

LAWS = {
    "unilateral": rl.Unilateral(),
    "yielding": rl.Yielding(hardness=0.05),
    "dugdale": rl.Dugdale(work_of_adhesion=1e-3, range=0.05),
    "exponential": rl.Exponential(work_of_adhesion=5e-4, range=0.05),
}
LOADS = {
    "depths": [0.02, 0.06, 0.1, 0.04, 0.01],
    "forces": [0.002, 0.01, 0.02, 0.005],
}
MOVED = {
    "rolled": lambda field: np.roll(field, (5, 3), (0, 1)),
    "mirrored": lambda field: field[::-1, ::-1],
    "exchanged": lambda field: field.T,
}
OFF = 1e-8  # of the largest value, at the tolerance below


def pressed(heights, sizes, law, control, periodic):
    surface = rl.Surface(heights, sizes)
    half_space = rl.Homogeneous(1.0, periodic=periodic)
    given = {control: LOADS[control], "fields": True, "rtol": 1e-10}
    return rl.press(surface, half_space=half_space, law=law, **given)


def rough():
    waves = np.array(rl.SelfAffine(hurst=0.6, rms_height=0.05).surface(16, rng=4).heights)
    return waves[:, :12]


def assert_close(one, other):
    scale = np.abs(one).max()
    np.testing.assert_allclose(other, one, rtol=0, atol=OFF * scale)


@pytest.mark.parametrize("moved", MOVED)
@pytest.mark.parametrize("control", LOADS)
@pytest.mark.parametrize("law", LAWS)
def test_a_repeated_body_has_no_first_row(law, control, moved):
    heights, sizes = rough(), (1.0, 0.75)
    there = sizes[::-1] if moved == "exchanged" else sizes
    one = pressed(heights, sizes, LAWS[law], control, True)
    other = pressed(MOVED[moved](heights), there, LAWS[law], control, True)
    for name in ("depth", "force", "stiffness", "area_fraction"):
        assert_close(getattr(one, name), getattr(other, name))
    for here, beyond in zip(one.fields, other.fields, strict=True):
        assert_close(MOVED[moved](here.pressure), beyond.pressure)
        assert_close(MOVED[moved](here.gap), beyond.gap)
        areas = np.sort(here.patches().areas)
        np.testing.assert_allclose(np.sort(beyond.patches().areas), areas, rtol=1e-12)


@pytest.mark.parametrize("moved", ["rolled", "mirrored", "exchanged"])
@pytest.mark.parametrize("law", LAWS)
def test_a_strip_has_no_first_row_along_it(law, moved):
    move = {**MOVED, "rolled": lambda field: np.roll(field, 5, 0)}[moved]
    heights, sizes = rough(), (1.0, 0.75)
    there, along = (sizes[::-1], "y") if moved == "exchanged" else (sizes, "x")
    one = pressed(heights, sizes, LAWS[law], "depths", "x")
    other = pressed(move(heights), there, LAWS[law], "depths", along)
    for name in ("force", "stiffness", "area_fraction"):
        assert_close(getattr(one, name), getattr(other, name))
    for here, beyond in zip(one.fields, other.fields, strict=True):
        assert_close(move(here.pressure), beyond.pressure)


@pytest.mark.parametrize("sides", ["periodic", "closed"])
def test_a_flow_has_no_first_row_across_it(sides):
    gap = np.maximum(rough() + 0.01, 0.0)
    moves = [lambda field: field[:, ::-1], lambda field: field[::-1]]
    if sides == "periodic":
        moves.append(lambda field: np.roll(field, 5, 1))
    one = rl.flow(gap, (1.0, 0.75), sides=sides)
    assert not one.is_sealed
    for move in moves:
        other = rl.flow(move(gap), (1.0, 0.75), sides=sides)
        for name in ("permeance", "slope", "largest_share"):
            assert getattr(other, name) == pytest.approx(getattr(one, name), rel=1e-9)
    turned = rl.flow(gap.T, (0.75, 1.0), along="y", sides=sides)
    for name in ("permeance", "slope", "largest_share"):
        assert getattr(turned, name) == pytest.approx(getattr(one, name), rel=1e-9)
