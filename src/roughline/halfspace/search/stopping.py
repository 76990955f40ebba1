"""When the search for a contact is over, and in which precision it computes until then."""

from __future__ import annotations

import numpy as np

from roughline.halfspace.operators.operator import Precision
from roughline.halfspace.search.exchange import ExchangeRule
from roughline.halfspace.search.relaxation import Relaxation
from roughline.halfspace.search.state import Method, Outcome
from roughline.halfspace.search.trial import Trial

# Single precision serves while errors are above this part of the approach; its own are 1e-7 of it.
_SINGLE_ABOVE = 1e-4


class StoppingRule:
    """When a search is over, and the precisions of its convolutions.

    Parameters
    ----------
    method : Method
        Tolerance and precision.

    Attributes
    ----------
    residuals, steps : {"float64", "float32"}
        Precision of the next residuals and of the next steps. Both may rise to the precision of
        the certificate.
    """

    def __init__(self, method: Method) -> None:
        self.residuals: Precision = method.steps
        self.steps: Precision = method.steps
        self._method = method
        self._error_before = np.inf

    def choose_precision(self, relaxation: Relaxation, length_scale: float) -> None:
        """Compute the next residuals in single precision only while errors are large."""
        large = max(_SINGLE_ABOVE * abs(relaxation.level), self._method.rtol * length_scale)
        rough = relaxation.largest_error > large
        self.residuals = self._method.steps if rough else self._method.certificate

    def outcome(self, trial: Trial, exchange: ExchangeRule, *, spent: bool) -> Outcome | None:
        """Say how the search ends with a trial, or None where it goes on.

        Parameters
        ----------
        trial : Trial
            With residuals in the precision of this rule.
        exchange : ExchangeRule
            How the exchange of nodes goes on.
        spent : bool
            Whether no more convolutions are allowed.
        """
        if self.residuals != self._method.certificate:
            return None
        worst = trial.residuals.violation
        certified = worst <= self._method.rtol
        if certified and trial.residuals.rounding > self._method.rtol:
            return Outcome.STALLED
        # the stiffness depends on single nodes: go on while one overlaps more than those in contact
        if certified and (trial.residuals.penetration == 0 or exchange.to_tolerance):
            return Outcome.CONVERGED
        if not np.isfinite(worst):
            return Outcome.STALLED
        if spent:
            return Outcome.CONVERGED if certified else Outcome.MAX_ITERATIONS
        error = worst * trial.length_scale  # which falls itself where pressures become even
        if not exchange.wrong and error > 0.5 * self._error_before:
            if self.steps == self._method.certificate:
                return Outcome.CONVERGED if certified else Outcome.STALLED
            self.steps = self._method.certificate
        self._error_before = error
        return None
