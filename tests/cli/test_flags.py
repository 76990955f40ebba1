"""Messages speak of arguments; the command line says its flags instead."""

import pytest

import roughline as rl
from roughline.cli.flags import FLAGS
from roughline.errors.words import called, speaking


@pytest.mark.parametrize(
    ("argument", "in_python", "as_flag"),
    [
        (("E_star",), "E_star=", "--modulus"),
        (("unit", "um"), 'unit="um"', "--unit um"),
        (("sizes", "1 mm, 0.5 mm"), 'sizes="1 mm, 0.5 mm"', "--size '1 mm, 0.5 mm'"),
        (("grid_error", True), "grid_error=True", "--grid-error"),
        (("my_unit",), "my_unit=", "my_unit="),
    ],
)
def test_arguments_are_called_as_the_caller_writes_them(argument, in_python, as_flag):
    assert called(*argument) == in_python
    with speaking(FLAGS):
        assert called(*argument) == as_flag
        with speaking(None):
            assert called(*argument) == in_python
    assert called(*argument) == in_python


def test_a_refusal_begins_with_what_the_caller_calls_its_argument():
    for words, begun in ((None, "n_loads"), (FLAGS, "--loads")):
        with speaking(words), pytest.raises(rl.InputError) as refused:
            rl.Question("scan.x3p", E_star=1e9, n_loads=1)
        assert refused.value.argument == "n_loads"
        assert str(refused.value).startswith(f"{begun} is 1; a whole number")


def test_values_of_a_description_are_called_the_same_for_everyone():
    with speaking(FLAGS), pytest.raises(rl.InputError) as refused:
        rl.Question("scan.x3p", materials="steel hardness=-1 GPa, copper")
    assert str(refused.value).startswith("--materials ")
    assert "--hardness" not in str(refused.value)


def test_a_file_without_unit_is_refused_in_the_words_of_the_caller(tmp_path, invoke):
    body = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(16, 7)
    rl.write(body, tmp_path / "map.nc")
    with pytest.raises(rl.UnitError, match='such as unit="um"$'):
        rl.read(tmp_path / "map.nc")
    code, _, errors = invoke("press", tmp_path / "map.nc", "--modulus", "1 GPa")
    assert code == 2
    assert errors.endswith("such as --unit um\n")
