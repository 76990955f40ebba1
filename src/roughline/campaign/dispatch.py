"""Sending batches to workers, writing what comes back, and telling of it."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from roughline._version import __version__
from roughline.campaign.batch import Batch, BatchResult, VersionError, evaluate
from roughline.campaign.cluster import Cluster, interrupts_held_back
from roughline.campaign.writer import Writer
from roughline.contact.status import Status
from roughline.errors import ClusterError

_BATCHES_PER_CORE = 4  # that are sent out at a time, so that no core waits for work
_CHECK_INTERVAL = 5.0  # between two looks at the cluster [s]
_LONGEST_WITHOUT_WORKERS = 60.0  # [s]
_GONE = "the Dask scheduler is gone; what is done is kept: start it again and repeat the command"

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


class Dispatch:
    """One run of a campaign: batches go out as workers ask for more, results are written."""

    def __init__(
        self,
        writer: Writer,
        cluster: Cluster,
        threads: int,
        missing: dict[str, int],
        report: EnsembleProgress,
    ) -> None:
        self._writer, self._cluster = writer, cluster
        self._missing, self._report = missing, report
        self.threads = threads  # for each case
        self.summary = Summary()  # of what was done so far
        self._pending: dict[Any, Batch] = {}
        # cases of batches whose workers died: each is computed alone, to find the one that fails
        self._suspects: list[Batch] = []
        self._alone = False
        self.cores = cluster.cores()  # cases that the cluster computes at a time
        self._checked = self._last_with_workers = time.monotonic()

    def work(self, batches: dict[str, list[Batch]]) -> None:
        """Compute and write all batches."""
        from distributed.comm.core import CommClosedError  # here because it loads slowly

        waiting = iter([batch for each in batches.values() for batch in each])
        try:
            self._send(waiting)
            while self._pending or self._suspects:
                if not self._pending:
                    alone = self._suspects.pop()
                    self._alone = True
                    self._pending[self._submit(alone)] = alone
                for future in self._finished():
                    self._take(future)
                self._send(waiting)
        except CommClosedError as error:  # between two looks at the states of the futures
            raise ClusterError(_GONE) from error
        finally:
            with suppress(Exception):  # a cluster that is gone has nothing to cancel
                self._cluster.client.cancel(list(self._pending), force=True)

    def _send(self, waiting: Iterator[Batch]) -> None:
        while len(self._pending) < _BATCHES_PER_CORE * max(self.cores, 1):
            batch = next(waiting, None)
            if batch is None:
                return
            self._pending[self._submit(batch)] = batch

    def _submit(self, batch: Batch) -> Any:
        work = partial(evaluate, batch)
        return self._cluster.client.submit(work, self.threads, __version__, pure=False)

    def _finished(self) -> list[Any]:
        """Wait until something has finished; raise if the cluster is lost."""
        from distributed import wait

        while True:
            # the states of the futures tell what either exception means
            with self._cluster.client.as_current(), suppress(TimeoutError, CancelledError):
                wait(list(self._pending), timeout=_CHECK_INTERVAL, return_when="FIRST_COMPLETED")
            finished = [future for future in self._pending if future.status != "pending"]
            if any(future.status in ("cancelled", "lost") for future in finished):
                raise ClusterError(_GONE)
            self._check_cluster()
            if finished:
                return finished

    def _check_cluster(self) -> None:
        """Count the cores of the cluster now and then; it may grow, shrink, or vanish."""
        now = time.monotonic()
        if now - self._checked < _CHECK_INTERVAL:
            return
        self._checked, self.cores = now, self._cluster.cores()
        if self.cores:
            self._last_with_workers = now
        elif now - self._last_with_workers > _LONGEST_WITHOUT_WORKERS:
            raise ClusterError(
                f"there has been no worker for {_LONGEST_WITHOUT_WORKERS:g} s; what is done is "
                "kept: start workers and repeat the command"
            )

    def _take(self, future: Any) -> None:
        """Write what a worker sent back, or record why it did not."""
        batch = self._pending.pop(future)
        error = future.exception() if future.status == "error" else None
        if isinstance(error, VersionError | ImportError):
            raise ClusterError(f"{error}; install version {__version__} on every worker")
        if type(error).__name__ == "KilledWorker" and not self._alone:
            self._suspects += batch.split()
            return
        result = _failed(batch, error) if error is not None else future.result()
        future.release()
        with interrupts_held_back():  # so that what is written is counted too
            self._writer.put(batch, result)
            self.summary.add(batch, result)
        name, total = batch.ensemble.name, batch.ensemble.cases
        done = total - self._missing[name] + self.summary.done[name]
        self._report(name, done, self.summary.failed[name], total)


def _failed(batch: Batch, error: BaseException) -> BatchResult:
    """Return the result of a batch of which nothing came back."""
    killed = type(error).__name__ == "KilledWorker"
    why = (
        "its worker died repeatedly, perhaps because memory ran out"
        if killed
        else f"{type(error).__name__}: {error}".splitlines()[0]
    )
    return BatchResult({}, dict.fromkeys(range(len(batch.cells)), why))
