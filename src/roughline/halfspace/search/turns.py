"""The contact under one load, by the correction of a defect.

Each turn looks at the gap that the exact operator gives, and then searches near the contact with
an operator that is restricted to it and exact for the pressures so far. Such a search leaves about
1/500 of the error. The residuals that count are those of the exact operator, wherever bodies can
touch. Where turns do not help, the search continues with the exact operator alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughline.halfspace.operators.grid_nodes import Precision
from roughline.halfspace.search.active_set import AIM, SINGLE_ABOVE, search
from roughline.halfspace.search.carriers import Carriers
from roughline.halfspace.search.problem import Contact, ContactSet, Load, Method, Outcome, Problem
from roughline.halfspace.search.region import REACH, Region, Trial

_GAIN = 2e-3  # of residuals by a search near the contact, and what its operator leaves, about
_NEARER = 30.0  # reach of later searches, which leave a smaller error than they find
_PRODUCTS = 200  # with the restricted operator in one search, at most; a sound one takes some 20
_DEEPER = 1.05  # times the depth of the start up to which nodes are looked at


def solve(problem: Problem, load: Load, start: ContactSet, method: Method) -> Contact:
    """Find the contact set and the pressures under one load.

    Parameters
    ----------
    problem : Problem
        The bodies.
    load : Load
        What is prescribed.
    start : ContactSet
        Where to start from.
    method : Method
        Tolerance, bound on the convolutions and precision.
    """
    spent = _Spent(method.max_iterations)
    trial = _looked_at(problem, load, start, method.steps, spent, rescale=True)
    before, worst, precision = np.inf, trial.residuals.worst, method.steps
    while precision != method.certificate or not trial.certified(method.rtol):
        found = None
        if worst < 0.5 * before and spent.left > 1:
            found = _refined(trial, load, method, spent)
        if found is None:
            return _with_exact_operator(trial, load, method, spent)
        precision = method.certificate
        trial = _looked_at(problem, load, found, precision, spent)
        before, worst = worst, trial.residuals.worst
    return trial.contact(Outcome.CONVERGED, spent.convolutions)


@dataclass
class _Spent:
    """What a load has taken so far.

    Attributes
    ----------
    most : int
        Bound on convolutions and products together.
    convolutions : int
        Convolutions with the exact operator.
    products : int
        Products with restricted operators.
    """

    most: int
    convolutions: int = 0
    products: int = 0

    @property
    def left(self) -> int:
        """What may still be spent."""
        return self.most - self.convolutions - self.products


def guessed(problem: Problem, load: Load, start: ContactSet, method: Method) -> ContactSet:
    """Find a contact roughly: as :func:`solve`, with one search, and no certificate."""
    spent = _Spent(method.max_iterations)
    trial = _looked_at(problem, load, start, method.steps, spent, rescale=True)
    region, carriers = trial.region.near(trial, REACH) or _everywhere(trial)
    found, _, _ = search(region, load, carriers, method)
    return region.on_grid(found.carriers, found.depth)


def _looked_at(
    problem: Problem,
    load: Load,
    start: ContactSet,
    precision: Precision,
    spent: _Spent,
    *,
    rescale: bool = False,
) -> Trial:
    """Return a start as a trial among all nodes that can touch."""
    total = load.total(problem.operator.cell_area)
    depth = start.depth if load.depth is None else load.depth
    pressures = float(start.pressure.sum()) if total is None else total
    reach = np.inf if depth is None else problem.reach(depth, pressures)
    while True:
        region = Region.possible(problem, start.nodes, _DEEPER * reach)
        carriers = region.carriers(start).able_to_carry(total, region.bounds, region.separation)
        if region.reach < np.inf and not carriers.can_carry(total, region.bounds):
            reach = np.inf
            continue
        trial = region.trial(load, carriers, precision, rescale=rescale)
        spent.convolutions += 1
        reach = problem.reach(trial.depth, float(trial.carriers.pressure.sum()))
        if reach <= region.reach:
            return trial
        start = region.on_grid(trial.carriers, trial.depth)


def _everywhere(trial: Trial) -> tuple[Region, Carriers]:
    """Return all of the grid with the exact operator, and the carriers of a trial in it."""
    region = Region.whole(trial.region.problem)
    return region, region.carriers(trial.region.on_grid(trial.carriers, trial.depth))


def _with_exact_operator(trial: Trial, load: Load, method: Method, spent: _Spent) -> Contact:
    """Go on from a trial with the exact operator alone."""
    rest = replace(method, max_iterations=max(1, spent.left))
    if rest.max_iterations == 1:  # no more than a certificate
        rest = replace(rest, precision=method.certificate)
    region, carriers = _everywhere(trial)
    trial, outcome, products = search(region, load, carriers, rest)
    return trial.contact(outcome, spent.convolutions + products)


def _refined(trial: Trial, load: Load, method: Method, spent: _Spent) -> ContactSet | None:
    """Search near the contact of a trial in turns, until a certificate is likely.

    Parameters
    ----------
    trial : Trial
        A trial among all nodes that can touch.
    load, method
        As for :func:`solve`.
    spent : _Spent
        What the load has taken; added to.

    Returns
    -------
    ContactSet or None
        What was found; None where the exact operator costs less.
    """
    found, reach, worst = None, REACH, trial.residuals.worst
    while (near := trial.region.near(trial, reach)) is not None:
        # 1. Search with the restricted operator.
        target = max(_GAIN * worst, AIM * method.rtol)
        rough = Method(target, max(1, min(spent.left - 1, _PRODUCTS)), "float32")
        result, _, products = search(near[0], load, near[1], rough)
        found = near[0].on_grid(result.carriers, result.depth)
        spent.products += products
        expected = max(target, _GAIN * worst)
        if expected <= method.rtol or spent.left <= 1:
            break
        # 2. See, there, what the exact operator gives.
        precision = method.steps if expected > SINGLE_ABOVE else method.certificate
        exact = near[0].recentred(result.carriers, precision)
        trial = exact.trial(load, result.carriers, "float32")
        spent.convolutions += 1
        before, worst, reach = worst, trial.residuals.worst, _NEARER
        if not worst < 0.5 * before:
            break
    return found
