"""The mean pressure at which the last channel closes, and down to which load it stays so."""

import math
from itertools import product

import numpy as np
import pytest

import roughline as rl
from random_cases import cases
from roughline.contact.fields import Fields
from roughline.fluid.one_map import can_be_cut, factor_left_open
from roughline.fluid.sealing_pressure import CHANNEL

REPEATED = rl.Homogeneous(1.0, periodic=True)


@pytest.fixture(scope="module")
def spectrum():
    return rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, q_high=100.0)


def sealed(surface, pressure, along, **given):
    curve = rl.press(surface, forces=[pressure * surface.area], fields=True, **given)
    sides = "periodic" if curve.half_space.periodic else "closed"
    return rl.flow(curve.fields[0], surface.sizes, along=along, sides=sides).is_sealed


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("hardness", [None, 0.2])
@pytest.mark.parametrize("along", ["x", "y"])
def test_the_gap_is_open_at_the_low_end_and_sealed_at_the_high_one(
    spectrum, periodic, hardness, along
):
    # across its border the last channel along y would stay open longer, which free bodies close
    surface = spectrum.surface(64, rng=5)
    law = None if hardness is None else rl.Yielding(hardness)
    given = {"half_space": rl.Homogeneous(1.0, periodic), "law": law}
    found = rl.sealing_pressure(surface, along=along, interval=False, **given)
    assert found.low < found.high <= 1.01 * found.low
    assert not sealed(surface, found.low, along, **given)
    assert sealed(surface, found.high, along, **given)
    assert found.area_fractions[0] <= found.area_fractions[1]


def test_of_both_directions_it_is_the_larger_one(spectrum):
    surface = spectrum.surface(64, rng=7)
    x, y, both = (
        rl.sealing_pressure(surface, half_space=REPEATED, along=along, interval=False).value
        for along in ("x", "y", "both")
    )
    assert both == pytest.approx(max(x, y), rel=0.01)


def test_it_scales_with_modulus_and_slope(spectrum):
    surface = spectrum.surface(64, rng=7)
    steeper = rl.Surface(3 * surface.heights, surface.sizes, is_cut_out=False)
    one, six = (
        rl.sealing_pressure(given, half_space=half_space, rtol=1e-3, interval=False).value
        for given, half_space in (
            (surface, REPEATED),
            (steeper, rl.Homogeneous(2.0, periodic=True)),
        )
    )
    assert six == pytest.approx(6 * one, rel=2e-3)


@pytest.mark.parametrize("n", [32, 64, 128])
def test_grooves_close_where_a_wave_is_in_full_contact(n):
    """Along a wave d cos(2 pi x / L) only full contact seals, under pi E* d / L (Westergaard)."""
    wave = 0.01 * np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)
    surface = rl.Surface(np.repeat(wave[:, np.newaxis], n, axis=1), (1.0, 1.0), is_cut_out=False)
    found = rl.sealing_pressure(surface, half_space=REPEATED, along="y", interval=False, rtol=1e-4)
    # the cells nearest to the trough are half a cell away from it, and close before
    assert found.value == pytest.approx(np.pi * 0.01, rel=2 / n)
    assert found.value <= np.pi * 0.01 * 1.0001


KINDS = list(product((0.5, 0.8), (None, 2 * np.pi * 16), (False, True)))
"""Hurst exponent, shortest wave, and whether the surface yields."""


@pytest.mark.parametrize(
    ("n", "surfaces"), [(32, range(1)), (32, range(2)), (64, range(len(KINDS) * cases(4, share=2)))]
)
def test_its_interval_holds_that_of_grids_four_times_finer(n, surfaces):
    """Their gaps are open under its lower end and sealed under its upper one."""
    held = []
    for number in surfaces:
        seed, (hurst, q_high, yields) = 5000 + number // len(KINDS), KINDS[number % len(KINDS)]
        spectrum = rl.SelfAffine(hurst=hurst, rms_height=0.01, q_roll=8 * np.pi, q_high=q_high)
        coarse, fine = spectrum.surface(n, seed), spectrum.surface(4 * n, seed)
        hardness = 0.4 * fine.rms_slope if yields else math.inf
        law = rl.Yielding(hardness) if yields else rl.Unilateral()
        low, high = rl.sealing_pressure(coarse, half_space=REPEATED, law=law).interval
        held.append(is_open(fine, low, hardness) and not is_open(fine, high, hardness))
    assert np.mean(held) >= 0.9


