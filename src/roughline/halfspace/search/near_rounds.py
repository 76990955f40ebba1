"""The contact of bodies that pull each other, by looks at all of it and rounds near it.

Each look computes, with the exact operator, the gap that pressures and pulls leave. Then shares of
the pull and gaps are led to each other near the contact, with an operator that is restricted to it
and exact for the pressures so far. Such rounds leave about 1/500 of the error. Where hardly
anything is pulled, shares follow the gap from look to look.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import InGrid, InRegion, among
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.pulling_zone import farthest_pulled, pulled_length
from roughline.halfspace.operators.grid_nodes import Precision
from roughline.halfspace.search.active_set import TOLERANCE_AIM, Foreseen, Search
from roughline.halfspace.search.carriers import Carriers
from roughline.halfspace.search.problem import (
    SINGLE_ABOVE,
    Contact,
    ContactSet,
    Load,
    Method,
    Outcome,
    Problem,
)
from roughline.halfspace.search.pull import Shares
from roughline.halfspace.search.region import REACH_OF_ERROR, Region, Trial
from roughline.halfspace.search.rounds import Rounds

_RESIDUAL_GAIN = 2e-3  # by rounds near the contact, about
# Looks in a row that may leave more than half of the residual of the one before: where bodies jump
# together, others come within reach.
_MOST_SLOW_LOOKS = 2
# Nodes that bear less than a part of the largest pull follow from look to look, if they do so at a
# gap that is less by a part of the range, too. It is the first part that leaves few enough nodes.
_LEAST_SHARES_NEAR, _MARGIN, _FEW_NODES = (3e-3, 3e-2, 0.1, 0.3), 0.2, 0.12
# Points of a grid on which rounds with the exact operator take less. There nearly all nodes are
# near, and steps that go far have left the branch that slow bodies follow.
_FEW_POINTS = 2**12
_MOST_ROUNDS, _MOST_PRODUCTS = 40, 200  # between two looks, and in a round
# Part of the misfit of shares to which their contact is solved, and the largest such tolerance.
_MISFIT_SHARE, _LARGEST_TOLERANCE = 0.3, 0.05


@dataclass(frozen=True, eq=False)
class _Look:
    """A trial on all of the grid, and the shares that its gap leaves."""

    trial: Trial
    followed: Shares
    misfit: float  # of the shares that it was computed with, over the length scale

    @property
    def worst(self) -> float:
        """The largest of the residuals and the misfit."""
        return max(self.trial.residuals.worst, self.misfit)


@dataclass(frozen=True, eq=False)
class _Surroundings:
    """The nodes near the contact of a look, and what that found there."""

    nodes: InGrid
    region: Region
    load: Load  # on these nodes
    touching: Carriers
    followed: Shares  # of all nodes
    worst: float
    length_scale: float  # with which gaps are compared [length]


class NearRounds:
    """The search for the shares of a pull, the contact set and the pressures under one load.

    It starts from a contact set, and keeps where it is in the problem and the start.
    """

    def __init__(
        self, problem: Problem, load: Load, start: ContactSet | None, method: Method
    ) -> None:
        self.problem = problem
        self.start = start
        self.convolutions = 0
        self._load = load
        self._method = method
        self._serves = start is not None and problem.separation.size > _FEW_POINTS
        self._slow_looks = 0
        self._worst = self._aim = np.inf  # of the last look, and for rounds after it

    def contact(self) -> Contact | None:
        """Return the certified contact; None where rounds near the contact do not lead to it."""
        found = None
        while found is None and self._serves and self.convolutions < self._method.max_iterations:
            found = self._after_a_look()
        return found

    def _after_a_look(self) -> Contact | None:
        """Look, and return the contact if it is certified; else go on near it."""
        # 1. Look at the gap, and at the shares that it leaves.
        method, rough = self._method, self._aim > SINGLE_ABOVE
        look = self._look(method.steps if rough else method.certificate)
        fits = not rough and look.misfit <= method.rtol
        if fits and look.trial.certified(method.rtol):
            contact = look.trial.contact(Outcome.CONVERGED, self.convolutions)
            return replace(contact, residuals=replace(contact.residuals, misfit=look.misfit))
        self._slow_looks = 0 if look.worst < 0.5 * self._worst else self._slow_looks + 1
        self._worst = look.worst
        self._aim = max(_RESIDUAL_GAIN * look.worst, TOLERANCE_AIM * method.rtol)
        # 2. Lead shares and gaps to each other near the contact.
        surroundings = self._surroundings(look)
        del look  # none is held until the next
        self._serves = self._slow_looks <= _MOST_SLOW_LOOKS and self._lead(surroundings)
        return None

    def _look(self, precision: Precision) -> _Look:
        """Look at the gap on all of the grid."""
        region = Region.everywhere(replace(self.problem))  # which alone holds bounds of all nodes
        assert self.start is not None
        touching = Carriers(InRegion(self.start.nodes), self.start.pressure)
        self.convolutions += 1
        trial = region.trial(self._load, region.bearing(touching), precision)
        followed, gap_change = self.problem.pull.followed_everywhere(trial.gap, self.problem.shares)
        return _Look(trial, followed, gap_change / trial.length_scale)

    def _surroundings(self, look: _Look) -> _Surroundings:
        """Return the surroundings of the contact of a look."""
        for least in _LEAST_SHARES_NEAR:
            nodes = self._pulled_more_than(least, look)
            if nodes.size <= _FEW_NODES * look.trial.gap.size:
                break
        near = look.trial.region.around(look.trial, nodes)
        return _Surroundings(nodes, *near, look.followed, look.worst, look.trial.length_scale)

    def _lead(self, near: _Surroundings) -> bool:
        """Lead shares and gaps to each other near the contact; return whether that serves."""
        problem, nodes, region, touching = self.problem, near.nodes, near.region, near.touching
        problem.operator.workspace.rest()
        misfit, depth = near.worst, self._load.depth
        pulled = Bounds.of(problem.law, nodes)
        rounds = Rounds(problem.pull.knowing(nodes), Shares(nodes, problem.shares.at(nodes)))
        for _ in range(_MOST_ROUNDS):
            tolerance = min(
                max(_MISFIT_SHARE * misfit, TOLERANCE_AIM * self._aim), _LARGEST_TOLERANCE
            )
            bounds = Bounds(pulled.low * rounds.shares.at(nodes), pulled.high)
            region = replace(region, bounds=bounds)
            found = self._foreseen(region, touching, near.load, tolerance)
            if found is None:
                return False
            touching, depth = region.touching_among(found.carriers), found.depth
            following = rounds.then(found.gap, nodes)
            misfit = following.misfit / near.length_scale
            if max(misfit, found.error) <= self._aim:
                break
            rounds = following
        shares = near.followed.but(nodes, rounds.shares.at(nodes))
        self.problem = replace(problem, shares=shares)
        self.start = ContactSet(among(nodes, touching.places), touching.pressure, depth)
        return True

    def _pulled_more_than(self, least: float, look: _Look) -> InGrid:
        """Return the nodes that touch, or bear more than a part of the largest pull, or may."""
        trial, problem = look.trial, self.problem
        margin = _MARGIN * pulled_length(problem.law)
        margin = min(REACH_OF_ERROR * look.worst * trial.length_scale, margin)
        is_near = trial.gap < farthest_pulled(problem.law, least) + margin
        nodes = InGrid(np.flatnonzero(is_near))
        is_near[nodes] = problem.pull.shares_at(trial.gap[nodes] - margin, nodes) > least
        taken = problem.shares
        is_near[among(taken.nodes, taken.values > least)] = True
        is_near[trial.carriers.places[trial.touching]] = True
        return InGrid(np.flatnonzero(is_near))

    def _foreseen(
        self, region: Region, touching: Carriers, load: Load, tolerance: float
    ) -> Foreseen | None:
        """Solve the contact near it with the pulls of its bounds, to a tolerance."""
        method = Method(tolerance, _MOST_PRODUCTS, "float32")
        search = Search(region, region.bearing(touching), load, method)
        found = search.foreseen()
        if region.operator.linear is region.operator.exact:
            self.convolutions += search.products
        return found
