"""The answers of a part, its maps and what each of them gives, as tables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from roughline.report.contact_tables import (
    IF_ELASTIC,
    UNRESOLVED,
    differs,
    leading_keys,
    quantity,
    star_is_shown,
    starred,
    unit_shown,
)
from roughline.report.groups import Group, figures_of, groups_of, headline_of, sentence
from roughline.report.page import Headline
from roughline.report.values import with_interval
from roughline.topography.body import Body, Surface
from roughline.units import decimal, engineering

if TYPE_CHECKING:
    from roughline.assessment.part import PartAnswer, PartAssessment

_NO_MEAN = "-"
"""Written where maps have no common value."""

_SAME = 1e-6  # scatter below which a quantity was given, and did not come out


def part_table(
    part: PartAssessment,
    loads: Sequence[int],
    *,
    keys: Sequence[str] | None = None,
    with_elastic: bool = False,
) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of mean, interval and scatter of all answers at some of the loads.

    A star marks loads under which the grid decides on a map. The mean of elastic bodies stands
    below, if wanted, where yield changes it by more than its interval.
    """
    headings = [starred(each) for each in part.assessments]
    header = [""]
    for i in loads:
        header += [max((each[i] for each in headings), key=len), "scatter"]
    rows = []
    for key in part.answers if keys is None else keys:
        each = part.answers[key]
        row = [f"{each.name} {each.symbol}"]
        for i in loads:
            row += [_mean_and_interval(each, i), scatter_in_words(each, i)]
        rows.append(row)
        elastic = part.elastic.get(key) if with_elastic else None
        if elastic is not None and any(_differs(elastic, each, i) for i in loads):
            row = [IF_ELASTIC]
            for i in loads:
                row += [_mean(elastic, i), ""]
            rows.append(row)
    return header, rows


def part_load_table(part: PartAssessment, keys: Sequence[str]) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of mean, interval and scatter, with a row for each load.

    A single map has no scatter.
    """
    headings = [starred(each) for each in part.assessments]
    answers, several = [part.answers[key] for key in keys], len(part.names) > 1
    header = ["load"]
    rows = [[max((each[i] for each in headings), key=len)] for i in range(len(part.headings))]
    for each in answers:
        header.append(f"{each.name} {each.symbol}")
        header += [f"scatter of {each.symbol}"] if several else []
        for i, row in enumerate(rows):
            row.append(_mean_and_interval(each, i))
            row += [scatter_in_words(each, i)] if several else []
    return header, rows


def elastic_of_part_in_words(part: PartAssessment) -> str:
    """Say what the leading means would be of elastic bodies, at the largest load.

    Answers that yield does not change by more than their interval are left out.
    """
    i = part.largest
    shown = []
    for key in leading_keys_of(part):
        elastic, answer = part.elastic.get(key), part.answers.get(key)
        if elastic is not None and answer is not None and _differs(elastic, answer, i):
            shown.append(f"{elastic.name} {_mean(elastic, i)}")
    return f"for comparison, {IF_ELASTIC}: {', '.join(shown)}" if shown else ""


def each_map_table(
    part: PartAssessment, load: int, maps: Sequence[int]
) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of all answers of some of the maps, at one load.

    A star after a map's name marks that the grid decides on its values.
    """
    stars = [starred(each)[load].removeprefix(part.headings[load]) for each in part.assessments]
    header = [part.headings[load], *(f"{part.names[i]}{stars[i]}" for i in maps)]
    keys = part.assessments[0].answers
    rows = []
    for key, first in keys.items():
        found = [part.assessments[i].answers.get(key) for i in maps]
        cells = [_NO_MEAN if each is None else quantity(each, load) for each in found]
        rows.append([f"{first.name} {first.symbol}", *cells])
    return header, rows


def maps_table(part: PartAssessment) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of what each map is, and of those that were not pressed."""
    header = ["map", "points", "sides", "rms height", "rms slope"]
    rows = [
        [name, *body_in_words(each.body)]
        for name, each in zip(part.names, part.assessments, strict=True)
    ]
    rows += [[name, "refused", "", "", ""] for name in part.refused]
    rows += [[name, "not pressed", "", "", ""] for name in part.left]
    return header, rows


def leading_table(part: PartAssessment) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of each map's leading answers at the largest load."""
    first, load = part.assessments[0], part.largest
    keys = leading_keys_of(part)
    header = [part.headings[load], *(first.answers[key].symbol for key in keys)]
    rows = []
    for name, each in zip(part.names, part.assessments, strict=True):
        star = starred(each)[load].removeprefix(part.headings[load])
        cells = [
            quantity(each.answers[key], load) if key in each.answers else _NO_MEAN for key in keys
        ]
        rows.append([f"{name}{star}", *cells])
    return header, rows


