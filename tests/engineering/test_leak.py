"""Leak rates from apertures: liquids, gases, slip, against the flow along one channel solved."""

import numpy as np
import pytest
from scipy import optimize

import roughline as rl
from roughline.engineering.leak import (
    gas_throughput,
    liquid_leak,
    mass_of_throughput,
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
    through = gas_throughput(1e-6, 1.0, high, low, GAS)
    volume = liquid_leak(1e-6, 1.0, high - low, rl.Liquid(GAS.viscosity))
    assert through == pytest.approx(volume * (high + low) / 2, rel=1e-12)


def test_mass_is_that_of_the_volume_at_its_pressure():
    throughput = gas_throughput(1e-6, 10.0, 6e5, 1e5, GAS)
    density = 1e5 / (GAS.gas_constant * GAS.temperature)
    assert mass_of_throughput(throughput, GAS) == pytest.approx(throughput / 1e5 * density)
    warm = rl.fluid_of("helium temperature=350 K")
    assert throughput_at_room(throughput, warm) == pytest.approx(throughput * 293.15 / 350)


def solved_throughput(gaps, gas, inlet, outlet):
    """Throughput per width of a channel of pieces of equal length, 1 in all, with slip."""
    constant = gas.mean_free_path(1.0)  # free path times pressure

    def end(throughput):
        pressure = inlet
        for gap in gaps:  # (u³ P²/2 + 6 K u² P) falls by 12 η q_pV / pieces
            square, slip = gap**3 / 2, 6 * constant * gap**2
            left = square * pressure**2 + slip * pressure
            left -= 12 * gas.viscosity * throughput / len(gaps)
            if left < 0:
                return -1.0 - outlet
            pressure = (-slip + np.sqrt(slip**2 + 4 * square * left)) / (2 * square)
        return pressure - outlet

    widest = max(gaps)
    most = widest**3 / 2 * inlet**2 + 6 * constant * widest**2 * inlet
    most *= len(gaps) / (12 * gas.viscosity)
    return optimize.brentq(end, 0.0, most, xtol=1e-300, rtol=1e-14)


def with_slip(gaps, gas, inlet, outlet):
    """The same from the aperture at the mean pressure."""
    path = gas.mean_free_path((inlet + outlet) / 2)
    aperture = np.cbrt(1 / np.mean(1 / (gaps**3 + 6 * path * gaps**2)))
    return gas_throughput(aperture, 1.0, inlet, outlet, gas)


@pytest.mark.parametrize("outlet", [0.0, 1e3, 1e5])
@pytest.mark.parametrize("gap", [5e-8, 1e-6])
def test_slip_is_exact_between_flat_plates(gap, outlet):
    gaps = np.full(5, gap)
    expected = solved_throughput(gaps, GAS, 6e5, outlet)
    assert with_slip(gaps, GAS, 6e5, outlet) == pytest.approx(expected, rel=1e-9)


def test_slip_in_a_chain_of_throats_is_as_good_as_said():
    rng = np.random.default_rng(4)
    for _ in range(300):
        gaps = 10 ** rng.uniform(-7.5, -6, rng.integers(2, 30))
        inlet = 10 ** rng.uniform(4.5, 6.5)
        outlet = inlet * rng.choice([0.0, 0.1, 0.5, 0.9])
        solved = solved_throughput(gaps, GAS, inlet, outlet)
        found = with_slip(gaps, GAS, inlet, outlet)
        without = gas_throughput(np.cbrt(1 / np.mean(gaps**-3.0)), 1.0, inlet, outlet, GAS)
        error, slip = abs(found / solved - 1), 1 - without / solved
        assert error < 0.06
        assert error < 0.25 * slip + 1e-9
