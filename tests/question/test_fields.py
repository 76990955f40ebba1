"""A field of a question stands once: all that is said of it is read from the table."""

import inspect
import subprocess
import sys

import pytest
import typer
from typer.testing import CliRunner

import roughline as rl
from roughline.cli.flags import FLAGS
from roughline.cli.options import with_fields
from roughline.errors.words import Words, called, speaking
from roughline.question import fields
from roughline.question.asked import KINDS, asked_for
from roughline.question.fields import FIELDS, LOADS, Field, names_by

TEMPERATURE = Field(
    name="temperature",
    group=LOADS,
    flag="--temperature",
    control="temperature",
    help='Temperature of both bodies, such as "300 K".',
    otherwise="that of the room",
)


def test_an_entry_of_the_table_is_an_option_with_its_help(monkeypatch):
    monkeypatch.setattr("roughline.cli.options.FIELDS", (*FIELDS, TEMPERATURE))
    received = []

    @with_fields(LOADS)
    def command(file: str, values: dict):
        received.append(values)

    app = typer.Typer()
    app.command()(command)
    page = CliRunner().invoke(app, ["--help"], terminal_width=200).output
    assert "--temperature" in page
    assert "Temperature of both bodies" in page
    assert CliRunner().invoke(app, ["a.nc", "--temperature", "300 K"]).exit_code == 0
    assert received[0]["temperature"] == "300 K"


def test_an_entry_of_the_table_has_a_name_in_messages(monkeypatch):
    monkeypatch.setattr(fields, "FIELDS", (*FIELDS, TEMPERATURE))
    flags = Words(names_by(lambda field: field.flag), str)
    assert called("temperature") == "temperature="
    with speaking(flags):
        assert called("temperature") == "--temperature"
        with pytest.raises(rl.InputError, match="^--temperature is "):
            raise rl.InputError("is 3; a quantity is needed", "temperature")


FOREIGN = """
from roughline.question import fields
from roughline.question.asked import KINDS, asked_for

fields.FIELDS += (
    fields.Field(
        name="temperature",
        group=fields.LOADS,
        flag="--temperature",
        control="temperature",
        help="Temperature of both bodies.",
    ),
)
from roughline.cli.flags import FLAGS
from roughline.lab.measured.documents import as_command, as_python
from roughline.lab.measured.state import control_texts
from roughline.lab.measured.state import PAGE_WORDS
from roughline.lab.site import page

said = {"first": "steel", "second": "copper", "temperature": "300 K"}
assert control_texts({"state": said}) == said
assert 'data-text="temperature"' in page()
assert "Temperature of both bodies." in page()
assert "--temperature '300 K'" in as_command(said, ["a.nc"])
assert "temperature='300 K'," in as_python(said, ["a.nc"])
assert FLAGS.names["temperature"] == "--temperature"
assert PAGE_WORDS.names["temperature"] == "temperature"
"""


def test_an_entry_of_the_table_is_a_control_in_the_address_and_in_the_code():
    done = subprocess.run([sys.executable, "-c", FOREIGN], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_every_flag_of_the_table_is_a_name_of_its_own():
    flags = [flag for field in FIELDS for flag in field.flag.split(",") if flag]
    assert len({*flags}) == len(flags)
    assert FLAGS.names["rl.Joint"] == FLAGS.names["joint_area"] == "--joint-area"
    assert FLAGS.names["rl.Fluid"] == FLAGS.names["fluid"] == "--fluid"


def test_every_field_of_what_is_asked_is_an_argument_of_its_class():
    for each in (field for field in FIELDS if field.is_asked and field.of != "Theories"):
        assert each.argument in inspect.signature(KINDS[each.of]).parameters
    for each in (field for field in FIELDS if field.of == "Question"):
        assert each.argument in inspect.signature(rl.Question).parameters


@pytest.mark.parametrize(
    ("told", "asked"),
    [
        ({"friction": 0.3, "history": True}, [rl.Friction(0.3)]),
        ({"theories": ["persson"]}, [rl.Theories("persson")]),
        ({"fluid": "water", "closure": False}, [rl.Fluid("water")]),
        ({"closure": True, "along": "x"}, [rl.Fluid(along="x", closure=True)]),
        (
            {"fluid": "water", "inlet": "6 bar", "seal": "1 mm x 1 mm", "carries": False},
            [rl.Fluid("water", inlet="6 bar", seal="1 mm x 1 mm", carries=False)],
        ),
        ({"closure": False, "carries": None, "theories": []}, []),
    ],
)
def test_what_is_told_of_fields_is_what_is_asked(told, asked):
    assert asked_for(told) == tuple(asked)


def test_what_is_asked_is_checked_when_it_is_made():
    for wrong in (lambda: rl.Friction(7), lambda: rl.Ultrasound("5 m"), lambda: rl.Joint(-1)):
        with pytest.raises(rl.InputError):
            wrong()
    with pytest.raises(rl.InputError, match="ask is 0.3; give what is asked"):
        rl.Question("scan.x3p", "steel,copper", ask=0.3)
    with pytest.raises(rl.InputError, match="ask holds several rl.Friction"):
        rl.Question("scan.x3p", "steel,copper", ask=[rl.Friction(0.1), rl.Friction(0.2)])


def test_an_unknown_keyword_names_the_nearest_one():
    with pytest.raises(rl.InputError, match="Question has no argument materialz=; give materials="):
        rl.Question("scan.x3p", materialz="steel,copper")
