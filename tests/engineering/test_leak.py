"""Leak rates from apertures: liquids, gases, slip, against the flow along one channel solved."""

import numpy as np
import pytest
from scipy import optimize

import roughline as rl
from roughline.engineering.leak import (
    beyond_slip,
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
    through = gas_throughput(1e-6, 1.0, high, low, GAS)
    volume = liquid_leak(1e-6, 1.0, high - low, rl.Liquid(GAS.viscosity))
    assert through == pytest.approx(volume * (high + low) / 2, rel=1e-12)


def test_mass_is_that_of_the_volume_at_its_pressure():
    throughput = gas_throughput(1e-6, 10.0, 6e5, 1e5, GAS)
    density = 1e5 / (GAS.gas_constant * GAS.temperature)
    assert mass_of_throughput(throughput, GAS) == pytest.approx(throughput / 1e5 * density)
    warm = rl.fluid_of("helium temperature=350 K")
    assert throughput_at_room(throughput, warm) == pytest.approx(throughput * 293.15 / 350)


def solved_throughput(gaps, gas, inlet, outlet, lengths=None):
    """Throughput per width of a channel of pieces, equally long unless given, 1 in all."""
    lengths = np.full(len(gaps), 1 / len(gaps)) if lengths is None else lengths
    constant = gas.mean_free_path(1.0)  # free path times pressure

    def end(throughput):
        pressure = inlet
        for gap, length in zip(gaps, lengths, strict=True):  # u³ P²/2 + 6 K u² P falls
            square, slip = gap**3 / 2, 6 * constant * gap**2
            left = square * pressure**2 + slip * pressure
            left -= 12 * gas.viscosity * throughput * length
            if left < 0:
                return -1.0 - outlet
            pressure = 2 * left / (slip + np.sqrt(slip**2 + 4 * square * left))
        return pressure - outlet

    widest = max(gaps)
    most = widest**3 / 2 * inlet**2 + 6 * constant * widest**2 * inlet
    most /= 12 * gas.viscosity * min(lengths)
    return optimize.brentq(end, 0.0, most, xtol=1e-300, rtol=1e-13, maxiter=1000)


def with_slip(gaps, gas, inlet, outlet, lengths=None):
    """The same from the aperture at the mean pressure."""
    path = gas.mean_free_path((inlet + outlet) / 2)
    aperture = np.cbrt(1 / np.average(1 / (gaps**3 + 6 * path * gaps**2), weights=lengths))
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


@pytest.mark.parametrize(("ratio", "to_vacuum", "to_half"), [(2, 0.05, 0.016), (10, 0.15, 0.05)])
def test_slip_in_two_gaps_is_off_by_no_more_than_said(ratio, to_vacuum, to_half):
    """The worst over all free paths, lengths and both orders; where it is reached it is signed."""
    for outlet, most in ((0.0, to_vacuum), (0.5e5, to_half)):
        errors = []
        for gap in np.geomspace(1e-8, 1e-5, 16):
            for share in np.linspace(0.1, 0.95, 12):  # of the first gap in the resistance
                for gaps in (np.array([1.0, ratio]) * gap, np.array([ratio, 1.0]) * gap):
                    lengths = np.array([share, 1 - share]) * gaps**3
                    lengths /= lengths.sum()
                    solved = solved_throughput(gaps, GAS, 1e5, outlet, lengths)
                    errors.append(with_slip(gaps, GAS, 1e5, outlet, lengths) / solved - 1)
        assert 0.8 * most < np.max(np.abs(errors)) <= most


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
    there = gas_throughput(1e-6 * length, 5.0, 3e5 * pressure, 1e5 * pressure, gas)
    here = gas_throughput(1e-6, 5.0, 3e5, 1e5, GAS)
    assert there == pytest.approx(here * pressure * length**3 / time)
    assert mass_of_throughput(there, gas) == pytest.approx(
        mass_of_throughput(here, GAS) * mass / time
    )
    volume = liquid_leak(1e-6 * length, 5.0, 1e5 * pressure, rl.Liquid(viscosity))
    expected = liquid_leak(1e-6, 5.0, 1e5, rl.Liquid(GAS.viscosity)) * length**3 / time
    assert volume == pytest.approx(expected)
    turned = gas_throughput(1e-6, 5.0, 1e5, 3e5, GAS)
    assert turned == -here


def test_beyond_slip_more_flows_and_never_less():
    """Far from it nothing changes; from there on it rises, beyond the table as well."""
    ratios = np.geomspace(1e-4, 1e3, 50)
    more = beyond_slip(ratios)
    assert more[0] == 1
    assert (np.diff(more) >= 0).all()
    assert beyond_slip(5.0) == pytest.approx(2.01)
    free = beyond_slip(400.0) - beyond_slip(20.0)  # with the logarithm, as between 5 and 20
    assert free == pytest.approx((2.63 - 2.01) / np.log(4) * np.log(20), rel=1e-9)
