"""Messages speak of arguments; the command line says its flags instead."""

import pytest

import roughline as rl
from roughline.cli.flags import in_flags


@pytest.mark.parametrize(
    ("message", "told"),
    [
        ("give E_star= or materials=", "give --modulus or --materials"),
        ('such as unit="um"', "such as --unit um"),
        ('such as sizes="1 mm, 0.5 mm"', "such as --size '1 mm, 0.5 mm'"),
        ("with grid_error=True it is", "with --grid-error it is"),
        ("a unit = um is not an argument", "a unit = um is not an argument"),
        ("my_unit=3", "my_unit=3"),
        ('give it with the material, as "hardness=..."',) * 2,
    ],
)
def test_arguments_become_flags(message, told):
    assert in_flags(message) == told


def test_a_file_without_unit_is_refused_in_the_words_of_the_caller(tmp_path, invoke):
    body = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(16, 7)
    rl.write(body, tmp_path / "map.nc")
    with pytest.raises(rl.UnitError, match='such as unit="um"$'):
        rl.read(tmp_path / "map.nc")
    code, _, errors = invoke("press", tmp_path / "map.nc", "--modulus", "1 GPa")
    assert code == 2
    assert errors.endswith("such as --unit um\n")
