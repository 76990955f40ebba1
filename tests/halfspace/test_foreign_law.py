"""Contact laws that the package does not know are pressed as its own are.

They are defined here, in the public words of a law alone, and held against dense matrices.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

import roughline as rl
from halfspace.dense_contact import Body
from halfspace.dense_hardness import History
from halfspace.small_bodies import needle, rough
from halfspace.test_adhesion_oracle import DenseSticking, ramps

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
    """

    hardness: np.ndarray

    def bounds(self, nodes):
        """Return zero and the hardness of each node."""
        return 0.0, self.hardness.ravel() if nodes is None else self.hardness.ravel()[nodes]

    def scaled(self, pressure, length):
        """Return the law in other units."""
        return replace(self, hardness=self.hardness / pressure)

    def on(self, take):
        """Return the law on another grid."""
        return replace(self, hardness=take(self.hardness))


@dataclass(frozen=True)
class PowerLawPull(rl.ContactLaw):
    """Surfaces pull each other with sigma_0 / (1 + g / rho)³ across gaps g up to an end.

    Attributes
    ----------
    pull : float
        Tension of nodes that all but touch, sigma_0. [pressure]
    length : float
        Gap across which it falls to an eighth, rho. [length]
    end : float
        Largest gap that is pulled. [length]
    """

    pull: float
    length: float
    end: float

    @property
    def cutoff(self):
        """Return the end, at which the pull jumps to zero."""
        return self.end

    def bounds(self, nodes):
        """Return the largest pull, and that nodes bear any pressure."""
        return -self.pull, np.inf

    def scaled(self, pressure, length):
        """Return the law in other units."""
        pull, rho, end = self.pull / pressure, self.length / length, self.end / length
        return replace(self, pull=pull, length=rho, end=end)

    def share_at(self, gap):
        """Return the share of the largest pull across a gap."""
        return (1 + gap / self.length) ** -3

    def gap_at(self, share):
        """Return the gap that leaves a share."""
        return self.length * (share ** (-1 / 3) - 1)

    def work_beyond(self, gap):
        """Return the integral of the share from a gap to the end."""
        return (
            self.length / 2 * ((1 + gap / self.length) ** -2 - (1 + self.end / self.length) ** -2)
        )


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


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("name", BODIES)
def test_a_hardness_of_each_node_is_the_dense_solutions(name, periodic):
    body, pressure = posed(name, periodic)
    factors = np.random.default_rng(5).uniform(0.4, 1.6, body.heights.shape)
    hardness = 0.2 * pressure * factors
    forces = HISTORY * 0.06 * pressure * body.sizes[0] * body.sizes[1]
    history = History(body, hardness.ravel())
    states = [history.press(force) for force in forces]
    assert any(0 < each.plastic.sum() < each.contact.sum() for each in states)
    law = UnevenHardness(hardness)
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


def test_depths_that_elastic_bodies_do_not_reach_are_the_dense_solutions():
    body, pressure = posed("H = 0.8", periodic=True)
    hardness = 0.05 * pressure * np.random.default_rng(5).uniform(0.4, 1.6, body.heights.shape)
    history = History(body, hardness.ravel())
    shares = np.array([0.2, 0.97, 0.5, 0.98])
    states = [history.press(share * body.cell * hardness.sum()) for share in shares]
    depths = np.array([each.depth for each in states])
    assert depths[1] > float(np.mean(body.separation))  # full contact, if it did not yield
    curve = pressed(body, UnevenHardness(hardness), depths=depths)
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
        rl.press(body, E_star=1.0, forces=[1e-4], law=law)


class DensePull(DenseSticking):
    """Depths one after another, where the shares of a pull follow gaps over dense solutions."""

    def pull_of(self, law):
        """The largest pull of each node, and the share of it, whose jump ends over a ramp."""
        pull = np.ravel(law.pull)
        ramp = ramps(self.body, pull.max(), law.end, self._dense.K)

        def share_at(gap):
            fallen = [(1 + at / law.length) ** -3 for at in (np.clip(gap, 0, law.end), law.end)]
            within = np.clip((law.end + ramp - gap) / (2 * ramp), 0, 1)
            return fallen[0] - fallen[1] * (1 - within)

        return pull, share_at


def power_law_pull(body, zone=6.0, length=0.1):
    """A pull that ends at twice its length, with a zone of so many cells about a contact."""
    rho = length * float(body.heights.std())
    work = 4 / 9 * rho  # over the largest pull
    return PowerLawPull(body.E_star * work / (np.pi * zone * np.sqrt(body.cell)), rho, 2 * rho)


def there_and_back(body, law, count=7):
    """Depths to the nearest and back to where bodies come off, not the same ones, and nearer."""
    farthest, nearest = -4 * law.end, 0.4 * float(np.mean(body.separation))
    nearer = np.linspace(farthest, nearest, count)
    apart = np.linspace(nearest, farthest, count + 2)[1:]
    return np.concatenate([nearer, apart, [nearest / 3, 0.9 * nearest]])


