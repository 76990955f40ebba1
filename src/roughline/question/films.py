"""Films thinner than contact spots are wide: these feel the hardness of what lies below."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.measures import Measure
from roughline.engineering.coated import Coated
from roughline.engineering.material import Material
from roughline.question.loads import find_hardness
from roughline.question.question import Question


def _spot_radius(fields: Fields) -> float:
    """Mean radius of discs as large as the spots, weighted with their areas. [length]"""
    areas = fields.patches().areas
    return float((areas**1.5).sum() / areas.sum() / math.sqrt(math.pi)) if areas.size else 0.0


SPOT_RADIUS = Measure(
    "spot_radius", "r_s", "length", "mean radius of spots, weighted with their areas", _spot_radius
)
"""Taken of a body whose softer side has a film."""


@dataclass(frozen=True)
class Film:
    """The top layer of the softer body, and what lies below it."""

    top: Material
    thickness: float  # [m]
    below: Material


def find_film(question: Question) -> Film | None:
    """The film whose hardness a question is answered with; None if that is given, or not asked."""
    if question.pair is None or question.hardness is not None or question.elastic:
        return None
    softer = question.pair.softer
    if not isinstance(softer, Coated):
        return None
    top, thickness = softer.layers[0]
    return Film(top, thickness, softer.materials[1])


def film_that_spots_exceed(question: Question, curve: Curve) -> tuple[Film, float] | None:
    """The film, and the radius of the spots where these are wider than it is thick; else None."""
    measured = curve.measured if isinstance(curve, SurfaceCurve) else {}
    film, radii = find_film(question), measured.get(SPOT_RADIUS.name)
    if film is None or radii is None:
        return None
    radius = float(np.nanmax(radii.values, initial=0.0))
    return (film, radius) if radius > film.thickness else None


def hardness_ends(question: Question, curve: Curve) -> tuple[float, float] | None:
    """The softest and the hardest that the softer body may be; None if bodies are elastic. [Pa]

    Spots that are wider than a film is thick press into what lies below it, so that the hardness
    they meet lies between both. One that is given with the material is taken as exact.
    """
    hardness = find_hardness(question)
    if hardness is None:
        return None
    low, high = hardness.ends
    if hardness.factor == 1:
        return low, high
    found = film_that_spots_exceed(question, curve)
    below = None if found is None else found[0].below
    if below is None or below.hardness is None:
        return low, high
    factor = below.hardness_factor
    return min(low, below.hardness / factor), max(high, below.hardness * factor)
