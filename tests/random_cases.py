"""How many random cases tests try: few in `make test`, a share in `make full`, all every week."""

import os

import pytest

ALL = os.environ.get("ROUGHLINE_CASES") == "all"


def cases(number, share):
    """Return how many of a number of cases are tried: all of them, or one in `share`."""
    return number if ALL else number // share


def seeds(few, many, first=0):
    """Run a test on `seeds`: the first few are a short case of it, the others of all a long one."""
    ranges = [range(first, first + few), range(first + few, first + many)]
    return pytest.mark.parametrize("seeds", ranges, ids=["few", "many"])
