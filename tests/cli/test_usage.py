"""Mistakes in a command itself: one line, and what is not offered is said to be so."""

from pathlib import Path

import pytest

from roughline.cli.usage import _NOT_DONE, NOT_OFFERED

PAGE = Path(__file__).parents[2] / "docs" / "not_offered.md"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("presss",), 'there is no command "presss"; did you mean press?'),
        (("campaign", "rum"), 'there is no command "rum"; --help lists the commands'),
        (("press",), "FILE is needed, a topography or line scan"),
        (("press", "x", "--modulus"), "--modulus needs a value"),
        (("press", "x", "--json=3"), "--json takes no value: leave it out"),
        (("press", "x", "--modulos", "3"), "there is no option --modulos; did you mean --modulus?"),
        (
            ("press", "x", "--leak-rate", "1"),
            "there is no option --leak-rate; did you mean --fluid",
        ),
        (
            ("press", "x", "--coating", "gold"),
            "there is no option --coating; did you mean --materials?",
        ),
        (("press", "x", "--xyzzy"), "there is no option --xyzzy; --help lists the options"),
        (
            ("press", "x", "--loads", "10 N"),
            '--loads is "10 N"; a whole number is needed; did you mean --load?',
        ),
        (("press", "x", "--friction", "1,5"), '--friction is "1,5"; a number is needed'),
        (("press", "x", "--trend", "up"), '--trend is "up"; allowed are "none", "mean", "tilt"'),
        (("press", "x", "--modulus", ""), '--modulus is ""; give a value, or leave --modulus out'),
        (("press", "x", "--out="), '--out is ""; give a value, or leave --out out'),
        (("paper", "--scale", "huge"), '--scale is "huge"; allowed are "quick", "full"'),
        (("generate",), "--out is needed, file to write"),
        (("generate", "--seed", "-1"), '--seed is "-1"; at least 0 is needed'),
        (("info", "a", "b"), '"b" is not expected there; see roughline info --help'),
    ],
)
def test_a_mistake_in_a_command_is_one_line(invoke, arguments, told):
    code, out, errors = invoke(*arguments)
    assert (code, out) == (2, "")
    assert errors.startswith(f"roughline: {told}")
    assert errors.count("\n") == 1


@pytest.mark.parametrize("option", ["--creep", "--viscoelastic", "--wear", "--lubricant"])
def test_what_is_not_offered_is_said_to_be_so(invoke, option):
    code, _, errors = invoke("press", "x", option, "1")
    assert code == 2
    assert f"there is no option {option}: " in errors
    assert errors.endswith(f"is not offered; what to use: {NOT_OFFERED}\n")


def test_the_page_tells_of_all_that_is_not_offered():
    headings = [line.lower() for line in PAGE.read_text("utf-8").splitlines() if line[:2] == "##"]
    for topic, words in _NOT_DONE.items():
        spelt = [word.replace("-", " ") for word in words.split()]
        assert any(word in line for word in spelt for line in headings), topic
