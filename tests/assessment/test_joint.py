"""From a map to the joint that it shows a part of."""

import math
import re

import numpy as np
import pytest

import roughline as rl
from roughline.engineering.formulas import electrical_resistance

# harder than any contact pressure here, so that nothing yields
FIRST = "E=210 GPa nu=0.3 hardness=1000 GPa resistivity=1e-7 ohm m conductivity=50 W/m/K"
SECOND = "E=120 GPa nu=0.3 hardness=1000 GPa resistivity=2e-8 ohm m conductivity=400 W/m/K"
PAIR = f"{FIRST} density=7800 kg/m^3, {SECOND} density=8900 kg/m^3"
RESISTIVITIES = (1e-7, 2e-8)
YIELDING = PAIR.replace("hardness=1000 GPa", "hardness=0.5 GPa")
VALUES = {"grid_error": False, "fields": False}  # and no more
SPECTRUM = rl.SelfAffine(hurst=0.7, length=4e-4, rms_height=1e-6, q_roll=math.tau / 12e-6)


@pytest.fixture(scope="module", params=[32, 64])
def part(request):
    """A part of 0.4 mm, and a map of 0.1 mm of it."""
    n = request.param
    surface = SPECTRUM.surface(4 * n, 3)
    return surface, surface.cropped((0, n), (0, n)).detrended()


@pytest.mark.parametrize("materials", [PAIR, YIELDING])
def test_a_joint_of_four_maps_is_the_map_laid_four_times(materials):
    """Every answer, for every one grows with the area as is declared."""
    tile = rl.SelfAffine(hurst=0.7, length=1e-4, rms_height=1e-7).surface(32, 5)
    four = rl.Surface(np.tile(tile.heights, (2, 2)), (2e-4, 2e-4))
    asked = {"materials": materials, **VALUES}
    wave = rl.Ultrasound("5 MHz")
    joint = rl.assess(
        rl.Question(tile, loads="4 N", ask=[rl.Joint(four.area), wave], **asked)
    ).answers
    whole = rl.assess(rl.Question(four, loads="4 N", periodic=True, ask=wave, **asked)).answers
    k_u = whole["unloading_stiffness"].values  # of what is repeated, that of the interface
    expectations = {key: each.values for key, each in whole.items()} | {
        "interface_stiffness": k_u,
        "stiffness_per_area": k_u / four.area,
        "specific_contact_resistance": whole["constriction_resistance"].values * four.area,
    }
    for key, answer in joint.items():
        # estimates of the literature take the rms slope of the forward differences inside
        tolerance = 0.05 if key in ("mikic_conductance", "plastic_conductance") else 1e-5
        assert answer.values == pytest.approx(expectations[key], rel=tolerance), key
    assert set(whole) - set(joint) == {"unloading_stiffness"}
    assert (joint["plastic_fraction"].values > 0.1) == (materials == YIELDING)


def test_forces_act_on_the_joint_and_pressures_are_the_same_everywhere(part):
    _, piece = part
    by_force, by_pressure = (
        rl.assess(rl.Question(piece, PAIR, loads=load, ask=rl.Joint("2 cm^2"), fields=False))
        for load in ("1 kN", "5 MPa")
    )
    assert by_force.curve.force == pytest.approx(1e3 * piece.area / 2e-4, rel=1e-12)
    told = by_force.curve.to_dataset().attrs  # a file of the map's curve names the joint
    assert told["joint_area"] / told["length"] ** 2 * by_force.curve.force == pytest.approx([1e3])
    for key, answer in by_force.answers.items():
        other = by_pressure.answers[key]
        assert answer.rows == pytest.approx(other.rows, rel=1e-6), key
    assert by_force.headings == ["1 kN"]
    assert by_force.answers["normal_force"].values == pytest.approx([1e3])


def test_what_is_per_area_does_not_know_how_large_the_joint_is(part):
    _, piece = part
    small, large = (
        rl.assess(rl.Question(piece, PAIR, loads="5 MPa", ask=rl.Joint(area))).answers
        for area in ("1 mm^2", "100 mm^2")
    )
    for key in ("specific_contact_resistance", "stiffness_per_area", "contact_area_fraction"):
        assert large[key].rows == pytest.approx(small[key].rows, rel=1e-9), key
    assert large["constriction_resistance"].rows * 100 == pytest.approx(
        small["constriction_resistance"].rows, rel=1e-9
    )


@pytest.mark.parametrize("materials", [PAIR, YIELDING])
def test_the_joint_is_within_the_interval_of_its_map(part, materials):
    """The truth is the whole part, pressed as it is, which the map is a sixteenth of."""
    surface, piece = part
    pair, force = rl.Question(piece, materials).pair, 5e6 * surface.area
    truth = rl.press(
        surface, E_star=pair.E_star, hardness=pair.hardness, forces=[force], periodic=True
    )
    question = rl.Question(
        piece, materials, loads=force, ask=rl.Joint(surface.area), grid_error=True
    )
    found, k_u = rl.assess(question).answers, truth.unloading_stiffness
    expected = {
        "contact_stiffness": truth.stiffness,
        "interface_stiffness": k_u,
        "contact_area": truth.area_fraction_corrected * surface.area,
        "constriction_resistance": electrical_resistance(k_u, pair.E_star, RESISTIVITIES),
    }
    assert (found["plastic_fraction"].values > 0.1) == (materials == YIELDING)
    for key, value in expected.items():
        answer = found[key]
        # where all yields, the area is F / H, the least that can be, but for rounding
        assert answer.low <= value * (1 + 1e-12), key
        assert value < answer.high, key


