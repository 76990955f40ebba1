"""The half-space makes one map from pressures to displacements, in any units and on any grid."""

import tracemalloc

import numpy as np
import pytest

import roughline as rl
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.operators import convolution
from roughline.halfspace.operators.convolution import displacement_field
from roughline.halfspace.operators.discretisation import coarser_grid, on_grid
from roughline.halfspace.operators.grid_nodes import GridNodes

ROUNDING = 1e-13

SHAPE, SPACING = (9, 6), (0.3, 0.7)
PRESSURE = np.random.default_rng(1).normal(size=SHAPE)

boundaries = pytest.mark.parametrize("periodic", [False, True])


@boundaries
def test_a_stiffer_half_space_yields_less(periodic):
    soft, stiff = (on_grid(Homogeneous(E, periodic), SHAPE, SPACING) for E in (1.0, 4.0))
    expected = displacement_field(soft, PRESSURE) / 4
    assert displacement_field(stiff, PRESSURE) == pytest.approx(expected, rel=ROUNDING)


@boundaries
def test_scaled_units_change_the_numbers_and_not_the_displacement(periodic):
    half_space, pressure, length = Homogeneous(70e9, periodic), 70e9, 2e-6
    expected = displacement_field(on_grid(half_space, SHAPE, SPACING), PRESSURE)
    scaled = half_space.in_units(pressure, length)
    spacing = (SPACING[0] / length, SPACING[1] / length)
    found = displacement_field(on_grid(scaled, SHAPE, spacing), PRESSURE / pressure) * length
    assert scaled.E_star == 1.0
    assert np.abs(found - expected).max() < ROUNDING * np.abs(expected).max()


def test_only_the_periodic_operator_counts_displacements_from_their_mean():
    for periodic in (False, True):
        operator = on_grid(Homogeneous(1.0, periodic), SHAPE, SPACING)
        even = displacement_field(operator, np.ones(SHAPE))
        assert operator.mean_is_free == periodic
        assert (np.abs(even).max() < ROUNDING) == periodic


def test_a_coarser_grid_covers_the_same_surface():
    for periodic in (False, True):
        shape, spacing = coarser_grid((8, 6), SPACING, periodic=periodic)
        assert shape == (4, 3)
        assert spacing == pytest.approx((0.6, 1.4))


def test_on_odd_sides_periods_stay_and_free_cells_double():
    spacings = {}
    for periodic in (False, True):
        shape, spacings[periodic] = coarser_grid((9, 1), SPACING, periodic=periodic)
        assert shape == (5, 1)
    assert spacings[False] == pytest.approx((0.6, 0.7))
    assert spacings[True] == pytest.approx((9 * 0.3 / 5, 0.7))


@pytest.mark.parametrize("E_star", [0.0, -1.0, np.inf, np.nan])
def test_a_modulus_that_is_none_is_refused(E_star):
    with pytest.raises(rl.InputError, match="a positive, finite contact modulus is needed"):
        Homogeneous(E_star)


@pytest.mark.parametrize(("shape", "spacing"), [((40, 57), (1.0, 1.0)), ((64, 30), (1.0, 2.7))])
def test_sums_over_pairs_are_those_of_the_transforms(monkeypatch, shape, spacing):
    monkeypatch.setattr(convolution, "FEW_MODES", 0)
    rng = np.random.default_rng(5)
    operator = on_grid(Homogeneous(E_star=2.0), shape, spacing)
    points = shape[0] * shape[1]
    sources, targets = (
        GridNodes.of(np.sort(rng.choice(points, n, replace=False)), shape) for n in (300, 200)
    )
    pressure = rng.random(300)
    transformed = operator.displacement(pressure, sources, targets)
    monkeypatch.setattr(convolution, "_MANY_MODES", 0)
    monkeypatch.setattr(convolution, "_PAIRS_PER_MODE", np.inf)
    summed = operator.displacement(pressure, sources, targets)
    assert (summed != transformed).any()
    np.testing.assert_allclose(summed, transformed, rtol=1e-13)
    out = np.empty(200)
    assert operator.displacement(pressure, sources, targets, out=out) is out
    np.testing.assert_array_equal(out, summed)


def test_the_displacement_of_many_nodes_under_few_takes_no_more_than_the_transform():
    """Sums over pairs hold one part for each of 32 blocks, which is much for many nodes."""
    shape = (1024, 1024)
    operator = on_grid(Homogeneous(E_star=1.0), shape, (1.0, 1.0))
    sources, targets = GridNodes.of(np.arange(4), shape), GridNodes.of(np.arange(2**19), shape)
    operator.displacement(np.ones(4), sources, targets)  # its memory stays
    tracemalloc.start()
    operator.displacement(np.ones(4), sources, targets)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4 * 8 * 2**19


