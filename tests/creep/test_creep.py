"""Bodies that creep: the creep function, exact contacts, and steps in time with dense matrices."""

from __future__ import annotations

import math
import re

import mpmath
import numpy as np
import pytest
import xarray
from scipy.integrate import quad

import roughline as rl
from halfspace.dense_contact import BodyOn, DenseContact
from halfspace.test_foreign_half_space import OnRigidBase
from random_cases import cases
from random_problems import E_STAR, random_problem
from roughline.creep.creep import memory_of_stress
from roughline.creep.fading_memory import FadingMemory
from roughline.exact import indenters

ROUNDING = 1e-12
R = 2.0
RUBBER = rl.Creep(shares=[0.3, 0.4], times=[1.0, 100.0])
TIMES = np.array([0.0, 0.1, 1.0, 10.0, 1e3, 1e6])


def power_law(n, c=0.7, largest=1.0):
    r = np.linspace(0, largest, 41)
    return rl.Profile(r, -c * r**n)


def ball():
    return power_law(2.0, 1 / (2 * R))


@pytest.fixture(scope="module")
def surface():
    return rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(32, rng=7)


@pytest.fixture(scope="module")
def line():
    return rl.SelfAffine(hurst=0.8, rms_height=0.01).line(2**12, rng=7)


def random_creep(rng):
    """Few or many times, close or many decades apart, with little or much left in the end."""
    count, decades = int(rng.integers(1, 16)), rng.choice([0.1, 3.0, 8.0])
    left = 10 ** rng.uniform(-3, -0.1)
    times = 10 ** rng.uniform(-decades, decades, count)
    if count > 1 and rng.random() < 0.3:
        times[1] = times[0]
    return rl.Creep((1 - left) * rng.dirichlet(np.ones(count)), times)


# The creep function


def test_one_share_has_the_creep_function_of_the_standard_solid():
    g, tau = 0.7, 3.0
    c, s = g / (1 - g), (1 - g) / tau
    creep, t = rl.Creep(g, tau), np.geomspace(1e-3, 1e3, 20)
    assert creep.relaxation(t) == pytest.approx(1 - g + g * np.exp(-t / tau), rel=ROUNDING)
    assert creep.compliance(t) == pytest.approx(1 + c * (1 - np.exp(-s * t)), rel=ROUNDING)


def test_equal_times_are_one():
    both, t = rl.Creep([0.2, 0.3, 0.1], [2.0, 2.0, 5.0]), np.geomspace(1e-2, 1e3, 20)
    assert both.compliance(t) == pytest.approx(rl.Creep([0.5, 0.1], [2.0, 5.0]).compliance(t))


def test_the_transforms_of_both_functions_are_inverse():
    """Their product is 1 / s² over thirty decades, as well as the rounding of R allows."""
    rng = np.random.default_rng(1)
    for _ in range(cases(200, 5)):
        creep = random_creep(rng)
        memory = memory_of_stress(creep)
        assert (memory.weights <= 0).all()
        with mpmath.workdps(40):
            for s in map(mpmath.mpf, 10 ** rng.uniform(-15, 15, 20)):
                rates = [1 / mpmath.mpf(each) for each in creep.times]
                pairs = zip(creep.shares, rates, strict=True)
                of_R = 1 - mpmath.fsum(g * rate / (s + rate) for g, rate in pairs)
                pairs = zip(memory.weights.tolist(), memory.rates.tolist(), strict=True)
                of_J = memory.end + mpmath.fsum(w * s / (s + rate) for w, rate in pairs)
                assert abs(float(of_R * of_J) - 1) < 1e-14 / creep.relaxed_share


def test_stress_of_the_strain_of_a_constant_stress_is_constant():
    """By quadrature of R(t - s) dJ(s)."""
    rng = np.random.default_rng(2)
    for _ in range(10):
        count = int(rng.integers(1, 6))
        creep = rl.Creep(0.9 * rng.dirichlet(np.ones(count)), 10 ** rng.uniform(-1, 1, count))
        memory = memory_of_stress(creep)

        def rate(s, memory=memory):
            return float(-(memory.weights * memory.rates) @ np.exp(-memory.rates * s))

        for t in (0.05, 1.0, 20.0):
            with_delay = quad(
                lambda s, t=t, creep=creep, rate=rate: float(creep.relaxation(t - s)) * rate(s),
                0,
                t,
                epsabs=1e-13,
                epsrel=1e-12,
                limit=200,
            )[0]
            assert float(creep.relaxation(t)) + with_delay == pytest.approx(1, abs=1e-10)


