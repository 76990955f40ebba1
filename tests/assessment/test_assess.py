"""From a question to an assessment: what Python and the command line both answer."""

import json

import numpy as np
import pytest

import roughline as rl
from roughline.cli.flags import FLAGS
from roughline.errors.words import speaking

PAIR = ("steel", "copper")


def test_messages_are_of_the_loads_that_are_shown(rough):
    """The lighter loads of a report's curve have other contact pressures."""
    alone, whole = (
        rl.assess(rl.Question(rough, PAIR, loads="10 N", whole_curve=whole, elastic=True))
        for whole in (False, True)
    )
    warnings = [
        [note for note in pressed.warnings if "times the softer body's hardness" in note]
        for pressed in (alone, whole)
    ]
    assert warnings[0] == warnings[1] != []


FILES = {
    "al3d-1.al3d": ({}, ()),
    "di-1.di": ({}, ()),
    "opd-1.opd": ({}, ()),
    "dektak-1.csv": ({}, ()),
    "mitutoyo_mock.xlsx": ({}, ()),
    "sur-3.sur": ({"missing": rl.Missing(most=0.9)}, ("--max-missing", "0.9")),
    "xy-1.txt": ({"unit": "um"}, ("--unit", "um")),
    "di_corrupted.di": ({}, ()),
}


REFUSED = ("di-1.di", "di_corrupted.di")  # it does not bear the load; it is damaged


def both(topographies, invoke, name, points):
    """What the command line says of a file, and the same question as Python asks it."""
    reading, flags = FILES[name]
    told = invoke(
        "press",
        topographies / name,
        *flags,
        materials="steel,copper",
        load=["1 mN", "10 kPa"],
        resample=points,
        frequency="5 MHz",
        json=True,
    )
    question = rl.Question(
        topographies / name,
        materials="steel,copper",
        loads=["1 mN", "10 kPa"],
        ask=rl.Ultrasound("5 MHz"),
        reading=rl.Reading(**reading),
        preparation=rl.Preparation(points=points),
        fields=False,
    )
    return told, question


@pytest.mark.parametrize("name", REFUSED)
def test_python_and_the_command_line_give_the_same_refusal(topographies, invoke, name):
    (code, _, errors), question = both(topographies, invoke, name, 96)
    assert code == 2
    with speaking(FLAGS), pytest.raises(rl.InputError) as refused:
        rl.assess(question)
    assert errors == f"roughline: {refused.value}\n"


@pytest.mark.parametrize(
    ("name", "points"),
    [("al3d-1.al3d", 24), *((name, 96) for name in FILES if name not in REFUSED)],
)
def test_python_and_the_command_line_give_the_same_numbers(topographies, invoke, name, points):
    """Whatever the file: values, both ends and remarks."""
    (code, out, errors), question = both(topographies, invoke, name, points)
    assert code == 0, errors
    with speaking(FLAGS):
        told, result = json.loads(out), rl.assess(question)
        assert result.remarks == told["notes"]
    assert [each["key"] for each in told["answers"].values()] == list(result.answers)
    for each in told["answers"].values():
        answer = result.answers[each["key"]]
        for field in ("values", "low", "high"):
            ours, theirs = getattr(answer, field), each[field]
            assert (ours is None) == (theirs is None)
            if ours is not None:
                assert [x if np.isfinite(x) else None for x in ours] == theirs
    for field in ("depth", "force", "stiffness"):
        assert getattr(result.curve_as_asked, field).tolist() == told["curve"][field]


@pytest.mark.parametrize(
    "asked", [{"elastic": True, "grid_error": False, "fields": False}, {}], ids=["little", "all"]
)
def test_a_file_with_missing_points_is_read_once(holed, monkeypatch, asked):
    from roughline.question import source

    file, *_ = holed
    read = []
    original = source.measurement

    def measurement(*arguments):
        read.append(arguments)
        return original(*arguments)

    monkeypatch.setattr(source, "measurement", measurement)
    reading = rl.Reading(unit="m", sizes="1 mm")
    result = rl.assess(rl.Question(file, PAIR, loads="10 N", reading=reading, **asked))
    assert any("filled by nearest instead" in note for note in result.notes)
    assert len(read) == 1


