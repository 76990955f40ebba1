"""Friction against exact solutions: spheres, discs, oblique loads, two materials."""

from math import acos, pi, sqrt

import numpy as np
import pytest

import roughline as rl

MU = 0.3
NO_SIDE = rl.Homogeneous(1.0, poisson=0.0)  # no displacement across shear: G* = E*
RADIUS = 0.3  # of the contact of a sphere of radius one
DEPTH, FORCE = RADIUS**2, 4 / 3 * RADIUS**3


def sphere(n):
    x = (np.arange(n) + 0.5) / n - 0.5
    return rl.Surface(-(x[:, np.newaxis] ** 2 + x**2) / 2, sizes=(1.0, 1.0))


def disc(n, radius=0.4):
    x = (np.arange(n) + 0.5) / n - 0.5
    inside = np.hypot(x[:, np.newaxis], x) < radius
    surface = rl.Surface(np.where(inside, 0.0, -1.0), sizes=(1.0, 1.0))
    return surface, sqrt(inside.sum() / pi) / n  # the radius of the same area


HARDNESS = 0.1  # of rough bodies, at which a part of them yields


def rough(n, seed=7):
    return rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(n, rng=seed)


PATH = [(0.5, 0), (0.5, 0.1), (0.5, 0.35), (1, 0.35), (1, 0.6), (0.8, 0.6), (0.8, -0.2)]
PATH += [(1, 0.5), (0.6, 0.1)]
SLIDES = [0, 0.08707700, 0.34764972, 0.34764972, 0.52216790, 0.53813625, -0.10404277]
SLIDES += [0.41515641, 0.12653507]


@pytest.mark.parametrize(("n", "error"), [(32, 4e-4), (64, 3e-5)])
def test_a_sphere_follows_the_springs_of_mindlin_and_deresiewicz(n, error):
    """Along any history, in one step a load: springs with friction are exact of n = 0."""
    curve = rl.press(
        sphere(n),
        half_space=NO_SIDE,
        friction=rl.Friction(MU),
        forces=[f * FORCE for f, _ in PATH],
        shear_forces=[q * MU * FORCE for _, q in PATH],
    )
    assert curve.slide[:, 0] / (MU * DEPTH) == pytest.approx(SLIDES, abs=error)
    assert abs(curve.slide[:, 1]).max() < 1e-12


@pytest.mark.parametrize(("n", "error"), [(32, 2e-2), (64, 1e-3)])
def test_a_cycle_dissipates_what_cattaneo_and_mindlin_say(n, error):
    share = 0.7
    shears = rl.cycle(share * MU * FORCE, per_cycle=4, cycles=1)
    curve = rl.press(
        sphere(n),
        half_space=NO_SIDE,
        friction=rl.Friction(MU),
        forces=[FORCE] * len(shears),
        shear_forces=shears,
    )
    bracket = 1 - (1 - share) ** (5 / 3) - 5 * share / 6 * (1 + (1 - share) ** (2 / 3))
    expected = 3.6 * (MU * FORCE) ** 2 / RADIUS * bracket
    assert curve.dissipated[-4:].sum() == pytest.approx(expected, rel=error)
    assert curve.drift[-4, 0] > 0 > curve.drift[-2, 0]


def jaeger(surface, force, shear, **bodies):
    """Return slide and traction by the theorem of Ciavarella and Jäger, with n = 0.

    Bodies that have yielded unload as elastic ones.
    """
    forces = [force, force - shear / MU]
    curve = rl.press(surface, forces=forces, fields=True, rtol=1e-9, **bodies)
    slipping = curve.fields[0].pressure - curve.fields[1].pressure
    return MU * (curve.depth[0] - curve.depth[1]), MU * slipping


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("n", [32, 64])
@pytest.mark.parametrize("hardness", [None, HARDNESS])
def test_rough_bodies_slip_as_the_difference_of_two_normal_contacts(n, periodic, hardness):
    surface, force = rough(n), 0.02
    bodies = {"half_space": rl.Homogeneous(1.0, periodic, poisson=0.0), "hardness": hardness}
    shears = [share * MU * force for share in (0.3, 0.7, 0.95)]
    curve = rl.press(
        surface,
        friction=rl.Friction(MU),
        forces=[force] * 4,
        shear_forces=[0.0, *shears],
        fields=True,
        rtol=1e-8,
        **bodies,
    )
    assert (curve.plastic_fraction > 0.1).all() or hardness is None
    for load, shear in enumerate(shears, 1):
        slide, traction = jaeger(surface, force, shear, **bodies)
        assert curve.slide[load, 0] == pytest.approx(slide, rel=1e-6)
        largest = MU * curve.fields[load].pressure.max()
        assert curve.fields[load].shear[..., 0] == pytest.approx(traction, abs=1e-5 * largest)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("steps", [1, 3])
