"""Examples in docstrings, which the reference shows, print what they say."""

import doctest

import pytest

import roughline as rl

LOOKED_UP = (
    *("press", "press_scan", "compare", "estimate", "theory", "assess", "Question"),
    *("SelfAffine", "Surface", "Line", "read", "write", "prepared", "facing"),
    *("roughness", "isotropic_spectrum", "fit_self_affine", "fit_power_law", "average"),
    *("material", "contact_modulus", "fluid_of", "iso"),
)
"""Names whose pages have an example: those that people look up."""


def examples_of(name):
    """The examples of one name, without those of its members."""
    docstring = getattr(rl, name).__doc__ or ""
    return doctest.DocTestParser().get_doctest(docstring, {}, name, None, 0)


@pytest.mark.parametrize("name", [name for name in rl.__all__ if name != "__version__"])
def test_examples_print_what_they_say(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    test = examples_of(name)
    assert test.examples or name not in LOOKED_UP
    told = []
    doctest.DocTestRunner().run(test, out=told.append)
    assert not told, "".join(told)


@pytest.mark.parametrize("name", LOOKED_UP)
def test_examples_stand_under_their_heading(name):
    text = getattr(rl, name).__doc__
    assert "\n    Examples\n    --------\n    >>> import" in text
    heading, rest = text.split("    Examples\n    --------\n")
    assert ">>>" not in heading
    assert "\n    ----" not in rest  # numpydoc has them last
