"""The front door of bodies that yield: what it refuses, and what histories give."""

import math
import re

import numpy as np
import pytest

import roughline as rl


@pytest.fixture(scope="module")
def surface():
    return rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(32, 7)


@pytest.mark.parametrize("hardness", [0, 0.0, -1.0, math.nan, -math.inf, "soft", "2 GPa", [1.0]])
def test_an_impossible_hardness_is_refused(surface, hardness):
    with pytest.raises(rl.InputError, match="hardness is .*") as refusal:
        rl.press(surface, E_star=1.0, hardness=hardness, forces=[0.1])
    said = str(refusal.value)
    assert (f'"{hardness}"' if isinstance(hardness, str) else repr(hardness)) in said
    assert "positive" in said
    assert "\n" not in said


@pytest.mark.parametrize("share", [1.0, 1 + 1e-12, 3.0])
@pytest.mark.parametrize("periodic", [False, True])
def test_a_force_beyond_what_the_body_bears_is_refused(surface, share, periodic):
    most = 0.25 * surface.area
    with pytest.raises(rl.InputError, match=re.escape("forces[1] is ")) as refusal:
        rl.press(surface, E_star=1.0, hardness=0.25, forces=[0.1, share * most], periodic=periodic)
    assert f"{most:g}" in str(refusal.value)  # the largest force
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("periodic", [False, True])
def test_just_less_than_the_body_bears_is_solved(surface, periodic):
    most = 0.25 * surface.area
    curve = rl.press(surface, E_star=1.0, hardness=0.25, forces=[0.999 * most], periodic=periodic)
    assert curve.area_fraction[0] >= 0.999
    assert curve.plastic_fraction[0] > 0.99


def test_the_reduced_model_has_no_hardness():
    line = rl.SelfAffine(hurst=0.8, rms_height=1.0).line(256, 7)
    with pytest.raises(rl.InputError, match="hardness") as refusal:
        rl.press(line, E_star=1.0, hardness=0.1, forces=[0.01])
    said = str(refusal.value)
    assert "Surface" in said  # what has one
    assert "0.4 of the hardness" in said  # how far the line serves
    assert "\n" not in said
    curve = rl.press(line, E_star=1.0, forces=[0.01])
    names = ("hardness", "unloading_stiffness", "plastic_fraction", "indentation", "work")
    assert not [name for name in names if getattr(curve, name, None) is not None]


def test_an_infinite_hardness_is_none(surface):
    curve = rl.press(surface, E_star=1.0, hardness=math.inf, forces=[0.1])
    assert curve.hardness is None
    assert "hardness" not in curve.settings
    curve = rl.press(surface, E_star=1.0, hardness=2, forces=[0.1])
    assert curve.hardness == curve.settings["hardness"] == 2.0


@pytest.mark.parametrize(
    ("loads", "message"),
    [
        ({"forces": [0.0, 0.1]}, "forces[0] is 0.0, zero"),
        ({"forces": [0.1, -0.1]}, "forces[1] is -0.1, negative"),
        ({"depths": [0.1, np.nan]}, "depths[1] is nan, not finite"),
    ],
)
def test_impossible_histories_are_refused(surface, loads, message):
    for hardness in (None, 0.1):
        with pytest.raises(rl.InputError, match=re.escape(message)):
            rl.press(surface, E_star=1.0, hardness=hardness, **loads)


@pytest.mark.parametrize("hardness", [None, 0.1])
def test_a_zero_unloads(surface, hardness):
    curve = rl.press(
        surface, E_star=1.0, hardness=hardness, forces=[0.05, 0.0, 0.02, 0.0], fields=True
    )
    apart = [1, 3]
    assert curve.converged.all()
    for name in ("force", "stiffness", "unloading_stiffness", "area_fraction", "plastic_fraction"):
        assert not getattr(curve, name)[apart].any(), name
    if hardness is None:
        assert not curve.depth[apart].any()
    else:  # the highest point that is left is lower, if not by the deepest dent
        assert (curve.depth[apart] > 0).all()
        assert (curve.depth[apart] < curve.indentation[apart]).all()
    for i in apart:
        assert not curve.fields[i].contact.any()
        assert curve.fields[i].gap.min() == pytest.approx(0, abs=1e-12)
    by_depth = rl.press(surface, E_star=1.0, hardness=hardness, depths=[1.0, 0.0, 0.5])
    assert by_depth.depth.tolist() == [1.0, 0.0, 0.5]
    assert by_depth.force[1] == 0


def test_a_depth_at_which_a_grid_is_apart_tells_nothing_of_the_errors_of_others():
    """The finest grid keeps deeper indentations than one of the coarser ones there."""
    spectrum = rl.SelfAffine(hurst=0.7, length=4.0, rms_height=1e-3, q_roll=math.tau / 0.125)
    surface = spectrum.surface(256, 0).cropped((0, 64), (0, 64)).detrended()
    settings = {"E_star": 1.0, "hardness": 0.0038, "grid_error": True}
    alone, followed = (
        rl.press(surface, depths=depths, **settings)
        for depths in ([0.5e-3, 1e-3], [0.5e-3, 1e-3, 0.9e-3])
    )
    assert followed.force[2] == 0
    assert not np.isfinite(followed.unloading_stiffness_error[2])
    for name in ("stiffness_error", "unloading_stiffness_error", "area_fraction_error"):
        np.testing.assert_array_equal(getattr(followed, name)[:2], getattr(alone, name))
    assert np.isfinite(alone.unloading_stiffness_error).all()


