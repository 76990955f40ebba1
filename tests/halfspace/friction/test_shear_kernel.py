"""The kernels of shear and of coupling against high precision, and their operator against sums."""

import mpmath
import numpy as np
import pytest

import roughline as rl
from halfspace.friction.dense_friction import dense_matrix
from roughline.halfspace.elasticity.shear_kernel import across_shear, along_shear, by_pressure
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.shear import shear_on_grid

KERNEL = 1e-15  # of the self term
OPERATOR = 1e-14  # of displacements of the order of one, by some hundred cells


def to_40_digits(kind, x, y, dx, dy):
    with mpmath.workdps(40):
        x, y, dx, dy = map(mpmath.mpf, (x, y, dx, dy))

        def corner(a, b):
            r = mpmath.sqrt(a * a + b * b)
            if kind is along_shear:
                return b * mpmath.asinh(a / abs(b))
            if kind is across_shear:
                return -r
            return b * mpmath.log(r) + a * mpmath.atan(b / a)

        right, left, top, bottom = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
        total = corner(right, top) - corner(left, top) - corner(right, bottom)
        return float((total + corner(left, bottom)) / mpmath.pi)


@pytest.mark.parametrize("kind", [along_shear, across_shear, by_pressure])
@pytest.mark.parametrize(("dx", "dy"), [(1.0, 1.0), (1.0, 0.7), (0.1, 1.0), (1e-6, 3e-6)])
def test_the_kernels_are_exact_from_0_to_16384_cells(kind, dx, dy):
    rng = np.random.default_rng(0)
    near = [(i, j) for i in range(3) for j in range(3)]
    far = (2 ** rng.uniform(0, 14, size=(12, 2))).astype(int).tolist()
    edges = [
        (15, 0),
        (16, 0),
        (17, 0),
        (63, 3),
        (64, 3),
        (799, 5),
        (801, 5),
        (0, 16384),
        (16384, 1),
    ]
    own = along_shear([0], [0], dx, dy)[0, 0]
    for i, j in [*near, *far, *edges]:
        expected = to_40_digits(kind, i * dx, j * dy, dx, dy)
        assert abs(kind([i], [j], dx, dy)[0, 0] - expected) <= KERNEL * own


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize(
    ("shape", "spacing"), [((8, 10), (1.0, 0.7)), ((7, 9), (0.6, 1.0)), ((12, 5), (1.0, 1.0))]
)
def test_the_operator_is_the_sum_over_all_cells(shape, spacing, periodic):
    body = rl.Homogeneous(2.0, periodic, poisson=0.3, beta=0.2)
    matrix = dense_matrix(shape, spacing, n=3 / 7, beta=0.2, periodic=periodic, E_star=2.0)
    assert abs(matrix - matrix.T).max() < 1e-15  # energy is symmetric
    least = float(np.linalg.eigvalsh(matrix).min())
    assert least > (-OPERATOR if periodic else 0.1)
    operator, count = shear_on_grid(body, shape, spacing), shape[0] * shape[1]
    rng = np.random.default_rng(1)
    sources, targets = (np.sort(rng.choice(count, count // k, replace=False)) for k in (2, 3))
    listed = GridNodes.of(sources, shape), GridNodes.of(targets, shape)
    tractions = np.zeros((3, count))
    tractions[:2, sources] = rng.normal(size=(2, sources.size))
    moved = (matrix @ tractions.ravel()).reshape(3, count)[:, targets]
    shear = np.ascontiguousarray(tractions[:2, sources].T)
    assert operator.displacement(shear, *listed) == pytest.approx(moved[:2].T, abs=OPERATOR)
    assert operator.into_body(shear, *listed) == pytest.approx(moved[2], abs=OPERATOR)
    pressed = np.zeros((3, count))
    pressed[2, sources] = shear[:, 0]
    moved = (matrix @ pressed.ravel()).reshape(3, count)[:2, targets]
    assert operator.by_pressure(shear[:, 0], *listed) == pytest.approx(moved.T, abs=OPERATOR)
    assert operator.diagonal == pytest.approx((matrix[0, 0] + matrix[count, count]) / 2, rel=1e-13)


def test_single_precision_serves_for_steps():
    body, rng = rl.Homogeneous(1.0, poisson=0.3), np.random.default_rng(2)
    operator = shear_on_grid(body, (40, 30), (1.0, 1.0))
    nodes = GridNodes.of(np.arange(1200), (40, 30))
    shear = rng.normal(size=(1200, 2))
    exact = operator.displacement(shear, nodes, nodes)
    rough = operator.displacement(shear, nodes, nodes, "float32")
    assert 0 < abs(rough - exact).max() < 1e-6 * abs(exact).max()


def test_two_equal_bodies_are_not_coupled_and_two_others_are():
    steel = rl.Homogeneous.of(2.0, 0.3)
    assert steel.is_coupled
    assert steel.beta == pytest.approx(2 / 7)
    assert not (steel + steel).is_coupled
    rubber = rl.Homogeneous.of(0.1, 0.5)
    assert not rubber.is_coupled
    pair, q = steel + rubber, np.array([0.5, 3.0])
    along, across = pair.shear_spectrum(q)
    n = (0.3 / (2 / 2.6) + 0.5 / (0.1 / 3)) / (0.7 / (2 / 2.6) + 0.5 / (0.1 / 3))
    assert along == pytest.approx(pair.spectrum(q))
    assert across == pytest.approx((1 + n) * along)
    beta = 0.5 * (0.4 / (2 / 2.6)) / (0.7 / (2 / 2.6) + 0.5 / (0.1 / 3))
    assert pair.coupling_spectrum(q) == pytest.approx(beta * along)
    assert (rubber + steel).coupling_spectrum(q) == pytest.approx(-beta * along)
