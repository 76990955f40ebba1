"""Several maps of a part: each read and checked, and what they gave together."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.assessment.part import PartAnswer, PartAssessment
from roughline.errors.checks import shortened
from roughline.errors.words import speaking
from roughline.lab.frames import frame
from roughline.lab.measured.state import (
    PAGE_WORDS,
    control_texts,
    page_preparation,
    page_reading,
    page_sources,
    used_in,
)
from roughline.lab.panels import PanelContent, Points
from roughline.lab.server.tasks import Arguments, Progress, without_paths
from roughline.question.source import Topography
from roughline.report.answers import leading_keys, written_unit
from roughline.report.part_tables import body_in_words, leading_table, maps_table
from roughline.report.values import figure, up_to_three_digits, written_scale

_GIVEN_WITHIN = 1e-9  # relative range up to which an answer was given and did not come out


@speaking(PAGE_WORDS)
def maps(arguments: Arguments, progress: Progress) -> bytes:
    """Each map of a part as it is read and prepared, or why it is refused."""
    sources = page_sources(control_texts(arguments), arguments["session"])
    (reading_of_all, preparation), refused = used_in(
        arguments, lambda texts: (page_reading(texts, None), page_preparation(texts))
    )
    rows = []
    for i, source in enumerate(sources):
        progress(i, len(sources))
        row = {"file": source.key, "name": source.name, "cells": [], "refused": ""}
        reading = replace(reading_of_all, name=source.name)
        try:
            row["cells"] = body_in_words(Topography.of(source.path, reading, preparation).body)
        except rl.InputError as error:
            row["refused"] = without_paths(str(error), arguments)
        rows.append(row)
    return frame({"maps": rows, "refused": refused})


def part_in_words(part: PartAssessment, chosen: int) -> dict[str, Any]:
    """Names and tables of the maps of a part, of which one is shown alone, and its drawings."""
    tables = {
        "measured-part-leading": leading_table(part, up_to_three_digits),
        "measured-part-maps": maps_table(part),
    }
    leading = [key for key in leading_keys(part.assessments[0]) if key in part.answers]
    others = [key for key in part.answers if key not in leading]
    drawn = {}
    for answer in map(part.answers.get, (*leading, *others)):
        assert answer is not None
        values = np.array([each.values[part.largest] for each in answer.of_maps])
        if np.ptp(values) > _GIVEN_WITHIN * np.max(values):  # those that differ between the maps
            drawn[f"{answer.name} {answer.symbol}"] = vars(_panel(part, answer, values))
    maps = {"names": part.names, "shown": chosen}
    return {"part": maps, "tables": tables, "choices": {"part": drawn}}


def _panel(part: PartAssessment, answer: PartAnswer, values: NDArray[np.float64]) -> PanelContent:
    """One answer of each map at the largest load, the mean, and the part's interval."""
    load, count = part.largest, len(part.names)
    factor, unit = written_scale(float(np.nanmax(values)), written_unit(answer))
    unit, (low, high) = unit.strip(), (end * factor for end in answer.ends_of_maps(load))
    values, mean = values * factor, float(answer.mean[load]) * factor
    interval = [float(end[load]) * factor for end in (answer.low, answer.high)]
    cells = zip([*values, mean], [*low, interval[0]], [*high, interval[1]], strict=True)
    rows = [[f"{figure(each)} {unit}".strip() for each in row] for row in cells]
    ends = (0.5, count + 0.5)
    series: dict[str, Points] = {
        "maps": {"x": np.arange(1, count + 1), "y": values, "low": low, "high": high},
        "mean": {"x": ends, "y": 2 * [mean], "low": 2 * interval[:1], "high": 2 * interval[1:]},
    }
    return PanelContent.fitted(
        series,
        x=ends,
        axes=("", f"{answer.name} {answer.symbol}" + (f" [{unit}]" if unit else "")),
        caption=f"at {part.headings[load]}",
        names=[f"{i} {shortened(name)}" for i, name in enumerate(part.names, 1)],
        rows=[[name, *row] for name, row in zip([*part.names, "mean"], rows, strict=True)],
    )