def test_ends_and_growth_of_both_functions():
    t = np.append(np.geomspace(1e-4, 1e7, 200), np.inf)
    assert RUBBER.relaxed_share == pytest.approx(0.3)
    assert RUBBER.relaxation(0.0) == pytest.approx(1, rel=ROUNDING)
    assert RUBBER.compliance(0.0) == pytest.approx(1, rel=ROUNDING)
    assert RUBBER.relaxation(np.inf) == pytest.approx(0.3, rel=ROUNDING)
    assert RUBBER.compliance(np.inf) == pytest.approx(1 / 0.3, rel=ROUNDING)
    assert (np.diff(RUBBER.relaxation(t)) <= 0).all()
    assert (np.diff(RUBBER.compliance(t)) >= 0).all()
    assert (RUBBER.relaxation(t) * RUBBER.compliance(t) <= 1 + ROUNDING).all()


@pytest.mark.parametrize("seed", range(20))
def test_all_zeros_of_a_sum_of_exponentials_are_found(seed):
    """By counting changes of sign on a fine grid."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 5))
    rates = np.sort(10 ** rng.uniform(-1, 1, count))
    function = FadingMemory(float(rng.normal()), rng.normal(size=count) * 3, rates)
    t = np.linspace(0, 30, 300_001)
    signs = np.sign(function.at(t))
    wanted = t[:-1][signs[:-1] * signs[1:] < 0]
    found = function.zeros(30.0)
    assert len(found) == wanted.size
    assert found == pytest.approx(wanted, abs=1e-4)


def test_a_history_is_superposed_as_by_quadrature():
    times, values = np.array([1.0, 1.5, 4.0, 4.1]), np.array([0.2, 0.7, 0.4, 0.5])
    found = memory_of_stress(RUBBER).superposed(times, values)
    for i, t in enumerate(times):
        wanted = 0.2 * float(RUBBER.compliance(t - 1.0))
        for k in range(i):
            rate = (values[k + 1] - values[k]) / (times[k + 1] - times[k])
            part = quad(lambda s, t=t: float(RUBBER.compliance(t - s)), *times[k : k + 2])[0]
            wanted += rate * part
        assert found[i] == pytest.approx(wanted, rel=ROUNDING)


# Bodies of revolution and lines


@pytest.mark.parametrize("n", [1.0, 2.0])
def test_a_ball_and_a_cone_under_a_constant_force(n):
    """Lee and Radok: an elastic contact of the compliance J(t) / E_0."""
    curve = rl.press_creep(
        power_law(n), RUBBER, times=TIMES, force=0.01, half_space=rl.Homogeneous(3.0)
    )
    for i, t in enumerate(TIMES):
        exact = indenters.PowerLawIndenter(n, 0.7, 3.0 / float(RUBBER.compliance(t)))
        assert exact.force(curve.depth[i]) == pytest.approx(0.01, rel=ROUNDING)
        radius = curve.instantaneous_stiffness[i] / (2 * 3.0)
        assert exact.radius(curve.depth[i]) == pytest.approx(radius, rel=ROUNDING)
        assert curve.area_fraction[i] == pytest.approx(radius**2, rel=ROUNDING)
    assert (curve.force == 0.01).all()
    assert (curve.force_error == 0).all()
    if n == 2:
        radius = curve.instantaneous_stiffness / 6
        curvature = 1 / (2 * 0.7)
        J = RUBBER.compliance(TIMES) / 3.0
        assert radius**3 == pytest.approx(3 / 4 * curvature * 0.01 * J, rel=ROUNDING)


def test_a_ball_at_a_constant_depth_relaxes():
    curve = rl.press_creep(ball(), RUBBER, times=TIMES, depth=0.01, half_space=rl.Homogeneous(3.0))
    wanted = RUBBER.relaxation(TIMES) * 4 / 3 * 3.0 * math.sqrt(R) * 0.01**1.5
    assert curve.force == pytest.approx(wanted, rel=ROUNDING)
    assert (curve.force_error == 0).all()
    assert np.ptp(curve.depth) == np.ptp(curve.area_fraction) == 0


def test_a_ball_under_a_force_that_grows_evenly():
    rate, times = 1e-3, np.array([0.0, 0.5, 3.0, 200.0])
    curve = rl.press_creep(
        ball(), RUBBER, times=times, force=rate * times, half_space=rl.Homogeneous(3.0)
    )
    grown = [quad(lambda s: float(RUBBER.compliance(s)), 0, t)[0] for t in times]
    exact = indenters.paraboloid(R, 3.0)
    assert curve.depth[0] == curve.instantaneous_stiffness[0] == curve.area_fraction[0] == 0
    assert exact.force(curve.depth[1:]) == pytest.approx(rate * np.array(grown[1:]), rel=1e-9)


def force_of_depths(body, times, depths, t):
    """Force at a time under depths that are straight between times, by quadrature."""
    total = body.force(depths[0]) * float(RUBBER.relaxation(t - times[0])) if depths[0] else 0.0
    for k in range(np.searchsorted(times, t)):
        rate = (depths[k + 1] - depths[k]) / (times[k + 1] - times[k])
        if rate:
            total += quad(
                lambda s, k=k, rate=rate: (
                    float(RUBBER.relaxation(t - s))
                    * float(body.stiffness(depths[k] + rate * (s - times[k])))
                    * rate
                ),
                *times[k : k + 2],
                epsabs=1e-15,
                epsrel=1e-12,
            )[0]
    return total


@pytest.mark.parametrize("depths", [[0, 0.004, 0.01, 0.01, 0.02], [0.003, 0.003, 0.004, 0.01, 0.1]])
def test_the_force_of_a_moving_ball_and_its_bounds(depths):
    """It is within its bounds, which are as close as they were asked to be, and far better."""
    times, exact = np.array([1.0, 1.5, 2.0, 22.0, 23.0]), indenters.paraboloid(R, 3.0)
    start = 1 if depths[0] == 0 else 0
    wanted = np.array([force_of_depths(exact, times, depths, t) for t in times[start:]])
    for rtol in (1e-2, 1e-3, 1e-4, 1e-5):
        curve = rl.press_creep(
            ball(), RUBBER, times=times, depth=depths, half_space=rl.Homogeneous(3.0), rtol=rtol
        )
        off = np.abs(curve.force[start:] - wanted)
        assert (curve.force_error <= rtol * curve.force).all()
        assert (off <= curve.force_error[start:] + ROUNDING * wanted).all()
        assert (off < 0.1 * rtol * wanted).all()
        assert curve.elastic_force[start:] == pytest.approx(exact.force(curve.depth[start:]))


def test_the_force_on_a_line_at_moving_depths_is_that_of_each_spring(line):
    """Each spring is pressed from when the body meets it."""
    times, depths = np.array([0.0, 1.0, 3.0, 10.0]), np.array([0.0, 0.01, 0.01, 0.03])
    curve = rl.press_creep(
        line, RUBBER, times=times, depth=depths, half_space=rl.Homogeneous(2.0), rtol=1e-5
    )
    separations = line.heights.max() - line.heights
    for t, found in zip(times[1:], curve.force[1:], strict=True):
        total = 0.0
        for k in range(3):
            if times[k] < t and depths[k + 1] > depths[k]:
                rate = (depths[k + 1] - depths[k]) / (times[k + 1] - times[k])
                met = times[k] + np.maximum(separations - depths[k], 0) / rate
                met = np.minimum(met, times[k + 1])
                # the integral of R(t - s) over s from where a spring is met
                ends = sum(
                    g * tau * (np.exp(-(t - times[k + 1]) / tau) - np.exp(-(t - met) / tau))
                    for g, tau in zip(RUBBER.shares, RUBBER.times, strict=True)
                )
                total += rate * float((0.3 * (times[k + 1] - met) + ends).sum())
        wanted = 2.0 * line.spacing * total
        assert found == pytest.approx(wanted, rel=1e-5)
        i = int(np.searchsorted(times, t))
        assert abs(found - wanted) <= curve.force_error[i] + 1e-12 * wanted


def test_a_line_creeps_as_its_springs_do(line):
    curve = rl.press_creep(line, RUBBER, times=TIMES, force=1e-3, half_space=rl.Homogeneous(2.0))
    springs = rl.press(line, E_star=2.0, forces=1e-3 * RUBBER.compliance(TIMES))
    assert curve.depth == pytest.approx(springs.depth, rel=ROUNDING)
    assert curve.area_fraction is None


# Rough surfaces


@pytest.mark.parametrize("half_space", [
    rl.Homogeneous(1.5),
    rl.Homogeneous(1.5, periodic=True),
    rl.Layered(1.0, 0.45, 0.1, math.inf),
    rl.Layered([1.0, 2.0], [0.45, 0.3], [0.1, 0.1], math.inf, periodic=True),
    OnRigidBase(1.5, 0.1),
])  # fmt: skip
def test_in_the_end_a_contact_is_that_of_the_relaxed_modulus(surface, half_space):
    curve = rl.press_creep(surface, RUBBER, times=[1e9], force=3e-3, half_space=half_space)
    left = RUBBER.relaxed_share
    softer = half_space.in_units(1 / left, 1.0)
    relaxed = rl.press(surface, half_space=softer, forces=[3e-3])
    assert curve.depth == pytest.approx(relaxed.depth, rel=1e-5)
    assert curve.area_fraction == pytest.approx(relaxed.area_fraction, abs=2 / surface.heights.size)
    assert curve.instantaneous_stiffness * left == pytest.approx(relaxed.stiffness, rel=1e-3)


def test_units_and_the_start_of_time_do_not_matter(surface):
    """Times in other units, and a history that begins at another time."""
    force = np.array([1e-3, 2e-3, 1.9e-3])
    depth = np.array([3e-3, 1e-2, 1.2e-2])
    times = np.array([0.0, 2.0, 100.0])
    slower = rl.Creep(RUBBER.shares, np.array(RUBBER.times) * 3600)
    for history in ({"force": force}, {"depth": depth}):
        first = rl.press_creep(
            surface, RUBBER, times=times, half_space=rl.Homogeneous(1.0), **history
        )
        for creep, other in ((RUBBER, times + 7.0), (slower, 3600 * times)):
            again = rl.press_creep(
                surface, creep, times=other, half_space=rl.Homogeneous(1.0), **history
            )
            assert again.depth == pytest.approx(first.depth, rel=1e-6)
            assert again.force == pytest.approx(first.force, rel=1e-6)


def test_a_number_is_a_history_that_stays(surface):
    times = np.array([0.0, 1.0, 50.0])
    for name, value in (("force", 1e-3), ("depth", 1e-2)):
        held = rl.press_creep(
            surface, RUBBER, times=times, half_space=rl.Homogeneous(1.0), **{name: value}
        )
        told = rl.press_creep(
            surface, RUBBER, times=times, half_space=rl.Homogeneous(1.0), **{name: [value] * 3}
        )
        later = rl.press_creep(
            surface, RUBBER, times=50.0, half_space=rl.Homogeneous(1.0), **{name: value}
        )
        for key in ("force", "depth", "instantaneous_stiffness", "area_fraction"):
            np.testing.assert_allclose(getattr(told, key), getattr(held, key), rtol=1e-6)
            np.testing.assert_allclose(getattr(later, key), getattr(held, key)[2:], rtol=1e-6)


def test_a_fast_load_meets_the_instantaneous_stiffness(surface):
    """A depth that grows at once by little, after it was held."""
    held, step, fast = 100.0, 1e-4, 1e-9
    times, depths = [0.0, held, held + fast], [0.01, 0.01, 0.01 + step]
    curve = rl.press_creep(
        surface, RUBBER, times=times, depth=depths, half_space=rl.Homogeneous(1.0), rtol=1e-5
    )
    slope = (curve.force[2] - curve.force[1]) / step
    low, high = curve.instantaneous_stiffness[1:]
    assert low * (1 - 1e-3) <= slope <= high * (1 + 1e-3)
    assert high < 1.02 * low


def test_a_flat_punch_at_moving_depths_and_falls_of_rounding():
    flat = rl.Surface(np.zeros((8, 8)), (1.0, 1.0))
    stiffness = rl.press(flat, E_star=1.0, depths=[0.01]).stiffness[0]
    times, depths = [0.0, 1.0, 5.0, 6.0], [0.0, 0.01, 0.02, 0.02 * (1 - 1e-14)]
    curve = rl.press_creep(
        flat, RUBBER, times=times, depth=depths, half_space=rl.Homogeneous(1.0), rtol=1e-5
    )
    for t, force in zip(times[1:], curve.force[1:], strict=True):
        parts = [(0.0, 1.0, 0.01), (1.0, 5.0, 0.0025)]
        wanted = sum(
            rate * quad(lambda s, t=t: float(RUBBER.relaxation(t - s)), start, end)[0]
            for start, end, rate in parts
            if end <= t
        )
        assert force == pytest.approx(stiffness * wanted, rel=1e-5)


@pytest.mark.parametrize("bodies", [12, cases(300, 5)])
def test_no_pressure_falls_as_a_homogeneous_body_or_a_soft_layer_is_loaded(bodies):
    """What the correspondence principle rests on: increments are those of a rigid punch."""
    rng, share = np.random.default_rng(5), 0.0
    for _ in range(bodies):
        problem = random_problem(rng, 40)
        body = problem.surface
        loads = np.geomspace(1e-5, 10 ** rng.uniform(-2, 2), 8)
        forces = E_STAR * (body.rms_height or 1.0) * body.length * loads
        half_space = rl.Homogeneous(E_STAR, problem.periodic)
        if rng.random() < 0.3:
            thickness = body.length * 10 ** rng.uniform(-0.5, 0.5)
            half_space = rl.Layered(E_STAR, rng.uniform(0, 0.49), thickness, math.inf)
        curve = rl.press(body, half_space=half_space, forces=forces, fields=True)
        for before, after in zip(curve.fields, curve.fields[1:], strict=False):
            falls = np.maximum(before.pressure - after.pressure, 0).sum()
            share = max(share, float(falls / after.pressure.sum()))
    assert share < 1e-6


# Steps in time, with dense matrices


def stepped(body, half_space, creep, times, *, force=None, depth=None):
    """Depths, forces and contacts over time by Euler's backward steps.

    Each share of the modulus has a stress that relaxes, at every point of the surface; elastic
    displacements are K e. Nothing here supposes that the contact grows, or knows a creep function.
    """
    dense = DenseContact(BodyOn.of(body, half_space))
    K, separation, cell = dense.K, dense.body.separation, dense.body.cell
    shares, taus = np.array(creep.shares), np.array(creep.times)
    strain, relaxing = np.zeros(separation.size), np.zeros((shares.size, separation.size))
    found, contacts = [], []
    for i, t in enumerate(times):
        fading = 1 / (1 + (t - times[i - 1]) / taus) if i else np.ones(shares.size)
        modulus = 1 - shares.sum() + shares @ fading
        before = (shares * fading) @ (relaxing - strain)
        shifted = modulus * separation - K @ before
        if force is not None:
            level, pressure = dense.under_force(shifted, force[i], 0.0, np.inf)
        else:
            level, pressure = dense.at_depth(shifted, modulus * depth[i], 0.0, np.inf)
        now = (pressure - before) / modulus
        relaxing, strain = fading[:, np.newaxis] * (relaxing + now - strain), now
        found.append((level / modulus, cell * pressure.sum()))
        contacts.append(pressure > 0)
    return (*np.array(found).T, np.array(contacts))


HISTORIES = {
    "constant force": ("force", [0.0, 300.0], [4e-3, 4e-3]),
    "force that rises and falls": ("force", [0.0, 5.0, 40.0], [1e-3, 6e-3, 5.9e-3]),
    "moving depth": ("depth", [0.0, 5.0, 40.0, 60.0], [2e-3, 8e-3, 8e-3, 1.5e-2]),
}


@pytest.mark.parametrize("half_space", [
    rl.Homogeneous(1.5),
    rl.Homogeneous(1.5, periodic=True),
    rl.Layered(1.0, 0.4, 0.2, math.inf),
], ids=["free", "periodic", "layer"])  # fmt: skip
@pytest.mark.parametrize("history", HISTORIES)
def test_steps_in_time_come_to_the_same_contact(history, half_space):
    """Errors of Euler's steps fall as the steps do, so that two of them give the limit."""
    body = rl.SelfAffine(hurst=0.8, rms_height=0.01).surface(12, rng=4)
    name, at, values = HISTORIES[history]
    curve = rl.press_creep(
        body, RUBBER, times=at, half_space=half_space, rtol=1e-5, **{name: values}
    )
    other = "depth" if name == "force" else "force"
    wanted = getattr(curve, other)[-1]
    ends = []
    for steps in (100, 200, 400):
        fine = np.unique(np.append(at, np.geomspace(1e-2, at[-1], steps)))
        given = np.interp(fine, at, values)
        depth, force, contacts = stepped(body, half_space, RUBBER, fine, **{name: given})
        ends.append(depth[-1] if name == "force" else force[-1])
        assert not (contacts[:-1] & ~contacts[1:]).any()
    off = np.abs(np.array(ends) / wanted - 1)
    assert off[-1] < 4e-3
    assert off[1] / off[2] == pytest.approx(2, rel=0.2)
    assert 2 * ends[2] - ends[1] == pytest.approx(wanted, rel=3e-4)
    touching = curve.area_fraction[-1] * body.heights.size
    assert abs(contacts[-1].sum() - touching) <= 1


