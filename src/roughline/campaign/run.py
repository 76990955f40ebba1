"""Computing a plan: the batches that a store lacks, on a Dask cluster, each written when done."""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from contextlib import AbstractContextManager, ExitStack, suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

from roughline._version import __version__
from roughline.campaign import cluster as clusters
from roughline.campaign.batch import (
    Batch,
    Outcome,
    VersionError,
    evaluate,
    evaluate_gallery,
)
from roughline.campaign.cost import cost_of, refuse_beyond_disk, refuse_countless, workers_that_fit
from roughline.campaign.plan import Plan
from roughline.campaign.writer import Writer, writing
from roughline.computing import fft
from roughline.contact.curve import Status
from roughline.errors import ClusterError, InputError

Progress = Callable[[str, int, int, int], None]
"""Called with (ensemble, cases done, cases failed, cases in all)."""

_AHEAD = 4  # batches that are sent out for each core, so that none waits for work
_GLANCE = 5.0  # how often the cluster is looked at while nothing arrives [s]
_PATIENCE = 60.0  # without any worker [s]


@dataclass
class Summary:
    """What a run did.

    Attributes
    ----------
    done, failed : Counter
        Cases by ensemble, in this run.
    core_seconds : dict
        Time of the workers by ensemble. [s]
    reasons : Counter
        Why cases failed, equal reasons together.
    unconverged : int
        Loads, of cases that are done, that were not solved to the tolerance; they are NaN.
    """

    done: Counter[str] = field(default_factory=Counter)
    failed: Counter[str] = field(default_factory=Counter)
    core_seconds: dict[str, float] = field(default_factory=dict)
    reasons: Counter[str] = field(default_factory=Counter)
    unconverged: int = 0

    def add(self, batch: Batch, outcome: Outcome) -> None:
        """Count a batch that was written."""
        name, failed = batch.ensemble.name, len(outcome.failures)
        self.done[name] += len(batch.cells) - failed
        self.failed[name] += failed
        self.core_seconds[name] = self.core_seconds.get(name, 0.0) + outcome.core_seconds
        self.reasons.update(outcome.failures.values())
        if "status" in outcome.results:
            self.unconverged += int((outcome.results["status"] > Status.CONVERGED).sum())


def run(
    plan: Plan,
    store: str | Path,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    announce: Callable[[str], None] | None = None,
) -> Summary:
    """Compute what a store lacks of a plan.

    Interrupting keeps every batch that was finished; a further call goes on from there. Results
    do not depend on the number of workers, on threads, or on the order. A case that fails is
    recorded with its reason, stops no other, and is tried again by the next call.

    Parameters
    ----------
    plan : Plan
        What to compute.
    store : str or Path
        Folder for the results; made, or enlarged, if needed.
    scheduler : str, optional
        Address of a Dask scheduler, such as "tcp://10.0.0.1:8786"; default: a cluster on this
        machine.
    workers : int, optional
        Processes on this machine; default: one for each core, as far as memory allows.
    threads : int, optional
        Threads for each case; default: the cores of this machine shared out among the workers,
        1 with a scheduler.
    progress : callable, optional
        Called with (ensemble, cases done, cases failed, cases in all), at the start too.
    announce : callable, optional
        Called with lines worth reading: what there is to do, and the dashboard's address.

    Returns
    -------
    Summary
        What this call did.

    Raises
    ------
    InputError
        If workers, threads or memory do not suffice or do not fit together.
    StoreError
        If the store cannot be used or written.
    ClusterError
        If the cluster cannot be used, or is lost.
    KeyboardInterrupt
        On Ctrl-C, saying where what is done is kept.
    """
    report = progress or (lambda name, done, failed, total: None)
    say = announce or (lambda text: None)
    _check(scheduler, workers, threads)
    try:
        return _computed(plan, Path(store), scheduler, workers, threads, report, say)
    except KeyboardInterrupt:
        kept = f"interrupted; what is done is kept in {store}: run again to go on"
        raise KeyboardInterrupt(kept) from None


