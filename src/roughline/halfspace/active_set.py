"""The contact problem p >= 0, gap >= 0, p gap = 0 under one load: primal-dual active set.

On the current set the pressures approach those of K p = d - s by conjugate gradients, until what
is wrong with the set (nodes that pull, nodes outside that overlap) outweighs what is wrong with the
pressures [4]_. Then the nodes that pull are dropped and those that overlap are added, and so on.
What is returned carries residuals recomputed from it in double precision.

References
----------
.. [1] M. Hintermüller, K. Ito and K. Kunisch, "The primal-dual active set strategy as a semismooth
   Newton method", SIAM J. Optim. 13, 865-888 (2003).
.. [2] I. A. Polonsky and L. M. Keer, "A numerical method for solving rough contact problems based
   on the multi-level multi-summation and conjugate gradient techniques", Wear 231, 206-219 (1999).
.. [3] J. J. Júdice and F. M. Pires, "A block principal pivoting algorithm for large-scale strictly
   monotone linear complementarity problems", Comput. Oper. Res. 21, 587-596 (1994).
.. [4] Z. Dostál and J. Schöberl, "Minimizing quadratic functions subject to bound constraints with
   the rate of convergence and finite termination", Comput. Optim. Appl. 30, 23-43 (2005): there,
   too, a set is changed when the violations outweigh the residual (proportioning).
"""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Mask
from roughline.halfspace.operator import Places
from roughline.halfspace.patch import ConjugateGradients, Patch, merged
from roughline.halfspace.state import (
    Contact,
    Load,
    Method,
    Nodes,
    Outcome,
    Problem,
    Residuals,
    Start,
    Vector,
)

# An inner solve aims below the tolerance so that the certificate is not missed by a hair.
_INNER_MARGIN = 0.3
# Single precision serves while errors are above this part of the depth; its own are 1e-7 of it.
_SINGLE_ABOVE = 1e-4
# Steps on one set before it is looked at again.
_STEPS = 200
# Rounds with no fewer wrong nodes than ever before, after which the equations are solved sharply
# before the set is changed; after twice as many, nodes change one by one [3]_.
_PATIENCE = 8
# Nodes whose gap is below so many times the error on contact may come into contact.
_WATCHED = 2.0


def solve(problem: Problem, load: Load, start: Start, method: Method) -> Contact:
    """Find the contact set and the pressures under one load.

    Parameters
    ----------
    problem : Problem
        The body and the half-space.
    load : Load
        What is prescribed.
    start : Start
        Where to start from.
    method : Method
        Tolerance, bound on the convolutions and precision.
    """
    search = _Search(problem, load, start, method)
    while True:
        search.assess()
        outcome = search.outcome() or search.improve()
        if outcome is not None:
            return Contact(
                search.depth,
                search.force,
                search.nodes,
                search.pressure,
                search.gap,
                search.residuals,
                outcome,
                search.convolutions,
            )


