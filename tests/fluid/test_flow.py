"""Flow through a gap: against dense solutions, its own balances, symmetries and limits."""

from types import SimpleNamespace

import numpy as np
import pytest

import roughline as rl
from roughline.errors import InputError

BALANCE = 1e-12  # of inflow, outflow and dissipation: sums of positive terms, and nothing else
CELL = 1e-10  # the same where nothing ends, and flows of either sign are added
TURNED = {"x": "y", "y": "x"}  # sides along which a turned gap repeats
DENSE = 1e-9  # relative error that a dense solution may have itself


def rough_gap(n, seed, closed=0.4, hurst=0.8):
    """The gap of a periodic surface that is cut at a height, so much of it closed."""
    heights = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_roll=25.0).surface(n, rng=seed).heights
    return np.maximum(np.quantile(heights, 1 - closed) - heights, 0.0)


def dense_permeance(gap, sizes, periodic):
    """Permeance along x from one dense system of equations for the cells."""
    nx, ny = gap.shape
    along, across = (sizes[1] / ny) / (sizes[0] / nx), (sizes[0] / nx) / (sizes[1] / ny)
    k = gap**3
    matrix, inflow = np.zeros((nx * ny, nx * ny)), np.zeros(nx * ny)
    for i, j in np.ndindex(nx, ny):
        here = i * ny + j
        neighbours = [(i + 1, j, along)] if i + 1 < nx else []
        if j + 1 < ny or periodic:
            neighbours.append((i, (j + 1) % ny, across))
        for p, q, square in neighbours:
            if k[i, j] > 0 and k[p, q] > 0:
                there, g = p * ny + q, square * 2 / (1 / k[i, j] + 1 / k[p, q])
                matrix[[here, there], [here, there]] += g
                matrix[[here, there], [there, here]] -= g
        if i == 0:
            inflow[here] = 2 * along * k[i, j]
        if i in (0, nx - 1):
            matrix[here, here] += 2 * along * k[i, j]
    pressure = np.linalg.lstsq(matrix, inflow, rcond=1e-14)[0]
    return inflow @ (1 - pressure) * sizes[0] / sizes[1]


@pytest.mark.parametrize("sides", ["y", "closed"])
@pytest.mark.parametrize("shape", [(2, 2), (2, 9), (7, 2), (12, 12), (17, 23), (40, 31), (5, 40)])
def test_a_dense_solution_finds_the_same(shape, sides):
    rng = np.random.default_rng(shape[0] + shape[1])
    for _ in range(4):
        gap = rng.random(shape) * (rng.random(shape) > 0.25)
        sizes = (1.3, 0.7)
        expected = dense_permeance(gap, sizes, sides == "y")
        found = rl.flow(gap, sizes, sides=sides)
        assert found.permeance == pytest.approx(expected, rel=DENSE, abs=1e-12)
        assert found.imbalance < BALANCE


@pytest.mark.parametrize("closed", [0.0, 0.2, 0.4, 0.47])
@pytest.mark.parametrize("along", ["x", "y"])
@pytest.mark.parametrize("sides", ["periodic", "closed", "x", "y"])
def test_what_flows_in_flows_out_and_is_dissipated(closed, along, sides):
    flow = rl.flow(rough_gap(128, 3, closed), (1.0, 2.0), along=along, sides=sides)
    assert flow.converged
    assert flow.imbalance < (CELL if sides in ("periodic", along) else BALANCE)
    sources = np.diff(flow.rates_x, axis=0) + np.diff(flow.rates_y, axis=1)
    assert abs(sources).max() <= 1e-9 * flow.inflow


def test_every_cross_section_lets_the_same_through():
    flow = rl.flow(rough_gap(96, 5), (1.0, 1.0))
    assert flow.rates_x.sum(axis=1) == pytest.approx(np.full(97, flow.inflow), rel=1e-10)