def test_under_a_load_that_fails_smaller_ones_are_not_known_and_larger_ones_are():
    """What it would have left is not known; a larger one would have left the same without it."""
    surface = rl.SelfAffine(hurst=0.7, rms_height=1.0).surface(32, 3)
    settings = {"E_star": 1.0, "hardness": 0.2, "forces": [0.02, 0.19, 0.05, 0.195]}
    for most in range(10, 40):
        curve = rl.press(surface, solver=rl.Solver(max_iterations=most), throw=False, **settings)
        if curve.converged[[0, 3]].all():
            break
    assert curve.status[1] == rl.Status.MAX_ITERATIONS
    assert not curve.converged[2]
    for values in (curve.work, curve.indentation, curve.plastic_fraction):
        assert np.isnan(values).tolist() == [False, True, True, False]
    whole = rl.press(surface, **settings)
    assert curve.stiffness[3] == pytest.approx(whole.stiffness[3], rel=1e-6)
    assert curve.indentation[3] == pytest.approx(whole.indentation[3], rel=1e-5)
    with pytest.raises(
        rl.ConvergenceError, match="the surface as a larger load before them left it"
    ) as caught:
        rl.press(surface, solver=rl.Solver(max_iterations=most), **settings)
    assert "\n" not in str(caught.value)
    with pytest.raises(rl.InputError, match="load 1 was not solved .* is not known"):
        curve.surface_after(1)


def test_what_a_history_leaves_is_a_surface(surface, tmp_path):
    surface = rl.Surface(surface.heights, surface.sizes, "m")
    curve = rl.press(surface, E_star=1.0, hardness=0.1, forces=[0.02, 0.047, 0.0], fields=[1])
    left = curve.surface_after(2)
    assert isinstance(left, rl.Surface)
    assert left.sizes == surface.sizes
    assert left.unit == surface.unit
    assert left.heights.max() < surface.heights.max()
    assert (left.heights == curve.surface_after(1).heights).all()
    assert surface.heights - left.heights == pytest.approx(curve.fields[1].indentation, abs=1e-12)
    again = rl.press(left, E_star=1.0, hardness=0.1, forces=[0.047])
    unloading = curve.unloading_stiffness[1]
    assert again.unloading_stiffness[0] == pytest.approx(unloading, rel=1e-6)
    rl.write(left, tmp_path / "left.nc")
    assert (rl.read(tmp_path / "left.nc").heights == left.heights).all()


def test_files_hold_what_yields(surface, tmp_path):
    curve = rl.press(surface, E_star=1.0, hardness=0.1, forces=[0.02, 0.05, 0.0], fields=True)
    data = curve.to_dataset()
    for name in (
        *("unloading_stiffness", "plastic_fraction", "indentation", "work", "dissipated_work"),
    ):
        assert data[name].values.tolist() == getattr(curve, name).tolist(), name
    assert data.attrs["hardness"] == 0.1
    curve.write(tmp_path / "curve.nc")
    curve.write(tmp_path / "curve.csv")


@pytest.mark.parametrize("most", [1, 2, 5, 12, 20, 40])
def test_the_bound_on_convolutions_is_that_of_a_load(surface, most):
    """The first load is elastic until it proves to yield, and is solved again then."""
    hardness = 0.3 * surface.rms_slope
    forces = [0.3 * hardness * surface.area]
    settings = {"E_star": 1.0, "hardness": hardness, "forces": forces, "throw": False}
    bounded = rl.press(surface, solver=rl.Solver(max_iterations=most), **settings)
    assert bounded.converged[0] or bounded.status[0] == rl.Status.MAX_ITERATIONS
    if not bounded.converged[0]:  # else its stiffness is counted as well
        assert bounded.convolutions[0] <= most + 4
    assert not rl.press(surface, solver=rl.Solver(max_iterations=1), **settings).converged[0]


@pytest.mark.parametrize("softness", [None, 0.3])
def test_a_load_that_was_solved_before_takes_no_convolutions(surface, softness):
    hardness = softness and softness * surface.rms_slope
    forces = np.array([0.2, 1.0, 0.4, 1.0, 1.0, 1.2]) * 0.1 * surface.rms_slope * surface.area
    curve = rl.press(surface, E_star=1.0, hardness=hardness, forces=forces)
    assert (curve.convolutions == 0).tolist() == [False, False, False, True, True, False]
    assert (curve.stiffness[3:5] == curve.stiffness[1]).all()
    assert (curve.residual[3:5] == curve.residual[1]).all()
    if softness:
        assert all(each is curve.dents[1] for each in curve.dents[2:5])  # kept once


@pytest.mark.parametrize("hurst", [0.2, 0.8])
@pytest.mark.parametrize("softness", [1.0, 0.5, 0.2, 0.05])
def test_the_mean_contact_pressure_is_the_hardness_only_where_all_yields(hurst, softness):
    """Also of a few cells, where the correction of the outline is as large as what is possible."""
    surface = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(64, 3)
    hardness = softness * surface.rms_slope
    forces = hardness * surface.area * np.geomspace(1e-4, 0.9, 8)
    curve = rl.press(surface, E_star=1.0, hardness=hardness, forces=forces)
    pressure = curve.force / (curve.area_fraction_corrected * surface.area)
    all_yields = curve.plastic_fraction == 1
    assert (pressure[~all_yields] < 0.9995 * hardness).all()
    assert (pressure <= hardness * (1 + 1e-9)).all()
    elastic = rl.press(surface, E_star=1.0, forces=forces)
    alike = (curve.plastic_fraction == 0) & (
        elastic.force < 0.999 * hardness * elastic.area_fraction_corrected * surface.area
    )
    assert alike.any()
    alike_areas = curve.area_fraction_corrected[alike], elastic.area_fraction_corrected[alike]
    assert alike_areas[0].tolist() == alike_areas[1].tolist()
