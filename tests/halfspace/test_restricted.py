"""The operator that is restricted to the contact: how much it errs, and that it may err at all."""

import dataclasses

import numpy as np
import pytest
from scipy.linalg import eigh

import roughline as rl
from random_cases import cases
from roughline.computing import fft
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.inverse import cache
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.operators import coarse_grid, convolution
from roughline.halfspace.operators.coarse_grid import CoarseGrid, PaddedGrid, Splines
from roughline.halfspace.operators.convolution import displacement_field
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.restricted import RestrictedOperator, RestrictedOperators
from roughline.halfspace.search.region import Region
from roughline.halfspace.search.turns import Turns


@pytest.fixture(autouse=True)
def _on_small_grids(monkeypatch):
    """Restrict the operator of small grids as well."""
    monkeypatch.setattr(convolution, "FEW_MODES", 0)
    monkeypatch.setattr(cache._cache, "inverses", {})


def contact_nodes(shape, seed, part):
    """Return the highest nodes of a rough surface, in clusters as contact is."""
    n = 2 ** int(np.ceil(np.log2(max(shape))))
    heights = rl.SelfAffine(hurst=0.5, rms_height=1.0).surface(n, seed).heights
    heights = np.asarray(heights)[: shape[0], : shape[1]]
    return np.flatnonzero(heights > np.quantile(heights, 1 - part))


def made(operator, ratios):
    """Split an operator."""
    restricted = ApproximateInverse.of(operator).restricted
    return RestrictedOperator.of(operator, ratios, restricted.margins)


def on(operator, nodes):
    """Return the restricted operator that is chosen for some nodes."""
    return ApproximateInverse.of(operator).restricted.on(nodes)


def matrices(operator, ratios, nodes):
    """Return the exact and the restricted operator as dense matrices."""
    here = GridNodes.of(nodes, operator.shape)
    split = made(operator, ratios)
    units = np.eye(nodes.size)
    return tuple(
        np.stack([each.displacement(unit, here, here) for unit in units])
        for each in (operator, split)
    )


@pytest.mark.parametrize(
    ("shape", "spacing", "ratios", "periodic"),
    [
        ((64, 64), (1.0, 1.0), (2, 2), False),
        ((64, 64), (1.0, 1.0), (4, 4), False),
        ((96, 80), (1.0, 1.0), (8, 8), False),
        ((67, 101), (1.0, 1.3), (4, 4), False),
        ((64, 128), (2.0, 1.0), (2, 4), False),
        ((80, 96), (1.0, 1.0), (8, 8), True),
        ((64, 64), (1.0, 1.0), (4, 4), True),
    ],
)
def test_it_is_the_exact_operator_to_a_fiftieth_for_any_pressure(shape, spacing, ratios, periodic):
    """Each correction of the defect then leaves a fiftieth of the error, in energy."""
    operator = on_grid(Homogeneous(1.0, periodic), shape, spacing)
    exact, split = matrices(operator, ratios, contact_nodes(shape, 3, 0.08))
    assert np.abs(split - split.T).max() <= 1e-5 * np.abs(exact).max()
    if periodic:  # even pressure displaces nothing
        exact, split = (each + operator.spectrum.max() for each in (exact, split))
    factors = eigh((split + split.T) / 2, exact, eigvals_only=True)
    assert np.abs(factors - 1).max() <= 0.02


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("base_young", [1e-3, 1e-2, 0.1, 10.0, np.inf])
@pytest.mark.parametrize(("ratio", "thickness"), [(4, 6.0), (4, 100.0), (2, 3.0), (8, 16.0)])
def test_it_is_as_near_for_layers_that_the_coarse_grid_resolves(
    ratio, thickness, base_young, periodic
):
    """However hard or soft they are: what lies beneath them is smooth on it.

    Free plates far harder than their base are bent by what lies beyond the grid, where its kernel
    ends.
    """
    body = rl.Layered(1.0, 0.3, thickness, base_young, 0.3, periodic)
    operator = on_grid(body, (64, 64), (1.0, 1.0))
    exact, split = matrices(operator, (ratio, ratio), contact_nodes((64, 64), 3, 0.08))
    if operator.mean_is_free:
        exact, split = (each + operator.spectrum.max() for each in (exact, split))
    factors = eigh((split + split.T) / 2, exact, eigvals_only=True)
    plates = {} if periodic else {1e-3: 0.3, 1e-2: 0.06}
    assert np.abs(factors - 1).max() <= plates.get(base_young, 0.03)


