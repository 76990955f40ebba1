"""The contact problem under one load, solved by a primal-dual active set.

Each round has four steps.

1. The gap under the trial pressures is computed, on the whole grid or near the contact only, and
   with it the residuals.
2. The search ends if the residuals are within the tolerance, or no longer fall.
3. Conjugate gradients lead the pressures towards those that close the gap on the trial nodes,
   until the error of the set of nodes outweighs the error of the pressures [3]_.
4. Nodes that pull are dropped and nodes that overlap are added, all chosen from the same
   pressures [1]_. Where the bodies yield, nodes above the hardness are set to it, and nodes at it
   that come apart are elastic again.

Polonsky and Keer's method [2]_ corrects the set after every step of conjugate gradients; here it
is corrected only after as many steps as are worth their cost. The residuals of what is returned are
recomputed from it, in double precision unless single precision is asked for throughout.

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

import numpy as np

from roughline.halfspace.search.contact_set import ContactSet
from roughline.halfspace.search.exchange import ExchangeRule, able_to_carry, watched_nodes
from roughline.halfspace.search.relaxation import relaxed
from roughline.halfspace.search.state import Contact, Load, Method, Outcome, Problem
from roughline.halfspace.search.stopping import StoppingRule
from roughline.halfspace.search.trial import Trial


def search(problem: Problem, load: Load, start: ContactSet, method: Method) -> Contact:
    """Find the contact set and the pressures under one load, with the operator of the problem.

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
        pulling = contact_set.pressure < 0
        if outcome is Outcome.CONVERGED and pulling.any():  # by less than the tolerance
            contact_set = contact_set.without(pulling)
            continue
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
