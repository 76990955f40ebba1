"""The shear on nodes in contact, each within a disc: Newton's method on the discs.

A node that sticks is displaced as its target says, and its shear is within its disc. One that slips
has its shear on the rim of its disc, in the direction in which the target runs ahead of it. With q
the shear, A the half-space and w = target + level - A q the slip, that is q = Pi(q + w / m) for any
m > 0 [1]_, where Pi projects onto the discs. Its residual, times m, is a length. A node may have a
spring of its own beside the half-space, which displaces it by as much more as it bears more.

Unknowns are two numbers at a node that sticks and one, the turn along the rim, at a node that
slips. On fixed sets Newton's equations (P A P + lambda) y = P w are positive definite: P takes what
lies along the rim, and the radius w q / g² of the slip resists a turn. They are solved by conjugate
gradients, in which the slip is as stiff as it is, (1 + lambda / m)^-1/2 on both sides; lambda holds
the springs, too.

References
----------
.. [1] P. Alart and A. Curnier, "A mixed formulation for frictional contact problems prone to Newton
   like solution methods", Comput. Methods Appl. Mech. Eng. 92, 353-375 (1991).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.halfspace.friction.vectors import followed, inner, largest_excess, within

_MOST_ROUNDS = 60
_MOST_STEPS = 300  # of conjugate gradients in a round
_STEP_SHARE = 0.1  # of what is wrong with the sets, to which a round is solved
_TOLERANCE_SHARE = 0.3  # of the tolerance, to which equations are solved at most

Linear = Callable[[Real], Real]
"""A linear map of vectors on nodes, shape (nodes, 2)."""


@dataclass(frozen=True, eq=False)
class Sheared:
    """Shear on nodes, and what it leaves of the conditions."""

    shear: Real  # shape (nodes, 2) [pressure]
    level: Real  # shape (2,): what is added to all targets [length]
    slip: Real  # shape (nodes, 2) [length]
    displacement: Real  # shape (nodes, 2), by the operator that was searched with [length]
    residual: float  # largest of the nodes [length]
    missing: float  # of the total [pressure]
    rounds: int = 0
    products: int = 0  # with the operator


@dataclass(frozen=True, eq=False)
class Discs:
    """What is asked of the shear on nodes."""

    bound: Real  # shape (nodes,): radii of the discs [pressure]
    target: Real  # shape (nodes, 2) [length]
    total: Real | None  # sum of the shear, shape (2,); None: the targets are what they are
    diagonal: float  # m, displacement of a node by shear on itself [length / pressure]
    springs: Real  # shape (nodes,): of each node beside the half-space [length / pressure]

    def judged(self, shear: Real, level: Real, displacement: Real) -> Sheared:
        """Return shear with its slip, and how far both are from the conditions."""
        slip = self.target + level - displacement - self.springs[:, np.newaxis] * shear
        off = shear - within(shear + slip / self.diagonal, self.bound)
        residual = self.diagonal * float(np.hypot(off[:, 0], off[:, 1]).max(initial=0.0))
        missing = 0.0
        if self.total is not None:
            missing = float(np.abs(self.total - shear.sum(axis=0)).max())
        return Sheared(shear, level, slip, displacement, residual, missing)


@dataclass(frozen=True, eq=False)
class DiscSearch:
    """Newton's method with an operator and an approximate inverse of it.

    Of a rough operator there may be some shear whose displacement is known exactly.
    """

    operator: Linear
    inverse: Linear
    known: tuple[Real, Real] | None = None

    def displacement(self, shear: Real) -> Real:
        """Return the displacement by shear, exactly for the one that is known."""
        if self.known is None:
            return self.operator(shear)
        before, moved = self.known
        return moved + self.operator(shear - before)

    def found(
        self,
        discs: Discs,
        start: tuple[Real, Real],
        *,
        tolerance: float,
        share: float,
        gain: float = 0.0,
    ) -> Sheared:
        """Return the shear on the discs, from a shear and a level.

        It is within the tolerance [length], and its total within a share of the sum of all bounds,
        or within that part of what the start leaves of each; or it is the best that was found.
        """
        shear, level = within(start[0], discs.bound), start[1]
        slips = np.hypot(shear[:, 0], shear[:, 1]) >= discs.bound * (1 - 1e-12)
        enough, products = share * float(discs.bound.sum()), 0
        best: Sheared | None = None
        for rounds in range(_MOST_ROUNDS):
            products += 1
            now = discs.judged(shear, level, self.displacement(shear))
            now = replace(now, rounds=rounds, products=products)
            if not rounds:
                tolerance = max(tolerance, gain * now.residual)
                enough = max(enough, gain * now.missing)
            if best is None or max(now.residual / tolerance, now.missing / enough) < max(
                best.residual / tolerance, best.missing / enough
            ):
                best = now
            if now.residual <= tolerance and now.missing <= enough:
                return now
            outward = np.einsum("ij,ij->i", now.slip, shear)
            slips &= outward >= 0
            step = _Round.of(self, discs, now, slips)
            change, rise = step.solved(tolerance)
            products += step.products
            shear, level = shear + change, level + rise
            size = np.hypot(shear[:, 0], shear[:, 1])
            slips |= size > discs.bound
            nonzero = slips & (size > 0)
            shear[nonzero] *= (discs.bound[nonzero] / size[nonzero])[:, np.newaxis]
        assert best is not None
        return replace(best, rounds=_MOST_ROUNDS, products=products)


class _Round:
    """Newton's equations on fixed sets of nodes that stick and slip."""

    def __init__(
        self, search: DiscSearch, discs: Discs, now: Sheared, slips: Mask, rim: Real, curve: Real
    ) -> None:
        self._search, self._discs, self._now = search, discs, now
        self._slips, self._rim = slips, rim
        self._curve = (curve + discs.springs)[:, np.newaxis]  # lambda [length / pressure]
        self._scale = 1 / np.sqrt(1 + self._curve / discs.diagonal)
        self.products = 0

    @classmethod
    def of(cls, search: DiscSearch, discs: Discs, now: Sheared, slips: Mask) -> _Round:
        """Take the directions along the rims, and the radii of the slip."""
        rim, curve = np.zeros_like(now.shear), np.zeros(slips.size)
        bound = np.maximum(discs.bound[slips], 1e-300)
        outward = now.shear[slips] / bound[:, np.newaxis]
        rim[slips, 0], rim[slips, 1] = -outward[:, 1], outward[:, 0]
        curve[slips] = np.einsum("ij,ij->i", now.slip[slips], outward) / bound
        return cls(search, discs, now, slips, rim, np.maximum(curve, 0.0))

    def _allowed(self, vectors: Real) -> Real:
        """Return what of vectors nodes can follow: that along the rim where they slip."""
        return followed(vectors, self._slips, self._rim)

    def _product(self, vectors: Real) -> Real:
        self.products += 1
        return self._allowed(self._search.operator(vectors)) + self._curve * vectors

    def _preconditioned(self, residual: Real) -> Real:
        return self._scale * self._allowed(self._search.inverse(self._scale * residual))

    def solved(self, tolerance: float) -> tuple[Real, Real]:
        """Return the change of the shear and that of the level."""
        total, residual = self._discs.total, self._allowed(self._now.slip)
        rise, change, largest = np.zeros(2), np.zeros_like(residual), 0.0
        held = None if total is None else _HeldTotal.of(self._allowed, self._preconditioned, self)
        if held is not None and total is not None:
            change = held.moved_by(total - self._now.shear.sum(axis=0))
            if change.any():
                residual = residual - self._product(change)
        direction, before = np.zeros_like(residual), 0.0
        for _ in range(_MOST_STEPS):
            step = self._preconditioned(residual)
            if held is not None:
                lift = held.lift(step)
                step, residual = step + held.steps(lift), residual + held.even(lift)
                rise += lift
            energy = inner(residual, step)
            largest = float(np.abs(residual).max(initial=0.0))
            wrong = self._wrong(change)
            if largest <= max(_TOLERANCE_SHARE * tolerance, _STEP_SHARE * wrong) or not energy > 0:
                break
            direction = step + (energy / before if before > 0 else 0.0) * direction
            before, response = energy, self._product(direction)
            curvature = inner(direction, response)
            if not curvature > 0:
                break
            change = change + energy / curvature * direction
            residual = residual - energy / curvature * response
        return change, rise

    def _wrong(self, change: Real) -> float:
        """Return how far a change takes nodes out of the sets, as a length."""
        # also what a turn along the tangent leaves the rim by
        excess = largest_excess(self._now.shear, change, self._discs.bound)
        return self._discs.diagonal * excess


