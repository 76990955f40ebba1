"""Whether maps are of one kind, and the remarks on all of them and on single ones."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence

from roughline.assessment.assessment import Assessment
from roughline.assessment.nominal import nominal_area
from roughline.topography.body import Body, Surface
from roughline.units import engineering

_NUMBER = re.compile(r"\d[\d.]*(e[-+]?\d+)?( ?[afpnµmkMGT]?(m²|m|N/m|N|Pa|Ω|%)(?!\w))?")
_SAME_SIZE = 1.05  # largest area over smallest, up to which forces on maps are compared
_FEW = 5  # maps up to which it is said how much more would help

# Largest over smallest from which on maps are not of one kind. Places of one surface differ in
# their long waves, and so in rms height; an instrument does not change its lens by a tenth.
_KINDS: tuple[tuple[str, Callable[[Body], float], float], ...] = (
    ("rms heights", lambda body: body.rms_height, 3.0),
    ("pixels", lambda body: _pixel(body), 1.5),
    ("sides", lambda body: nominal_area(body) ** 0.5, 1.5),
)


def differ_in_size(results: Sequence[Assessment]) -> bool:
    """Whether maps differ so much in size that quantities of a whole map cannot be compared."""
    areas = [each.area for each in results]
    return max(areas) > _SAME_SIZE * min(areas)


def differences_in_kind(results: Mapping[str, Assessment]) -> list[str]:
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
            + (", or the area of the joint (joint_area=)" if kinds == {True} else "")
        )
    return found


def what_is_averaged(results: Sequence[Assessment]) -> list[str]:
    """Say what mean, scatter and interval of a part are."""
    from scipy.special import stdtrit  # here because it loads slowly

    count = len(results)
    if count == 1:
        return [
            "a single map shows no scatter between places: no interval for the part; map at least "
            "two more places, better four"
        ]
    student = float(stdtrit(count - 1, 0.975))
    notes = [
        f"mean: geometric, over {count} maps, taken to be of places chosen at random; scatter: "
        "about two of three places lie within this factor of the mean",
        "interval of the part: 95 % for the mean over all its places, Student's t on logarithms "
        f"({student:.3g} standard errors for {count} maps), widened by errors that all maps may "
        "have in common, such as the grid's error and waves longer than a map, which do not "
        "average out",
    ]
    if count < _FEW:
        more = float(stdtrit(_FEW - 1, 0.975))
        notes[1] += (
            f"; with {_FEW} maps it is {more:.3g}, and intervals are narrower by a factor of "
            f"{student / more * (_FEW / count) ** 0.5:.2g} for the same scatter"
        )
    if any(each.intervals is None for each in results):
        notes.append(
            "some maps have no interval of their own; where they have none, the part's interval "
            "is that of the scatter alone (grid_error=True gives the maps intervals)"
        )
    return notes


def what_the_maps_say(results: Mapping[str, Assessment]) -> tuple[list[str], list[str]]:
    """Warnings and notes of all maps: those of all once, the others with the maps' names."""
    return (
        _once({name: each.warnings for name, each in results.items()}),
        _once({name: each.notes for name, each in results.items()}),
    )


def _once(said: Mapping[str, Sequence[str]]) -> list[str]:
    """Each remark once, with the names of the maps that it is of, unless it is of all.

    Remarks of different maps that differ in their numbers alone are one; it has the numbers of its
    first map. Those of one map, such as of its loads, stay apart.
    """
    remarks: dict[tuple[str, int], dict[str, str]] = {}
    for name, texts in said.items():
        count: Counter[str] = Counter()
        for text in dict.fromkeys(texts):
            alike = _NUMBER.sub("#", text)
            count[alike] += 1
            remarks.setdefault((alike, count[alike]), {})[name] = text
    found = []
    for of_maps in remarks.values():
        first, *others = of_maps
        of = "" if len(of_maps) == len(said) else f"of {', '.join(of_maps)}: "
        if others and len(set(of_maps.values())) > 1:
            of += f"(numbers of {first}) "
        found.append(f"{of}{of_maps[first]}")
    return found


def _pixel(body: Body) -> float:
    """Side of a pixel, of both the geometric mean. [m]"""
    if isinstance(body, Surface):
        dx, dy = body.spacing
        return float((dx * dy) ** 0.5)
    return body.spacing
