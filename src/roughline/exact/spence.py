"""Spence's contact of two materials that slips as it is pressed; and the one that sticks wholly.

A flat disc of unit radius is pressed into a half-space of another material, E* times its depth
being one. It holds the surface from being drawn inwards, by a shear q outwards. The lines of
pressure and shear,

    psi(t) = 2 int_t^1 r p dr / sqrt(r² - t²),    phi(t) = 2 t int_t^1 q dr / sqrt(r² - t²),
    p(r) = (psi(1) / sqrt(1 - r²) - int_r^1 psi'(t) dt / sqrt(t² - r²)) / pi,

are even and odd in t. With the Hilbert transform H f(t) = (1 / pi) PV int_-1^1 f(s) / (s - t) ds,

    psi - beta H phi = 1,                                            the surface under it is flat,
    phi + beta H psi = 0                               for t < c,    and it has not moved sideways,
    phi = (2 mu t / pi) (psi(1) K'(t) - int_t^1 psi'(s) K(sqrt(1 - t² / s²)) ds / s)    for t > c,

as q = mu p there. The radius c is that at which phi does not jump. A body that grows without a
change of shape, such as a sphere, is a sequence of such discs, and has the same c / a.

References
----------
.. [1] D. A. Spence, "The Hertz contact problem with finite friction", J. Elast. 5, 297-319 (1975).
.. [2] D. A. Spence, "Self similar solutions to adhesive contact problems with incremental loading",
   Proc. R. Soc. A 305, 55-80 (1968).
.. [3] V. I. Mossakovskii, "Compression of elastic bodies under conditions of adhesion (axisymmetric
   case)", J. Appl. Math. Mech. 27, 630-643 (1963): full stick.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import atanh, pi

import numpy as np

from roughline.exact._checks import Real, positive
from roughline.exact.goodman import disc_stick_ratio

_NODES_PER_PANEL = 8
_PANEL_RATIO = 0.4  # of neighbours, towards c and towards the edge
_LARGEST_RATIO = 1 - 1e-5  # of c and a; closer, panels at the edge are lost to rounding
_LEGENDRE_REACH = 4.0  # half-lengths of a panel within which its Cauchy integrals take Legendre's Q

_X, _W = np.polynomial.legendre.leggauss(_NODES_PER_PANEL)
# rows: coefficients of Legendre polynomials of values at the nodes
_COEFFICIENTS = (
    (np.arange(_NODES_PER_PANEL)[:, np.newaxis] + 0.5)
    * np.polynomial.legendre.legvander(_X, _NODES_PER_PANEL - 1).T
    * _W
)


def stuck_force_ratio(beta: float) -> float:
    """Force on a disc that sticks wholly over that without shear, artanh(beta) / beta [3]_. [1]

    Parameters
    ----------
    beta : float
        Dundurs' constant. [1]

    Raises
    ------
    ValueError
        If it is not positive.
    """
    positive(beta=beta)
    return atanh(beta) / beta


@dataclass(frozen=True)
class StickSlipDisc:
    """A disc, or a body c r^n, that is pressed with friction into another material.

    Attributes
    ----------
    friction : float
        Coefficient mu. [1]
    beta : float
        Dundurs' constant. [1]
    refinement : int
        Panels towards c and towards the edge, on which both lines are polynomials.

    Raises
    ------
    ValueError
        If one of them is not positive, or so little slips that panels do not resolve it.
    """

    friction: float
    beta: float
    refinement: int = 14

    def __post_init__(self) -> None:
        positive(friction=self.friction, beta=self.beta, refinement=self.refinement)
        if disc_stick_ratio(self.friction, self.beta) > _LARGEST_RATIO:
            raise ValueError(
                f"friction is {self.friction:g}, {self.friction / self.beta:g} times beta; the "
                "ring that slips is too narrow: take stuck_force_ratio"
            )

    @cached_property
    def stick_ratio(self) -> float:
        """Stick radius over contact radius, c / a; less than Goodman's. [1]"""
        from scipy.optimize import brentq  # here because it loads slowly

        low = high = disc_stick_ratio(self.friction, self.beta)
        while _Lines.of(self, low).jump > 0:
            low, high = low / 2, low
        return float(brentq(lambda c: _Lines.of(self, c).jump, low, high, xtol=1e-13))

    @cached_property
    def _lines(self) -> _Lines:
        return _Lines.of(self, self.stick_ratio)

    @property
    def force_ratio(self) -> float:
        """Force on the disc over that without friction. [1]"""
        return float(self._lines.weights @ self._lines.psi)

    @property
    def sphere_area_ratio(self) -> float:
        """Contact area of a sphere, over that of Hertz at the same depth. [1]

        A disc of radius 1 displaces the line at t > 1 by -beta H phi(t). A sphere reaches a when
        its line, x² / R, has risen from all discs before to its depth.
        """
        t, phi = self._lines.nodes, self._lines.phi
        risen = phi * -(t**2 + np.log1p(-(t**2))) / t**3
        return 1 - 2 * self.beta / pi * float(self._lines.weights @ risen)

    @property
    def sphere_force_ratio(self) -> float:
        """Force on a sphere, over that of Hertz at the same depth. [1]"""
        return self.force_ratio * self.sphere_area_ratio**0.5

    def line_of_pressure(self, t: Real) -> Real:
        """Line psi at 0 < t < 1, over E* d: the polynomials of its panels. [1]"""
        return self._lines.at(t, self._lines.psi)

    def line_of_shear(self, t: Real) -> Real:
        """Line phi at 0 < t < 1, over E* d: the polynomials of its panels. [1]"""
        return self._lines.at(t, self._lines.phi)


