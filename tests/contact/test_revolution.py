"""Bodies of revolution, with and without adhesion, against closed forms and the full model."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import roughline as rl
from random_surfaces import laws
from roughline.exact import adhesion, hess, indenters, mdr, punch

E_STAR, WORK, R = 3.0, 0.02, 2.0
LAW = rl.JKR(WORK)
PULL = math.pi * WORK * R  # unit of the forces on a ball
ROUNDING = 1e-12
BY_SUMS = 1e-5  # of energies, which are summed between radii


def power_law(n, c=0.7, largest=1.0, points=201):
    r = np.linspace(0, largest, points)
    return rl.Profile(r, -c * r**n)


def ball(largest=1.5, points=31):
    return power_law(2.0, 1 / (2 * R), largest, points)


def press(body, law=LAW, **loads):
    return rl.press(body, E_star=E_STAR, law=law, **loads)


# without adhesion


@pytest.mark.parametrize("n", [1.0, 2.0])
@pytest.mark.parametrize("points", [3, 40])
def test_cones_and_paraboloids_are_exact_on_any_number_of_radii(n, points):
    curve = press(power_law(n, points=points), None, depths=[0.01, 0.3, 0.7])
    exact = indenters.PowerLawIndenter(n, 0.7, E_STAR)
    radius = curve.stiffness / (2 * E_STAR)
    assert curve.force == pytest.approx(exact.force(curve.depth), rel=ROUNDING)
    assert exact.depth(radius) == pytest.approx(curve.depth, rel=ROUNDING)
    assert curve.area_fraction == pytest.approx(radius**2, rel=ROUNDING)


@pytest.mark.parametrize("n", [1.5, 2.5, 3.0, 4.0])
def test_errors_of_power_laws_fall_faster_than_the_square_of_the_spacing(n):
    exact = indenters.PowerLawIndenter(n, 0.7, E_STAR)
    depth, points = float(exact.depth(0.5321)), np.array([26, 51, 101, 201, 401])
    errors = [
        press(power_law(n, points=each), None, depths=[depth]).force[0] / exact.force(depth) - 1
        for each in points
    ]
    assert abs(errors[-1]) < 1e-7
    assert np.polyfit(np.log(points), np.log(np.abs(errors)), 1)[0] < -2.5


def test_a_ball_that_is_no_paraboloid_is_that_of_the_quadrature():
    r = np.linspace(0, 1.2, 2001)
    curve = press(rl.Profile(r, np.sqrt(R**2 - r**2)), None, depths=[0.05, 0.2, 0.4])
    for depth, force, radius in zip(
        curve.depth, curve.force, curve.stiffness / (2 * E_STAR), strict=True
    ):
        line = mdr.line_profile(lambda r: r / np.sqrt(R**2 - r**2), np.array([radius]))
        assert line[0] == pytest.approx(depth, rel=1e-6)
        exact = mdr.force(lambda r: r / np.sqrt(R**2 - r**2), radius, E_STAR)
        assert force == pytest.approx(exact, rel=1e-6)


def test_a_flat_end_bears_as_a_disc_and_the_body_ends_as_one():
    disc = press(rl.Profile([0, 0.4], [0.0, 0.0]), None, depths=[0.1, 0.0])
    stiffness = punch.disc_stiffness(E_STAR, 0.4)
    assert disc.stiffness == pytest.approx([stiffness, 0.0])
    assert disc.force == pytest.approx([0.1 * stiffness, 0.0])
    blunt = press(rl.Profile([0, 0.2, 0.5], [0.0, 0.0, -0.3]), None, depths=[1e-9, 5.0, 6.0])
    assert blunt.stiffness[0] == pytest.approx(2 * E_STAR * 0.2, rel=1e-6)
    assert blunt.force[2] - blunt.force[1] == pytest.approx(punch.disc_stiffness(E_STAR, 0.5))
    assert "all of the profile touches" in blunt.warnings[0]


def test_force_and_depth_control_agree_and_the_order_of_loads_does_not_matter():
    by_depth = press(power_law(2.5), None, depths=[0.1, 0.4, 0.2])
    by_force = press(power_law(2.5), None, forces=by_depth.force[::-1])
    assert by_force.depth[::-1] == pytest.approx(by_depth.depth, rel=ROUNDING)
    assert by_depth.work is by_depth.dissipated_work is by_depth.law is None


def test_spaced_forces_run_from_ten_radii_to_all_of_them():
    curve = press(ball(points=121), None, n_loads=8)
    assert curve.area_fraction[[0, -1]] == pytest.approx([1 / 144, 1.0])
    assert np.diff(np.log(curve.force)) == pytest.approx(np.log(curve.force[1] / curve.force[0]))
    assert curve.resolved.all()


# with adhesion


def test_a_ball_is_pulled_off_as_johnson_kendall_and_roberts_have_it():
    held = press(ball(), depths=[0.2, -1.0])
    assert held.pull_off_force == pytest.approx(-1.5 * PULL, rel=1e-9)
    pulled = press(ball(), forces=[0.0, -1.0], throw=False)
    assert pulled.pull_off_force == pytest.approx(-1.5 * PULL, rel=1e-9)
    assert pulled.pull_off_depth == pytest.approx(held.pull_off_depth, rel=1e-4)
    assert pulled.status.tolist() == [rl.Status.CONVERGED, rl.Status.PULLED_OFF]
    assert math.isnan(pulled.force[1])


def test_the_pull_off_of_a_round_tip_converges_in_its_radii():
    """A tip whose slope is r / R - r³ / (4 R³): no paraboloid."""
    sticking = hess.StickingBody(lambda r: r / R - r**3 / (4 * R**3), 1.5, E_STAR, WORK)
    exact = sticking.pull_off_force
    points, errors = np.array([21, 41, 81, 161]), []
    for each in points:
        r = np.linspace(0, 1.5, each)
        tip = rl.Profile(r, -(r**2) / (2 * R) + r**4 / (16 * R**3))
        errors.append(press(tip, depths=[0.1, -1.0]).pull_off_force / exact - 1)
    assert np.abs(errors)[-1] < 1e-6
    assert np.polyfit(np.log(points), np.log(np.abs(errors)), 1)[0] < -2


def test_with_fixed_grips_a_ball_lets_go_at_five_sixths():
    radius = np.cbrt(math.pi * WORK * R**2 / (4 / 3 * E_STAR) / 6)  # a³ = 1/6 in JKR's units
    exact = hess.StickingBody(lambda r: r / R, 1.5, E_STAR, WORK)
    depth = float(exact.depth(radius))
    curve = press(ball(), depths=[0.1, depth * (1 - 1e-9), depth * (1 + 1e-9)])
    assert curve.force == pytest.approx([curve.force[0], -5 / 6 * PULL, 0.0], rel=1e-3)
    assert curve.stiffness[1:] == pytest.approx([2 * E_STAR * radius, 0.0], rel=1e-3)


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0])
def test_power_laws_follow_hesss_branch_under_depths_and_forces(n):
    exact = hess.StickingBody(lambda r: 0.7 * n * r ** (n - 1), 1.0, E_STAR, WORK)
    stretch = 2 * n * indenters.PowerLawIndenter(n, 0.7, E_STAR).stretch * 0.7
    pull_off_radius = (3 * math.sqrt(2 * math.pi * WORK / E_STAR) / stretch) ** (1 / (n - 0.5))
    radii = np.append(0.9, np.linspace(0.6, 1.02 * pull_off_radius, 4))
    for control, values in (("depths", exact.depth(radii)), ("forces", exact.force(radii))):
        curve = press(power_law(n, points=801), **{control: values})
        assert curve.stiffness == pytest.approx(2 * E_STAR * radii, rel=2e-4)
        assert curve.depth == pytest.approx(exact.depth(radii), rel=2e-5, abs=1e-5)
        assert curve.force == pytest.approx(exact.force(radii), rel=2e-5, abs=1e-5)
    drawn = press(power_law(n, points=801), depths=[0.3, -1.0])
    assert drawn.pull_off_force == pytest.approx(exact.force(pull_off_radius), rel=1e-5)


def test_a_cone_and_a_disc_come_off_as_in_closed_form():
    cone = press(power_law(1.0, 0.5, points=2), forces=[0.1, -1.0], throw=False)
    assert cone.pull_off_force == pytest.approx(-54 * WORK**2 / (math.pi * E_STAR * 0.5**3))
    disc = press(rl.Profile([0, 0.4], [0.0, 0.0]), depths=[0.0, 0.1, -1.0])
    assert disc.pull_off_force == pytest.approx(adhesion.punch_pull_off(0.4, WORK, E_STAR))


def test_bodies_jump_together_at_first_touch_and_hold_on_below_it():
    curve = press(ball(), depths=[-0.03, 0.0, 0.1, 0.0, -0.03, -1.0, -0.03])
    assert curve.area_fraction[0] == curve.area_fraction[-1] == curve.force[0] == 0.0
    touching = np.cbrt(2 * math.pi * WORK * R**2 / E_STAR)  # where g = Delta l
    assert curve.stiffness[[1, 3]] == pytest.approx(2 * E_STAR * touching)
    assert curve.force[4] < curve.force[3] < 0
    assert curve.on_approach.tolist() == [True, True, True, False, False, False, True]


def test_what_a_jump_gives_up_is_the_difference_of_energies():
    """At touch 0.6 pi w a² of a ball: the springs store 0.4 of what the area gives."""
    curve = press(ball(), depths=[0.0, 0.3, 0.0, -1.0])
    touching = np.cbrt(2 * math.pi * WORK * R**2 / E_STAR)
    lost = 0.6 * math.pi * WORK * touching**2
    assert curve.dissipated_work[:3] == pytest.approx(lost, rel=BY_SUMS)
    assert curve.work[[0, 2]] == pytest.approx(0.0, abs=BY_SUMS * lost)
    assert curve.work[3] == pytest.approx(curve.dissipated_work[3])  # nothing is stored


def test_work_is_the_integral_of_the_force_over_the_depth():
    depths = np.concatenate([np.linspace(0, 0.3, 400), np.linspace(0.3, -0.07, 400)])
    curve = press(ball(), depths=depths)
    work = np.append(0.0, np.cumsum(np.diff(depths) * (curve.force[1:] + curve.force[:-1]) / 2))
    assert curve.work == pytest.approx(work, abs=1e-4 * np.ptp(work))


def test_a_cycle_encloses_what_it_dissipates_and_ends_apart():
    for body in (ball(), power_law(1.0), power_law(3.0)):
        curve = press(body, n_loads=40)
        assert curve.depth[0] == 0
        assert curve.area_fraction.max() == pytest.approx(1.0)
        assert curve.area_fraction[-1] == 0
        assert (np.diff(curve.dissipated_work) >= 0).all()
        assert curve.dissipated_work[-1] == pytest.approx(curve.work[-1])
        assert curve.dissipated_work[-1] > 0


def test_a_cycle_goes_on_beyond_the_pull_off_where_a_tip_is_drawn_in_whole():
    """Where all of it touches it is a flat punch, pressed until it bears twice the pull-off."""
    r = np.linspace(0, 0.02, 101)
    curve = press(rl.Profile(r, -(r**2) / 2), n_loads=40)
    assert curve.force.max() == pytest.approx(-2 * curve.pull_off_force)
    assert curve.force[-1] == 0


def test_a_wavy_tip_jumps_from_ridge_to_ridge():
    """Where the line of it rises but not by more than the springs at the edge are pulled."""
    r = np.linspace(0, 0.8, 1501)
    slope = r / R + 0.11 * r * np.sin(60 * r)
    tip = rl.Profile(r, -np.append(0, np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(r))))
    depths = np.linspace(0.0, 0.13, 200)
    curve = press(tip, depths=np.append(depths, depths[::-1]))
    nearer, back = curve.stiffness[:200], curve.stiffness[:199:-1]
    assert (np.diff(nearer) > 0).all()
    assert np.diff(nearer).max() > 20 * np.median(np.diff(nearer))  # it jumps
    assert (back >= nearer * (1 - ROUNDING)).all()
    assert (back > 1.02 * nearer).any()
    assert (np.diff(curve.dissipated_work) >= 0).all()
    assert curve.dissipated_work[-1] > 1.001 * curve.dissipated_work[0]


def test_no_work_of_adhesion_is_no_adhesion():
    plain = press(ball(), None, depths=[0.1, 0.3])
    for work in (1e-6, 1e-9, 1e-12):
        least = press(ball(), rl.JKR(work), depths=[0.1, 0.3])
        assert least.force == pytest.approx(plain.force, rel=10 * math.sqrt(work))


def test_units_are_neutral():
    length, pressure = 1e-9, 1e11
    loads = np.array([0.2, 0.05, 0.0, -0.03])
    one = press(ball(), depths=loads)
    r = ball().radii * length
    other = rl.press(
        rl.Profile(r, -(r**2) / (2 * R * length), "m"),
        E_star=E_STAR * pressure,
        law=rl.JKR(WORK * pressure * length),
        depths=loads * length,
    )
    assert other.force == pytest.approx(one.force * pressure * length**2)
    assert other.work == pytest.approx(one.work * pressure * length**3, abs=1e-25)
    assert other.area_fraction == pytest.approx(one.area_fraction)
    assert other.rms_height == pytest.approx(one.rms_height * length)
    assert other.to_dataset().dissipated_work.attrs["units"] == "J"


bodies = hnp.arrays(np.float64, st.integers(2, 40), elements=st.floats(0.01, 1.0))


@laws(bodies, bodies, st.floats(1e-5, 1e-1), st.integers(0, 2**32 - 1))
def test_convex_bodies_dissipate_and_stay_between_touch_and_pull_off(steps, bends, work, seed):
    count = min(steps.size, bends.size)
    r = np.append(0.0, np.cumsum(steps[:count]))
    heights = -np.append(0.0, np.cumsum(np.cumsum(bends[:count]) * steps[:count]))
    body, law = rl.Profile(r, heights), rl.JKR(work)
    cycle = press(body, law, n_loads=12)
    assert cycle.area_fraction[-1] == 0
    rng = np.random.default_rng(seed)
    history = press(body, law, depths=rng.uniform(cycle.depth.min(), cycle.depth.max(), 8))
    assert (np.diff(history.dissipated_work, prepend=0) >= -1e-9 * cycle.work.max()).all()
    plain = press(body, None, depths=np.maximum(history.depth, 1e-9))
    touching = (history.depth > 0) & (history.area_fraction < 1)
    assert (history.area_fraction >= plain.area_fraction * (1 - 1e-9))[touching].all()
    assert (history.force <= plain.force * (1 + 1e-9))[touching].all()
    off = press(body, law, forces=[0.0, 2 * cycle.pull_off_force], throw=False)
    assert off.pull_off_force == pytest.approx(cycle.pull_off_force, rel=1e-6)


def test_the_full_model_comes_to_it_as_the_range_falls():
    """Two ranges of Dugdale's pull, extrapolated to none as their square, on retreat."""
    points, side, work = 96, 3.8, 1 / math.pi
    x = side / points / 2 * (2 * np.arange(points) + 1 - points)
    sphere = rl.Surface(-(x[:, None] ** 2 + x**2) / 2, (side, side), is_cut_out=False)
    loads = {"E_star": 0.75, "depths": [1.0, 0.4, 0.0, -0.3]}
    exact = rl.press(power_law(2.0, 0.5, 2.0), law=rl.JKR(work), **loads).force[1:]
    first, second = (
        rl.press(sphere, law=rl.Dugdale(work, 2 * work / t), **loads).force[1:] for t in (0.75, 1.5)
    )
    assert (4 * second - first) / 3 == pytest.approx(exact, abs=0.03)  # of pi w R
    assert (np.abs(second - exact) < np.abs(first - exact)).all()