def test_the_joint_slides_under_its_own_load(part):
    _, piece = part
    question = rl.Question(
        piece,
        PAIR,
        loads="100 N",
        ask=[rl.Joint("1 mm^2"), rl.Friction(0.3)],
        whole_curve=True,
        **VALUES,
    )
    assert rl.assess(question).partial_slip.force[-1] == pytest.approx(30.0)


def test_what_is_left_out_of_a_joint_is_told_with_its_size(part):
    _, piece = part
    light, heavy = (
        rl.assess(rl.Question(piece, PAIR, loads=load, ask=rl.Joint(2e-8), **VALUES))
        for load in ("1 mN", "10 N")
    )
    disc = 2 * light.curve.E_star * math.sqrt(2e-8 / math.pi)
    radius = math.sqrt(2e-8 / math.pi)
    assert electrical_resistance(disc, light.curve.E_star, RESISTIVITIES) == pytest.approx(
        sum(RESISTIVITIES) / (4 * radius)
    )
    assert any("evenly loaded" in note for note in light.notes)
    assert any("evenly loaded" in note and "matter as well" in note for note in heavy.warnings)


def test_without_a_joint_forces_act_on_the_map_and_the_notes_say_so(part):
    surface, piece = part
    told = "forces act on the map alone"

    def notes(body, load):
        return " ".join(rl.assess(rl.Question(body, PAIR, loads=load, **VALUES)).notes)

    assert told in notes(piece, "1 N")
    assert told not in notes(piece, "2 MPa")
    assert told not in notes(surface, "1 N")  # it was not cut out of a larger one


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (lambda: rl.Joint(0), "joint_area is 0; a positive, finite area is needed"),
        (lambda: rl.Joint("-2 cm^2"), 'joint_area is "-2 cm^2"; a positive, finite area is'),
        (lambda: rl.Joint(math.nan), "joint_area is nan; a positive, finite area is needed"),
        (lambda: rl.Joint("inf cm^2"), 'joint_area is "inf cm^2"; a positive, finite area is'),
        (lambda: rl.Joint("2 cm"), 'joint_area is "2 cm", which is no quantity in m^2'),
        (lambda: rl.Joint("2"), 'joint_area is "2", without a unit; give one, such as "2 cm^2"'),
        (lambda: rl.Joint("1,5 cm^2"), "numbers take a decimal point"),
        (
            lambda: rl.Question("a.x3p", E_star=1e9, loads="1 N", ask=rl.Joint(1.0)),
            "needs two materials",
        ),
        (
            lambda: rl.Question("a.x3p", PAIR, depths="1 um", ask=rl.Joint(1.0)),
            "is pressed by loads (loads=)",
        ),
    ],
)
def test_joints_that_cannot_be_are_refused(asked, message):
    with pytest.raises(rl.InputError, match=re.escape(message)):
        asked()


def test_bodies_that_stand_for_no_joint_are_refused(part):
    _, piece = part
    with pytest.raises(rl.InputError, match="less than the map, which has .*: crop the map"):
        rl.Question(piece, PAIR, loads="1 N", ask=rl.Joint("100 µm²"))
    assert rl.Question(piece, PAIR, loads="1 N", ask=rl.Joint(piece.area)).joint == piece.area
    scan = rl.Line(piece.heights[0], 1e-4, kind="profile")
    with pytest.raises(rl.InputError, match="rl.Joint belongs to a surface"):
        rl.Question(scan, PAIR, loads="1 N", ask=rl.Joint("2 cm^2"))


@pytest.mark.parametrize("area", ["2 cm^2", "2 cm²", "2cm2", "200 mm^2", 2e-4])
def test_areas_are_read_as_they_are_written(area):
    assert rl.Question("nowhere.x3p", PAIR, loads="1 N", ask=rl.Joint(area)).joint == 2e-4


def test_a_repeated_map_tells_of_the_jump_at_its_borders(part):
    surface, piece = part
    slope = 0.1 * np.arange(len(piece.heights))[:, np.newaxis] * piece.spacing[0]
    tilted = rl.Surface(piece.heights + slope, piece.sizes, is_cut_out=True)

    def said(body, **asked):
        result = rl.assess(rl.Question(body, PAIR, loads="5 MPa", **VALUES, **asked))
        return " ".join(result.warnings), " ".join(result.notes)

    assert "jumps by" in said(piece, periodic=True)[1]
    warned, _ = said(tilted, periodic=True)
    assert re.search(r"jumps by .*, \S+ times an ordinary step .*; \d\d% of its mean-sq", warned)
    assert not any("jumps by" in text for text in said(piece))
    assert not any("jumps by" in text for text in said(surface, periodic=True))
    joint = {"ask": rl.Joint("1 mm^2")}  # whose map is pressed without its tilt
    assert "jumps by" in said(tilted, **joint)[1]
