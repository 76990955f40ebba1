"""Topography files: what is needed to read them, two together, and what to say of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from roughline.errors import InputError
from roughline.measured import missing_points, read, suspicions
from roughline.missing import Filling
from roughline.preparation import Preparation, prepared
from roughline.topography import Body, Line, Surface
from roughline.two_bodies import facing


@dataclass(frozen=True)
class Source:
    """A file, and what is needed to read it; as for :func:`roughline.read`."""

    file: Path
    unit: str | None = None
    channel: str | None = None
    sizes: tuple[float, ...] | None = None
    missing: Filling = "harmonic"
    most_missing: float = 0.1

    def read(self, missing: Filling | None = None) -> Body:
        """Read it, with points filled as stated or by another method."""
        return read(
            self.file,
            self.unit,
            channel=self.channel,
            sizes=self.sizes,
            missing=missing or self.missing,
            most_missing=self.most_missing,
        )

    def missing_points(self) -> Body | None:
        """Read where points are missing; None where they were filled before it was written."""
        return missing_points(self.file, self.unit, channel=self.channel, sizes=self.sizes)


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


def notes_on_parts(parts: Sequence[Body], say: Callable[[Body], list[str]]) -> list[str]:
    """Say something of each topography, and of which of two it is."""
    if len(parts) == 1:
        return say(parts[0])
    return [
        f"{which} body: {note}"
        for which, part in zip(("first", "second"), parts, strict=True)
        for note in say(part)
    ]