def _computed(
    plan: Plan,
    store: Path,
    scheduler: str | None,
    workers: int | None,
    threads: int | None,
    report: Progress,
    say: Callable[[str], None],
) -> Summary:
    """Compute what a store lacks; as :func:`run`."""
    if scheduler is None:
        clusters.refuse_unguarded_script()
    refuse_countless(plan)
    if not store.exists():  # else it shows below what is missing
        whole = {ensemble.name: ensemble.cases for ensemble in plan.ensembles}
        refuse_beyond_disk(plan, whole, store)
    with ExitStack() as ending:
        with clusters.deaf_to_interrupts():
            writer = ending.enter_context(writing(store, plan))
            batches = {ensemble.name: writer.missing(ensemble) for ensemble in plan.ensembles}
        missing = {name: sum(len(b.cells) for b in found) for name, found in batches.items()}
        draws = plan.gallery is not None and not writer.has_gallery
        if not (draws or any(missing.values())):
            _tell_all(plan, missing, report)
            return Summary()
        cost = cost_of(plan, missing)
        refuse_beyond_disk(plan, missing, store)
        cores = fft.available_cores()
        if scheduler is None:
            workers = workers_that_fit(max(cost.memory, 1), workers)
            threads = threads or max(1, cores // workers)
            if threads * workers > cores:
                raise InputError(
                    f"{workers} workers with {threads} threads each are more than the {cores} "
                    "cores of this machine: take fewer of one"
                )
        say(f"{plan.name}: {cost.described(workers or 1)}")
        cluster: AbstractContextManager[clusters.Cluster] = (
            clusters.remote(scheduler) if scheduler else clusters.local(workers or 1)
        )
        with cluster as at_work:
            say(f"dashboard: {at_work.dashboard}")
            _tell_all(plan, missing, report)
            campaign = _Campaign(plan, writer, at_work, threads or 1, missing, report)
            started = time.time()
            try:
                campaign.work(batches, draws)
            finally:
                _log(store, started, campaign, threads or 1)
        return campaign.summary


class _Campaign:
    """One run: batches go out as workers take them, and are written as they come back."""

    def __init__(
        self,
        plan: Plan,
        writer: Writer,
        cluster: clusters.Cluster,
        threads: int,
        missing: dict[str, int],
        report: Progress,
    ) -> None:
        self.plan, self.writer, self.cluster = plan, writer, cluster
        self.threads, self.missing, self.report = threads, missing, report
        self.summary = Summary()
        self.pending: dict[Any, Batch | None] = {}
        # cases that were with workers that died; which of them is to blame shows when each is alone
        self.suspects: list[Batch] = []
        self.alone = False
        self.cores = cluster.cores()
        self.looked = self.last_with_workers = time.monotonic()

    def work(self, batches: dict[str, list[Batch]], draws: bool) -> None:
        """Compute and write all batches, and the gallery if it is wanted."""
        waiting = iter([batch for found in batches.values() for batch in found])
        if draws and self.plan.gallery is not None:
            self.pending[self._submit(partial(evaluate_gallery, self.plan.gallery))] = None
        try:
            self._send(waiting)
            while self.pending or self.suspects:
                if not self.pending:
                    alone = self.suspects.pop()
                    self.alone = True
                    self.pending[self._submit(partial(evaluate, alone))] = alone
                for future in self._finished():
                    self._take(future)
                self._send(waiting)
        finally:
            with suppress(Exception):  # a cluster that is gone has nothing to cancel
                self.cluster.client.cancel(list(self.pending), force=True)

    def _send(self, waiting: Iterator[Batch]) -> None:
        while len(self.pending) < _AHEAD * max(self.cores, 1):
            batch = next(waiting, None)
            if batch is None:
                return
            self.pending[self._submit(partial(evaluate, batch))] = batch

    def _submit(self, work: Callable[..., object]) -> Any:
        return self.cluster.client.submit(work, self.threads, __version__, pure=False)

    def _finished(self) -> list[Any]:
        """Wait until something has finished; raise if the cluster is lost."""
        from distributed import wait

        while True:
            # both exceptions are looked at below
            with self.cluster.client.as_current(), suppress(TimeoutError, CancelledError):
                wait(list(self.pending), timeout=_GLANCE, return_when="FIRST_COMPLETED")
            finished = [future for future in self.pending if future.status != "pending"]
            if any(future.status in ("cancelled", "lost") for future in finished):
                raise ClusterError(
                    "the Dask scheduler is gone; what is done is kept: start it again, and run the "
                    "same command"
                )
            self._look()
            if finished:
                return finished

    def _look(self) -> None:
        """Count the cores of the cluster now and then: it may grow, shrink, and vanish."""
        now = time.monotonic()
        if now - self.looked < _GLANCE:
            return
        self.looked, self.cores = now, self.cluster.cores()
        if self.cores:
            self.last_with_workers = now
        elif now - self.last_with_workers > _PATIENCE:
            raise ClusterError(
                f"there has been no worker for {_PATIENCE:g} s; what is done is kept: start "
                "workers, and run the same command"
            )

    def _take(self, future: Any) -> None:
        """Write what a worker sent back, or record why it did not."""
        batch = self.pending.pop(future)
        error = future.exception() if future.status == "error" else None
        if isinstance(error, VersionError | ImportError):
            raise ClusterError(f"{error}; install version {__version__} on every worker")
        if batch is None:
            if error is not None:
                raise error
            assert self.plan.gallery is not None
            self.writer.put_gallery(self.plan.gallery, future.result())
            return
        if type(error).__name__ == "KilledWorker" and not self.alone:
            self.suspects += batch.split()
            return
        outcome = _failed(batch, error) if error is not None else future.result()
        future.release()
        with clusters.deaf_to_interrupts():  # of what is counted, everything is written
            self.writer.put(batch, outcome)
            self.summary.add(batch, outcome)
        name, total = batch.ensemble.name, batch.ensemble.cases
        done = total - self.missing[name] + self.summary.done[name]
        self.report(name, done, self.summary.failed[name], total)


def _failed(batch: Batch, error: BaseException) -> Outcome:
    """Outcome of a batch that came to nothing."""
    killed = type(error).__name__ == "KilledWorker"
    why = (
        "its worker died again and again, perhaps for want of memory"
        if killed
        else f"{type(error).__name__}: {error}".splitlines()[0]
    )
    return Outcome({}, dict.fromkeys(range(len(batch.cells)), why))


def _check(scheduler: str | None, workers: int | None, threads: int | None) -> None:
    for name, value in (("workers", workers), ("threads", threads)):
        if value is not None and value < 1:
            raise InputError(f"{name} is {value}; at least 1 is needed")
    if scheduler is not None and workers is not None:
        raise InputError(
            "workers and a scheduler are given; the workers of a cluster are started there: leave "
            "one out"
        )


def _tell_all(plan: Plan, missing: dict[str, int], report: Progress) -> None:
    for ensemble in plan.ensembles:
        report(ensemble.name, ensemble.cases - missing[ensemble.name], 0, ensemble.cases)


def _log(store: Path, started: float, campaign: _Campaign, threads: int) -> None:
    """Add a line to the log beside the store: results do not depend on it, so it is not inside."""
    summary = campaign.summary
    entry = {
        "started": datetime.fromtimestamp(started, UTC).isoformat(timespec="seconds"),
        "seconds": round(time.time() - started, 1),
        "cores": campaign.cores,
        "threads": threads,
        "roughline_version": __version__,
        "done": dict(summary.done),
        "failed": dict(+summary.failed),
        "core_seconds": {name: round(value, 1) for name, value in summary.core_seconds.items()},
    }
    with suppress(OSError), log_of(store).open("a", encoding="utf-8") as file:
        file.write(json.dumps(entry) + "\n")


def log_of(store: Path) -> Path:
    """Return the file that says when and for how long was worked on a store."""
    return store.with_name(f"{store.name}.log")
