"""Flow through gaps of known permeance, with the rates at which it comes nearer on finer grids."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from scipy import ndimage

import roughline as rl
from roughline.exact import flow as exact

SIDES = ("periodic", "closed")
ROUNDING = 1e-12  # of one cell after another
SECOND = (1.9, 2.1)  # rates that are of the second order
FIRST = (0.8, 1.2)  # and of the first, where an outline is drawn with whole cells
GAPS = arrays.arrays(np.float64, (7, 6), elements=st.just(0.0) | st.floats(0.05, 2.0))


def middles(n):
    return (np.arange(n) + 0.5) / n


def rates(errors):
    """Orders of convergence from one grid to the next, twice as fine."""
    return np.log2(np.abs(errors[:-1]) / np.abs(errors[1:]))


def smooth_gap(n, seed, deviation=0.5):
    """A log-normal gap of few waves, the same one on every grid, in units of its median."""
    waves = rl.SelfAffine(hurst=0.8, C_0=1.0, q_roll=4 * math.pi, q_high=12 * math.pi)
    heights = waves.surface(n, seed).heights
    return np.exp(deviation * heights / waves.surface(32, seed).rms_height)


@pytest.mark.parametrize("sides", SIDES)
@pytest.mark.parametrize("shape", [(9, 9), (5, 16), (40, 3)])
@pytest.mark.parametrize("sizes", [(1.0, 1.0), (3e-3, 1e-3)])
def test_flat_plates_and_strips_are_exact_on_any_grid(shape, sizes, sides):
    along, across = rl.flow(np.full(shape, 2e-6), sizes, along="both", sides=sides)
    assert along.permeance == pytest.approx(exact.uniform(2e-6), rel=ROUNDING)
    assert across.hydraulic_aperture == pytest.approx(2e-6, rel=ROUNDING)
    strips = np.random.default_rng(1).uniform(0.1, 2.0, shape[0])
    gap = np.repeat(strips[:, np.newaxis], shape[1], axis=1)
    along, across = rl.flow(gap, sizes, along="both", sides=sides)
    assert along.permeance == pytest.approx(exact.in_series(strips), rel=ROUNDING)
    assert across.permeance == pytest.approx(exact.in_parallel(strips), rel=ROUNDING)


def test_a_wedge_in_the_second_order():
    errors = []
    for n in (8, 16, 32, 64):
        gap = np.repeat((0.9 - 0.6 * middles(n))[:, np.newaxis], 4, axis=1)
        found = rl.flow(gap, (2.0, 1.0), sides="y").permeance
        errors.append(found / exact.wedge(0.9, 0.3) - 1)
    assert ((rates(errors) > SECOND[0]) & (rates(errors) < SECOND[1])).all()


@pytest.mark.parametrize("amplitude", [0.3, 0.8])
def test_a_whole_wave_faster_than_any_power(amplitude):
    """Means over whole waves: each doubling squares the error until it is rounding."""
    across, along = [], []
    for n in (8, 16, 32, 64):
        wave = 0.7 * (1 + amplitude * np.cos(2 * np.pi * middles(n)))
        gap = np.repeat(wave[:, np.newaxis], 5, axis=1)
        flows = rl.flow(gap, (1.0, 0.3), along="both")
        across.append(flows[0].permeance / exact.across_a_wave(0.7, amplitude) - 1)
        along.append(flows[1].permeance / exact.along_a_wave(0.7, amplitude) - 1)
    assert np.abs(along).max() < ROUNDING
    errors = np.abs(across)
    assert (errors[1:] <= 3 * errors[:-1] ** 2 + ROUNDING).all()
    assert errors[-1] < 1e-8


@pytest.mark.parametrize("grids", [(32, 64, 128), (32, 64, 128, 256)])
def test_discs_in_a_square_cell_in_the_first_order(grids):
    """Four radii on some grids; each falls as 1 / n, and their mean at the rate 1."""
    errors = []
    for n in grids:
        radius = np.hypot(*np.meshgrid(middles(n) - 0.5, middles(n) - 0.5))
        errors.append(
            [
                rl.flow(np.where(radius < R, 0.0, 2.0), (3.0, 3.0)).permeance
                / exact.disc_in_a_square_cell(R, 2.0)
                - 1
                for R in (0.1, 0.2, 0.3, 0.4)
            ]
        )
        assert np.abs(errors[-1]).max() < 4.0 / n
    mean = np.abs(errors).mean(axis=1)
    overall = math.log2(mean[0] / mean[-1]) / (len(grids) - 1)
    assert FIRST[0] < overall < FIRST[1]


@pytest.mark.parametrize("seed", [3, 4])
def test_duality_on_rough_gaps_in_the_second_order(seed):
    """The flow along x and that of the reciprocal gap along y, between two closed sides."""
    errors = []
    for n in (32, 64, 128):
        gap = smooth_gap(n, seed)
        along = rl.flow(gap, (1.0, 1.0), sides="closed").permeance
        dual = rl.flow(exact.dual_gap(gap, 0.7), (1.0, 1.0), along="y", sides="closed").permeance
        errors.append(dual / exact.dual_permeance(along, 0.7) - 1)
    assert ((rates(errors) > SECOND[0]) & (rates(errors) < SECOND[1])).all()
    assert abs(errors[-1]) < 3e-3


@pytest.mark.parametrize("n", [32, 64])
def test_log_normal_gaps_have_their_median_in_the_mean(n):
    logs = [
        math.log(rl.flow(gap, (1.0, 1.0), along=along).hydraulic_aperture)
        for gap in (smooth_gap(n, seed) for seed in range(12))
        for along in ("x", "y")
    ]
    assert abs(np.mean(logs)) < 3 * np.std(logs) / math.sqrt(len(logs))
    assert np.std(logs) < 0.2


@pytest.mark.parametrize("sides", SIDES)
@pytest.mark.parametrize("closed", [0.0, 0.4])
def test_scaling_turning_and_repeating(sides, closed):
    gap = np.maximum(smooth_gap(48, 5) - closed * 1.5, 0.0)[:, :40]
    flow = rl.flow(gap, (1.2, 1.0), sides=sides)
    assert flow.permeance > 0
    alike = (
        rl.flow(gap, (1.2e-9, 1e-9), sides=sides).permeance,
        rl.flow(1e6 * gap, (1.2, 1.0), sides=sides).permeance / 1e18,
        rl.flow(1e-9 * gap, (1.2, 1.0), sides=sides).permeance * 1e27,
        rl.flow(np.rot90(gap), (1.0, 1.2), along="y", sides=sides).permeance,
        rl.flow(gap.T, (1.0, 1.2), along="y", sides=sides).permeance,
        rl.flow(gap[::-1, ::-1], (1.2, 1.0), sides=sides).permeance,
    )
    assert alike == pytest.approx([flow.permeance] * len(alike), rel=1e-10)
    beside = np.concatenate([gap, gap if sides == "periodic" else gap[:, ::-1]], axis=1)
    assert rl.flow(beside, (1.2, 2.0), sides=sides).permeance == pytest.approx(
        flow.permeance, rel=1e-10
    )
    behind = np.concatenate([gap, gap[::-1]])  # a mirror image is at half the pressure between
    mirrored = rl.flow(behind, (2.4, 1.0), sides=sides).permeance
    if sides == "periodic":
        ended = rl.flow(gap, (1.2, 1.0), sides="y").permeance
        assert mirrored == pytest.approx(ended, rel=1e-10)
    else:
        assert mirrored <= flow.permeance * (1 + 1e-10)
    if sides == "periodic":
        moved = rl.flow(np.roll(gap, (11, 7), (0, 1)), (1.2, 1.0)).permeance
        assert moved == pytest.approx(flow.permeance, rel=1e-10)


@settings(deadline=None, max_examples=60)
@given(
    GAPS, arrays.arrays(np.float64, (7, 6), elements=st.floats(0.0, 1.0)), st.sampled_from(SIDES)
)
def test_a_smaller_gap_never_lets_more_through(gap, part, sides):
    flow = rl.flow(gap, (1.0, 1.5), sides=sides)
    smaller = rl.flow(gap * np.where(part < 0.2, 0.0, part), (1.0, 1.5), sides=sides)
    assert smaller.permeance <= flow.permeance * (1 + ROUNDING)


@settings(deadline=None, max_examples=60)
@given(GAPS, st.sampled_from(SIDES))
def test_the_flow_lies_between_walls_and_short_circuits(gap, sides):
    low, high = exact.bounds(gap)
    found = rl.flow(gap, (1.0, 1.5), sides=sides).permeance
    assert low * (1 - ROUNDING) <= found <= high * (1 + ROUNDING)


@settings(deadline=None, max_examples=40)
@given(GAPS, st.sampled_from(SIDES), st.sampled_from(("x", "y")))
def test_the_power_is_the_pressure_times_the_flow(gap, sides, along):
    """From the pressures that are returned, face by face."""
    flow = rl.flow(gap, (1.0, 1.5), along=along, sides=sides)
    k, p, width, length = (
        np.where(np.isnan(flow.pressure), 0, gap**3),
        flow.pressure,
        1.5 / 6,
        1 / 7,
    )
    if along == "y":
        k, p, width, length = k.T, p.T, length, width

    def power(first, second, fall, square):
        joined = (first > 0) & (second > 0)
        harmonic = 2 * first * second / np.where(joined, first + second, 1.0)
        return float((square * np.where(joined, harmonic * fall**2, 0.0)).sum())

    k, p = np.where(np.isnan(p), 0.0, k), np.nan_to_num(p)  # nothing flows where it is not known
    total = power(k[:-1], k[1:], p[:-1] - p[1:], width / length)
    if sides == "periodic":
        total += power(k, np.roll(k, -1, 1), p - np.roll(p, -1, 1), length / width)
    else:
        total += power(k[:, :-1], k[:, 1:], p[:, :-1] - p[:, 1:], length / width)
    if sides == "periodic":
        total += power(k[-1], k[0], p[-1] - p[0] + 1, width / length)
    else:
        ends = k[0] * (1 - p[0]) ** 2 + k[-1] * p[-1] ** 2
        total += float(ends.sum()) * 2 * width / length
    assert total == pytest.approx(flow.inflow, rel=1e-9, abs=1e-15)


def cut_at_a_level(seed, closed, n=64):
    """Heights of a Gaussian surface that is cut at a level, so much of it closed."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=12 * math.pi, q_high=20 * math.pi)
    heights = spectrum.surface(n, seed, "gaussian").heights
    return np.maximum(np.quantile(heights, 1 - closed) - heights, 0.0)


