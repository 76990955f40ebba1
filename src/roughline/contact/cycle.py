"""Depths of a whole cycle of bodies that stick: to a force well above the pull-off, and back."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roughline.contact.full import press_surface
from roughline.contact.loads import (
    OVER_PULL_OFF,
    Loads,
    deepest_ones,
    even_cycle,
    separation_depth,
)
from roughline.errors import Interrupted
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.pulling_zone import farthest_pulled
from roughline.halfspace.search.problem import Method
from roughline.topography.body import Surface

_RETREAT_STEPS = 16  # on the way on which the pull-off is looked for
_TRIAL_RTOL = 1e-3  # tolerance of the depths that are tried


def cycle_of_depths(
    surface: Surface,
    half_space: HalfSpace,
    law: ContactLaw,
    n_loads: int,
    method: Method,
) -> Loads:
    """Return even depths from out of reach to a large one, and back until nothing is in contact.

    Depths are tried from half of the mean separation on. Each is pressed, and drawn back in some
    steps, until the force is twice the largest pull on the way back. Where a load was not solved,
    or no depth is enough, the last one that was tried is taken.

    Parameters
    ----------
    surface : Surface
        The rough body. [length]
    half_space : HalfSpace
        What it is pressed into.
    law : ContactLaw
        A law of bodies that stick.
    n_loads : int
        Number of depths.
    method : Method
        How each depth is solved; those that are tried, no better than to a tolerance of 1e-3.

    Raises
    ------
    KeyboardInterrupt
        On Ctrl-C, as no load of the cycle was solved yet.
    """
    method = replace(method, rtol=max(method.rtol, _TRIAL_RTOL))
    for deepest in deepest_ones(surface, half_space):
        separated = separation_depth(surface, half_space, law, deepest)
        back = np.linspace(deepest, separated, _RETREAT_STEPS + 1)
        loads = Loads("depths", back)
        try:
            force = press_surface(surface, loads, law, half_space=half_space, method=method).force
        except Interrupted:  # no load of the cycle was solved
            raise KeyboardInterrupt from None
        if not np.isfinite(force).all() or force[0] >= OVER_PULL_OFF * -force.min():
            break
    # the first step after which nothing is in contact any more
    last = min(int(np.flatnonzero(force != 0).max(initial=0)) + 1, _RETREAT_STEPS)
    return even_cycle(-farthest_pulled(law), deepest, float(back[last]), n_loads)
