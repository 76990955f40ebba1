"""Hankel transforms of order zero of functions that fall exponentially.

References
----------
.. [1] G. N. Watson, *A Treatise on the Theory of Bessel Functions*, Cambridge (1944), §13.2 (the
   integral along the real axis, turned to the imaginary one).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy import special

from roughline.computing.arrays import Real
from roughline.computing.panels import on_panels

_LARGEST_QH = 22.0  # from which on exp(-2 q h) and a few powers of q h are below rounding
_SMALLEST_QL = 1e-7  # q times the longest length, below which a function no longer changes
_PANEL_RADIANS = 10.0  # radians of J_0 that one panel holds at most
_TURNED_FROM = 40.0  # times the longest length: exp(-40) is left out
_K0_PANEL = np.polynomial.legendre.leggauss(80)


def hankel(transform: Callable[[Real], Real], r: Real, length: float, longest: float) -> Real:
    """Return ``integral of transform(q) J_0(q r) dq`` from zero to infinity, for each r.

    Parameters
    ----------
    transform : callable
        A function that falls as exp(-2 q length), of real and of imaginary q. It is real on the
        real axis. No pole with a real part that is not negative is nearer to zero than about one
        over the longest length.
    r : ndarray, shape (n,)
        Distances, the largest at most some times the least. [length]
    length, longest : float
        Lengths over which the result changes near and far. [length]

    Returns
    -------
    ndarray, shape (n,)
        The integrals.
    """
    if r.min() > _TURNED_FROM * longest:
        return _turned(transform, r)
    return _along_the_axis(transform, r, length, longest)


def _along_the_axis(
    transform: Callable[[Real], Real], r: Real, length: float, longest: float
) -> Real:
    """Integrate over panels, each twice as long as the one before, up to a turn or so of J_0."""
    most, step = _LARGEST_QH / length, _PANEL_RADIANS / float(r.max())
    first = _SMALLEST_QL / longest
    growing = first * 2.0 ** np.arange(math.ceil(math.log2(max(min(step, most) / first, 2.0))))
    edges = np.concatenate([[0.0], growing, np.arange(growing[-1] + step, most + step, step)])
    q, weights = on_panels(edges)
    values = weights * transform(q)
    return np.array([values @ special.j0(q * each) for each in r])


def _turned(transform: Callable[[Real], Real], r: Real) -> Real:
    """Integrate ``(2 / pi) Re transform(i t) K_0(t r)`` over t, up to where it is small [1]_.

    With t r = u^6, the logarithm of K_0 is no hindrance.
    """
    nodes, weights = _K0_PANEL
    end = _TURNED_FROM ** (1 / 6)
    u = end * (1 + nodes) / 2
    t, shares = u**6, end * weights * 6 * u**5 * special.k0(u**6) / math.pi
    return np.array([shares @ transform(1j * t / each).real / each for each in r])