@pytest.mark.parametrize("shape", [(16, 24), (9, 35), (1, 8)])
def test_modes_taken_in_even_and_odd_halves_displace_as_all_at_once(shape, monkeypatch):
    monkeypatch.setattr(convolution, "FEW_MODES", 0)
    operator = on_grid(Homogeneous(1.0), shape, (1.0, 0.6))
    rng = np.random.default_rng(8)
    sources, targets = (
        GridNodes.of(np.flatnonzero(rng.random(shape) < 0.4), shape) for _ in range(2)
    )
    pressure = rng.normal(size=sources.indices.size)
    expected = [operator.displacement(pressure, sources, where) for where in (None, targets)]
    monkeypatch.setattr(convolution, "_LARGE_GRID_POINTS", 0)
    for where, whole in zip((None, targets), expected, strict=True):
        halves = operator.displacement(pressure, sources, where)
        assert halves == pytest.approx(whole, abs=ROUNDING * abs(whole).max())
        assert (halves != whole).any()


@pytest.mark.parametrize("periodic", [False, True, "x", "y"])
@pytest.mark.parametrize("shape", [(16, 24), (9, 35), (1, 8), (64, 64)])
def test_a_small_grid_is_transformed_at_once_as_a_large_one_is_by_rows(
    monkeypatch, shape, periodic
):
    rng = np.random.default_rng(8)
    sources, targets = (
        GridNodes.of(np.flatnonzero(rng.random(shape) < 0.4), shape) for _ in range(2)
    )
    pressure, found = rng.normal(size=sources.indices.size), []
    for few in (convolution.FEW_MODES, 0):
        monkeypatch.setattr(convolution, "FEW_MODES", few)
        operator = on_grid(Homogeneous(1.0, periodic), shape, (1.0, 0.6))
        assert bool(operator.small_grid) == bool(few)
        found.append([operator.displacement(pressure, sources, each) for each in (None, targets)])
    for one, other in zip(*found, strict=True):
        assert one == pytest.approx(other, abs=ROUNDING * abs(other).max())


def test_an_interface_is_displaced_from_its_mean_and_by_waves_as_the_whole_is():
    free = rl.Layered(1.0, 0.4, 0.7, np.inf) + rl.Homogeneous(3.0)
    for each in (free, free.first):
        found = each.interface
        assert found.periodic
        assert found.mean_is_free
        assert found.interface is found
        assert repr(found) == f"({each!r}).interface"
        assert (found.E_star, found.disc_stiffness(2.0)) == (each.E_star, each.disc_stiffness(2.0))
        q = np.array([0.1, 1.0, 10.0])
        assert (found.spectrum(q) == each.spectrum(q)).all()
        operator = on_grid(found, SHAPE, SPACING)
        assert np.abs(displacement_field(operator, np.ones(SHAPE))).max() < ROUNDING
        scaled = found.in_units(2.0, 5.0)
        assert scaled.spectrum(q * 5) == pytest.approx(found.spectrum(q) * 2 / 5, rel=1e-12)
        with pytest.raises(rl.InputError, match="less than half a cell"):
            found.refuse((2.0, 0.1))
    assert rl.Homogeneous(3.0).interface == rl.Homogeneous(3.0, periodic=True)


def test_the_whole_of_a_repeated_layer_is_its_interface_and_the_even_spring_of_the_layer():
    """The depth differs by p h / M, with M = E (1 - nu) / ((1 + nu) (1 - 2 nu))."""
    body = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(16, rng=7)
    young, poisson, thickness = 1.0, 0.3, 0.1
    layer = rl.Layered(young, poisson, thickness, np.inf, periodic=True)
    spring = (
        thickness * (1 + poisson) * (1 - 2 * poisson) / (young * (1 - poisson)) / body.area
    )  # depth over force
    forces = [1e-4, 1e-3, 1e-2]
    whole = rl.press(body, half_space=layer, forces=forces)
    interface = rl.press(body, half_space=layer.interface, forces=forces)
    assert whole.area_fraction == pytest.approx(interface.area_fraction, abs=0)
    assert whole.depth - interface.depth == pytest.approx(spring * np.array(forces), rel=1e-6)
    assert 1 / whole.stiffness - 1 / interface.stiffness == pytest.approx(spring, rel=1e-5)


def test_waves_feel_the_modulus_of_a_half_space_that_they_displace_as_much():
    q = np.geomspace(1e-2, 1e3, 30)
    assert (rl.Homogeneous(3.0).modulus(q) == 3.0).all()
    layers = rl.Layered(2.0, 0.3, 0.1, 5.0, 0.2)
    felt = layers.modulus(q)
    assert felt[-1] == pytest.approx(layers.E_star, rel=1e-9)
    assert felt[0] == pytest.approx(5.0 / (1 - 0.2**2), rel=1e-2)
    for wave, modulus in zip(q, felt, strict=True):
        same = rl.Homogeneous(modulus).spectrum(np.array([wave]))
        assert same == pytest.approx(layers.spectrum(np.array([wave])), rel=1e-14)
