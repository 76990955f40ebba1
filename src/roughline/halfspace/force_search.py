"""The contact under one load; under a force, where need be, through contacts at given depths.

Where many nodes yield at once, the exchange of nodes under a given force can go round in circles:
the level of the elastic nodes hangs on what those at the hardness leave them to bear, and the
other way round. At a given depth it does not, and the force rises with the depth, so that the
depth is found between two others.
"""

from __future__ import annotations

from dataclasses import replace

from roughline.halfspace.active_set import solve
from roughline.halfspace.contact_set import ContactSet
from roughline.halfspace.state import Contact, Load, Method, Outcome, Problem

# Over the force: how near a contact comes before the exchange under the force is tried from it, and
# how much nearer before it is tried again.
_NEAR, _NEARER = 1e-2, 0.1
# Over the tolerance: a force so near is the one that was asked for.
_AIM = 0.3
# Over the tolerance: that of contacts at given depths in double precision. Soft bodies spring by
# little of the height with which gaps are compared, so that small gaps are much of their forces.
_TIGHTER = 1e-3
_MOST_DEPTHS = 60


def solved(problem: Problem, load: Load, start: ContactSet, method: Method) -> Contact:
    """Find the contact under one load; see :func:`~roughline.halfspace.active_set.solve`."""
    contact = solve(problem, load, start, method)
    if contact.outcome is not Outcome.CYCLING:
        return contact
    assert load.force is not None
    search = _Search(problem, load.force, method, contact)
    return search.result()


class _Search:
    """The depth under a force, between one that is too small and one that is too large.

    Parameters
    ----------
    problem, method : Problem, Method
        The bodies, and how contacts are solved.
    force : float
        The force. [force]
    contact : Contact
        Where the exchange under the force ended.
    """

    def __init__(self, problem: Problem, force: float, method: Method, contact: Contact) -> None:
        self._problem, self._force, self._method = problem, force, method
        self._contact = contact
        self._spent = contact.convolutions

    def result(self) -> Contact:
        """Return the contact, or the last one, with an outcome that says what is wrong with it."""
        touch, near = self._problem.touch, _NEAR
        low, lack = touch, self._force
        high, excess = float("inf"), 0.0
        depth = max(self._contact.depth, 2 * touch - self._contact.depth)
        for _ in range(_MOST_DEPTHS):
            at_depth = self._solved(Load(depth=depth))
            if not at_depth.residuals.worst <= self._method.rtol:
                return at_depth
            missing = self._force - at_depth.force
            if abs(missing) <= _AIM * self._method.rtol * self._force:
                residuals = replace(at_depth.residuals, load=abs(missing) / self._force)
                return replace(at_depth, residuals=residuals, outcome=Outcome.CONVERGED)
            if abs(missing) <= near * self._force:
                under_force = self._solved(Load(force=self._force))
                if under_force.outcome is Outcome.CONVERGED:
                    return under_force
                near *= _NEARER
                self._contact = at_depth
            # Illinois: the end that stays counts half, so that it does not stay for long
            if missing > 0:
                low, lack, excess = depth, missing, excess / 2
            else:
                high, excess, lack = depth, -missing, lack / 2
            if high == float("inf"):
                depth = touch + 2 * (depth - touch)
            else:
                depth = low + (high - low) * lack / (lack + excess)
        return replace(self._contact, outcome=Outcome.STALLED)

    def _solved(self, load: Load) -> Contact:
        """Solve a contact, from the last one."""
        start = ContactSet(self._contact.nodes, self._contact.pressure)
        rtol = self._method.rtol
        if load.depth is not None and self._method.certificate == "float64":
            rtol *= _TIGHTER
        left = max(self._method.max_iterations - self._spent, 1)
        method = replace(self._method, rtol=rtol, max_iterations=left)
        contact = solve(self._problem, load, start, method)
        self._spent += contact.convolutions
        self._contact = replace(contact, convolutions=self._spent)
        return self._contact
