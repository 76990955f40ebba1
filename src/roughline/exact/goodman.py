"""Goodman's approximation of contacts that slip as they are pressed: shear does not move pressure.

Bodies of two materials are pressed together. Their surfaces would be drawn inwards by different
amounts, so shear arises; it sticks within c and slips from c to the edge a. Both ratios below hold
for a flat punch and for all bodies c r^n at once, as the latter grow without a change of shape.

References
----------
.. [1] L. E. Goodman, "Contact stress analysis of normally loaded rough spheres", J. Appl. Mech. 29,
   515-522 (1962): the approximation.
.. [2] D. A. Spence, "Self similar solutions to adhesive contact problems with incremental loading",
   Proc. R. Soc. A 305, 55-80 (1968): the same ratio for punches and for bodies that grow alike.
.. [3] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §2.8 and 5.4: plane bodies, with the
   elliptic integrals.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cosh, exp, log, tanh

from roughline.exact._checks import positive

_LOWEST_LOGARITHM, _HIGHEST_LOGARITHM = (
    -340.0,
    log(35.0),
)  # of ln(artanh(c / a)): 0 and 1 to rounding


def disc_stick_ratio(friction: float, beta: float) -> float:
    """Stick radius over contact radius of bodies of revolution. [1]

    It solves (beta / 2 mu) ln((a + c) / (a - c)) = (c / a) K'(c / a), with the complete elliptic
    integral K' of the complementary modulus.

    Parameters
    ----------
    friction : float
        Coefficient mu. [1]
    beta : float
        Dundurs' constant. [1]

    Raises
    ------
    ValueError
        If either is not positive.
    """
    positive(friction=friction, beta=beta)
    return _ratio_where(lambda artanh, k, K, K_1: beta * artanh - friction * k * K_1)


def plane_stick_ratio(friction: float, beta: float) -> float:
    """Half-width of stick over that of contact, of cylinders and long flat punches. [1]

    It solves beta K(c / a) = mu K'(c / a).

    Parameters
    ----------
    friction : float
        Coefficient mu. [1]
    beta : float
        Dundurs' constant. [1]

    Raises
    ------
    ValueError
        If either is not positive.
    """
    positive(friction=friction, beta=beta)
    return _ratio_where(lambda artanh, k, K, K_1: beta * K - friction * K_1)


def _ratio_where(excess: Callable[[float, float, float, float], float]) -> float:
    """Modulus k at which what rises with it, a function of artanh k, k, K and K', is zero.

    What is looked for is ln(artanh k), so that moduli near 0 and near 1 are told apart.
    """
    from scipy.optimize import brentq
    from scipy.special import ellipkm1

    def at(logarithm: float) -> float:
        artanh = exp(logarithm)
        k = tanh(artanh)
        return excess(artanh, k, float(ellipkm1(cosh(artanh) ** -2)), float(ellipkm1(k**2)))

    if at(_HIGHEST_LOGARITHM) <= 0:
        return 1.0
    return tanh(
        exp(float(brentq(at, _LOWEST_LOGARITHM, _HIGHEST_LOGARITHM, xtol=1e-15, rtol=1e-14)))
    )