@dataclass(frozen=True, eq=False)
class _Lines:
    """Both lines for a radius of the stick, at Gauss's nodes of panels that narrow to it."""

    edges: Real
    psi: Real
    phi: Real
    stuck: int  # so many panels are within the radius

    @classmethod
    def of(cls, disc: StickSlipDisc, c: float) -> _Lines:
        """Solve the equations of the lines with this radius of the stick."""
        graded = _PANEL_RATIO ** np.arange(disc.refinement, -1, -1.0)  # up to 1
        middle = (1 - c) / 2
        edges = np.concatenate(
            [
                [0.0],
                c - c * graded[-2::-1],
                [c],
                c + middle * graded,
                1 - middle * graded[-2::-1],
                [1.0],
            ]
        )
        stuck = disc.refinement + 1
        nodes, is_stuck = _nodes(edges), stuck * _NODES_PER_PANEL
        ahead, behind = _cauchy(edges, nodes), _cauchy(edges, -nodes)
        H_odd, H_even = (ahead + behind) / pi, (ahead - behind) / pi
        shear = np.concatenate(  # phi of psi
            [-disc.beta * H_even[:is_stuck], disc.friction * _slip(edges, nodes, stuck)]
        )
        psi = np.linalg.solve(np.eye(nodes.size) - disc.beta * H_odd @ shear, np.ones(nodes.size))
        return cls(edges, psi, shear @ psi, stuck)

    @property
    def nodes(self) -> Real:
        """Gauss's nodes of all panels."""
        return _nodes(self.edges)

    @property
    def weights(self) -> Real:
        """Weights of the nodes."""
        return np.outer(np.diff(self.edges) / 2, _W).ravel()

    @property
    def jump(self) -> float:
        """How much phi falls from c inwards to c outwards."""
        inner, outer = (
            self.phi.reshape(-1, _NODES_PER_PANEL)[panel] for panel in (self.stuck - 1, self.stuck)
        )
        signs = (-1.0) ** np.arange(_NODES_PER_PANEL)
        return float((_COEFFICIENTS @ inner).sum() - signs @ (_COEFFICIENTS @ outer))

    def at(self, t: Real, line: Real) -> Real:
        """A line anywhere within the panels."""
        panel = np.clip(np.searchsorted(self.edges, t) - 1, 0, self.edges.size - 2)
        start, end = self.edges[panel], self.edges[panel + 1]
        values = line.reshape(-1, _NODES_PER_PANEL)[panel]
        found: Real = (_values_between((2 * t - start - end) / (end - start)) * values).sum(axis=-1)
        return found


