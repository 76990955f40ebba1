"""Contact laws that the package does not know are pressed as its own are.

They are defined here, in the public words of a law alone, and held against dense matrices.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from threadpoolctl import threadpool_limits

import roughline as rl
from halfspace.dense_contact import Body, DenseContact
from halfspace.dense_hardness import History
from halfspace.small_bodies import needle, rough

E_STAR = 2.0
RTOL = 1e-9  # a pressure answers a gap with the grid's stiffness, so gaps must be smaller
PRESSURE = 1e-6  # of the largest
STIFFNESS = 1e-6
LOAD = 1e-7
DENT = 1e-7  # of the rms height


@pytest.fixture(autouse=True)
def small_matrices_need_one_thread():
    with threadpool_limits(limits=1, user_api="blas"):
        yield


@dataclass(frozen=True, eq=False)
class UnevenHardness(rl.ContactLaw):
    """Each node bears a hardness of its own, and is dented where it would bear more.

    Attributes
    ----------
    hardness : ndarray, shape (nx, ny)
        The most that each node bears. [pressure]
    elastic_first : bool
        Whether loads are tried without the hardness first.
    elastic : bool
        Whether this one is now.
    """

    hardness: np.ndarray
    elastic_first: bool = False
    elastic: bool = False
    memory: ClassVar = "dents"

    def bounds(self, nodes):
        """Return zero and the hardness of each node."""
        if self.elastic:
            return 0.0, np.inf
        return 0.0, self.hardness.ravel() if nodes is None else self.hardness.ravel()[nodes]

    def refuse(self, control, values, heights, area, mean_is_free):
        """Refuse forces that all nodes together cannot bear."""
        super().refuse(control, values, heights, area, mean_is_free)
        if control == "forces" and values.max() >= self.largest_force(area):
            raise rl.InputError(
                f"forces reach {values.max():g}; all nodes together bear less than "
                f"{self.largest_force(area):g}: give smaller forces"
            )

    def scaled(self, pressure, length):
        """Return the law in other units."""
        return replace(self, hardness=self.hardness / pressure)

    def on(self, take):
        """Return the law on another grid."""
        return replace(self, hardness=take(self.hardness))

    def start(self, value, last, largest):
        """Begin a load without the hardness, if so asked."""
        return replace(self, elastic=self.elastic_first)

    def then(self, contact):
        """Take the hardness into account where a node bears more."""
        over = contact.pressure > self.hardness.ravel()[contact.nodes]
        return self.bounded() if self.elastic and over.any() else None

    def bounded(self):
        """Return the law with its hardness."""
        return replace(self, elastic=False)


@dataclass(frozen=True, eq=False)
class RangedPull(rl.ContactLaw):
    """Surfaces pull each other evenly across gaps up to a range (Dugdale).

    Which nodes are within reach is found in rounds: bodies that come nearer add the nodes whose gap
    is within the range until none is added, bodies that go apart drop those beyond it. At fixed
    reach more pull closes more gap, so these rounds lead to where slow bodies would come.

    Attributes
    ----------
    pull : float
        Tension at gaps up to the range. [pressure]
    range : float
        Largest gap that is pulled. [length]
    held : ndarray of bool, shape (nx, ny), or None
        Nodes within reach; None if there are none.
    comes_nearer : bool
        Direction of the path.
    """

    pull: float
    range: float | None = None
    held: np.ndarray | None = None
    comes_nearer: bool = True
    memory: ClassVar = "path"
    only_pushes: ClassVar = False

    @property
    def reach(self):
        """Return the range, beyond which nothing is pulled."""
        return self.range

    def bounds(self, nodes):
        """Return the pull within reach and zero elsewhere, and that nodes bear any pressure."""
        if self.held is None:
            return 0.0, np.inf
        low = np.where(self.held.ravel(), -self.pull, 0.0)
        return low if nodes is None else low[nodes], np.inf

    def refuse(self, control, values, heights, area, mean_is_free):
        """Refuse forces, under which a pulled contact has two depths or none."""
        if self.range is None:
            raise rl.InputError("this pull has no range; the largest gap that it crosses is needed")
        if control == "forces":
            raise rl.InputError("a pulled contact has two depths under a force: give depths")

    def scaled(self, pressure, length):
        """Return the law in other units."""
        return replace(self, pull=self.pull / pressure, range=self.range / length)

    def on(self, take):
        """Return the law on another grid."""
        return self if self.held is None else replace(self, held=take(self.held * 1.0) > 0.5)

    def start(self, value, last, largest):
        """Turn where the path turns; nodes within reach are kept."""
        return replace(self, comes_nearer=last is None or value >= last)

    def then(self, contact):
        """Add nodes that have come within reach, or drop those that have left it."""
        within = contact.gap <= self.range
        held = np.zeros_like(within) if self.held is None else self.held
        changed = held | within if self.comes_nearer else held & within
        return None if (changed == held).all() else replace(self, held=changed)

    def scales(self, pressure, displacement):
        """Compare gaps with the range; bodies that pull may displace each other by nothing."""
        return float(np.abs(pressure).mean()), self.range


BODIES = {
    "H = 0": ((14, 10), (1.0, 1.0), lambda shape: rough(shape, 0.0)),
    "H = 0.8": ((14, 10), (1.0, 1.3), lambda shape: rough(shape, 0.8)),
    "white noise": (
        (10, 13),
        (1.0, 1.0),
        lambda shape: 0.1 * np.random.default_rng(2).normal(size=shape),
    ),
    "needle": ((12, 10), (1.0, 1.0), needle),
    "large": ((70, 20), (1.0, 0.3), lambda shape: rough(shape, 0.8)),  # it has coarser grids
}


def posed(name, periodic):
    """Return a body and the pressure that its slopes set."""
    shape, sizes, made = BODIES[name]
    body = Body(made(shape), sizes, E_STAR, periodic)
    return body, E_STAR * rl.Surface(body.heights, sizes).rms_slope


def pressed(body, law, **changed):
    settings = {"half_space": rl.Homogeneous(body.E_star, periodic=body.periodic), "law": law}
    settings |= {"fields": True, "rtol": RTOL}
    return rl.press(rl.Surface(body.heights, body.sizes), **settings | changed)


# Loads below the largest so far are not that load itself: there nodes are at the hardness, and
# bear it elastically, and either set is right.
HISTORY = np.array([0.2, 0.5, 0.3, 1.0, 0.4, 0.0, 0.8, 1.3, 0.7])


@pytest.mark.parametrize("elastic_first", [False, True])
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("name", BODIES)
def test_a_hardness_of_each_node_is_the_dense_solutions(name, periodic, elastic_first):
    body, pressure = posed(name, periodic)
    factors = np.random.default_rng(5).uniform(0.4, 1.6, body.heights.shape)
    hardness = 0.2 * pressure * factors
    forces = HISTORY * 0.06 * pressure * body.sizes[0] * body.sizes[1]
    history = History(body, hardness.ravel())
    states = [history.press(force) for force in forces]
    assert any(0 < each.plastic.sum() < each.contact.sum() for each in states)
    law = UnevenHardness(hardness, elastic_first)
    depths = np.array([each.depth for each in states])
    by_force = pressed(body, law, forces=forces)
    assert by_force.depth == pytest.approx(depths, rel=LOAD)
    depths[5] = 0.0  # apart, as the surface is dented
    by_depth = pressed(body, law, depths=depths)
    assert by_depth.force == pytest.approx(forces, rel=LOAD)
    for curve in (by_force, by_depth):
        for i, state in enumerate(states):
            assert_same_dents(curve, i, state)
        dissipated = [each.dissipated_work for each in states]
        most = max(dissipated)
        assert curve.dissipated_work == pytest.approx(dissipated, rel=LOAD, abs=LOAD * most)


def assert_same_dents(curve, i, state):
    """Compare one load of bodies that yield with the dense solution."""
    fields = curve.fields[i]
    assert (fields.contact.ravel() == state.contact).all()
    assert (fields.plastic.ravel() == state.plastic).all()
    off = np.abs(fields.pressure.ravel() - state.pressure).max()
    assert off <= PRESSURE * state.pressure.max()
    assert curve.stiffness[i] == pytest.approx(state.stiffness, rel=STIFFNESS)
    assert curve.unloading_stiffness[i] == pytest.approx(state.unloading_stiffness, rel=STIFFNESS)
    off = np.abs(fields.indentation.ravel() - state.indentation).max()
    assert off <= DENT * curve.rms_height
    assert curve.area_fraction[i] == state.contact.mean()


@pytest.mark.parametrize("elastic_first", [False, True])
def test_depths_that_elastic_bodies_do_not_reach_are_the_dense_solutions(elastic_first):
    body, pressure = posed("H = 0.8", periodic=True)
    hardness = 0.05 * pressure * np.random.default_rng(5).uniform(0.4, 1.6, body.heights.shape)
    history = History(body, hardness.ravel())
    shares = np.array([0.2, 0.97, 0.5, 0.98])
    states = [history.press(share * body.cell * hardness.sum()) for share in shares]
    depths = np.array([each.depth for each in states])
    assert depths[1] > float(np.mean(body.separation))  # full contact, if it did not yield
    curve = pressed(body, UnevenHardness(hardness, elastic_first), depths=depths)
    assert curve.force == pytest.approx([each.force for each in states], rel=LOAD)
    for i, state in enumerate(states):
        assert_same_dents(curve, i, state)


def test_one_hardness_of_all_nodes_is_the_packages_own():
    body, pressure = posed("large", periodic=False)
    forces = HISTORY * 0.06 * pressure * body.sizes[0] * body.sizes[1]
    uneven = UnevenHardness(np.full(body.heights.shape, 0.2 * pressure))
    ours = pressed(body, uneven, forces=forces)
    own = pressed(body, rl.Yielding(hardness=0.2 * pressure), forces=forces)
    surface = rl.Surface(body.heights, body.sizes)
    short = rl.press(surface, E_star=E_STAR, hardness=0.2 * pressure, forces=forces, rtol=RTOL)
    assert (own.depth == short.depth).all()
    for name in ("depth", "stiffness", "unloading_stiffness", "dissipated_work"):
        expected = getattr(own, name)
        most = np.abs(expected).max()
        assert getattr(ours, name) == pytest.approx(expected, rel=LOAD, abs=LOAD * most), name
    assert ours.area_fraction.tolist() == own.area_fraction.tolist()


class Forgetful(UnevenHardness):
    """A law that does not take its field to other grids."""

    def on(self, take):
        return self


def test_bounds_of_another_grid_are_refused():
    body = rl.SelfAffine(hurst=0.8, rms_height=1e-3).surface(128, rng=3)
    law = Forgetful(np.linspace(0.05, 0.5, 128**2).reshape(128, 128))
    with pytest.raises(rl.InputError, match="let `on` take the law's fields to other grids"):
        rl.press(body, E_star=1.0, forces=[1e-6], law=law)


@dataclass(frozen=True)
class Pulled:
    """A contact with pull as dense matrices give it; fields are flat."""

    force: float
    pressure: np.ndarray
    touching: np.ndarray
    held: np.ndarray
    stiffness: float


class DensePull:
    """Depths one after another, the nodes within reach found in rounds over dense solutions."""

    def __init__(self, body, pull, most):
        self.body, self.pull, self.most = body, pull, most
        self._dense = DenseContact(body)
        self._reach = np.zeros(body.heights.size, bool)
        self._depth = -np.inf
        self.rounds = 0

    def press(self, depth):
        nearer, self._depth = depth >= self._depth, depth
        separation = self.body.separation
        while True:
            low = np.where(self._reach, -self.pull, 0.0)
            _, pressure = self._dense.at_depth(separation, depth, low, np.inf)
            within = self._dense.K @ pressure + separation - depth <= self.most
            reach = self._reach | within if nearer else self._reach & within
            if (reach == self._reach).all():
                break
            self._reach, self.rounds = reach, self.rounds + 1
        touching = self._dense.between
        return Pulled(
            force=self.body.cell * float(pressure.sum()),
            pressure=pressure,
            touching=touching,
            held=reach & ~touching,
            stiffness=self._dense.stiffness(touching),
        )


def cycle(nearest, farthest, count=9):
    """Depths to the nearest and back to the farthest, not the same ones, and nearer once more."""
    nearer = np.linspace(farthest, nearest, count)
    apart = np.linspace(nearest, farthest, count + 2)[1:]
    return np.concatenate([nearer, apart, [nearest / 3, 0.9 * nearest]])


@pytest.mark.parametrize("strength", [0.1, 0.4])
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("name", ["H = 0", "H = 0.8", "white noise", "large"])
def test_a_pull_that_ends_at_a_range_is_the_dense_solutions(name, periodic, strength):
    body, pressure = posed(name, periodic)
    pull, most = strength * pressure, 0.1 * float(body.heights.std())
    nearest = 0.4 * float(np.mean(body.separation))
    depths = cycle(nearest, -4 * most)
    dense = DensePull(body, pull, most)
    states = [dense.press(depth) for depth in depths]
    curve = pressed(body, RangedPull(pull, most), depths=depths)
    assert dense.rounds > 5
    assert any(each.held.any() and each.touching.any() for each in states)
    largest = max(np.abs(each.force) for each in states)
    assert curve.force == pytest.approx(
        [each.force for each in states], rel=LOAD, abs=LOAD * largest
    )
    assert (curve.depth == depths).all()
    for i, state in enumerate(states):
        fields = curve.fields[i]
        assert (fields.contact.ravel() == state.touching).all(), i
        held = ~fields.contact & (fields.pressure < 0)
        assert (held.ravel() == state.held).all(), i
        off = np.abs(fields.pressure.ravel() - state.pressure).max()
        assert off <= PRESSURE * np.abs(state.pressure).max(), i
        assert curve.stiffness[i] == pytest.approx(state.stiffness, rel=STIFFNESS), i
        assert curve.unloading_stiffness[i] == pytest.approx(state.stiffness, rel=STIFFNESS), i
        assert curve.area_fraction[i] == state.touching.mean()


def test_a_cycle_of_pull_takes_work():
    """On the way back bodies hold each other where they did not pull yet on the way in."""
    body, pressure = posed("H = 0.8", periodic=False)
    most = 0.1 * float(body.heights.std())
    steps = np.linspace(-6 * most, 0.3 * float(np.mean(body.separation)), 25)
    curve = pressed(body, RangedPull(0.4 * pressure, most), depths=[*steps, *steps[::-1]])
    nearer, apart = curve.force[:25], curve.force[:24:-1]
    assert nearer[-1] == pytest.approx(apart[-1], rel=LOAD)  # the same load again
    assert (apart <= nearer + LOAD * np.abs(curve.force).max()).all()
    assert np.trapezoid(nearer - apart, steps) > 0
    assert curve.force.min() < 0
    assert curve.force[-1] == 0  # it lets go
    touched = curve.area_fraction > 0
    assert touched[25:].sum() > touched[:25].sum()


def test_beyond_full_contact_elastic_bodies_show_infinite_pressures():
    """No finite pressures are so deep, so the law that follows is the one with a hardness."""
    body, pressure = posed("H = 0.8", periodic=True)
    hardness = pressure * np.linspace(0.5, 2.0, body.heights.size).reshape(body.heights.shape)
    depths = np.array([1.2, 0.5, 1.5]) * float(np.mean(body.separation))
    at_once, elastic_first = (
        pressed(body, UnevenHardness(hardness, first), depths=depths) for first in (False, True)
    )
    for name in ("force", "stiffness", "unloading_stiffness", "indentation"):
        assert getattr(elastic_first, name) == pytest.approx(getattr(at_once, name), rel=1e-6), name


def maugis_pull_off(strength):
    """Least force on a sphere over pi w R (Maugis 1992, eqs. 6.10-6.13)."""

    def force(m):
        mu, angle = np.sqrt(m**2 - 1), np.arctan(np.sqrt(m**2 - 1))

        def excess(a):
            bent = strength * a**2 / 2 * (mu + (m**2 - 2) * angle)
            return bent + 4 / 3 * strength**2 * a * (mu * angle - m + 1) - 1

        a = brentq(excess, 1e-6, 10.0)
        return a**3 - strength * a**2 * (mu + m**2 * angle)

    return minimize_scalar(force, bounds=(1.01, 20), method="bounded", options={"xatol": 1e-9}).fun


def pull_off(n, strength=1.0):
    """Least force on a sphere as it is taken away, over pi w R.

    Lengths in the plane are over (pi w R² / K)^(1/3), K = 4 E* / 3.
    """
    x = 1.7 * (2 * np.arange(n) + 1 - n) / n
    body = Body(-(x[:, None] ** 2 + x**2) / 2, (3.4, 3.4), 0.75, periodic=False)
    pull = strength / 2
    law = RangedPull(pull, 1 / (np.pi * pull))
    depths = np.concatenate([[-0.5, 0.0], np.linspace(-0.3, -0.7, 9)])
    curve = pressed(body, law, depths=depths, rtol=1e-6, fields=False)
    assert curve.force.argmin() not in (0, 1, 2, depths.size - 1)
    return curve.force.min()


def test_a_sphere_is_pulled_off_as_maugis_has_it():
    exact = maugis_pull_off(1.0)
    assert exact == pytest.approx(-1.60073, abs=5e-6)
    errors = [pull_off(n) / exact - 1 for n in (36, 72)]
    assert 0 < errors[1] < 0.04
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.35)  # the error is as large as a cell


@dataclass(frozen=True)
class Lost(rl.ContactLaw):
    """Bodies that only push, but for one thing that is no number."""

    lost: str

    def bounds(self, nodes):
        """Return zero, and largest pressures, of which one, or all, are lost."""
        high = np.full(140, np.inf)
        high[LOST_NODES.get(self.lost, [])] = np.nan
        return 0.0, high if nodes is None else high[nodes]

    def scaled(self, pressure, length):
        """Have no units."""
        return self

    def scales(self, pressure, displacement):
        """Compare with the pressure's and the length's scale."""
        ours = super().scales(pressure, displacement)
        return tuple(
            np.nan if self.lost == name else each for name, each in zip(SCALES, ours, strict=True)
        )


SCALES = ("pressures", "lengths")
HIGHEST = int(posed("H = 0.8", periodic=False)[0].heights.argmax())
LOST_NODES = {"the highest node's bound": HIGHEST, "all bounds": slice(None)}


@pytest.mark.parametrize("lost", [*LOST_NODES, *SCALES])
@pytest.mark.parametrize("load", [{"forces": [0.01]}, {"depths": [0.05]}])
def test_what_is_not_finite_is_never_certified(lost, load):
    body, _ = posed("H = 0.8", periodic=False)
    curve = pressed(body, Lost(lost), throw=False, **load)
    assert not curve.converged.any()
    assert np.isnan(curve.stiffness).all()
    assert np.isnan(curve.residual[0])
    with pytest.raises(rl.ConvergenceError, match="nan"):
        pressed(body, Lost(lost), **load)


SURFACE = rl.Surface(rough((14, 10), 0.8), (1.0, 1.3))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"law": rl.Yielding(hardness=1.0), "hardness": 1.0}, r"law.*hardness.*"),
        ({"law": "yielding"}, "law is .*yielding.*ContactLaw"),
        ({"law": rl.Unilateral}, "law is .*Unilateral.*ContactLaw"),
        ({"law": RangedPull(0.1)}, "this pull has no range"),
    ],
)
def test_what_is_no_law_is_refused(given, said):
    with pytest.raises(rl.InputError, match=said) as refused:
        rl.press(SURFACE, E_star=1.0, depths=[0.05], **given)
    assert "\n" not in str(refused.value)


class Multiplied(UnevenHardness):
    """A law whose pressures grow with the unit."""

    def scaled(self, pressure, length):
        """Multiply where the number in other units is divided."""
        return replace(self, hardness=self.hardness * pressure)


class FarReaching(RangedPull):
    """A law that forgets to bring its length to other units."""

    def scaled(self, pressure, length):
        """Bring the pull to other units, and not the range."""
        return replace(super().scaled(pressure, length), range=self.range)


def test_a_law_that_is_another_one_in_other_units_is_refused():
    hard = Multiplied(np.full((14, 10), 0.3))
    said = r"law has a method Multiplied.scaled\(.*upper bound .*: pressures are to be divided by"
    with pytest.raises(rl.InputError, match=said) as refused:
        rl.press(SURFACE, E_star=1.0, law=hard, depths=[0.05])
    assert "\n" not in str(refused.value)
    with pytest.raises(rl.InputError, match=r"makes the reach .* is right"):
        rl.press(SURFACE, E_star=1.0, law=FarReaching(0.1, 0.01), depths=[0.05])


class Swapped(UnevenHardness):
    """A law that tells its bounds in the wrong order."""

    def bounds(self, nodes):
        """Return the hardness, and zero."""
        return super().bounds(nodes)[::-1]


def test_bounds_in_the_wrong_order_are_refused():
    with pytest.raises(rl.InputError, match=r"Swapped.bounds .* the lower one comes first"):
        rl.press(SURFACE, E_star=1.0, law=Swapped(np.ones((14, 10))), depths=[0.05])


def test_a_law_refuses_loads_in_its_own_words():
    with pytest.raises(rl.InputError, match="a pulled contact has two depths under a force"):
        rl.press(SURFACE, E_star=1.0, law=RangedPull(0.1, 0.01), forces=[0.1])
    with pytest.raises(rl.InputError, match="all nodes together bear less than 1.3"):
        rl.press(SURFACE, E_star=1.0, law=UnevenHardness(np.ones((14, 10))), forces=[2.0])
    with pytest.raises(rl.InputError, match=r"depths\[0\] is -0.1, negative"):
        rl.press(SURFACE, E_star=1.0, law=UnevenHardness(np.ones((14, 10))), depths=[-0.1])


def test_a_line_has_no_law():
    line = rl.Line(np.arange(8.0) % 3, length=1.0)
    with pytest.raises(rl.InputError, match="law belongs to the full model"):
        rl.press(line, E_star=1.0, law=rl.Unilateral(), depths=[0.1])


def test_a_law_says_all_that_a_law_is_asked():
    class Speechless(rl.ContactLaw):
        pass

    with pytest.raises(TypeError, match="abstract"):
        Speechless()
