"""Disc that is moved sideways on a half-space: in full stick, and with a constant strength.

Pressure and shear do not move each other here, and shear is along the slide everywhere: bodies of
equal materials, or both incompressible, and exactly of n = nu / (1 - nu) = 0. In full stick the
stiffness holds for every Poisson's ratio.

References
----------
.. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §3.7 and 7.2.
.. [2] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
   Friction*, Springer (2015), ch. 5.
"""

from __future__ import annotations

from roughline.exact._checks import Real, positive
from roughline.exact.punch import disc_pressure
from roughline.exact.yielding import YieldingDisc


def stuck_stiffness(G_star: float, radius: float) -> float:
    """Tangential stiffness of the disc in full stick, k_t = 2 G* a [1]_. [force / length]

    Parameters
    ----------
    G_star : float
        Tangential contact modulus, 1 / G* = (2 - nu1) / (4 G1) + (2 - nu2) / (4 G2). [pressure]
    radius : float
        Radius a. [length]
    """
    positive(G_star=G_star, radius=radius)
    return 2 * G_star * radius


def stuck_shear(shear_force: float, radius: float, r: Real) -> Real:
    """Shear under the disc in full stick, Q / (2 pi a sqrt(a² - r²)), as of a pressure. [pressure]

    Parameters
    ----------
    shear_force : float
        Q. [force]
    radius : float
        Radius a. [length]
    r : ndarray
        Distances from the axis; the shear is infinite at the rim. [length]
    """
    return disc_pressure(shear_force, radius, r)


def disc_of_strength(radius: float, G_star: float, strength: float) -> YieldingDisc:
    """Disc on which the shear is at most a strength: it slips at its rim, from the first slide on.

    With G* for E* and the strength for the hardness it is the disc that yields [2]_: slide
    (2 tau / G*) sqrt(a² - c²), shear force 2 tau (a² arccos(c / a) + c sqrt(a² - c²)), at most
    pi a² tau, and tangential stiffness 2 G* c for the stick radius c.

    Parameters
    ----------
    radius : float
        Radius a. [length]
    G_star, strength : float
        Tangential contact modulus, and tau. [pressure]

    Returns
    -------
    YieldingDisc
        Of its depth, force, stiffness and pressure each is that of the shear.
    """
    return YieldingDisc(radius, G_star, strength)
