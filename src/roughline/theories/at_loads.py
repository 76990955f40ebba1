"""Theories beside a curve that was solved."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from roughline.contact.curve import Curve
from roughline.facts.fact import Fact, own_words
from roughline.theories.theory import theory, why_not
from roughline.theories.theory_curve import TheoryCurve
from roughline.topography.body import Surface


def theories_at_loads(
    names: Iterable[str], surface: Surface, curve: Curve
) -> tuple[list[TheoryCurve], list[Fact]]:
    """Theories at the mean pressures of the loads that were solved, rising, each once.

    The second result says which are left out, as they do not hold of layers.
    """
    solved = np.unique(curve.force[curve.converged & (curve.force > 0)])
    found: list[TheoryCurve] = []
    left_out: list[Fact] = []
    for name in names if solved.size else ():
        if why := why_not(name, surface, curve.half_space):
            left_out.append(Fact("without_answer", names=(name,), why=own_words(why)))
        else:
            pressure = solved / surface.area
            found.append(theory(name, surface, pressure=pressure, half_space=curve.half_space))
    return found, left_out
