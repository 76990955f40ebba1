"""What a file of a page holds: read once, kept, and described as it stands and as prepared."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Literal

from roughline.errors.words import speaking
from roughline.lab.frames import drawn
from roughline.lab.measured.cache import cached
from roughline.lab.measured.controls import at
from roughline.lab.measured.pictures import file_pictures, preparation_pictures
from roughline.lab.measured.state import (
    PAGE_WORDS,
    ControlTexts,
    control_texts,
    first_source,
    page_preparation,
    page_reading,
    used_in,
)
from roughline.lab.server.tasks import Arguments, Progress
from roughline.question.description import Description, describe_measurement
from roughline.question.reading import Reading
from roughline.question.source import measured_body
from roughline.report.description_table import description_table
from roughline.report.values import up_to_three_digits
from roughline.topography.body import Body, Surface, point_spacings, side_lengths
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.read import measurement
from roughline.topography.low_pass import inner_points
from roughline.topography.preparation import Preparation


@speaking(PAGE_WORDS)
def look(arguments: Arguments, progress: Progress) -> bytes:
    """What the file holds, what it leaves open, and its roughness as it is read."""
    found, refused, _ = _described(arguments, "file")
    content = found.measurement
    header = {
        "name": first_source(control_texts(arguments), arguments["session"]).name,
        "refused": refused,
        "asks": {
            "unit": content.unit is None,
            "size": content.sizes is None,
            "channels": list(content.channels) if len(content.channels) > 1 else [],
        },
        "channel": content.channel,
        "body": _body(found),
        "tables": {"measured-roughness": [["", ""], description_table(found, up_to_three_digits)]},
        "lists": {"obstacles": found.obstacles, "remarks": _remarks(found)},
    }
    return drawn(header, *file_pictures(found))


@speaking(PAGE_WORDS)
def prepare(arguments: Arguments, progress: Progress) -> bytes:
    """The file before and after its preparation."""
    found, refused, crop = _described(arguments, "preparation")
    header = {"refused": refused, "body": _body(found), "crop": crop}
    obstacles, body = {"obstacles": found.obstacles}, found.body
    if body is None:
        return drawn({**header, "lists": obstacles}, {}, {})
    before, _, _ = _described(arguments, "file")
    old, new = (dict(description_table(each, up_to_three_digits)) for each in (before, found))
    names = [name for name in old | new if name != "file"]
    rows = [[name, old.get(name, "-"), new.get(name, "-")] for name in names]
    header |= {
        "lists": obstacles | {"prepared-remarks": _remarks(found)},
        "tables": {"measured-prepared": [["", "before", "after"], rows]},
    }
    uncropped = before.body or body
    corner = (crop or (0.0, 0.0, 0.0, 0.0))[::2]
    if cutoff := body.provenance.low_pass:
        inner = inner_points(replace(uncropped, is_cut_out=body.is_cut_out), cutoff)
        corner = [
            start + each.start * step
            for start, each, step in zip(corner, inner, point_spacings(uncropped), strict=False)
        ]
    return drawn(header, *preparation_pictures(uncropped, body, corner))


def _described(
    arguments: Arguments, key: Literal["file", "preparation"]
) -> tuple[Description, dict[str, str], Sequence[float] | None]:
    """The file of a page, prepared or as read; which texts are not used and why; the crop. [m]"""
    session = arguments["session"]
    source = first_source(control_texts(arguments), session)

    def read(texts: ControlTexts) -> tuple[Description, Preparation | None]:
        with at(key):
            reading = page_reading(texts, source.name)
            preparation = page_preparation(texts) if key == "preparation" else None

            def made() -> Measurement:
                return measurement(source.path, reading.channel, source.name)

            def read_body(piece: Measurement, reading: Reading, rest: Preparation | None) -> Body:
                """The body as it is read; kept, because filling missing points loads slowly."""
                keeps_trend = rest is not None and rest.trend is not None
                asked = source.key, reading, preparation and preparation.crop, keeps_trend
                return cached(session, "body", asked, lambda: measured_body(piece, reading, rest))

            content = cached(session, "measurement", (source.key, reading.channel), made)
            found = describe_measurement(
                source.path, content, reading, preparation, body_of=read_body
            )
            return found, preparation

    (found, preparation), refused = used_in(arguments, read)
    return found, refused, preparation.crop if preparation else None


def _remarks(found: Description) -> list[str]:
    """What is to be known about a body."""
    return [*found.remarks, *(found.roughness.remarks if found.roughness else [])]


def _body(found: Description) -> dict[str, Any] | None:
    """What is pressed, as far as it can be."""
    body = found.body
    if body is None:
        return None
    kind = "surface" if isinstance(body, Surface) else body.kind
    return {"kind": kind, "sides": side_lengths(body), "points": body.heights.shape}
