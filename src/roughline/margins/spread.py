"""What one cause alone leaves open of a curve's values, and what all of them together do."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.measures import Measured
from roughline.engineering.intervals import Ends, Intervals

_LEAST_OPEN = 1e-9  # share of the area that is not in contact; less counts as this
_LEAST_OF_FLOOR = 1e-12  # of a floor; less of a measure is none
_PROBE = 0.01  # relative distance of ends that show what a cause moves
FLOOR = 0.3  # of a measure, added before its logarithm is taken: what is sealed has none


def logit(share: Real) -> Real:
    """Logarithm of a share over the rest."""
    with np.errstate(divide="ignore"):
        return np.log(share) - np.log1p(-share)


@dataclass(frozen=True)
class Scale:
    """A scale on which a quantity scatters evenly, and the way back."""

    to: Callable[[Real], Real]
    back: Callable[[Real], Real]

    def moved(self, values: Real, differences: Ends) -> Ends:
        """Both ends of values that differ by so much on this scale; what has no place on it stays.

        That is nothing at all; and what is infinite has any finite value within.
        """
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            place = self.to(values)
            low, high = (self.back(place + each) for each in differences)
            least = self.back(np.full_like(place, -np.inf))
        low = np.where(np.isneginf(differences[0]) & ~np.isnan(values), least, low)
        stays = np.isneginf(place)
        return np.where(stays, values, low), np.where(stays, values, high)

    def distance(self, values: Real, others: Real) -> Real:
        """By how much values differ from others on this scale."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(others == values, 0.0, np.abs(self.to(others) - self.to(values)))

    def together(self, values: Real, ends: Sequence[Ends]) -> Ends:
        """Both ends that independent causes leave open: their distances add in squares."""
        if len(ends) < 2:
            return ends[0] if ends else (values, values)
        found = []
        for sign, side in zip((-1.0, 1.0), zip(*ends, strict=True), strict=True):
            squares = np.square([self.distance(values, each) for each in side])
            moved = np.sqrt(squares.sum(axis=0))
            with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                there = self.back(self.to(values) + sign * moved)
            found.append(np.where(moved == 0, values, there))
        return found[0], found[1]


LOGARITHM = Scale(np.log, np.exp)
"""Of a stiffness."""

LOGIT = Scale(
    lambda share: logit(np.minimum(share, 1 - _LEAST_OPEN)),
    lambda odds: 1 / (1 + np.exp(-odds)),
)
"""Of a share of the area."""


def with_floor(floor: Real) -> Scale:
    """Scale of a measure that may be zero: the logarithm of the measure and a floor.

    Near sealing places scatter evenly in the aperture itself, and elsewhere in its logarithm.
    """
    return Scale(lambda value: np.log(value + floor), lambda log: np.exp(log) - floor)


@dataclass(frozen=True, eq=False)
class Values:
    """What a curve gives under each of its loads, of which something is left open."""

    stiffness: Real  # on further loading [N / m]
    unloading: Real  # without yield it is the same [N / m]
    area: Real  # corrected contact area fraction; NaN where the model has none [1]
    measures: Mapping[str, Real] = field(default_factory=dict)
    least_area: Real | None = None  # that bears the force, if bodies may yield [1]

    @classmethod
    def of(cls, curve: Curve) -> Values:
        """What a curve gives; of a line, whose model has no yield and no area, less."""
        if not isinstance(curve, SurfaceCurve):
            return cls(curve.stiffness, curve.stiffness, np.full_like(curve.force, np.nan))
        hardness = curve.hardness
        return cls(
            curve.stiffness,
            curve.unloading_stiffness,
            curve.area_fraction_corrected,
            {name: each.values for name, each in curve.measured.items()},
            None if hardness is None else curve.force / (hardness * curve.length**2),
        )