# what is told, and what is refused


def test_files_tell_the_law_and_what_sticks(tmp_path):
    curve = press(ball(), n_loads=10)
    data = curve.to_dataset()
    assert data.attrs["law"] == "JKR"
    assert data.attrs["work_of_adhesion"] == WORK
    assert data.attrs["model"] == "reduced"
    assert data.attrs["pull_off_force"] == curve.pull_off_force
    assert {"work", "dissipated_work", "on_approach", "area_fraction"} <= set(data.variables)
    curve.write(tmp_path / "curve.nc")
    curve.write(tmp_path / "curve.csv")
    assert repr(ball()) == "<Profile: 31 radii, largest 1.5>"


def test_a_pull_that_no_contact_bears_is_said():
    with pytest.raises(rl.ConvergenceError, match=r"largest is 0\.1885, at depth -0\.03452"):
        press(ball(), forces=[0.1, -1.0])


WRONG_PROFILES = {
    "radii is [0.1, 1.0]; numbers that rise from zero": ([0.1, 1.0], [0.0, -1.0]),
    "numbers that rise from zero": ([0.0, 1.0, 1.0], [0.0, -1.0, -1.0]),
    "at least two": ([0.0], [0.0]),
    'radii is "radii"': ("radii", [0.0, -1.0]),
    "2 radii and 3 heights": ([0.0, 1.0], [0.0, -1.0, -2.0]),
    "a Profile takes 1": ([0.0, 1.0], [[0.0, -1.0]]),
    "NaN or infinite": ([0.0, 1.0], [0.0, math.nan]),
    "highest on its axis": ([0.0, 1.0], [0.0, 0.5]),
}


