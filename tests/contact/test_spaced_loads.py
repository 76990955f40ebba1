"""Where spaced loads end, on homogeneous half-spaces and on those that have a length."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from halfspace.test_foreign_half_space import Coating, OnRigidBase
from roughline.contact.loads import separation_depth

N = 64
SPECTRA = {
    "fractal": rl.SelfAffine(hurst=0.8, rms_height=0.01),
    "rolled off": rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, q_high=100.0),
}
CELL = 1 / N
SOFT = [
    rl.Layered(1.0, 0.3, CELL, 1e3, 0.3),
    rl.Layered(1.0, 0.49, CELL, math.inf),
    rl.Layered(1.0, 0.49, 0.1, 1e3, 0.3),
    rl.Layered(1.0, 0.3, 0.1, 10.0, 0.3),
    rl.Layered(1.0, 0.3, 1.0, math.inf),
    rl.Layered(1.0, 0.3, 10.0, 1e3, 0.3),
    rl.Layered([1.0, 20.0], [0.45, 0.3], [0.05, 0.1], math.inf),
    rl.Layered(1.0, 0.3, 0.1, 10.0, 0.3) + rl.Homogeneous(2.0),
    Coating(1.0, 0.7, 0.05),
]
HARD = [
    rl.Layered(1.0, 0.3, CELL, 1e-3, 0.3),
    rl.Layered(1.0, 0.3, CELL, 0.1, 0.3),
    rl.Layered(1.0, 0.3, 0.1, 0.1, 0.3),
    rl.Layered(1.0, 0.3, 1.0, 1e-3, 0.3),
    rl.Layered(1.0, 0.3, 10.0, 1e-3, 0.3),
    rl.Layered([1.0, 20.0], [0.3, 0.3], [0.05, 0.1], 0.5, 0.3),
    Coating(1.0, -1.5, 0.05),
]


@pytest.fixture(params=SPECTRA)
def surface(request):
    return SPECTRA[request.param].surface(N, 3)


def repeated(half_space):
    if isinstance(half_space, rl.TwoBodies):
        return repeated(half_space.first) + repeated(half_space.second)
    return replace(half_space, periodic=True)


def last_of(surface, half_space):
    """The forces, and the last of these pressed: contact area, and stiffness over the punch's."""
    forces = rl.press(surface, half_space=half_space, n_loads=2, throw=False).force
    last = rl.press(surface, half_space=half_space, forces=forces[-1:])
    flat = rl.Surface(np.zeros(surface.shape), surface.sizes)
    punch = math.inf
    if not half_space.periodic:
        punch = rl.press(flat, half_space=half_space, depths=[1.0]).stiffness[0]
    return forces, last.area_fraction[0], last.stiffness[0] / punch


def test_on_homogeneous_half_spaces_they_end_where_they_always_did(surface):
    """At 3 E* h L, and repeated at a mean pressure of E* times the rms slope, to the last bit."""
    free, periodic = (
        rl.press(surface, E_star=2.0, periodic=each, n_loads=2, throw=False).force[-1]
        for each in (False, True)
    )
    assert free == np.geomspace(1.0, 3.0 * 2.0 * surface.rms_height * surface.length, 2)[-1]
    assert periodic == np.geomspace(1.0, 2.0 * surface.rms_slope * surface.area, 2)[-1]
    _, area, stiffness = last_of(surface, rl.Homogeneous(2.0))
    assert 0.15 < area < 0.35
    assert stiffness > 0.84
    assert last_of(surface, rl.Homogeneous(2.0, periodic=True))[1] > 0.95


@pytest.mark.parametrize("half_space", [*SOFT, *HARD], ids=str)
def test_free_ones_end_within_15_percent_of_the_punch_as_homogeneous_ones_do(surface, half_space):
    _, usual, _ = last_of(surface, rl.Homogeneous(1.0))
    forces, area, stiffness = last_of(surface, half_space)
    assert forces[0] <= 1e-3 * forces[-1]
    assert stiffness > 0.84
    if half_space in HARD:  # pressures near full contact move the area of a stiff surface alone
        assert 0.4 * usual < area < 1.1 * usual
    else:
        assert 0.9 * usual < area <= 1.0


