"""Springs with friction: any history of a body of revolution, against exact solutions and laws."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import roughline as rl
from roughline.exact import indenters, sheared_disc
from roughline.exact.cattaneo_mindlin import CattaneoMindlin
from roughline.exact.mindlin_deresiewicz import CoulombSprings

MU, E_STAR, R, DEPTH = 0.3, 3.0, 2.0, 0.1
ROUNDING = 1e-11
HALF_SPACE = rl.Homogeneous(E_STAR, poisson=0.25)
G_STAR = E_STAR / (1 + 0.25 / 0.75 / 2)
BALL = indenters.paraboloid(R, E_STAR)
r = np.linspace(0, 1.0, 41)
PROFILE = rl.Profile(r, -(r**2) / (2 * R))


def press(profile=PROFILE, half_space=HALF_SPACE, friction=MU, **loads):
    return rl.press(profile, half_space=half_space, friction=rl.Friction(friction), **loads)


def power_law(n, c=0.7):
    radii = np.linspace(0, 1.0, 401 if n not in (1.0, 2.0) else 3)
    return rl.Profile(radii, -c * radii**n)


# Mindlin and Deresiewicz, from another program: forces over the largest, shear forces over mu times
# that, slides over mu (E* / G*) d
HISTORY = np.array(
    [
        (0.5, 0.0, 0.0),
        (0.5, 0.1, 0.08707700),
        (0.5, 0.35, 0.34764972),
        (1.0, 0.35, 0.34764972),
        (1.0, 0.6, 0.52216790),
        (0.8, 0.6, 0.53813625),
        (0.8, -0.2, -0.10404277),
        (1.0, 0.5, 0.41515641),
        (0.6, 0.1, 0.12653507),
    ]
)


def test_mindlin_and_deresiewicz_to_the_last_digit():
    force, shear, slide = HISTORY.T
    most = float(BALL.force(DEPTH))
    curve = press(forces=most * force, shear_forces=MU * most * shear)
    found = curve.slide[:, 0] / (MU * E_STAR / G_STAR * DEPTH)
    assert found == pytest.approx(slide, abs=6e-9)  # of which 5e-9 is that of the digits
    assert not curve.slide[:, 1].any()
    back = press(depths=curve.depth, slides=curve.slide)
    assert back.shear_force == pytest.approx(curve.shear_force, rel=1e-9, abs=1e-12 * most)
    # but for the last load, at whose slope of mu springs may slip or not
    assert back.stick_fraction[:-1] == pytest.approx(curve.stick_fraction[:-1], rel=1e-6)
    assert back.dissipated == pytest.approx(curve.dissipated, rel=1e-6, abs=1e-12 * most)


@pytest.mark.parametrize(("n", "within"), [(1.0, ROUNDING), (2.0, ROUNDING), (3.0, 1e-6)])
def test_a_constant_force_gives_partial_slip_in_closed_form(n, within):
    exact = CattaneoMindlin(indenters.PowerLawIndenter(n, 0.7, E_STAR), DEPTH, G_STAR, MU)
    shear = exact.largest_force * np.array([0.0, 0.3, 0.9, 0.5, -0.7, -0.9, 0.9])
    curve = press(power_law(n), depths=[DEPTH] * 7, shear_forces=shear)
    there, back = slice(0, 3), slice(3, 6)
    Q = shear[2]
    assert curve.slide[there, 0] == pytest.approx(exact.slide(shear[there]), rel=within)
    assert curve.slide[back, 0] == pytest.approx(exact.slide_after(Q, shear[back]), rel=within)
    stick = exact.stick_radius(shear[there])
    radius = curve.stiffness[0] / (2 * E_STAR)
    assert curve.stick_fraction[there] == pytest.approx((stick / radius) ** 2, rel=10 * within)
    assert curve.shear_stiffness[there, 0, 0] == pytest.approx(2 * G_STAR * stick, rel=10 * within)
    assert curve.shear_limit == pytest.approx(exact.largest_force, rel=within)
    # the loop is closed: what it has dissipated is its area
    assert curve.slide[6] == pytest.approx(curve.slide[2], rel=ROUNDING)
    loop = exact.energy_of_cycle(Q)
    assert curve.dissipated[3:].sum() == pytest.approx(loop, rel=max(within, 1e-9))


@pytest.mark.parametrize(("n", "seed"), [(2.0, 0), (1.0, 1), (2.0, 2), (2.0, 3)])
@pytest.mark.parametrize("count", [2**10, 2**14])
def test_random_histories_are_those_of_springs_followed_one_by_one(n, seed, count):
    body, random = indenters.PowerLawIndenter(n, 0.7, E_STAR), np.random.default_rng(seed)
    depths = random.uniform(0.02, DEPTH, 12)
    shear = random.uniform(-0.95, 0.95, 12) * MU * body.force(depths)
    springs = CoulombSprings(body, DEPTH, G_STAR, MU, count)
    slides = np.array([each.slide for each in springs.under(depths, shear)])
    curve = press(power_law(n), depths=depths, shear_forces=shear)
    errors = np.abs(curve.slide[:, 0] - slides) / (MU * E_STAR / G_STAR * DEPTH)
    assert errors.max() < 40 / count**2 + 1e-9


def test_oblique_loading_within_the_cone_of_friction_does_not_slip():
    forces = np.array([0.2, 0.5, 1.0])
    curve = press(forces=forces, shear_forces=0.9 * MU * forces)
    assert curve.slide[:, 0] == pytest.approx(0.9 * MU * E_STAR / G_STAR * curve.depth, rel=1e-12)
    assert (curve.stick_fraction == 1).all()
    assert not curve.dissipated.any()
    assert (curve.shear_stiffness == curve.shear_stiffness_back).all()


def test_a_small_loop_is_forgotten_when_the_load_goes_beyond_it():
    """Springs remember corners of the history, and a larger load wipes smaller ones out."""
    most = MU * float(BALL.force(DEPTH))
    plain = press(depths=[DEPTH] * 3, shear_forces=[0.0, 0.4 * most, 0.8 * most])
    looped = [0.0, 0.4 * most, 0.1 * most, 0.3 * most, -0.2 * most, 0.4 * most, 0.8 * most]
    curve = press(depths=[DEPTH] * 7, shear_forces=looped)
    assert curve.slide[[5, 6]] == pytest.approx(plain.slide[1:], rel=ROUNDING)
    assert curve.dissipated[6] == pytest.approx(plain.dissipated[2], rel=1e-9)


SHARES = st.floats(-0.98, 0.98)
STATES = st.lists(st.tuples(st.floats(0.02, 0.1), SHARES), min_size=2, max_size=5)


@settings(deadline=None, derandomize=True, max_examples=10)
@given(STATES)
def test_cutting_a_way_that_is_straight_in_depth_and_slide_changes_nothing(states):
    depths, slides = np.array(states).T
    slides = slides * MU * E_STAR / G_STAR * DEPTH
    whole = press(depths=depths, slides=slides)
    parts = 4
    at = np.arange(1, parts * depths.size + 1) / parts
    corners = np.arange(depths.size + 1)
    cut = press(
        depths=np.interp(at, corners, np.append(0, depths)),
        slides=np.interp(at, corners, np.append(0, slides)),
    )
    most = MU * float(BALL.force(DEPTH))
    ends = slice(parts - 1, None, parts)
    assert cut.shear_force[ends] == pytest.approx(whole.shear_force, abs=1e-10 * most)
    assert np.add.reduceat(cut.dissipated, corners[:-1] * parts) == pytest.approx(
        whole.dissipated, abs=1e-9 * most * DEPTH
    )
    assert (cut.dissipated >= -1e-12 * most * DEPTH).all()


def test_what_shear_has_worked_is_stored_or_dissipated():
    """A closed history: no energy is stored at its end, as at its start."""
    most = MU * float(BALL.force(DEPTH))
    corners = np.array([(0.02, 0), (0.1, 0.4), (0.06, 0.5), (0.1, -0.6), (0.03, 0.1), (0.0, 0.0)])
    corners *= 1, MU * E_STAR / G_STAR * DEPTH
    errors = []
    for parts in (10, 20, 40):
        at = np.arange(1, 5 * parts + 1) / parts
        depths, slides = (np.interp(at, np.arange(6), each) for each in corners.T)
        depths, slides = np.append(corners[0, 0], depths), np.append(0.0, slides)
        curve = press(depths=depths, slides=slides)
        force = curve.shear_force[:, 0]
        work = np.sum((force[1:] + force[:-1]) / 2 * np.diff(slides))  # by trapezia
        errors.append(work / curve.dissipated.sum() - 1)
    assert abs(errors[-1]) < 1e-3
    assert np.polyfit(np.log([1, 2, 4]), np.log(np.abs(errors)), 1)[0] < -1.5
    assert force[-1] == 0
    assert curve.dissipated.sum() > 0.1 * most * DEPTH * MU


def test_both_stiffnesses_are_those_of_small_steps_on_and_back():
    most = MU * float(BALL.force(DEPTH))
    before = [0.0, 0.6 * most, 0.3 * most]
    curve = press(depths=[DEPTH] * 3, shear_forces=before)
    for step, stiffness in (
        (-1e-7, curve.shear_stiffness[2, 0, 0]),
        (1e-7, curve.shear_stiffness_back[2, 0, 0]),
    ):
        after = press(depths=[DEPTH] * 4, shear_forces=[*before, before[-1] + step * most])
        slope = step * most / (after.slide[3, 0] - after.slide[2, 0])
        assert slope == pytest.approx(stiffness, rel=1e-5)
    assert curve.shear_stiffness[2, 1, 1] == curve.shear_stiffness_back[2, 0, 0]
    assert curve.shear_stiffness_back[2, 0, 0] == pytest.approx(
        sheared_disc.stuck_stiffness(G_STAR, math.sqrt(R * DEPTH)), rel=1e-12
    )


def test_a_flat_end_sticks_until_all_of_it_slides():
    disc = rl.Profile([0, 0.4], [0.0, 0.0])
    limit = MU * 2 * E_STAR * 0.4 * DEPTH
    slides = np.array([0.0, 0.5, 0.99, 1.5, 1.2, 2.0]) * limit / (2 * G_STAR * 0.4)
    curve = press(disc, depths=[DEPTH] * 6, slides=slides)
    shear = np.array([0.0, 0.5, 0.99, 1.0, 0.7, 1.0]) * limit
    assert curve.shear_force[:, 0] == pytest.approx(shear, rel=ROUNDING)
    assert curve.stick_fraction == pytest.approx([1, 1, 1, 0, 1, 0], abs=1e-12)
    slipped = np.diff(slides)[2] - 0.01 * limit / (2 * G_STAR * 0.4)
    assert curve.dissipated[3] == pytest.approx(limit * slipped, rel=1e-9)


def test_a_body_that_slides_bears_mu_times_its_force():
    curve = press(depths=[0.05, 0.1, 0.08], slides=[0.5, 0.8, 1.2])
    assert curve.shear_force[:, 0] == pytest.approx(MU * curve.force, rel=1e-14)
    assert not curve.stick_fraction.any()
    assert not curve.shear_stiffness[:, 0, 0].any()
    # the work of the shear, and what is stored in it less: mu² E* / G* times the normal work
    depths = np.linspace(0.1, 0.08, 2001)
    work = MU * 0.4 * np.trapezoid(BALL.force(depths), dx=1 / 2000)
    stored = MU**2 * E_STAR / G_STAR * 2 / 5 * BALL.force(depths[[0, -1]]) * depths[[0, -1]]
    assert curve.dissipated[2] == pytest.approx(work - np.diff(stored)[0], rel=1e-7)


def test_a_body_that_is_lifted_off_begins_anew():
    most = MU * float(BALL.force(DEPTH))
    first = press(depths=[DEPTH, DEPTH], shear_forces=[0.0, 0.5 * most])
    curve = press(
        depths=[DEPTH, DEPTH, 0, DEPTH, DEPTH], shear_forces=[0, 0.5 * most, 0, 0, 0.5 * most]
    )
    assert curve.slide[[3, 4]] == pytest.approx(first.slide, rel=ROUNDING, abs=1e-14)
    assert curve.drift[[0, 2, 3], 0] == pytest.approx([0, 0, 0], abs=1e-14)
    assert np.isnan(curve.drift[1]).all()
    away = press(depths=[DEPTH, 0, DEPTH], slides=[0.01, 0.05, 0.05])
    assert away.shear_force[1:, 0] == pytest.approx([0.0, 0.0], abs=1e-14)
    assert curve.stick_fraction[2] == curve.shear_stiffness_back[2, 0, 0] == 0


@pytest.mark.parametrize(("length", "pressure"), [(1e-6, 2e11), (1e9, 1e-7)])
def test_units_do_not_matter(length, pressure):
    force, shear, _ = HISTORY.T
    most = float(BALL.force(DEPTH))
    plain = press(forces=most * force, shear_forces=MU * most * shear)
    scaled = press(
        rl.Profile(PROFILE.radii * length, PROFILE.heights * length),
        rl.Homogeneous(E_STAR * pressure, poisson=0.25),
        forces=most * force * pressure * length**2,
        shear_forces=MU * most * shear * pressure * length**2,
    )
    for name, unit in (
        ("slide", length),
        ("shear_stiffness", pressure * length),
        ("dissipated", pressure * length**3),
        ("stick_fraction", 1.0),
        ("shear_limit", pressure * length**2),
    ):
        expected = getattr(plain, name)
        within = 1e-9 * np.abs(expected).max()
        assert getattr(scaled, name) / unit == pytest.approx(expected, rel=1e-9, abs=within)


@pytest.mark.parametrize("angle", [0.7, math.pi])
def test_a_history_along_another_line_is_turned_with_it(angle):
    force, shear, _ = HISTORY.T
    most = float(BALL.force(DEPTH))
    along_x = press(forces=most * force, shear_forces=MU * most * shear)
    axis = np.array([math.cos(angle), math.sin(angle)])
    turn = np.array([axis, [-axis[1], axis[0]]])
    curve = press(forces=most * force, shear_forces=np.outer(MU * most * shear, axis))
    assert curve.slide == pytest.approx(along_x.slide @ turn, rel=1e-12, abs=1e-15)
    assert curve.shear_stiffness == pytest.approx(turn.T @ along_x.shear_stiffness @ turn, rel=1e-9)
    assert curve.dissipated == pytest.approx(along_x.dissipated, rel=1e-9, abs=1e-12)


LINE = rl.SelfAffine(hurst=0.7, rms_height=0.02).line(2**8, rng=7)
SPRING = LINE.spacing  # springs have E* and G* times that


def forces_of_the_line(depths):
    """Its own F(d), under normal loads alone."""
    return rl.press(LINE, E_star=E_STAR, depths=np.atleast_1d(depths)).force


@pytest.mark.parametrize("depth", [0.01, 0.05, 0.2])  # the last one beyond all springs
def test_a_line_obeys_jaegers_principle_with_its_own_force(depth):
    """Q = mu (F(d) - F(d - G* u / (mu E*))), and twice that from a turn on."""
    (force,) = forces_of_the_line(depth)
    shear = MU * force * np.array([0.0, 0.2, 0.6, 0.9, 0.3, -0.5, -0.9, 0.9])
    curve = press(LINE, depths=[depth] * shear.size, shear_forces=shear)
    stuck = G_STAR / (MU * E_STAR)
    slide, turn = curve.slide[:, 0], 3
    rising = forces_of_the_line(depth - stuck * slide[1:4])
    assert MU * (force - rising) == pytest.approx(shear[1:4], rel=1e-12)
    way, back = slide[turn] - slide[4:7], shear[turn] - shear[4:7]
    falling = forces_of_the_line(depth - stuck * way / 2)
    assert 2 * MU * (force - falling) == pytest.approx(back, rel=1e-12)
    assert slide[7] == pytest.approx(slide[turn], rel=1e-12)
    # what a cycle dissipates lies between F(d) and its chord, from the force of what sticks
    inner = depth - stuck * slide[turn]
    separations = LINE.heights.max() - LINE.heights
    between = separations[(separations > inner) & (separations < depth)]
    d = np.concatenate([[inner], np.sort(between), [depth]])
    F = forces_of_the_line(d)  # straight between springs that touch
    chord = np.interp(d, d[[0, -1]], F[[0, -1]])
    loop = 8 * MU**2 * (E_STAR / G_STAR) * np.trapezoid(chord - F, d)
    assert curve.dissipated[turn + 1 :].sum() == pytest.approx(loop, rel=1e-9)
    sticks = np.count_nonzero(separations < inner) / np.count_nonzero(separations < depth)
    assert curve.stick_fraction[turn] == pytest.approx(sticks, rel=1e-12)
    on = G_STAR * SPRING * np.count_nonzero(separations < inner)
    assert curve.shear_stiffness[turn, 0, 0] == pytest.approx(on, rel=1e-12)
    assert curve.shear_stiffness_back[turn, 0, 0] == pytest.approx(
        G_STAR / E_STAR * curve.stiffness[turn], rel=1e-12
    )


def followed(depths, slides, parts=1):
    """Shear forces, and what is dissipated, of the springs of the line one by one."""
    z, shear = LINE.heights.max() - LINE.heights, np.zeros(LINE.heights.size)
    forces, lost, depth, slide = [], [], 0.0, 0.0
    for to_depth, to_slide in zip(depths, slides, strict=True):
        lost.append(0.0)
        corners, slide_step = np.linspace(depth, to_depth, parts + 1), (to_slide - slide) / parts
        for before, now in itertools.pairwise(corners):
            share = np.ones(z.size)
            if now > before:
                share = np.clip((now - z) / (now - before), 0.0, 1.0)
            had, bears = (
                MU * E_STAR * SPRING * np.maximum(each - z, 0.0) for each in (before, now)
            )
            tried = shear + G_STAR * SPRING * share * slide_step
            after = np.clip(tried, -bears, bears)
            lost[-1] += float(((had + bears) / 2 * np.abs(tried - after)).sum() / G_STAR / SPRING)
            shear = after
        forces.append(float(shear.sum()))
        depth, slide = to_depth, to_slide
    return np.array(forces), np.array(lost)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_random_histories_of_a_line_are_those_of_its_springs_one_by_one(seed):
    random = np.random.default_rng(seed)
    depths = random.uniform(0.0, 0.1, 16)
    slides = random.uniform(-1, 1, 16) * 1.5 * MU * E_STAR / G_STAR * 0.1
    curve = press(LINE, depths=depths, slides=slides)
    forces, _ = followed(depths, slides)
    most = MU * curve.force.max()
    assert curve.shear_force[:, 0] == pytest.approx(forces, abs=1e-12 * most)
    _, lost = followed(depths, slides, parts=400)
    assert curve.dissipated == pytest.approx(lost, rel=1e-3, abs=1e-4 * lost.max())
    shares = random.uniform(-0.95, 0.95, 16)
    held = press(LINE, forces=curve.force, shear_forces=shares * curve.shear_limit)
    again = press(LINE, depths=held.depth, slides=held.slide)
    assert again.shear_force == pytest.approx(held.shear_force, abs=1e-10 * most)