def test_oblique_loading_below_the_friction_angle_slips_nowhere(steps, periodic):
    """In any number of steps: nodes that join slip from their contact on."""
    surface, slope = rough(32), MU / 2
    depths = np.linspace(0.0, 0.02, steps + 1)[1:]
    body = rl.Homogeneous(1.0, periodic, poisson=0.0)
    told = rl.press(surface, half_space=body, depths=depths, rtol=1e-9)
    curve = rl.press(
        surface,
        half_space=body,
        friction=rl.Friction(MU),
        forces=told.force,
        shear_forces=slope * told.force,
        rtol=1e-9,
    )
    assert curve.slide[:, 0] == pytest.approx(slope * depths, rel=1e-7)
    assert (curve.stick_fraction == 1).all()
    assert curve.dissipated == pytest.approx(0.0, abs=1e-12 * curve.force[-1])


@pytest.mark.parametrize(("n", "error"), [(32, 1e-3), (64, 3e-4)])
@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
def test_a_strength_lets_a_ring_of_a_disc_slip(share, n, error):
    """Strength tau beyond the radius c: Q and the slide are those of a crack's plastic zone."""
    surface, a = disc(n)
    c, strength = share * a, 0.02
    force = 2 * strength * (a * a * acos(c / a) + c * sqrt(a * a - c * c))
    slide = 2 * strength * sqrt(a * a - c * c)
    friction = rl.Friction(strength=strength)
    given = {"half_space": NO_SIDE, "friction": friction, "forces": [1.0]}
    curve = rl.press(surface, shear_forces=[force], **given)
    assert curve.slide[0, 0] == pytest.approx(slide, rel=error)
    assert sqrt(curve.stick_fraction[0]) == pytest.approx(share, abs=0.5 / n)


@pytest.mark.parametrize(
    ("poisson", "beta", "mu", "stiffer", "sticks"),
    [
        (0.3, 2 / 7, 5.0, 1.028626664, None),  # full stick, Mossakovskii: but for the last cell
        (0.0, 0.5, 5.0, 1.098612289, None),
        (0.3, 2 / 7, 0.3, 1.024297, 0.8959447),  # Spence
        (0.0, 0.5, 0.2, 1.035950, 0.2208566),
    ],
)
def test_a_flat_disc_of_another_material_is_as_stiff_as_spence_says(
    poisson, beta, mu, stiffer, sticks
):
    n = 32
    surface, _ = disc(n)
    plain = rl.press(surface, half_space=NO_SIDE, depths=[1e-3])
    coupled = rl.Homogeneous(1.0, poisson=poisson, beta=beta)
    curve = rl.press(surface, half_space=coupled, friction=rl.Friction(mu), depths=[1e-3])
    within = 2e-4 if sticks else 0.04 * (stiffer - 1)
    assert curve.force[0] / plain.force[0] == pytest.approx(stiffer, abs=within)
    assert np.hypot(*curve.slide[0]) < 1e-12
    if sticks:
        assert sqrt(curve.stick_fraction[0]) == pytest.approx(sticks, abs=1.0 / n)
    assert curve.stiffness[0] == pytest.approx(curve.force[0] / 1e-3, rel=1e-4)


