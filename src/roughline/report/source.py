"""A topography file: what is needed to read it, and what to say of what was read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from roughline.measured import read, suspicions
from roughline.missing import Filling
from roughline.topography import Body


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


def notes_on_body(body: Body) -> list[str]:
    """Say what was filled, what spikes there are, and what is suspicious."""
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
    return notes + suspicions(body)