@pytest.mark.parametrize("sides", ["periodic", "closed"])
def test_rates_follow_from_the_pressure(sides):
    gap = rough_gap(64, 2)
    flow = rl.flow(gap, (1.0, 1.0), sides=sides)
    first, second = gap[:-1] ** 3, gap[1:] ** 3
    both = first + second
    mean = np.divide(2 * first * second, both, out=np.zeros_like(both), where=both > 0)
    fall = np.nan_to_num(flow.pressure[:-1] - flow.pressure[1:])
    assert flow.rates_x[1:-1] == pytest.approx(mean * fall, abs=1e-9 * flow.inflow)


@pytest.mark.parametrize("sides", ["periodic", "closed", "x", "y"])
def test_turning_the_gap_turns_the_flow(sides):
    gap = rough_gap(48, 7)[:, :36]
    along_x = rl.flow(gap, (2.0, 1.0), sides=sides)
    along_y = rl.flow(gap.T, (1.0, 2.0), along="y", sides=TURNED.get(sides, sides))
    assert along_y.permeance == pytest.approx(along_x.permeance, rel=1e-12)
    assert along_y.pressure == pytest.approx(along_x.pressure.T, rel=1e-9, nan_ok=True)
    turned = along_y.flux[::-1].swapaxes(1, 2)
    assert turned == pytest.approx(along_x.flux, abs=1e-9 * along_x.inflow)
    both = rl.flow(gap, (2.0, 1.0), along="both", sides=sides)
    assert [each.along for each in both] == ["x", "y"]
    assert both[0].permeance == along_x.permeance
    back = rl.flow(gap[::-1], (2.0, 1.0), sides=sides)
    assert back.permeance == pytest.approx(along_x.permeance, rel=1e-12)


def test_a_path_through_the_periodic_border_is_found():
    gap = np.zeros((6, 6))
    gap[:3, 0] = gap[2:, -1] = 1.0
    assert rl.flow(gap, (1.0, 1.0), sides="closed").is_sealed
    assert rl.flow(gap, (1.0, 1.0), sides="y").permeance > 0


def test_a_last_channel_is_as_accurate_as_any():
    """A wide gap, a throat narrower by so many orders, and a wide gap, in series."""
    for throat in (1e-3, 1e-6, 1e-9, 1e-12):
        gap = np.zeros((33, 33))
        gap[:16], gap[17:] = 1.0, 1.0
        gap[16, 20] = throat
        flow = rl.flow(gap, (1.0, 1.0))
        assert flow.imbalance < BALANCE
        assert flow.inflow == pytest.approx(throat**3, rel=2.1 * max(throat**3, 1e-15) * 1e3)
        assert flow.constriction == (16, 20)
        assert flow.largest_share == pytest.approx(1.0, rel=1e-12)


def test_sealed_is_exactly_zero():
    gap = np.ones((20, 20))
    gap[7] = 0
    flow = rl.flow(gap, (1.0, 1.0), sides="y")
    assert flow.is_sealed
    assert flow.converged
    assert (flow.permeance, flow.hydraulic_aperture, flow.imbalance) == (0.0, 0.0, 0.0)
    assert (flow.dissipation, flow.largest_share, flow.constriction) == (0.0, 0.0, None)
    assert (flow.pressure[:7] == 1).all()
    assert np.isnan(flow.pressure[7]).all()
    assert (flow.pressure[8:] == 0).all()
    assert not flow.flux.any()
    assert rl.flow(np.zeros((4, 4)), (1.0, 1.0)).is_sealed


def test_closed_pockets_change_nothing():
    gap = rough_gap(64, 11, closed=0.45)
    before = rl.flow(gap, (1.0, 1.0))
    unreached = np.isnan(before.pressure) & (gap > 0)
    assert unreached.any()
    after = rl.flow(np.where(unreached, 0.0, gap), (1.0, 1.0))
    assert after.permeance == before.permeance


def test_a_gas_flows_between_plates_as_kinetic_theory_says():
    """Two gaps in series: each of its own rarefaction (Cercignani and Daneri 1963)."""
    flat = rl.flow(np.full((8, 8), 2.0), (1.0, 1.0), mean_free_path=1.0)
    assert flat.permeance == pytest.approx(1.332 * (2.0**3 + 6 * 2.0**2), rel=1e-12)
    gap = np.full((8, 8), 2.0)
    gap[:4] = 1.0
    stepped = rl.flow(gap, (1.0, 1.0), mean_free_path=1.0).permeance
    assert stepped == pytest.approx(2 / (1 / flat.permeance + 1 / (1.4919 * 7)), rel=1e-12)