def is_open(surface, pressure, hardness):
    """Whether a path leads through in either direction; none does where all bears the hardness."""
    if pressure >= hardness:
        return False
    curve = rl.press(
        surface,
        forces=[pressure * surface.area],
        half_space=REPEATED,
        hardness=hardness,
        measures=[CHANNEL["both"]],
    )
    return bool(curve.measured[CHANNEL["both"].name].values[0])


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"surface": rl.Surface(np.zeros((16, 16)), (1.0, 1.0))}, "is flat"),
        ({"surface": rl.SelfAffine(hurst=0.8, rms_height=1.0).line(64, 1)}, "is no Surface"),
        ({"along": "z"}, "along"),
        ({"rtol": 0}, "rtol"),
        ({"half_space": 1.0}, "an rl.HalfSpace is needed"),
        ({"law": 0.3}, "a contact law is needed"),
    ],
)
def test_what_cannot_be_used_is_refused(spectrum, given, said):
    told = {"surface": spectrum.surface(32, 1), "half_space": REPEATED} | given
    with pytest.raises(rl.InputError, match=said):
        rl.sealing_pressure(**told)


FORCE = 0.06


@pytest.fixture(scope="module")
def pressed(spectrum):
    """A force that leaves the gap open, on elastic bodies and on soft ones."""
    surface = spectrum.surface(64, rng=7)
    return {
        hardness: rl.press(
            surface, E_star=1.0, periodic=True, hardness=hardness, forces=[FORCE], fields=True
        )
        for hardness in (None, 0.25)
    }


@pytest.mark.parametrize("hardness", [None, 0.25])
def test_on_the_way_back_ten_times_as_much_leaks_at_the_low_end(pressed, hardness):
    curve = pressed[hardness]
    found = rl.reopening(curve, along="x")
    history = rl.press(
        curve.surface,
        E_star=1.0,
        periodic=True,
        hardness=hardness,
        forces=[FORCE, FORCE * found.high, FORCE * found.low],
        fields=True,
    )
    full, high, low = (rl.flow(each, each.sizes, along="x").permeance for each in history.fields)
    assert high < 10 * full <= low
    assert found.apertures == pytest.approx(np.cbrt([full, low, high]), rel=1e-5)


def test_elastic_bodies_leak_as_when_the_load_rose(pressed):
    curve = pressed[None]
    found = rl.reopening(curve, times=5.0, along="y")
    rising = rl.press(
        curve.surface,
        E_star=1.0,
        periodic=True,
        forces=[FORCE * found.low, FORCE * found.high, FORCE],
        fields=True,
    )
    low, high, full = (rl.flow(each, each.sizes, along="y").permeance for each in rising.fields)
    assert high < 5 * full <= low


@pytest.mark.parametrize("n", [32, 64])
def test_a_surface_that_yielded_stays_tight_longer(spectrum, n):
    """Flattened summits, under the force that makes elastic bodies leak as little."""
    surface = spectrum.surface(n, rng=7)
    shares = [
        rl.reopening(
            rl.press(surface, E_star=1.0, periodic=True, hardness=hardness, forces=[force]),
            along="both",
        ).value
        for hardness, force in ((None, 0.05), (0.1, 0.03))
    ]
    assert shares[1] < shares[0]


def test_what_cannot_be_taken_off_is_refused(pressed):
    curve = pressed[None]
    with pytest.raises(rl.InputError, match="the curve has loads 0 to 0"):
        rl.reopening(curve, 3)
    with pytest.raises(rl.InputError, match="a factor above 1"):
        rl.reopening(curve, times=1.0)
    line = rl.press(rl.SelfAffine(hurst=0.8, rms_height=1.0).line(64, 1), E_star=1.0, forces=[1.0])
    with pytest.raises(rl.InputError, match="the reduced model does not give: press a Surface"):
        rl.reopening(line)


