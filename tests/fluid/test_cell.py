"""What repeats along the flow has no ends: the same wherever it is cut, and exact solutions."""

from fractions import Fraction

import numpy as np
import pytest

import roughline as rl
from roughline.fluid.winding import windings

KINDS = ("closed in places", "throats", "any")


def torus(number, largest=5):
    """A small gap that repeats, of one of three kinds, by its number."""
    rng = np.random.default_rng([67, number])
    shape = rng.integers(2, largest + 1, 2)
    gap = rng.integers(1, 9, shape).astype(float)
    kind = KINDS[number % len(KINDS)]
    if kind != "any":
        gap[rng.random(shape) < 0.35] = 0
    if kind == "throats":
        gap *= 2.0 ** -rng.integers(0, 30, shape)
    return gap


def exact(gap):
    """Tensor of a gap on square cells, in fractions, by Gauss's elimination."""
    nx, ny = gap.shape
    k = [[Fraction(float(each)) ** 3 for each in row] for row in gap]
    edges = []
    for i in range(nx):
        for j in range(ny):
            for a, b, period in (
                ((i + 1) % nx, j, (int(i + 1 == nx), 0)),
                (i, (j + 1) % ny, (0, int(j + 1 == ny))),
            ):
                if k[i][j] and k[a][b]:
                    g = 2 * k[i][j] * k[a][b] / (k[i][j] + k[a][b])
                    edges.append((i * ny + j, a * ny + b, g, period))
    size = nx * ny
    matrix = [[Fraction(0)] * (size + 2) for _ in range(size)]
    for a, b, g, period in edges:
        for here, there, sign in ((a, b, -1), (b, a, 1)):
            matrix[here][here] += g
            matrix[here][there] -= g
            for axis in (0, 1):
                matrix[here][size + axis] += sign * g * period[axis]
    for pivot in range(size):  # one cell of each part is left, whose row is empty by then
        row = matrix[pivot]
        if row[pivot] == 0:
            continue
        for other in range(pivot + 1, size):
            factor = matrix[other][pivot] / row[pivot]
            if factor:
                matrix[other] = [x - factor * y for x, y in zip(matrix[other], row, strict=True)]
    pressure = [[Fraction(0)] * 2 for _ in range(size)]
    for i in reversed(range(size)):
        row = matrix[i]
        if row[i]:
            for axis in (0, 1):
                rest = sum(row[j] * pressure[j][axis] for j in range(i + 1, size))
                pressure[i][axis] = (row[size + axis] - rest) / row[i]
    tensor = [[Fraction(0)] * 2 for _ in range(2)]
    for a, b, g, period in edges:
        falls = [pressure[a][axis] - pressure[b][axis] + period[axis] for axis in (0, 1)]
        for first in (0, 1):
            for second in (0, 1):
                tensor[first][second] += g * falls[first] * falls[second]
    ratio = Fraction(nx, ny)
    scale = [[ratio, 1], [1, 1 / ratio]]
    return np.array([[float(tensor[a][b] * scale[a][b]) for b in (0, 1)] for a in (0, 1)])


def of(gap, **given):
    return rl.flow(gap, sizes=tuple(map(float, gap.shape)), **given)


@pytest.mark.parametrize("numbers", [range(30), range(30, 3000)])
def test_small_tori_are_the_exact_solutions(numbers):
    for number in numbers:
        gap = torus(number)
        flow, expected = of(gap), exact(gap)
        scale = np.sqrt(np.outer(expected.diagonal(), expected.diagonal()))
        assert ((flow.tensor == 0) | (scale > 0)).all(), number
        assert abs(flow.tensor - expected).max() <= 1e-12 * expected.max(), number
        relative = abs(flow.tensor.diagonal() - expected.diagonal())
        assert (relative <= 1e-11 * expected.diagonal()).all(), number
        assert flow.converged, number


MOVES = {
    "rolled": (lambda a: np.roll(a, (5, 17), (0, 1)), np.eye(2)),
    "mirrored": (lambda a: a[::-1], np.diag([-1, 1])),
    "exchanged": (lambda a: a.T, np.eye(2)[::-1]),
}