def test_the_same_bytes_every_time():
    gap = rough_gap(128, 1)
    first, second = (rl.flow(gap, (1.0, 1.0)) for _ in range(2))
    assert first.permeance == second.permeance
    assert np.array_equal(first.pressure, second.pressure, equal_nan=True)


def test_the_gap_of_a_load_is_its_fields():
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    loads = [0.01, 0.05]
    curve = rl.press(surface, E_star=1.0, forces=loads, periodic=True, fields=True)
    low, high = map(rl.flow, curve.fields)
    assert high.permeance < low.permeance
    assert not high.gap[curve.fields[1].contact].any()
    assert "flow" in repr(high).lower()
    assert (high.sizes, high.sides) == (surface.sizes, "periodic")
    free = rl.press(surface, E_star=1.0, forces=[0.05], fields=True)
    assert rl.flow(free.fields[0]).sides == "closed"
    assert rl.flow(free.fields[0], sizes=(2.0, 1.0), sides="periodic").sides == "periodic"


def test_what_is_too_steep_is_said():
    """The same gap, 1,000 times as high."""
    gap = rough_gap(64, 4)
    assert rl.flow(1e-4 * gap, (1.0, 1.0)).validity == ""
    assert "slope" in rl.flow(0.5 * gap, (1.0, 1.0)).validity
    assert "aperture" in rl.flow(np.full((8, 8), 0.2), (1.0, 1.0)).validity


@pytest.mark.parametrize(
    ("gap", "words"),
    [
        (np.ones(8), "two dimensions"),
        (np.ones((1, 8)), "at least 2 cells"),
        (np.ones((8, 1)), "at least 2 cells"),
        (np.full((4, 4), -1.0), "no distances, the first -1.0 at"),
        (np.full((4, 4), np.nan), "no distances, the first nan at"),
        (np.full((4, 4), np.inf), "no distances, the first inf at"),
        (np.full((4, 4), 1e200), "number from 1e-40 to 1e[+]40"),  # its cube is none
        (np.full((4, 4), 1e-110), "number from 1e-40 to 1e[+]40"),  # its cube is zero
        (np.ma.masked_less(np.eye(4), 1), "12 values .* not masked"),
        (np.ones((4, 4), complex), "array of numbers"),
        (np.ones((4, 4), "M8[D]"), "array of numbers"),
        ("gap.npy", "array of numbers"),
        (rl.Line(np.arange(8.0), length=1.0), "Line"),
        (rl.Surface(np.ones((4, 4)), sizes=(1.0, 1.0)), "press it"),
    ],
)
def test_gaps_that_are_none_are_refused(gap, words):
    with pytest.raises(InputError, match=words):
        rl.flow(gap, sizes=(1.0, 1.0))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({}, "sizes"),
        ({"sizes": (1.0, 0.0)}, "sizes"),
        ({"sizes": 1.0}, "sizes"),
        ({"sizes": (1.0, 1.0), "along": "z"}, "along"),
        ({"sizes": (1.0, 1.0), "sides": "open"}, "sides"),
        ({"sizes": (1.0, 1.0), "sides": True}, "sides"),
        ({"sizes": (1.0, 1.0), "mean_free_path": -1.0}, "mean_free_path"),
        ({"sizes": (1.0, 1.0), "mean_free_path": 1e300}, "mean_free_path is 1e[+]300"),
        ({"sizes": (1e-100, 1e100)}, "times as long as wide"),
    ],
)
def test_arguments_that_do_not_fit_are_refused(arguments, words):
    with pytest.raises(InputError, match=words):
        rl.flow(np.ones((4, 4)), **arguments)


def test_what_does_not_fit_into_memory_is_refused_before_the_work(monkeypatch):
    none = SimpleNamespace(available=10_000)
    monkeypatch.setattr("roughline.computing.memory.psutil.virtual_memory", lambda: none)
    with pytest.raises(InputError, match="GB of memory"):
        rl.flow(np.ones((64, 64)), (1.0, 1.0))
