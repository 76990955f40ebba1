"""The contact problem under one load, solved by a primal-dual active set.

Each round has four steps.

1. The gap that the trial pressures leave is computed on the whole grid, and with it the residuals.
2. The search ends where the residuals are within the tolerance, or where they fall no more.
3. Conjugate gradients lead the pressures towards those that close the gap on the trial nodes,
   until what is wrong with the set of nodes outweighs what is wrong with the pressures [3]_.
4. Nodes that pull are dropped and nodes that overlap are added, all chosen from the same
   pressures [1]_. Where the bodies yield, nodes above the hardness are set to it, and nodes at it
   that come apart are elastic again.

Polonsky and Keer's method [2]_ corrects the set after every step of conjugate gradients; here as
many steps are done as pay. The residuals of what is returned are recomputed from it, in double
precision unless single precision is asked for throughout.

References
----------
.. [1] M. Hintermüller, K. Ito and K. Kunisch, "The primal-dual active set strategy as a semismooth
   Newton method", SIAM J. Optim. 13, 865-888 (2003).
.. [2] I. A. Polonsky and L. M. Keer, "A numerical method for solving rough contact problems based
   on the multi-level multi-summation and conjugate gradient techniques", Wear 231, 206-219 (1999).
.. [3] Z. Dostál and J. Schöberl, "Minimizing quadratic functions subject to bound constraints with
   the rate of convergence and finite termination", Comput. Optim. Appl. 30, 23-43 (2005): there,
   too, a set is changed when the violations outweigh the residual (proportioning).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from roughline.halfspace.contact_set import ContactSet, merged
from roughline.halfspace.exchange import ExchangeRule, able_to_carry, watched_nodes
from roughline.halfspace.relaxation import relaxed
from roughline.halfspace.state import Contact, Load, Method, Outcome, Problem
from roughline.halfspace.stopping import StoppingRule
from roughline.halfspace.trial import Trial


def solve(problem: Problem, load: Load, start: ContactSet, method: Method) -> Contact:
    if not problem.splits.possible:
        return search(problem, load, start, method)
    contact_set, gap = start, np.empty(problem.separation.shape)
    precision, convolutions, worst_before = method.steps, 0, np.inf
    near: Any = problem.separation
    first = True
    while True:
        contact_set = able_to_carry(contact_set, problem.fewest_nodes(load), gap if not first else problem.separation)
        trial = Trial.of(problem, load, contact_set, precision, gap, rescale=first)
        first = False
        convolutions += 1
        worst = trial.residuals.worst
        TRACE.append((precision, trial.contact_set.nodes.size, worst, trial.residuals))
        if precision == method.certificate:
            if worst <= method.rtol and trial.residuals.penetration == 0:
                return trial.contact(problem, Outcome.CONVERGED, convolutions)
        if not worst < 0.5 * worst_before:
            contact = search(problem, load, trial.contact_set, method)
            return replace(contact, convolutions=contact.convolutions + convolutions)
        worst_before = worst
        target = max(_GAIN * worst, 0.3 * method.rtol)
        nodes = trial.contact_set.nodes
        error = float(np.sqrt(np.mean(gap.flat[nodes] ** 2)))
        watched = near_nodes(gap, nodes, max(_NEAR * error, 0.0))
        sites, _ = merged(nodes, watched)
        inner = problem.nearby(trial.contact_set, gap, trial.approach, sites)
        places = ContactSet(np.searchsorted(sites, nodes), trial.contact_set.pressure)
        contact = search(inner, load, places, Method(target, method.max_iterations, "float32"))
        TRACE.append(('inner', sites.size, inner.operator.ratio, contact.convolutions, contact.residuals.worst, contact.outcome))
        contact_set = ContactSet(sites[contact.nodes], contact.pressure)
        expected = max(target, 1e-2 * worst)
        if expected < 1e-4:
            precision = method.certificate


TRACE: list = []
_GAIN = 1e-2
_NEAR = 4.0


def near_nodes(gap, nodes, reach):
    close = gap.ravel() < reach
    close[nodes] = False
    others = np.flatnonzero(close)
    if others.size <= 2 * nodes.size + 1000:
        return others
    gaps = gap.flat[others]
    most = 2 * nodes.size + 1000
    return others[gaps <= np.partition(gaps, most)[most]]


def search(problem: Problem, load: Load, start: ContactSet, method: Method) -> Contact:
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
    contact_set, gap = start, np.empty(problem.separation.shape)
    exchange, stopping = ExchangeRule(gap.size), StoppingRule(method)
    convolutions = 0
    while True:
        # 1. The gap that the pressures leave, and the residuals.
        near = gap if convolutions and contact_set.nodes.size else problem.separation
        contact_set = able_to_carry(contact_set, problem.fewest_nodes(load), near)
        trial = Trial.of(
            problem, load, contact_set, stopping.residuals, gap, rescale=not convolutions
        )
        contact_set = trial.contact_set
        convolutions += 1
        spent = convolutions >= method.max_iterations
        if spent and stopping.residuals != method.certificate:
            stopping.residuals = method.certificate
            trial = Trial.of(problem, load, contact_set, stopping.residuals, gap)
            convolutions += 1
        # 2. The end of the search.
        outcome = stopping.outcome(trial, exchange, spent=spent)
        if outcome is not None:
            return trial.contact(problem, outcome, convolutions)
        # 3. Conjugate gradients on the trial nodes.
        watched = watched_nodes(gap, contact_set.nodes, every=exchange.one_by_one)
        try:
            relaxation = relaxed(
                problem,
                load,
                trial,
                watched,
                method.rtol,
                stopping.steps,
                most_steps=method.max_iterations - convolutions,
                to_tolerance=exchange.to_tolerance,
            )
        except np.linalg.LinAlgError:  # an elastic half-space is positive definite
            return trial.contact(problem, Outcome.STALLED, convolutions)
        convolutions += relaxation.steps
        stopping.choose_precision(relaxation, trial.length_scale)
        # 4. The exchange of wrong nodes.
        contact_set = exchange.applied(problem, contact_set, watched, relaxation.violations)
        del trial, relaxation, watched  # the next gap needs their memory
