"""Where something that falls as the load rises crosses a threshold, by few trials."""

import math
from functools import partial

import numpy as np
import pytest

import roughline as rl
from roughline.fluid.trials import Trials, bisected, bracketed, crossing, ends, side_by_side

SHAPES = {
    "logarithm": lambda load: -math.log(load),
    "line": lambda load: 1 - load,
    "power": lambda load: load**-0.2 - 1,
    "late": lambda load: 1 - load**3,
    "two channels": lambda load: max(0.05 * (1 - load), 1 - 2 * load),
}
"""What is left open under a load; nothing from 1 on."""


def measured(shape, at, tried):
    """What is left of a shape that closes at a load; it notes what is tried."""

    def press(loads):
        assert list(loads) == sorted(loads)
        tried.append(list(loads))
        return [max(0.0, shape(load / at)) for load in loads]

    return press


def sought(search, press):
    return side_by_side([search], [press])[0]


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
@pytest.mark.parametrize("at", [0.1, 0.3, 0.8, 1.0, 1.7, 5.0])
def test_the_ends_are_those_of_bisection_step_by_step(shape, at):
    tried, every = [], []

    def step_by_step(load):
        every.append(load)
        return shape(load / at) > 0

    def bisect(is_above):
        return bisected(*bracketed(1.0, math.inf, is_above), 0.01, is_above)

    found = sought(ends(Trials(first=[0.45, 0.67]), bisect), measured(shape, at, tried))
    assert found == bisect(step_by_step)
    assert len(tried) <= len(every)


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
@pytest.mark.parametrize("threshold", [0.0, 0.1])
@pytest.mark.parametrize("at", [0.3, 0.9, 1.1, 2.0])
def test_the_crossing_is_known_within_two_per_cent_where_lines_tell_it(shape, threshold, at):
    tried = []
    found = sought(crossing(Trials(threshold, first=[0.7, 0.95])), measured(shape, at, tried))
    is_bent = shape in (SHAPES["late"], SHAPES["two channels"])  # a line leads astray
    tolerance = 1.045 if is_bent else 1.02
    assert shape(found / at / tolerance) > threshold > shape(found / at * tolerance)
    assert len(tried) <= 7


def test_what_is_left_by_a_yielding_surface_is_sought_below_the_hardness():
    tried = []
    at = sought(crossing(Trials(most=2.0, first=[0.5, 0.7])), measured(SHAPES["line"], 1.98, tried))
    assert at == pytest.approx(1.98, rel=0.045)  # up to 2 nothing more is known
    assert max(map(max, tried)) < 2


def test_bodies_side_by_side_are_pressed_as_one_list():
    closing = [0.8, 1.0, 1.2]
    tried = [[] for _ in closing]
    shape = SHAPES["logarithm"]
    found = side_by_side(
        [crossing(Trials(first=[0.7, 0.95])) for _ in closing],
        [measured(shape, *each) for each in zip(closing, tried, strict=True)],
    )
    assert found == pytest.approx(closing, rel=0.01)
    alone = [sought(crossing(Trials(first=[0.7, 0.95])), measured(shape, at, [])) for at in closing]
    assert found == alone


def test_what_no_load_closes_is_refused():
    for search in (
        crossing(Trials(first=[0.5, 0.7])),
        ends(Trials(first=[0.5, 0.7]), partial(bracketed, 1.0, math.inf)),
    ):
        with pytest.raises(rl.InputError, match="does not seal under any load"):
            sought(search, lambda loads: list(np.ones(len(loads))))
