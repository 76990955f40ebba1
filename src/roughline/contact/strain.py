"""How far a load strains a body, beside what half-spaces are a model of."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from roughline.errors import UnitWarning
from roughline.facts.fact import Fact
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.topography.body import Body, Surface, side_lengths
from roughline.topography.profile import Profile

if TYPE_CHECKING:
    from roughline.contact.curve import Curve

LARGEST_STRAIN = 1.0
"""Depth over the shorter side of a body, or mean pressure over E*, beyond any half-space."""

LARGE_STRAIN = 0.1
"""The same, or any strain, above which a warning says that bodies are not linear elastic."""

LINEARITY = "half-spaces are linear elastic far below that only"

_WRONG_UNIT_STRAIN = 10.0  # from which a unit is wrong, if heights and sides have the same one
_ONE_UNIT_ROUGHNESS = 0.1  # rms height over the side, up to which both have the same unit


def warn_of_strain(body: Body | Profile, curve: Curve) -> None:
    """Warn of loads that strain a body beyond any half-space, as a wrong unit makes them.

    Contacts are alike whatever the unit of heights and depths, as long as they are linear. So
    nothing is said of flat bodies, and of those as high as they are wide, whose heights have a unit
    of their own.
    """
    if isinstance(body, Profile):
        side, area = 2 * body.largest_radius, body.area
    else:
        side = min(side_lengths(body))
        area = body.area if isinstance(body, Surface) else side**2
    if not curve.converged.any() or not 0 < body.rms_height <= _ONE_UNIT_ROUGHNESS * side:
        return
    found = [(0.0, "")]
    if curve.control == "depths":  # under a force, a soft base gives way as deep as it is soft
        depth = float(np.nanmax(curve.depth))
        found.append((depth / side, "depth"))
    if isinstance(curve.half_space, Homogeneous):
        pressure = float(np.nanmax(curve.force)) / area
        found.append((pressure / curve.E_star, "pressure"))
    ratio, of = max(found)
    if ratio > _WRONG_UNIT_STRAIN:
        warnings.warn(str(Fact("wrong_unit", ratio=ratio, of=of)), UnitWarning, stacklevel=5)