@pytest.mark.parametrize("angle", [0, 90, 210])
def test_oblique_loading_with_a_side_slips_the_same_way_round(angle):
    """With Poisson's ratio of 0.3 it is exact but for the displacement across shear."""
    surface, turn = rough(32), np.deg2rad(angle)
    force = 0.02 * MU / 2 * np.array([np.cos(turn), np.sin(turn)])
    asked = {"half_space": rl.Homogeneous(1.0, poisson=0.3), "friction": rl.Friction(MU)}
    once = rl.press(surface, forces=[0.02], shear_forces=[force], **asked)
    finely = rl.press(
        surface,
        forces=np.linspace(0.0, 0.02, 9)[1:],
        shear_forces=np.outer(np.arange(1, 9) / 8, force),
        **asked,
    )
    assert once.slide[0] == pytest.approx(finely.slide[-1], abs=4e-3 * np.hypot(*once.slide[0]))


@pytest.mark.parametrize(
    ("n", "steps", "within"), [(32, 1, 0.08), (32, 4, 0.02), (64, 4, 0.005), (64, 8, 0.01)]
)
def test_a_sphere_of_another_material_sticks_where_spence_says(n, steps, within):
    """Whatever the steps: nodes at their bound slip on or stick as the rates say."""
    depths = DEPTH * (np.geomspace(0.25, 1, steps) if steps > 1 else np.ones(1))
    curve = rl.press(
        sphere(n),
        half_space=rl.Homogeneous(1.0, poisson=0.3, beta=2 / 7),
        friction=rl.Friction(MU),
        depths=depths,
    )
    assert sqrt(curve.stick_fraction[-1]) == pytest.approx(0.8959447, abs=within)


def test_of_a_sphere_that_turns_back_all_sticks_and_going_on_what_did():
    """The same loads in more steps show the same: a load that stands asks as the one before."""
    force = MU * FORCE
    shears = [0.0, 0.3 * force, 0.6 * force, 0.6 * force, 0.6 * force]
    forces = [FORCE, FORCE, FORCE, FORCE, 1.02 * FORCE]
    asked = {"half_space": NO_SIDE, "friction": rl.Friction(MU)}
    curve = rl.press(sphere(32), forces=forces, shear_forces=shears, **asked)
    sticks = curve.stick_fraction
    assert sqrt(sticks[2]) == pytest.approx(0.4 ** (1 / 3), abs=0.03)
    assert sticks[3] == sticks[2]
    assert sticks[4] == 1  # the bound grows and the shear does not: nothing slips on
    assert curve.shear_stiffness[4] == pytest.approx(curve.shear_stiffness_back[4])


@pytest.mark.parametrize("control", ["shear_forces", "slides"])
def test_a_sphere_that_is_lifted_off_comes_back_as_springs_do(control):
    """History is tractions and the slide: of bodies that came off, where the highest point was."""
    radii = np.linspace(0, 0.6, 201)
    springs = rl.Profile(radii, -(radii**2) / 2)
    forces = FORCE * np.array([1, 1, 0, 1, 0.8, 0, 0.5])
    along = {
        "shear_forces": MU * FORCE * np.array([0, 0.7, 0, 0.3, -0.4, 0, 0.2]),
        "slides": MU * DEPTH * np.array([0.2, 1.6, 1.6, 1.9, 1.0, 0.9, 1.1]),
    }[control]
    asked = {"half_space": NO_SIDE, "friction": rl.Friction(MU), "forces": forces, control: along}
    full, reduced = rl.press(sphere(32), **asked), rl.press(springs, **asked)
    assert full.slide[:, 0] == pytest.approx(reduced.slide[:, 0], abs=2e-3 * MU * DEPTH)
    assert full.shear_force[:, 0] == pytest.approx(reduced.shear_force[:, 0], abs=2e-3 * MU * FORCE)
    if control == "shear_forces":
        assert full.slide[[2, 5], 0] == pytest.approx(0.0, abs=2e-3 * MU * DEPTH)


def test_a_sphere_that_slid_before_it_came_off_stays_where_it_slid_to():
    """Of bodies that slid by two slides before, springs and nodes tell the same place."""
    radii = np.linspace(0, 0.6, 201)
    asked = {"half_space": NO_SIDE, "friction": rl.Friction(MU)}
    slides = MU * DEPTH * np.array([0.0, 2.0])
    for body in (sphere(32), rl.Profile(radii, -(radii**2) / 2)):
        slid = rl.press(body, forces=[FORCE] * 2, slides=slides, **asked)
        assert slid.shear_force[1, 0] == pytest.approx(slid.shear_limit[1], rel=1e-6)
    shears = MU * FORCE * np.array([0.999, -0.999, 0.0, 0.0])
    forces = [FORCE, FORCE, FORCE, 0.0]
    left = [
        rl.press(body, forces=forces, shear_forces=shears, **asked).slide[:, 0]
        for body in (sphere(32), rl.Profile(radii, -(radii**2) / 2))
    ]
    assert left[0] == pytest.approx(left[1], abs=5e-3 * MU * DEPTH)