@pytest.mark.parametrize("steps", [300, 1200])
def test_a_contact_recedes_when_it_is_said_to(steps):
    """Steps in time lose a point that touched just after the time of the message."""
    body = rl.SelfAffine(hurst=0.8, rms_height=0.01).surface(12, rng=4)
    at, values = [0.0, 10.0, 60.0], [4e-3, 6e-3, 4e-3]
    with pytest.raises(rl.InputError, match="contact recedes from time") as refused:
        rl.press_creep(body, RUBBER, times=at, force=values, half_space=rl.Homogeneous(1.5))
    (when,) = map(float, re.findall(r"from time ([\d.]+) on", str(refused.value)))
    assert 10 < when < 60
    fine = np.linspace(0, 60, steps + 1)
    given = np.interp(fine, at, values)
    depth, _, contacts = stepped(body, rl.Homogeneous(1.5), RUBBER, fine, force=given)
    assert fine[depth.argmax()] == pytest.approx(when, abs=0.2)
    lost = (contacts[:-1] & ~contacts[1:]).any(axis=1)
    assert not lost[fine[1:] < when - 0.2].any()
    assert lost[fine[1:] > when].any()
    before = [0.0, 10.0, 0.999 * when]
    force = np.interp(before, at, values)
    grown = rl.press_creep(body, RUBBER, times=before, force=force, half_space=rl.Homogeneous(1.5))
    assert (np.diff(grown.elastic_force) > 0).all()


