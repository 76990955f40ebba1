"""Where half-spaces and laws that the package does not know seal, and leak again."""

import numpy as np
import pytest

import roughline as rl
from halfspace.test_foreign_half_space import Coating, OnRigidBase
from halfspace.test_foreign_law import PowerLawPull, UnevenHardness

STIFF_COATING = Coating(1.0, -1.5, 0.02, periodic=True)
REPEATED = rl.Homogeneous(1.0, periodic=True)
SOFT_COATING = Coating(1.0, 0.7, 0.02, periodic=True)


@pytest.fixture(scope="module", params=[32, 64])
def surface(request):
    spectrum = rl.SelfAffine(hurst=0.5, rms_height=0.01, q_roll=8 * np.pi)
    return spectrum.surface(request.param, rng=1)


@pytest.fixture
def rtol(surface):
    """How far apart ends may be: on few points far, where nothing that is compared shows it."""
    return 0.2 if surface.shape == (32, 32) else 0.01


@pytest.mark.parametrize("half_space", [STIFF_COATING, SOFT_COATING, OnRigidBase(1.0, 0.1)])
def test_grooves_close_where_a_wave_is_in_full_contact(half_space):
    """Full contact with a wave d cos(q x) takes d / s(q), s the displacement over the pressure."""
    n = 64
    wave = 0.01 * np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)
    grooves = rl.Surface(np.repeat(wave[:, np.newaxis], 16, axis=1), (1.0, 1.0), is_cut_out=False)
    found = rl.sealing_pressure(
        grooves, half_space=half_space, along="y", interval=False, rtol=1e-4
    )
    exact = 0.01 / half_space.spectrum(np.array(2 * np.pi))
    # the cells nearest to the trough are half a cell away from it, and close before
    assert exact * (1 - 2 / n) < found.value <= exact * 1.0001


def test_an_even_hardness_of_each_node_is_that_of_all(surface, rtol):
    hardness = 0.4 * surface.rms_slope
    law = UnevenHardness(np.full(surface.shape, hardness))
    one, each = (
        rl.sealing_pressure(surface, half_space=REPEATED, law=given, rtol=rtol)
        for given in (rl.Yielding(hardness), law)
    )
    rounding = 1e-12
    assert [each.low, *each.interval] == pytest.approx([one.low, *one.interval], rel=rounding)


def test_a_law_of_each_node_is_taken_to_the_half_grid_and_the_quarters(surface):
    """The quarter that is softer than the others seals sooner."""
    hardness = np.full(surface.shape, 10 * surface.rms_slope)
    nx, ny = surface.shape
    hardness[nx // 2 :, ny // 2 :] = 0.1 * surface.rms_slope
    law = UnevenHardness(hardness)
    asked = {"half_space": REPEATED, "along": "x" if nx == 32 else "both"}
    found = rl.sealing_pressure(surface, law=law, **asked)
    elastic = rl.sealing_pressure(surface, **asked)
    assert found.on_quarters[:3] == pytest.approx(elastic.on_quarters[:3], rel=0.02)
    assert found.on_quarters[3] < 0.1 * surface.rms_slope
    half = rl.sealing_pressure(surface.coarsened(), law=UnevenHardness(hardness[::2, ::2]), **asked)
    assert found.on_half == pytest.approx(half.value, rel=0.01)
    curve = rl.press(surface, half_space=REPEATED, law=law, forces=[0.02])
    low, high = rl.reopening(curve, interval=True).interval
    assert 0 <= low < high <= 1


def test_waves_that_the_grid_lacks_meet_the_coating_alone(surface, rtol):
    """They add more to the pressure where the coating is stiffer than its base."""
    softer, same, stiffer = (
        found.interval[1] / found.high
        for half_space in (SOFT_COATING, REPEATED, STIFF_COATING)
        for found in [rl.sealing_pressure(surface, half_space=half_space, rtol=rtol)]
    )
    assert softer < 0.95 * same
    assert stiffer > 1.05 * same


def test_the_half_grid_is_left_by_the_largest_load_before(surface, rtol):
    """Its dents are of that load, as those of the surface are."""
    given = {"E_star": 1.0, "hardness": 0.4 * surface.rms_slope, "periodic": True}
    asked = {"along": "x", "rtol": rtol}
    after, alone = (
        rl.reopening(rl.press(surface, forces=forces, **given), interval=True, **asked)
        for forces in ([0.08, 0.05], [0.05])
    )
    coarse = rl.press(surface.coarsened(), forces=[0.08, 0.05], **given)
    assert after.on_half == pytest.approx(rl.reopening(coarse, **asked).value, rel=0.01 + rtol / 2)
    assert after.on_half != pytest.approx(alone.on_half, rel=0.1)


def test_a_pull_seals_sooner_and_its_reopening_is_told_what_to_do(surface):
    law = PowerLawPull(0.01, 0.001, 0.002)
    asked = {"half_space": REPEATED, "rtol": 0.01, "interval": False}
    alone, pulled = (rl.sealing_pressure(surface, law=each, **asked) for each in (None, law))
    assert pulled.high < alone.low
    curve = rl.press(surface, E_star=1.0, law=law, depths=[0.02])
    with pytest.raises(rl.InputError, match="PowerLawPull, which remembers its path .* measures="):
        rl.reopening(curve)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({}, r"sealing_pressure needs half_space=, such as rl.Homogeneous\(E_star=1.0"),
        ({"half_space": SOFT_COATING, "law": "steel"}, "a contact law is needed"),
        ({"half_space": "steel"}, "an rl.HalfSpace is needed"),
    ],
)
def test_its_half_space_and_its_law_are_those_of_a_press(surface, given, said):
    with pytest.raises(rl.InputError, match=said):
        rl.sealing_pressure(surface, **given)
