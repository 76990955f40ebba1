"""Search for the load at which what lets a fluid through crosses a threshold, by few trials.

The widths of channels fall as the load rises, over decades about as its logarithm does [1]: by a
straight line through two loads, others are expected to lie above the threshold or below. What is
bisected is first followed as it is expected to go, and only its last two loads are pressed. If they
do not turn out as expected, they tell better where to go on, so that the ends are the same as if
each load on the way had been pressed.

References
----------
.. [1] Persson, B. N. J. Relation between interfacial separation and load: a general theory of
   contact mechanics. Phys. Rev. Lett. 99, 125502 (2007).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from roughline.errors import InputError

_Result = TypeVar("_Result")

Hunt = Generator[Sequence[float], Sequence[float], _Result]
"""Asks for rising loads, is sent what is measured under each, and returns what was sought."""

Measuring = Callable[[Sequence[float]], Sequence[float]]
"""What is measured of a body under rising loads."""

Decide = Callable[[float], bool]
"""Whether what is measured under a load is above the threshold."""

_TRIAL_STEP = 1.5  # step from one trial to the next, until one is above and the other below
_MOST_TRIALS = 60  # rounds of loads, until the search gives up
_NEVER = "does not seal under any load that was tried"
_LARGEST_SHARE = 0.999  # of the largest load, at which nothing is left
# In logarithms of the load:
_LARGEST_STEP = 0.09  # between loads above and below, from where a line tells the crossing to 2 %
_LARGEST_STEP_ON_LINE = 0.36  # the same where something is left under both
_LARGEST_REACH = 1.4  # of a line, beyond loads that were tried
_SURENESS = 6.0  # the way along a line over how far it errs


@dataclass
class Trials:
    """Loads that were tried, and what is measured under them: it falls as the load rises."""

    threshold: float = 0.0  # crossed from above as the load rises; zero counts as below
    most: float = math.inf  # load from which on nothing is left
    first: Sequence[float] = ()  # loads to try first
    values: dict[float, float] = field(default_factory=dict)

    def add(self, loads: Sequence[float], values: Sequence[float]) -> None:
        """Note what was measured under loads."""
        self.values |= zip(loads, values, strict=True)

    def is_above(self, load: float) -> bool:
        """Whether it is above the threshold: as measured, by other loads, or as expected."""
        if load in self.values:
            return self._is_above(self.values[load])
        above, below = self.ends
        return load <= above or (load < below and load < self.expected[0])

    @property
    def ends(self) -> tuple[float, float]:
        """The largest load that is above the threshold, and the least that is below."""
        above = [load for load, value in self.values.items() if self._is_above(value)]
        below = [load for load, value in self.values.items() if not self._is_above(value)]
        return max(above, default=0.0), min(below, default=self.most)

    @property
    def is_narrow(self) -> bool:
        """Whether both ends are near to each other; less near if a line leads on to both."""
        above, below = self.ends
        near = _LARGEST_STEP_ON_LINE if self.values.get(below) else _LARGEST_STEP
        return below <= above * math.exp(near)

    @property
    def expected(self) -> tuple[float, float]:
        """The load that is expected to cross the threshold, and a factor by which it may be wrong.

        It is on the line through the two loads next to the threshold under which something is left,
        if that is between both ends.
        """
        above, below = self.ends
        known = sorted((load, value) for load, value in self.values.items() if value > 0)
        lower = [each for each in known if each[0] <= above]
        higher = known[len(lower) :]
        pair = [lower[-1], higher[0]] if lower and higher else lower[-2:] or higher[:2]
        if len(pair) == 2 and pair[0][1] > pair[1][1]:
            (first, before), (second, after) = pair
            along = (after - self.threshold) / (before - after) * math.log(second / first)
            along = min(max(along, -_LARGEST_REACH), _LARGEST_REACH)
            at = second * math.exp(along)
            if above < at < below:
                way = min(abs(along), abs(math.log(at / first)))
                return at, math.exp(max(way / _SURENESS, _LARGEST_STEP / 3))
        if above == 0:
            above = below / _TRIAL_STEP**3
        if below == math.inf:
            below = above * _TRIAL_STEP**3
        return math.sqrt(above * below), (below / above) ** (1 / 6)

    @property
    def to_try(self) -> list[float]:
        """Loads on both sides of the expected one, unless it is known what is there."""
        if not self.values:
            return [*self.first]
        (at, factor), (above, below) = self.expected, self.ends
        return [load for load in (at / factor, at * factor) if above < load < below]

    def _is_above(self, value: float) -> bool:
        return value > 0 and value >= self.threshold


def ends(
    trials: Trials, bisect: Callable[[Decide], tuple[float, float]]
) -> Hunt[tuple[float, float]]:
    """Both ends that a bisection comes to, of loads above the threshold and below it."""
    for _ in range(_MOST_TRIALS):
        loads = trials.to_try
        if trials.is_narrow:
            both = bisect(trials.is_above)
            loads = [load for load in both if load not in trials.values]
            if not loads:
                return both
        trials.add(loads, (yield loads))
    raise InputError(_NEVER, "surface")


def crossing(trials: Trials) -> Hunt[float]:
    """The load at which the threshold is crossed, within about 2 % where a line tells it.

    It is in round numbers: contacts of one body that are searched in two ways differ by less.
    """
    for _ in range(_MOST_TRIALS):
        if trials.is_narrow:
            return float(f"{trials.expected[0]:.4g}")
        loads = trials.to_try
        trials.add(loads, (yield loads))
    raise InputError(_NEVER, "surface")


def bracketed(start: float, most: float, is_above: Decide) -> tuple[float, float]:
    """Loads above and below the threshold, by ever larger steps from one to try first."""
    found: dict[bool, float] = {}
    load, step = start, _TRIAL_STEP
    for _ in range(_MOST_TRIALS):
        above = is_above(load)
        found[above] = load
        if len(found) == 2:
            return found[True], found[False]
        load = load * step if above else load / step
        step *= step
        if load >= _LARGEST_SHARE * most:
            load = math.sqrt(found[True] * most)
    raise InputError(_NEVER, "surface")


def bisected(low: float, high: float, rtol: float, is_above: Decide) -> tuple[float, float]:
    """Loads above and below the threshold that differ by so little."""
    while high > low * (1 + rtol):
        middle = math.sqrt(low * high)
        if is_above(middle):
            low = middle
        else:
            high = middle
    return low, high


def side_by_side(searches: Sequence[Hunt[_Result]], press: Sequence[Measuring]) -> list[_Result]:
    """What searches come to, of bodies that are pressed side by side, as one list."""
    results: dict[int, _Result] = {}
    loads = {number: next(search) for number, search in enumerate(searches)}
    while loads:
        measured = {number: press[number](of_body) for number, of_body in loads.items()}
        loads = {}
        for number, values in measured.items():
            try:
                loads[number] = searches[number].send(values)
            except StopIteration as stop:
                results[number] = stop.value
    return [results[number] for number in range(len(searches))]