# What is refused, and what is told


def test_a_contact_that_recedes_between_the_times_is_found(surface):
    """Under a force that falls, the elastic one rises first and is higher at the last time too."""
    creep, times, force = rl.Creep(0.9, 1.0), [0.0, 1.0, 21.0], [1.0, 3.0, 1.9]
    loads = memory_of_stress(creep).superposed(np.array(times), np.array(force))
    assert (np.diff(loads) > 0).all()
    dense = np.linspace(1, 21, 2001)
    passed = memory_of_stress(creep).superposed(
        np.append(0.0, dense), np.append(1.0, np.interp(dense, times, force))
    )[1:]
    with pytest.raises(rl.InputError, match="recedes from time") as refused:
        rl.press_creep(surface, creep, times=times, force=force, half_space=rl.Homogeneous(1.0))
    (when,) = map(float, re.findall(r"from time ([\d.]+) on", str(refused.value)))
    (elastic,) = map(float, re.findall(r"elastic force of ([\d.]+)", str(refused.value)))
    assert when == pytest.approx(dense[passed.argmax()], abs=0.02)
    assert elastic == pytest.approx(passed.max(), rel=1e-3)


def test_a_stiff_layer_that_bends_is_refused():
    x = np.linspace(-0.5, 0.5, 48)
    body = rl.Surface(-np.add.outer(x**2, x**2) / 2, (1.0, 1.0))
    stiff_on_soft = rl.Layered([100.0, 1.0], [0.3, 0.45], [0.03, 0.2], math.inf)
    with pytest.raises(rl.InputError, match="stiff layer bends"):
        rl.press_creep(body, RUBBER, times=[1e4], force=0.03, half_space=stiff_on_soft)
    still = rl.press_creep(body, RUBBER, times=[0, 1e4], depth=0.01, half_space=stiff_on_soft)
    assert still.force[1] == pytest.approx(0.3 * still.force[0])


