"""What is worth telling of a surface that was pressed, and of which nothing else was asked."""

from __future__ import annotations

import math

import numpy as np

from roughline.contact.curve import SurfaceCurve
from roughline.facts.fact import Fact, by_weight
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.margins.grid import facts_on_full_contact
from roughline.question.meant import facts_on_strain
from roughline.topography.body import Surface
from roughline.units import engineering


def facts_on_press(surface: Surface, curve: SurfaceCurve) -> list[Fact]:
    """Return the facts of an assessment that rest on a body and its curve, the gravest first.

    These are what the curve says, slopes and strains beyond those of half-spaces, and loads under
    which all points touch.
    """
    half_space, forces = curve.half_space, np.maximum(curve.force, 0.0)
    side = math.inf if half_space.periodic is True else min(surface.sizes)
    loads = [engineering(force, "N", 3) for force in curve.force]
    of = "pressure" if isinstance(half_space, Homogeneous) else "layers"
    ratios = [half_space.strain(force / surface.area, side) for force in forces]
    strains = [
        (ratio, Fact("strain_of_load", load=load, ratio=ratio, of=of, is_beside_fluid=False))
        for load, ratio in zip(loads, ratios, strict=True)
    ]
    everywhere = np.arange(len(loads))
    return by_weight(
        [
            *facts_on_strain(surface, strains),
            *facts_on_full_contact(curve, surface.heights.size, everywhere, loads),
            *curve.facts,
        ]
    )
