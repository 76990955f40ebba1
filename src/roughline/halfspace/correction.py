"""The contact under one load, by the correction of a defect.

A search near the contact, with an operator that is restricted to it, errs by what this operator
errs. So the exact operator tells the gap of what was found, everywhere, and the search goes on from
there: the restricted operator is asked only for what further changes of the pressures displace.
Each turn leaves a hundredth of the error or less. The residuals that count are those of the exact
operator. Where turns do not help, the search goes on with the exact operator alone.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roughline.halfspace.active_set import search
from roughline.halfspace.contact_set import ContactSet
from roughline.halfspace.exchange import able_to_carry
from roughline.halfspace.nearby import NearbyProblem, nearby
from roughline.halfspace.state import Contact, Load, Method, Outcome, Problem
from roughline.halfspace.trial import Trial

_GAIN = 2e-3  # of residuals by a search near the contact
_PRODUCTS = 200  # with the restricted operator in one turn, at most; a sound one takes some 20
_AIM = 0.3  # below the tolerance, so that the certificate is not missed by a hair
_SINGLE_ABOVE = 1e-4  # residuals below this are computed in the precision of the certificate


def solve(problem: Problem, load: Load, start: ContactSet, method: Method) -> Contact:
    """Find the contact set and the pressures under one load.

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
    contact_set = start
    precision, convolutions, steps, worst = method.steps, 0, 0, np.inf
    while True:
        contact_set = able_to_carry(contact_set, problem.fewest_nodes(load), problem.separation)
        gap = np.empty(problem.separation.shape)
        trial = Trial.of(problem, load, contact_set, precision, gap, rescale=not convolutions)
        contact_set = trial.contact_set
        convolutions += 1
        worst_before, worst = worst, trial.residuals.worst
        if precision == method.certificate and trial.certified(method.rtol):
            return trial.contact(problem, Outcome.CONVERGED, convolutions)
        left = method.max_iterations - convolutions - steps
        if left <= 1 or not worst < 0.5 * worst_before:
            break
        target = max(_GAIN * worst, _AIM * method.rtol)
        near = nearby(problem, trial)
        del trial, gap  # the search needs the memory
        rough = Method(target, min(left - 1, _PRODUCTS), "float32")
        found = corrected(problem, load, near, rough)
        del near
        if found is None:
            break
        contact_set, spent = found
        steps += spent
        if target < _SINGLE_ABOVE:
            precision = method.certificate
    left = max(1, method.max_iterations - convolutions - steps)
    rest = replace(method, max_iterations=left)
    if left == 1:  # no more than a certificate
        rest = replace(rest, precision=method.certificate)
    contact = search(problem, load, contact_set, rest)
    return replace(contact, convolutions=contact.convolutions + convolutions)


def corrected(
    problem: Problem, load: Load, near: tuple[NearbyProblem, ContactSet] | None, method: Method
) -> tuple[ContactSet, int] | None:
    """Search near the contact of a trial with a restricted operator.

    Parameters
    ----------
    problem, load : Problem, Load
        The bodies, and what is prescribed.
    near : tuple of NearbyProblem and ContactSet, or None
        The problem near the contact of a trial, as :func:`nearby` returns it.
    method : Method
        Tolerance, bound on the products and precision of the search.

    Returns
    -------
    contact_set : ContactSet
        What was found.
    products : int
        Products with the restricted operator.

    None where the exact operator is cheaper than a restricted one.
    """
    if near is None:
        return None
    there, start = near
    problem.operator.release_buffers()  # the search needs the memory
    found = search(there, load, start, method)
    there.approximate.far.release_buffers()
    contact_set = there.on_grid(ContactSet(found.nodes, found.pressure))
    return contact_set, found.convolutions


def guessed(problem: Problem, load: Load, start: ContactSet, method: Method) -> ContactSet:
    """Find a contact roughly: as :func:`solve`, with one turn, and no certificate."""
    contact_set = able_to_carry(start, problem.fewest_nodes(load), problem.separation)
    trial = Trial.of(
        problem, load, contact_set, method.steps, np.empty(problem.separation.shape), rescale=True
    )
    contact_set, near = trial.contact_set, nearby(problem, trial)
    del trial
    found = corrected(problem, load, near, method)
    if found is None:
        contact = search(problem, load, contact_set, method)
        return ContactSet(contact.nodes, contact.pressure)
    return found[0]
