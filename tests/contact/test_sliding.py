"""Presses with friction: what is given, what is refused, and what the curve holds."""

import re

import numpy as np
import pytest

import roughline as rl

SURFACE = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(16, rng=7)
BODY = rl.Homogeneous(1.0, poisson=0.3)
FRICTION = rl.Friction(0.3)


def press(**given):
    return rl.press(SURFACE, **({"half_space": BODY, "friction": FRICTION} | given))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"friction": None, "shear_forces": [1.0]}, "are given without friction"),
        ({"friction": None, "slides": [1.0]}, "are given without friction"),
        ({"friction": 0.3}, "friction is 0.3; an rl.Friction is needed"),
        ({"half_space": None, "E_star": 1.0}, "without a Poisson's ratio"),
        ({"shear_forces": [0, 0]}, "shear_forces are 2 and forces are 1; give as many of both"),
        ({"shear_forces": [0], "slides": [0]}, "shear_forces and slides are given; give one"),
        ({"shear_forces": [(0, 0, 0)]}, "pairs of finite numbers (x, y) are needed"),
        ({"shear_forces": "much"}, "pairs of finite numbers (x, y) are needed"),
        ({"shear_forces": ["1e-3"]}, "pairs of finite numbers (x, y) are needed"),
        ({"shear_forces": np.array([1e-3 + 0j])}, "pairs of finite numbers (x, y) are needed"),
        ({"slides": np.ma.array([1e-3], mask=[True])}, "slides[0] is (nan, 0); pairs of finite"),
        ({"slides": [(np.nan, 0)]}, "slides[0] is (nan, 0); pairs of finite numbers"),
        ({"shear_forces": [0.003]}, "friction bears less than mu F = 0.003 there"),
        (
            {"forces": [0.01, 0], "shear_forces": [0, 1e-3]},
            "shear_forces[1] is (0.001, 0) at forces[1] = 0, where nothing presses",
        ),
        ({"law": rl.Dugdale(1e-4, 1e-2)}, "friction of bodies that stick to each other is not"),
        ({"grid_error": True}, "is not known with friction"),
        ({"forces": None, "n_loads": 3}, "with friction each has its shear"),
        (
            {"friction": rl.Friction(np.ones((3, 3)))},
            "coefficient of the friction has the shape (3, 3) and the surface (16, 16)",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(given, message):
    with pytest.raises(rl.InputError, match=re.escape(message)) as told:
        press(**({"forces": [0.01]} | given))
    assert "\n" not in str(told.value)


MASKED = np.ma.array([[0.3, 0.2]], mask=[[False, True]])


@pytest.mark.parametrize(
    "wrong", [0, -0.1, np.nan, np.inf, 6.0, "0.3", [0.3], [[0.3, -1.0]], [["0.3"]], MASKED]
)
def test_a_coefficient_is_a_positive_number_or_a_field(wrong):
    with pytest.raises(rl.InputError, match="a number above 0 and up to 5 is needed"):
        rl.Friction(wrong)


def test_a_friction_has_a_coefficient_or_a_strength():
    with pytest.raises(rl.InputError, match="needs a coefficient, a strength, or both"):
        rl.Friction()
    with pytest.raises(rl.InputError, match="strength is -1; a positive, finite pressure"):
        rl.Friction(strength=-1)
    assert rl.Friction(0.3) == rl.Friction(0.3) != rl.Friction(0.3, strength=1.0)
    field = np.full((2, 2), 0.3)
    assert rl.Friction(field) == rl.Friction(field.copy()) != rl.Friction(0.3)


def test_springs_of_a_line_need_a_poissons_ratio_as_surfaces_do():
    line = rl.SelfAffine(hurst=0.8, rms_height=0.01).line(64, rng=7)
    with pytest.raises(rl.InputError, match="Poisson's ratio"):
        rl.press(line, E_star=1.0, forces=[1e-4], friction=FRICTION)


@pytest.mark.parametrize(
    "wrong", [{"poisson": 0.6}, {"poisson": -0.1}, {"poisson": 0.3, "beta": 0.6}, {"beta": 0.1}]
)
def test_a_half_space_has_a_ratio_that_bodies_have(wrong):
    with pytest.raises(rl.InputError):
        rl.Homogeneous(1.0, **wrong)


def test_a_press_without_friction_is_the_same_to_the_last_bit():
    forces = [1e-3, 1e-2]
    plain = rl.press(SURFACE, E_star=1.0, forces=forces)
    beside = rl.press(SURFACE, half_space=BODY, forces=forces)
    sheared = press(forces=forces, shear_forces=[0, 1e-3])
    for name in ("depth", "force", "stiffness", "area_fraction"):
        assert np.array_equal(getattr(plain, name), getattr(beside, name))
        assert getattr(plain, name) == pytest.approx(getattr(sheared, name), rel=1e-6)
    assert type(plain) is rl.SurfaceCurve
    assert type(sheared) is rl.SlidingCurve


def test_a_load_that_slides_is_told_by_its_number():
    """Of depths, what friction bears is known once the contact is."""
    curve = press(depths=[0.004, 0.006], shear_forces=[0, 1.0], throw=False)
    assert [rl.Status(each).name for each in curve.status] == ["CONVERGED", "SLIDES"]
    assert np.isnan(curve.slide[1]).all()
    with pytest.raises(rl.ConvergenceError, match="it bears less than 0.00"):
        press(depths=[0.004, 0.006], shear_forces=[0, 1.0])
    lost = press(depths=[0.006, 0.006], shear_forces=[1.0, 0.0], throw=False)
    assert [rl.Status(each).name for each in lost.status] == ["SLIDES", "UNKNOWN_SURFACE"]


@pytest.mark.parametrize("beta", [0.5, -0.5])
def test_bodies_that_move_each_other_too_much_are_certified_or_refused_with_the_cause(beta):
    """Friction times |beta| is 2.5."""
    body = rl.Homogeneous(1.0, poisson=0.0, beta=beta)
    asked = {"half_space": body, "friction": rl.Friction(5.0), "forces": [0.01, 0.01, 0.01]}
    asked["shear_forces"] = [0.0, 0.015, 0.045]
    curve = press(throw=False, **asked)
    lost = np.flatnonzero(curve.status)
    assert lost.size
    assert curve.status[lost[0]] == rl.Status.STALLED
    assert curve.residual[lost[0]] > 1e-6
    assert (curve.residual[: lost[0]] <= 1e-6).all()
    with pytest.raises(rl.ConvergenceError, match="times Dundurs' .beta. is above 1/2: give less"):
        press(**asked)


def test_the_curve_has_what_was_asked_and_files_have_it(tmp_path):
    shears = [(0, 0), (1e-3, 5e-4)]
    curve = press(forces=[0.01, 0.01], shear_forces=shears, fields=True)
    assert np.array_equal(curve.shear_force, shears)
    one = press(forces=0.01, shear_forces=1e-3)  # numbers alone, as of forces
    assert np.array_equal(one.shear_force, [(1e-3, 0)])
    assert curve.slide.shape == (2, 2)
    assert curve.shear_stiffness.shape == curve.shear_stiffness_back.shape == (2, 2, 2)
    assert curve.shear_limit == pytest.approx(0.3 * curve.force)
    fields = curve.fields[1]
    assert fields.shear.sum(axis=(0, 1)) * np.prod(SURFACE.spacing) == pytest.approx(shears[1])
    bound = 0.3 * fields.pressure
    assert (np.hypot(*np.moveaxis(fields.shear, 2, 0)) <= bound * (1 + 1e-12)).all()
    assert not (fields.stick & ~fields.contact).any()
    assert fields.stick.sum() / fields.contact.sum() == curve.stick_fraction[1]
    assert fields.slip_total == pytest.approx(np.hypot(*np.moveaxis(fields.slip, 2, 0)))
    data = curve.to_dataset()
    assert data.shear_force.dims == ("force", "axis")
    assert data.shear.dims == ("force", "x", "y", "axis")
    assert data.dissipated.attrs["units"] == "energy"
    curve.write(tmp_path / "curve.nc")


def test_bodies_that_come_apart_forget():
    curve = press(forces=[0.01, 0.0, 0.01], shear_forces=[1e-3, 0, 1e-3], fields=True, rtol=1e-9)
    assert curve.shear_force[1] == pytest.approx(0)
    again = curve.slide[2] - curve.slide[1]
    assert again == pytest.approx(curve.slide[0], rel=1e-6, abs=1e-12)


def test_a_cycle_goes_up_and_down_evenly():
    loads = rl.cycle(2.0, mean=1.0, per_cycle=8, cycles=2, angle=np.pi / 2)
    sizes = [y for _, y in loads]
    assert sizes == pytest.approx([0, 1, 2, 3, *(2, 1, 0, -1, 0, 1, 2, 3) * 2])
    assert abs(np.array(loads)[:, 0]).max() < 1e-15
    for wrong in (
        {"amplitude": 0},
        {"amplitude": 1, "per_cycle": 3},
        {"amplitude": 1, "cycles": 0},
        {"amplitude": 1e-12, "mean": 1.0},  # with more loads up to the mean than memory holds
        {"amplitude": 1, "cycles": 10**9},
    ):
        with pytest.raises(rl.InputError) as told:
            rl.cycle(**wrong)
        assert "\n" not in str(told.value)


@pytest.mark.parametrize("per_cycle", [2, 4, 6, 12, 20, 32])
def test_a_cycle_comes_back_to_the_same_numbers_and_about_no_mean_to_zero(per_cycle):
    """So that a load is known as one that was, and the slide without shear as the drift."""
    half = per_cycle // 2
    sizes = [x for x, _ in rl.cycle(0.3, per_cycle=per_cycle, cycles=2)]
    first, second = sizes[-2 * per_cycle - 1 : -per_cycle], sizes[-per_cycle - 1 :]
    assert first == second
    assert first[: half + 1] == first[half:][::-1]
    assert first[:half] == [-each for each in first[half:-1]]
    assert (0.0 in first) == (half % 2 == 0)
