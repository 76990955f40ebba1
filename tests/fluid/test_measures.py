"""What a fluid finds in the gap under each load, taken without keeping the fields."""

import gc

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_surfaces import Make, parent_of
from roughline.fluid import measures
from roughline.fluid.measures import (
    LIQUID,
    equivalent_aperture,
    flow_factor,
    hydraulic_aperture,
    inverse_gap,
    largest_share,
    slope_of_flow,
)

PATH = 1e-3
FORCES = [0.02, 0.05, 0.4]  # open, and sealed


@pytest.fixture(scope="module")
def surface():
    return rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, q_high=100.0).surface(64, rng=7)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("along", ["x", "y"])
def test_they_are_those_of_the_flow_through_the_fields(surface, periodic, along):
    taken = [
        hydraulic_aperture(along),
        hydraulic_aperture(along, PATH),
        flow_factor(LIQUID, along),
        largest_share(LIQUID, along),
        slope_of_flow(LIQUID, along),
        rl.MEAN_GAP,
    ]
    given = {"E_star": 1.0, "forces": FORCES, "periodic": periodic}
    found = rl.press(surface, measures=taken, **given).measured
    kept = rl.press(surface, fields=True, **given).fields
    flows = [
        rl.flow(each, each.sizes, along=along, sides="periodic" if periodic else "closed")
        for each in kept
    ]
    aperture = found[f"hydraulic_aperture_{along}"].values
    assert aperture == pytest.approx([flow.hydraulic_aperture for flow in flows], rel=1e-12)
    assert (aperture == 0).tolist() == [flow.is_sealed for flow in flows] == [False, False, True]
    factor = (aperture / found["mean_gap"].values) ** 3
    assert found[f"pressure_flow_factor_{along}"].values == pytest.approx(factor, rel=1e-9)
    share = found[f"largest_share_{along}"].values
    assert share.tolist() == [flow.largest_share for flow in flows]
    assert found[f"flow_slope_{along}"].values.tolist() == [flow.slope for flow in flows]
    slipping = found[f"slip_aperture_{along}"].values
    assert (slipping[:2] > aperture[:2]).all()
    assert slipping[2] == 0


def test_several_measures_of_a_load_are_of_one_flow(surface, monkeypatch):
    solved = []
    monkeypatch.setattr(
        measures, "flow", lambda *given, **named: solved.append(1) or rl.flow(*given, **named)
    )
    taken = [each(LIQUID, "x") for each in (equivalent_aperture, flow_factor, largest_share)]
    rl.press(surface, E_star=1.0, forces=FORCES, periodic=True, measures=taken)
    assert len(solved) == len(FORCES)
    gc.collect()
    assert not measures._FOUND  # nothing is kept once the fields are gone


@pytest.mark.parametrize("jump", [0.01, 1.0])
def test_the_mean_of_the_inverse_gap_between_its_bounds(surface, jump):
    """Jensen's inequality from below; the temperature jump alone from above."""
    taken = [inverse_gap(jump), rl.MEAN_GAP]
    curve = rl.press(surface, E_star=1.0, forces=FORCES, periodic=True, measures=taken)
    share, gap = 1 - curve.area_fraction, curve.measured["mean_gap"].values
    found = curve.measured["inverse_gap"].values
    assert (share / (gap / share + jump) <= found * (1 + 1e-12)).all()
    assert (found <= share / jump).all()


def test_the_mean_of_the_inverse_gap_under_a_wave_that_hardly_touches():
    """Of u = a (1 - cos q x) it is 1 / sqrt(M² + 2 a M), by the mean of 1 / (c - cos q x)."""
    x = 2 * np.pi * np.arange(64) / 64
    wave = rl.Surface(0.01 * np.cos(x)[:, np.newaxis] * np.ones(16), (1.0, 0.25), is_cut_out=False)
    for jump in (0.01, 0.1):
        taken = [inverse_gap(jump)]
        curve = rl.press(wave, E_star=1e9, forces=[1e-6], periodic=True, measures=taken)
        expected = 1 / np.sqrt(jump**2 + 2 * 0.01 * jump)
        touching = curve.area_fraction[0] / jump  # the nodes at u = 0, which no gas is in
        found = curve.measured["inverse_gap"].values[0] + touching
        assert found == pytest.approx(expected, rel=1e-6)


