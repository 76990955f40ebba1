"""Physical limits of the answers: no interval reaches beyond them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.hardness import hardness_of
from roughline.computing.arrays import Real

Limits = tuple[Real | float, Real | float]
"""Least and largest value, over the loads or at all of them."""


def limits_of_answers(result: Assessment) -> Mapping[str, Limits]:
    """Least and largest possible value of answers, by their keys; others are only not negative.

    No contact is larger than the whole area. No point bears more than the hardness, so that an
    area is at least the force over it.
    """
    whole, pair = result.area * result.scale, result.question.pair
    limits: dict[str, Limits] = {
        "contact_area": (0.0, whole),
        "contact_area_fraction": (0.0, 1.0),
        "plastic_fraction": (0.0, 1.0),
    }
    hardness = hardness_of(result.question)
    if hardness is not None and result.curve.hardness is not None:
        hardest = hardness.ends[1]
        # under a depth, the pressure itself depends on the hardness
        least = 0.0 if result.question.depths else result.curve_as_asked.force / result.area
        limits["contact_pressure"] = (least, hardest)
        limits["contact_pressure_over_hardness"] = (0.0, 1.0)
        limits["contact_area"] = (least / hardest * whole, whole)
        limits["contact_area_fraction"] = (least / hardest, 1.0)
    if pair is not None and (impedances := pair.both("impedance")) is not None:
        first, second = impedances  # welded bodies reflect the least
        limits["reflection"] = (abs(first - second) / (first + second), 1.0)
    return limits


def within(ends: tuple[Real, Real], limits: Limits) -> tuple[Real, Real]:
    """Ends of an interval, as far as they are within limits."""
    return np.maximum(ends[0], limits[0]), np.minimum(ends[1], limits[1])
