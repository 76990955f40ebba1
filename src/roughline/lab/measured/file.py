"""What a file of a page holds: read once, kept, and described as it stands and as prepared."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from roughline.assessment.description import Description, describe_measurement
from roughline.assessment.reading import Reading
from roughline.assessment.source import measured_body
from roughline.errors.words import speaking
from roughline.lab.frames import frame
from roughline.lab.measured.kept import kept
from roughline.lab.measured.pictures import (
    drawing_of_body,
    drawing_of_file,
    spectrum_of,
)
from roughline.lab.measured.state import (
    CONTROLS,
    Said,
    Source,
    at,
    preparation_of,
    reading_of,
    said_of,
    source_of,
    used_in,
)
from roughline.lab.server.tasks import Arguments, Progress
from roughline.report.description_table import description_table
from roughline.topography.body import Body, Surface, sides_of
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.read import measurement
from roughline.topography.preparation import Preparation


@speaking(CONTROLS)
def look(arguments: Arguments, progress: Progress) -> bytes:
    """What the file holds, what it leaves open, and its roughness as it is read."""
    session = arguments["session"]
    source = source_of(said_of(arguments), session)

    def read(said: Said) -> Description:
        with at("file"):
            return described(said, source, session)

    found, refused = used_in(arguments, read)
    content = found.measurement
    drawing = drawing_of_file(content, found.body)
    header = {
        "name": source.name,
        "refused": refused,
        "asks": {
            "unit": content.unit is None,
            "size": content.sizes is None,
            "channels": list(content.channels) if len(content.channels) > 1 else [],
        },
        "channel": content.channel,
        "obstacles": list(found.obstacles),
        "file": drawing.header,
        **_of_description(found),
    }
    return frame(header, drawing.arrays | _body_arrays(found.body))


@speaking(CONTROLS)
def prepare(arguments: Arguments, progress: Progress) -> bytes:
    """The file, prepared."""
    session = arguments["session"]
    source = source_of(said_of(arguments), session)

    def read(said: Said) -> Description:
        with at("preparation"):
            return described(said, source, session, is_prepared=True)

    found, refused = used_in(arguments, read)
    header = {"refused": refused, "obstacles": list(found.obstacles)}
    return frame({**header, **_of_description(found)}, _body_arrays(found.body))


def described(
    said: Said, source: Source, session: Mapping[str, Any], *, is_prepared: bool = False
) -> Description:
    """Describe a file, prepared or as it is read."""
    reading = reading_of(said, source.name)
    preparation = preparation_of(said) if is_prepared else None
    content = kept(
        session,
        "measurement",
        (source.key, reading.channel),
        lambda: measurement(source.path, reading.channel, source.name),
    )

    def body_of(piece: Measurement, reading: Reading, rest: Preparation | None) -> Body:
        """The body as it is read; kept, because filling missing points loads slowly."""
        crop = preparation.crop if preparation else None
        keeps_trend = rest is not None and rest.trend is not None
        return kept(
            session,
            "body",
            (source.key, reading, crop, keeps_trend),
            lambda: measured_body(piece, reading, rest),
        )

    return describe_measurement(source.path, content, reading, preparation, body_of=body_of)


def _of_description(found: Description) -> dict[str, Any]:
    """Table, remarks and spectrum of a body, and what the page draws of it."""
    body, parameters = found.body, found.roughness
    remarks = [*found.notes, *(parameters.remarks if parameters else [])]
    return {
        "table": description_table(found),
        "remarks": list(remarks),
        "missing": found.missing.count,
        "body": None if body is None else _of_body(body),
        "spectrum": spectrum_of(found),
    }


def _of_body(body: Body) -> dict[str, Any]:
    return {
        **drawing_of_body(body).header,
        "kind": "surface" if isinstance(body, Surface) else body.kind,
        "sides": sides_of(body),
        "points": body.heights.shape,
        "is_cut_out": isinstance(body, Surface) and body.is_cut_out,
    }


def _body_arrays(body: Body | None) -> dict[str, np.ndarray[Any, Any]]:
    return {} if body is None else drawing_of_body(body).arrays
