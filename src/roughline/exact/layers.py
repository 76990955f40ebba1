"""Waves and springs of layers: closed forms of one bonded layer.

References
----------
.. [1] T. Nogi and T. Kato, "Influence of a hard surface layer on the limit of elastic contact,
   part I: analysis using a real surface model", J. Tribol. 119, 493-500 (1997).
.. [2] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §5.8.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import ArrayLike

from roughline.exact._checks import Real, positive


@dataclass(frozen=True)
class BondedLayer:
    """One elastic layer, bonded to a half-space or to a rigid base.

    Attributes
    ----------
    young, poisson : float
        Of the layer. [pressure] and [1]
    thickness : float
        h. [length]
    base_young, base_poisson : float
        Of the base; ``math.inf`` makes it rigid. [pressure] and [1]

    Raises
    ------
    ValueError
        If a modulus or the thickness is not positive.
    """

    young: float
    poisson: float
    thickness: float
    base_young: float = inf
    base_poisson: float = 0.0

    def __post_init__(self) -> None:
        positive(young=self.young, thickness=self.thickness)
        if self.base_young != inf:
            positive(base_young=self.base_young)

    def compliance(self, q: ArrayLike) -> Real:
        """Displacement over pressure of waves; q is above zero [1]_. [length / pressure]"""
        positive(q=q)
        q, nu = np.asarray(q, dtype=np.float64), self.poisson
        shear = self.young / (2 * (1 + nu))
        ratio = shear / (self.base_young / (2 * (1 + self.base_poisson)))
        of_base = 1 - 4 * (1 - nu) / (1 + ratio * (3 - 4 * self.base_poisson))
        of_layer = (ratio - 1) / (ratio + 3 - 4 * nu)
        k = q * self.thickness
        e = np.exp(-2 * k)
        over = 1 + 4 * k * of_layer * e - of_base * of_layer * e**2
        under = 1 - (of_base + of_layer + 4 * of_layer * k**2) * e + of_base * of_layer * e**2
        found: Real = (1 - nu) / (shear * q) * over / under
        return found

    @property
    def spring(self) -> float:
        """Pressure over displacement of a thin layer on a rigid base [2]_. [pressure / length]

        It is the modulus of a layer that cannot widen, over its thickness.
        """
        nu = self.poisson
        modulus = self.young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        return modulus / self.thickness
