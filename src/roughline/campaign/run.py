"""Computing a plan: the batches that a store lacks, on a Dask cluster, each written when done."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from contextlib import ExitStack, suppress
from datetime import UTC, datetime
from pathlib import Path

from roughline._version import __version__
from roughline.campaign import cluster as clusters
from roughline.campaign.cost import cost_of, refuse_beyond_disk, refuse_countless, workers_that_fit
from roughline.campaign.dispatch import Dispatch, EnsembleProgress, Summary
from roughline.campaign.plan import Plan
from roughline.campaign.writer import writing
from roughline.computing.cores import available_cores, processor_name
from roughline.errors import InputError
from roughline.errors.checks import refuse
from roughline.errors.public import public


@public
def run(
    plan: Plan,
    store: str | Path,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    threads: int | None = None,
    progress: EnsembleProgress | None = None,
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
        kept = f"interrupted; what is done is kept in {store}: run again to go on"
        raise KeyboardInterrupt(kept) from None


def _computed(
    plan: Plan,
    store: Path,
    scheduler: str | None,
    workers: int | None,
    threads: int | None,
    report: EnsembleProgress,
    say: Callable[[str], None],
) -> Summary:
    """Compute what a store lacks, as :func:`run` does, once its arguments are checked."""
    if scheduler is None:
        clusters.refuse_unguarded_script()
    refuse_countless(plan)
    cluster = None
    with ExitStack() as stack:
        if not store.exists() or (store.is_dir() and not any(store.iterdir())):
            # a new store is made once its cluster is there: what is refused leaves nothing behind
            whole = {ensemble.name: ensemble.cases for ensemble in plan.ensembles}
            refuse_beyond_disk(plan, whole, store)
            cluster, threads = _started(stack, plan, whole, scheduler, workers, threads, say)
        with clusters.interrupts_held_back():
            writer = stack.enter_context(writing(store, plan))
            batches = {ensemble.name: writer.missing(ensemble) for ensemble in plan.ensembles}
        missing = {name: sum(len(batch.cells) for batch in each) for name, each in batches.items()}
        if not any(missing.values()):
            _report_all(plan, missing, report)
            return Summary()
        if cluster is None:
            refuse_beyond_disk(plan, missing, store)
            cluster, threads = _started(stack, plan, missing, scheduler, workers, threads, say)
        _report_all(plan, missing, report)
        dispatch = Dispatch(writer, cluster, threads or 1, missing, report)
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
    cost = cost_of(plan, missing)
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


def _report_all(plan: Plan, missing: dict[str, int], report: EnsembleProgress) -> None:
    for ensemble in plan.ensembles:
        report(ensemble.name, ensemble.cases - missing[ensemble.name], 0, ensemble.cases)


def _log(store: Path, started: float, dispatch: Dispatch) -> None:
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
    with suppress(OSError), log_of(store).open("a", encoding="utf-8") as file:
        file.write(json.dumps(entry) + "\n")


def log_of(store: Path) -> Path:
    """Return the file that says when, and for how long, runs worked on a store."""
    return store.with_name(f"{store.name}.log")