@dataclass(frozen=True, eq=False)
class Spread:
    """Both ends of the values of a curve that are left open, by one cause or by several."""

    stiffness: Ends  # on further loading [N / m]
    unloading: Ends  # [N / m]
    area: Ends  # of the corrected area fraction [1]
    measures: Mapping[str, Ends] = field(default_factory=dict)
    floors: Mapping[str, Real] = field(default_factory=dict)
    """Of measures that may be zero, if the cause knows how large they are elsewhere."""

    @property
    def is_known(self) -> bool:
        """Whether the ends of each quantity are known under some load."""
        ends = (self.stiffness, self.unloading, self.area, *self.measures.values())
        return not any(np.isnan(each).all() for each in ends)

    @classmethod
    def probe(cls, values: Values) -> Spread:
        """Ends a little away from all values, which show what follows from them."""

        def ends(value: Real) -> Ends:
            return value / (1 + _PROBE), value * (1 + _PROBE)

        measures = {name: ends(value) for name, value in values.measures.items()}
        return cls(ends(values.stiffness), ends(values.unloading), ends(values.area), measures)

    @classmethod
    def between(
        cls, values: Values, others: Sequence[Values], *, times: float = 1.0, more: Real | float = 0
    ) -> Spread:
        """Leave open how far other curves are from a curve, to either side.

        The other ones are as good as the curve. Ends are so many times the root mean square of
        their distances away from it; values may be larger or smaller by a share `more` besides.
        """

        def ends(value: Real, found: Sequence[Real], scale: Scale) -> Ends:
            squares = np.square([scale.distance(value, each) for each in found])
            distance = np.hypot(times * np.sqrt(squares.mean(axis=0)), np.log1p(more))
            with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                low, high = (scale.back(scale.to(value) + each) for each in (-distance, distance))
            return np.where(distance == 0, value, low), np.where(distance == 0, value, high)

        measures = {}
        for name, value in values.measures.items():
            found = [each.measures[name] for each in others]
            measures[name] = ends(value, found, with_floor(_floor([value, *found])))
        return cls(
            ends(values.stiffness, [each.stiffness for each in others], LOGARITHM),
            ends(values.unloading, [each.unloading for each in others], LOGARITHM),
            ends(values.area, [each.area for each in others], LOGIT),
            measures,
        )

    @classmethod
    def together(cls, values: Values, spreads: Sequence[Spread]) -> Spread:
        """What independent causes leave open together; nothing where there is none."""
        return cls(
            LOGARITHM.together(values.stiffness, [each.stiffness for each in spreads]),
            LOGARITHM.together(values.unloading, [each.unloading for each in spreads]),
            LOGIT.together(values.area, [each.area for each in spreads]),
            measures_together(values.measures, spreads),
        )


def _floor(values: Sequence[Real]) -> Real:
    """What is added to a measure that may be zero: a share of the largest that is known."""
    finite = [np.where(np.isfinite(each), np.abs(each), 0.0) for each in values]
    largest = np.max(finite, axis=0)
    return FLOOR * np.where(largest > 0, largest, 1.0)


def measures_together(values: Mapping[str, Real], spreads: Sequence[Spread]) -> dict[str, Ends]:
    """Both ends of measures that independent causes leave open together."""
    found = {}
    for name, value in values.items():
        ends = [each.measures[name] for each in spreads if name in each.measures]
        given = [each.floors[name] for each in spreads if name in each.floors]
        floor = np.max(given, axis=0) if given else np.zeros_like(value)
        floor = np.where(floor > 0, floor, _floor([value, *(high for _, high in ends)]))
        low, high = with_floor(floor).together(value, ends)
        none = (value >= 0) & (low < _LEAST_OF_FLOOR * floor)
        found[name] = np.where(none, 0.0, low), high
    return found


def intervals_within(values: Values, spreads: Iterable[Spread | None]) -> Intervals | None:
    """Intervals that causes leave open, within what can be; None where one is not known."""
    found = _all_known(spreads)
    if found is None:
        return None
    together = Spread.together(values, found)
    stiffness, (low, high) = together.stiffness, together.area
    if values.least_area is not None:  # no area bears more than the hardness
        low = np.maximum(low, values.least_area)
        stiffness = loading_under_unloading(stiffness, together.unloading)
    return Intervals(stiffness, together.unloading, (low, high))


def measured_within(
    measured: Mapping[str, Measured], spreads: Iterable[Spread | None]
) -> dict[str, Measured]:
    """Measures with the intervals that causes leave open; none where one is not known."""
    known = _all_known(spreads)
    found = {name: replace(each, low=None, high=None) for name, each in measured.items()}
    if known is None:
        return found
    values = {name: each.values for name, each in measured.items()}
    for name, (low, high) in measures_together(values, known).items():
        if not np.isnan([low, high]).all():
            found[name] = replace(measured[name], low=low, high=high)
    return found


def _all_known(spreads: Iterable[Spread | None]) -> list[Spread] | None:
    """The spreads; None where one is not known."""
    found = list(spreads)
    known = [each for each in found if each is not None]
    return known if len(known) == len(found) else None


def loading_under_unloading(loading: Ends, unloading: Ends) -> Ends:
    """Ends of the stiffness on loading, which lies between none and that on unloading.

    These bounds are all that is known where a coarser grid has no point below the hardness.
    """
    known = np.isfinite(unloading[1])
    low = np.where(np.isnan(loading[0]) & known, 0.0, loading[0])
    return low, np.where(known, np.fmin(loading[1], unloading[1]), loading[1])
