"""Provenance of bodies in files: as it is written, and as files of earlier versions hold it.

Earlier versions wrote settings alone, from which what decides was read again and again. Here it is
read once, and becomes typed facts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, get_args

import numpy as np

from roughline.topography.borders import Borders
from roughline.topography.line_levels import LEVELLINGS, Levelling
from roughline.topography.missing import Filled, Filling
from roughline.topography.provenance import (
    MOUNTING,
    TILT,
    TILT_REMOVED,
    Facing,
    Instrument,
    Left,
    Masked,
    Pixels,
    Provenance,
    Step,
    Tilt,
)
from roughline.topography.settings import MEASURED
from roughline.topography.trend import Trend

_RecordedFacts = Mapping[str, Any]

_COUNTS = ("filled_before_crop", "filled_between_levels", "outliers_kept")
_COUNTS_IF_LOOKED_FOR = ("scars_removed", "outliers_removed")
_SHARES_AND_LENGTHS = ("cropped_share", "low_pass")
_TEXTS = ("format", "corrected", "doubts_of_file", "low_pass_kept", "resampled_to")
_PIECES = (MEASURED, "topography")  # origins of pieces of a larger surface
_WHOLE = ("periodic topography", "self-affine")  # starts of origins of what is periodic


def as_record(provenance: Provenance) -> dict[str, Any]:
    """Return what a file holds of a provenance, in numbers, texts and what JSON makes of them."""
    record = {name: _plain(value) for name, value in provenance.record.items()}
    if (both := provenance.facing) is not None:
        record["facing"] = {
            "first": as_record(both.first),
            "second": as_record(both.second),
            "cropped": list(both.cropped),
            "is_resampled": both.is_resampled,
        }
    return record


def _plain(value: Any) -> Any:
    """A number as one of Python's own."""
    return value.item() if isinstance(value, np.generic) else value


def provenance_in(record: _RecordedFacts) -> Provenance:
    """Return the provenance that a file holds, as :func:`as_record` gives it.

    Raises
    ------
    ValueError, TypeError, KeyError
        If it is damaged.
    """
    facing = None
    if both := record.get("facing"):
        cropped = tuple(map(bool, both["cropped"]))
        first, second = (provenance_in(both[name]) for name in ("first", "second"))
        facing = Facing(first, second, (cropped[0], cropped[1]), bool(both["is_resampled"]))
    return _provenance(record, facing)


def provenance_of_earlier(settings: _RecordedFacts) -> Provenance:
    """Return the provenance that files of earlier versions hold in their settings alone."""
    first, second = (
        {key.removeprefix(name): value for key, value in settings.items() if key.startswith(name)}
        for name in ("first_", "second_")
    )
    if not (first and second):
        return _provenance(settings, None)
    cropped = ("cropped_to" in first, "cropped_to" in second)
    # it may have been resampled when it was prepared alone, which had the same name
    is_resampled = "resampled_to" in second
    both = Facing(_provenance(first, None), _provenance(second, None), cropped, is_resampled)
    return _provenance(settings, both)


def is_piece_in_earlier(settings: _RecordedFacts) -> bool | None:
    """Say whether settings record a piece of a larger body; None if they do not tell."""
    origin = str(settings.get("origin"))
    if "cropped" in settings or origin in _PIECES:
        return True
    return False if origin.startswith(_WHOLE) else None


def trend_in(record: _RecordedFacts) -> Trend:
    """Return the trend whose removal a provenance or settings record."""
    trends: tuple[Trend, ...] = get_args(Trend)
    return next((each for each in trends if each == record.get("detrended")), "none")


def _provenance(record: _RecordedFacts, facing: Facing | None) -> Provenance:
    known: dict[str, Any] = {name: int(record.get(name, 0)) for name in _COUNTS}
    known |= {name: int(record[name]) for name in _COUNTS_IF_LOOKED_FOR if name in record}
    known |= {name: float(record[name]) for name in _SHARES_AND_LENGTHS if name in record}
    known |= {name: str(record.get(name, "")) for name in _TEXTS}
    known |= {
        name: _levelling(record.get(name)) for name in ("lines_levelled", "filled_over_lines")
    }
    return Provenance(
        **known,
        instrument=_instrument(record),
        tilt=_tilt(record),
        borders=_borders(record),
        masked=_masked(record),
        filled=_filled(record),
        left=tuple(_left(record)),
        detrended=trend_in(record),
        facing=facing,
    )


def _instrument(record: _RecordedFacts) -> Instrument:
    pixels: tuple[Pixels, ...] = get_args(Pixels)
    blur, radius = (
        float(value) if isinstance(value := record.get(name), float | int) else None
        for name in ("blur", "tip_radius")
    )
    return Instrument(
        next((each for each in pixels if each == record.get("pixels")), None), blur, radius
    )


def _tilt(record: _RecordedFacts) -> Tilt:
    slopes = (float(record[name]) for name in TILT_REMOVED if name in record)
    return Tilt(tuple(slopes), record.get(TILT) == MOUNTING)


def _borders(record: _RecordedFacts) -> Borders | None:
    if "border_chance" not in record:
        return None
    return Borders(float(record["border_step"]), float(record["border_chance"]))


def _masked(record: _RecordedFacts) -> Masked | None:
    if not (share := float(record.get("masked_share", 0.0))):
        return None
    return Masked(share, str(record["mask_of"]), record["mask"] == "used")


def _filled(record: _RecordedFacts) -> Filled | None:
    if not (points := int(record.get("missing_points", 0))):
        return None
    method: Filling = "nearest" if record["filled"] == "nearest" else "harmonic"
    return Filled(points, float(record["missing_share"]), method)


def _left(record: _RecordedFacts) -> Iterator[Left]:
    steps: tuple[Step, ...] = get_args(Step)
    for step in steps:
        height, slope = (record.get(f"{step}_left_of_rms_{of}") for of in ("height", "slope"))
        if height is not None:
            yield Left(step, float(height), None if slope is None else float(slope))


def _levelling(name: object) -> Levelling | None:
    return next((each for each in LEVELLINGS if each == name), None)