@pytest.fixture(scope="module")
def contact():
    """The gap of a contact at a quarter of its area, whose pressure falls through few channels."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, q_high=200.0)
    surface = spectrum.surface(64, rng=3)
    curve = rl.press(surface, E_star=1.0, forces=[0.05], periodic=True, fields=True)
    return np.where(curve.fields[0].contact, 0.0, curve.fields[0].gap)


@pytest.mark.parametrize("move", MOVES)
def test_where_the_map_is_cut_and_how_it_is_turned_is_all_the_same(contact, move):
    moved, turn = MOVES[move]
    gap = contact[:, :48]  # as if it repeated there
    sizes = {"exchanged": (1.0, 2.0)}.get(move, (2.0, 1.0))
    before = rl.flow(gap, sizes=(2.0, 1.0)).tensor
    after = rl.flow(moved(gap), sizes=sizes).tensor
    assert after == pytest.approx(turn @ before @ turn.T, rel=1e-9, abs=1e-12 * before.max())


@pytest.mark.parametrize("times", [(2, 1), (1, 2), (2, 2), (4, 4)])
def test_repeated_by_hand_it_lets_as_much_through(contact, times):
    whole = rl.flow(np.tile(contact, times), sizes=tuple(map(float, times)))
    once = rl.flow(contact, sizes=(1.0, 1.0))
    assert whole.tensor == pytest.approx(once.tensor, rel=1e-9)


def test_through_each_row_of_faces_flows_as_much_as_is_lost(contact):
    for flow in rl.flow(contact, sizes=(1.0, 1.0), along="both"):
        rows = flow.rates_x.sum(axis=1) if flow.along == "x" else flow.rates_y.sum(axis=0)
        assert rows == pytest.approx(np.full(65, flow.inflow), rel=1e-9)
        assert flow.dissipation == pytest.approx(flow.inflow, rel=1e-9)
        net = np.diff(flow.rates_x, axis=0) + np.diff(flow.rates_y, axis=1)
        assert abs(net).max() <= 1e-9 * flow.inflow


def test_pressures_fall_by_one_each_period(contact):
    flow = rl.flow(contact, sizes=(1.0, 1.0))
    pressure = np.concatenate([flow.pressure[-1:] + 1, flow.pressure, flow.pressure[:1] - 1])
    flows = flow.rates_x != 0
    falls = (pressure[:-1] - pressure[1:])[flows] * flow.conductances_x[flows]
    assert falls == pytest.approx(flow.rates_x[flows], rel=1e-6, abs=1e-9 * flow.inflow)
    assert np.nanmean(flow.pressure) == pytest.approx(0.5, abs=0.05)


def test_ends_let_too_much_through_and_closed_sides_too_little(contact):
    cell = rl.flow(contact, sizes=(1.0, 1.0)).permeance
    ends = rl.flow(contact, sizes=(1.0, 1.0), sides="y").permeance
    strip = rl.flow(contact, sizes=(1.0, 1.0), sides="x").permeance
    assert strip <= cell <= ends
    assert ends > 1.02 * cell


def test_the_cell_lies_between_the_means_of_rows_and_of_columns(contact):
    cubes = np.maximum(contact, 1e-4) ** 3
    tensor = rl.flow(np.cbrt(cubes), sizes=(1.0, 1.0)).tensor
    least = 1 / np.mean(1 / cubes)
    assert (np.linalg.eigvalsh(tensor) >= least).all()
    assert (np.linalg.eigvalsh(tensor) <= np.mean(cubes)).all()


def test_duality_of_the_cell():
    """Keller: the tensor of one over the cube is the inverse, turned by a right angle."""
    errors = []
    turn = np.array([[0, -1], [1, 0]])
    for n in (16, 32, 64):
        x = (np.arange(n) + 0.5) / n
        x, y = np.meshgrid(2 * np.pi * x, 2 * np.pi * x, indexing="ij")
        gap = np.exp(0.5 * (np.sin(x + 2 * y) + np.cos(2 * x - y + 1) + 0.5 * np.sin(x)))
        one, other = (rl.flow(each, sizes=(1.0, 1.0)).tensor for each in (gap, 1 / gap))
        errors.append(abs(one @ turn @ other @ turn.T - np.eye(2)).max())
    assert np.log2(errors[0] / errors[1]) > 1.7
    assert np.log2(errors[1] / errors[2]) > 1.8
    assert errors[2] < 1e-2


def test_a_disc_in_the_middle_of_a_cell():
    """A circle of contact of a fifth of the side, by its series; in steps, of the first order."""
    errors = []
    for n in (64, 128):
        x = (np.arange(n) + 0.5) / n - 0.5
        gap = (np.hypot(*np.meshgrid(x, x)) > 0.2).astype(float)
        errors.append(abs(rl.flow(gap, sizes=(1.0, 1.0)).permeance / 0.776714 - 1))
    assert errors[1] < errors[0] / 1.5 < 0.02


def test_waves_along_and_across():
    x = (np.arange(64) + 0.5) / 64
    gap = (1 + 0.6 * np.cos(2 * np.pi * x))[:, None] * np.ones(8)
    tensor = rl.flow(gap, sizes=(1.0, 1.0)).tensor
    across, along = (1 - 0.36) ** 2.5 / 1.18, 1 + 1.5 * 0.36
    assert tensor == pytest.approx(np.diag([across, along]), rel=1e-9, abs=1e-12)


def test_a_channel_in_a_diagonal_leads_nowhere_else():
    steps = np.eye(10) + np.roll(np.eye(10), 1, axis=0)
    flow = rl.flow(steps, sizes=(1.0, 1.0))
    assert flow.tensor == pytest.approx(np.full((2, 2), 0.05), rel=1e-12)
    assert flow.principal_permeances == pytest.approx((0.1, 0.0), abs=1e-15)
    assert flow.easiest_direction == pytest.approx(45.0)
    assert rl.flow(steps[::-1], sizes=(1.0, 1.0)).easiest_direction == pytest.approx(-45.0)


def test_a_channel_that_never_meets_itself_is_sealed():
    gap = np.zeros((8, 8))
    gap[:, 3] = 1
    gap[4, 3] = 0
    along_x, along_y = rl.flow(gap, sizes=(1.0, 1.0), along="both")
    assert along_x.is_sealed
    assert along_y.is_sealed
    assert along_x.permeance == along_y.permeance == 0
    assert along_x.converged


def test_a_place_beyond_a_thread_flows_within_as_if_it_were_alone():
    gap = np.ones((64, 64))
    gap[10] = gap[40] = 0
    alone = rl.flow(gap, sizes=(1.0, 1.0), along="y").permeance
    gap[10, 5], gap[40, 50] = 1e-4, 1.1e-4
    assert alone == pytest.approx(62 / 64, rel=1e-12)
    joined = rl.flow(gap, sizes=(1.0, 1.0), along="both")
    assert joined[1].permeance == pytest.approx(alone, rel=1e-12)
    thread = rl.flow(np.roll(gap, 20, 0), sizes=(1.0, 1.0)).permeance
    assert joined[0].permeance == pytest.approx(thread, rel=1e-12)
    assert 0 < thread < 1e-12


def test_directions_are_those_of_a_tensor_alone():
    flow = rl.flow(np.ones((4, 4)), sizes=(1.0, 1.0), sides="closed")
    assert flow.tensor is None
    for name in ("principal_permeances", "easiest_direction"):
        with pytest.raises(rl.InputError, match='repeats along both sides: this one has sides="c'):
            getattr(flow, name)


def test_windings_are_those_of_the_rolled_map():
    rng = np.random.default_rng(5)
    for share in (0.5, 0.55, 0.6, 0.65):
        for _ in range(20):
            is_open = rng.random((12, 9)) < share
            found = [
                windings(np.roll(is_open, by, (0, 1)), (True, True))
                for by in ((0, 0), (3, 0), (0, 4), (7, 5))
            ]
            assert len({(each.leads(0), each.leads(1)) for each in found}) == 1
            assert len({each.through.sum() for each in found}) == 1
