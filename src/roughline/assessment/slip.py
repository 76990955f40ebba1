"""Partial slip: tangential loading of a pressed body at its largest load."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.assessment.loads import LoadCase
from roughline.assessment.question import Question
from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.engineering.formulas import partial_slip

_LIGHTEST, _LOADS = 1e-3, 16  # first of the loads on the way back, over the last, and their number


@dataclass(frozen=True, eq=False)
class PartialSlip:
    """Tangential loading at the largest normal load, from no load to full sliding.

    Attributes
    ----------
    friction : float
        Coefficient of friction. [1]
    displacement, force : ndarray
        Slip displacement [m] and tangential force [N].
    """

    friction: float
    displacement: Real
    force: Real


def slip_at_largest_load(
    question: Question, case: LoadCase, curve: Curve, area: float
) -> tuple[PartialSlip | None, bool]:
    """Partial slip at the largest load, if it was solved and friction is known.

    Where metals yield, slip follows the unloading curve, which is elastic: the surface that the
    largest load left is pressed again. The second result says whether Ctrl-C came.

    Parameters
    ----------
    question : Question
        With friction and the joint, if there is one.
    case : LoadCase
        How the curve was made.
    curve : Curve
        Of the body.
    area : float
        Nominal area of the body. [m²]
    """
    pair, friction, largest = question.pair, question.friction, case.largest
    if pair is None or friction is None or not curve.converged[largest]:
        return None, False
    force, branch = float(curve.force[largest]), curve
    if curve.hardness is not None:
        forces = force * np.geomspace(_LIGHTEST, 1.0, _LOADS)
        back = LoadCase(curve.E_star, forces.tolist(), [], (), None, case.periodic)
        branch, interrupted = back.press(curve.surface_after(largest), [], None)
        if interrupted:
            return None, True
    rising = np.argsort(branch.force)
    rising = rising[(branch.converged & (branch.force <= force))[rising]]
    scale = question.scale(area)
    found = partial_slip(
        branch.depth[rising], branch.force[rising] * scale, pair.E_star, pair.G_star, friction
    )
    return PartialSlip(friction, *found), False
