"""Where layers of rubber seal: thick and thin ones, and the springs that very thin ones are."""

import math

import numpy as np
import pytest

import roughline as rl
from roughline.exact.layers import BondedLayer

YOUNG, WAVE = 5e6, 8e-3  # modulus [Pa], longest wave [m]


def flange(seed, n=64, finest=6.0, waves=4):
    """A flange that is some of the longest waves wide."""
    q = 2 * math.pi / WAVE
    spectrum = rl.SelfAffine(
        hurst=0.8, length=waves * WAVE, rms_height=10e-6, q_roll=q, q_high=finest * q
    )
    return spectrum.surface(n, rng=seed)


def rubber(thickness, poisson=0.499):
    return rl.Layered(YOUNG, poisson, thickness, math.inf, periodic=True)


def sealing_pressure(surface, half_space, rtol=1e-3):
    found = rl.sealing_pressure(surface, half_space=half_space, interval=False, rtol=rtol)
    return found.value


@pytest.mark.parametrize("poisson", [0.3, 0.49, 0.499])
@pytest.mark.parametrize("seed", [1, 2])
def test_thick_rubber_seals_as_a_half_space_of_it(seed, poisson):
    thick = rubber(4 * WAVE, poisson)
    homogeneous = rl.Homogeneous(thick.E_star, periodic=True)
    surface = flange(seed)
    assert sealing_pressure(surface, thick) == pytest.approx(
        sealing_pressure(surface, homogeneous), rel=1e-3
    )


@pytest.mark.parametrize(
    "flanges",
    [
        [{"seed": 5, "n": 16, "waves": 1}],
        [{"seed": 5, "n": 32, "waves": 2}],
        [{"seed": seed} for seed in range(1, 9)],
    ],
    ids=["one of one wave", "one of two waves", "eight"],
)
def test_the_thinner_the_rubber_the_more_it_takes_in_the_mean_of_flanges(flanges):
    """One flange may seal a tenth sooner than on thick rubber, near half a wave.

    Rubber so thin is harder to the longest waves alone. Under the pressures of thick rubber it
    would sink less at some places and more at others than in the contact on average. Those flanges
    seal sooner whose last channel lies at one of the former.
    """
    surfaces, shares = [flange(**each) for each in flanges], (0.04, 0.1, 0.3, 0.5, 4)
    found = np.log(
        [[sealing_pressure(each, rubber(h * WAVE)) for h in shares] for each in surfaces]
    )
    assert (np.diff(found.mean(axis=0)) < 0).all()
    assert (np.diff(found[:, :3]) < 0).all()
    beside_thick = np.exp(found - found[:, -1:])
    assert (beside_thick[:, 0] > 30).all()
    if len(flanges) == 1:
        return  # how much they differ is told by several
    assert 0.85 < beside_thick[:, 3].min() < 0.95
    assert 1.2 < beside_thick[:, 3].max() < 1.4
    assert 6 < np.exp((found[:, 1] - found[:, -1]).mean()) < 8


@pytest.mark.parametrize("given", [{"n": 32, "waves": 2}, {}], ids=["two waves", "four"])
def test_rubber_that_keeps_its_volume_better_takes_more_where_it_is_thin(given):
    surface = flange(2, **given)
    thin, thick = (
        [sealing_pressure(surface, rubber(h * WAVE, nu)) for nu in (0.49, 0.499)] for h in (0.04, 2)
    )
    assert thin[1] > 1.8 * thin[0]
    assert thick[1] == pytest.approx(thick[0], rel=0.02)


@pytest.mark.parametrize("thickness", [0.05 * WAVE, 0.2 * WAVE])
@pytest.mark.parametrize("seed", [1, 3])
def test_the_fluid_comes_through_below_and_not_above(seed, thickness):
    surface, half_space = flange(seed), rubber(thickness)
    found = rl.sealing_pressure(surface, half_space=half_space, interval=False)
    forces = np.array([found.low, found.high]) * surface.area
    curve = rl.press(surface, half_space=half_space, forces=forces, fields=True)
    below, above = ([rl.flow(fields, along=along) for along in "xy"] for fields in curve.fields)
    assert not all(flow.is_sealed for flow in below)
    assert all(flow.is_sealed for flow in above)
    assert max(flow.hydraulic_aperture for flow in below) > 0


@pytest.mark.parametrize("poisson", [0.3, 0.49, 0.499])
@pytest.mark.parametrize("thickness", [0.03, 0.2, 2.0])
def test_grooves_close_where_a_wave_is_in_full_contact(poisson, thickness):
    """By the closed form of one bonded layer; the deepest cells are half a cell off the trough."""
    n, depth = 64, 1e-5
    wave = depth * np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)
    heights = np.repeat(wave[:, np.newaxis], 16, axis=1)
    grooves = rl.Surface(heights, (WAVE, WAVE / 4), is_cut_out=False)
    layer = BondedLayer(YOUNG, poisson, thickness * WAVE)
    exact = depth / float(layer.compliance(2 * math.pi / WAVE))
    half_space = rubber(thickness * WAVE, poisson)
    found = rl.sealing_pressure(
        grooves, half_space=half_space, along="y", interval=False, rtol=1e-4
    )
    assert exact * (1 - 3 / n) < found.value <= exact * 1.0001


@pytest.mark.parametrize(
    ("seed", "n", "waves"), [(1, 32, 1), (1, 64, 2), (1, 128, 4), (2, 128, 4), (3, 128, 4)]
)
def test_a_very_thin_layer_seals_as_springs_do_with_a_rate(seed, n, waves):
    """Springs touch where the flange is above a level, and islands close the last channel.

    Waves feel springs up to the square of wavenumber and thickness.
    """
    surface, poisson = flange(seed, n, finest=3.0, waves=waves), 0.2
    low, high = float(surface.heights.min()), float(surface.heights.max())
    while high - low > 1e-4 * surface.rms_height:
        level = (low + high) / 2
        gap = np.maximum(level - surface.heights, 0.0)
        flows = [rl.flow(gap, surface.sizes, along=along, sides="periodic") for along in "xy"]
        low, high = (level, high) if all(flow.is_sealed for flow in flows) else (low, level)
    overlap = float(np.maximum(surface.heights - level, 0.0).mean())
    errors = []
    for cells in (0.55, 2.2):
        thickness = cells * max(surface.spacing)
        of_springs = BondedLayer(YOUNG, poisson, thickness).spring * overlap
        found = sealing_pressure(surface, rubber(thickness, poisson), rtol=1e-4)
        errors.append(found / of_springs - 1)
    assert 0 < errors[0] < 3e-3
    assert errors[1] > 8 * errors[0]
