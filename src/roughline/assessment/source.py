"""Topography files: what is needed to read them, two together, and what to say of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from roughline.errors import InputError
from roughline.files.measurement import Measurement
from roughline.files.read import measurement, read, suspicions
from roughline.topography.body import Body, Line, Surface
from roughline.topography.missing import Filling, Missing
from roughline.topography.preparation import Preparation, prepared
from roughline.topography.trend import Trend
from roughline.topography.two_bodies import facing
from roughline.units import engineering


@dataclass(frozen=True)
class Source:
    """A file, and what is needed to read it; as for :func:`roughline.read`.

    Lengths in `sizes` have units. `trend` is what reading removes: "none" where the preparation
    says itself what is to be removed, in its own turn.
    """

    file: Path
    unit: str | None = None
    channel: str | None = None
    sizes: str | None = None
    missing: Filling = "harmonic"
    most_missing: float = 0.1
    trend: Trend = "tilt"

    def measurement(self) -> Measurement:
        """What the file holds, whether or not it can be pressed."""
        return measurement(self.file, self.channel)

    def read(self, missing: Filling | None = None) -> Body:
        """Read it, with points filled as stated or by another method."""
        return read(
            self.file,
            self.unit,
            channel=self.channel,
            sizes=self.sizes,
            missing=missing or self.missing,
            most_missing=self.most_missing,
            trend=self.trend,
        )

    def body(self, found: Measurement) -> Body:
        """The body that was measured, as :meth:`read` gives it."""
        filling = Missing(self.missing, self.most_missing)
        return found.body(self.unit, self.sizes, filling, self.trend)

    def obstacles(self, found: Measurement) -> list[str]:
        """What is still needed before what the file holds can be pressed."""
        filling = Missing(self.missing, self.most_missing)
        return [str(each) for each in found.obstacles(self.unit, self.sizes, filling)]

    def missing_points(self) -> Body | None:
        """Where points are missing, as heights of 1; None where they were filled before."""
        found = measurement(self.file, self.channel)
        if found.by_roughline:
            return None
        marked = replace(found, heights=found.unknown.astype(np.float64))
        body = marked.body(self.unit, self.sizes, Missing(), "none")
        return replace(body, heights=np.sign(body.heights))


def notes_on_body(body: Body) -> list[str]:
    """Say what is suspicious, what was filled, and what spikes there are."""
    return suspicions(body) + notes_on_points(body)


def notes_on_points(body: Body) -> list[str]:
    """Say what was filled, and what spikes there are."""
    notes = []
    if body.settings.get("missing_points"):
        count, share = body.settings["missing_points"], float(body.settings["missing_share"])
        notes.append(f"{count} missing points ({share:.2%}) filled: {body.settings['filled']}")
    if body.settings.get("outliers_kept"):
        notes.append(
            f"{body.settings['outliers_kept']} spikes kept; the highest point decides where touch "
            "is, so see whether they are real, or remove them"
        )
    if body.settings.get("outliers_removed"):
        notes.append(f"{body.settings['outliers_removed']} spikes removed and filled")
    return notes


def read_parts(
    sources: Sequence[Source], preparation: Preparation | None, filling: Filling | None = None
) -> list[Body]:
    """Read and prepare each topography; missing points are filled as stated or otherwise."""
    return [prepared(each.read(filling), preparation) for each in sources]


def filled_regions(
    sources: Sequence[Source], parts: Sequence[Body], preparation: Preparation | None
) -> list[Surface | None]:
    """Read for each map where points were filled: 1 there, 0 elsewhere; None if none is known.

    They are cropped like the map, and have its file's points.
    """
    crop = Preparation(crop=preparation.crop if preparation else None, trend="none")
    found: list[Surface | None] = []
    for source, part in zip(sources, parts, strict=True):
        marks = source.missing_points() if part.settings.get("missing_points") else None
        found.append(crop.applied(marks) if isinstance(marks, Surface) else None)
    return found


def together(parts: Sequence[Body]) -> Body:
    """Return the body to press: the sum of two surfaces, or the first of two line scans.

    Raises
    ------
    InputError
        If one is a surface and the other is not, or they have too little in common.
    """
    if len(parts) == 1:
        return parts[0]
    first, second = parts
    if isinstance(first, Surface) and isinstance(second, Surface):
        return facing(first, second)
    if (
        isinstance(first, Line)
        and isinstance(second, Line)
        and first.kind == second.kind == "profile"
    ):
        return first
    raise InputError("two rough bodies must both be surfaces, or both line scans")


def notes_on_facing(body: Body) -> list[str]:
    """Say what was cropped and resampled when two surfaces were laid together."""
    if not isinstance(body, Surface):
        return []
    notes = []
    for name in ("first", "second"):
        if f"{name}_cropped_to" in body.settings:
            sizes = " x ".join(engineering(size, "m") for size in body.sizes)
            notes.append(
                f"{name} body: cropped to what both have in common, {sizes}, from x = y = 0"
            )
    if "second_resampled_to" in body.settings:
        pixel = " x ".join(engineering(size, "m") for size in body.spacing)
        notes.append(f"second body: resampled by cubic splines to pixels of {pixel}, the first's")
    return notes


def notes_on_parts(parts: Sequence[Body], say: Callable[[Body], list[str]]) -> list[str]:
    """Say something of each topography, and of which of two it is."""
    if len(parts) == 1:
        return say(parts[0])
    return [
        f"{which} body: {note}"
        for which, part in zip(("first", "second"), parts, strict=True)
        for note in say(part)
    ]
