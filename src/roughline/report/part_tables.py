"""The maps of a part, and what each of them gives, as tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughline.report.answers import NO_MEAN, leading_keys, marks, quantity
from roughline.report.values import Write, with_interval
from roughline.topography.body import Body, Surface
from roughline.units import decimal, engineering

if TYPE_CHECKING:
    from roughline.assessment.part import PartAssessment


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


def leading_table(
    part: PartAssessment, write: Write = with_interval
) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of each map's leading answers at the largest load."""
    first, load = part.assessments[0], part.largest
    of_maps = map(leading_keys, part.assessments)  # some maps may yield, and others not
    keys = [key for key in max(of_maps, key=len) if key in first.answers]
    header = [part.headings[load], *(first.answers[key].symbol for key in keys)]
    rows = []
    for name, each in zip(part.names, part.assessments, strict=True):
        cells = [
            quantity(each.answers[key], load, write) if key in each.answers else NO_MEAN
            for key in keys
        ]
        rows.append([f"{name}{marks(each)[load]}", *cells])
    return header, rows


def count_in_words(part: PartAssessment) -> str:
    """Number of maps on the page, and of all maps if some are missing."""
    count = len(part.names)
    text = f"{count} maps" if count > 1 else "a single map"
    missing = len(part.refused) + len(part.left)
    return f"{text} of {count + missing}" if missing else text


def body_in_words(body: Body) -> list[str]:
    """Points, sides, rms height and rms slope of a map or a line scan."""
    if isinstance(body, Surface):
        points = f"{body.shape[0]} x {body.shape[1]}"
        sides = " x ".join(engineering(size, "m", 3) for size in body.sizes)
    else:
        points, sides = str(body.heights.size), engineering(body.length, "m", 3)
    return [points, sides, engineering(body.rms_height, "m", 3), decimal(body.rms_slope, 3)]
