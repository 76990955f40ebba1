"""A cause of which nothing is known is said to be not known, and is not taken as nothing."""

import numpy as np
import pytest

import roughline as rl
from roughline.engineering.margin import Margin, Reason
from roughline.engineering.rules import rules
from roughline.margins.filling import FilledPoints
from roughline.margins.variant import AS_ASKED, Curves
from roughline.question.case import Case

PLACE = "what one map does not show: not known; a larger map would tell more"
JOINT = rl.Joint("1 m^2")
GRID = "the grid: not known; finer pixels would tell more"


@pytest.fixture(scope="module")
def surface():
    return rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, rng=7)


@pytest.fixture(scope="module")
def piece(surface):
    """A piece of a surface whose longest waves are longer than it."""
    return surface.cropped((0, 32), (0, 32))


def why(body, **asked):
    """What is said of each answer, by its key."""
    asked = {"loads": ["1 MPa"], "elastic": True, "grid_error": True, **asked}
    result = rl.assess(rl.Question(body, "steel,copper", **asked))
    return {key: [str(each) for each in answer.why()] for key, answer in result.answers.items()}


def given(key):
    """Whether no cause moves it: what was asked, and estimates from heights and hardness alone."""
    estimates = ("holm_resistance", "plastic_conductance", "mikic_conductance")
    return rules[key].is_given or key in estimates


def test_of_a_joint_beyond_reach_all_answers_say_it(piece):
    for key, said in why(piece, ask=JOINT).items():
        assert (PLACE in said) != given(key)
        assert said == [] or said[0] == PLACE
        assert GRID not in said


def test_an_area_that_is_all_at_the_hardness_says_it_too(piece):
    """Its lower end is the area that bears the force, which is the value, but for rounding."""
    said = why(piece, elastic=False, hardness="7 MPa", loads=[f"{7e6 * 12 / 32**2} Pa"], ask=JOINT)
    assert said["contact_area"] == [PLACE]


def test_of_a_map_that_is_not_alike_everywhere_those_of_the_larger_surface_say_it(piece):
    slope = 0.3 + 2 * np.linspace(0, 1, 32)[:, None]
    drifting = rl.Surface(piece.heights * slope, piece.sizes, unit="m", is_cut_out=True)
    said = why(drifting)
    assert {key for key, each in said.items() if PLACE in each} == {
        *("interface_stiffness", "mean_gap", "thermal_conductance_per_area"),
    }


def test_without_the_error_of_the_grid_all_answers_say_it(surface, piece):
    said = why(piece, grid_error=False, ask=rl.Joint("4 mm^2"))
    assert all((each == [GRID, PLACE]) != given(key) for key, each in said.items())
    said = why(surface, grid_error=False, loads=["3 N"])  # which no map was cut out of
    assert all((each == [GRID]) != given(key) for key, each in said.items())


def test_a_map_without_filled_points_leaves_nothing_open_however_early_one_stops(piece):
    case = Case.of(rl.Question(piece, "steel,copper", loads=["3 N"]))
    curve = rl.press(piece, E_star=1e11, forces=[3.0])
    found = FilledPoints().spread(case, Curves({AS_ASKED: curve}, stopped=AS_ASKED), AS_ASKED)
    assert (found.stiffness[0] == curve.stiffness).all()
    assert (found.stiffness[1] == curve.stiffness).all()


def test_a_load_that_was_not_solved_has_no_reasons(piece):
    answer = rl.assess(rl.Question(piece, "steel,copper", loads=["3 N"], elastic=True)).answers[
        "contact_stiffness"
    ]
    unknown = np.array([np.nan])
    margin = Margin("grid", "the grid", "finer pixels", unknown, unknown)
    unsolved = type(answer)(answer.rule, unknown, None, None, "k", "k", "k", margins=[margin])
    assert unsolved.why() == []


@pytest.mark.parametrize(
    ("ends", "factor", "told"),
    [
        ((0.5, 2.0), 4.0, "the grid: 0.5 to 2 times the value; finer pixels would narrow it"),
        ((0.0, 2.0), np.inf, "the grid: 0 to 2 times the value; finer pixels would narrow it"),
        (
            (0.5, np.inf),
            np.inf,
            "the grid: 0.5 or more times the value; finer pixels would narrow it",
        ),
        ((np.nan, np.nan), np.nan, GRID),
    ],
)
def test_a_reason_says_its_ends(ends, factor, told):
    reason = Reason("grid", "the grid", "finer pixels", *ends)
    assert reason.factor == pytest.approx(factor, nan_ok=True)
    assert str(reason) == told
