"""Layers under shear: of one material they are that material, thick ones hide their base."""

import numpy as np
import pytest

import roughline as rl

Q = np.array([0.01, 0.1, 1.0, 5.0, 40.0])


def parts(body):
    return (*body.shear_spectrum(Q), body.coupling_spectrum(Q), body.spectrum(Q))


def test_layers_of_one_material_are_that_material():
    layered = rl.Layered([2.0, 2.0], [0.3, 0.3], [0.1, 0.5], base_young=2.0, base_poisson=0.3)
    plain = rl.Homogeneous.of(2.0, 0.3)
    for found, expected in zip(parts(layered), parts(plain), strict=True):
        assert found == pytest.approx(expected, rel=1e-13)


def test_short_waves_feel_the_layer_and_long_ones_the_base():
    layered = rl.Layered(2.0, 0.3, 1.0, base_young=5.0, base_poisson=0.1)
    top, base = rl.Homogeneous.of(2.0, 0.3), rl.Homogeneous.of(5.0, 0.1)
    for q, alone, share in ((40.0, top, 1e-12), (1e-5, base, 1e-4)):
        waves = np.array([q])
        for found, expected in zip(
            (*layered.shear_spectrum(waves), layered.coupling_spectrum(waves)),
            (*alone.shear_spectrum(waves), alone.coupling_spectrum(waves)),
            strict=True,
        ):
            assert found == pytest.approx(expected, rel=share)


def test_even_shear_of_a_layer_on_a_rigid_base_shears_it_evenly():
    layered = rl.Layered([2.0, 1.0], [0.3, 0.25], [0.5, 0.2], base_young=np.inf, periodic=True)
    even = 0.5 / (2 / 2.6) + 0.2 / (1 / 2.5)
    for each in layered.shear_spectrum(np.array([0.0, 1e-5])):
        assert each == pytest.approx(even, rel=1e-8)
    assert layered.coupling_spectrum(np.array([0.0]))[0] == 0


def test_friction_on_layers_of_one_material_is_friction_on_it():
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.02).surface(16, rng=3)
    layered = rl.Layered(1.0, 0.3, 0.2, base_young=1.0, base_poisson=0.3, periodic=True)
    asked = {"friction": rl.Friction(0.3), "depths": [0.02, 0.03], "slides": [(0, 0), (1e-3, 5e-4)]}
    curves = [
        rl.press(surface, half_space=body, rtol=1e-8, **asked)
        for body in (layered, rl.Homogeneous.of(1.0, 0.3, periodic=True))
    ]
    assert curves[0].shear_force == pytest.approx(curves[1].shear_force, rel=1e-6, abs=1e-10)
    assert curves[0].force == pytest.approx(curves[1].force, rel=1e-7)


@pytest.mark.parametrize("periodic", [False, "x"])
def test_free_layers_are_refused_in_one_line(periodic):
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.02).surface(16, rng=3)
    asked = {"friction": rl.Friction(0.3), "depths": [0.02]}
    layered = rl.Layered(1.0, 0.3, 0.2, base_young=2.0, base_poisson=0.3, periodic=periodic)
    with pytest.raises(rl.InputError, match="Layered has no shear_kernel, which friction"):
        rl.press(surface, half_space=layered, **asked)