def test_two_materials_that_come_nearer_are_much_the_same_in_few_steps():
    """Nodes that join leave out what they were moved before; four steps do what sixteen do."""
    body = rl.Homogeneous(1.0, poisson=0.3, beta=2 / 7)
    asked = {"half_space": body, "friction": rl.Friction(MU)}
    found = {}
    for steps in (1, 2, 4, 8):
        depths = DEPTH * np.arange(1, steps + 1) / steps
        found[steps] = rl.press(sphere(32), depths=depths, **asked).force[-1]
    off = [abs(found[steps] / found[8] - 1) for steps in (1, 2, 4)]
    assert off[0] < 5e-3
    assert off[1] < 1e-3
    assert off[2] < 2e-4


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("hardness", [None, HARDNESS])
def test_what_shear_does_is_stored_or_dissipated(periodic, hardness):
    """W - U - D = 0 with tractions in the middle of each step, on one material."""
    surface, force = rough(32), 0.02
    body = rl.Homogeneous(1.0, periodic, poisson=0.3)
    shears = [(0, 0), (0.5, 0.1), (0.7, 0.3), (0.1, 0.3), (-0.6, 0.0)]
    shears = [(MU * force * x, MU * force * y) for x, y in shears]
    curve = rl.press(
        surface,
        half_space=body,
        friction=rl.Friction(MU),
        forces=[force] * 5,
        shear_forces=shears,
        hardness=hardness,
        fields=True,
        rtol=1e-9,
    )
    area = np.prod(surface.spacing)
    for load in range(1, 5):
        before, after = curve.fields[load - 1], curve.fields[load]
        sliding = curve.slide[load] - curve.slide[load - 1]
        middle = (before.shear + after.shear) / 2
        done = area * middle.sum(axis=(0, 1)) @ sliding
        lost = area * (middle * after.slip).sum()
        moved = np.where(after.contact[..., np.newaxis], sliding - after.slip, 0.0)
        stored = area * (middle * moved).sum()
        assert done - stored - lost == pytest.approx(0.0, abs=1e-12 * abs(done))
        assert curve.dissipated[load] >= lost >= 0
        assert curve.dissipated[load] == pytest.approx(
            area * (after.shear * after.slip).sum(), rel=1e-10
        )


@pytest.mark.parametrize("angle", [0.0, 30.0, 150.0, 180.0])
@pytest.mark.parametrize("hardness", [None, HARDNESS])
def test_tangents_are_those_of_small_steps(angle, hardness):
    """Going on within a cone about the last increment, turning back within another."""
    surface, depth, small = rough(16), 0.02, 1e-6
    last = np.array([4e-4, 1e-4])
    turn = np.deg2rad(angle)
    turned = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    way = small * turned @ last / np.hypot(*last)
    curve = rl.press(
        surface,
        half_space=rl.Homogeneous(1.0, poisson=0.3),
        friction=rl.Friction(MU),
        depths=[depth] * 4,
        slides=[(0, 0), 4 * last, 5 * last, 5 * last + way],
        hardness=hardness,
        rtol=1e-12,
        solver=rl.Solver(precision="float64"),
    )
    assert 0.05 < curve.stick_fraction[2] < 0.95
    tangent = (curve.shear_stiffness if angle < 90 else curve.shear_stiffness_back)[2]
    change = curve.shear_force[3] - curve.shear_force[2]
    assert change == pytest.approx(tangent @ way, abs=3e-3 * small * tangent[0, 0])
    assert tangent == pytest.approx(tangent.T)


