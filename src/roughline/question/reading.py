"""How the files of a question are read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roughline.errors.checks import allowed_choice
from roughline.errors.public import public
from roughline.topography.files.measurement import Sizes
from roughline.topography.missing import USUALLY_FILLED, Missing
from roughline.topography.provenance import MOUNTING, Instrument, Pixels
from roughline.units import metres_per


@public
@dataclass(frozen=True)
class Reading:
    """How a file is read.

    Parameters
    ----------
    unit, channel, sizes, missing
        As for :func:`roughline.read`.
    name : str, optional
        What the first file is called in messages and results; default: its own name.
    tilt : {"unknown", "mounting"}, optional
        Whose the tilt of a measured topography is: that of its mounting alone, such as the stage's,
        or that of the mounting and of waves longer than the topography, which is not known.
    pixels : {"means", "points"}, optional
        Whether heights are means over pixels or those of points; default: means for a file of an
        optical instrument (OPD, AL3D and others of which that is known), else not known.
    blur : float, optional
        Standard deviation of the instrument's Gaussian blur, beside the pixels'; 0 for none;
        default: it is not known. [m]
    tip_radius : float, optional
        Radius of the tip that traced the surface; shorter waves than it follows are left out of
        the self-affine law. [m]
    """

    unit: str | None = None
    channel: int | str | None = None
    sizes: Sizes | None = None
    missing: Missing = USUALLY_FILLED
    name: str | None = None
    tilt: Literal["unknown", "mounting"] = "unknown"
    pixels: Pixels | None = None
    blur: float | None = None
    tip_radius: float | None = None

    def __post_init__(self) -> None:
        _ = self.instrument  # refuses what cannot be
        allowed_choice("tilt", self.tilt, ("unknown", MOUNTING))
        if self.unit is not None:
            metres_per(self.unit)

    @property
    def instrument(self) -> Instrument:
        """What is told of the instrument."""
        return Instrument(self.pixels, self.blur, self.tip_radius)
