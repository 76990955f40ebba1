"""The reduction method for bodies of revolution: profile f(r) to line g(x), by quadrature.

References
----------
.. [1] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
   Friction*, Springer (2015), eqs. 3.1 to 3.5.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from roughline.exact._checks import Real

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(200)


def line_profile(slope: Callable[[Real], Real], x: Real) -> Real:
    """Profile of the line, ``g(x) = |x| int_0^|x| f'(r) / sqrt(x² - r²) dr``. [length]

    Parameters
    ----------
    slope : callable
        f'(r) of the body of revolution; takes and returns an array. [1]
    x : ndarray
        Positions along the line. [length]
    """
    # r = |x| sin(t) takes the root away: g = |x| int_0^(pi/2) f'(|x| sin t) dt
    angles, weights = _quadrature(0.0, np.pi / 2)
    distance = np.abs(np.atleast_1d(x))
    return distance * (slope(distance[:, np.newaxis] * np.sin(angles)) @ weights)


def force(slope: Callable[[Real], Real], radius: float, E_star: float) -> float:
    """Force at contact radius a, F = 2 E* int_0^a (g(a) - g(x)) dx. [force]

    Parameters
    ----------
    slope : callable
        f'(r). [1]
    radius : float
        Contact radius a. [length]
    E_star : float
        Contact modulus. [pressure]
    """
    x, weights = _quadrature(0.0, radius)
    depth = line_profile(slope, np.array([radius]))[0]
    return float(2 * E_star * ((depth - line_profile(slope, x)) @ weights))


def _quadrature(start: float, end: float) -> tuple[Real, Real]:
    half = (end - start) / 2
    return start + half * (_NODES + 1), half * _WEIGHTS
