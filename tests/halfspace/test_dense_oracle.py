"""An independent solution of small contacts: dense matrices and non-negative least squares.

With K = R^T R the contact problem min 1/2 p K p - p b, p >= 0 is the least-squares problem
min |R p - R^-T b|, p >= 0, which Lawson and Hanson's algorithm solves; it shares nothing with ours
but the kernel, which has judges of its own.
"""

import numpy as np
import pytest
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import brentq, nnls

import roughline as rl
from halfspace.dense_contact import love_matrix
from halfspace.small_bodies import needle, rough

pytestmark = pytest.mark.usefixtures("either_search")

N = 16
SIZES = (1.0, 1.6)
E_STAR = 2.0

FORCE = 3e-6  # three times the certified tolerance
STIFFNESS = 1e-8


BODIES = {
    "H = 0": rough((N, N), 0.0),
    "H = 0.5": rough((N, N), 0.5),
    "H = 1": rough((N, N), 1.0),
    "white noise": 0.1 * np.random.default_rng(2).normal(size=(N, N)),
    "plateaus": np.round(10 * rough((N, N), 0.8)) / 10,
    "needle": needle((N, N), 3.0),
}


def free_matrix():
    return love_matrix((N, N), (SIZES[0] / N, SIZES[1] / N)) / E_STAR


def periodic_matrix():
    q = [2 * np.pi * np.fft.fftfreq(N, s / N) for s in SIZES]
    magnitude = np.hypot(q[0][:, None], q[1])
    magnitude[0, 0] = np.inf
    response = np.fft.ifft2(2 / (E_STAR * magnitude)).real
    i, j = (index.ravel() for index in np.indices((N, N)))
    return response[(i[:, None] - i) % N, (j[:, None] - j) % N]


MATRICES = {"free": free_matrix(), "periodic": periodic_matrix()}


def oracle(boundary, heights, depth):
    """Pressures, force and stiffness at a depth."""
    K = MATRICES[boundary]
    cell_area = SIZES[0] * SIZES[1] / N**2
    separation = (heights.max() - heights).ravel()
    # dropping q = 0 leaves K without its mean: a tiny one makes it definite and changes nothing
    shift = 1e-9 * np.trace(K) / K.size if boundary == "periodic" else 0.0
    R = cholesky(K + shift)
    pressure, _ = nnls(R, solve_triangular(R, depth - separation, trans="T"), maxiter=10**5)
    contact = pressure > 0
    stiffness = (
        cell_area * np.linalg.solve(K[np.ix_(contact, contact)], np.ones(contact.sum())).sum()
    )
    return pressure.reshape(N, N), cell_area * pressure.sum(), stiffness


@pytest.mark.parametrize("boundary", ["free", "periodic"])
@pytest.mark.parametrize("share", [0.05, 0.3, 0.8])
@pytest.mark.parametrize("name", BODIES)
def test_both_controls_give_the_oracles_contact(name, share, boundary):
    heights = BODIES[name]
    depth = share * float(np.mean(heights.max() - heights))
    pressure, force, stiffness = oracle(boundary, heights, depth)
    surface = rl.Surface(heights, SIZES)
    settings = {"E_star": E_STAR, "periodic": boundary == "periodic", "fields": True}
    for loads in ({"depths": [depth]}, {"forces": [force]}):
        curve = rl.press(surface, **settings, **loads)
        assert (curve.fields[0].contact == (pressure > 0)).all()
        assert curve.force[0] == pytest.approx(force, rel=FORCE)
        assert curve.depth[0] == pytest.approx(depth, rel=FORCE)
        assert curve.stiffness[0] == pytest.approx(stiffness, rel=STIFFNESS)
        off = np.abs(curve.fields[0].pressure - pressure).max()
        assert off < 1e-4 * pressure.max()  # a pressure answers a gap with the grid's stiffness


def test_the_oracle_inverts_its_own_depth():
    """Force control of the oracle by root finding, against ours without a search."""
    heights = BODIES["H = 0.5"]
    force = 0.05
    depth = brentq(lambda d: oracle("free", heights, d)[1] - force, 1e-3, 1.0, xtol=1e-13)
    curve = rl.press(rl.Surface(heights, SIZES), E_star=E_STAR, forces=[force])
    assert curve.depth[0] == pytest.approx(depth, rel=FORCE)


def test_a_path_of_loads_ends_where_a_single_load_does():
    for name, heights in BODIES.items():
        surface = rl.Surface(heights, SIZES)
        path = rl.press(surface, E_star=E_STAR, n_loads=9)
        alone = rl.press(surface, E_star=E_STAR, forces=path.force[-1:])
        assert path.area_fraction[-1] == alone.area_fraction[0], name
        assert path.depth[-1] == pytest.approx(alone.depth[0], rel=FORCE)
        assert path.stiffness[-1] == pytest.approx(alone.stiffness[0], rel=STIFFNESS)
