"""The contact conditions: what pressures and gaps obey, and where they violate it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real


@dataclass(frozen=True)
class Residuals:
    """Violations of the contact conditions, recomputed from the returned pressures.

    Attributes
    ----------
    gap, penetration : float
        Largest gap on contact nodes and overlap off them, over the length scale.
    tension : float
        Largest pull, over the mean contact pressure.
    load : float
        Error of the force, over the force; zero under depth control.
    """

    gap: float
    penetration: float
    tension: float
    load: float

    @property
    def worst(self) -> float:
        """The largest of the four."""
        return max(self.gap, self.penetration, self.tension, self.load)


@dataclass(frozen=True, eq=False)
class Violations:
    """Nodes that are on the wrong side of the contact set.

    Attributes
    ----------
    pulling : ndarray of bool, shape (nodes,)
        Nodes in contact on which the pressure is negative.
    pull : ndarray
        Pressures on them. [pressure]
    overlapping : ndarray of bool, shape (watched,)
        Nodes off the contact at which the bodies overlap.
    overlap : ndarray
        Gaps there. [length]
    """

    pulling: Mask
    pull: Real
    overlapping: Mask
    overlap: Real

    @property
    def count(self) -> int:
        """Number of wrong nodes."""
        return self.pull.size + self.overlap.size

    def squared(self, diagonal: float) -> float:
        """Sum of the squared violations. [length²]

        A pull counts as the displacement that it causes at its own node, by the diagonal of the
        operator. [length / pressure]
        """
        pull = diagonal * self.pull
        return float(pull @ pull + self.overlap @ self.overlap)


@dataclass(frozen=True)
class UnilateralContact:
    """Bodies that neither stick to each other nor overlap: p >= 0, gap >= 0 and p gap = 0.

    All that the solver knows of the conditions is here, so that bodies with other conditions, such
    as a largest pressure that they bear, need another such class and not another solver.
    """

    def projected(self, pressure: Real) -> Real:
        """Return the nearest pressures that the conditions allow."""
        return np.maximum(pressure, 0.0)

    def elastic(self, pressure: Real) -> Mask | slice:
        """Return which nodes in contact are displaced with the other body: here all of them.

        Their pressures follow a change of the load.
        """
        return slice(None)

    def largest_pull(self, pressure: Real) -> float:
        """Return how far the pressures leave their bounds, at most. [pressure]"""
        return max(0.0, -float(pressure.min()))

    def violations(self, pressure: Real, watched: Real, depth: float) -> Violations:
        """Find the nodes that are on the wrong side of the contact set.

        Parameters
        ----------
        pressure : ndarray, shape (nodes,)
            Pressures on the nodes in contact. [pressure]
        watched : ndarray, shape (watched,)
            Gap plus depth at the watched nodes off the contact. [length]
        depth : float
            Approach since first touch. [length]
        """
        pulling = pressure < 0
        overlapping = watched < depth
        return Violations(pulling, pressure[pulling], overlapping, watched[overlapping] - depth)

    def residuals(
        self, gap: Real, nodes: Indices, pressure: Real, length_scale: float, load_error: float
    ) -> Residuals:
        """Compute the residuals of a contact.

        Parameters
        ----------
        gap : ndarray, shape (nx, ny)
            On the whole grid. [length]
        nodes : ndarray of int
            Nodes in contact.
        pressure : ndarray, shape (nodes,)
            Pressures on them. [pressure]
        length_scale : float
            Gaps are compared with this. [length]
        load_error : float
            Error of the force, over the force.
        """
        on_contact = gap.flat[nodes]
        # gaps on contact count as such whatever their sign, so they may stay in the minimum
        overlap_everywhere = max(0.0, -float(gap.min()))
        overlap_on_contact = max(0.0, -float(on_contact.min()))
        penetration = overlap_everywhere if overlap_everywhere > overlap_on_contact else 0.0
        pull = self.largest_pull(pressure)
        return Residuals(
            gap=float(np.abs(on_contact).max()) / length_scale,
            penetration=penetration / length_scale,
            tension=pull / abs(float(pressure.mean())) if pull else 0.0,
            load=load_error,
        )
