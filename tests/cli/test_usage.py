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
        (("press", "x", "--slip", "1"), "there is no option --slip; did you mean --shear?"),
        (("press", "x", "--creep", "1"), "there is no option --creep; see roughline creep --help"),
        (("press", "x", "--radius", "1"), "there is no option --radius; see roughline ball --help"),
        (("press", "x", "--xyzzy"), "there is no option --xyzzy; --help lists the options"),
        (
            ("press", "x", "--loads", "10 N"),
            '--loads is "10 N"; a whole number is needed; did you mean --load?',
        ),
        (("press", "x", "--friction", "1,5"), '--friction is "1,5"; a number is needed'),
        (("press", "x", "--trend", "up"), '--trend is "up"; allowed are "none", "mean", "tilt"'),
        (("press", "x", "--modulus", ""), '--modulus is ""; give a value, or leave --modulus out'),
        (("press", "x", "--out="), '--out is ""; give a value, or leave --out out'),
        (
            ("press", "x", "--modulus", "1 GPa", "--modulus=2 GPa"),
            '--modulus is given twice, as "1 GPa" and "2 GPa"; give it once',
        ),
        (
            ("press", "x", "--grid-error", "--no-grid-error"),
            "--grid-error and --no-grid-error are both given: give one of them",
        ),
        (("press", "--elastic", "x", "--elastic"), "--elastic is given twice; give it once"),
        (
            ("campaign", "run", "x", "--store", "--store", "--store", "y"),
            '--store is given twice, as "--store" and "y"; give it once',
        ),
        (
            ("press", "x", "--periodic", "--load", "1 N", "--load", "2 N", "--periodic-along", "x"),
            "--periodic and --periodic-along are both given: give one of them",
        ),
        (
            ("press", "x", "--modulus", "1 GPa", "--crop", "1 um"),
            '--crop is "1 um"; give from and to along each side, such as "0 um, 50 um, 0 um',
        ),
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


@pytest.mark.parametrize("option", ["--loss-modulus", "--sliding", "--wear", "--lubricant"])
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
