"""A question is checked at birth: before any file is read, in terms of its arguments."""

import re

import numpy as np
import pytest

import roughline as rl

NOWHERE = "no/such/file.x3p"


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({}, "give either a contact modulus (E_star=) or two materials (materials=)"),
        ({"E_star": 1e9, "materials": ("steel", "copper")}, "give either a contact modulus"),
        ({"E_star": "110"}, 'E_star is "110", without a unit'),
        ({"E_star": -1.0}, "E_star is -1.0; a positive, finite contact modulus is needed"),
        ({"materials": "steel"}, "give two with a comma between"),
        ({"materials": ("steel", "rigit")}, 'did you mean "rigid"'),
        ({"materials": ("rigid", "rigid")}, "both materials are rigid"),
        ({"E_star": 1.0, "loads": ["1 N"], "n_loads": 5}, "give one of loads=, depths= and"),
        ({"E_star": 1.0, "loads": ["1 N"], "depths": ["1 um"]}, "give one of loads="),
        ({"E_star": 1.0, "n_loads": 1}, "n_loads is 1; a whole number of at least 2 is needed"),
        ({"E_star": 1.0, "loads": ["10 m"]}, "give a total force"),
        ({"E_star": 1.0, "loads": [-1.0]}, "loads is -1.0; give positive ones"),
        ({"E_star": 1.0, "loads": ["1,5 N"]}, "numbers take a decimal point"),
        ({"E_star": 1.0, "depths": ["5 N"]}, 'depths is "5 N"'),
        ({"E_star": 1.0, "theories": ["hertz"]}, 'theories is "hertz"; allowed are'),
        (
            {"E_star": 1.0, "ask": rl.Ultrasound("5 MHz")},
            "reflection and partial slip need two materials",
        ),
        (
            {"E_star": 1.0, "ask": rl.Friction(0.1)},
            "reflection and partial slip need two materials",
        ),
        (
            {"materials": "steel,copper", "frequency": "-5 MHz"},
            'frequency is "-5 MHz"; a positive, finite one is needed',
        ),
        (
            {"materials": "steel,copper", "friction": 0.0},
            "friction is 0.0; a number above 0 and up to 5",
        ),
        *(
            (
                {"materials": "steel,copper", "friction": given},
                "above 0 and up to 5 is needed",
            )
            for given in (30, -1, 5.1, float("nan"), float("inf"))
        ),
        *(
            ({"materials": "steel,copper", "friction": given}, "a number")
            for given in ("0.3", True)
        ),
    ],
)
def test_what_does_not_fit_together_is_refused_before_the_file(asked, message):
    with pytest.raises(rl.InputError, match=re.escape(message)) as refused:
        rl.Question(NOWHERE, **asked)
    assert "--" not in str(refused.value)


def test_bodies_in_memory():
    line = rl.Line(np.sin(np.arange(64.0)), length=1.0, kind="profile")
    with pytest.raises(rl.InputError, match="belong to a surface"):
        rl.Question(line, E_star=1.0, periodic=True)
    surface = rl.Surface(np.zeros((8, 8)), sizes=(1.0, 1.0), unit="um")
    with pytest.raises(rl.InputError, match='body is in "um"; give it in metres'):
        rl.Question(surface, E_star=1.0)
    with pytest.raises(rl.InputError, match=r"body is an array of shape \(8, 8\); give a Surface"):
        rl.Question(np.zeros((8, 8)), E_star=1.0)


def test_reading_belongs_to_files():
    surface = rl.Surface(np.eye(8), sizes=(1.0, 1.0))
    with pytest.raises(rl.InputError, match="reading= says how files are read"):
        rl.Question(surface, E_star=1.0, reading=rl.Reading(unit="um"))


def test_arrays_of_numbers():
    question = rl.Question(NOWHERE, E_star=np.float64(1e9), loads=np.array([1.0, 2.5]))
    assert question.headings == ["1 N", "2.5 N"]
    assert question.forces(1.0) == [1.0, 2.5]
    assert rl.Question(NOWHERE, E_star=1e9, loads=np.float32(2)).headings == ["2 N"]
    assert rl.Question(NOWHERE, E_star=1e9, n_loads=np.int64(5)).n_loads == 5


def test_reading_is_checked_too():
    with pytest.raises(rl.InputError, match="most_missing is 2"):
        rl.Reading(most_missing=2)


def test_a_question_is_a_value():
    first, second = (rl.Question(NOWHERE, "steel,copper", loads="10 N") for _ in range(2))
    assert first == second
    assert first.materials == (rl.material("steel"), rl.material("copper"))
    assert rl.Question(NOWHERE, E_star=1.0).n_loads == 20
    with pytest.raises(AttributeError):
        first.loads = ()
