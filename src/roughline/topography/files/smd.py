"""Profiles of software gauges (SMD) after ISO 5436-2.

A file has four records: the head, remarks, heights, and a check sum. The character ETX ends each.

References
----------
ISO 5436-2:2012, annex A.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np

from roughline.computing.memory import refuse_beyond_memory
from roughline.errors import InputError, UnitError
from roughline.errors.checks import shortened
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.measurement import Measurement
from roughline.topography.settings import MEASURED
from roughline.units import metres_per

_MARK = re.compile(rb"\s*ISO[ -]?5436|.*^C[XZ][\x00 ].*\x03", re.DOTALL | re.MULTILINE)
_ETX = "\x03"
_AXES = {"CX": ("I", "CX I 4000 mm 1.0e0 D 2.5e-4"), "CZ": ("A", "CZ A 4000 um 1.0e0 D")}
"""The kind of each axis that is read, at even steps and as it is, and an example of its line."""

_START = 1024  # bytes
_BYTES_PER_CHARACTER = 16  # of text: as characters, as words and as numbers
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)


def read_smd(path: Path, _: int | str | None, name: str) -> Measurement | None:
    """Read a profile of a software gauge; None if the file has another format."""
    with path.open("rb") as file:
        start = file.read(_START)
    if not _MARK.match(start):
        return None
    needed = _BYTES_PER_CHARACTER * path.stat().st_size
    refuse_beyond_memory(needed, f"reading the text of {name}", "write it as X3P, SUR or NPY")
    records = path.read_bytes().decode("latin-1").replace("\0", " ").split(_ETX)
    if len(records) < 4:
        raise InputError(
            f"{name} is an SMD file with {len(records) - 1} ends of records (ETX) of 4: it was cut "
            "short; export it again"
        )
    points, step = _axis(records[0], "CX", name)
    stated, unit = _axis(records[0], "CZ", name)
    words = records[2].split()
    wrong = [word for word in words if not _NUMBER.fullmatch(word)]
    if wrong:
        raise InputError(
            f'{name} has "{shortened(wrong[0])}" among its heights, which is no number: export it '
            "again"
        )
    if not points == stated == len(words):
        raise InputError(
            f"{name} has {len(words)} heights and states {points} along x and {stated} of z: it "
            "was cut short or changed; export it again"
        )
    refuse_points((points,), path, name)
    return Measurement(
        file=name,
        heights=unit * np.array(words, dtype=np.float64),
        unit="m",
        sizes=(points * step,),
        kind="profile",
        settings={"origin": MEASURED, "file": name},
        format="SMD",
    )


def _axis(head: str, axis: str, name: str) -> tuple[int, float]:
    """The number of points along an axis, and its step or the height of one count. [m]"""
    lines = [line.split() for line in head.splitlines() if line.split()[:1] == [axis]]
    kind, example = _AXES[axis]
    try:
        ((_, found, count, unit, scale, _type, *step),) = lines
        numbers = [scale, *step]
        is_stated = found == kind and count.isdecimal() and len(numbers) == len(example.split()) - 5
        if not (is_stated and all(_NUMBER.fullmatch(number) for number in numbers)):
            raise ValueError(found)
        value = metres_per(unit.lower()) * math.prod(map(float, numbers))
        if not 0 < value < math.inf:
            raise ValueError(value)
    except (ValueError, UnitError):
        line = " ".join(lines[0]) if lines else "no such line"
        raise InputError(
            f'{name} states its axis {axis} by "{shortened(line)}"; what is read is like '
            f'"{example}": export it again'
        ) from None
    return int(count), value
