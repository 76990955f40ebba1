"""The contact under one load, by the correction of a defect.

A search near the contact with an operator that is restricted to it has the error of this operator.
The exact operator therefore computes the gap of the result everywhere, and the search continues
from there: the restricted operator gives only the displacement by further changes of the pressures.
Each turn leaves about 1/500 of the error. The residuals that count are those of the exact
operator. Where turns do not help, the search continues with the exact operator alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughline.halfspace.operators.operator import Precision
from roughline.halfspace.search.active_set import search
from roughline.halfspace.search.contact_set import ContactSet
from roughline.halfspace.search.exchange import able_to_carry
from roughline.halfspace.search.nearby import Nearby, nearby, within_reach
from roughline.halfspace.search.state import Contact, Load, Method, Outcome, Problem
from roughline.halfspace.search.trial import Trial

_MUCH = 2**26  # bytes, which are given back where they are not needed for a while
_GAIN = 2e-3  # of residuals by a search near the contact
_DEFECT = 2e-3  # of residuals that a restricted operator leaves, about
_REACH = 30.0  # of later searches, which leave a smaller error than they find
_PRODUCTS = 200  # with the restricted operator in one search, at most; a sound one takes some 20
_AIM = 0.3  # below the tolerance, so that the certificate is not missed by a hair
_SINGLE_ABOVE = 1e-4  # residuals below this are computed in the precision of the certificate


def solve(problem: Problem, load: Load, start: ContactSet, method: Method) -> Contact:
    """Find the contact set and the pressures under one load.

    The contact is that of the nodes under pressure. A node that touches but bears nothing is none
    of them: it counts neither in the area nor in the stiffness.

    Parameters
    ----------
    problem : Problem
        The body and the half-space.
    load : Load
        What is prescribed.
    start : ContactSet
        Where to start from, with pressures of which none is negative.
    method : Method
        Tolerance, bound on the convolutions and precision.
    """
    contact_set, gap = start, None
    del start  # from here on, nothing is held that is not needed
    spent, worst, precision = Spent(), np.inf, method.steps
    bounded = replace(method, max_iterations=method.max_iterations - 1)
    several = bounded.max_iterations > 1
    begun = within_reach(problem, load, contact_set, precision) if several else None
    if begun is not None:
        spent.convolutions += 1
        worst = begun[1]
        contact_set = _refined(begun[0], load, worst, bounded, spent)
        precision = method.certificate
    del begun
    while True:
        contact_set = able_to_carry(contact_set, problem.fewest_nodes(load), problem.separation)
        gap = np.empty(problem.separation.shape) if gap is None else gap
        first = not spent.convolutions
        trial = Trial.of(problem, load, contact_set, precision, gap, rescale=first)
        contact_set = trial.contact_set
        spent.convolutions += 1
        worst_before, worst = worst, trial.residuals.worst
        if precision == method.certificate and trial.certified(method.rtol):
            contact = trial.contact(problem, Outcome.CONVERGED, spent.convolutions)
            return contact.of_loaded_nodes()
        left = method.max_iterations - spent.total
        near = nearby(problem, trial)
        if near is None or left <= 1 or not worst < 0.5 * worst_before:
            break
        del trial, contact_set
        if gap.nbytes > _MUCH:
            gap = None
        bounded = replace(method, max_iterations=left)
        contact_set = _refined(near, load, worst, bounded, spent)
        del near
        precision = method.certificate
    left = max(1, method.max_iterations - spent.total)
    rest = replace(method, max_iterations=left)
    if left == 1:  # no more than a certificate
        rest = replace(rest, precision=method.certificate)
    contact = search(problem, load, contact_set, rest)
    spent.convolutions += contact.convolutions
    return replace(contact, convolutions=spent.convolutions).of_loaded_nodes()


@dataclass
class Spent:
    """What a load has taken so far.

    Attributes
    ----------
    convolutions : int
        Convolutions with the exact operator.
    products : int
        Products with restricted operators.
    """

    convolutions: int = 0
    products: int = 0

    @property
    def total(self) -> int:
        """Both, which the bound on iterations bounds."""
        return self.convolutions + self.products


def _refined(near: Nearby, load: Load, worst: float, method: Method, spent: Spent) -> ContactSet:
    """Search near the contact, correcting the defect there, until a certificate is likely.

    What is found is returned on the grid.

    Parameters
    ----------
    near : Nearby
        The problem near the contact, and where to start from; both are overwritten.
    load : Load
        What is prescribed.
    worst : float
        The largest residual there.
    method : Method
        As for :func:`solve`.
    spent : Spent
        What the load has taken; added to.
    """
    most = spent.total + method.max_iterations
    while True:
        target, left = max(_GAIN * worst, _AIM * method.rtol), most - spent.total
        rough = Method(target, max(1, min(left - 1, _PRODUCTS)), "float32")
        spent.products += _search(near, load, rough)
        expected = max(target, _DEFECT * worst)
        if expected <= method.rtol or most - spent.total <= 1:
            break
        precision = method.steps if expected > _SINGLE_ABOVE else method.certificate
        spent.convolutions += 1
        worst_before, worst = worst, _correct(near, load, precision)
        if not worst < 0.5 * worst_before:
            break
    return near.on_grid


def _search(near: Nearby, load: Load, method: Method) -> int:
    """Search near the contact, and return the products that it took."""
    found = search(near.problem, load, near.contact_set, method)
    near.contact_set = ContactSet(found.nodes, found.pressure)
    return found.convolutions


def _correct(near: Nearby, load: Load, precision: Precision) -> float:
    """Compute exactly what was found displaces, and return the largest residual.

    It is infinite where the exact operator is cheaper than a restricted one.
    """
    exact = near.problem.recentred(near.contact_set, precision)
    trial = exact.trial(load, near.contact_set)
    nearer = nearby(exact, trial, _REACH)
    if nearer is None:
        return np.inf
    near.problem, near.contact_set = nearer.problem, nearer.contact_set
    return trial.residuals.worst


def guessed(problem: Problem, load: Load, start: ContactSet, method: Method) -> ContactSet:
    """Find a contact roughly: as :func:`solve`, with one search, and no certificate."""
    begun = within_reach(problem, load, start, method.steps)
    if begun is not None:
        _search(begun[0], load, method)
        return begun[0].on_grid
    contact_set = able_to_carry(start, problem.fewest_nodes(load), problem.separation)
    gap = np.empty(problem.separation.shape)
    trial = Trial.of(problem, load, contact_set, method.steps, gap, rescale=True)
    contact_set, near = trial.contact_set, nearby(problem, trial)
    del trial, gap
    if near is None:
        contact = search(problem, load, contact_set, method)
        return ContactSet(contact.nodes, contact.pressure)
    _search(near, load, method)
    return near.on_grid
