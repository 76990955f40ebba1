"""States along random paths, against a solution of all cells node by node."""

import numpy as np
import pytest

import roughline as rl
from halfspace.friction.dense_friction import DensePath, dense_matrix

SAME = 3e-9  # of the largest pressure, at a tolerance of 1e-10
TIGHT = {"rtol": 1e-10, "solver": rl.Solver(precision="float64")}
ONE_SIDED = 2 / 7


def random_case(seed, shape, spacing, *, periodic):
    """Return a rough surface, and depths and slides of a path that turns and comes back."""
    rng = np.random.default_rng(seed)
    sizes = shape[0] * spacing[0], shape[1] * spacing[1]
    surface = rl.Surface(0.1 * rng.normal(size=shape), sizes=sizes)
    separation = surface.heights.max() - surface.heights
    deep = 0.5 * separation.mean() if periodic else np.quantile(separation, 0.3)
    depths = deep * np.array([0.6, 1.0, 1.0, 1.1, 0.7, 1.2])
    slides = 0.15 * deep * rng.normal(size=(6, 2))
    return surface, separation, depths, slides


@pytest.mark.parametrize(
    ("seed", "shape", "spacing", "periodic", "beta"),
    [
        (0, (6, 6), (1.0, 1.0), False, 0.0),
        (1, (8, 9), (1.0, 0.7), False, 0.0),
        (2, (8, 8), (0.6, 1.0), True, 0.0),
        (1, (9, 7), (1.0, 1.0), True, ONE_SIDED),
        (2, (8, 7), (0.6, 1.0), False, ONE_SIDED),
        (3, (6, 6), (1.0, 1.0), False, -ONE_SIDED),
        (4, (8, 9), (1.0, 0.7), True, 0.5),
        (5, (7, 8), (1.0, 1.0), False, 0.5),
    ],
)
def test_every_state_of_a_path_is_that_of_brute_force(seed, shape, spacing, periodic, beta):
    surface, separation, depths, slides = random_case(seed, shape, spacing, periodic=periodic)
    poisson = (0.0, 0.3, 0.5)[seed % 3] if beta == 0 else 0.3
    n, mu = poisson / (1 - poisson), (0.1, 0.3, 0.5)[seed % 3]
    body = rl.Homogeneous(1.0, periodic, poisson=poisson, beta=beta)
    friction = rl.Friction(mu)
    curve = rl.press(
        surface,
        half_space=body,
        friction=friction,
        depths=depths,
        slides=slides,
        fields=True,
        **TIGHT,
    )
    matrix = dense_matrix(shape, spacing, n=n, beta=beta, periodic=periodic)
    path = DensePath(matrix, separation, mu)
    for depth, slide, fields in zip(depths, slides, curve.fields, strict=True):
        expected, cell = path.to(depth, slide), spacing[0] * spacing[1]
        scale = expected.traction[2].max()
        pressure, shear = fields.pressure.ravel(), fields.shear.reshape(-1, 2).T
        assert pressure == pytest.approx(expected.traction[2], abs=SAME * scale)
        assert shear == pytest.approx(expected.traction[:2], abs=SAME * scale)
        load = int(np.flatnonzero(depths == depth)[0])
        total = cell * expected.traction[:2].sum(axis=1)
        if (depths == depth).sum() == 1:
            assert curve.shear_force[load] == pytest.approx(total, abs=1e-8 * cell * scale)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("beta", [0.0, ONE_SIDED])
def test_forces_lead_through_the_states_of_depths_and_slides(periodic, beta):
    surface, _, depths, slides = random_case(5, (9, 8), (1.0, 0.7), periodic=periodic)
    given = {
        "half_space": rl.Homogeneous(1.0, periodic, poisson=0.3, beta=beta),
        "friction": rl.Friction(0.4),
        **TIGHT,
    }
    told = rl.press(surface, depths=depths, slides=slides, **given)
    held = np.hypot(*told.shear_force.T) < 0.999 * told.shear_limit
    assert held.all()
    found = rl.press(surface, forces=told.force, shear_forces=told.shear_force, **given)
    assert found.slide == pytest.approx(slides, abs=1e-7 * depths.max())
    assert found.depth == pytest.approx(depths, rel=1e-7)


def test_friction_may_differ_from_point_to_point_and_have_a_strength():
    surface, separation, depths, slides = random_case(7, (8, 8), (1.0, 1.0), periodic=False)
    rng = np.random.default_rng(8)
    mu, strength = rng.uniform(0.1, 0.9, (8, 8)), rng.uniform(0.01, 0.05, (8, 8))
    curve = rl.press(
        surface,
        half_space=rl.Homogeneous(1.0, poisson=0.3),
        friction=rl.Friction(mu, strength),
        depths=depths,
        slides=slides,
        fields=True,
        **TIGHT,
    )
    matrix = dense_matrix((8, 8), (1.0, 1.0), n=3 / 7, beta=0.0, periodic=False)
    path = DensePath(matrix, separation, mu, strength)
    for depth, slide, fields in zip(depths, slides, curve.fields, strict=True):
        expected = path.to(depth, slide).traction
        found = fields.shear.reshape(-1, 2).T
        assert found == pytest.approx(expected[:2], abs=SAME * expected[2].max())


@pytest.mark.parametrize(
    ("seed", "shape", "spacing", "periodic", "share"),
    [
        (11, (8, 9), (1.0, 0.7), False, 0.7),
        (12, (8, 8), (0.6, 1.0), True, 0.7),
        (13, (7, 8), (1.0, 1.0), False, 0.4),
        (14, (8, 7), (1.0, 1.0), True, 0.4),
    ],
)
@pytest.mark.parametrize("beta", [0.0, ONE_SIDED, -0.5])
def test_bodies_that_yield_follow_brute_force(seed, shape, spacing, periodic, share, beta):
    """The hardness is some share of the largest elastic pressure; dents are those of all loads."""
    surface, separation, depths, slides = random_case(seed, shape, spacing, periodic=periodic)
    body = rl.Homogeneous(1.0, periodic, poisson=0.3, beta=beta)
    elastic = rl.press(surface, half_space=body, depths=depths).largest_pressure
    hardness = share * elastic.max()
    curve = rl.press(
        surface,
        half_space=body,
        hardness=hardness,
        friction=rl.Friction(0.3),
        depths=depths,
        slides=slides,
        fields=True,
        **TIGHT,
    )
    assert (curve.plastic_fraction > 0).sum() > 1
    matrix = dense_matrix(shape, spacing, n=3 / 7, beta=beta, periodic=periodic)
    path = DensePath(matrix, separation, 0.3, hardness=hardness)
    loads = zip(depths, slides, curve.fields, curve.dents, strict=True)
    for depth, slide, fields, dents in loads:
        expected = path.to(depth, slide).traction
        found = fields.shear.reshape(-1, 2).T
        assert fields.pressure.ravel() == pytest.approx(expected[2], abs=SAME * hardness)
        assert found == pytest.approx(expected[:2], abs=SAME * hardness)
        deep = np.zeros(separation.size)
        if dents is not None:
            deep[dents.nodes] = dents.depth
        assert deep == pytest.approx(path.separation - separation.ravel(), abs=1e-8 * depths.max())
