"""Whether maps are of one kind, and the facts on all of them and on single ones."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.part import PartAnswer
from roughline.facts.fact import Fact
from roughline.margins.parts import BehindMaps
from roughline.statistics.student import student
from roughline.topography.body import Body, Surface, point_spacings, side_lengths

_JUDGED_TOGETHER = (
    *("differs_between_places", "drifts", "no_roll_off"),
    *("levelled_by_lines", "levelled_before", "tilted", "bowed"),
)
"""What is said of a map alone, and what several maps are judged by together."""

_LARGEST_AREA_RATIO = 1.05  # largest area over smallest, up to which forces on maps are compared
_ADVISED_MAPS = 5  # maps up to which it is said how much more would help

# Largest over smallest from which on maps are not of one kind. Places of one surface differ in
# their long waves, and so in rms height; an instrument does not change its lens by a tenth.
_KINDS: tuple[tuple[str, Callable[[Body], float], float], ...] = (
    ("rms heights", lambda body: body.rms_height, 3.0),
    ("pixels", lambda body: _mean(point_spacings(body)), 1.5),
    ("sides", lambda body: _mean(side_lengths(body)), 1.5),
)


def _mean(lengths: Sequence[float]) -> float:
    """Geometric mean of those along x and y, or of that of a line. [m]"""
    return float(math.prod(lengths) ** (1 / len(lengths)))


def facts_of_part(
    results: Mapping[str, Assessment], behind: BehindMaps | None, answers: Mapping[str, PartAnswer]
) -> list[Fact]:
    """Facts on a part and on its maps, by their names."""
    maps = list(results.values())
    is_joint = maps[0].question.joint is not None
    facts = {name: each.facts for name, each in results.items()}
    if len(maps) > 1:
        facts = {
            name: [each for each in some if each.innermost.kind not in _JUDGED_TOGETHER]
            for name, some in facts.items()
        }
    of = {key: each.name for key, each in answers.items() if each.is_of_larger}
    return [
        *(() if behind is None else behind.facts(of, is_joint=is_joint)),
        *_sealed_in_some(results, answers),
        *_differences_in_kind(results),
        *_what_is_averaged(maps, is_joint),
        *_once(facts),
    ]


def differ_in_size(results: Sequence[Assessment]) -> bool:
    """Whether maps differ so much in size that quantities of a whole map cannot be compared."""
    areas = [each.area for each in results]
    return max(areas) > _LARGEST_AREA_RATIO * min(areas)


def _differences_in_kind(results: Mapping[str, Assessment]) -> list[Fact]:
    """Point out maps that plainly are not of one kind."""
    found = []
    kinds = {isinstance(each.body, Surface) for each in results.values()}
    if len(kinds) > 1:
        scans = [name for name, each in results.items() if not isinstance(each.body, Surface)]
        found.append(Fact("some_are_scans", names=tuple(scans)))
    for what, of, most in _KINDS:
        sizes = {name: of(each.body) for name, each in results.items()}
        least, largest = min(sizes, key=sizes.__getitem__), max(sizes, key=sizes.__getitem__)
        if sizes[largest] > most * sizes[least]:
            ends = {"least": sizes[least], "largest": sizes[largest]}
            of_ends = {"least_of": least, "largest_of": largest}
            found.append(Fact("not_of_one_kind", what=what, **ends, **of_ends, most=most))
    first = next(iter(results.values()))
    if first.question.joint is None and differ_in_size(list(results.values())):
        found.append(Fact("sizes_differ", can_be_joint=kinds == {True}))
    return found


def _sealed_in_some(
    results: Mapping[str, Assessment], answers: Mapping[str, PartAnswer]
) -> list[Fact]:
    """Say where some maps are sealed and others leak, of which there is no mean."""
    if (answer := answers.get("hydraulic_aperture")) is None:
        return []
    values = np.stack([each.values for each in answer.of_maps])
    loads = np.flatnonzero((values == 0).any(axis=0) & (values > 0).any(axis=0))
    if not loads.size:
        return []
    sealed = [name for name, each in zip(results, values[:, loads[0]], strict=True) if each == 0]
    heading = next(iter(results.values())).headings[loads[0]]
    fact = Fact("sealed_in_some", load=heading, names=tuple(sealed))
    return [fact.concerning("hydraulic_aperture")]


def _what_is_averaged(results: Sequence[Assessment], is_joint: bool) -> list[Fact]:
    """Say what mean, scatter and interval of a part are."""
    count = len(results)
    if count == 1:
        return [Fact("single_map")]
    advised = _ADVISED_MAPS
    factor, factor_of_more = (float(student(each - 1)) for each in (count, advised))
    narrower = factor / factor_of_more * math.sqrt(advised / count)
    numbers = {"count": count, "student": factor, "is_joint": is_joint, "narrower": narrower}
    more = {"more": advised if count < advised else None, "student_of_more": factor_of_more}
    facts = [Fact("mean_of_maps", count=count), Fact("interval_of_part", **numbers, **more)]
    if any(each.intervals is None for each in results):
        facts.append(Fact("some_without_interval"))
    return facts


def _once(facts_by_map: Mapping[str, Sequence[Fact]]) -> list[Fact]:
    """Each fact once, with the names of the maps that it is of, unless it is of all.

    Facts of different maps that differ in their numbers alone are one; it has the numbers of its
    first map. Those of one map, such as of its loads, stay apart.
    """
    found: dict[tuple[Any, ...], dict[str, Fact]] = {}
    for name, facts in facts_by_map.items():
        count: Counter[tuple[Any, ...]] = Counter()
        for fact in dict.fromkeys(facts):
            key = fact.without_numbers
            count[key] += 1
            found.setdefault((key, count[key]), {})[name] = fact
    return [_with_its_maps(by_map, len(facts_by_map)) for by_map in found.values()]


def _with_its_maps(facts: Mapping[str, Fact], count: int) -> Fact:
    """One fact for all maps that it is of, out of so many."""
    first, *others = facts
    maps = () if len(facts) == count else tuple(facts)
    differ = any(str(facts[each]) != str(facts[first]) for each in others)
    fact = facts[first].grave(any(each.is_grave for each in facts.values()))
    if not (maps or differ):
        return fact
    return fact.within(Fact("on_maps", fact=fact, maps=maps, first=first if differ else ""))
