"""The stiffness of a rigid disc on a half-space, from what its waves are displaced by.

Of all pressures of a force on the disc, that of the punch has the least energy. So a few pressures
that a disc may have, of the least energy together, give a stiffness that is at most the exact one.
Pressures (1 - r²)^(i - 1/2) are that of a punch on a half-space, that of a ball, and one that falls
more steeply yet, as on a thin layer that keeps its volume.

References
----------
.. [1] G. N. Watson, *A Treatise on the Theory of Bessel Functions*, Cambridge (1944), §12.11
   (Sonine's integral: the transforms of these pressures).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy import special

from roughline.computing.arrays import Real
from roughline.computing.panels import on_panels


def disc_stiffness(spectrum: Callable[[Real], Real], radius: float) -> float:
    """Force per approach of a rigid disc, at most the exact one. [force / length]"""
    turns = 20 * math.pi  # wavenumber times radius; then no more is left than means over a turn
    near = np.append(np.geomspace(1e-9, 5.0, 34), np.linspace(5.0, turns, 13)[1:])
    x, weights = on_panels(near)
    of_unit_force = enumerate((1.0, 3.0, 15.0))
    each = [factor * special.spherical_jn(i, x) / x**i for i, factor in of_unit_force]
    compliance = (each * (weights * x * spectrum(x / radius))) @ np.transpose(each)
    x, weights = on_panels(np.geomspace(turns, 1e8 * turns, 28))  # of the punch alone
    compliance[0, 0] += float((weights / (2 * x)) @ spectrum(x / radius))
    shares = np.linalg.solve(compliance, np.ones(len(each)))
    return 2 * math.pi * radius**2 * float(shares.sum())
