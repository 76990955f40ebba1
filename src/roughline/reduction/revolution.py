"""The reduced model of a body of revolution: one contact, whose edge follows the load.

References
----------
.. [1] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
   Friction*, Springer (2015), eqs. 3.1 to 3.5, and §4.2 and 4.3 for bodies that stick.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from roughline.computing.arrays import Real

_SMALLEST_RADIUS = 1e-7  # of the radii between which edges are looked for, over the largest
_LOGARITHMIC_RADII, _EVEN_RADII = 400, 2000  # of these, evenly in their logarithm, and evenly
_BLOCK_INTEGRALS = 10**6  # integrals computed at a time
_PROFILE_ROUNDING = 1e-6  # by which a line that rises may seem to fall, over its largest

_DEPTH, _FORCE = 0, 1  # in the order of loads at rest
LoadControl = Literal["depths", "forces"]
"""What is prescribed."""


class Moved(NamedTuple):
    """Where a load leads the edge of a contact."""

    radius: float  # zero: nothing is left. [length]
    dissipated: float = 0.0  # where the edge jumped. [energy]
    pull_off: tuple[float, float] | None = None  # depth and force of the largest pull, if passed


@dataclass(frozen=True, eq=False)
class Revolution:
    """A body of revolution on springs, with a contact of radius a.

    Its line is g(a) = a int_0^a f'(r) / sqrt(a² - r²) dr for a body -f(r). At a depth d the force
    is 2 E* (a d - G) with G = int_0^a g dx, and the edge rests where the springs there are pulled
    by what they bear, d = g - Delta l. It moves outwards where that is less than the depth, and
    inwards where it is more; under a force alike.
    """

    radii: Real
    slopes: Real  # shape (2, n - 1): of f between the radii, constants and factors of r
    E_star: float
    work_of_adhesion: float  # zero: the body does not stick. [energy / length²]

    @classmethod
    def of(cls, radii: Real, heights: Real, E_star: float, work_of_adhesion: float) -> Revolution:
        """Put springs under heights at radii."""
        return cls(radii, _slopes(radii, heights), E_star, work_of_adhesion)

    def line(self, a: Real) -> tuple[Real, Real]:
        """The line g and its integral G, exact for the slopes of the profile."""
        rows = max(1, _BLOCK_INTEGRALS // self.radii.size)
        parts = [self._line(a[i : i + rows]) for i in range(0, a.size, rows)]
        g, G = np.concatenate(parts, axis=1)
        return g, G

    def _line(self, a: Real) -> Real:
        t = np.minimum(self.radii / a[:, np.newaxis], 1.0)
        angle, root = np.arcsin(t), np.sqrt((1 - t) * (1 + t))
        # the integrals of t^k / root, and of t^k root, for k = 0 and 1
        of_g = angle, -root
        of_G = (angle + t * root) / 2, -root * root * root / 3
        g, G = (
            sum(np.diff(each) @ self.slopes[k] * a**k for k, each in enumerate(of))
            for of in (of_g, of_G)
        )
        return np.array([a * g, a**2 * G])

    def elongation(self, a: Real) -> Real:
        """Pull of the springs at the edge, Delta l. [length]"""
        return np.sqrt(2 * np.pi * a * self.work_of_adhesion / self.E_star)

    def force(self, a: float, depth: float) -> float:
        """Force of a contact. [force]"""
        return 2 * self.E_star * (a * depth - self._integral(a))

    def depth(self, a: float, force: float) -> float:
        """Depth of a contact. [length]"""
        return (force / (2 * self.E_star) + self._integral(a)) / a

    def _integral(self, a: float) -> float:
        return float(self.line(np.array([a]))[1][0]) if a else 0.0

    def at_rest(self, a: Real) -> tuple[Real, Real]:
        """Depths and forces at which the edge rests at radii."""
        return self._at_rest(a, *self.line(a))

    def _at_rest(self, a: Real, g: Real, G: Real) -> tuple[Real, Real]:
        depth = g - self.elongation(a)
        return depth, 2 * self.E_star * (a * depth - G)

    @cached_property
    def _lines(self) -> tuple[Real, Real, Real]:
        """Radii between which edges are looked for, and the line and its integral there."""
        most = self.radii[-1]
        narrow = most * np.geomspace(_SMALLEST_RADIUS, 1, _LOGARITHMIC_RADII)
        a = np.union1d(narrow[:-1], most * np.linspace(0, 1, _EVEN_RADII + 1)[1:])
        return a, *self.line(a)

    @cached_property
    def table(self) -> tuple[Real, Real, Real]:
        """These radii, and the depths and forces at which the edge rests there."""
        return self._lines[0], *self._at_rest(*self._lines)

    @cached_property
    def _squares(self) -> tuple[Real, Real]:
        """Radii from zero on, and the integral of g² over x up to each."""
        radii = np.append(0.0, self._lines[0])
        return radii, np.append(0.0, np.cumsum(self._squares_between(radii[:-1], radii[1:])))

    def _squares_between(self, start: Real, end: Real) -> Real:
        """The integrals of g² over x, by Gauss's rule of two nodes."""
        middle, half = (start + end) / 2, (end - start) / 2
        lines = [self.line(middle + side * half / np.sqrt(3))[0] for side in (-1, 1)]
        return half * (lines[0] ** 2 + lines[1] ** 2)

    def _squares_up_to(self, a: float) -> float:
        radii, sums = self._squares
        last = int(np.searchsorted(radii, a, side="right")) - 1
        return float(sums[last] + self._squares_between(radii[last : last + 1], np.array([a]))[0])

    def stored(self, a: float, depth: float) -> float:
        """Energy of the springs, less the work of adhesion. [energy]"""
        stretched = a * depth**2 - 2 * depth * self._integral(a) + self._squares_up_to(a)
        return self.E_star * stretched - self.work_of_adhesion * np.pi * a**2

    @property
    def falls_at(self) -> float | None:
        """Radius from which the line falls, so that the contact may be no disc. [length]"""
        a, g, _ = self._lines
        wrong = np.maximum.accumulate(np.maximum(g, 0.0)) - g > _PROFILE_ROUNDING * np.abs(g).max()
        return float(a[wrong.argmax()]) if wrong.any() else None

    def moved(self, control: LoadControl, start: float, value: float) -> Moved:
        """Lead the edge slowly from a radius to a load, jumps included.

        Bodies that are apart are first brought to where they touch, at a depth of zero.

        Parameters
        ----------
        control : {"depths", "forces"}
            What is prescribed.
        start : float
            Contact radius before; zero: the bodies are apart. [length]
        value : float
            The depth, or the force. [length] or [force]
        """
        which = _DEPTH if control == "depths" else _FORCE
        touched = Moved(start)
        if start == 0 and (value >= 0 or which == _FORCE):
            touched = self._outwards(0.0, 0.0, _DEPTH)
        radius = touched.radius
        if radius == 0 and value <= 0:
            return touched
        is_less = radius == 0 or self._load_at(radius, which) < value
        moved = (self._outwards if is_less else self._inwards)(radius, value, which)
        return moved._replace(dissipated=touched.dissipated + moved.dissipated)

    def _outwards(self, start: float, value: float, which: int) -> Moved:
        radii, loads = self.table[0], self.table[1 + which]
        way = np.append(start, radii[radii > start])
        passed = np.append(self._load_at(start, which), loads[radii > start])
        reached = passed[1:] >= value
        if reached.any():
            last = 1 + int(reached.argmax())
            end = self._radius_where(value, which, way[last - 1], way[last])
            way, passed = np.append(way[:last], end), np.append(passed[:last], value)
        excess = np.maximum.accumulate(passed) - passed
        return Moved(float(way[-1]), self._dissipated(way, excess, which))

    def _inwards(self, start: float, value: float, which: int) -> Moved:
        radii, loads = self.table[0], self.table[1 + which]
        way = np.append(start, radii[radii < start][::-1])
        passed = np.append(self._load_at(start, which), loads[radii < start][::-1])
        if not (passed <= value).any():  # between these radii the load may be less
            least = self._least(which, way, int(passed.argmin()))
            outside = way > least
            way = np.append(way[outside], least)
            passed = np.append(passed[outside], self._load_at(least, which))
        reached = passed <= value
        last = int(reached.argmax())
        comes_off = not reached[last]
        if reached[0]:
            return Moved(start)
        if not comes_off:
            end = self._radius_where(value, which, way[last], way[last - 1])
            way, passed = np.append(way[:last], end), np.append(passed[:last], value)
        least_so_far = np.minimum.accumulate(passed)
        dissipated = self._dissipated(way, least_so_far - passed, which)
        off = self._pull_off(way[passed <= least_so_far], comes_off)
        end = float(way[-1])
        if not comes_off:
            return Moved(end, dissipated, off)
        if which == _FORCE:  # where bodies go is not told; they are drawn apart by their depth
            dissipated += self._inwards(end, -np.inf, _DEPTH).dissipated
        else:
            dissipated += self.stored(end, self._load_at(end, _DEPTH))
        return Moved(0.0, dissipated, off)

    def _dissipated(self, way: Real, excess: Real, which: int) -> float:
        """Energy that the edge gives up where it jumps, as the load is beyond that of rest.

        At a depth d the energy of the contact changes by E* ((d - g)² - Delta l²) da. Under a force
        the depth is that of the radius.
        """
        if which == _FORCE:
            excess = excess / (2 * self.E_star * np.maximum(way, self.table[0][0]))
        lost = excess * (2 * self.elongation(way) - excess)
        return float(self.E_star * np.trapezoid(lost, way))

    def _pull_off(self, way: Real, comes_off: bool) -> tuple[float, float] | None:
        """Depth and force of the largest pull among radii at rest, unless it is at the end."""
        forces = self.at_rest(way)[_FORCE]
        last = int(forces.argmin())
        if self.work_of_adhesion == 0 or (last == way.size - 1 and not comes_off):
            return None
        at = self._least(_FORCE, way, last)
        return self._load_at(at, _DEPTH), self._load_at(at, _FORCE)

    def _load_at(self, radius: float, which: int) -> float:
        return float(self.at_rest(np.array([radius]))[which][0]) if radius else 0.0

    def _radius_where(self, value: float, which: int, low: float, high: float) -> float:
        """Radius at which the edge rests under a load, between two others."""
        from scipy.optimize import brentq  # here because it loads slowly

        def excess(radius: float) -> float:
            return self._load_at(radius, which) - value

        if excess(low) * excess(high) >= 0:  # one of them, but for rounding
            return min(low, high, key=lambda radius: abs(excess(radius)))
        precise = 4 * np.finfo(float).eps
        return float(brentq(excess, low, high, xtol=precise * high, rtol=precise))

    def _least(self, which: int, way: Real, near: int) -> float:
        """Radius at which a load is least, by radii along a way of which one is near it."""
        from scipy.optimize import minimize_scalar  # here because it loads slowly

        low, high = sorted((way[max(near - 1, 0)], way[min(near + 1, way.size - 1)]))
        found = float(way[near])
        if low < high:
            tried = minimize_scalar(
                lambda a: self._load_at(a, which),
                bounds=(low, high),
                method="bounded",
                options={"xatol": 1e-9 * high},
            )
            found = min(found, float(tried.x), key=lambda a: self._load_at(a, which))
        return found


def _slopes(r: Real, heights: Real) -> Real:
    """Slopes of f between the radii, constants and factors of r.

    A slope is that of the chord in the middle and changes as the slopes of chords do on that side
    where they change less. So convex bodies stay convex, and the line rises.
    """
    step, middle = np.diff(r), (r[1:] + r[:-1]) / 2
    chord = -np.diff(heights) / step
    change = np.zeros_like(chord)
    if chord.size > 1:
        bend = np.diff(chord) / np.diff(middle)
        before, after = np.append(bend[0], bend), np.append(bend, bend[-1])
        least = np.where(np.abs(before) < np.abs(after), before, after)
        change = np.where(before * after > 0, least, 0.0)
        change[0] = min(change[0], 2 * chord[0] / step[0])  # f does not fall from the axis
    return np.array([chord - change * middle, change])