class _Search:
    """The current set and pressures, and what is wrong with them."""

    def __init__(self, problem: Problem, load: Load, start: Start, method: Method) -> None:
        self.nodes, self.pressure = start.nodes, start.pressure
        self.gap = np.empty(problem.separation.shape)
        self.convolutions = 0
        self._operator, self._approximation = problem.operator, problem.approximation
        self._separation, self._rms_height = problem.separation, problem.rms_height
        self._load = load
        self._method = method
        self._outer = self._inner = method.steps
        self._wrong, self._fewest_wrong, self._waited = self.gap.size, self.gap.size + 1, 0
        self._residual_before = np.inf

    def assess(self) -> None:
        """Compute the gap everywhere, and with it the residuals."""
        load, cell_area = self._load, self._operator.cell_area
        if load.force is not None:
            self.pressure = _with_total(self.pressure, load.force / cell_area)
        places = Places.of(self.nodes, self._operator.shape)
        gap = self._operator.convolve(self.pressure, places, None, self._outer, out=self.gap)
        if load.depth is not None and not self.convolutions:
            best = _best_factor(
                load.depth - self._separation.flat[self.nodes], self.pressure, gap.flat[self.nodes]
            )
            self.pressure = best * self.pressure
            gap *= best
        self.convolutions += 1
        gap += self._separation
        total = float(self.pressure.sum())
        if load.depth is None:  # the work of the pressures
            self.depth = float(self.pressure @ gap.flat[self.nodes]) / total
        else:
            self.depth = load.depth
        gap -= self.depth
        self.force = cell_area * total
        self._length_scale = abs(self.depth)
        if self._rms_height:
            self._length_scale = min(self._rms_height, self._length_scale)
        elif self._operator.is_periodic:  # even pressure on a flat surface moves nothing
            self._length_scale = 1.0
        self.residuals = Residuals.of(
            gap, self.nodes, self.pressure, self.force, load, self._length_scale
        )

    def outcome(self) -> Outcome | None:
        """Say whether the search is over, and how it ended."""
        spent = self.convolutions >= self._method.max_iterations
        if self._outer != self._method.certificate:
            if not spent:
                return None
            self._outer = self._method.certificate
            self.assess()
        worst = self.residuals.worst
        certified = worst <= self._method.rtol
        # the stiffness hangs on single nodes: go on for those that overlap more than others err
        if certified and (self.residuals.penetration == 0 or self._waited > _PATIENCE):
            return Outcome.CONVERGED
        if not np.isfinite(worst):
            return Outcome.STALLED
        if spent:
            return Outcome.CONVERGED if certified else Outcome.MAX_ITERATIONS
        if not self._wrong and worst > 0.5 * self._residual_before:
            if self._inner == self._method.certificate:
                return Outcome.CONVERGED if certified else Outcome.STALLED
            self._inner = self._method.certificate
        self._residual_before = worst
        return None

    def improve(self) -> Outcome | None:
        """Step towards the pressures of the current set, then exchange the wrong nodes.

        Returns the outcome if that cannot be done: a half-space is positive definite.
        """
        tolerance = _INNER_MARGIN * self._method.rtol * self._length_scale
        one_by_one = self._waited > 2 * _PATIENCE
        on_contact = self.gap.flat[self.nodes]
        watched = self._near(np.inf if one_by_one else _WATCHED * _rms(on_contact), one_by_one)
        try:
            patch = Patch(self._operator, self._approximation, self.nodes, watched)
        except np.linalg.LinAlgError:
            return Outcome.STALLED
        fixed_total = self._load.force is not None
        solution = ConjugateGradients(
            patch,
            self.pressure,
            -on_contact - (self.depth if fixed_total else 0.0),
            self.gap.flat[watched] + self.depth,
            fixed_total=fixed_total,
            precision=self._inner,
        )
        while True:
            level = solution.level if fixed_total else self.depth
            error = float(np.abs(solution.error).max())
            pulling = solution.pressure < 0
            overlapping = solution.watched < level
            if error <= tolerance or solution.steps >= _STEPS:
                break
            if self._waited <= _PATIENCE and solution.steps:
                pull = self._approximation.own * solution.pressure[pulling]
                overlap = solution.watched[overlapping] - level
                if pull @ pull + overlap @ overlap > solution.error @ solution.error:
                    break
            if (
                self.convolutions + solution.steps >= self._method.max_iterations
                or not solution.advance()
            ):
                break
        self.convolutions += solution.steps
        self.pressure = solution.pressure
        worst = max(error, -float(solution.pressure.min()) * self._approximation.own)
        rough = worst > max(_SINGLE_ABOVE * abs(level), self._method.rtol * self._length_scale)
        self._outer = self._method.steps if rough else self._method.certificate
        self._wrong = int(np.count_nonzero(pulling) + np.count_nonzero(overlapping))
        self._waited = 0 if self._wrong < self._fewest_wrong else self._waited + 1
        self._fewest_wrong = min(self._wrong, self._fewest_wrong)
        if one_by_one:
            _keep_last(self.nodes, pulling, watched, overlapping)
        self._exchange(pulling, watched[overlapping])
        return None

    def _near(self, reach: float, every: bool) -> Nodes:
        """Return the nodes off the contact with gaps below `reach`, at most as many as are on it.

        With `every`, all of them.
        """
        near = self.gap.ravel() < reach
        near[self.nodes] = False
        nodes = np.flatnonzero(near)
        if every or nodes.size <= self.nodes.size:
            return nodes
        gaps = self.gap.flat[nodes]
        return nodes[gaps <= np.partition(gaps, self.nodes.size)[self.nodes.size]]

    def _exchange(self, pulling: Mask, added: Nodes) -> None:
        """Drop nodes that pull and add others; the highest point stays if none does."""
        if pulling.any():
            self.nodes, self.pressure = self.nodes[~pulling], self.pressure[~pulling]
        if added.size:
            self.nodes, order = merged(self.nodes, added)
            self.pressure = np.append(self.pressure, np.zeros(added.size))[order]
        if not self.nodes.size:
            self.nodes = np.array([self._separation.argmin()])
            self.pressure = np.zeros(1)


def _keep_last(nodes: Nodes, pulling: Mask, watched: Nodes, overlapping: Mask) -> None:
    """Leave only the wrong node of highest index, the rule that cannot cycle."""
    last_pulling = nodes[pulling].max(initial=-1)
    last_overlapping = watched[overlapping].max(initial=-1)
    pulling &= (nodes == last_pulling) & (last_pulling > last_overlapping)
    overlapping &= (watched == last_overlapping) & (last_overlapping > last_pulling)


def _rms(values: Vector) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _with_total(pressure: Vector, total: float) -> Vector:
    """Scale the pressures to a total; spread it evenly where there is nothing to scale."""
    now = float(pressure.sum())
    if now > 0:
        return pressure * (total / now)
    return np.full_like(pressure, total / pressure.size)


def _best_factor(target: Vector, pressure: Vector, displacement: Vector) -> float:
    """Return the factor by which the pressures come closest to the target, in energy."""
    energy = float(pressure @ displacement)
    return max(float(pressure @ target) / energy, 0.0) if energy > 0 else 1.0
