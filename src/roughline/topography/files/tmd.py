"""TMD, the format of TrueMap and of GelSight's scanners, in mm."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from roughline.errors import InputError
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.measurement import Measurement
from roughline.topography.settings import MEASURED

_MARK = b"Binary TrueMap Data File v2.0"
_COMMENT = 32  # where it begins; it ends with a zero byte, after as many as its program likes
_LONGEST_COMMENT = 2**16  # of a comment
_HEAD = "<2I4f"  # points, sides and the place of the map, along x and y
_BYTES_PER_POINT = 24
_BY_SURFALIZE = b"Exported by surfalize"
_IN_UM = (
    "surfalize wrote it, which up to version 0.19 has um where this format has mm: then the map is "
    "1000 times too large, also in height; export it from there as X3P or SUR"
)


def read_tmd(path: Path, channel: int | str | None, name: str) -> Measurement | None:
    """Read heights from TMD; None if the file has another format."""
    with path.open("rb") as file:
        start = file.read(_COMMENT + _LONGEST_COMMENT)
        if not start.startswith(_MARK):
            return None
        place = start.find(b"\0", _COMMENT) + 1
        head = start[place : place + struct.calcsize(_HEAD)]
        if not place or len(head) < struct.calcsize(_HEAD):
            raise InputError(f"{name} ends within the head of TMD: export it again")
        nx, ny, x, y, *_ = struct.unpack(_HEAD, head)
        if not (0 < x < np.inf and 0 < y < np.inf):
            raise InputError(f"{name} is damaged: its sides are {x:g} mm x {y:g} mm")
        refuse_points((nx, ny), path, name, _BYTES_PER_POINT)
        file.seek(place + len(head))
        stored = file.read()
    if len(stored) != 4 * nx * ny:
        raise InputError(
            f"{name} has {len(stored)} bytes of heights, and its {nx} x {ny} points need "
            f"{4 * nx * ny}: export it again"
        )
    return Measurement(
        file=name,
        heights=np.frombuffer(stored, "<f4").astype(np.float64).reshape(ny, nx).T,
        unit="mm",
        sizes=(x, y),
        kind="surface",
        format="TMD",
        doubts=(_IN_UM,) if _BY_SURFALIZE in start[_COMMENT:place] else (),
        settings={"origin": MEASURED, "file": name},
    )