@pytest.mark.parametrize("hardness", [None, HARDNESS, HARDNESS / 2])
@pytest.mark.parametrize(("first", "shear"), [(0.01, 0.0029), (0.019, 0.004)])
def test_what_slips_on_is_what_slips_in_a_small_further_step(hardness, first, shear):
    """Nodes that yield bear no more, and slip only where they have all the shear that they bear."""
    way = 1 + 1e-5
    curve = rl.press(
        rough(48),
        half_space=rl.Homogeneous(1.0, poisson=0.3),
        hardness=hardness,
        friction=rl.Friction(MU),
        forces=[first, 0.02, first + (0.02 - first) * way],
        shear_forces=[0.0, shear, shear * way],
        fields=True,
        rtol=1e-12,
        solver=rl.Solver(precision="float64"),
    )
    pressed, before, after = curve.fields
    known = (pressed.contact & before.contact) | before.plastic
    slid = np.hypot(*(curve.slide[2] - curve.slide[1]))
    slips = np.hypot(after.slip[..., 0], after.slip[..., 1]) > 1e-4 * slid
    assert (slips[known] == ~before.stick[known]).all()
    assert 0.01 < slips[known].mean() < 0.6


@pytest.mark.parametrize("hardness", [None, HARDNESS])
@pytest.mark.parametrize(("angle", "beta"), [(0.0, 2 / 7), (20.0, 0.5), (180.0, 2 / 7)])
def test_tangents_of_two_materials_are_those_of_small_steps(angle, beta, hardness):
    surface, small, force = rough(16), 1e-6, 0.02
    last, turn = np.array([4e-4, 1e-4]), np.deg2rad(angle)
    turned = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    way = small * turned @ last / np.hypot(*last)
    curve = rl.press(
        surface,
        half_space=rl.Homogeneous(1.0, poisson=0.3, beta=beta),
        friction=rl.Friction(MU),
        forces=[force] * 4,
        slides=[(0, 0), 4 * last, 5 * last, 5 * last + way],
        hardness=hardness,
        rtol=1e-11,
        solver=rl.Solver(precision="float64"),
    )
    assert 0.05 < curve.stick_fraction[2] < 0.95
    assert hardness is None or curve.plastic_fraction[2] > 0.02
    tangent = (curve.shear_stiffness if angle < 90 else curve.shear_stiffness_back)[2]
    change = curve.shear_force[3] - curve.shear_force[2]
    assert change == pytest.approx(tangent @ way, abs=3e-3 * small * tangent[0, 0])
    back = curve.shear_stiffness_back  # Betti: where all sticks each way answers the other alike
    assert back == pytest.approx(back.transpose(0, 2, 1), abs=1e-12 * tangent[0, 0])


@pytest.mark.parametrize("hardness", [None, HARDNESS])
@pytest.mark.parametrize("beta", [0.0, 2 / 7])
def test_bodies_that_come_apart_bear_nothing_and_come_again(beta, hardness):
    curve = rl.press(
        rough(16),
        half_space=rl.Homogeneous(1.0, poisson=0.3, beta=beta),
        friction=rl.Friction(MU),
        hardness=hardness,
        forces=[0.02, 0.0, 0.005],
        shear_forces=[1e-3, 0.0, 5e-4],
    )
    assert curve.force == pytest.approx([0.02, 0.0, 0.005])
    assert curve.area_fraction[1] == 0
    assert np.isfinite(curve.slide).all()
    assert (curve.depth[1] > 0) == (hardness is not None)


@pytest.mark.parametrize("beta", [0.0, 2 / 7, 0.5])
@pytest.mark.parametrize("more", [1, -1])
def test_stiffness_of_two_materials_that_yield_is_that_of_small_steps(beta, more):
    """On more load nodes at the hardness follow no further, on less they do."""
    force, small = 0.02, 1e-6
    curve = rl.press(
        rough(16),
        half_space=rl.Homogeneous(1.0, poisson=0.3, beta=beta),
        friction=rl.Friction(MU),
        hardness=HARDNESS,
        forces=[0.99 * force, force, force * (1 + more * small)],
        rtol=1e-12,
        solver=rl.Solver(precision="float64"),
    )
    assert curve.plastic_fraction[1] > 0.1
    stiffness = (curve.stiffness if more > 0 else curve.unloading_stiffness)[1]
    expected = np.diff(curve.force)[1] / np.diff(curve.depth)[1]
    assert stiffness == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("beta", [0.0, 2 / 7])