def leading_keys_of(part: PartAssessment) -> list[str]:
    """Keys of the answers that the page of a part begins with: those of its maps."""
    keys = max(map(leading_keys, part.assessments), key=len)  # some maps may yield, and others not
    return [key for key in keys if key in part.assessments[0].answers]


def told_of_part(part: PartAssessment, key: str) -> str:
    """Name, mean and interval of an answer at the largest load."""
    answer = part.answers[key]
    return f"{answer.name} {answer.symbol} {_mean_and_interval(answer, part.largest)}"


def count_in_words(part: PartAssessment) -> str:
    """Number of maps on the page, and of all maps if some are missing."""
    count = len(part.names)
    text = f"{count} maps" if count > 1 else "a single map"
    missing = len(part.refused) + len(part.left)
    return f"{text} of {count + missing}" if missing else text


def lead_of_part(part: PartAssessment) -> str:
    """What was asked: both materials, and the largest load."""
    i = part.largest
    pair, joint = part.question.pair, part.question.joint
    if pair is None:
        return ""
    under = part.headings[i] + (
        "" if joint is None else f" on a joint of {engineering(joint, 'm²')}"
    )
    count = len(part.headings)
    which = f", the largest of {count} loads" if count > 1 else ""
    text = f"{pair.first.name} on {pair.second.name} under {under}{which}"
    if not any(key in part.answers for key in leading_keys_of(part)):
        return sentence(f"{text}: the maps have no common mean")
    unsure = any(not each.curve_as_asked.resolved[i] for each in part.assessments)
    return sentence(text + (f" ({UNRESOLVED})" if unsure else ""))


def headline_of_part(part: PartAssessment) -> Headline:
    """Means of the leading answers with their intervals, and how far places scatter."""
    i = part.largest
    leading = [key for key in leading_keys_of(part) if key in part.answers]
    shown = [part.answers[key] for key in figures_of(groups_of_part(part), leading)]
    below = [elastic_of_part_in_words(part)]
    if leading and len(part.names) > 1:
        first = part.answers[leading[0]]
        below.insert(0, f"places scatter by {scatter_in_words(first, i)} in {first.name}")
    return headline_of(
        [(each.name, _mean_and_interval(each, i)) for each in shown], part.warnings, below
    )


def groups_of_part(part: PartAssessment) -> list[Group]:
    """The groups of its answers."""
    return groups_of(part.answers, leading_keys_of(part))


def _mean_and_interval(answer: PartAnswer, i: int) -> str:
    """Write the mean of an answer at one load, with its interval where there is one."""
    mean = float(answer.mean[i])
    if np.isnan(mean):
        return _NO_MEAN
    ends = (float(answer.low[i]), float(answer.high[i]))
    return with_interval(mean, ends, unit_shown(answer.of_maps[0]))


def _mean(answer: PartAnswer, i: int) -> str:
    """Write the mean of an answer at one load alone."""
    mean = float(answer.mean[i])
    return _NO_MEAN if np.isnan(mean) else with_interval(mean, None, unit_shown(answer.of_maps[0]))


def _differs(elastic: PartAnswer, yielding: PartAnswer, i: int) -> bool:
    """Whether yield changes a mean by more than its interval."""
    ends = float(yielding.low[i]), float(yielding.high[i])
    return differs(float(elastic.mean[i]), float(yielding.mean[i]), ends)


def scatter_in_words(answer: PartAnswer, i: int) -> str:
    """Write the scatter of an answer between maps: per cent where small, a factor where large."""
    factor = float(answer.scatter[i])
    if np.isnan(factor) or answer.count[i] < 2:
        return _NO_MEAN
    if factor < 1 + _SAME:
        return "none"
    return f"{100 * (factor - 1):.2g}%" if factor < 1.5 else f"factor {decimal(factor, 3)}"


def star_is_shown_of(part: PartAssessment) -> bool:
    """Whether the grid decides on a map, under one of the loads."""
    return any(map(star_is_shown, part.assessments))


def body_in_words(body: Body) -> list[str]:
    """Points, sides, rms height and rms slope of a map or a line scan."""
    if isinstance(body, Surface):
        points = f"{body.shape[0]} x {body.shape[1]}"
        sides = " x ".join(engineering(size, "m", 3) for size in body.sizes)
    else:
        points, sides = str(body.heights.size), engineering(body.length, "m", 3)
    return [points, sides, engineering(body.rms_height, "m", 3), decimal(body.rms_slope, 3)]