@dataclass(frozen=True, eq=False)
class _HeldTotal:
    """The condition that steps leave the total as it is, whose multiplier is the level."""

    ones: tuple[Real, Real]  # an even displacement along x and along y, as nodes can follow it
    preconditioned: tuple[Real, Real]
    inverse: Real  # of the matrix between both

    @classmethod
    def of(cls, allowed: Linear, preconditioned: Linear, round_: _Round) -> _HeldTotal:
        """Precondition both even displacements."""
        zeros = np.zeros_like(round_._rim)
        ones = tuple(zeros + axis for axis in np.eye(2))
        along = allowed(ones[0]), allowed(ones[1])
        steps = preconditioned(along[0]), preconditioned(along[1])
        matrix = np.array([[inner(a, b) for b in steps] for a in along])
        return cls(along, steps, np.linalg.pinv((matrix + matrix.T) / 2, rcond=1e-14))

    def lift(self, step: Real) -> Real:
        """Return the rise of the level after which a preconditioned step keeps the total."""
        return -self.inverse @ np.array([inner(each, step) for each in self.ones])

    def steps(self, lift: Real) -> Real:
        """Return what a rise of the level adds to the preconditioned step."""
        return lift[0] * self.preconditioned[0] + lift[1] * self.preconditioned[1]

    def even(self, lift: Real) -> Real:
        """Return what a rise of the level adds to the residual."""
        return lift[0] * self.ones[0] + lift[1] * self.ones[1]

    def moved_by(self, missing: Real) -> Real:
        """Return a change of the shear by so much in total."""
        return self.steps(self.inverse @ missing)
