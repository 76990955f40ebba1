import pytest

from mutants import PACKAGE, TESTS, mutants


@pytest.mark.parametrize("mutant", mutants(), ids=lambda each: f"{each.file}: {each.wrong}")
def test_a_mistake_can_be_planted_in_one_place_and_has_tests(mutant):
    assert (PACKAGE / mutant.file).read_text(encoding="utf-8").count(mutant.right) == 1
    assert mutant.wrong != mutant.right
    assert (TESTS / mutant.found_by).is_file()