@dataclass(frozen=True, eq=False)
class UnevenPull(PowerLawPull):
    """The same where the largest pull differs from node to node."""

    def bounds(self, nodes):
        """Return the largest pull of each node."""
        return -(self.pull.ravel() if nodes is None else self.pull.ravel()[nodes]), np.inf

    def on(self, take):
        """Return the law on another grid."""
        return replace(self, pull=take(self.pull))


@pytest.mark.parametrize("uneven", [False, True])
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("name", ["H = 0.8", "white noise", "large"])
def test_a_pull_by_a_power_law_is_the_dense_solutions(name, periodic, uneven):
    body, _ = posed(name, periodic)
    law = power_law_pull(body)
    if uneven:
        factors = np.random.default_rng(6).uniform(0.3, 1.0, body.heights.shape)
        law = UnevenPull(law.pull * factors, law.length, law.end)
    depths = there_and_back(body, law)
    dense = DensePull(body, law)
    states = [dense.press(depth) for depth in depths]
    curve = pressed(body, law, depths=depths)
    assert any(each.pulling.any() and each.touching.any() for each in states)
    largest = max(np.abs(each.pressure).sum() * body.cell for each in states)
    most = max(np.abs(each.pressure).max() for each in states)
    for i, state in enumerate(states):
        fields = curve.fields[i]
        assert (fields.contact.ravel() == state.touching).all(), i
        assert abs(curve.force[i] - state.force) <= LOAD * largest, i
        assert np.abs(fields.pressure.ravel() - state.pressure).max() <= PRESSURE * most, i
        assert curve.stiffness[i] == pytest.approx(state.stiffness, rel=1e-5), i
    forces = np.array([0.5, 0.2, 0.0]) * curve.force.max()
    by_force = pressed(body, law, forces=forces)
    by_depth = pressed(body, law, depths=by_force.depth)
    assert by_depth.force == pytest.approx(forces, abs=1e-6 * largest)


@pytest.mark.parametrize("uneven", [False, True])
def test_a_cycle_of_a_pull_takes_work_that_is_none_where_nothing_jumps(uneven):
    """On the way back bodies hold each other where they did not pull yet on the way in."""
    body, _ = posed("H = 0.8", periodic=False)
    strong, weak = power_law_pull(body, zone=4.0), power_law_pull(body, zone=60.0, length=1.0)
    if uneven:
        factors = np.random.default_rng(6).uniform(0.3, 1.0, body.heights.shape)
        strong, weak = (UnevenPull(x.pull * factors, x.length, x.end) for x in (strong, weak))
    deepest = 0.3 * float(np.mean(body.separation))
    steps = np.linspace(-6 * strong.end, deepest, 25)
    curve = pressed(body, strong, depths=[*steps, *steps[::-1]])
    nearer, apart = curve.force[:25], curve.force[:24:-1]
    assert (apart <= nearer + LOAD * np.abs(curve.force).max()).all()
    rounding = 1e-12 * np.abs(curve.force).max() * float(np.ptp(steps))
    assert np.trapezoid(nearer - apart, steps) > -rounding
    assert curve.force.min() < 0
    assert curve.settings["law"] == type(strong).__name__
    slowly = pressed(body, weak, depths=np.linspace(0.0, deepest, 100), fields=False)
    assert np.abs(slowly.dissipated_work).max() < 2e-4 * slowly.work.max()


def test_beyond_full_contact_elastic_bodies_show_infinite_pressures():
    """No finite pressures are so deep, so bodies yield there at once."""
    body, pressure = posed("H = 0.8", periodic=True)
    hardness = pressure * np.linspace(0.5, 2.0, body.heights.size).reshape(body.heights.shape)
    depths = np.array([1.2, 0.5, 1.5]) * float(np.mean(body.separation))
    curve = pressed(body, UnevenHardness(hardness), depths=depths)
    history = History(body, hardness.ravel())
    states = [history.press(force) for force in curve.force]
    assert curve.depth == pytest.approx([each.depth for each in states], rel=1e-6)
    for i, state in enumerate(states):
        assert_same_dents(curve, i, state)


class EvenPull(PowerLawPull):
    """Dugdale's law in the words of another."""

    def share_at(self, gap):
        """Return one."""
        return np.ones_like(gap)

    def gap_at(self, share):
        """Return the end."""
        return np.full_like(share, self.end)

    def work_beyond(self, gap):
        """Return what is left to the end."""
        return self.end - gap


