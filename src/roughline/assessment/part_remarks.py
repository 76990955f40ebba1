"""Whether maps are of one kind, and the remarks on all of them and on single ones."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.behind_maps import BehindMaps
from roughline.assessment.kinds import nominal_area
from roughline.assessment.notes import listed, listed_in_short
from roughline.assessment.part import PartAnswer
from roughline.errors.remark import INTERVALS, Remark, remarks
from roughline.errors.words import called
from roughline.spectra.departures import Assumption, departures
from roughline.topography.body import Body, Surface
from roughline.units import engineering

_NUMBER = re.compile(r"\d[\d.]*(e[-+]?\d+)?( ?[afpnµmkMGT]?(m²|m|N/m|N|Pa|Ω|%)(?!\w))?")
_LARGEST_AREA_RATIO = 1.05  # largest area over smallest, up to which forces on maps are compared
_ADVISED_MAPS = 5  # maps up to which it is said how much more would help

# Largest over smallest from which on maps are not of one kind. Places of one surface differ in
# their long waves, and so in rms height; an instrument does not change its lens by a tenth.
_KINDS: tuple[tuple[str, Callable[[Body], float], float], ...] = (
    ("rms heights", lambda body: body.rms_height, 3.0),
    ("pixels", lambda body: _pixel(body), 1.5),
    ("sides", lambda body: nominal_area(body) ** 0.5, 1.5),
)


def remarks_of_part(
    results: Mapping[str, Assessment], behind: BehindMaps | None, answers: Mapping[str, PartAnswer]
) -> tuple[list[Remark], list[Remark]]:
    """Warnings and notes on a part and on its maps, by their names."""
    maps = list(results.values())
    is_joint = maps[0].question.joint is not None
    of_part, agreement = _part_texts(behind, answers, is_joint)
    common = {name: _common_departures(each.body) for name, each in results.items()}
    own = {
        name: [text for text in each.warnings if not text.startswith(common[name])]
        for name, each in results.items()
    }
    warnings = own if len(maps) > 1 else {name: each.warnings for name, each in results.items()}
    notes = {name: each.notes for name, each in results.items()}
    return (
        [
            *remarks(of_part),
            *remarks(_sealed_in_some(results, answers)),
            *remarks(_differences_in_kind(results), is_grave=True),
            *_once(warnings),
        ],
        [
            *remarks(_what_is_averaged(maps, is_joint), INTERVALS),
            *remarks(agreement),
            *_once(notes),
        ],
    )


def _common_departures(body: Body) -> tuple[str, ...]:
    """How what is said of a map alone begins where the maps judge it together."""
    common: tuple[Assumption, ...] = ("stationary", "steady", "longer waves", "roll-off")
    return tuple(each.text for each in departures(body, common))


def differ_in_size(results: Sequence[Assessment]) -> bool:
    """Whether maps differ so much in size that quantities of a whole map cannot be compared."""
    areas = [each.area for each in results]
    return max(areas) > _LARGEST_AREA_RATIO * min(areas)


def _differences_in_kind(results: Mapping[str, Assessment]) -> list[str]:
    """Point out maps that plainly are not of one kind."""
    found = []
    kinds = {isinstance(each.body, Surface) for each in results.values()}
    if len(kinds) > 1:
        scans = [name for name, each in results.items() if not isinstance(each.body, Surface)]
        found.append(f"not of one kind: {', '.join(scans)} is a line scan, and others are maps")
    for what, of, most in _KINDS:
        sizes = {name: of(each.body) for name, each in results.items()}
        least, largest = min(sizes, key=sizes.__getitem__), max(sizes, key=sizes.__getitem__)
        if sizes[largest] > most * sizes[least]:
            ends = [f"{engineering(sizes[name], 'm', 3)} ({name})" for name in (least, largest)]
            found.append(
                f"not of one kind: {what} go from {ends[0]} to {ends[1]}, more than a factor of "
                f"{most:g}; check whether these are maps of one part, measured in the same way"
            )
    first = next(iter(results.values()))
    if first.question.joint is None and differ_in_size(list(results.values())):
        found.append(
            "the maps differ in size, so quantities of a whole map have no common mean; give mean "
            "pressures as loads to compare quantities per area"
            + (f", or the area of the joint ({called('rl.Joint')})" if kinds == {True} else "")
        )
    return found


def _sealed_in_some(
    results: Mapping[str, Assessment], answers: Mapping[str, PartAnswer]
) -> list[str]:
    """Say where some maps are sealed and others leak, of which there is no mean."""
    if (answer := answers.get("hydraulic_aperture")) is None:
        return []
    values = np.stack([each.values for each in answer.of_maps])
    loads = np.flatnonzero((values == 0).any(axis=0) & (values > 0).any(axis=0))
    if not loads.size:
        return []
    sealed = [name for name, each in zip(results, values[:, loads[0]], strict=True) if each == 0]
    heading = next(iter(results.values())).headings[loads[0]]
    return [
        f"under {heading}, {listed(sealed)} let nothing through, and other maps do: what leaks has "
        "no mean over them there, and hangs on the leakiest places; press more maps"
    ]


def _what_is_averaged(results: Sequence[Assessment], is_joint: bool) -> list[str]:
    """Say what mean, scatter and interval of a part are."""
    from scipy.special import stdtrit  # here because it loads slowly

    count = len(results)
    if count == 1:
        return [
            "a single map shows no scatter between places: no interval for the part; map at least "
            "two more places, better four"
        ]
    student = float(stdtrit(count - 1, 0.975))
    scope = (
        "the whole part, its places sharing the load"
        if is_joint
        else "the mean over all its places"
    )
    notes = [
        f"mean: geometric, over {count} maps, taken to be of places chosen at random; scatter: "
        "about two of three places lie within this factor of the mean",
        f"interval of the part: 95 % for {scope}; Student's t on logarithms "
        f"({student:.3g} standard errors for {count} maps), widened by errors that all maps may "
        "have in common and that do not average out, such as the grid's"
        + (", and by how a map differs from the part behind it" if is_joint else ""),
    ]
    if count < _ADVISED_MAPS:
        more = float(stdtrit(_ADVISED_MAPS - 1, 0.975))
        notes[1] += (
            f"; with {_ADVISED_MAPS} maps it is {more:.3g}, and intervals are narrower by a factor "
            f"of {student / more * (_ADVISED_MAPS / count) ** 0.5:.2g} for the same scatter"
        )
    if any(each.intervals is None for each in results):
        notes.append(
            "some maps have no interval of their own; where they have none, the part's interval "
            f"is that of the scatter alone ({called('grid_error', True)} gives the maps intervals)"
        )
    return notes


def _part_texts(
    behind: BehindMaps | None, answers: Mapping[str, PartAnswer], is_joint: bool
) -> tuple[list[str], list[str]]:
    """Say whether maps tell of the part, and whether they agree; warnings and notes."""
    if behind is None:
        return [], []
    warnings: list[str] = []
    notes: list[str] = []
    of_interface = [each.name for each in answers.values() if each.of_maps[0].rule.is_of_interface]
    if behind.why_unknown and of_interface:
        names = "answers of the joint" if is_joint else listed_in_short(of_interface)
        verb = "comes" if len(of_interface) == 1 and not is_joint else "come"
        warnings.append(f"{behind.why_unknown}; {names} {verb} without an interval")
    found = behind.agreement
    if found is None:
        return warnings, notes
    between, within = (f"{math.expm1(each):.2g}" for each in (found.between, found.within))
    numbers = (
        f"rms heights scatter by a factor of {1 + float(between):.3g} between maps, and chance "
        f"explains {1 + float(within):.3g}, as between quarters of a map (ratio of variances "
        f"{found.ratio:.2g}, and chance allows up to {found.chance:.2g})"
    )
    if found.holds:
        notes.append(f"the maps agree: {numbers}")
    else:
        text = (
            f"the maps do not agree: {numbers}; places of the part differ, and rougher ones bear "
            "more of its load than maps under one pressure show: the intervals allow for that; if "
            "the part has regions, ask for each of them"
        )
        warnings.append(Remark(text, is_grave=True))
    return warnings, notes


def _once(texts_by_map: Mapping[str, Sequence[str]]) -> list[Remark]:
    """Each remark once, with the names of the maps that it is of, unless it is of all.

    Remarks of different maps that differ in their numbers alone are one; it has the numbers of its
    first map. Those of one map, such as of its loads, stay apart.
    """
    remarks: dict[tuple[str, int], dict[str, str]] = {}
    for name, texts in texts_by_map.items():
        count: Counter[str] = Counter()
        for text in dict.fromkeys(texts):
            pattern = _NUMBER.sub("#", text)
            count[pattern] += 1
            remarks.setdefault((pattern, count[pattern]), {})[name] = text
    found = []
    for of_maps in remarks.values():
        first, *others = of_maps
        of = "" if len(of_maps) == len(texts_by_map) else f"of {', '.join(of_maps)}: "
        differ = others and len(set(of_maps.values())) > 1
        whose = f" (so for {first}; the numbers of the other maps differ)" if differ else ""
        found.append(Remark(of_maps[first]).reworded(f"{of}{of_maps[first]}{whose}"))
    return found


def _pixel(body: Body) -> float:
    """Side of a pixel, of both the geometric mean. [m]"""
    if isinstance(body, Surface):
        dx, dy = body.spacing
        return float((dx * dy) ** 0.5)
    return body.spacing
