"""Several maps of a part: each read and checked, and what they gave together."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

import roughline as rl
from roughline.assessment.part import PartAnswer, PartAssessment
from roughline.assessment.source import Topography
from roughline.errors.words import speaking
from roughline.lab.frames import frame
from roughline.lab.measured.state import (
    CONTROLS,
    preparation_of,
    reading_of,
    said_of,
    sources_of,
    used_in,
)
from roughline.lab.server.tasks import Arguments, Progress, without_paths
from roughline.report.answers import (
    UNRESOLVED,
    answer_table,
    counted,
    headline,
    lead_of,
    leading_keys,
    star_is_shown,
    unit_shown,
)
from roughline.report.part_tables import body_in_words, leading_table, maps_table
from roughline.report.values import scale_of

_SAME = 1e-9  # largest over least, less 1, up to which an answer was given and did not come out


@speaking(CONTROLS)
def maps(arguments: Arguments, progress: Progress) -> bytes:
    """Each map of a part as it is read and prepared, or why it is refused."""
    sources = sources_of(said_of(arguments), arguments["session"])
    (reading_of_all, preparation), refused = used_in(
        arguments, lambda said: (reading_of(said, None), preparation_of(said))
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


def part_in_words(part: PartAssessment, arguments: Arguments) -> dict[str, Any]:
    """Tables, remarks and the drawing of a part."""
    return {
        "names": part.names,
        "maps": maps_table(part),
        "leading": leading_table(part),
        "lead": lead_of(part),
        "figures": [vars(each) for each in headline(part).figures],
        "answers": answer_table(part) if part.answers else None,
        "groups": counted(part),
        "star": f"* {UNRESOLVED}" if star_is_shown(part) else "",
        "remarks": [without_paths(each, arguments) for each in part.remarks],
        "load": part.headings[part.largest],
        "drawings": _drawings(part),
    }


def _drawings(part: PartAssessment) -> list[dict[str, Any]]:
    """Answers that differ between the maps at the largest load, the leading ones first."""
    leading = [key for key in leading_keys(part.assessments[0]) if key in part.answers]
    others = [key for key in part.answers if key not in leading]
    drawn = [_drawing(part.answers[key], part.largest) for key in leading + others]
    return [each for each in drawn if np.ptp(each["values"]) > _SAME * np.max(each["values"])]


def _drawing(answer: PartAnswer, load: int) -> dict[str, Any]:
    """One answer of each map at a load with its interval, the mean, and the part's interval."""
    values = np.array([each.values[load] for each in answer.of_maps])
    factor, unit = scale_of(float(np.nanmax(values)), unit_shown(answer))
    low, high = (end * factor for end in answer.ends_of_maps(load))
    return {
        "name": f"{answer.name} {answer.symbol}",
        "unit": unit.strip(),
        "values": values * factor,
        "low": low,
        "high": high,
        "mean": answer.mean[load] * factor,
        "interval": [answer.low[load] * factor, answer.high[load] * factor],
    }
