"""The contact conditions that pressures and gaps obey, and their violations."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real


@dataclass(frozen=True)
class Residuals:
    """Violations of the contact conditions, recomputed from the returned pressures.

    Attributes
    ----------
    gap, penetration : float
        Largest gap on contact nodes and overlap off them, over the length scale.
    tension, excess : float
        Largest pull, and largest pressure above the hardness, over the mean contact pressure.
    load : float
        Error of the force, over the force; zero under depth control.
    rounding : float
        Spacing of floating-point numbers at the depth, over the length scale: smaller gaps are
        lost in it.
    """

    gap: float = 0.0
    penetration: float = 0.0
    tension: float = 0.0
    excess: float = 0.0
    load: float = 0.0
    rounding: float = 0.0

    @property
    def worst(self) -> float:
        """The largest of them."""
        return max(self.violation, self.rounding)

    @property
    def violation(self) -> float:
        """The largest of them but for the rounding."""
        return max(self.gap, self.penetration, self.tension, self.excess, self.load)

    @property
    def worst_is_of(self) -> str:
        """What the largest of them is of, in words."""
        named = {
            "the gap within the contact": self.gap,
            "the overlap outside the contact": self.penetration,
            "tension": self.tension,
            "pressure above the hardness": self.excess,
            "the force": self.load,
            "the rounding of the depth": self.rounding,
        }
        return max(named, key=lambda name: named[name])


@dataclass(frozen=True, eq=False)
class Violations:
    """Nodes that are on the wrong side of a set: of the contact, or of the nodes at the hardness.

    Attributes
    ----------
    pulling, yielding : ndarray of bool, shape (nodes,)
        Elastic nodes in contact whose pressure is negative, or above the hardness.
    lifting : ndarray of bool, shape (nodes,)
        Nodes at the hardness at which the bodies come apart.
    overlapping : ndarray of bool, shape (watched,)
        Nodes off the contact at which the bodies overlap.
    pull, excess : ndarray
        How far the pressures of the first two leave their bounds. [pressure]
    lift, overlap : ndarray
        Gaps at the last two. [length]
    """

    pulling: Mask
    yielding: Mask
    lifting: Mask
    overlapping: Mask
    pull: Real
    excess: Real
    lift: Real
    overlap: Real

    @property
    def count(self) -> int:
        """Number of wrong nodes."""
        return self.pull.size + self.excess.size + self.lift.size + self.overlap.size

    def squared(self, diagonal: float) -> float:
        """Sum of the squared violations. [length²]

        A pressure out of its bounds counts as the displacement that it causes at its own node, by
        the diagonal of the operator. [length / pressure]
        """
        pull, excess = diagonal * self.pull, diagonal * self.excess
        return float(
            pull @ pull + excess @ excess + self.lift @ self.lift + self.overlap @ self.overlap
        )


class ContactConditions(Protocol):
    """What pressures and gaps obey.

    All that the solver knows of the conditions is here, so that bodies with other conditions need
    another such class and not another solver.
    """

    @property
    def largest_pressure(self) -> float:
        """The most that a node bears. [pressure]"""

    def elastic(self, pressure: Real) -> Mask:
        """Return which nodes in contact are displaced with the other body.

        Their pressures follow a change of the load.
        """

    def projected(self, pressure: Real) -> Real:
        """Return the nearest pressures that the conditions allow."""

    def with_total(self, pressure: Real, total: float) -> Real:
        """Return pressures of a given sum, scaled as far as they are not bounded. [pressure]"""


@dataclass(frozen=True)
class UnilateralContact:
    """Bodies that neither stick to each other nor overlap: p >= 0, gap >= 0 and p gap = 0."""

    @property
    def largest_pressure(self) -> float:
        """Elastic bodies bear any pressure."""
        return math.inf

    def elastic(self, pressure: Real) -> Mask:
        """Return that every node in contact follows a change of the load."""
        return np.ones(pressure.size, dtype=bool)

    def projected(self, pressure: Real) -> Real:
        """Return the nearest pressures that do not pull."""
        return np.maximum(pressure, 0.0)

    def with_total(self, pressure: Real, total: float) -> Real:
        """Scale the pressures to a total; spread it evenly where there is nothing to scale."""
        now = float(pressure.sum())
        if now > 0:
            return pressure * (total / now)
        return np.full_like(pressure, total / pressure.size)


@dataclass(frozen=True)
class YieldingContact:
    """Elastic, perfectly plastic bodies: 0 <= p <= H, with permanent dents where p = H [1]_.

    Where p = 0 the gap is not negative, and where 0 < p < H it is zero. Where p = H the bodies
    overlap by what the load indents, and the surface is lower by that ever after. A node is at the
    hardness if its pressure is H exactly.

    Attributes
    ----------
    hardness : float
        The most that a node bears, H. [pressure]

    References
    ----------
    .. [1] A. Almqvist, F. Sahlin, R. Larsson and S. Glavatskih, "On the dry elasto-plastic contact
       of nominally flat surfaces", Tribol. Int. 40, 574-579 (2007).
    """

    hardness: float

    @property
    def largest_pressure(self) -> float:
        """The hardness."""
        return self.hardness

    def elastic(self, pressure: Real) -> Mask:
        """Return which nodes are below the hardness; those at it bear no more."""
        return pressure < self.hardness

    def projected(self, pressure: Real) -> Real:
        """Return the nearest pressures from zero to the hardness."""
        return np.clip(pressure, 0.0, self.hardness)

    def with_total(self, pressure: Real, total: float) -> Real:
        """Change the pressures below the hardness so that all of them sum to a total.

        They are scaled down, or moved up by the same part of what each has left to the hardness,
        so none reaches it. Where the nodes at the hardness alone would carry too much, all are
        scaled down.
        """
        pressure = np.minimum(pressure, self.hardness)
        elastic = pressure < self.hardness
        rest = total - self.hardness * np.count_nonzero(~elastic)
        now = float(pressure[elastic].sum())
        if rest < 0:
            return pressure * (total / float(pressure.sum()))
        if rest <= now:
            pressure[elastic] *= rest / now if now else 1.0
        else:
            left = self.hardness - pressure[elastic]
            pressure[elastic] += left * min((rest - now) / float(left.sum()), 1.0)
        return pressure


def violations(
    conditions: ContactConditions,
    elastic: Mask,
    pressure: Real,
    watched: Real,
    held: Real,
    depth: float,
    slack: float,
) -> Violations:
    """Find the nodes that are on the wrong side of a set.

    Parameters
    ----------
    conditions : ContactConditions
        What pressures and gaps obey.
    elastic : ndarray of bool, shape (nodes,)
        Which nodes in contact are elastic.
    pressure : ndarray, shape (elastic nodes,)
        Pressures on these. [pressure]
    watched : ndarray, shape (watched,)
        Gap plus depth at the watched nodes off the contact. [length]
    held : ndarray, shape (nodes that are not elastic,)
        Gap plus depth at the nodes at the hardness, negative gaps being overlaps. [length]
    depth : float
        Approach since first touch. [length]
    slack : float
        Gap up to which a node stays at the hardness. [length]
    """
    most = conditions.largest_pressure
    negative, over, overlapping = pressure < 0, pressure > most, watched < depth
    apart = held > depth + slack
    pulling, yielding, lifting = np.zeros((3, elastic.size), dtype=bool)
    pulling[elastic], yielding[elastic], lifting[~elastic] = negative, over, apart
    return Violations(
        pulling,
        yielding,
        lifting,
        overlapping,
        pull=pressure[negative],
        excess=pressure[over] - most,
        lift=held[apart] - depth,
        overlap=watched[overlapping] - depth,
    )


def out_of_bounds(conditions: ContactConditions, pressure: Real) -> tuple[float, float]:
    """Return the largest pull, and the largest pressure above the hardness. [pressure]"""
    if not pressure.size:
        return 0.0, 0.0
    over = float(pressure.max()) - conditions.largest_pressure
    return max(0.0, -float(pressure.min())), max(0.0, over)


def residuals(
    conditions: ContactConditions,
    gap: Real,
    nodes: Indices,
    pressure: Real,
    length_scale: float,
    load_error: float,
    approach: float = 0.0,
) -> Residuals:
    """Compute the residuals of a contact.

    Parameters
    ----------
    conditions : ContactConditions
        What pressures and gaps obey.
    gap : ndarray, shape (nx, ny)
        On the whole grid, on the surface as it is indented. [length]
    nodes : ndarray of int
        Nodes in contact.
    pressure : ndarray, shape (nodes,)
        Pressures on them. [pressure]
    length_scale : float
        Gaps are compared with this. [length]
    load_error : float
        Error of the force, over the force.
    approach : float
        From which gaps are counted; smaller ones are lost in its rounding. [length]
    """
    on_contact = gap.flat[nodes]
    # gaps on contact count as such whatever their sign, so they may stay in the minimum
    overlap_everywhere = max(0.0, -float(gap.min()))
    overlap_on_contact = max(0.0, -float(on_contact.min()))
    penetration = overlap_everywhere if overlap_everywhere > overlap_on_contact else 0.0
    pull, excess = out_of_bounds(conditions, pressure)
    scale = abs(float(pressure.mean()))
    return Residuals(
        gap=float(np.abs(on_contact).max()) / length_scale,
        penetration=penetration / length_scale,
        tension=pull / scale if pull else 0.0,
        excess=excess / scale if excess else 0.0,
        load=load_error,
        rounding=float(np.spacing(abs(approach))) / length_scale,
    )
