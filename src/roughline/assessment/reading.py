"""How the files of a question are read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roughline.errors.checks import one_of
from roughline.errors.public import public
from roughline.files.scale import Sizes
from roughline.topography.missing import Filling, Missing
from roughline.topography.settings import MOUNTING
from roughline.units import metres_per


@public
@dataclass(frozen=True)
class Reading:
    """How a file is read.

    Parameters
    ----------
    unit, channel, sizes, missing, most_missing
        As for :func:`roughline.read`.
    name : str, optional
        What the first file is called in messages and results; default: its own name.
    tilt : {"unknown", "mounting"}, optional
        Whose the tilt of a measured topography is: that of its mounting alone, such as the stage's,
        or that of the mounting and of waves longer than the topography, which is not known.
    """

    unit: str | None = None
    channel: int | str | None = None
    sizes: Sizes | None = None
    missing: Filling = "harmonic"
    most_missing: float = 0.1
    name: str | None = None
    tilt: Literal["unknown", "mounting"] = "unknown"

    def __post_init__(self) -> None:
        one_of("tilt", self.tilt, ("unknown", MOUNTING))
        Missing(self.missing, self.most_missing)  # refuses what cannot be
        if self.unit is not None:
            metres_per(self.unit)