REFUSED = {
    "creep": ({"creep": 0.3}, "rl.Creep"),
    "no load": ({"force": None}, "neither force nor depth"),
    "two loads": ({"depth": 1.0}, "both force and depth"),
    "falls": ({"force": [2e-3, 1e-3, 1e-3]}, "contact recedes from time 0"),
    "falls at the end": ({"force": [1e-3, 1e-3, 0.0]}, "contact recedes from time 1"),
    "depth falls": ({"force": None, "depth": [0.1, 0.2, 0.1]}, "falls from 0.2 to 0.1"),
    "pulled": ({"force": -1.0}, "positive"),
    "nothing": ({"force": 0.0}, "positive"),
    "nothing yet": ({"force": [0.0, 0.0, 0.0]}, "positive"),
    "unknown": ({"force": [1e-3, math.nan, 1e-3]}, r"force\[1\] is nan"),
    "text": ({"force": "1 N"}, "not numbers"),
    "too few": ({"force": [1e-3, 1e-3]}, "2 values at 3 times"),
    "unsorted": ({"times": [0.0, 2.0, 1.0]}, "rise"),
    "twice": ({"times": [0.0, 1.0, 1.0]}, "rise"),
    "before": ({"times": [-1.0, 1.0, 2.0]}, "from time zero"),
    "no times": ({"times": []}, "shape"),
    "for ever": ({"times": [0.0, 1.0, math.inf]}, "finite"),
    "hardness": ({"hardness": 1.0}, "no argument hardness="),
    "law": ({"law": rl.Dugdale(1e-3, 1e-2)}, "no argument law="),
    "two bodies": (
        {"half_space": rl.Homogeneous(1.0) + rl.Homogeneous(2.0)},
        "creep alike",
    ),
    "elastic base": (
        {"half_space": rl.Layered(1.0, 0.3, 0.1, 10.0, 0.3)},
        "elastic base",
    ),
    "no half-space": ({"half_space": None}, "an rl.HalfSpace is needed"),
    "tolerance": ({"rtol": 1.0}, "tolerance"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_used_is_refused_in_one_line(surface, case):
    changed, told = REFUSED[case]
    given = {"creep": RUBBER, "times": [0.0, 1.0, 2.0], "force": 1e-3}
    given |= {"half_space": rl.Homogeneous(1.0), **changed}
    with pytest.raises(rl.InputError, match=told) as refused:
        rl.press_creep(surface, **given)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) <= 350


@pytest.mark.parametrize(
    "given",
    [
        *(([0.5, 0.5], [1, 2]), ([0.3, 0.7], [1, 2]), ([0.5], [1, 2]), ([], []), (0.5, -1)),
        *((0.5, math.nan), (math.nan, 1), (0, 1), ("a", 1), (1.5, 1), (-0.1, 1), (0.5, math.inf)),
    ],
)
def test_shares_and_times_that_are_none_are_refused(given):
    with pytest.raises(rl.InputError):
        rl.Creep(*given)


def test_times_before_a_step_are_refused():
    for function in (RUBBER.relaxation, RUBBER.compliance):
        with pytest.raises(rl.InputError, match="not negative"):
            function([1.0, -1.0])


def test_a_dataset_over_time_has_units(surface, tmp_path):
    metres = rl.Surface(surface.heights * 1e-6, (1e-3, 1e-3), "m")
    curve = rl.press_creep(
        metres, RUBBER, times=[0, 1, 10], depth=[0, 1e-8, 2e-8], half_space=rl.Homogeneous(1e7)
    )
    data = curve.to_dataset()
    assert list(data.sizes.items()) == [("time", 3)]
    assert data.force.attrs["units"] == data.elastic_force.attrs["units"] == "N"
    assert data.instantaneous_stiffness.attrs["units"] == "N/m"
    assert data.attrs["creep_times"] == RUBBER.times
    for name in data.data_vars:
        np.testing.assert_array_equal(data[name], getattr(curve, name))
    curve.write(tmp_path / "creep.nc")
    with xarray.open_dataset(tmp_path / "creep.nc", engine="h5netcdf") as written:
        xarray.testing.assert_equal(written, data)
    curve.write(tmp_path / "creep.csv")
    with pytest.raises(rl.InputError, match="ends in neither"):
        curve.write(tmp_path / "creep.txt")
    of_line = rl.press_creep(
        ball(), RUBBER, times=[0, 1], force=1e-3, half_space=rl.Homogeneous(1.0)
    ).to_dataset()
    assert "area_fraction" in of_line
    assert "3 values" in repr(curve)
    assert curve.warnings == curve.elastic.warnings


def test_a_curve_over_time_is_sent_to_where_it_is_drawn():
    curve = rl.press_creep(ball(), RUBBER, times=TIMES, depth=0.01, half_space=rl.Homogeneous(3.0))
    with pytest.raises(
        rl.InputError, match=r"is a CreepCurve; .*to_dataset\(\).area_fraction.plot"
    ):
        rl.plot.curve(curve)
