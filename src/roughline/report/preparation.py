"""What was done to a topography before it was pressed, in words."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from roughline.topography.body import Body, sides_of
from roughline.units import engineering

if TYPE_CHECKING:
    from collections.abc import Mapping

_RANGE = re.compile(r"(?:([xy]) )?(\d+):(\d+)")

STEPS = (
    "cropped",
    "outliers_removed",
    "detrended",
    "low_pass",
    "resampled",
    "resampled_to",
    "filled",
)
"""Settings of a body that record its preparation, in the order in which they are told."""


def preparation_in_words(body: Body) -> str:
    """Return the steps of a body in metres, with their units; "none" if there were none."""
    settings: Mapping[str, str | int | float] = body.settings
    done = [f"{name.replace('_', ' ')}: {_told(name, body)}" for name in STEPS if name in settings]
    return ", ".join(done) or "none"


def _told(name: str, body: Body) -> str:
    """What one step did, in lengths where it is of lengths."""
    value = body.settings[name]
    if name == "cropped":
        return _crop(str(value), body)
    if name == "low_pass":
        return f"waves shorter than {engineering(float(value), 'm')} (Gaussian, ISO 16610)"
    if name == "resampled_to":
        return f"{value} points"
    return str(value)


def _crop(points: str, body: Body) -> str:
    """The piece that was kept, in lengths from the corner of the whole.

    Later steps keep the sides of the piece, so its points had the distance of side over points.
    """
    sides = sides_of(body)
    kept = []
    for (axis, *ends), side in zip(_RANGE.findall(points), sides, strict=True):
        first, end = map(int, ends)
        low, high = (engineering(each * side / (end - first), "m") for each in (first, end))
        kept.append(f"{axis} {low} to {high}".strip())
    return f"{' and '.join(kept)} (points {points})"
