"""What pressing several maps of one part gave: each map's answers, their mean and scatter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.computing.arrays import Indices, Real
from roughline.computing.notebook import in_notebook, printed
from roughline.computing.summary import summary
from roughline.engineering.intervals import Ends
from roughline.engineering.rule import Answer, Rule, within
from roughline.facts.fact import Fact, WithFacts
from roughline.question.question import Question
from roughline.statistics.places import average_of_places


@dataclass(frozen=True, eq=False)
class PartAnswer:
    """One quantity of a part, over the loads.

    Attributes
    ----------
    of_maps : sequence of Answer
        Of each map, with its own interval.
    mean : ndarray, shape (loads,)
        Geometric mean over the maps. [unit]
    scatter : ndarray, shape (loads,)
        Geometric standard deviation over the maps, a factor of at least 1; NaN of a single map.
    low, high : ndarray, shape (loads,)
        Ends of the 95 % interval of the mean over all places of the part; NaN where there is none.
        [unit]
    count : ndarray of int, shape (loads,)
        Maps that have a value.
    """

    of_maps: Sequence[Answer]
    mean: Real
    scatter: Real
    low: Real
    high: Real
    count: Indices

    @classmethod
    def of(
        cls,
        of_maps: Sequence[Answer],
        common: Sequence[Ends] = (),
        sharing: Sequence[Ends] = (),
        *,
        is_supported: bool = True,
    ) -> PartAnswer:
        """Average the answers of one or more maps, within the limits of each of them.

        Ends for each map are of what all miss alike, by default its own interval, and of what its
        value becomes as the places of the part share its load. There is no interval where the maps
        do not tell of the part.
        """
        values = np.stack([each.values for each in of_maps])
        unknown = np.full(values.shape[1], np.nan)
        common = common or [each.ends or (unknown, unknown) for each in of_maps]
        by_sharing = _stacked(sharing) if sharing else None
        found = average_of_places(values, *_stacked(common), by_sharing)
        if len(of_maps) == 1 or not is_supported:
            # what one map leaves open of itself is no interval of the part
            return cls(of_maps, found.mean, found.scatter, unknown, unknown, found.count)
        least, most = zip(*(each.limits for each in of_maps), strict=True)
        limits = reduce(np.minimum, least), reduce(np.maximum, most)
        low, high = within((found.low, found.high), limits)
        return cls(of_maps, found.mean, found.scatter, low, high, found.count)

    def ends_of_maps(self, load: int) -> tuple[Real, Real]:
        """Both ends of each map's own interval at one load, (maps,); its value if it has none."""
        ends = [each.ends or (each.values, each.values) for each in self.of_maps]
        low, high = (np.array([each[load] for each in side]) for side in zip(*ends, strict=True))
        return low, high

    @property
    def key(self) -> str:
        """Name by which it is found, such as "contact_stiffness"."""
        return self.of_maps[0].key

    @property
    def is_of_larger(self) -> bool:
        """Whether it is about the surface that maps were cut out of, rather than about them."""
        return any(each.is_of_larger for each in self.of_maps)

    @property
    def rule(self) -> Rule:
        """That it follows from."""
        return self.of_maps[0].rule

    @property
    def name(self) -> str:
        """What it is called in tables."""
        return self.of_maps[0].name

    @property
    def symbol(self) -> str:
        """What it is called in formulas."""
        return self.of_maps[0].symbol

    @property
    def unit(self) -> str:
        """SI unit."""
        return self.of_maps[0].unit


@dataclass(frozen=True, eq=False)
class PartAssessment(WithFacts):
    """What pressing several maps of one part gave.

    Attributes
    ----------
    question : Question
        What was asked of each map, with the first one's body.
    names : sequence of str
        What the maps that were pressed are called.
    assessments : sequence of Assessment
        Of these maps, in their order.
    refused : mapping of str to str
        Maps that could not be pressed, and why.
    left : sequence of str
        Maps that were not pressed, or not to the end, because Ctrl-C came.
    answers : mapping of str to PartAnswer
        By their keys, over the loads that were asked for. Without a joint, maps of different size
        have no common answers that depend on the size.
    elastic : mapping of str to PartAnswer
        The same without yield; empty where nothing yields in any map.
    facts : sequence of Fact
        On all maps, and on single ones, with their names; warnings first.
    """

    question: Question
    names: Sequence[str]
    assessments: Sequence[Assessment]
    refused: Mapping[str, str]
    left: Sequence[str]
    answers: Mapping[str, PartAnswer]
    elastic: Mapping[str, PartAnswer] = field(default_factory=dict)
    facts: Sequence[Fact] = ()

    __repr__ = summary
    __str__ = printed
    _repr_html_ = in_notebook

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C came before the last map was done."""
        return bool(self.left)

    @property
    def headings(self) -> list[str]:
        """What each load is called: as it was typed."""
        return self.question.loading.headings

    @property
    def largest(self) -> int:
        """Number of the largest load among those that were asked for."""
        return self.assessments[0].largest


def _stacked(ends: Sequence[Ends]) -> Ends:
    """Both ends of all maps, each (maps, loads)."""
    low, high = zip(*ends, strict=True)
    return np.stack(low), np.stack(high)
