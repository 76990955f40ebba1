"""Partial slip under a constant normal force: Cattaneo and Mindlin's sphere, and bodies c r^n.

The shear is that of sliding, mu p, less that of a smaller contact, which ends where the stick does.
Pressure and shear do not move each other, and n = nu / (1 - nu) is 0: else shear is not quite along
the slide where bodies slip, and these formulas are those of the textbooks still, within 1 %.

References
----------
.. [1] R. D. Mindlin, "Compliance of elastic bodies in contact", J. Appl. Mech. 16, 259-268 (1949).
.. [2] R. D. Mindlin and H. Deresiewicz, "Elastic spheres in contact under varying oblique forces",
   J. Appl. Mech. 20, 327-344 (1953): unloading, and the energy of a cycle.
.. [3] J. Jäger, "Axi-symmetric bodies of equal material in contact under torsion or shift", Arch.
   Appl. Mech. 65, 478-487 (1995): any body of revolution.
.. [4] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eqs. 7.41 and 7.42, and §7.4.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughline.exact._checks import Real, positive
from roughline.exact.indenters import PowerLawIndenter


@dataclass(frozen=True)
class CattaneoMindlin:
    """A body c r^n at a constant depth, under a shear force that rises and is reversed.

    Attributes
    ----------
    body : PowerLawIndenter
        The body; Hertz's paraboloid is Cattaneo and Mindlin's.
    depth : float
        Depth d. [length]
    G_star : float
        Tangential contact modulus. [pressure]
    friction : float
        Coefficient mu. [1]

    Raises
    ------
    ValueError
        If a number is not positive.
    """

    body: PowerLawIndenter
    depth: float
    G_star: float
    friction: float

    def __post_init__(self) -> None:
        positive(depth=self.depth, G_star=self.G_star, friction=self.friction)

    @property
    def largest_force(self) -> float:
        """Shear force mu F at which the body slides. [force]"""
        return self.friction * float(self.body.force(self.depth))

    @property
    def largest_slide(self) -> float:
        """Slide mu (E* / G*) d at which the body begins to slide. [length]"""
        return self.friction * self.body.E_star / self.G_star * self.depth

    def slide(self, shear_force: ArrayLike) -> Real:
        """Slide mu (E* / G*) (d - d_c), with F(d_c) = F - Q / mu; odd in the force. [length]

        Of a sphere it is mu (E* / G*) d (1 - (1 - Q / (mu F))^(2/3)) [4]_.

        Parameters
        ----------
        shear_force : float or ndarray
            Q, at most mu F; that of a body that was at rest. [force]
        """
        share = np.asarray(shear_force) / self.largest_force
        return np.sign(share) * self.largest_slide * (1 - (1 - np.abs(share)) ** self._power)

    def slide_after(self, turned_at: float, shear_force: ArrayLike) -> Real:
        """Slide after the force was turned at Q*, as it goes on to -Q*, by Masing's rule. [length]

        Parameters
        ----------
        turned_at : float
            Q*, at most mu F in size. [force]
        shear_force : float or ndarray
            Q, between Q* and -Q*. [force]
        """
        back = (turned_at - np.asarray(shear_force)) / 2
        return self.slide(turned_at) - 2 * self.slide(back)

    def stick_radius(self, shear_force: ArrayLike) -> Real:
        """Stick radius; of a sphere a (1 - Q / (mu F))^(1/3). [length]"""
        left = 1 - np.abs(shear_force) / self.largest_force
        return self.body.radius(self.depth) * left ** (self._power / self.body.exponent)

    def stiffness(self, shear_force: ArrayLike) -> Real:
        """Tangential stiffness dQ/du = 2 G* c of a force that goes on. [force / length]"""
        return 2 * self.G_star * self.stick_radius(shear_force)

    def energy_of_cycle(self, amplitude: float) -> float:
        """Energy that a cycle between Q* and -Q* dissipates. [energy]

        Of a sphere it is 3.6 ((mu F)² / (G* a)) (1 - (1 - S)^(5/3) - (5 / 6) S (1 + (1 - S)^(2/3)))
        with S = Q* / (mu F) [2]_.

        Parameters
        ----------
        amplitude : float
            Q*, at most mu F. [force]
        """
        S, m = amplitude / self.largest_force, self._power
        # by Masing the loop is 8 times what is between the first loading and its chord
        below = S - (1 - (1 - S) ** (1 + m)) / (1 + m)  # integral of u dQ
        chord = S * (1 - (1 - S) ** m) / 2
        return 8 * self.largest_force * self.largest_slide * (chord - below)

    @property
    def _power(self) -> float:
        """Of the force in the depth of the contact: d is as F to this power."""
        return self.body.exponent / (self.body.exponent + 1)