def _nodes(edges: Real) -> Real:
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    return (middle[:, np.newaxis] + half[:, np.newaxis] * _X).ravel()


def _values_between(x: Real) -> Real:
    """Factors of the values at the nodes of a panel -1 < x < 1, whose sum is that at x."""
    found: Real = np.polynomial.legendre.legvander(x, _NODES_PER_PANEL - 1) @ _COEFFICIENTS
    return found


def _cauchy(edges: Real, at: Real) -> Real:
    """Factors of the values at nodes, whose sum is PV int_0^1 f(s) / (s - t) ds, for all t.

    In a panel, and near it, the integral of a Legendre polynomial is -2 times Legendre's Q.
    """
    columns = []
    for start, end in pairwise(edges):
        y = (2 * at - start - end) / (end - start)
        close = np.abs(y) < _LEGENDRE_REACH
        Q = [np.log(np.abs((1 + y[close]) / (1 - y[close]))) / 2]
        Q.append(y[close] * Q[0] - 1)
        for n in range(2, _NODES_PER_PANEL):
            Q.append(((2 * n - 1) * y[close] * Q[-1] - (n - 1) * Q[-2]) / n)
        found = np.empty((at.size, _NODES_PER_PANEL))
        found[close] = -2 * np.transpose(Q) @ _COEFFICIENTS
        found[~close] = _W / (_X - y[~close, np.newaxis])
        columns.append(found)
    return np.concatenate(columns, axis=1)


def _slip(edges: Real, nodes: Real, stuck: int) -> Real:
    """Factors of psi at all nodes, whose sums are phi / mu at nodes of the panels that slip.

    By parts, phi / mu = psi(t) + (2 t / pi) int_t^1 psi(s) d/ds (K / s) ds.
    """
    first, per = stuck * _NODES_PER_PANEL, _NODES_PER_PANEL
    t = nodes[first:, np.newaxis]
    weights = np.outer(np.diff(edges) / 2, _W).ravel()
    panel = np.arange(nodes.size) // per
    beyond = panel > panel[first:, np.newaxis]
    found = np.where(beyond, weights * _kernel(np.where(beyond, nodes, 2 * t), t), 0.0)
    end, start = edges[panel[first:] + 1, np.newaxis], edges[panel[first:], np.newaxis]
    s = (t + end) / 2 + (end - t) / 2 * _X  # the rest of a node's own panel
    rest = (end - t) / 2 * _W * _kernel(s, t)
    shares = np.einsum("ij,ijk->ik", rest, _values_between((2 * s - start - end) / (end - start)))
    own = first + np.arange(t.size)[:, np.newaxis] // per * per + np.arange(per)
    np.put_along_axis(found, own, shares, axis=1)
    found *= 2 * t / pi
    found[:, first:] += np.eye(t.size)
    return found


def _kernel(s: Real, t: Real) -> Real:
    """The derivative by s of K(k) / s, k² = 1 - t² / s²."""
    from scipy.special import ellipe, ellipk  # here because it loads slowly

    m = (1 - t / s) * (1 + t / s)
    K, E = ellipk(m), ellipe(m)
    small = m < 1e-4  # where the first terms of the series of dK/dm are exact to rounding
    series = pi / 8 * (1 + 9 / 8 * m + 75 / 64 * m**2)
    by_m = np.where(small, series, (E - (1 - m) * K) / np.where(small, 1.0, 2 * m * (1 - m)))
    found: Real = 2 * t**2 / s**4 * by_m - K / s**2
    return found
