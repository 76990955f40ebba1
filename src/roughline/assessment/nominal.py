"""The nominal area of a body, and of the joint that it is a map of."""

from __future__ import annotations

import math

from roughline.assessment.given import as_si
from roughline.errors.checks import refuse
from roughline.topography.body import Body, Surface


def nominal_area(body: Body) -> float:
    """Nominal area of a body; of a line, the square of its length. [m²]"""
    return body.area if isinstance(body, Surface) else body.length**2


def area_of_joint(given: float | str) -> float:
    """Nominal area of a joint, from a number or a text such as "2 cm^2". [m²]

    Raises
    ------
    InputError
        If it is not positive, or no area.
    """
    area = as_si(given, "m^2", "joint_area")
    if not 0 < area < math.inf:
        refuse("joint_area", given, "a positive, finite area is needed")
    return area
