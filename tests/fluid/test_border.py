"""What the border of a piece does to the flow through it: dense solutions, and what bounds what."""

import numpy as np
import pytest

import roughline as rl
from roughline.contact.fields import Fields
from roughline.fluid.gap import Gap
from roughline.fluid.measures import (
    LIQUID,
    equivalent_aperture,
    flow_factor,
    measures_at_border,
    names_at_border,
)
from roughline.fluid.rarefied import Rarefied

DENSE = 1e-10  # relative error that a dense solution of a few cells may have itself
LENGTHS = (1.3, 0.7)
HELD = {"periodic": "y", "x": "closed"}  # sides of a gap that ends along x, and is alike across


def at_border(gap, sizes=LENGTHS, **given):
    return rl.flow(gap, sizes, **given).border_permeances


def random_gap(number, largest=6):
    """A small gap, closed in places."""
    rng = np.random.default_rng([71, number])
    shape = rng.integers(2, largest + 1, 2)
    return rng.uniform(0.5, 2.0, shape) * (rng.random(shape) > 0.3)


def dense(gap, sizes, repeats_across):
    """Permeances along x with the flow given along the border, and the pressure, by pinv."""
    nx, ny = gap.shape
    along = (sizes[1] / ny) / (sizes[0] / nx)
    k, here = gap**3, np.arange(nx * ny).reshape(nx, ny)
    laplacian = np.zeros((nx * ny, nx * ny))
    reach = np.eye(nx * ny, dtype=bool)
    for i, j in np.ndindex(nx, ny):
        for p, q, square in ((i + 1, j, along), (i, (j + 1) % ny, 1 / along)):
            if p == nx or (q == 0 and p == i and not repeats_across):
                continue
            if k[i, j] * k[p, q] > 0:
                a, b, g = here[i, j], here[p, q], 2 * square / (1 / k[i, j] + 1 / k[p, q])
                laplacian[[a, b], [a, b]] += g
                laplacian[[a, b], [b, a]] -= g
                reach[a, b] = reach[b, a] = True
    reach = np.linalg.matrix_power(reach.astype(float), nx * ny) > 0
    parts = {tuple(np.flatnonzero(reach[here[0, j]])) for j in range(ny) if k[0, j] > 0}
    given = held = 0.0
    for part in parts:
        members = np.isin(here, part)
        ends = [np.where(members[row], k[row], 0.0) for row in (0, -1)]
        if not all(end.any() for end in ends):
            continue
        into = np.zeros((nx, ny))
        into[0] += ends[0] / ends[0].sum()
        into[-1] -= ends[1] / ends[1].sum()
        inside = laplacian[np.ix_(part, part)]
        flows = into.ravel()[list(part)]
        resistance = flows @ np.linalg.pinv(inside, rcond=1e-13) @ flows
        given += 1 / (resistance + sum(1 / (2 * along * end.sum()) for end in ends))
        halves = [np.zeros((nx, ny)) for _ in ends]
        halves[0][0], halves[1][-1] = (2 * along * end for end in ends)
        inlet, outlet = (each.ravel()[list(part)] for each in halves)
        pressure = np.linalg.solve(inside + np.diag(inlet + outlet), inlet)
        held += inlet @ (1 - pressure)
    return np.array([given, held]) * sizes[0] / sizes[1]


@pytest.mark.parametrize("sides", ["periodic", "x"])
def test_dense_solutions_find_the_same(sides):
    leads = 0
    for number in range(20):
        gap = random_gap(number)
        expected = dense(gap, LENGTHS, sides == "periodic")
        assert at_border(gap, sides=sides) == pytest.approx(expected, rel=DENSE)
        leads += expected[0] > 0
    assert 5 < leads < 20


@pytest.mark.parametrize("numbers", [range(15), range(15, 60)])
def test_the_pressure_held_even_lets_most_through(numbers):
    """It joins what the cell leaves apart; and the flow that is given is but one of all flows."""
    for number in numbers:
        gap = random_gap(number)
        for sides, ended in HELD.items():
            given, held = at_border(gap, sides=sides)
            cell = rl.flow(gap, LENGTHS, sides=sides).permeance
            assert held >= cell * (1 - 1e-12)
            assert given <= held * (1 + 1e-12)
            expected = rl.flow(gap, LENGTHS, sides=ended).permeance
            assert held == pytest.approx(expected, rel=1e-12)