def test_a_gap_between_flat_plates_is_its_own_aperture():
    """A low plateau beside a high one: the fluid flows over the low one."""
    heights = np.zeros((32, 32))
    heights[:, 16:] = -0.01
    plates = rl.Surface(heights, (1.0, 1.0), is_cut_out=False)
    taken = [hydraulic_aperture("x"), hydraulic_aperture("y"), largest_share(LIQUID, "x")]
    curve = rl.press(plates, E_star=1e6, forces=[1e-6], periodic=True, measures=taken)
    aperture = curve.measured["hydraulic_aperture_x"].values[0]
    assert aperture == pytest.approx(0.01 / np.cbrt(2), rel=1e-6)
    assert curve.measured["hydraulic_aperture_y"].values[0] == 0


@pytest.mark.parametrize("n", [32, 64])
@pytest.mark.parametrize("is_cut", [False, True])
@pytest.mark.parametrize("hardness_bar", [None, 0.4])
def test_the_interval_of_an_aperture_holds_what_a_grid_four_times_finer_gives(
    n, is_cut, hardness_bar
):
    """From an open gap to sealing, with and without waves that the grid does not have."""
    q_high = np.pi / 2 * n if is_cut else None
    spectrum = rl.SelfAffine(hurst=0.5, rms_height=0.01, q_high=q_high)
    coarse, fine = spectrum.surface(n, 3002), spectrum.surface(4 * n, 3002)
    slope = fine.rms_slope
    given = {"E_star": 1.0, "periodic": True, "measures": [hydraulic_aperture("x")]}
    given |= {"forces": slope * np.array([0.02, 0.06, 0.12, 0.18, 0.22])}
    given |= {"hardness": hardness_bar and hardness_bar * slope}
    found = rl.press(coarse, grid_error=True, **given).measured["hydraulic_aperture_x"]
    truth = rl.press(fine, **given).measured["hydraulic_aperture_x"].values
    assert (found.low <= truth).all()
    assert (truth <= found.high).all()
    assert (found.low <= found.values).all()
    assert (found.values <= found.high).all()


def test_a_gap_that_is_sealed_on_the_coarse_grid_alone_is_told_so_by_its_interval():
    spectrum = rl.SelfAffine(hurst=0.5, rms_height=0.01)
    coarse, fine = spectrum.surface(32, 3002), spectrum.surface(128, 3002)
    given = {"E_star": 1.0, "periodic": True, "measures": [hydraulic_aperture("x")]}
    given |= {"forces": fine.rms_slope * np.array([0.12, 0.22])}
    found = rl.press(coarse, grid_error=True, **given).measured["hydraulic_aperture_x"]
    truth = rl.press(fine, **given).measured["hydraulic_aperture_x"].values
    assert found.values[-1] == found.low[-1] == 0
    assert 0 < truth[-1] <= found.high[-1]


@pytest.mark.parametrize("kind", ["worn", "ground, 30"])
@pytest.mark.parametrize("hardness_bar", [None, 0.15])
def test_intervals_hold_where_pixels_hide_most_of_the_roughness(kind, hardness_bar):
    """Pixels of an instrument lose the edges of worn plateaus, and most of a coarse grinding."""
    make = Make(points=256, maps=1, hurst=0.6, waves=6.0, cells=4.0)
    fine = parent_of(kind, make, np.random.default_rng(13))
    coarse = fine.coarsened().coarsened()
    given = {"E_star": 1.0, "measures": [rl.MEAN_GAP, hydraulic_aperture("x")]}
    given |= {"forces": fine.rms_slope * fine.area * np.array([0.003, 0.02])}
    given |= {"periodic": False, "hardness": hardness_bar and hardness_bar * fine.rms_slope}
    found, truth = rl.press(coarse, grid_error=True, **given), rl.press(fine, **given)
    for name, each in found.measured.items():
        assert (each.low <= truth.measured[name].values).all(), name
        assert (truth.measured[name].values <= each.high).all(), name
