"""Depths just below that of full contact, on periodic bodies: every load ends certified.

Displacements have no mean there, so at a given depth the gaps sum to the same whatever the
pressures. Where few nodes are open, they take up what changes on all others, and this is far more
than any error on the contact: a node that was wide open overlaps after one round of the search.
"""

import numpy as np
import pytest

import roughline as rl
from halfspace.dense_hardness import Body
from random_cases import cases, seeds

pytestmark = pytest.mark.usefixtures("either_search")

BODIES = cases(84, share=4)  # for each precision, under four loads each: of 1,008 in all
BELOW = 10.0 ** np.array([-6, -1])  # of the depths below that of full contact, over it
MANY = 1000  # convolutions; the loads take 400 at most, and thousands where nodes go one by one
RTOL = {"mixed": 1e-6, "float64": 1e-6, "float32": 1e-4}
MOST = 600  # nodes that are solved with dense matrices as well
STIFFNESS = 1e-6


def near_full_contact(seed):
    """Draw a surface, a modulus and depths."""
    rng = np.random.default_rng([5, seed])
    shape = np.exp(rng.uniform(np.log(8), np.log(100), 2)).astype(int)
    if seed % 2:
        spectrum = rl.SelfAffine(hurst=rng.uniform(0.2, 0.9), rms_height=1.0)
        heights = spectrum.surface(int(shape[0]), seed).heights
    else:
        heights = rng.normal(size=shape)
        heights = (heights, np.abs(heights), np.tanh(heights) ** 3)[rng.integers(3)]
    heights = 10 ** rng.uniform(-9, 6) * heights
    sizes = 10 ** rng.uniform(-6, 3) * np.array(heights.shape) * 10 ** rng.uniform(-0.4, 0.4, 2)
    below = np.exp(rng.uniform(*np.log(BELOW), 4))
    depths = np.mean(heights.max() - heights) * (1 - below)
    return rl.Surface(heights, sizes), 10 ** rng.uniform(-3, 11), depths


def exact(surface, E_star, depth, contact):
    """Force and stiffness of a set of nodes, after holding it against its bounds."""
    matrix = Body(surface.heights, surface.sizes, E_star, periodic=True).matrix()
    above = depth - (surface.heights.max() - surface.heights).ravel()
    targets = np.stack([above[contact], np.ones(contact.sum())], axis=1)
    pressure, follows = np.linalg.solve(matrix[np.ix_(contact, contact)], targets).T
    gap = matrix[:, contact] @ pressure - above
    assert (pressure > 0).all()
    assert (gap[~contact] > 0).all()
    cell = surface.area / above.size
    return cell * pressure.sum(), cell * follows.sum()


@pytest.mark.parametrize("precision", RTOL)
@seeds(4, BODIES)
def test_depths_near_full_contact_are_certified(precision, seeds):
    for seed in seeds:
        surface, E_star, depths = near_full_contact(seed)
        small = surface.heights.size <= MOST
        for depth in depths:  # one at a time: none starts from the one before
            curve = rl.press(
                surface,
                E_star=E_star,
                depths=[depth],
                periodic=True,
                rtol=RTOL[precision],
                solver=rl.Solver(max_iterations=MANY, precision=precision),
                fields=small,
                throw=False,
            )
            assert curve.converged.all(), f"body {seed} at {depth}"
            assert np.isfinite(curve.stiffness).all()
            if small and precision != "float32":  # whose tolerance does not tell all sets apart
                contact = curve.fields[0].contact.ravel()
                force, stiffness = exact(surface, E_star, depth, contact)
                # few open nodes make the contact stiff, and the tolerance is that of a gap
                most = RTOL[precision] * stiffness * curve.fields[0].gap.max()
                assert curve.force[0] == pytest.approx(force, rel=1e-12, abs=most)
                assert curve.stiffness[0] == pytest.approx(stiffness, rel=STIFFNESS)


@pytest.mark.parametrize("seed", range(4))
def test_a_hardness_that_no_node_reaches_takes_no_convolutions(seed):
    """Coarser grids, whose last rows stand for fewer nodes, foresee no yield at the same depth."""
    heights = np.random.default_rng(seed).normal(size=(9, 127))
    surface = rl.Surface(heights, heights.shape)
    depths = [(1 - 1e-5) * np.mean(heights.max() - heights)]
    elastic = rl.press(surface, E_star=1.0, depths=depths, periodic=True)
    never = 10 * elastic.force[0] / surface.area
    hard = rl.press(surface, E_star=1.0, depths=depths, periodic=True, hardness=never)
    assert hard.plastic_fraction[0] == 0
    assert hard.convolutions[0] == elastic.convolutions[0]