def test_coarse_grids_that_resolve_a_layer_are_preferred():
    """Of a layer that none resolves, any does, and errs more."""
    for thickness, ratios in ((100.0, (8, 8)), (6.0, (4, 4)), (3.0, (2, 2)), (0.6, (8, 8))):
        operator = on_grid(rl.Layered(1.0, 0.3, thickness, 0.1), (64, 64), (1.0, 1.0))
        nodes = GridNodes.of(np.arange(20), (64, 64))
        assert on(operator, nodes).far.convolution.spacing == ratios


@pytest.mark.parametrize("periodic", [False, True])
def test_coarse_grids_that_threads_share_give_the_same(monkeypatch, periodic):
    operator = on_grid(Homogeneous(1.0, periodic), (96, 64), (1.0, 1.0))
    nodes = GridNodes.of(contact_nodes((96, 64), 3, 0.3), (96, 64))
    pressure = np.random.default_rng(1).random(nodes.indices.size)
    split = made(operator, (2, 2))
    alone = split.displacement(pressure, nodes, nodes)
    monkeypatch.setattr(coarse_grid, "_ONE_THREAD_MODES", 0)
    shared = split.displacement(pressure, nodes, nodes)
    assert np.abs(shared - alone).max() <= 1e-5 * np.abs(alone).max()


def test_its_memory_is_clean_after_use():
    operator = on_grid(Homogeneous(1.0, True), (64, 64), (1.0, 1.0))
    nodes = GridNodes.of(contact_nodes((64, 64), 1, 0.3), (64, 64))
    split = made(operator, (4, 4))
    first = split.displacement(np.ones(nodes.indices.size), nodes, nodes)
    assert not PaddedGrid.of(split.shape, split.margins, operator.workspace).values.any()
    again = split.displacement(np.ones(nodes.indices.size), nodes, nodes)
    np.testing.assert_array_equal(first, again)


@pytest.mark.parametrize("unit", [1e-300, 1e-30, 1.0, 1e30])
def test_units_do_not_matter(unit):
    operator = on_grid(Homogeneous(1.0), (64, 64), (1.0, 1.0))
    nodes = GridNodes.of(contact_nodes((64, 64), 1, 0.3), (64, 64))
    split = on(operator, nodes)
    pressure = np.random.default_rng(0).random(nodes.indices.size)
    expected = unit * split.displacement(pressure, nodes, nodes)
    moved = split.displacement(unit * pressure, nodes, nodes)
    np.testing.assert_allclose(moved, expected, rtol=1e-5)


@pytest.mark.skipif(fft.threads() < 2, reason="needs two cores")
def test_its_bits_do_not_depend_on_the_number_of_threads():
    operator = on_grid(Homogeneous(1.0), (256, 200), (1.0, 1.0))
    nodes = GridNodes.of(contact_nodes((256, 200), 1, 0.3), (256, 200))
    split = on(operator, nodes)
    pressure = np.random.default_rng(0).random(nodes.indices.size)
    many = split.displacement(pressure, nodes, nodes)
    count = fft.threads()
    fft.set_threads(1)
    try:
        one = split.displacement(pressure, nodes, nodes)
    finally:
        fft.set_threads(count)
    np.testing.assert_array_equal(many, one)


@pytest.mark.parametrize(
    ("shape", "spacing", "periodic"),
    [
        ((1, 512), (1.0, 1.0), False),
        ((2, 2), (1.0, 1.0), False),
        ((40, 400), (1.0, 1.0), False),
        ((128, 128), (1.0, 40.0), False),
        ((97, 101), (1.0, 1.0), True),
    ],
    ids=["line", "two points", "strip", "oblong cells", "primes"],
)
def test_where_no_coarse_grid_exists_there_is_none(shape, spacing, periodic):
    operator = on_grid(Homogeneous(1.0, periodic), shape, spacing)
    nodes = GridNodes.of(np.arange(1), shape)
    assert on(operator, nodes) is None


