"""A profile that is pressed and sheared: what is refused, what is written, and the full model."""

import math

import numpy as np
import pytest

import roughline as rl

R = np.linspace(0, 1.0, 41)
BALL = rl.Profile(R, -(R**2) / 4)
SHEARED = {"half_space": rl.Homogeneous(3.0, poisson=0.25), "friction": rl.Friction(0.3)}


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"shear_forces": [0.02, 0.1]}, r"shear_forces\[1\] .* of the size 0\.1, .* 0\.06 there"),
        (
            {"forces": [0.1, 0.0], "shear_forces": [0.02, 0.01]},
            r"shear_forces\[1\] .* nothing press",
        ),
        ({"shear_forces": [0.0]}, "shear_forces are 1 and forces are 2; give as many of both"),
        ({"shear_forces": [(0.01, 0), (0, 0.02)]}, r"shear along one line: .* or press a Surface"),
        ({"slides": [0.01, math.nan]}, r"slides\[1\] is \(nan, 0\)"),
        ({"shear_forces": [0, 0.01], "slides": [0, 0.01]}, "give one of the two"),
        ({"friction": None, "slides": [0, 0.01]}, "given without friction"),
        ({"friction": 0.3}, "an rl.Friction is needed"),
        ({"friction": rl.Friction(strength=0.1)}, "one coefficient: .* or press a Surface"),
        ({"friction": rl.Friction(np.full((4, 4), 0.2))}, "one coefficient: .* or press a Surface"),
        ({"law": rl.JKR(0.01)}, "bear no friction"),
        ({"half_space": rl.Homogeneous(3.0)}, "Poisson's ratio"),
        ({"half_space": rl.Homogeneous.of(3.0, 0.25)}, r"give beta=0\.0, or press a Surface"),
        ({"forces": None, "n_loads": 4}, "give depths or forces"),
    ],
)
def test_what_springs_do_not_know_is_refused_in_one_line(given, said):
    with pytest.raises(rl.InputError, match=said) as caught:
        rl.press(BALL, **(SHEARED | {"forces": [0.1, 0.2]} | given))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"shear_forces": [0.01, (0.01, 0.01)]}, "pairs of finite numbers"),
        ({"shear_forces": [(0.01, 0.0), (0.01, 0.01)]}, "along one line"),
        ({"friction": rl.Friction(strength=1.0)}, "one coefficient"),
        ({"half_space": rl.Homogeneous(3.0)}, "Poisson's ratio"),
        ({"half_space": rl.Homogeneous.of(3.0, 0.25)}, r"give beta=0\.0"),
        ({"shear_forces": [0.0, 0.07]}, "so that the bodies slide"),
        ({"forces": None, "n_loads": 4}, "give depths or forces"),
    ],
)
def test_a_line_is_refused_what_its_springs_do_not_know(given, said):
    line = rl.SelfAffine(hurst=0.8, rms_height=0.01).line(256, rng=7)
    with pytest.raises(rl.InputError, match=said) as caught:
        rl.press(line, **(SHEARED | {"forces": [0.1, 0.2]} | given))
    assert "\n" not in str(caught.value)


def test_shear_at_given_depths_is_refused_with_the_force_there():
    with pytest.raises(rl.InputError, match=r"friction bears less than mu F = 0\.053665"):
        rl.press(BALL, **SHEARED, depths=[0.1], shear_forces=[0.06])


def test_without_shear_the_curve_is_that_without_friction():
    plain = rl.press(BALL, E_star=3.0, forces=[0.1, 0.3, 0.2])
    curve = rl.press(BALL, **SHEARED, forces=[0.1, 0.3, 0.2])
    assert isinstance(curve, rl.SlidingLineCurve)
    for name in ("depth", "force", "stiffness", "area_fraction"):
        assert (getattr(curve, name) == getattr(plain, name)).all()
    for name in ("slide", "shear_force", "dissipated", "drift"):
        assert not getattr(curve, name).any()


def test_files_hold_what_friction_adds(tmp_path):
    import xarray

    curve = rl.press(BALL, **SHEARED, forces=[0.1, 0.3], shear_forces=[0.0, 0.04])
    curve.write(tmp_path / "curve.nc")
    with xarray.open_dataset(tmp_path / "curve.nc") as data:
        assert data.slide.dims == ("force", "axis")
        assert data.shear_stiffness.shape == (2, 2, 2)
        for name in ("slide", "shear_force", "stick_fraction", "shear_limit", "dissipated"):
            assert (data[name].values == getattr(curve, name)).all()


@pytest.mark.parametrize("n", [24, 64])
def test_springs_and_the_full_model_agree_along_a_history(n):
    """Exact springs at n = 0; errors of the grid fall with its cells."""
    x = (np.arange(n) + 0.5) / n - 0.5
    surface = rl.Surface(-(x[:, np.newaxis] ** 2 + x**2) / 2, sizes=(1.0, 1.0))
    depth = x[n // 2] ** 2  # of the highest points
    half_space, friction = rl.Homogeneous(1.0, poisson=0.0), rl.Friction(0.3)
    radii = np.linspace(0, 0.6, 61)
    ball = rl.Profile(radii, -(radii**2) / 2)
    depths, share = np.array([0.04, 0.09, 0.09, 0.06]), np.array([0.0, 0.5, -0.4, 0.3])
    forces = 4 / 3 * depths**1.5
    shear_forces = 0.3 * forces * share
    loads = {"half_space": half_space, "friction": friction, "forces": forces}
    full = rl.press(surface, **loads, shear_forces=shear_forces)
    springs = rl.press(ball, **loads, shear_forces=shear_forces)
    assert full.depth + depth == pytest.approx(springs.depth, rel=2 / n)
    largest = np.abs(springs.slide).max()
    assert full.slide == pytest.approx(springs.slide, abs=0.2 / n * largest)
    assert full.dissipated[2] == pytest.approx(springs.dissipated[2], rel=1 / n)
