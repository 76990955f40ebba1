"""A topography file, described: what it holds, its roughness, and what is still needed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from roughline.errors import InputError
from roughline.facts.fact import Fact, WithFacts, own_words
from roughline.measurement.roughness import Roughness, roughness
from roughline.question.reading import Reading
from roughline.question.source import crop_first, measured_body
from roughline.texture.iso import IsoParameters, iso
from roughline.topography.body import Body
from roughline.topography.effects import what_was_prepared
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.read import measurement, suspicions
from roughline.topography.missing import MissingPattern, missing_pattern
from roughline.topography.preparation import Preparation, as_prepared


@dataclass(frozen=True, eq=False)
class Description(WithFacts):
    """What is known of a file."""

    file: Path
    unit: str | None  # of its lengths, if the caller gave one
    measurement: Measurement
    piece: Measurement  # what is left of it after a crop
    missing: MissingPattern  # where points are missing in the piece
    obstacles: Sequence[str]  # why it cannot be pressed as it is; empty if it can
    body: Body | None = None  # prepared; None if something is still needed [m]
    roughness: Roughness | None = None  # None for a reduced line, which is no topography
    facts: Sequence[Fact] = ()  # what was filled, what is suspicious
    texture: IsoParameters | None = None  # of the body, if they were asked for


def describe(
    file: Path, reading: Reading | None = None, preparation: Preparation | None = None
) -> Description:
    """Read a file, prepare what it holds, and describe it.

    A file without a unit or sizes, or with too many missing points, is described as far as
    possible; one that cannot be read is refused.
    """
    reading = reading or Reading()
    content = measurement(file, reading.channel, reading.name)
    return describe_measurement(file, content, reading, preparation)


def with_texture(
    description: Description, s_filter: float | None = None, l_filter: float | None = None
) -> Description:
    """Return a description with the parameters of ISO 25178-2 or ISO 21920-2 of its body.

    Without a body there are none, and a note says so; what it lacks is among the obstacles.

    Raises
    ------
    InputError
        For a reduced line, and for cutoffs that the body cannot show.
    """
    if description.body is None:
        return replace(description, facts=[*description.facts, Fact("no_texture_yet")])
    return replace(description, texture=iso(description.body, s_filter=s_filter, l_filter=l_filter))


def describe_measurement(
    file: Path,
    content: Measurement,
    reading: Reading,
    preparation: Preparation | None = None,
    *,
    body_of: Callable[[Measurement, Reading, Preparation | None], Body] = measured_body,
) -> Description:
    """Prepare what a file holds, once it is read, and describe it; the content stays as it is.

    Bodies are made by another function for a caller that keeps them.
    """
    piece = content = content.with_mask(reading.missing.mask)
    obstacles = content.scale_obstacles(reading.unit, reading.sizes)
    if not obstacles:
        piece, reading, preparation = crop_first(content, reading, preparation)
    obstacles = piece.obstacles(reading.unit, reading.sizes, reading.missing)
    missing = missing_pattern(piece.unknown, piece.sizes)
    found = Description(file, reading.unit, content, piece, missing, list(map(str, obstacles)))
    if obstacles:
        return found
    body = as_prepared(body_of(piece, reading, preparation), preparation)
    facts, parameters = [*suspicions(body), *what_was_prepared(body)], None
    try:
        parameters = roughness(body)
    except InputError as error:  # a reduced line is no topography
        facts.append(own_words(str(error), "note"))
    return replace(found, body=body, roughness=parameters, facts=facts)
