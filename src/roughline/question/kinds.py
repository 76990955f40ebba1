"""Of which kind a body is, and how large, where answers depend on that."""

from __future__ import annotations

from typing import TypeGuard

from roughline.engineering.formulas import ELASTIC_UP_TO
from roughline.spectra.isotropic import has_rings
from roughline.topography.body import Body, Surface

WITHOUT_YIELD = (
    "has no yield: it can be used while mean contact pressures stay below about "
    f"{ELASTIC_UP_TO:g} of the hardness"
)
"""Said of the reduced model, which a line is pressed with."""


def is_map(body: Body) -> TypeGuard[Surface]:
    """Whether it is a surface that was cut out of a larger one."""
    return isinstance(body, Surface) and body.is_cut_out


def has_spectrum(body: Body) -> TypeGuard[Surface]:
    """Whether it is a surface with enough points along both sides and some roughness."""
    if not isinstance(body, Surface) or min(body.shape) < 8 or body.rms_height == 0:
        return False
    return has_rings(body)


def nominal_area(body: Body) -> float:
    """Nominal area of a body; of a line, the square of its length. [m²]"""
    return body.area if isinstance(body, Surface) else body.length**2
