"""A topography file, described: what it holds, its roughness, and what is still needed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from roughline.assessment.notes import filled_points_and_spikes
from roughline.assessment.reading import Reading
from roughline.assessment.source import measured_body
from roughline.errors import InputError
from roughline.files.measurement import Measurement
from roughline.files.read import measurement, suspicions
from roughline.spectra.roughness import Roughness, roughness
from roughline.topography.body import Body
from roughline.topography.missing import Missing, MissingPattern, missing_pattern
from roughline.topography.preparation import Preparation, prepared


@dataclass(frozen=True, eq=False)
class Description:
    """What is known of a file.

    Attributes
    ----------
    file : Path
        The file.
    unit : str or None
        Unit of its lengths, if the caller gave one.
    measurement : Measurement
        What the file holds.
    missing : MissingPattern
        Where points are missing in the file.
    obstacles : sequence of str
        Why it cannot be pressed as it is; empty if it can.
    body : Surface or Line or None
        Prepared, in metres; None if something is still needed (see `obstacles`).
    roughness : Roughness or None
        Its parameters; None without a body, and for a reduced line, which is no topography.
    notes : sequence of str
        What was filled, what is suspicious.
    """

    file: Path
    unit: str | None
    measurement: Measurement
    missing: MissingPattern
    obstacles: Sequence[str]
    body: Body | None = None
    roughness: Roughness | None = None
    notes: Sequence[str] = ()


def describe(
    file: Path, reading: Reading | None = None, preparation: Preparation | None = None
) -> Description:
    """Read a file, prepare what it holds, and describe it.

    A file without a unit or sizes, or with too many missing points, is described as far as
    possible.

    Parameters
    ----------
    file : Path
        The topography.
    reading : Reading, optional
        How it is read.
    preparation : Preparation, optional
        Default: only the tilt of measured topographies is removed.

    Raises
    ------
    InputError
        If the file cannot be read, or what is asked for does not suit it.
    """
    reading = reading or Reading()
    content = measurement(file, reading.channel, reading.name)
    return describe_measurement(file, content, reading, preparation)


def describe_measurement(
    file: Path,
    content: Measurement,
    reading: Reading,
    preparation: Preparation | None = None,
    *,
    body_of: Callable[[], Body] | None = None,
) -> Description:
    """Prepare what a file holds, once it is read, and describe it.

    Parameters
    ----------
    file : Path
        The topography.
    content : Measurement
        What it holds; it stays as it is.
    reading, preparation
        As for :func:`describe`.
    body_of : callable, optional
        Returns the body as it was read, before its preparation, if the caller has kept it.

    Raises
    ------
    InputError
        If what is asked for does not suit it.
    """
    missing = missing_pattern(content.unknown, content.sizes)
    filling = Missing(reading.missing, reading.most_missing)
    obstacles = [str(each) for each in content.obstacles(reading.unit, reading.sizes, filling)]
    if obstacles:
        return Description(file, reading.unit, content, missing, obstacles)
    if body_of is None:
        read = measured_body(content, reading, preparation, in_place=False)
    else:
        read = body_of()
    body = prepared(read, preparation)
    notes, parameters = suspicions(body) + filled_points_and_spikes(body), None
    try:
        parameters = roughness(body)
    except InputError as error:  # a reduced line is no topography
        notes.append(str(error))
    return Description(file, reading.unit, content, missing, obstacles, body, parameters, notes)
