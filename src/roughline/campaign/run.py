"""Computing a plan: the batches that a store lacks, on a Dask cluster, each written when done."""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

from roughline._version import __version__
from roughline.campaign import cluster as clusters
from roughline.campaign.batch import Batch, BatchResult, VersionError, evaluate
from roughline.campaign.cost import estimated_cost, refuse_more_than_disk, workers_that_fit
from roughline.campaign.plan import Plan
from roughline.campaign.writer import Writer, writing
from roughline.computing.cores import available_cores, processor_name
from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.status import Status
from roughline.errors import ClusterError, InputError
from roughline.errors.checks import refuse
from roughline.errors.public import public

_BYTES_PER_CASE = 500  # in the process that runs the campaign, which lists all cases
_BATCHES_PER_CORE = 4  # that are sent out at a time, so that no core waits for work
_CHECK_INTERVAL = 5.0  # between two looks at the cluster [s]
_LONGEST_WAIT_FOR_WORKERS = 60.0  # [s]

_CampaignProgress = Callable[[str, int, int, int], None]
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


@public
def run(
    plan: Plan,
    store: str | Path,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    threads: int | None = None,
    progress: _CampaignProgress | None = None,
    announce: Callable[[str], None] | None = None,
) -> Summary:
    """Compute the cases of a plan that a store does not hold yet.

    An interrupted run keeps every finished batch, and a further call continues from there.
    Results do not depend on the number of workers, on threads, or on the order. A case that fails
    is recorded with its reason, does not stop other cases, and is tried again by the next call.

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
        Called with (ensemble, cases done, cases failed, cases in all) after each batch, and once
        at the start.
    announce : callable, optional
        Called with lines for the user: what there is to do, and the dashboard's address.

    Returns
    -------
    Summary
        What this call did.

    Raises
    ------
    InputError
        If workers, threads and memory do not fit together, or do not suffice.
    StoreError
        If the store cannot be used or written.
    ClusterError
        If the cluster cannot be used, or is lost.
    KeyboardInterrupt
        On Ctrl-C; its message says where the finished results are.
    """
    report = progress or (lambda name, done, failed, total: None)
    say = announce or (lambda text: None)
    _check(scheduler, workers, threads)
    try:
        return _computed(plan, Path(store), scheduler, workers, threads, report, say)
    except KeyboardInterrupt:
        message = f"interrupted; what is done is kept in {store}: run again to go on"
        raise KeyboardInterrupt(message) from None


def _computed(
    plan: Plan,
    store: Path,
    scheduler: str | None,
    workers: int | None,
    threads: int | None,
    report: _CampaignProgress,
    say: Callable[[str], None],
) -> Summary:
    """Compute what a store lacks, as :func:`run` does, once its arguments are checked."""
    if scheduler is None:
        clusters.refuse_unguarded_script()
    _refuse_countless(plan)
    cluster = None
    with ExitStack() as stack:
        if not store.exists() or (store.is_dir() and not any(store.iterdir())):
            # a new store is made once its cluster is there: what is refused leaves nothing behind
            all_cases = {ensemble.name: ensemble.cases for ensemble in plan.ensembles}
            refuse_more_than_disk(plan, all_cases, store)
            cluster, threads = _started(stack, plan, all_cases, scheduler, workers, threads, say)
        with clusters.interrupts_held_back():
            writer = stack.enter_context(writing(store, plan))
            batches = {ensemble.name: writer.missing(ensemble) for ensemble in plan.ensembles}
        missing = {name: sum(len(batch.cells) for batch in each) for name, each in batches.items()}
        if not any(missing.values()):
            _report_all(plan, missing, report)
            return Summary()
        if cluster is None:
            refuse_more_than_disk(plan, missing, store)
            cluster, threads = _started(stack, plan, missing, scheduler, workers, threads, say)
        _report_all(plan, missing, report)
        dispatch = _Dispatch(writer, cluster, threads or 1, missing, report)
        started = time.time()
        try:
            dispatch.work(batches)
        finally:
            _log(store, started, dispatch)
        return dispatch.summary


def _started(
    stack: ExitStack,
    plan: Plan,
    missing: dict[str, int],
    scheduler: str | None,
    workers: int | None,
    threads: int | None,
    say: Callable[[str], None],
) -> tuple[clusters.Cluster, int | None]:
    """Return a cluster for cases that are missing, which ends with the stack, and its threads."""
    if scheduler is not None:
        cluster = stack.enter_context(clusters.remote(scheduler))
    cost = estimated_cost(plan, missing)
    if scheduler is None:
        workers = workers_that_fit(max(cost.memory, 1), workers)
        threads = _threads_that_fit(workers, threads)
        cluster = stack.enter_context(clusters.local(workers))
    say(f"{plan.name}: {cost.described(workers)}")
    say(f"dashboard: {cluster.dashboard}")
    return cluster, threads


