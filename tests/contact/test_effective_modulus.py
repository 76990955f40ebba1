"""The contact modulus that a layered contact feels: its waves, and both limits."""

import numpy as np
import pytest

import roughline as rl
from roughline.contact.effective_modulus import effective_modulus

SURFACE = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4).surface(32, rng=7)
E_TOP, NU_TOP, E_BASE, NU_BASE = 5e6, 0.4, 80e6, 0.3
OF_TOP, OF_BASE = E_TOP / (1 - NU_TOP**2), E_BASE / (1 - NU_BASE**2)


def felt(thickness, pressure=1e4, *, periodic=True):
    layered = rl.Layered(E_TOP, NU_TOP, thickness, E_BASE, NU_BASE, periodic=periodic)
    forces = [pressure * SURFACE.area]
    fields = rl.press(SURFACE, half_space=layered, forces=forces, fields=True).fields[0]
    return effective_modulus(fields, OF_TOP), fields, layered


def test_it_is_the_mean_over_the_waves_of_the_pressure():
    found, fields, layered = felt(60e-6)
    power = np.abs(np.fft.fft2(fields.pressure)) ** 2
    each = (
        2 * np.pi * np.fft.fftfreq(n, size / n)
        for n, size in zip((32, 32), fields.sizes, strict=True)
    )
    q = np.hypot(*np.meshgrid(*each, indexing="ij"))
    uneven = q > 0
    mean = power[uneven] @ (2 / q[uneven]) / (power[uneven] @ layered.spectrum(q[uneven]))
    assert found == pytest.approx(mean, rel=1e-5)


@pytest.mark.parametrize("periodic", [True, False])
def test_it_goes_from_that_of_the_base_to_that_of_the_layer(periodic):
    thicknesses = [16e-6, 60e-6, 250e-6, 4.0]
    moduli = [felt(each, periodic=periodic)[0] for each in thicknesses]
    assert (np.diff(moduli) < 0).all()
    assert moduli[0] < OF_BASE
    assert moduli[-1] == pytest.approx(OF_TOP, rel=1e-3)


def test_a_smooth_wave_feels_the_base_as_far_as_the_layer_is_thin():
    """What a layer adds to its base falls with its thickness over the length of the wave."""
    x = np.arange(128) / 128
    heights = 1e-6 * np.cos(2 * np.pi * x)[:, np.newaxis] + 1e-6 * np.cos(2 * np.pi * x)
    wave = rl.Surface(heights, (1e-3, 1e-3))
    off = []
    for thickness in (1.6e-5, 8e-6, 4e-6):
        layered = rl.Layered(E_TOP, NU_TOP, thickness, E_BASE, NU_BASE, periodic=True)
        fields = rl.press(wave, half_space=layered, forces=[0.4], fields=True).fields[0]
        off.append(OF_BASE / effective_modulus(fields, OF_TOP) - 1)
    assert off[0] > off[1] > off[2] > 0
    assert off[1] / off[2] == pytest.approx(2, rel=0.1)


@pytest.mark.parametrize("periodic", [True, False])
def test_a_layer_of_its_base_changes_nothing(periodic):
    alike = rl.Layered(E_BASE, NU_BASE, 60e-6, E_BASE, NU_BASE, periodic=periodic)
    fields = rl.press(SURFACE, half_space=alike, forces=[0.01, 0.0], fields=True).fields
    for each in fields:  # without a load it is that of the top layer
        assert effective_modulus(each, OF_BASE) == pytest.approx(OF_BASE, rel=1e-6)


def test_light_contacts_feel_the_layer():
    moduli = [felt(60e-6, pressure)[0] for pressure in (1e5, 1e4, 1e2)]
    assert moduli[0] > moduli[1] > moduli[2] > OF_TOP