def test_a_hard_plate_on_a_soft_base_ends_stiff_while_few_points_touch(surface):
    """It bends away from what would touch next."""
    _, area, stiffness = last_of(surface, rl.Layered(1.0, 0.3, 0.1, 1e-3, 0.3))
    assert 0.005 < area < 0.05
    assert stiffness > 0.99


@pytest.mark.parametrize("half_space", [*SOFT, *HARD], ids=str)
def test_repeated_ones_end_near_full_contact(surface, half_space):
    _, area, _ = last_of(surface, repeated(half_space))
    assert 0.94 < area <= 1.0


def test_even_pressure_on_a_rigid_base_does_not_move_the_end(surface):
    assert 0.94 < last_of(surface, OnRigidBase(1.0, 0.02))[1] < 0.99


def test_single_precision_takes_the_loads_of_a_stiff_thin_layer():
    """What it resolves is told by how deep a flat punch would sink, not by the layer's modulus."""
    surface = SPECTRA["rolled off"].surface(N, 3)
    thin, plate = SOFT[1], HARD[0]
    given = {"solver": rl.Solver(precision="float32"), "rtol": 1e-4, "throw": False}
    curve = rl.press(surface, half_space=thin, n_loads=2, **given)
    assert curve.force_bar[-1] > 100
    with pytest.raises(rl.InputError, match="of what sinks a flat punch by the rms height: so de"):
        rl.press(surface, half_space=plate, forces=10 * curve.force[-1:] * plate.E_star, **given)


@pytest.mark.parametrize("half_space", [rl.Homogeneous(1.0), SOFT[2], *HARD[2:4]], ids=str)
def test_a_cycle_of_bodies_that_stick_ends_apart(half_space):
    """Even where all but a flat punch sticks to a hard layer, which holds it ten times as far."""
    x = (np.arange(24) + 0.5) / 24 - 0.5
    disc = np.hypot(x[:, np.newaxis], x) < 0.45
    punch = rl.Surface(np.where(disc, 0.0, -1.0), (1.0, 1.0))
    law = rl.Dugdale(1e-3 * half_space.E_star, 0.03)
    apart = separation_depth(punch, half_space, law, 0.01)
    depths = [0.01, *(apart * np.linspace(0.0, 1.0, 20))]
    curve = rl.press(punch, half_space=half_space, law=law, depths=depths)
    assert curve.force[-1] == 0.0
    assert apart < curve.pull_off_depth < 0
    if half_space is HARD[3]:
        assert curve.pull_off_depth < 10 * -0.03


@pytest.mark.parametrize("periodic", [False, True, "x"])
@pytest.mark.parametrize("work", [2.5e-4, 2.5e-5])
def test_a_cycle_of_bodies_that_stick_goes_on_well_beyond_the_pull_off(periodic, work):
    """It begins and ends out of reach, and few of its loads are spent there."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=4e-3, q_roll=25.0, q_high=50.0)
    body = spectrum.surface(32, rng=3)
    law = rl.Dugdale(work, math.sqrt(work) / 1.5)
    curve = rl.press(body, E_star=1.0, law=law, periodic=periodic, n_loads=24)
    assert curve.depth.size == 24
    assert curve.force.max() > 1.5 * -curve.pull_off_force > 0
    assert curve.force[0] == curve.force[-1] == 0
    assert (curve.force == 0).mean() < 0.4


def test_a_cycle_is_interrupted_before_its_depths_are_known(monkeypatch):
    """What was tried until then is no curve of the loads that were asked for."""

    def stopped(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("roughline.contact.full.solve_path", stopped)
    body = SPECTRA["rolled off"].surface(N, 3)
    with pytest.raises(KeyboardInterrupt) as stop:
        rl.press(body, E_star=1.0, law=rl.Exponential(1e-4, 0.01), n_loads=8)
    assert not isinstance(stop.value, rl.Interrupted)