def _threads_that_fit(workers: int, wanted: int | None) -> int:
    """Return how many threads each worker on this machine may have."""
    cores = available_cores()
    threads = wanted or max(1, cores // workers)
    if threads * workers > cores:
        raise InputError(
            f"{workers} workers with {threads} threads each are more than the {cores} "
            "cores of this machine: take fewer workers or fewer threads"
        )
    return threads


def _check(scheduler: str | None, workers: int | None, threads: int | None) -> None:
    for name, value in (("workers", workers), ("threads", threads)):
        if value is not None and value < 1:
            refuse(name, value, "at least 1 is needed")
    if scheduler is not None and workers is not None:
        raise InputError(
            "both workers and a scheduler are given; the workers of a cluster are started there: "
            "leave one of them out"
        )
    if scheduler is not None:
        clusters.refuse_senseless(scheduler)


def _report_all(plan: Plan, missing: dict[str, int], report: _CampaignProgress) -> None:
    for ensemble in plan.ensembles:
        report(ensemble.name, ensemble.cases - missing[ensemble.name], 0, ensemble.cases)


def _log(store: Path, started: float, dispatch: _Dispatch) -> None:
    """Add a line to the log, which lies beside the store because results do not depend on it."""
    summary = dispatch.summary
    entry = {
        "started": datetime.fromtimestamp(started, UTC).isoformat(timespec="seconds"),
        "seconds": round(time.time() - started, 1),
        "processor": processor_name(),
        "cores": dispatch.cores,
        "threads": dispatch.threads,
        "roughline_version": __version__,
        "done": dict(summary.done),
        "failed": dict(+summary.failed),
        "core_seconds": {name: round(value, 1) for name, value in summary.core_seconds.items()},
    }
    with suppress(OSError), log_path(store).open("a", encoding="utf-8") as file:
        file.write(json.dumps(entry) + "\n")


def log_path(store: Path) -> Path:
    """Return the file that says when, and for how long, runs worked on a store."""
    return store.with_name(f"{store.name}.log")


def _refuse_countless(plan: Plan) -> None:
    """Refuse a campaign with more cases than memory can list."""
    needed = _BYTES_PER_CASE * plan.cases
    refuse_beyond_memory(needed, f"a campaign of {plan.cases} cases", "split the plan")


class _Dispatch:
    """One run of a campaign: batches go out as workers ask for more, results are written."""

    def __init__(
        self,
        writer: Writer,
        cluster: clusters.Cluster,
        threads: int,
        missing: dict[str, int],
        report: _CampaignProgress,
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
        with clusters.answered():
            return self._cluster.client.submit(work, self.threads, __version__, pure=False)

    def _finished(self) -> list[Any]:
        """Wait until something has finished; raise if the cluster is lost."""
        from distributed import wait

        while True:
            # the states of the futures tell what either exception means
            with (
                clusters.answered(),
                self._cluster.client.as_current(),
                suppress(TimeoutError, CancelledError),
            ):
                wait(list(self._pending), timeout=_CHECK_INTERVAL, return_when="FIRST_COMPLETED")
            finished = [future for future in self._pending if future.status != "pending"]
            if any(future.status in ("cancelled", "lost") for future in finished):
                raise ClusterError(clusters.GONE)
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
        elif now - self._last_with_workers > _LONGEST_WAIT_FOR_WORKERS:
            raise ClusterError(
                f"there has been no worker for {_LONGEST_WAIT_FOR_WORKERS:g} s; what is done is "
                "kept: start workers and repeat the command"
            )

    def _take(self, future: Any) -> None:
        """Write what a worker sent back, or record why it did not."""
        batch = self._pending.pop(future)
        error = future.exception() if future.status == "error" else None
        if isinstance(error, VersionError | ImportError):
            raise ClusterError(
                f"{error}; install version {__version__}, and the modules of the plan's laws and "
                "half-spaces, on every worker"
            )
        if type(error).__name__ == "KilledWorker" and not self._alone:
            self._suspects += batch.split()
            return
        with clusters.answered():
            result = _failed(batch, error) if error is not None else future.result()
            future.release()
        with clusters.interrupts_held_back():  # so that what is written is counted too
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