def test_the_flow_given_may_let_more_through_than_the_cell():
    """Where the borders do not fit together, what repeats has to find its way to the next map."""
    gap = np.zeros((6, 12))
    gap[:4, 2:4] = gap[3, 2:9] = gap[3:, 7:9] = 1
    assert rl.flow(gap, LENGTHS).is_sealed
    given, held = at_border(gap)
    assert 0 < given <= held


def test_plates_and_strips_are_what_they_are():
    strips = np.where(np.arange(8) % 2, 1.0, 2.0)
    ones = np.ones((8, 6))
    series, parallel = 1 / np.mean(strips**-3), np.mean(strips**3)
    for gap, along, expected in (
        (2 * ones, "x", 8.0),
        (strips[:, None] * ones, "x", series),
        (strips[:, None] * ones, "y", parallel),
    ):
        assert at_border(gap, along=along) == pytest.approx((expected,) * 2, rel=1e-12)


def test_parts_beside_one_another_add_up():
    """Each has the flow that plates would share in it, whatever the others let through."""
    rng = np.random.default_rng(3)
    gap = rng.uniform(0.5, 2.0, (7, 15))
    gap[:, ::5] = 0
    parts = [np.where(np.arange(15) // 5 == part, gap, 0.0) for part in range(3)]
    expected = np.sum([at_border(each) for each in parts], axis=0)
    assert at_border(gap) == pytest.approx(expected, rel=1e-12)


def test_without_a_path_from_border_to_border_there_is_none():
    gap = np.ones((6, 6))
    gap[3] = 0
    assert at_border(gap) == (0.0, 0.0)
    assert at_border(np.zeros((4, 4))) == (0.0, 0.0)
    assert min(at_border(gap, along="y")) > 0


def test_turned_and_mirrored_it_is_the_same():
    gap = random_gap(0)
    expected = at_border(gap)
    assert min(expected) > 0
    assert at_border(gap[::-1]) == pytest.approx(expected, rel=1e-12)
    assert at_border(gap[:, ::-1]) == pytest.approx(expected, rel=1e-12)
    assert at_border(gap.T, LENGTHS[::-1], along="y") == pytest.approx(expected, rel=1e-12)


def test_a_body_that_ends_has_no_border_to_judge():
    for sides, along in (("closed", "x"), ("x", "y"), ("y", "x")):
        flow = rl.flow(np.ones((4, 4)), LENGTHS, sides=sides, along=along)
        with pytest.raises(rl.InputError, match=f'along {along} this one ends, sides="{sides}"'):
            _ = flow.border_permeances


@pytest.mark.parametrize("fluid", [LIQUID, Rarefied(0.5), Rarefied(20.0, 1.0)])
def test_measures_at_the_border_are_those_of_the_gap(fluid):
    """Of a gas in a vacuum, the weighted sum of two places along the seal."""
    gap = random_gap(0)
    blank, no_contact = np.zeros(gap.shape), np.zeros(gap.shape, bool)
    fields = Fields(
        pressure=blank,
        displacement=blank,
        gap=gap,
        contact=gap == 0,
        plastic=no_contact,
        pulling=no_contact,
        indentation=blank,
        sizes=LENGTHS,
        periodic=True,
    )
    expected = np.zeros(2)
    even = fluid.is_even(fields.mean_gap)
    for weight, path in [(1.0, fluid.path)] if even else fluid.stations:
        expected += weight * np.array(rl.flow(fields, mean_free_path=path).border_permeances)
    found = {each.name: each.of(fields) for each in measures_at_border(fluid, "x")}
    for measure in (equivalent_aperture(fluid, "x"), flow_factor(fluid, "x")):
        assert set(names_at_border(measure.name)) <= set(found)
    names = names_at_border("hydraulic_aperture_x"), names_at_border("pressure_flow_factor_x")
    for permeance, aperture, factor in zip(expected, *names, strict=True):
        assert fluid.plates(found[aperture]) == pytest.approx(permeance, rel=1e-9)
        mean = Gap.of(fields, None, None, 0.0).distances.mean()
        assert found[factor] == pytest.approx((found[aperture] / mean) ** 3, rel=1e-9)
