"""The contact under one load, by the correction of a defect.

Each turn looks at the gap that the exact operator gives, and then searches near the contact with
an operator that is restricted to it and exact for the pressures so far. Such a search leaves about
1/500 of the error. The residuals that count are those of the exact operator, wherever bodies can
touch. Where turns do not help, the search continues with the exact operator alone.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roughline.halfspace.operators.grid_nodes import Precision
from roughline.halfspace.search import small_grid
from roughline.halfspace.search.active_set import TOLERANCE_AIM, Search
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
from roughline.halfspace.search.region import REACH_OF_ERROR, Region, Trial

_RESIDUAL_GAIN = 2e-3  # by a search near the contact, and what its operator leaves, about
_LATER_REACH = 30.0  # reach of later searches, which leave a smaller error than they find


class Turns:
    """The search for the contact set and the pressures under one load.

    It holds what the next step needs and nothing else, so that the memory of a step is free for
    the one after. The bound on iterations is one on convolutions and products together.
    """

    def __init__(self, problem: Problem, load: Load, start: ContactSet, method: Method) -> None:
        self._problem = problem
        self._load = load
        self._method = method
        self._start: ContactSet | None = start
        self._near: tuple[Region, Carriers] | None = None
        self._worst = np.inf  # residual of the last look wherever bodies can touch
        self._worst_near = np.inf  # and of the last one near the contact
        self._convolutions = 0  # with the exact operator
        self._products = 0  # with restricted ones

    @property
    def _left(self) -> int:
        """Convolutions and products that may still be spent."""
        return self._method.max_iterations - self._convolutions - self._products

    def contact(self) -> Contact:
        """Return the contact, certified or not."""
        method = self._method
        precision = method.certificate if self._found_on_small_grid() else method.steps
        contact = self._seen(precision)
        while contact is None and self._near is not None:
            while self._refine():
                pass
            contact = self._seen(method.certificate)
        return contact or self._with_exact_operator()

    def guess(self) -> ContactSet:
        """Return a contact that is found roughly, by one search and with no certificate."""
        if self._found_on_small_grid():
            assert self._start is not None
            return self._start
        trial = self._trial(self._method.steps)
        near = self._near_contact(trial, REACH_OF_ERROR) or self._everywhere(trial.contact_set)
        return Search(*near, self._load, self._method).found()[0].contact_set

    def _found_on_small_grid(self) -> bool:
        """Take what is found by whole fields on a small grid as the start, if anything is."""
        assert self._start is not None
        found, spent = small_grid.contact_under(
            self._problem, self._load, self._start, self._method
        )
        self._convolutions += spent
        self._start = found or self._start
        return found is not None

    def _seen(self, precision: Precision) -> Contact | None:
        """Look wherever bodies can touch; return the contact if it is certified.

        If not, the nodes near the contact are kept, unless the last turn did not help.
        """
        trial, before = self._trial(precision), self._worst
        if precision == self._method.certificate and trial.certified(self._method.rtol):
            return trial.contact(Outcome.CONVERGED, self._convolutions)
        self._start = trial.contact_set
        self._worst = self._worst_near = trial.residuals.worst
        helped = self._worst < 0.5 * before
        self._near = (
            self._near_contact(trial, REACH_OF_ERROR) if helped and self._left > 1 else None
        )
        return None

    def _trial(self, precision: Precision) -> Trial:
        """Return where the search is as a trial among all nodes that can touch."""
        problem, load, start = self._problem, self._load, self._start
        assert start is not None
        total = load.total(problem.grid.cell_area)
        reach = problem.foreseen_reach(load, start)
        while True:
            region = Region.possible(problem, start.nodes, reach)
            carriers = region.carriers(start)
            carriers = carriers.able_to_carry(total, region.bounds, region.separation)
            if region.reach < np.inf and not carriers.can_carry(total, region.bounds):
                reach = np.inf
                continue
            trial = region.trial(load, carriers, precision, rescale=not self._convolutions)
            self._convolutions += 1
            if problem.reach(trial.depth) <= region.reach:
                return trial
            start = trial.contact_set
            reach = problem.foreseen_reach(load, start)

    def _refine(self) -> bool:
        """Search near the contact, and look there; return whether that serves once more."""
        method, worst = self._method, self._worst_near
        # 1. Search with the restricted operator.
        target = max(_RESIDUAL_GAIN * worst, TOLERANCE_AIM * method.rtol)
        region, carriers = self._searched_near(target)
        expected = max(target, _RESIDUAL_GAIN * worst)
        if expected <= method.rtol or self._left <= 1:
            return False
        # 2. See, there, what the exact operator gives.
        precision = method.steps if expected > SINGLE_ABOVE else method.certificate
        region = region.recentred(carriers, precision)
        trial = region.trial(self._load, carriers, "float32")
        self._convolutions += 1
        self._start, self._worst_near = trial.contact_set, trial.residuals.worst
        if self._worst_near < 0.5 * worst:
            self._near = self._near_contact(trial, _LATER_REACH)
        return self._near is not None

    def _near_contact(self, trial: Trial, reach: float) -> tuple[Region, Carriers] | None:
        """Return the nodes near the contact of a trial, while the exact operator rests."""
        self._problem.operator.workspace.rest()
        return trial.region.near(trial, reach)

    def _searched_near(self, target: float) -> tuple[Region, Carriers]:
        """Search among the nodes near the contact, to a target, and return what is found there."""
        assert self._near is not None
        most = max(1, min(self._left - 1, 200))  # a sound search takes some 20 products
        rough = Method(target, most, "float32")
        search = Search(*self._near, self._load, rough)
        self._near = None
        found, _ = search.found()
        self._products += search.products
        self._start = found.contact_set
        return found.region, found.carriers

    def _everywhere(self, contact_set: ContactSet) -> tuple[Region, Carriers]:
        """Return all of the grid with the exact operator, and a contact set as carriers in it."""
        region = Region.everywhere(self._problem)
        return region, region.carriers(contact_set)

    def _with_exact_operator(self) -> Contact:
        """Go on with the exact operator alone."""
        rest = replace(self._method, max_iterations=max(1, self._left))
        if rest.max_iterations == 1:  # no more than a certificate
            rest = replace(rest, precision=rest.certificate)
        assert self._start is not None
        search = Search(*self._everywhere(self._start), self._load, rest)
        self._start = None
        trial, outcome = search.found()
        return trial.contact(outcome, self._convolutions + search.products)
