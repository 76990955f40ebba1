"""Every option of every command with values that make no sense: one line, in the user's words."""

import re
from dataclasses import replace

import numpy as np
import pytest
import typer

import roughline as rl
from roughline.cli import app
from roughline.lab.server import serve

VALUES = ("text", "-1", "0", "nan", "inf", "1e400", "", "1 kg", "1,5 mm", "x" * 500, "a\nb")
# any text is a name, or an address, which is tried when the server starts
SKIPPED = ("--out", "--report", "--prepared", "--store", "--scheduler", "--host")
INSTEAD_OF = {"--fractal-dimension": "--hurst", "--modulus": "--materials", "--depth": "--load"}
PLAN = """
[[ensemble]]
name = "lines"
model = "reduced"
fractal_dimensions = [2.2]
points = 64
realisations = 1
force_bars = [0.1]
"""
SENSIBLE = {
    "--max-missing": ("0",),
    "--seed": ("0",),
    "--port": ("0",),
    "--hurst": ("0",),
    "--blur": ("0",),
}
NEEDED = {
    "press": ("{array}", "--unit", "um", "--size", "1 mm", "--materials", "steel,copper", "--json"),
    "info": ("{array}", "--unit", "um", "--size", "1 mm", "--iso"),
    "compare": ("--hurst", "0.8", "--points", "16", "--surfaces", "2", "--length", "1 mm"),
    "generate": (
        *("--hurst", "0.8", "--out", "{folder}/made.nc"),
        *("--length", "1 mm", "--rms-height", "1 um"),
    ),
    "ball": ("--radius", "1 mm", "--materials", "steel,copper", "--load", "1 N"),
    "creep": (
        *("{file}", "--materials", "E=9 MPa nu=0.49, rigid", "--prony", "0.5 1 s"),
        *("--load", "10 mN", "--times", "0 s, 1 s"),
    ),
    "paper": ("--out", "{folder}/paper"),
    "lab": ("--no-browser",),
    "about": (),
    "run": ("{folder}/plan.toml", "--store", "{folder}/plan.zarr"),
    "status": ("{folder}/plan.zarr",),
    "export": ("{folder}/plan.zarr", "--out", "{folder}/exported"),
}


def commands(group=None, before=()):
    group = group or typer.main.get_command(app)
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from commands(command, (*before, name))
        else:
            yield (*before, name), command


OPTIONS = [
    (" ".join(words), "/".join(parameter.opts))
    for words, command in commands()
    for parameter in command.params
    if parameter.param_type_name == "option" and not parameter.is_flag
    if not set(parameter.opts) & set(SKIPPED) and (words[-1], parameter.name) != ("paper", "seed")
]


@pytest.fixture
def places(tmp_path):
    surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(8, 7)
    np.save(tmp_path / "map.npy", surface.heights)
    rl.write(replace(surface, unit="m"), tmp_path / "map.nc")
    (tmp_path / "plan.toml").write_text(PLAN, encoding="utf-8")
    return {"folder": tmp_path, "array": tmp_path / "map.npy", "file": tmp_path / "map.nc"}


def without(option, needed):
    """What a command needs, less an option and its value."""
    at = needed.index(option) if option in needed else len(needed)
    return [*needed[:at], *needed[at + 2 :]]


def wrong_with(told, names, value):
    """What is wrong with the line that refuses a value."""
    shown = {"1e400": "1e400|inf", "a\nb": "a b"}.get(value, re.escape(value[:20]))
    checks = {
        "it is no single line": told.count("\n") == 1 and told.startswith("roughline: "),
        "it does not name the option": any(name in told for name in names),
        "it does not show the value": re.search(shown, told) or "--channel" in names,
        "it is long": len(told) < 400,
        "it speaks Python": not re.search(
            r"\w_\w+ is|\b[a-z]\w*=|Traceback", told.split("Known")[0]
        ),
    }
    return [each for each, holds in checks.items() if not holds]


@pytest.mark.parametrize(("words", "option"), OPTIONS)
def test_senseless_values_are_refused_in_one_line(words, option, places, invoke, monkeypatch):
    monkeypatch.setattr(serve, "serve", lambda *given: None)
    names = option.split("/")
    needed = [each.format(**places) for each in NEEDED[words.split()[-1]]]
    for each in (*names, INSTEAD_OF.get(option)):
        needed = without(each, needed)
    for value in VALUES:
        code, _, told = invoke(*words.split(), *needed, names[-1], value)
        if value in SENSIBLE.get(names[-1], ()):
            assert not code or "and there is none: leave it out" in told, told
        else:
            assert (code in (1, 2), wrong_with(told, names, value)) == (True, []), told


BEYOND = [
    ("--low-pass", "1 km", "longer than the topography, 1 mm"),
    ("--resample", "100000000", "GB is free: resample to fewer points, up to "),
    ("--friction", "30", "a number above 0 and up to 5 is needed"),
    ("--friction", "-1", "a number above 0 and up to 5 is needed"),
    ("--joint-area", "1e300 m^2", "is needed, up to 1 km²"),
    ("--adhesion", "50 mJ/m^2 over 1 km", "is longer than the shorter side, 1 mm"),
    ("--adhesion", "1e300 J/m^2", "is more than the contact modulus times the shorter side"),
]


@pytest.mark.parametrize(("option", "value", "why"), BEYOND)
def test_values_beyond_what_a_body_has_are_refused_before_it_is_pressed(
    option, value, why, places, invoke
):
    needed = [each.format(**places) for each in NEEDED["press"]][:-1]
    needed += ["--elastic"] if option == "--adhesion" else []
    code, _, told = invoke("press", *needed, "--load", "2 MPa", option, value)
    assert code == 2
    assert told.count("\n") == 1  # and none of the progress
    assert why in told
    assert len(told) < 350


def test_the_same_is_refused_in_python(places):
    def question(**given):
        return rl.Question(rl.read(places["file"]), ("steel", "copper"), loads="2 MPa", **given)

    for refused in (
        lambda: rl.assess(question(preparation=rl.Preparation(low_pass=1e3))),
        lambda: rl.assess(question(preparation=rl.Preparation(points=10**8))),
        lambda: question(ask=rl.Adhesion("50 mJ/m^2 over 1 km"), elastic=True),
        *(lambda value=value: rl.Friction(value) for value in (-1, 30)),
    ):
        with pytest.raises(rl.InputError, match="needed|longer than|GB"):
            refused()
