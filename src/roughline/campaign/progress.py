"""What a run reports, case by case and at its end."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

from roughline.campaign.batch import Batch, BatchResult
from roughline.contact.status import Status

EnsembleProgress = Callable[[str, int, int, int], None]
"""Called with (ensemble, cases done, cases failed, cases in all)."""


@dataclass
class Summary:
    """What one run did.

    Attributes
    ----------
    done, failed : Counter
        Cases by ensemble, in this run.
    core_seconds : dict
        Time of the workers by ensemble. [s]
    reasons : Counter
        Number of failed cases by reason.
    unconverged : int
        Number of loads that were not solved to the tolerance, of cases that are done; they are NaN.
    """

    done: Counter[str] = field(default_factory=Counter)
    failed: Counter[str] = field(default_factory=Counter)
    core_seconds: dict[str, float] = field(default_factory=dict)
    reasons: Counter[str] = field(default_factory=Counter)
    unconverged: int = 0

    def add(self, batch: Batch, result: BatchResult) -> None:
        """Count a batch that was written."""
        name, failed = batch.ensemble.name, len(result.failures)
        self.done[name] += len(batch.cells) - failed
        self.failed[name] += failed
        self.core_seconds[name] = self.core_seconds.get(name, 0.0) + result.core_seconds
        self.reasons.update(result.failures.values())
        if "status" in result.results:
            self.unconverged += int((result.results["status"] > Status.CONVERGED).sum())