@pytest.mark.parametrize(
    ("name", "turned", "matrix"),
    [
        ("mirrored", lambda z: z[::-1], [[-1, 0], [0, 1]]),
        ("transposed", lambda z: z.T, [[0, 1], [1, 0]]),
        ("turned by 90 degrees", lambda z: np.rot90(z), [[0, -1], [1, 0]]),
        ("rolled", lambda z: np.roll(z, (3, 5), (0, 1)), [[1, 0], [0, 1]]),
    ],
)
def test_a_body_that_is_moved_answers_alike(name, turned, matrix, beta):
    heights = rough(16).heights
    body = rl.Homogeneous(1.0, periodic=name == "rolled", poisson=0.3, beta=beta)
    depths, slides = [0.004, 0.006], np.array([(2e-4, 1e-4), (5e-4, -2e-4)])
    asked = {"half_space": body, "friction": rl.Friction(MU), "depths": depths, "rtol": 1e-9}
    matrix = np.array(matrix, float)
    one = rl.press(rl.Surface(heights, sizes=(1.0, 1.0)), slides=slides, **asked)
    moved = rl.Surface(np.ascontiguousarray(turned(heights)), sizes=(1.0, 1.0))
    other = rl.press(moved, slides=slides @ matrix.T, **asked)
    scale = abs(one.shear_force).max()
    assert other.shear_force == pytest.approx(one.shear_force @ matrix.T, abs=1e-7 * scale)
    assert other.dissipated == pytest.approx(one.dissipated, abs=1e-7 * scale * 5e-4)


@pytest.mark.parametrize("beta", [0.0, 2 / 7])
def test_units_change_nothing(beta):
    surface, length, pressure = rough(16), 1e-6, 2e11
    scaled = rl.Surface(surface.heights * length, sizes=(length, length))
    body = rl.Homogeneous(1.0, poisson=0.3, beta=beta)
    other = rl.Homogeneous(pressure, poisson=0.3, beta=beta)
    slides = np.array([(2e-4, 1e-4), (5e-4, -2e-4)])
    friction = rl.Friction(MU, strength=0.02)
    one = rl.press(
        surface, half_space=body, friction=friction, depths=[0.004, 0.006], slides=slides
    )
    two = rl.press(
        scaled,
        half_space=other,
        friction=rl.Friction(MU, strength=0.02 * pressure),
        depths=[0.004 * length, 0.006 * length],
        slides=slides * length,
    )
    force = pressure * length**2
    assert two.shear_force / force == pytest.approx(one.shear_force, rel=1e-9, abs=1e-15)
    assert two.shear_limit / force == pytest.approx(one.shear_limit, rel=1e-9)
    if beta == 0:
        stiffness = two.shear_stiffness / (pressure * length)
        assert stiffness == pytest.approx(one.shear_stiffness, rel=1e-7, abs=1e-9)


@pytest.mark.parametrize("beta", [2 / 7, -0.5])
@pytest.mark.parametrize("hardness", [None, HARDNESS])
def test_two_materials_that_are_unloaded_are_where_one_is(beta, hardness):
    """Nothing bears shear any more, and nothing is lifted by it."""
    surface, force = rough(16), 0.02
    body = rl.Homogeneous(1.0, "x", poisson=0.3, beta=beta)
    shears = 0.3 * force * np.array([0, 0.5, 0, 0.2, 0])
    asked = {"half_space": body, "friction": rl.Friction(0.3), "hardness": hardness, "fields": True}
    forces = [force, force, 0, force / 2, 0]
    curve = rl.press(surface, forces=forces, shear_forces=shears, **asked)
    dents = curve.fields[2].indentation
    for load in (2, 4):
        fields = curve.fields[load]
        separation = surface.heights.max() - surface.heights + fields.indentation
        assert curve.depth[load] == pytest.approx(separation.min(), abs=1e-12)
        assert fields.gap == pytest.approx(separation - curve.depth[load], abs=1e-12)
        assert fields.indentation == pytest.approx(dents, abs=1e-12)
    if hardness is None:
        again = rl.press(surface, depths=curve.depth, shear_forces=shears, **asked)
        assert again.force == pytest.approx(curve.force, rel=1e-4, abs=1e-12)


