"""NMS, the format of NanoFocus's confocal microscopes, which states lengths in nm."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from roughline.errors import InputError
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.measurement import Measurement
from roughline.topography.provenance import Instrument
from roughline.topography.settings import MEASURED

_HEAD = 3468  # bytes before the heights
_MARK = b"OM_MS_"  # with the version, at byte 32; not all files have it
_HEIGHTS_HEAD = "<4i2d"  # type of numbers, kind of map; counts and heights [um] of the ends
_AT_POINTS = 1368
_POINTS_HEAD = "<2i2d"  # points and their distances [nm] along x and y
_AT_INTENSITY = 1416  # whether the intensity of each point follows the heights
_SHORT, _AREA = 2, 1
_FULL = 2**16 - 2  # counts from the lower to the upper end, where a file does not state them
_BYTES_PER_POINT = 24


def read_nms(path: Path, channel: int | str | None, name: str) -> Measurement | None:
    """Read heights from NMS; None if the file has another format.

    A point without a signal, or whose count is below that of the lower end, is missing.
    """
    with path.open("rb") as file:
        head = file.read(_HEAD)
    is_marked = head[32:].startswith(_MARK)
    if not is_marked and path.suffix.lower() != ".nms":
        return None
    if len(head) < _HEAD:
        raise InputError(f"{name} ends within the head of NMS: it was cut short; export it again")
    type_, kind, first, last, low, high = struct.unpack_from(_HEIGHTS_HEAD, head)
    nx, ny, dx, dy = struct.unpack_from(_POINTS_HEAD, head, _AT_POINTS)
    is_sound = 0 < nx < 10**5 and 0 < ny < 10**5 and 0 < dx < np.inf and 0 < dy < np.inf
    if not is_sound or not np.isfinite(high - low):
        raise InputError(
            f"{name} is damaged, or no NMS: its head states {nx} x {ny} points {dx:.4g} nm x "
            f"{dy:.4g} nm apart, and heights from {low:.4g} to {high:.4g} um; export it again"
        )
    if is_marked and (type_, kind) != (_SHORT, _AREA):
        raise InputError(
            f"{name} is NMS with numbers of type {type_} and a map of kind {kind}; maps (1) of 16 "
            "bits (2) are read: export it as X3P"
        )
    refuse_points((nx, ny), path, name, _BYTES_PER_POINT)
    if not (is_marked and last > first):
        first, last = 0, _FULL
    has_intensity = is_marked and struct.unpack_from("<i", head, _AT_INTENSITY)[0] > 0
    with path.open("rb") as file:
        file.seek(_HEAD)
        stored, signal = file.read(2 * nx * ny), file.read(nx * ny if has_intensity else 0)
    if len(stored) < 2 * nx * ny or len(signal) < nx * ny * has_intensity:
        raise InputError(f"{name} ends before its {nx} x {ny} points do: export it again")
    counts = np.frombuffer(stored, "<u2")
    missing = counts < first
    if any(signal):
        missing |= np.frombuffer(signal, "u1") == 0
    heights = low + (high - low) / (last - first) * (counts - float(first))
    return Measurement(
        file=name,
        heights=np.ma.array(heights, mask=missing).reshape(ny, nx).T,
        unit="um",
        sizes=(1e-3 * dx * nx, 1e-3 * dy * ny),
        kind="surface",
        format="NMS",
        corrected=(
            "its lengths are in nm; SurfaceTopography 1.27 takes them for mm, which makes the map "
            "a million times too wide",
        ),
        settings={"origin": MEASURED, "file": name},
    ).with_instrument(Instrument(pixels="means"))