def test_the_other_filling_is_that_of_a_second_reading(holed):
    file, *_ = holed
    nearest = rl.read(file, "m", sizes="1 mm", missing=rl.Missing("nearest"))
    question = rl.Question(file, E_star=1e9, loads=1, reading=rl.Reading(unit="m", sizes="1 mm"))
    (part,) = rl.assess(question).topographies
    assert (part.filled_by("nearest").heights == nearest.heights).all()
    assert (part.filled_by("harmonic").heights == part.body.heights).all()


def test_where_a_crop_leaves_no_missing_point_nothing_is_filled(holed):
    file, *_ = holed
    question = rl.Question(
        file,
        E_star=1e9,
        loads=1,
        reading=rl.Reading(unit="m", sizes="1 mm"),
        preparation=rl.Preparation(crop=(5e-4, 1e-3, 5e-4, 1e-3), trend="none"),
    )
    result = rl.assess(question)
    assert not any("filled" in note for note in result.notes)
    assert "missing_points" not in result.body.settings


def test_a_body_in_memory_is_assessed_like_its_file(rough):
    from_file = rl.assess(rl.Question(rough, PAIR, loads=["10 N"]))
    given = rl.assess(rl.Question(rl.read(rough), PAIR, loads=[10.0]))
    assert from_file.headings == given.headings == ["10 N"]
    for key, answer in from_file.answers.items():
        assert answer.rows.tolist() == given.answers[key].rows.tolist()


def test_numbers_are_in_si_units(rough):
    texts = rl.Question(rough, E_star="110 GPa", depths=["100 nm", "0.2 um"])
    numbers = rl.Question(rough, E_star=110e9, depths=[100e-9, 0.2e-6])
    first, second = (rl.assess(each).curve for each in (texts, numbers))
    assert first.force.tolist() == second.force.tolist()
    assert first.depth.tolist() == [1e-7, 2e-7]


def test_an_assessment_has_the_fields_of_the_largest_load(rough):
    result = rl.assess(rl.Question(rough, E_star=1e9, loads=["2 mN", "1 mN"]))
    force = result.fields.pressure.sum() * np.prod(result.body.spacing)
    assert force == pytest.approx(2e-3, rel=1e-5)
    assert rl.assess(rl.Question(rough, E_star=1e9, loads=1e-3, fields=False)).fields is None


@pytest.mark.usefixtures("loads_of_curve")
def test_partial_slip_is_an_answer(rough, invoke):
    question = rl.Question(rough, PAIR, loads="10 N", ask=rl.Friction(0.3), whole_curve=True)
    slip = rl.assess(question).partial_slip
    assert slip.force[-1] == pytest.approx(3.0)  # all of it slides: Q = mu F
    assert (np.diff(slip.displacement) > 0).all()
    code, out, errors = invoke(
        "press", rough, materials="steel,copper", load="10 N", friction="0.3", json=True
    )
    assert code == 0, errors
    told = json.loads(out)["partial_slip"]
    assert told["friction"] == 0.3
    assert told["force"][-1] == pytest.approx(3.0)


def test_line_scans_far_apart_are_pressed_without_moments_of_their_spectrum():
    heights = 1e-7 * np.sin(np.arange(64.0))[:, None] * np.random.default_rng(0).random(12)
    apart = rl.Surface(heights, (32e-6, 600e-6), "m", is_cut_out=True)
    result = rl.assess(rl.Question(apart, PAIR, loads="1 MPa", grid_error=False))
    assert result.answers["contact_stiffness"].values > 0
    with pytest.raises(rl.InputError, match="whose pixels are nearly square"):
        rl.assess(rl.Question(apart, PAIR, loads="1 MPa", ask=rl.Theories("persson")))


def test_theories_stand_beside_the_loads_that_were_solved(rough):
    result = rl.assess(
        rl.Question(rough, E_star=1e9, loads=[1e-3, 1e-2], ask=rl.Theories("persson"))
    )
    (persson,) = result.theories
    assert persson.pressure.tolist() == (result.curve.force / result.area).tolist()
