"""Bodies that stick, held against dense matrices over histories of depths.

The judge knows the law of pull and the kernel. Under each depth it moves the shares of the pull to
those of the gap until nothing changes, from those of the depth before. At a given depth more pull
closes more gap, so that this leads where slow bodies come.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

import roughline as rl
from halfspace.dense_contact import Body, DenseContact
from random_cases import cases, seeds

RTOL = 1e-9
OFF = 1e-6  # forces and pressures, over the largest of their kind
STIFFNESS = 1e-5  # touching sets are the same, but near a jump they are soft


@pytest.fixture(autouse=True)
def small_matrices_need_one_thread():
    with threadpool_limits(limits=1, user_api="blas"):
        yield


@dataclass(frozen=True)
class Sticking:
    """A contact as dense matrices give it; fields are flat."""

    force: float
    pressure: np.ndarray
    touching: np.ndarray
    pulling: np.ndarray
    stiffness: float


class DenseSticking:
    """Depths one after another."""

    def __init__(self, body, law):
        self.body = body
        self._dense = DenseContact(body)
        self._pull, self._share_at = self.pull_of(law)
        self._share = np.zeros(body.heights.size)

    def pull_of(self, law):
        """The largest pull, and the share of it across gaps."""
        return law.work_of_adhesion / law.range, share_of(self.body, law, self._dense.K)

    def press(self, depth):
        separation, before = self.body.separation, np.inf
        while before > 1e-12:
            low = -self._pull * self._share
            _, pressure = self._dense.at_depth(separation, depth, low, np.inf)
            share = self._share_at(self._dense.K @ pressure + separation - depth)
            before, self._share = np.abs(share - self._share).max(), share
        touching = self._dense.between
        return Sticking(
            force=self.body.cell * float(pressure.sum()),
            pressure=pressure,
            touching=touching,
            pulling=~touching & (pressure < 0),
            stiffness=self._dense.stiffness(touching),
        )


def assert_sticking_is_dense(curve, dense, depths):
    """Compare contacts at depths, with their fields, with those of a dense history."""
    for i, depth in enumerate(depths):
        state, found = dense.press(depth), curve.fields[i]
        scale = np.abs(state.pressure).max()
        assert np.abs(found.pressure.ravel() - state.pressure).max() <= 1e-5 * scale
        np.testing.assert_array_equal(found.contact.ravel(), state.touching)


def share_of(body, law, matrix):
    """The share of the largest pull across a gap, of the nodes of a body."""
    if isinstance(law, rl.Exponential):
        return lambda gap: np.exp(-np.maximum(gap, 0) / law.range)
    ramp = ramps(body, law.work_of_adhesion / law.range, law.range, matrix)
    return lambda gap: np.clip((law.range + ramp - gap) / (2 * ramp), 0, 1)


def ramps(body, pull, cutoff, matrix):
    """Half of the width over which a pull ends that jumps to zero at a cutoff, at each node."""
    # a node's own displacement; even pressure moves a periodic body as its longest wave does
    own = matrix[0, 0]
    if body.periodic:
        own += 2 * max(body.sizes) / (2 * np.pi * body.E_star) / body.heights.size
    half_space = getattr(body, "half_space", None)
    repeats = (body.periodic, body.periodic) if half_space is None else half_space.repeats
    steps = []
    for axis in (0, 1):
        beside = [(0, 0), (0, 0)]
        beside[axis] = (1, 1)
        beyond = {"mode": "wrap"} if repeats[axis] else {"mode": "reflect", "reflect_type": "odd"}
        heights = np.moveaxis(np.pad(body.heights, beside, **beyond), axis, 0)
        steps.append(np.moveaxis(np.abs(heights[2:] - heights[:-2]) / 2, 0, axis).ravel())
    return np.minimum(np.maximum(sum(steps) / 2, 4 * pull * own), cutoff)


def posed(seed, law):
    """A random body with a law of pull, and depths to and fro."""
    rng = np.random.default_rng(seed)
    shape, periodic = tuple(rng.integers(8, 17, 2)), bool(rng.integers(2))
    if rng.random() < 0.8:
        spectrum = rl.SelfAffine(hurst=float(rng.uniform(0.1, 0.95)), rms_height=0.1)
        heights = np.array(spectrum.surface(16, seed).heights[: shape[0], : shape[1]])
    else:
        heights = 0.1 * rng.normal(size=shape)
    body = Body(heights, (1.0, float(rng.uniform(0.5, 2))), 2.0, periodic)
    reach = float(rng.uniform(0.02, 1.0)) * heights.std()
    zone = float(np.exp(rng.uniform(np.log(2), np.log(30))))  # of the pull, in cells
    work = body.E_star * reach**2 / (np.pi * zone * np.sqrt(body.cell))
    deepest = 0.5 * float(body.separation.mean())
    nearer = np.sort(rng.uniform(-2 * reach, deepest, 6))
    apart = np.sort(rng.uniform(-6 * reach - 0.3 * deepest, deepest, 8))[::-1]
    return body, law(work, reach), [*nearer, *apart, deepest / 3, 0.9 * deepest]


def pressed(body, law, **loads):
    half_space = rl.Homogeneous(body.E_star, periodic=body.periodic)
    surface = rl.Surface(body.heights, body.sizes)
    return rl.press(surface, half_space=half_space, law=law, rtol=RTOL, fields=True, **loads)


@pytest.mark.parametrize("law", [rl.Dugdale, rl.Exponential])
@seeds(3, cases(400, share=20))
def test_histories_are_the_dense_solutions(law, seeds):
    both = 0
    for seed in seeds:
        body, of_body, depths = posed(seed, law)
        curve = pressed(body, of_body, depths=depths)
        dense = DenseSticking(body, of_body)
        states = [dense.press(depth) for depth in depths]
        largest = max(np.abs(each.pressure).sum() * body.cell for each in states)
        most = max(np.abs(each.pressure).max() for each in states)
        for i, state in enumerate(states):
            fields = curve.fields[i]
            assert (fields.contact.ravel() == state.touching).all(), (seed, i)
            assert abs(curve.force[i] - state.force) <= OFF * largest, (seed, i)
            assert np.abs(fields.pressure.ravel() - state.pressure).max() <= OFF * most, (seed, i)
            if law is rl.Dugdale:
                differ = fields.pulling.ravel() != state.pulling  # but where the reach just ends
                assert (np.abs(state.pressure[differ]) <= OFF * most).all(), (seed, i)
            assert curve.stiffness[i] == pytest.approx(state.stiffness, rel=STIFFNESS), (seed, i)
        both += sum(each.touching.any() and each.pulling.any() for each in states)
    assert both > 3 * len(seeds)


@pytest.mark.parametrize("law", [rl.Dugdale, rl.Exponential])
@seeds(3, cases(60, share=8))
def test_forces_are_where_depths_have_them(law, seeds):
    """A path of forces passes through contacts that dense depths have."""
    for seed in seeds:
        body, of_body, depths = posed(seed, law)
        largest = float(pressed(body, of_body, depths=[max(depths)]).force[0])
        if largest <= 0:
            continue
        forces = np.array([0.3, 1.0, 0.6, 0.1]) * largest
        curve = pressed(body, of_body, forces=forces)
        dense = DenseSticking(body, of_body)
        # on the way nearer the dense depths rise, so that no jump is left out
        for i, depth in enumerate(curve.depth):
            state = dense.press(depth)
            borne = np.abs(state.pressure).sum() * body.cell
            assert abs(state.force - forces[i]) <= 1e-5 * borne, (seed, i)
            assert (curve.fields[i].contact.ravel() == state.touching).all(), (seed, i)


@pytest.mark.parametrize("seed", [3, 16, 33])
def test_bodies_of_which_one_node_touches_bear_no_load_at_all(seed):
    """Nothing is within reach there, so that nothing pushes and nothing pulls."""
    body, law, depths = posed(seed, rl.Dugdale)
    force = float(np.abs(pressed(body, law, depths=[max(depths)]).force[0]))
    curve = pressed(body, law, forces=[force, 0.3 * force, 0.0])
    assert curve.converged.all()
    one_node = law.work_of_adhesion / law.range * body.cell
    assert abs(curve.force[2]) <= 1e-3 * RTOL * one_node
    nearby = pressed(body, law, forces=[force, 0.3 * force, 1e-6 * force])
    assert nearby.stiffness[2] == pytest.approx(curve.stiffness[2], rel=1e-6)
