"""The contact among the nodes of a region, by a primal-dual active set.

Each round has four steps.

1. The gap under the trial pressures is computed, and with it the residuals.
2. The search ends if the residuals are within the tolerance, or no longer fall.
3. Conjugate gradients lead the pressures of touching nodes towards those that close the gap there,
   until the error of the sets of nodes outweighs the error of the pressures [3]_.
4. Nodes beyond a bound of the pressure are set to it, nodes at a bound touch where the gap has the
   wrong sign, and nodes without pressure join where bodies overlap. All are chosen from the same
   pressures [1]_.

Polonsky and Keer's method [2]_ corrects the set after every step of conjugate gradients; here it
is corrected only after as many steps as are worth their cost.

References
----------
.. [1] M. Hintermüller, K. Ito and K. Kunisch, "The primal-dual active set strategy as a semismooth
   Newton method", SIAM J. Optim. 13, 865-888 (2003).
.. [2] I. A. Polonsky and L. M. Keer, "A numerical method for solving rough contact problems based
   on the multi-level multi-summation and conjugate gradient techniques", Wear 231, 206-219 (1999).
.. [3] Z. Dostál and J. Schöberl, "Minimizing quadratic functions subject to bound constraints with
   the rate of convergence and finite termination", Comput. Optim. Appl. 30, 23-43 (2005): there,
   too, a set is changed when the violations outweigh the residual (proportioning).
.. [4] J. J. Júdice and F. M. Pires, "A block principal pivoting algorithm for large-scale strictly
   monotone linear complementarity problems", Comput. Oper. Res. 21, 587-596 (1994).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import InRegion, Mask, Real, among
from roughline.halfspace.inverse.blocks import without_pulls
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.operators.grid_nodes import Precision
from roughline.halfspace.search.carriers import Carriers, merged
from roughline.halfspace.search.patch import MOST_STEPS, ConjugateGradients, Patch
from roughline.halfspace.search.problem import SINGLE_ABOVE, Load, Method, Outcome
from roughline.halfspace.search.region import Region, Trial

TOLERANCE_AIM = 0.3
"""Of the tolerance, at which conjugate gradients aim so that a certificate is not just missed."""
# After more rounds than this without a new minimum of wrong nodes, only the deepest overlaps join.
# After six times as many, the equations are solved to the tolerance before nodes are exchanged; if
# no minimum follows in twice as many, nodes are exchanged one by one.
_MOST_ROUNDS = 8
_MOST_RELIEF = 1e-3  # part of a bound by which a node that leaves it is relieved at most
_MANY_BELOW = 0.05  # part of the carriers that pull plates, up to which others join
_DEEPEST_PART = 0.1  # of the nodes that overlap, that joins where rounds are slow


class Search:
    """The search for the sets of nodes and the pressures under one load.

    It holds what the next round needs and nothing else, so that the memory of a round is free for
    the one after. It starts from carriers with pressures within their bounds.
    """

    def __init__(self, region: Region, carriers: Carriers, load: Load, method: Method) -> None:
        self.region = region
        self.products = 0  # with the operator, so far
        self._load = load
        self._method = method
        self._rule = _ExchangeRule(region.separation.size)
        self._stopping = _StoppingRule(method)
        self._carriers = self._able(carriers, region.separation)

    def found(self) -> tuple[Trial, Outcome]:
        """Return what is found, and how the search ended."""
        found = None
        while found is None:
            found = self._after_a_round()
        return found

    def foreseen(self) -> Foreseen | None:
        """Return where conjugate gradients lead; None where they fail.

        Nodes are exchanged until gaps with the wrong sign, too, are within the tolerance. No
        residuals are computed in the end, which would take one product more.
        """
        method, rule = self._method, self._rule
        while self.products < method.max_iterations:
            trial = self._trial()
            watched = trial.close(np.inf, trial.gap.size)
            try:
                relaxation = self._relaxed(trial, watched, method.steps)
            except np.linalg.LinAlgError:  # an elastic half-space is positive definite
                return None
            applied = rule.applied(self.region, relaxation, watched)
            self._carriers = self._able(applied, trial.gap)
            largest = max(relaxation.largest_error, relaxation.wrong.largest)
            error = largest / trial.length_scale
            if error <= method.rtol:
                gap = np.zeros(trial.gap.size)
                gap[relaxation.others] = relaxation.gap
                return Foreseen(self._carriers, gap, error, trial.depth)
        return None

    def _after_a_round(self) -> tuple[Trial, Outcome] | None:
        """Exchange nodes; return what is found where the search ends."""
        region, method, rule, stopping = self.region, self._method, self._rule, self._stopping
        # 1. The gap that the pressures leave, and the residuals.
        trial = self._trial(rescale=not self.products)
        spent = self.products >= method.max_iterations
        if spent and stopping.residuals != method.certificate:
            stopping.residuals = method.certificate
            trial = self._trial()
        # 2. The end of the search.
        outcome = stopping.outcome(trial, rule, spent=spent)
        if outcome is Outcome.CONVERGED and trial.residuals.tension:  # less than the tolerance
            bounds = region.bounds.at(trial.carriers.places)
            self._carriers = self._able(_within_bounds(trial.carriers, bounds), trial.gap)
            return None
        if outcome is not None:
            return trial, outcome
        # 3. Conjugate gradients on the touching nodes.
        watched = trial.close(np.inf, trial.gap.size) if rule.one_by_one else trial.watched
        try:
            relaxation = self._relaxed(trial, watched, stopping.steps)
        except np.linalg.LinAlgError:  # an elastic half-space is positive definite
            return trial, Outcome.STALLED
        stopping.choose_precision(relaxation, trial.length_scale)
        # 4. The exchange of wrong nodes.
        self._carriers = self._able(rule.applied(region, relaxation, watched), trial.gap)
        return None

    def _relaxed(self, trial: Trial, watched: InRegion, precision: Precision) -> _Relaxation:
        """Lead the pressures of a trial on, as far as products are left, and count these."""
        relaxation = _relaxed(
            trial,
            self._load,
            watched,
            self._method.rtol,
            precision,
            most_steps=self._method.max_iterations - self.products,
            to_tolerance=self._rule.to_tolerance,
        )
        self.products += relaxation.steps
        return relaxation

    def _trial(self, *, rescale: bool = False) -> Trial:
        self.products += 1
        precision = self._stopping.residuals
        trial = self.region.trial(self._load, self._carriers, precision, rescale=rescale)
        self._carriers = trial.carriers
        return trial

    def _able(self, carriers: Carriers, gap: Real) -> Carriers:
        """Return carriers that can carry the load, joined by the nodes nearest to contact."""
        region = self.region
        total = self._load.total(region.problem.grid.cell_area)
        gap = gap if carriers.places.size else region.separation
        return carriers.able_to_carry(total, region.bounds, gap)


@dataclass(frozen=True, eq=False)
class Foreseen:
    """Where conjugate gradients lead, with no residuals of it."""

    carriers: Carriers
    gap: Real  # of all nodes of the region; zero where bodies touch [length]
    error: float  # of the gap where they touch, over the length scale
    depth: float  # [length]


def _within_bounds(carriers: Carriers, bounds: Bounds) -> Carriers:
    """Set pressures below their bounds to these; a node without pressure is no carrier."""
    below = carriers.pressure < bounds.low
    pressure = np.where(below, bounds.low, carriers.pressure)
    return Carriers(carriers.places, pressure).without(below & (pressure == 0))


@dataclass(frozen=True, eq=False)
class _Wrong:
    """Nodes on the wrong side of a set."""

    below: Mask  # touching carriers whose pressure is beyond its lower bound
    above: Mask  # and beyond its upper one
    leaving: Mask  # carriers at a bound at which the gap has the wrong sign
    overlapping: Mask  # watched nodes, without pressure, at which the bodies overlap
    off: Real  # gap at those that leave [length]
    overlap: Real  # at those that overlap, by its size [length]

    @property
    def count(self) -> int:
        """Number of wrong nodes."""
        each = (self.below, self.above, self.leaving, self.overlapping)
        return sum(int(np.count_nonzero(wrong)) for wrong in each)

    @property
    def largest(self) -> float:
        """The largest gap with the wrong sign. [length]"""
        return float(max(np.abs(self.off).max(initial=0.0), self.overlap.max(initial=0.0)))

    def deepest(self, least: float = math.inf) -> _Wrong:
        """Of the nodes that overlap, leave only those that do so half as deep as any, or deeper.

        The deepest tenth stays in any case, and with a least overlap those that overlap by as much.
        """
        if self.overlap.size:
            tenth = float(np.quantile(self.overlap, 1 - _DEEPEST_PART))
            least = min(least, float(self.overlap.max()) / 2, tenth)
        join = self.overlap >= least
        overlapping = self.overlapping.copy()
        overlapping[self.overlapping] = join
        return replace(self, overlapping=overlapping, overlap=self.overlap[join])

    def certain(self, carriers: int, error: float) -> _Wrong:
        """Leave out nodes that may no longer overlap once the pressures under a plate are known.

        Pressures beyond the lower bound hold a plate down beside them. So as long as these are many
        of the carriers nodes only leave, and then those join that overlap by more than the error of
        the gap where bodies touch, or most of all.
        """
        if np.count_nonzero(self.below) > _MANY_BELOW * carriers:
            none = np.zeros_like(self.overlapping)
            return replace(self, overlapping=none, overlap=self.overlap[:0])
        return self.deepest(error)

    def last_alone(self, places: InRegion, watched: InRegion) -> _Wrong:
        """Leave only the wrong node of highest place."""
        among = places[self.below | self.above | self.leaving]
        last = max(among.max(initial=-1), watched[self.overlapping].max(initial=-1))
        alone, alone_watched = places == last, watched == last
        return _Wrong(
            self.below & alone,
            self.above & alone,
            self.leaving & alone,
            self.overlapping & alone_watched,
            self.off[alone[self.leaving]],
            self.overlap[alone_watched[self.overlapping]],
        )


@dataclass(frozen=True, eq=False)
class _Relaxation:
    """Where conjugate gradients on the touching nodes of a trial ended."""

    carriers: Carriers  # with the pressures after the steps
    wrong: _Wrong
    others: InRegion  # watched nodes and carriers at a bound
    gap: Real  # there, negative where bodies overlap [length]
    level: float  # approach since touch that goes with the pressures [length]
    gap_error: float  # largest gap or overlap of the touching nodes [length]
    largest_error: float  # displacement that is missing on the touching nodes [length]
    steps: int  # each takes one product with the operator


def _relaxed(
    trial: Trial,
    load: Load,
    watched: InRegion,
    rtol: float,
    precision: Precision,
    *,
    most_steps: int,
    to_tolerance: bool,
) -> _Relaxation:
    """Lead the pressures of a trial towards those that close the gap where bodies touch.

    Overlap is looked for at the watched nodes. With `to_tolerance` the steps go on to the
    tolerance, whatever is wrong with the sets of nodes. LinAlgError is raised if the operator is
    not positive definite.
    """
    diagonal = trial.region.problem.inverse.diagonal
    # how far plates bend beside a node shows only once the gap is known at all
    known = trial.length_scale if trial.region.problem.inverse.is_of_plates else math.inf
    tolerance, most_steps = TOLERANCE_AIM * rtol * trial.length_scale, min(most_steps, MOST_STEPS)
    partition = Partition.of(trial, watched)
    if not trial.touching.any():  # under a given depth, all may be at a bound
        wrong = partition.wrong(trial.carriers.pressure[:0], partition.gap, tolerance)
        return _Relaxation(
            trial.carriers, wrong, partition.places, partition.gap, trial.approach, 0.0, 0.0, 0
        )
    gradients = partition.gradients(trial, precision, fixed_total=load.force is not None)
    while True:
        level = trial.approach if load.force is None else gradients.level
        error = gradients.largest_error
        if error <= tolerance or gradients.steps >= most_steps:
            break
        if gradients.steps and not to_tolerance and error < known:
            squared = partition.squared(gradients.pressure, gradients.watched - level, diagonal)
            if squared > gradients.error @ gradients.error:
                break
        if not gradients.advance():
            break
    gap = gradients.watched - level
    wrong = partition.wrong(gradients.pressure, gap, tolerance)
    pressure = gradients.pressure
    if not trial.touching.all():
        pressure = trial.carriers.pressure.copy()
        pressure[trial.touching] = gradients.pressure
    # a pressure out of its bounds counts as the displacement that it causes at its own node
    largest = max(error, max(partition.bounds.violations(gradients.pressure)) * diagonal)
    carriers = Carriers(trial.carriers.places, pressure)
    return _Relaxation(
        carriers, wrong, partition.places, gap, level, error, largest, gradients.steps
    )


@dataclass(frozen=True, eq=False)
class Partition:
    """The nodes of a trial beside its touching ones, and on which side each belongs."""

    touching: Mask  # carriers between their bounds
    bounds: Bounds  # of the touching nodes
    places: InRegion  # nodes without pressure that are watched, and carriers at a bound
    is_watched: Mask  # which of these places are watched
    is_plastic: Mask  # and which are at the upper bound
    gap: Real  # there, negative where bodies overlap [length]

    @classmethod
    def of(cls, trial: Trial, watched: InRegion) -> Partition:
        """Tell the nodes of a trial apart."""
        carriers, touching, plastic = trial.carriers, trial.touching, trial.plastic
        bounds = trial.region.bounds.at(carriers.places[touching])
        if touching.all():
            every = np.ones(watched.size, dtype=bool)
            return cls(touching, bounds, watched, every, ~every, trial.gap[watched])
        places, order = merged(watched, among(carriers.places, ~touching))
        is_watched = order < watched.size
        is_plastic = np.zeros(places.size, dtype=bool)
        is_plastic[~is_watched] = plastic[~touching]
        gap = trial.gap[places]
        gap[is_plastic] -= trial.overlap
        return cls(touching, bounds, places, is_watched, is_plastic, gap)

    def gradients(
        self, trial: Trial, precision: Precision, *, fixed_total: bool
    ) -> ConjugateGradients:
        """Return the equations of the touching nodes, with the displacement of the others."""
        operator, carriers = trial.region.operator, trial.carriers
        touching = carriers.without(~self.touching)
        error = trial.gap[touching.places]
        error += trial.approach if fixed_total else 0.0
        return ConjugateGradients(
            Patch(
                operator.linear,
                trial.region.problem.inverse,
                operator.grid_nodes(touching.places),
                operator.grid_nodes(self.places),
            ),
            touching.pressure.copy(),
            np.negative(error, out=error),
            self.gap + trial.approach,
            fixed_total=fixed_total,
            precision=precision,
        )

    def squared(self, pressure: Real, gap: Real, diagonal: float) -> float:
        """Return the sum of the squared violations. [length²]

        A pressure out of its bounds counts as the displacement that it causes at its own node, by
        the diagonal of the operator. [length / pressure]
        """
        outside = diagonal * (pressure - self.bounds.nearest(pressure))
        wrong = np.where(self.is_plastic, np.maximum(gap, 0.0), np.minimum(gap, 0.0))
        return float(outside @ outside + wrong @ wrong)

    def wrong(self, pressure: Real, gap: Real, slack: float) -> _Wrong:
        """Return the nodes on the wrong side of a set; up to a slack, nodes stay at their bound."""
        below, above, leaving = np.zeros((3, self.touching.size), dtype=bool)
        below[self.touching] = pressure < self.bounds.low
        above[self.touching] = pressure > self.bounds.high
        held = gap[~self.is_watched]
        off = np.where(self.is_plastic[~self.is_watched], held, -held) > slack
        leaving[~self.touching] = off
        beside = gap[self.is_watched]
        overlapping = beside < 0
        return _Wrong(below, above, leaving, overlapping, held[off], -beside[overlapping])


class _ExchangeRule:
    """How many of the wrong nodes change sides at a time.

    As long as their number falls, all of them do. A layer that is much harder than its base is
    lifted far around each node that joins, so that most overlaps vanish as the deepest ones join;
    if all of them joined at once, the set would grow and shrink without end. So where the number
    has not fallen for many rounds, only the deepest overlaps join. If that does not help, the
    equations are solved to the tolerance from then on, and the numbers before do not count. In the
    end only the wrong node of highest place changes sides, which cannot cycle [4]_.
    """

    def __init__(self, points: int) -> None:
        self.wrong = points  # in the last round
        self.to_tolerance = False  # whether equations are solved to it before nodes change sides
        self._fewest = math.inf
        self._rounds = 0  # since the last new minimum of wrong nodes

    @property
    def is_slow(self) -> bool:
        """Whether the number of wrong nodes has not fallen for many rounds."""
        return self.to_tolerance or self._rounds > _MOST_ROUNDS

    @property
    def one_by_one(self) -> bool:
        """Whether only one node changes sides at a time."""
        return self.to_tolerance and self._rounds > 2 * _MOST_ROUNDS

    def applied(self, region: Region, relaxation: _Relaxation, watched: InRegion) -> Carriers:
        """Return the carriers after wrong nodes have changed sides."""
        wrong, carriers = relaxation.wrong, relaxation.carriers
        self.wrong = wrong.count
        if self.one_by_one:
            wrong = wrong.last_alone(carriers.places, watched)
        else:
            if region.problem.inverse.is_of_plates:
                wrong = wrong.certain(carriers.places.size, relaxation.gap_error)
            if self.is_slow:
                wrong = wrong.deepest()
        self._rounds = 0 if self.wrong < self._fewest else self._rounds + 1
        self._fewest = min(self.wrong, self._fewest)
        if not self.to_tolerance and self._rounds > 6 * _MOST_ROUNDS:
            self.to_tolerance, self._rounds, self._fewest = True, 0, math.inf
        return exchanged(region, carriers, watched, wrong)


def exchanged(region: Region, carriers: Carriers, watched: InRegion, wrong: _Wrong) -> Carriers:
    """Return carriers after wrong nodes have changed sides; their pressures are overwritten."""
    bounds, pressure = region.bounds.at(carriers.places), carriers.pressure
    pressure[wrong.above] = bounds.at(wrong.above).high
    _raise_to_bounds(region, carriers, bounds, wrong.below)
    # a node that leaves its bound is relieved of what its own gap takes to close, but of little,
    # for its neighbours change sides as well
    bound = pressure[wrong.leaving]
    most = _MOST_RELIEF * np.abs(bound)
    pressure[wrong.leaving] -= np.clip(wrong.off / region.problem.inverse.diagonal, -most, most)
    free = wrong.below & (pressure == 0)
    return (
        Carriers(carriers.places, pressure)
        .without(free)
        .joined_by(among(watched, wrong.overlapping))
    )


def _raise_to_bounds(region: Region, carriers: Carriers, bounds: Bounds, below: Mask) -> None:
    """Raise the pressures below their lower bounds to these.

    Where a base is softer than the layers on it, blocks keep the sums of their pressures.
    """
    pressure, inverse = carriers.pressure, region.problem.inverse
    if inverse.solves_blocks and below.any():
        touching = bounds.touching(pressure)
        nodes = region.operator.grid_nodes(among(carriers.places, touching))
        low = bounds.at(touching).low
        raised = without_pulls(pressure[touching] - low, nodes, inverse.blocks.on(nodes).sides)
        pressure[touching] = raised + low
    pressure[below] = bounds.at(below).low


class _StoppingRule:
    """When a search is over, and the precisions of its next residuals and of its next steps.

    Both may rise to the precision of the certificate.
    """

    def __init__(self, method: Method) -> None:
        self.residuals: Precision = method.steps
        self.steps: Precision = method.steps
        self._method = method
        self._error_before = np.inf

    def choose_precision(self, relaxation: _Relaxation, length_scale: float) -> None:
        """Compute the next residuals in single precision only while errors are large."""
        large = max(SINGLE_ABOVE * abs(relaxation.level), self._method.rtol * length_scale)
        rough = relaxation.largest_error > large
        self.residuals = self._method.steps if rough else self._method.certificate

    def outcome(self, trial: Trial, rule: _ExchangeRule, *, spent: bool) -> Outcome | None:
        """Say how the search ends with a trial, or None where it goes on."""
        if self.residuals != self._method.certificate:
            return None
        worst = trial.residuals.violation
        if not np.isfinite(worst):
            return Outcome.STALLED
        certified = worst <= self._method.rtol
        if certified and trial.residuals.rounding > self._method.rtol:
            return Outcome.STALLED
        # the stiffness depends on single nodes: go on while one overlaps more than those in contact
        if certified and (trial.residuals.penetration == 0 or rule.is_slow):
            return Outcome.CONVERGED
        if spent:
            return Outcome.CONVERGED if certified else Outcome.MAX_ITERATIONS
        error = worst * trial.length_scale  # which falls itself where pressures become even
        # nodes that overlap are about to join, and more may follow them
        wrong = rule.wrong or trial.residuals.penetration
        if not wrong and error > 0.5 * self._error_before:
            if self.steps == self._method.certificate:
                return Outcome.CONVERGED if certified else Outcome.STALLED
            self.steps = self._method.certificate
        self._error_before = error
        return None