@pytest.mark.parametrize("message", WRONG_PROFILES)
def test_what_is_no_profile_is_refused(message):
    with pytest.raises(rl.InputError) as refused:
        rl.Profile(*WRONG_PROFILES[message])
    assert message in str(refused.value)


SURFACE = rl.Surface(np.eye(8), (1.0, 1.0))
REFUSED = {
    "no range of a pull: give law=rl.JKR": (ball(), {"law": rl.Dugdale(0.1, 0.1)}),
    "no yield, and no range": (ball(), {"law": rl.Yielding(0.1)}),
    "the reduced model of a Profile has no yield": (ball(), {"law": None, "hardness": 1.0}),
    "the reduced model of a Profile has none": (ball(), {"periodic": True}),
    "contact radius is the only length": (SURFACE, {}),
    "a rough line has many contacts": (rl.Line(np.arange(8.0), 1.0), {}),
    "or a Profile of a body of revolution": (3, {"law": None}),
    "negative: compression": (ball(), {"law": None, "depths": [0.1, -0.1]}),
    "would not be one disc": (rl.Profile([0, 1, 1.1, 2], [0, -0.1, -1, -1.05]), {}),
    "a flat punch has no range": (rl.Profile([0, 1], [0, 0]), {"depths": None, "n_loads": 5}),
}


@pytest.mark.parametrize("message", REFUSED)
def test_what_the_reduction_method_does_not_have_is_refused_in_one_line(message):
    body, changed = REFUSED[message]
    with pytest.raises(rl.InputError) as refused:
        rl.press(body, **{"E_star": 1.0, "law": LAW, "depths": [0.1], **changed})
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 350


@pytest.mark.parametrize("work", [0.0, -1.0, math.inf, math.nan, "1 J/m2", None])
def test_a_law_without_a_work_is_refused(work):
    with pytest.raises(
        rl.InputError, match="a positive, finite work|a number (without a unit )?is"
    ):
        rl.JKR(work)