def heights(n=96):
    return rl.SelfAffine(hurst=0.6, rms_height=1.0).surface(n, 5)


def test_without_it_the_results_are_the_same(monkeypatch):
    surface, forces = heights(), [0.02, 0.3, 2.0]
    by_both = rl.press(surface, E_star=1.0, forces=forces, fields=True)
    monkeypatch.setattr(RestrictedOperators, "on", lambda self, nodes: None)
    exact = rl.press(surface, E_star=1.0, forces=forces, fields=True)
    assert by_both.convolutions.sum() < 0.5 * exact.convolutions.sum()
    np.testing.assert_allclose(by_both.depth, exact.depth, rtol=3e-6)
    np.testing.assert_allclose(by_both.stiffness, exact.stiffness, rtol=1e-6)
    for one, other in zip(by_both.fields, exact.fields, strict=True):
        largest = other.pressure.max()
        np.testing.assert_allclose(one.pressure, other.pressure, atol=1e-4 * largest)


def damaged(name):
    """Return a way to damage the restricted operator."""
    sound = RestrictedOperator.of

    def of(operator, ratios, *others):
        whole = sound(operator, ratios, *others)
        if name == "no near part":
            return dataclasses.replace(whole, taps=0 * whole.taps)
        if name == "near part too strong":
            return dataclasses.replace(whole, taps=2 * whole.taps)
        if name == "near part of the wrong sign":
            return dataclasses.replace(whole, taps=-whole.taps)
        if name == "far part too weak":
            convolution = whole.far.convolution
            weak = dataclasses.replace(convolution, spectrum=0.5 * convolution.spectrum)
            far = dataclasses.replace(whole.far, convolution=weak)
            return dataclasses.replace(whole, far=far)
        if name == "weights of another place":
            rolled = tuple(np.roll(each, 1, axis=0) for each in whole.far.splines.weights)
            splines = dataclasses.replace(whole.far.splines, weights=rolled)
            return dataclasses.replace(whole, far=dataclasses.replace(whole.far, splines=splines))
        assert name == "not a number"
        return dataclasses.replace(whole, taps=np.nan * whole.taps)

    return of


@pytest.mark.parametrize(
    "damage",
    [
        "no near part",
        "near part too strong",
        "near part of the wrong sign",
        "far part too weak",
        "weights of another place",
        "not a number",
        "stale coarse grid",
    ],
)
@pytest.mark.parametrize("control", ["forces", "depths"])
@pytest.mark.usefixtures("nothing_kept")
def test_a_damaged_one_costs_time_and_never_a_wrong_result(monkeypatch, damage, control):
    surface = heights()
    sound = rl.press(surface, E_star=1.0, forces=[0.02, 0.3, 2.0])
    loads = {control: getattr(sound, control.removesuffix("s"))}
    cache._cache.clear()
    if damage == "stale coarse grid":
        monkeypatch.setattr(CoarseGrid, "_convolved", lambda self, pressure, out: out)
    else:
        monkeypatch.setattr(RestrictedOperator, "of", damaged(damage))
    curve = rl.press(surface, E_star=1.0, throw=False, **loads)
    assert curve.residual[curve.converged].max(initial=0) <= 1e-6
    for name in ("depth", "force", "stiffness"):
        found, expected = (getattr(each, name)[curve.converged] for each in (curve, sound))
        np.testing.assert_allclose(found, expected, rtol=1e-5)
    assert curve.converged.all()


def test_a_turn_that_does_not_help_is_not_repeated(monkeypatch):
    """A search near the contact that finds nothing is left to the exact operator."""
    monkeypatch.setattr(Turns, "_refine", lambda self: None)
    curve = rl.press(heights(), E_star=1.0, forces=[0.3])
    assert curve.converged.all()


