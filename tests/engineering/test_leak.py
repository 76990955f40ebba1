"""Leak rates from apertures: liquids and gases."""

import numpy as np
import pytest

import roughline as rl
from roughline.engineering.leak import (
    gas_throughput,
    liquid_leak,
    mass_of_throughput,
    reynolds_number,
    throughput_at_room,
)

GAS = rl.fluid_of("helium")


def test_two_flat_plates_let_poiseuilles_flow_through():
    water = rl.fluid_of("water")
    width, breadth, gap, fall = 0.1, 0.002, 1e-6, 1e5
    found = liquid_leak(gap, width / breadth, fall, water)
    assert found == pytest.approx(width * gap**3 * fall / (12 * water.viscosity * breadth))
    assert liquid_leak(np.array([0.0, gap]), 1.0, fall, water)[0] == 0


def test_a_gas_at_little_difference_is_a_liquid():
    low, high = 1e5, 1.0001e5
    through = gas_throughput(1e-18, 1.0, high, low, GAS)
    volume = liquid_leak(1e-6, 1.0, high - low, rl.Liquid(GAS.viscosity))
    assert through == pytest.approx(volume * (high + low) / 2, rel=1e-12)


def test_mass_is_that_of_the_volume_at_its_pressure():
    throughput = gas_throughput(1e-18, 10.0, 6e5, 1e5, GAS)
    density = 1e5 / (GAS.gas_constant * GAS.temperature)
    assert mass_of_throughput(throughput, GAS) == pytest.approx(throughput / 1e5 * density)
    warm = rl.fluid_of("helium temperature=350 K")
    assert throughput_at_room(throughput, warm) == pytest.approx(throughput * 293.15 / 350)


def test_the_reynolds_number_is_that_of_the_mean_speed():
    water, gap, width, fall = rl.fluid_of("water"), 1e-6, 0.1, 1e6
    speed = gap**2 * fall / (12 * water.viscosity * 1e-3)  # through 1 mm
    found = reynolds_number(1e3 * speed * gap * width, width, water.viscosity)
    assert found == pytest.approx(1e3 * speed * gap / water.viscosity, rel=1e-12)
    assert found == pytest.approx(0.083, rel=0.01)


@pytest.mark.parametrize(("length", "time"), [(1e6, 1.0), (1e3, 10.0), (0.1, 0.01)])
def test_leaks_do_not_depend_on_units(length, time):
    """Units of length and time so many times smaller; of mass so that R stays what it is."""
    mass = (time / length) ** 2
    pressure = mass / (length * time**2)
    viscosity = GAS.viscosity * mass / (length * time)
    gas = rl.Gas(viscosity, GAS.molar_mass * mass, temperature=GAS.temperature)
    assert gas.mean_free_path(1e5 * pressure) == pytest.approx(GAS.mean_free_path(1e5) * length)
    there = gas_throughput(1e-18 * length**3, 5.0, 3e5 * pressure, 1e5 * pressure, gas)
    here = gas_throughput(1e-18, 5.0, 3e5, 1e5, GAS)
    assert there == pytest.approx(here * pressure * length**3 / time)
    assert mass_of_throughput(there, gas) == pytest.approx(
        mass_of_throughput(here, GAS) * mass / time
    )
    volume = liquid_leak(1e-6 * length, 5.0, 1e5 * pressure, rl.Liquid(viscosity))
    expected = liquid_leak(1e-6, 5.0, 1e5, rl.Liquid(GAS.viscosity)) * length**3 / time
    assert volume == pytest.approx(expected)
    turned = gas_throughput(1e-18, 5.0, 1e5, 3e5, GAS)
    assert turned == -here