def test_an_even_pull_is_the_packages_own():
    body, _ = posed("large", periodic=True)
    law = power_law_pull(body)
    depths = there_and_back(body, law)
    ours = pressed(body, EvenPull(law.pull, law.length, law.end), depths=depths)
    own = pressed(body, rl.Dugdale(law.pull * law.end, law.end), depths=depths)
    for name in ("force", "stiffness", "work", "pulling_fraction"):
        expected = getattr(own, name)
        most = np.abs(expected).max()
        assert getattr(ours, name) == pytest.approx(expected, rel=LOAD, abs=LOAD * most), name


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


HIGHEST = int(posed("H = 0.8", periodic=False)[0].heights.argmax())
LOST_NODES = {"the highest node's bound": HIGHEST, "all bounds": slice(None)}


@pytest.mark.parametrize("lost", LOST_NODES)
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


class FarReaching(PowerLawPull):
    """A law that forgets to bring its length to other units."""

    def scaled(self, pressure, length):
        """Bring the pull to other units, and not the end."""
        return replace(super().scaled(pressure, length), end=self.end)


def test_a_law_that_is_another_one_in_other_units_is_refused():
    hard = Multiplied(np.full((14, 10), 0.3))
    said = r"law has a method Multiplied.scaled\(.*upper bound .*: pressures are to be divided by"
    with pytest.raises(rl.InputError, match=said) as refused:
        rl.press(SURFACE, E_star=1.0, law=hard, depths=[0.05])
    assert "\n" not in str(refused.value)
    with pytest.raises(rl.InputError, match=r"makes the reach .* is right"):
        rl.press(SURFACE, E_star=1.0, law=FarReaching(0.1, 0.01, 0.02), depths=[0.05])


class Swapped(UnevenHardness):
    """A law that tells its bounds in the wrong order."""

    def bounds(self, nodes):
        """Return the hardness, and zero."""
        return super().bounds(nodes)[::-1]


def test_bounds_in_the_wrong_order_are_refused():
    with pytest.raises(rl.InputError, match=r"Swapped.bounds .* the lower one comes first"):
        rl.press(SURFACE, E_star=1.0, law=Swapped(np.ones((14, 10))), depths=[0.05])


def test_loads_are_refused_that_the_bounds_of_a_law_never_bear():
    hard = UnevenHardness(np.linspace(0.5, 1.5, 140).reshape(14, 10))
    with pytest.raises(rl.InputError, match=r"forces\[0\] is 2; a body of mean hardness 1 .* 1.3"):
        rl.press(SURFACE, E_star=1.0, law=hard, forces=[2.0])
    with pytest.raises(rl.InputError, match=r"depths\[0\] is -0.1, negative"):
        rl.press(SURFACE, E_star=1.0, law=hard, depths=[-0.1])
    pull = PowerLawPull(0.1, 0.1, 0.2)
    with pytest.raises(rl.InputError, match="depth 10 is beyond reach: the periodic half-space"):
        rl.press(SURFACE, E_star=1.0, law=pull, depths=[10.0], periodic=True)


class Tacky(PowerLawPull):
    """A law with one formula that another does not fit."""

    def __init__(self, **wrong):
        super().__init__(0.1, 0.1, 0.2)
        vars(self).update(wrong)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"bounds": lambda nodes: (-0.1, 1.0)}, "is Tacky, whose bounds both pull and yield"),
        ({"share_at": lambda gap: 0.5 + 0 * gap}, "Tacky.share_at that is 0.5 at a gap of zero"),
        ({"share_at": lambda gap: 1 + gap}, "Tacky.share_at that rises, or is negative"),
        ({"gap_at": lambda share: share}, "Tacky.gap_at that is not the inverse"),
        ({"work_beyond": lambda gap: 1 - gap}, "Tacky.work_beyond that is not the integral"),
    ],
)
def test_formulas_that_do_not_go_together_are_refused(wrong, said):
    with pytest.raises(rl.InputError, match=said) as refused:
        rl.press(SURFACE, E_star=1.0, law=Tacky(**wrong), depths=[0.05])
    assert "\n" not in str(refused.value)


def test_a_pull_without_shares_is_refused():
    class Shareless(UnevenHardness):
        def bounds(self, nodes):
            return -1.0, np.inf

    with pytest.raises(rl.InputError, match="Shareless.share_at that is 0 at a gap of zero"):
        rl.press(SURFACE, E_star=1.0, law=Shareless(np.ones((14, 10))), depths=[0.05])


def test_a_line_has_no_law():
    line = rl.Line(np.arange(8.0) % 3, length=1.0)
    with pytest.raises(rl.InputError, match="law belongs to the full model"):
        rl.press(line, E_star=1.0, law=rl.Unilateral(), depths=[0.1])


def test_a_law_says_all_that_a_law_is_asked():
    class Speechless(rl.ContactLaw):
        pass

    with pytest.raises(TypeError, match="abstract"):
        Speechless()
