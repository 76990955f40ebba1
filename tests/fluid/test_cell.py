"""What repeats along the flow has no ends: the same wherever it is cut, and exact solutions."""

from fractions import Fraction

import numpy as np
import pytest

import roughline as rl
from roughline.fluid import network
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


@pytest.mark.parametrize("numbers", [range(30), range(30, 300)])
def test_joined_rows_let_more_through_and_parted_columns_less(numbers):
    """Rayleigh: rows of one pressure from above, columns without any flow across from below."""
    for number in numbers:
        gap = torus(number, largest=7)
        for flow, length in zip(of(gap, along="both"), (gap.shape, gap.shape[::-1]), strict=True):
            is_x = flow.along == "x"
            faces = flow.conductances_x[1:] if is_x else flow.conductances_y[:, 1:].T
            with np.errstate(divide="ignore"):
                most = 1 / (1 / faces.sum(axis=1)).sum() * length[0] / length[1]
                least = (1 / (1 / faces).sum(axis=0)).sum() * length[0] / length[1]
            assert least * (1 - 1e-12) <= flow.permeance <= most * (1 + 1e-12), number


@pytest.mark.parametrize("contrast", [0.1, 3.0, 10.0])
def test_squares_in_a_square_cell_lie_between_the_bounds_of_hashin_and_shtrikman(contrast):
    """They let as much through either way, and so any way; u³ inside over that outside."""
    gap = np.ones((40, 40))
    gap[10:30, 10:30] = np.cbrt(contrast)
    tensor = rl.flow(gap, sizes=(1.0, 1.0)).tensor
    assert tensor == pytest.approx(tensor[0, 0] * np.eye(2), rel=1e-12, abs=1e-12)
    bounds = [
        first + share / (1 / (second - first) + (1 - share) / (2 * first))
        for first, second, share in ((1.0, contrast, 0.25), (contrast, 1.0, 0.75))
    ]
    assert min(bounds) < tensor[0, 0] < max(bounds)


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


@pytest.mark.parametrize(("times", "angle"), [((1, 1), -45.0), ((2, 1), np.degrees(-np.arctan(2)))])
def test_waves_in_a_diagonal(times, angle):
    """So many of them along either side of a square; of the second order in the spacing."""
    errors, exact_ones = [], ((1 + 1.5 * 0.36), (1 - 0.36) ** 2.5 / 1.18)
    for n in (16, 32, 64):
        x, y = np.meshgrid(*[2 * np.pi * (np.arange(n) + 0.5) / n] * 2, indexing="ij")
        flow = rl.flow(1 + 0.6 * np.cos(times[0] * x + times[1] * y), sizes=(1.0, 1.0))
        errors.append(abs(np.divide(flow.principal_permeances, exact_ones) - 1).max())
    assert flow.easiest_direction == pytest.approx(angle, abs=0.1)
    assert np.log2(errors[0] / errors[1]) > 1.7
    assert np.log2(errors[1] / errors[2]) > 1.8
    assert errors[2] < 0.01


def winding_channel(times, n):
    """A channel of one cell that comes back to its beginning so many repetitions along x and y."""
    gap, i, j = np.zeros((n, n)), 0, 0
    total = times[0] * n, times[1] * n
    while (i, j) != total:
        gap[i % n, j % n] = 1
        if (i + 1) * total[1] <= (j + 1) * total[0]:
            i += 1
        else:
            j += 1
    return gap


@pytest.mark.parametrize("times", [(1, 1), (2, 1), (1, 2), (3, 2)])
def test_a_channel_that_comes_back_further_on_leads_in_that_direction_alone(times):
    """One loop, through which the pressure falls by as many periods as it leads on."""
    n = 24
    gap = winding_channel(times, n)
    cells = n * sum(times)
    assert gap.sum() == cells
    for sign in (1, -1):
        turned = gap if sign == 1 else gap[:, ::-1]
        found = windings(turned > 0, (True, True))
        assert found.rank.tolist() == [1]
        direction = np.array([times[0], sign * times[1]])
        assert abs(found.direction[0] @ direction) == direction @ direction
        assert found.leads(0)
        assert found.leads(1)
        flow = rl.flow(turned, sizes=(1.0, 1.0))
        assert flow.tensor == pytest.approx(np.outer(direction, direction) / cells, rel=1e-12)
        assert flow.principal_permeances == pytest.approx((direction @ direction / cells, 0.0))
        expected = np.degrees(np.arctan2(direction[1], direction[0]))
        assert flow.easiest_direction == pytest.approx(expected)
        for sides in ("x", "y"):  # where it repeats one way alone, the channel does not come back
            along_x, along_y = rl.flow(turned, sizes=(1.0, 1.0), along="both", sides=sides)
            assert (along_x if sides == "x" else along_y).is_sealed


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


@pytest.mark.parametrize("throat", [1e-4, 1e-6, 1e-8])
def test_the_least_permeance_is_that_of_two_throats_in_series(throat):
    """However wide the channels across are, which they part; each is half a throat long."""
    gap = np.ones((24, 20))
    gap[10] = gap[20] = 0
    gap[10, 5], gap[20, 15] = throat, 2 * throat
    flow = rl.flow(gap, sizes=(24.0, 20.0))
    series = 1 / (1 / throat**3 + 1 / (2 * throat) ** 3) * 24 / 20
    assert flow.principal_permeances[1] == pytest.approx(series, rel=1e-10 + 100 * throat**3)
    assert flow.principal_permeances[0] == pytest.approx(22 / 24, rel=1e-9)


def test_what_is_sealed_has_no_direction():
    flow = rl.flow(np.zeros((4, 4)), sizes=(1.0, 1.0))
    assert flow.principal_permeances == (0.0, 0.0)
    assert np.isnan(flow.easiest_direction)


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


def test_what_is_kept_of_rectangles_is_what_is_found_again(monkeypatch):
    gap = np.random.default_rng(3).uniform(0.1, 1.0, (40, 48)) ** 2
    kept = rl.flow(gap, (1.0, 1.2))
    monkeypatch.setattr(network, "MOST_KEPT", 0)
    found_again = rl.flow(gap, (1.0, 1.2))
    assert np.array_equal(kept.pressure, found_again.pressure)
    assert kept.permeance == found_again.permeance
