"""The search by whole fields finds what the general search finds, and finds it by itself."""

from itertools import pairwise

import numpy as np
import pytest

import roughline as rl
from roughline.halfspace.operators import convolution
from roughline.halfspace.search import small_grid

pytestmark = pytest.mark.usefixtures("nothing_kept")

SURFACE = rl.SelfAffine(hurst=0.7, rms_height=1.0).surface(40, 3)


@pytest.fixture
def searched(monkeypatch):
    """Whether each search found a contact."""
    found, sound = [], small_grid.contact_under

    def watched(*arguments):
        contact, convolutions = sound(*arguments)
        found.append(contact is not None)
        return contact, convolutions

    monkeypatch.setattr(small_grid, "contact_under", watched)

    return found


@pytest.mark.parametrize("periodic", [False, True, "x", "y"])
@pytest.mark.parametrize("factored", [0, 10**6])
@pytest.mark.parametrize("control", ["forces", "depths"])
def test_it_finds_the_contact_and_the_stiffness_of_the_general_search(
    monkeypatch, searched, periodic, factored, control
):
    monkeypatch.setattr(small_grid, "MOST_FACTORED_NODES", factored)
    loads = {"forces": [0.02, 0.3, 2.0], "depths": [0.3, 0.8, 1.2]}[control]
    given = {control: loads, "E_star": 1.0, "periodic": periodic, "fields": True}
    at_once = rl.press(SURFACE, **given)
    assert all(searched)
    assert len(searched) >= 3
    monkeypatch.undo()
    monkeypatch.setattr(convolution, "FEW_MODES", 0)
    by_regions = rl.press(SURFACE, **given)
    assert at_once.area_fraction.tolist() == by_regions.area_fraction.tolist()
    assert at_once.stiffness == pytest.approx(by_regions.stiffness, rel=1e-7)
    assert at_once.force == pytest.approx(by_regions.force, rel=1e-5)
    for one, other in zip(at_once.fields, by_regions.fields, strict=True):
        assert one.pressure == pytest.approx(other.pressure, abs=1e-5 * other.pressure.max())


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("factored", [0, 10**6])
@pytest.mark.parametrize("hardness", [0.3, 1.0, 3.0])
def test_it_finds_the_points_that_yield(monkeypatch, searched, periodic, factored, hardness):
    """Loads rise, fall and rise beyond the largest one; bodies are elastic in between."""
    monkeypatch.setattr(small_grid, "MOST_FACTORED_NODES", factored)
    given = {"E_star": 1.0, "periodic": periodic, "hardness": hardness, "fields": True}
    given["forces"] = 0.7 * hardness * np.array([0.05, 0.4, 0.1, 0.4, 1.0, 0.0, 0.8])
    at_once = rl.press(SURFACE, **given)
    assert sum(searched) >= np.count_nonzero(given["forces"])  # no load is left to the other
    assert not any(one is next_one is False for one, next_one in pairwise(searched))
    monkeypatch.undo()
    monkeypatch.setattr(convolution, "FEW_MODES", 0)
    by_regions = rl.press(SURFACE, **given)
    assert at_once.plastic_fraction.max() > 0.1
    for name in ("area_fraction", "plastic_fraction"):
        assert getattr(at_once, name).tolist() == getattr(by_regions, name).tolist()
    assert at_once.stiffness == pytest.approx(by_regions.stiffness, rel=1e-7)
    assert at_once.indentation == pytest.approx(by_regions.indentation, rel=1e-4, abs=1e-5)


@pytest.mark.parametrize("factored", [0, 10**6])
def test_steps_are_few(monkeypatch, searched, factored):
    """A wrong preconditioner, or wrong exchanges, would show here first."""
    monkeypatch.setattr(small_grid, "MOST_FACTORED_NODES", factored)
    curve = rl.press(SURFACE, E_star=1.0, forces=[0.5])
    assert all(searched)
    assert curve.convolutions[0] <= (9 if factored else 31)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("force", [0.5, 5.0])
def test_pressures_that_flatten_the_bodies_guess_the_contact_without_coarser_grids(
    searched, periodic, force
):
    curve = rl.press(SURFACE, E_star=1.0, forces=[force], periodic=periodic)
    assert searched == [True]
    assert curve.convolutions[0] <= 36


def test_a_bound_on_convolutions_holds(monkeypatch):
    few = rl.press(
        SURFACE, E_star=1.0, forces=[0.5], solver=rl.Solver(max_iterations=2), throw=False
    )
    assert few.status[0] == rl.Status.MAX_ITERATIONS
    assert few.convolutions[0] <= 4


def test_the_factor_of_other_nodes_is_not_taken(searched):
    """Two surfaces in turn, with contacts of as many nodes."""
    mirrored = rl.Surface(np.ascontiguousarray(SURFACE.heights[::-1]), SURFACE.sizes)
    for body in (SURFACE, mirrored, SURFACE):
        curve = rl.press(body, E_star=1.0, forces=[0.05, 0.06])
        assert curve.stiffness[0] == pytest.approx(
            rl.press(SURFACE, E_star=1.0, forces=[0.05]).stiffness[0], rel=1e-9
        )
    assert all(searched)
