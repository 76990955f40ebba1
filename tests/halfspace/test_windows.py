"""Light loads are solved where bodies can touch: nothing beyond that touches, or matters."""

from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.halfspace.search.window import GridWindow


def surfaces():
    """Surfaces with one peak or several, also beside a corner, on sides that are not even."""
    rng = np.random.default_rng(11)
    for seed in range(6):
        nx, ny = rng.integers(96, 200, 2)
        hurst = rng.uniform(0.2, 0.9)
        whole = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(256, seed)
        heights = np.roll(whole.heights, rng.integers(0, 256, 2), axis=(0, 1))[:nx, :ny]
        yield rl.Surface(heights, (1.0, rng.uniform(0.5, 2.0)))


def pressed(surface, hardness, **loads):
    return rl.press(surface, E_star=1.0, hardness=hardness, fields=True, **loads)


def test_nodes_farther_apart_than_the_depth_cannot_touch():
    """Pressures that push displace a free half-space away from the other body everywhere."""
    for surface in surfaces():
        curve = pressed(surface, None, forces=[1e-3, 1e-2, 0.1, 1.0])
        separation = surface.heights.max() - surface.heights
        for depth, fields in zip(curve.depth, curve.fields, strict=True):
            assert fields.displacement.min() > 0
            assert not (fields.contact & (separation > depth)).any()
            assert fields.gap[separation > depth].min() > 0
            assert fields.gap.min() > -1e-6 * min(surface.rms_height, depth)


@pytest.mark.parametrize("hardness", [None, 3.0])
@pytest.mark.parametrize("control", ["forces", "depths"])
def test_what_is_found_in_a_window_is_found_on_the_whole_grid(monkeypatch, control, hardness):
    values = {"forces": [2e-3, 0.02, 5e-3, 0.2], "depths": [0.05, 0.2, 0.15, 0.8]}[control]
    shares = []
    of = GridWindow.of.__func__

    def recorded(cls, *arguments):
        found = of(cls, *arguments)
        shares.append(found.bodies.separation.size / found.problem.separation.size)
        return found

    for surface in surfaces():
        with monkeypatch.context() as patch:
            patch.setattr(GridWindow, "of", classmethod(recorded))
            windowed = pressed(surface, hardness, **{control: values})
        with monkeypatch.context() as patch:
            patch.setattr(
                GridWindow, "of", classmethod(lambda cls, problem, *others: cls.everywhere(problem))
            )
            whole = pressed(surface, hardness, **{control: values})
        for name in ("force", "depth", "stiffness", "unloading_stiffness", "work"):
            assert getattr(windowed, name) == pytest.approx(getattr(whole, name), rel=1e-5), name
        assert windowed.area_fraction.tolist() == whole.area_fraction.tolist()
        for one, other in zip(windowed.fields, whole.fields, strict=True):
            assert (one.contact == other.contact).all()
            assert np.abs(one.gap - other.gap).max() <= 3e-6
            assert np.abs(one.indentation - other.indentation).max() <= 3e-6
    assert min(shares) < 0.1


def test_a_start_that_foresees_too_little_depth_is_solved_again_on_the_whole_grid(monkeypatch):
    surface = next(surfaces())
    usual = pressed(surface, None, forces=[0.05])
    of = GridWindow.of.__func__
    monkeypatch.setattr(
        GridWindow,
        "of",
        classmethod(
            lambda cls, problem, load, start: of(
                cls, problem, load, replace(start, depth=start.depth and 0.2 * start.depth)
            )
        ),
    )
    shallow = pressed(surface, None, forces=[0.05])
    assert shallow.area_fraction == usual.area_fraction
    assert shallow.stiffness == pytest.approx(usual.stiffness, rel=1e-6)


def test_a_half_space_whose_surface_may_rise_is_looked_at_everywhere():
    assert rl.Homogeneous(1.0).is_pushed_everywhere
    assert not rl.Homogeneous(1.0, periodic=True).is_pushed_everywhere
    assert not rl.HalfSpace.is_pushed_everywhere