@pytest.mark.parametrize("beta", [0.0, 2 / 7])
@pytest.mark.parametrize("periodic", [False, True])
def test_a_strength_that_nothing_reaches_is_as_good_as_any_larger_one(beta, periodic):
    body = rl.Homogeneous(1.0, periodic, poisson=0.3, beta=beta)
    slides = [
        rl.press(
            rough(16),
            half_space=body,
            friction=rl.Friction(strength=strength),
            forces=[0.02, 0.02],
            shear_forces=[0.0, 1e-3],
        ).slide
        for strength in (1e2, 1e4, 1e8)
    ]
    for each in slides[1:]:
        assert each == pytest.approx(slides[0], abs=1e-5 * abs(slides[0]).max())


@pytest.mark.parametrize("control", ["shear_forces", "slides"])
@pytest.mark.parametrize("beta", [0.0, 2 / 7])
@pytest.mark.parametrize(
    "friction", [rl.Friction(MU), rl.Friction(strength=0.02), rl.Friction(MU, strength=0.02)]
)
def test_a_load_that_is_repeated_changes_nothing(control, beta, friction):
    """Nothing slips further, and what sticks if loads go on is as it was."""
    forces = np.repeat([0.01, 0.02, 0.015], 2)
    along = {"shear_forces": [1e-3, 2e-3, -1e-3], "slides": [1e-3, 6e-3, 4e-3]}[control]
    curve = rl.press(
        rough(16),
        half_space=rl.Homogeneous(1.0, poisson=0.3, beta=beta),
        friction=friction,
        forces=forces,
        **{control: np.repeat(along, 2)},
    )
    for name in ("depth", "slide", "shear_force", "stick_fraction", "shear_stiffness"):
        values = getattr(curve, name)
        assert np.array_equal(values[::2], values[1::2]), name
    assert (curve.dissipated[1::2] == 0).all()
    assert (curve.stick_fraction[::2] < 1).any()


def test_a_node_that_joins_sticks_until_it_bears_all_of_a_strength():
    """What it bears does not follow its pressure, so that it is not at its bound as it joins."""
    curve = rl.press(
        rough(16),
        half_space=rl.Homogeneous(1.0, poisson=0.3),
        friction=rl.Friction(strength=0.02),
        forces=[0.01, 0.02],
        slides=[0.0, 5e-3],
        fields=True,
    )
    fields = curve.fields[1]
    full = np.hypot(*np.moveaxis(fields.shear, 2, 0)) >= 0.02 * (1 - 1e-9)
    assert 0 < full.sum() < fields.contact.sum()
    assert fields.stick[fields.contact & ~full].all()


@pytest.mark.parametrize(("poisson", "angle"), [(0.0, 0.0), (0.3, 25.0)])
def test_full_contact_that_is_repeated_slides_as_far_as_it_slips(poisson, angle):
    """All that sticks holds all, across a slip along one line too, and the rest follows."""
    n, force, small = 16, 0.1, 1e-5
    x = np.cos(2 * np.pi * np.arange(n) / n)
    surface = rl.Surface(1e-3 * (x[:, np.newaxis] + 0.5 * x), sizes=(1.0, 1.0))
    along = np.array([np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))])
    shears = [0 * along, 0.995 * MU * force * along, 0.995 * (1 + small) * MU * force * along]
    curve = rl.press(
        surface,
        half_space=rl.Homogeneous(1.0, True, poisson=poisson),
        friction=rl.Friction(MU),
        forces=[force] * 3,
        shear_forces=shears,
        rtol=1e-12,
        solver=rl.Solver(precision="float64"),
    )
    assert (curve.area_fraction == 1).all()
    assert np.isposinf(curve.shear_stiffness_back[:, [0, 1], [0, 1]]).all()
    assert 0 < curve.stick_fraction[1] < 1
    stiffness, slid = curve.shear_stiffness[1], np.diff(curve.slide, axis=0)[1]
    change = np.diff(curve.shear_force, axis=0)[1]
    if poisson == 0:
        assert np.isposinf(stiffness[1, 1])
        assert stiffness[0] == pytest.approx([change[0] / slid[0], 0.0], rel=1e-3)
    else:
        expected = np.linalg.solve(stiffness, change)
        assert slid == pytest.approx(expected, abs=1e-2 * abs(slid).max())
