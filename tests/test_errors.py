"""Errors: which argument mends them."""

import pickle

import numpy as np
import pytest

import roughline as rl


@pytest.mark.parametrize(
    ("arguments", "argument"),
    [
        ({"sizes": 1.0}, "unit"),
        ({"unit": "m"}, "sizes"),
        ({"unit": "m", "sizes": 1.0, "most_missing": 0.0}, "most_missing"),
        ({"unit": "m", "sizes": 1.0, "trend": "cubic"}, None),
    ],
)
def test_an_error_names_the_argument_that_mends_it(tmp_path, arguments, argument):
    heights = np.random.default_rng(0).normal(size=(8, 8))
    heights[3, 3] = np.nan
    np.save(tmp_path / "map.npy", heights)
    with pytest.raises(rl.InputError) as caught:
        rl.read(tmp_path / "map.npy", **arguments)
    assert caught.value.argument == argument
    assert argument is None or argument in str(caught.value)
    assert "--" not in str(caught.value)


def test_errors_travel_between_processes():
    error = pickle.loads(pickle.dumps(rl.UnitError("no unit", argument="unit")))
    assert (type(error), str(error), error.argument) == (rl.UnitError, "no unit", "unit")
