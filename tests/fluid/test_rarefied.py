"""A rare gas along a seal: against the kinetic equation, solved where the pressure falls."""

import numpy as np
import pytest
from scipy import integrate, optimize

import roughline as rl
from benchmarks.kinetic import kinetic
from roughline.fluid.measures import LIQUID, equivalent_aperture
from roughline.fluid.rarefied import Rarefied, conductance, kinetic_excess

TABLE = 0.005  # of the table between its points
STATIONS = 0.011  # of two pressures, or one, in place of the integral


def mean_along_seal(of_path, path, fall):
    """Mean of P Λ(P) over the mean pressure, which is 1, on many pressures."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    roots = (nodes + 1) / 2
    pressures = 1 - fall + 2 * fall * roots**2
    values = [of_path(path / pressure) for pressure in pressures]
    return float(np.sum(weights * roots * pressures * values))


@pytest.mark.parametrize("path", [0.03, 0.3, 3.0, 30.0, 300.0])
def test_plates_let_through_what_the_kinetic_equation_says(path):
    expected = kinetic(path, cells=int(40 + 8 / path))
    assert conductance(1.0, path) == pytest.approx(expected, rel=TABLE)


@pytest.mark.parametrize("fall", [1 / 3, 1.0])
@pytest.mark.parametrize("path", [0.1, 1.0, 10.0])
def test_a_seal_of_plates_lets_through_the_integral_over_its_pressures(path, fall):
    nodes, weights = np.polynomial.legendre.leggauss(4)
    roots = (nodes + 1) / 2
    pressures = 1 - fall + 2 * fall * roots**2
    solved = [kinetic(path / pressure, cells=30) for pressure in pressures]
    expected = np.sum(weights * roots * pressures * solved)
    assert Rarefied(path, fall).plates(1.0) == pytest.approx(expected, rel=STATIONS)


def test_a_little_slip_is_that_of_the_model():
    """Its slip is 1.1466 mean free paths: 1.016 in units of 2/sqrt(π) of them (Cercignani)."""
    path = 1e-4
    assert (conductance(1.0, path) - 1) / (6 * path) == pytest.approx(1.1466, rel=0.1)
    assert Rarefied(1e-9, 1.0).plates(1.0) == pytest.approx(1.0, abs=1e-7)


def test_molecules_alone_flow_with_the_square_of_the_gap():
    """Between walls that they meet before each other: 12/π λ u² ln(λ/u), for λ → ∞."""
    for path in (1e6, 1e9):
        slope = conductance(1.0, 10 * path) / (10 * path) - conductance(1.0, path) / path
        assert slope == pytest.approx(12 / np.pi * np.log(10), rel=1e-4)
        wide = conductance(2.0, 2 * path) / conductance(1.0, path)
        assert wide == pytest.approx(8.0, rel=1e-12)


@pytest.mark.parametrize("fall", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("path", [0.0, 1e-3, 1.0, 1e4])
@pytest.mark.parametrize("unit", [1.0, 1e-7])
def test_plates_are_found_from_what_they_let_through(path, fall, unit):
    gas = Rarefied(path * unit, fall)
    for gap in (0.01 * unit, unit, 30 * unit):
        assert gas.gap_of_plates(float(gas.plates(gap))) == pytest.approx(gap, rel=1e-12)
    assert gas.gap_of_plates(0.0) == 0
    assert gas.plates(np.array([0.0, np.nan])) == pytest.approx([0.0, np.nan], nan_ok=True)


def test_more_flows_the_rarer_a_gas_is():
    more = kinetic_excess(np.geomspace(1e-4, 1e5, 200), 1.0)
    assert more[0] == pytest.approx(1.0, abs=1e-3)
    assert (np.diff(more) > 0).all()


def test_a_liquid_has_the_same_measure_as_before():
    for along in ("x", "y"):
        assert equivalent_aperture(LIQUID, along) is rl.hydraulic_aperture(along)
    gaps = np.array([1e-9, 0.3, 7.0])
    assert (conductance(gaps, 0.0) == gaps**2 * gaps).all()


def through_steps(gaps, path, fall, times):
    """Throughput of a channel of two gaps, repeated, solved piece by piece along it."""
    grid = (1 + fall) * np.linspace(0, 1, 4001)[1:] ** 2
    losses = []
    for gap in gaps:  # the integral of P Λ(P) from vacuum on, which falls evenly in each piece
        rates = grid * conductance(gap, path / grid)
        first = rates[0] * grid[0]
        losses.append(integrate.cumulative_trapezoid(rates, grid, initial=0) + first)

    def past_end(throughput):
        pressure = 1 + fall
        for _ in range(times):
            for loss in losses:
                left = np.interp(pressure, grid, loss) - throughput / (2 * times)
                if left <= 0:
                    return -left
                pressure = np.interp(left, loss, grid)
        return 1 - fall - pressure

    most = 2 * times * max(loss[-1] for loss in losses)
    found = optimize.brentq(past_end, 0.0, most, rtol=1e-10)
    return found / (2 * fall)


@pytest.mark.parametrize("path", [0.05, 0.5, 20.0])
@pytest.mark.parametrize("fall", [0.2, 0.9])
def test_a_channel_with_steps_comes_to_its_mean_the_more_often_it_repeats(path, fall):
    gaps = (0.5, 1.5)

    def in_series(path):
        return 2 / sum(1 / conductance(gap, path) for gap in gaps)

    expected = mean_along_seal(in_series, path, fall)
    errors = [abs(through_steps(gaps, path, fall, n) / expected - 1) for n in (1, 8, 64)]
    assert errors[2] < errors[1] < errors[0]
    assert errors[2] < 2e-3


def stepped(gaps):
    """A channel of such gaps, one after the other, beside what bears the load."""
    heights = np.zeros((16, 16))
    heights[:8, 8:], heights[8:, 8:] = -gaps[0], -gaps[1]
    return rl.Surface(heights, (1.0, 1.0), is_cut_out=False)


@pytest.mark.parametrize("path", [0.05, 0.5, 20.0])
@pytest.mark.parametrize("fall", [0.2, 0.9])
def test_the_measure_of_a_channel_with_steps_is_what_flows_through_it(path, fall):
    gaps, scale = (0.5, 1.5), 1e-3
    gas = Rarefied(path * scale, fall)
    given = {"E_star": 1e6, "forces": [1e-6], "periodic": True}
    curve = rl.press(
        stepped(np.array(gaps) * scale), measures=[equivalent_aperture(gas, "x")], **given
    )
    found = gas.plates(curve.measured["hydraulic_aperture_x"].values[0]) / scale**3
    expected = through_steps(gaps, path, fall, 64) / 2  # half of the side is closed
    assert found == pytest.approx(expected, rel=2 * STATIONS)


@pytest.mark.parametrize("path", [0.003, 0.1, 3.0, 100.0])
def test_few_pressures_tell_what_flows_through_a_rough_gap(path):
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, q_high=100.0)
    given = {"E_star": 1.0, "forces": [0.04], "periodic": True}
    surface = spectrum.surface(32, rng=1)
    gap = rl.press(surface, fields=True, **given).fields[0]
    path *= rl.flow(gap).hydraulic_aperture

    def through(path):
        return rl.flow(gap, mean_free_path=path).permeance

    for fall in (1 / 3, 1.0):
        gas = Rarefied(path, fall)
        measured = rl.press(surface, measures=[equivalent_aperture(gas, "x")], **given).measured
        found = gas.plates(measured["hydraulic_aperture_x"].values[0])
        assert found == pytest.approx(mean_along_seal(through, path, fall), rel=STATIONS)
