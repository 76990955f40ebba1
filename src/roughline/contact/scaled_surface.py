"""A surface in the units in which its contact is solved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.loads import Loads
from roughline.errors import InputError
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.pulling_zone import farthest_pulled
from roughline.topography.body import Surface

_SCALING_TOLERANCE = 1e-6  # part by which what is scaled may differ


@dataclass(frozen=True, eq=False)
class ScaledSurface:
    """A surface in units in which E* is 1, a cell has unit area and the roughness unit rms.

    The problem is solved in these units, so that no scale is too small or too large for it.
    """

    surface: Surface  # untouched
    height: float  # units of lengths across and along the surface
    length: float
    E_star: float  # unit of pressures where both lengths are equal
    spacing: tuple[float, float]  # sides of a cell over the unit of lengths along the surface
    half_space: HalfSpace  # in units of this modulus and of lengths along the surface

    @classmethod
    def of(cls, surface: Surface, half_space: HalfSpace, loads: Loads) -> ScaledSurface:
        """Choose the units."""
        height = surface.rms_height
        if height == 0:  # a flat punch has no heights: its depth, at least roughly, gives the unit
            height = float(np.abs(loads.values).max()) or surface.length
            if loads.control == "forces":
                height /= half_space.E_star * surface.length
        dx, dy = surface.spacing
        length = float(np.sqrt(dx) * np.sqrt(dy))
        scaled = half_space.in_units(half_space.E_star, length)
        _refuse_other_half_space(half_space, scaled, length, max(surface.sizes) / length)
        return cls(surface, height, length, half_space.E_star, (dx / length, dy / length), scaled)

    def separation(self) -> Real:
        """Return the distance of the bodies at first touch over `height`. [1]"""
        heights = self.surface.heights
        distances = np.subtract(heights.max(), heights, order="C")
        distances /= self.height
        return distances

    def law(self, law: ContactLaw) -> ContactLaw:
        """Return a law in units of `pressure` and `height`; refuse one that gives another there."""
        scaled = law.scaled(self.pressure, self.height)
        _refuse_other_law(law, scaled, self.pressure, self.height)
        return scaled

    @property
    def force(self) -> float:
        """Unit of forces. [force]"""
        return self.E_star * self.height * self.length

    @property
    def pressure(self) -> float:
        """Unit of pressures. [pressure]"""
        return self.E_star * self.height / self.length

    @property
    def cell_area(self) -> float:
        """Area of one cell. [length²]"""
        return self.spacing[0] * self.spacing[1] * self.length**2


def _refuse_other_half_space(
    half_space: HalfSpace, scaled: HalfSpace, length: float, side: float
) -> None:
    """Refuse units in which waves as long as the surface, or as two cells, move otherwise."""
    q = np.array([2 * np.pi / side, np.pi])
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        moved = half_space.spectrum(q / length) * (half_space.E_star / length)
    there, computed = scaled.spectrum(q), np.isfinite(moved) & (moved > 0)  # in these units, too
    if computed.all() and not (abs(there - moved) <= _SCALING_TOLERANCE * moved).all():
        worst = int(np.abs(there / moved - 1).argmax())
        raise InputError(
            f"{type(half_space).__name__}.in_units({half_space.E_star:g}, {length:g}) displaces a "
            f"wave by {there[worst] / moved[worst]:g} of what it should: pressures are to be "
            "divided by the first number, and all lengths of the body by the second"
        )


def _refuse_other_law(law: ContactLaw, scaled: ContactLaw, pressure: float, length: float) -> None:
    """Refuse a law whose bounds, pull or reach are other ones in these units."""
    low, high = law.bounds(None)
    if np.any(np.asarray(low) > high) or np.any(np.asarray(low) > 0):
        raise InputError(
            f"has a method {type(law).__name__}.bounds that returns a lower bound above the upper "
            "one, or above zero: the lower one comes first, and is zero or negative",
            "law",
        )
    if not law.only_pushes:
        _refuse_other_pull(law)
    low_there, high_there = scaled.bounds(None)
    for what, given, there, unit in (
        ("a lower bound", low, low_there, pressure),
        ("an upper bound", high, high_there, pressure),
        ("the reach", farthest_pulled(law), farthest_pulled(scaled), length),
    ):
        if isinstance(given, float) and given == there * unit:
            continue  # as most are, infinite ones among them
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            found, right = np.broadcast_arrays(there, np.asarray(given) / unit)
        if (
            other := ~np.isclose(found, right, rtol=_SCALING_TOLERANCE, atol=0, equal_nan=True)
        ).any():
            raise InputError(
                f"has a method {type(law).__name__}.scaled({pressure:g}, {length:g}) that makes "
                f"{what} {found[other][0]:g} where {right[other][0]:g} is right: pressures are to "
                "be divided by the first number, and lengths by the second",
                "law",
            )


def _refuse_other_pull(law: ContactLaw) -> None:
    """Refuse a law that pulls and yields, or whose shares, gaps and work do not go together."""
    name = type(law).__name__
    if np.any(np.less(law.bounds(None)[1], np.inf)):
        raise InputError(
            f"is {name}, whose bounds both pull and yield: a contact leaves dents or remembers its "
            "path, not both; give an infinite upper bound, or a lower one of zero",
            "law",
        )
    ends = np.isfinite(law.cutoff)
    gaps = np.linspace(0, law.cutoff if ends else float(law.gap_at(np.array([0.01]))[0]), 9)
    shares, work = law.share_at(gaps), law.work_beyond(gaps)
    opened, steps = work[:-1] - work[1:], np.diff(gaps)
    slack = _SCALING_TOLERANCE * gaps[-1]
    for wrong, what in (
        (shares[0] != 1, f"share_at that is {shares[0]:g} at a gap of zero: it is one there"),
        (not gaps[-1] > 0, "gap_at that gives no gaps: they are positive where less is borne"),
        (np.any(np.diff(shares) > 0) or np.any(shares < 0), "share_at that rises, or is negative"),
        (
            not np.allclose(
                law.share_at(law.gap_at(shares)),
                shares,
                rtol=_SCALING_TOLERANCE,
                atol=_SCALING_TOLERANCE,
            ),
            "gap_at that is not the inverse of its share_at",
        ),
        (
            np.any(opened > shares[:-1] * steps + slack)
            or np.any(opened < shares[1:] * steps - slack),
            "work_beyond that is not the integral of its share_at over larger gaps",
        ),
    ):
        if wrong:
            raise InputError(f"has a method {name}.{what}", "law")
