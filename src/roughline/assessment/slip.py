"""Partial slip: tangential loading of a pressed body at its largest load."""

from __future__ import annotations

import numpy as np

from roughline.assessment.presses import UNLOADED
from roughline.engineering.formulas import partial_slip
from roughline.engineering.slip import PartialSlip
from roughline.margins.variant import Curves
from roughline.question.case import Case
from roughline.question.kinds import nominal_area


def slip_at_largest_load(case: Case, curves: Curves) -> PartialSlip | None:
    """Partial slip at the largest load, if it was solved and friction is known.

    Where metals yield, slip follows the unloading curve, which is elastic: that of the surface that
    the largest load left.
    """
    curve, pair, friction = curves.as_asked, case.pair, case.question.friction
    largest = case.loads.largest
    if pair is None or pair.coated or friction is None or not curve.converged[largest]:
        return None
    branch = curve if curve.hardness is None else curves.complete(UNLOADED)
    if branch is None:
        return None
    force = float(curve.force[largest])
    rising = np.argsort(branch.force)
    rising = rising[(branch.converged & (branch.force <= force))[rising]]
    scale = case.question.loading.scale(nominal_area(case.body))
    found = partial_slip(
        branch.depth[rising], branch.force[rising] * scale, pair.E_star, pair.G_star, friction
    )
    return PartialSlip(friction, *found)