@pytest.mark.parametrize("count", [15, 60])
def test_it_is_sealed_where_contact_crosses_from_side_to_side(count):
    """Of two closed sides: cells of contact join at their corners as well, open ones do not."""
    found = set()
    for seed in range(count):
        gap = cut_at_a_level(seed, 0.5)
        labels, _ = ndimage.label(gap == 0, np.ones((3, 3)))
        crossed = bool(set(labels[:, 0]) & set(labels[:, -1]) - {0})
        assert rl.flow(gap, (1.0, 1.0), sides="closed").is_sealed == crossed
        found.add(crossed)
    assert found == {True, False}


@pytest.mark.parametrize("n", [32, 64])
def test_undeformed_gaussian_surfaces_seal_at_half_contact(n):
    """A square is open along x as often as closed along y, and h as likely as -h."""
    shares = {}
    for closed in (0.3, 0.5, 0.7):
        sealed = [
            rl.flow(cut_at_a_level(seed, closed, n), (1.0, 1.0), sides="closed").is_sealed
            for seed in range(60)
        ]
        shares[closed] = np.mean(sealed)
    assert shares[0.3] < 0.1
    assert shares[0.7] > 0.9
    # three standard errors of 60, and the corners, at which contact joins and the gap does not
    assert abs(shares[0.5] - 0.5) < 3 * 0.5 / math.sqrt(60) + 0.05