def test_later_searches_look_beside_the_contact_too(monkeypatch):
    """A node that leaves by an error of the restricted operator comes back before the certificate.

    The corrected search looks at nodes of which most are in contact: its share of the grid counts.
    """
    looked_at = []

    def recorded(region, trial, reach):
        found = near(region, trial, reach)
        if region.problem.operator.shape == (256, 256):
            looked_at.append((found[0].separation.size, found[1].places.size))
        return found

    near = Region.near
    monkeypatch.setattr(Region, "near", recorded)
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(256, 7)
    curve = rl.press(surface, E_star=1.0, forces=[1.2])
    (_, first), (sites, contact) = looked_at[:2]
    assert contact > 0.8 * first  # of which most are in contact
    assert contact < sites < 1.1 * contact
    assert curve.converged.all()


@pytest.mark.parametrize("shape", [(19, 19), (35, 131), (67, 12), (16, 24), (21, 15)])
@pytest.mark.parametrize("periodic", [False, True])
def test_whole_fields_on_small_grids_are_displaced_as_others(shape, periodic):
    operator = on_grid(Homogeneous(2.0, periodic), shape, (1.0, 0.7))
    none = np.empty((1, 4), dtype=np.float32)
    splines = Splines(shape, (none, none), (periodic, periodic), operator.workspace)
    small = CoarseGrid(operator, splines)
    rng = np.random.default_rng(3)
    for _ in range(2):
        pressure = rng.normal(size=shape).astype(np.float32)
        found = small._convolved(pressure, np.empty_like(pressure))
        expected = displacement_field(operator, pressure.astype(float))
        np.testing.assert_allclose(found, expected, atol=1e-6 * np.abs(expected).max())


def test_the_coarse_grid_is_chosen_by_what_is_in_contact():
    operator = on_grid(Homogeneous(1.0), (256, 256), (1.0, 1.0))
    shapes = [
        on(operator, GridNodes.of(contact_nodes((256, 256), 1, part), (256, 256)))
        for part in (0.001, 0.1, 0.5, 1.0)
    ]
    sides = [None if each is None else each.far.splines.weights[0].shape[0] for each in shapes]
    assert sides == [8, 4, 2, None]


@pytest.mark.parametrize("hardness", [None, 30.0, 3.0])
def test_searches_that_begin_where_bodies_can_touch_end_as_others(hardness, monkeypatch):
    """Under forces and depths that rise and fall, on bodies that are elastic and that yield."""
    begun = []
    possible = Region.possible.__func__

    def recorded(cls, *arguments):
        found = possible(cls, *arguments)
        begun.append(np.isfinite(found.reach))
        return found

    monkeypatch.setattr(Region, "possible", classmethod(recorded))
    rng = np.random.default_rng(16)
    surfaces = cases(8, share=2)
    for seed in range(surfaces):
        n, hurst = int(rng.integers(96, 200)), rng.uniform(0.1, 0.9)
        whole = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(n, seed)
        surface = rl.Surface(whole.heights[: n - 16], ((n - 16) / n, 1.0))
        loads = {
            "forces": 10 ** rng.uniform(-2.5, 0, 4),
            "depths": 10 ** rng.uniform(-1, 0.3, 4),
        }
        for control, values in loads.items():
            given = {"E_star": 1.0, "hardness": hardness, control: values}
            usual = rl.press(surface, **given)
            with pytest.MonkeyPatch.context() as patch:
                whole_grid = lambda cls, problem, *others: cls.everywhere(problem)  # noqa: E731
                patch.setattr(Region, "possible", classmethod(whole_grid))
                near = rl.press(surface, **given)
            assert usual.converged.all()
            assert near.converged.all()
            for name in ("force", "depth", "stiffness"):
                assert getattr(near, name) == pytest.approx(getattr(usual, name), rel=1e-4)
    assert np.count_nonzero(begun) > 3.75 * surfaces


def test_light_loads_need_no_gap_on_the_whole_grid(monkeypatch):
    wholes = []
    displacement = convolution.Convolution.displacement

    def counted(self, pressure, sources, targets=None, *others, **named):
        if self.shape == (512, 512) and targets is None:
            wholes.append(named.get("precision", others[0] if others else "float64"))
        return displacement(self, pressure, sources, targets, *others, **named)

    monkeypatch.setattr(convolution.Convolution, "displacement", counted)
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(512, 7)
    assert rl.press(surface, E_star=1.0, forces=[0.03]).converged.all()
    assert wholes == []
