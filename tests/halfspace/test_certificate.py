"""A damaged solver is not believed: what is returned as certified is a solution, or nothing is."""

import dataclasses

import numpy as np
import pytest

import roughline as rl
from halfspace.dense_contact import love_matrix
from roughline.halfspace.operators import discretisation
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.search import active_set, small_grid

pytestmark = pytest.mark.usefixtures("nothing_kept")  # a sound kernel, or a damaged one

SURFACE = rl.SelfAffine(hurst=0.7, rms_height=1.0).surface(24, 3)
FORCES = [0.05, 0.5, 3.0]


def dense_kernel():
    return love_matrix((24, 24), SURFACE.spacing)


def assert_true_where_certified(curve):
    """Recompute the residuals of each certified load with the dense matrix."""
    kernel = dense_kernel()
    separation = (SURFACE.heights.max() - SURFACE.heights).ravel()
    for i in np.flatnonzero(curve.converged):
        pressure = curve.fields[i].pressure.ravel()
        gap = kernel @ pressure + separation - curve.depth[i]
        scale = min(1.0, curve.depth[i])
        assert pressure.min() >= 0
        assert np.abs(gap[pressure > 0]).max() <= 1.1e-6 * scale
        assert gap.min() >= -1.1e-6 * scale
        cell = SURFACE.area / SURFACE.heights.size
        assert pressure.sum() * cell == pytest.approx(curve.force[i], rel=1e-6)


def pressed(**options):
    return rl.press(
        SURFACE,
        E_star=1.0,
        forces=FORCES,
        fields=True,
        throw=False,
        solver=rl.Solver(max_iterations=300),
        **options,
    )


def test_the_sound_solver_is_certified():
    curve = pressed()
    assert curve.converged.all()
    assert_true_where_certified(curve)


def test_a_kernel_of_the_wrong_sign_is_refused(monkeypatch):
    sound = discretisation._free

    def wrong(*arguments):
        spectrum, periods = sound(*arguments)
        return -spectrum, periods

    monkeypatch.setattr(discretisation, "_free", wrong)
    curve = pressed()
    assert not curve.converged.any()
    assert np.isnan(curve.stiffness).all()
    with pytest.raises(rl.ConvergenceError, match=r"3 of 3 loads .*; worst residual"):
        rl.press(SURFACE, E_star=1.0, forces=FORCES, solver=rl.Solver(max_iterations=300))


@pytest.mark.parametrize("skipped", range(12))
def test_a_skipped_convolution_never_certifies_a_wrong_contact(monkeypatch, skipped):
    """The certificate is recomputed: it repairs a wrong step, or refuses."""
    sound, calls = Convolution.displacement, []

    def skipping(self, pressure, sources, targets=None, *options, **others):
        calls.append(targets)
        result = sound(self, pressure, sources, targets, *options, **others)
        # the steps' convolutions, one in twelve of them; certificates are another matter
        skip = targets is not None and len(calls) % 12 == skipped
        return np.zeros_like(result) if skip else result

    monkeypatch.setattr(Convolution, "displacement", skipping)
    assert_true_where_certified(pressed())


def test_steps_that_are_all_wrong_are_refused(monkeypatch):
    sound = Convolution.displacement

    def wrong(self, pressure, sources, targets=None, *options, **others):
        result = sound(self, pressure, sources, targets, *options, **others)
        return result if targets is None else 3 * result[::-1]

    monkeypatch.setattr(Convolution, "displacement", wrong)
    assert_true_where_certified(pressed())


def test_a_stale_contact_set_is_refused(monkeypatch, by_regions):
    monkeypatch.setattr(active_set, "exchanged", lambda region, carriers, *wrong: carriers)
    curve = pressed()
    assert not curve.converged.any()
    assert (curve.residual > 1e-6).all()


def test_a_contact_set_that_only_grows_is_refused(monkeypatch, by_regions):
    sound = active_set.exchanged

    def growing(region, carriers, watched, wrong):
        wrong = dataclasses.replace(wrong, below=np.zeros_like(wrong.below))
        return sound(region, carriers, watched, wrong)

    monkeypatch.setattr(active_set, "exchanged", growing)
    curve = pressed()
    assert_true_where_certified(curve)
    assert not curve.converged.all()


def test_a_useless_preconditioner_costs_time_and_not_truth(monkeypatch, by_regions):
    from roughline.halfspace.search import patch

    monkeypatch.setattr(patch, "preconditioner", lambda inverse, nodes: np.copy)
    curve = pressed()
    assert curve.converged.all()
    assert_true_where_certified(curve)
    assert curve.stiffness == pytest.approx(pressed().stiffness, rel=1e-6)


@pytest.mark.parametrize("load", [{"forces": [0.5]}, {"depths": [1.0]}])
def test_nodes_exchanged_one_by_one_reach_the_same_contact(monkeypatch, by_regions, load):
    surface = rl.SelfAffine(hurst=0.7, rms_height=1.0).surface(12, 3)
    together = rl.press(surface, E_star=1.0, **load)
    monkeypatch.setattr(active_set, "_MOST_ROUNDS", -1)
    monkeypatch.setattr(active_set._ExchangeRule, "one_by_one", True)
    alone = rl.press(surface, E_star=1.0, **load)
    assert alone.converged.all()
    assert alone.convolutions[0] > together.convolutions[0]
    assert alone.area_fraction == together.area_fraction
    assert alone.stiffness == pytest.approx(together.stiffness, rel=1e-7)


def one_third(pressure):
    """Return pressures of which every third is missing."""
    pressure[::3] = 0.0
    return pressure


@pytest.mark.parametrize(
    ("part", "damaged"),
    [
        ("_factor", lambda sound: lambda *a: 2 * sound(*a)),
        ("_exchanged_by_gap", lambda sound: lambda *a: (0, 0.0, 1.0)),
        ("_exchanged", lambda sound: lambda *a: 0),
        ("_missing", lambda sound: lambda *a: (0 * (found := sound(*a))[0], *found[1:])),
        ("_carried_over", lambda sound: lambda *a: one_third(sound(*a))),
    ],
)
@pytest.mark.parametrize("few", [0, 400])
def test_a_small_grid_that_is_solved_wrongly_is_not_believed(monkeypatch, part, damaged, few):
    sound = pressed()
    monkeypatch.setattr(small_grid, "MOST_FACTORED_NODES", few)
    monkeypatch.setattr(small_grid, part, damaged(getattr(small_grid, part)))
    curve = pressed()
    assert_true_where_certified(curve)
    solved = curve.converged
    assert curve.stiffness[solved] == pytest.approx(sound.stiffness[solved], rel=1e-7)
