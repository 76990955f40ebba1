"""A question is checked at birth: before any file is read, in terms of its arguments."""

import inspect
import re
from functools import partial

import attrs
import numpy as np
import pytest

import roughline as rl
from gwyddion_files import field, gwy
from roughline import campaign
from roughline.errors.earlier import EARLIER

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
        (
            {"E_star": 1.0, "ask": rl.Ultrasound("5 MHz")},
            "rl.Ultrasound needs two materials (materials=)",
        ),
        ({"E_star": 1.0, "ask": rl.Friction(0.1)}, "rl.Friction needs two materials (materials=)"),
        ({"E_star": 1.0, "ask": rl.Joint(1e-4)}, "rl.Joint needs two materials (materials=)"),
    ],
)
def test_what_does_not_fit_together_is_refused_before_the_file(asked, message):
    with pytest.raises(rl.InputError, match=re.escape(message)) as refused:
        rl.Question(NOWHERE, **asked)
    assert "--" not in str(refused.value)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: rl.Theories("hertz"), 'theories is "hertz"; allowed are'),
        (lambda: rl.Ultrasound("-5 MHz"), 'frequency is "-5 MHz"; a positive, finite one is'),
        *(
            (lambda given=given: rl.Friction(given), "a number above 0 and up to 5 is needed")
            for given in (0.0, 30, -1, 5.1, float("nan"), float("inf"), "0.3", True)
        ),
    ],
)
def test_what_cannot_be_is_refused_where_it_is_asked(ask, message):
    with pytest.raises(rl.InputError, match=re.escape(message)):
        ask()


CALLS = {
    "Question": 'rl.Question("a.nc", "steel,copper", loads="1 N", {})',
    "Ensemble": 'Ensemble("a", "full", (2.2,), 64, 1, (0.1,), 0, {})',
    "press": "rl.press(surface, E_star=1.0, forces=[1e-3], {})",
    "press_creep": "press_creep({})",
    "sealing_pressure": "sealing_pressure({})",
    "Reading": "rl.Reading({})",
    "read": "rl.read(file, {})",
    "Surface": "rl.Surface(heights, sizes, {})",
    "Line": "rl.Line(heights[0], length, {})",
}
"""How what had other arguments is called, with a place for one."""


@pytest.fixture(scope="module")
def bodies(tmp_path_factory):
    """What the calls above and the new spellings speak of."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(16, rng=1)
    file = tmp_path_factory.mktemp("files") / "map.gwy"
    mask = np.eye(16)
    named = {"0_data": field(surface.heights), "0_mask": field(mask, z="")}
    file.write_bytes(gwy(**named))
    names = {"surface": surface, "heights": surface.heights, "sizes": surface.sizes}
    names |= {"length": 1.0, "file": file, "material": rl.material("steel")}
    half_space = rl.Homogeneous(1.0, periodic=True)
    creep = partial(rl.press_creep, surface, rl.Creep(0.3, 1.0), times=[0.0], force=1e-3)
    seal = partial(rl.sealing_pressure, surface, half_space=half_space, rtol=0.5, interval=False)
    return names | {"press_creep": creep, "sealing_pressure": seal}


@pytest.mark.parametrize("spelling", EARLIER)
def test_every_earlier_spelling_gets_one_line_with_the_new_one(spelling, bodies):
    """And the new one is one that is taken."""
    question = rl.Question("a.nc", "steel,copper", loads="1 N", ask=rl.Fluid("water"))
    names = {"rl": rl, "question": question, "Ensemble": campaign.Ensemble}
    names |= {"law": rl.Dugdale(0.2, 0.4), **bodies}
    call = CALLS.get(spelling.partition("(")[0], "{}")
    earlier = spelling
    if spelling.startswith("rl."):
        earlier = f'{spelling}("6 bar")'
    elif spelling.endswith("=)"):
        earlier = call.format(f"{spelling.partition('(')[2][:-1]}0.3")
    with pytest.raises(rl.InputError) as refused:
        eval(earlier, names)
    new = EARLIER[spelling]
    assert str(refused.value).endswith(f" any more; write {new}")
    assert "\n" not in str(refused.value)
    if re.match("[a-z_]+=", new):
        new = call.format(new)
    new = new.replace("...", '"a.nc", "steel,copper", loads="1 N"')
    new = new.replace("rl.Line(heights,", "rl.Line(heights[0],")
    assert eval(new, names) is not None


def test_an_earlier_name_is_imported_no_more_and_listed_nowhere():
    with pytest.raises(rl.InputError, match="write rl.Fluid"):
        exec("from roughline import Inlet")
    assert not {f"rl.{name}" for name in dir(rl)} & {*EARLIER}


def test_a_signature_says_what_is_typed_and_an_attribute_what_was_read():
    typed = inspect.signature(rl.Question).parameters
    assert typed["E_star"].annotation == typed["hardness"].annotation == "float | str | None"
    assert typed["loads"].annotation == "float | str | Iterable[float | str] | None"
    assert inspect.signature(rl.Joint).parameters["area"].annotation == "float | str"
    read = attrs.fields(rl.Question)
    assert (read.E_star.type, read.loads.type) == ("float | None", "tuple[float | str, ...]")


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
    assert question.loading.headings == ["1 N", "2.5 N"]
    assert question.loading.forces(1.0) == [1.0, 2.5]
    assert rl.Question(NOWHERE, E_star=1e9, loads=np.float32(2)).loading.headings == ["2 N"]
    assert rl.Question(NOWHERE, E_star=1e9, n_loads=np.int64(5)).n_loads == 5


def test_reading_is_checked_too():
    with pytest.raises(rl.InputError, match="most_missing is 2"):
        rl.Missing(most=2)


def test_a_question_is_a_value():
    first, second = (rl.Question(NOWHERE, "steel,copper", loads="10 N") for _ in range(2))
    assert first == second
    assert first.materials == (rl.material("steel"), rl.material("copper"))
    assert rl.Question(NOWHERE, E_star=1.0).loading.n_loads == 20
    with pytest.raises(AttributeError):
        first.loads = ()
