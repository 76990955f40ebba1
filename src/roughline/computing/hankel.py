"""Hankel transforms of functions that fall exponentially.

References
----------
.. [1] G. N. Watson, *A Treatise on the Theory of Bessel Functions*, Cambridge (1944), §13.2 (the
   integral along the real axis, turned towards the imaginary one).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np
from scipy import special

from roughline.computing.arrays import Real
from roughline.computing.panels import on_panels

_LARGEST_QH = 22.0  # from which on exp(-2 q h) and a few powers of q h are below rounding
_SMALLEST_QL = 1e-7  # q times the longest length, below which a function no longer changes
_PANEL_RADIANS = 10.0  # radians of J that one panel holds at most
_PANEL_FALLS = 5.0  # q h that it holds at most: exp(-2 q h) falls by exp(-10)
_TURNED_FROM = 40.0  # times the longest length: exp(-40) is left out
_TURNS_AT = 2.0  # q r, at which the path leaves the real axis: Hankel's functions end at zero
_SMALLEST_QR = 1e-6  # where the first panel ends: on a soft base waves far longer than r count


def hankel(
    transform: Callable[[Real], Real], r: Real, length: float, longest: float, order: int = 0
) -> Real:
    """Return ``integral of transform(q) J_order(q r) dq`` from zero to infinity, for each r.

    Parameters
    ----------
    transform : callable
        A function that falls as exp(-2 q length), of real and of complex q. It is real on the
        real axis. No pole with a real part that is not negative is nearer to zero than about one
        over the longest length.
    r : ndarray, shape (n,)
        Distances, the largest at most some times the least. [length]
    length, longest : float
        Lengths over which the result changes near and far. [length]
    order : int, optional
        That of Bessel's function, from 0 to 2.

    Returns
    -------
    ndarray, shape (n,)
        The integrals.
    """
    if r.min() <= _TURNED_FROM * longest:
        return _along_the_axis(transform, r, length, longest, order)
    return _turned(transform, r, order)


def _along_the_axis(
    transform: Callable[[Real], Real], r: Real, length: float, longest: float, order: int
) -> Real:
    """Integrate over panels, each twice as long as the one before, up to a turn or so of J."""
    most = _LARGEST_QH / length
    step = min(_PANEL_RADIANS / float(r.max()), _PANEL_FALLS / length)
    first = _SMALLEST_QL / longest
    growing = first * 2.0 ** np.arange(math.ceil(math.log2(max(step / first, 2.0))))
    edges = np.concatenate([[0.0], growing, np.arange(growing[-1] + step, most + step, step)])
    q, weights = on_panels(edges)
    values = weights * transform(q)
    bessel = special.j0 if order == 0 else partial(special.jv, order)
    return np.array([values @ bessel(q * each) for each in r])


def _turned(transform: Callable[[Real], Real], r: Real, order: int) -> Real:
    """Integrate along the axis up to q r = 2, and from there on parallel to the imaginary one [1]_.

    J is the real part of Hankel's function, which falls along that way.
    """
    q, weights = on_panels(np.array([0.0, *np.geomspace(_SMALLEST_QR, _TURNS_AT, 12)]))
    up, shares = on_panels(np.array([0.0, *np.geomspace(1.0, _TURNED_FROM, 8)]))
    way = _TURNS_AT + 1j * up
    before = weights * special.jv(order, q)
    beyond = 1j * shares * special.hankel1(order, way)
    return np.array(
        [
            (before @ transform(q / each) + (beyond @ transform(way / each)).real) / each
            for each in r
        ]
    )