@pytest.mark.parametrize(("n", "seeds"), [(32, [2]), (64, range(cases(24, share=6)))])
def test_the_interval_of_the_load_left_holds_that_of_the_larger_surface(n, seeds):
    """Maps that are cut from a surface four times as large, and lose their tilt."""
    held = []
    for seed in seeds:
        spectrum = rl.SelfAffine(
            hurst=(0.5, 0.8)[seed % 2], rms_height=0.01, q_roll=16 * np.pi, q_high=64 * np.pi
        )
        part, is_yielding = spectrum.surface(2 * n, seed), seed // 2 % 2
        one = part.cropped((0, n), (0, n)).detrended()
        pressure = (0.1 if is_yielding else 0.15) * part.rms_slope
        given = {"E_star": 1.0, "periodic": True}
        given |= {"hardness": 0.4 * part.rms_slope} if is_yielding else {}
        truth, found = (
            rl.reopening(
                rl.press(each, forces=[pressure * each.area], **given),
                along="x",
                rtol=0.05,
                interval=each is one,
            )
            for each in (part, one)
        )
        held.append(found.interval[0] <= truth.value <= found.interval[1])
    assert np.mean(held) >= 0.9


def test_a_layer_that_half_the_points_do_not_resolve_is_not_halved():
    surface = rl.Surface(np.zeros((64, 64)), (64.0, 64.0))
    for thickness, resolved in ((1.0, True), (0.8, False)):
        layer = rl.Layered(1.0, 0.3, thickness, 2.0, 0.3, periodic=True)
        assert can_be_cut(surface, layer) == resolved


@pytest.mark.parametrize(("q_roll", "tells"), [(60.0, True), (None, False)])
def test_a_piece_without_waves_of_its_roll_off_does_not_tell_how_early_its_whole_seals(
    q_roll, tells
):
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=q_roll)
    piece = spectrum.surface(128, rng=3).cropped((0, 64), (0, 64))
    low, high = rl.sealing_pressure(piece, half_space=REPEATED, along="x", rtol=0.1).interval
    assert (low > 0) == tells
    assert high > low
    whole = rl.Surface(piece.heights, piece.sizes, is_cut_out=False)
    found = rl.sealing_pressure(whole, half_space=REPEATED, along="x", rtol=0.1)
    assert found.interval[0] > 0


def test_what_finer_grids_and_other_places_leave_open_combine_as_independent():
    def left_open(half, quarters, *, tells=True, of_grid=1.0):
        return factor_left_open(1.0, half, quarters, tells=tells, of_grid=of_grid)

    alike, unlike = [1.0] * 4, [0.5, 0.5, 2.0, 2.0]
    assert left_open(1.0, alike) == 1
    assert left_open(1.0, alike, of_grid=3.0) == pytest.approx(3)
    assert left_open(5.0, alike, of_grid=3.0) == pytest.approx(5)
    of_size = np.log(left_open(1.0, unlike))
    both = np.log(left_open(1.0, unlike, of_grid=3.0))
    assert both == pytest.approx(np.hypot(of_size, np.log(3)))
    assert left_open(1.0, [1.5] * 4) == 1
    assert left_open(1.0, [1.5] * 4, tells=False) == pytest.approx(1.5**2)


@pytest.mark.parametrize("hardness", [None, 0.2])
def test_rising_loads_leave_the_channel_that_each_leaves_alone(spectrum, hardness):
    surface, pressures = spectrum.surface(64, rng=5), np.array([0.02, 0.03, 0.04])
    given = {"E_star": 1.0, "periodic": True, "hardness": hardness, "measures": [CHANNEL["x"]]}

    def channel(pressures):
        return rl.press(surface, forces=pressures * surface.area, **given).measured

    name = CHANNEL["x"].name
    alone = [float(channel(each[np.newaxis])[name].values[0]) for each in pressures]
    assert channel(pressures)[name].values == pytest.approx(alone, rel=1e-6)
    assert alone[0] > alone[1] > alone[2] > 0


def test_the_last_channel_is_as_wide_as_the_narrowest_place_of_the_widest_way_through():
    """Beside a way that is 3 wide everywhere there is one of 5 with a place of 2."""
    gap = np.zeros((64, 64))
    gap[:, 10], gap[:, 30] = 3.0, 5.0
    gap[20, 30] = 2.0
    closed, nothing = gap == 0, np.zeros_like(gap)
    fields = Fields(
        nothing, nothing, gap, closed, closed, closed, nothing, sizes=(1.0, 1.0), periodic=True
    )
    assert CHANNEL["x"].of(fields) == CHANNEL["both"].of(fields) == 3
    assert CHANNEL["y"].of(fields) == 0
