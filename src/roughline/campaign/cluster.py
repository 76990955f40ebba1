"""Workers: a Dask cluster on this machine, or one that already runs elsewhere."""

from __future__ import annotations

import asyncio
import logging
import multiprocessing
import queue
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from multiprocessing import resource_tracker
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from roughline._version import __version__
from roughline.campaign.batch import check_version
from roughline.errors import ClusterError, InputError

GONE = "the Dask scheduler is gone; what is done is kept: start it again and repeat the command"

_READY_WITHIN = 30.0  # a scheduler and its workers [s]
_ANSWER_WITHIN = 3.0  # a scheduler [s]
_SCHEMES = ("tcp", "tls", "ws", "wss")  # of addresses that lead to another machine
_ENVIRONMENT_KEY = "distributed.nanny.pre-spawn-environ"
# Dask makes its workers give freed memory back to the system at once; to get it again takes longer
# than an FFT, so here they keep it.
_KEEP_MEMORY = {
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_MMAP_THRESHOLD_": str(2**30),
    "MALLOC_TRIM_THRESHOLD_": str(2**30),
    "OMP_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
}
# For some pages of its dashboard, Dask samples the stacks of its workers and counts the ticks of
# its event loop. With short cases, this costs more than to send them and to store their results.
_WITHOUT_PROFILES = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.tick.limit": "10s",
}
# Dask may close a worker that still registers, and closes it again once it has registered. The
# second closing fails with a traceback, so a worker writes nothing to the terminal after the first.
_SILENT_WHEN_CLOSED = {
    "distributed.worker.preload": [
        """
import os

async def dask_teardown(worker):
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
"""
    ]
}
_CAMPAIGN_AT_IMPORT = 77  # exit code of a process in which to import a script starts a campaign


@dataclass(frozen=True)
class Cluster:
    """A cluster that is ready to compute."""

    client: Any  # the connection to it
    dashboard: str  # address of the page that shows what it does
    restore: Callable[[], object]  # starts new workers in place of those that were lost

    def cores(self) -> int:
        """Return how many cases it can compute at a time now."""
        self.restore()
        with answered():
            return sum(self.client.ncores().values())


@contextmanager
def answered() -> Iterator[None]:
    """Say that the scheduler is gone where what is asked of it in the context is not answered."""
    try:
        yield
    except (OSError, CancelledError) as error:  # the connection is closed, and not made anew
        raise ClusterError(GONE) from error


@contextmanager
def local(workers: int) -> Iterator[Cluster]:
    """Start workers on this machine, each for one case at a time; they end with the context."""
    import dask  # here because they load slowly
    from distributed import Client, LocalCluster

    # these hold for workers that are started later, too
    settings = _WITHOUT_PROFILES | _SILENT_WHEN_CLOSED | {_ENVIRONMENT_KEY: _KEEP_MEMORY}
    with _quiet(), dask.config.set(settings), ExitStack() as stack:
        with interrupts_held_back():
            try:
                cluster = stack.enter_context(
                    LocalCluster(
                        n_workers=workers,
                        threads_per_worker=1,
                        processes=True,
                        memory_limit=0,  # cases that do not fit are refused before
                        dashboard_address="127.0.0.1:0",
                        silence_logs=logging.CRITICAL,
                    )
                )
            except (OSError, RuntimeError, TimeoutError) as error:
                raise ClusterError(f"workers on this machine do not start ({error})") from error
            client = stack.enter_context(Client(cluster, set_as_default=False))
            stack.callback(_wait_for_starting_workers, cluster, client)
        # Dask gives up a worker that dies while it starts, unless it is asked for it again
        yield Cluster(client, client.dashboard_link, lambda: cluster.scale(workers))


def _wait_for_starting_workers(cluster: Any, client: Any) -> None:
    """Wait for workers that start in place of dead ones, before their cluster is closed.

    Dask may take a worker for started that still registers. If it closes it then, the worker
    closes twice, and sometimes never ends.
    """
    from distributed import Status

    deadline = time.monotonic() + _READY_WITHIN
    while time.monotonic() < deadline:
        running = [nanny for nanny in cluster.workers.values() if nanny.status == Status.running]
        # not by the cluster's own waiting, which loses what it was to be told of workers that leave
        workers = client.scheduler_info()["workers"].values()
        if sum(worker["status"] == Status.running.name for worker in workers) >= len(running):
            return
        time.sleep(0.1)


@contextmanager
def remote(address: str) -> Iterator[Cluster]:
    """Connect to the scheduler of a cluster with workers of this version of roughline."""
    from distributed import Client

    with _quiet():
        try:
            _hear_from(address)
            # as the default, a client that fails would break later calls that ask for a scheduler
            client = Client(address, timeout=_READY_WITHIN / 3, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            means = " with the certificates of Dask's configuration" if "tls:" in address else ""
            raise ClusterError(
                f"no Dask scheduler answers at {address}{means}; start one with `dask scheduler`, "
                "or leave the address out to compute on this machine"
            ) from error
        with client:
            with answered():
                _wait_for_workers(client, address)
                _check_versions(client)
            yield Cluster(client, client.dashboard_link, lambda: None)


def _wait_for_workers(client: Any, address: str) -> None:
    try:
        client.wait_for_workers(1, timeout=_READY_WITHIN)
    except TimeoutError as error:
        raise ClusterError(
            f"the scheduler at {address} has no workers; start some with `dask worker {address}`"
        ) from error


def refuse_senseless(address: str) -> None:
    """Refuse a text without host or port, or with a scheme that is none of a scheduler's."""
    try:
        parts = urlsplit(address if "://" in address else f"tcp://{address}")
        if parts.scheme in _SCHEMES and parts.hostname and parts.port and not parts.path:
            return
    except ValueError:  # of a port
        pass
    dashboard = ": http:// leads to its dashboard" if address.startswith("http") else ""
    raise InputError(
        f"scheduler is {address!r}; the address that `dask scheduler` prints is needed, such as "
        f"tcp://10.0.0.1:8786{dashboard}; leave it out to compute on this machine"
    )


def _hear_from(address: str) -> None:
    """Wait for the answer of a scheduler; raise an OSError where none comes.

    A client of Dask that fails ends with a traceback, and waits for ever for what is no scheduler.
    """
    from distributed import Security
    from distributed.comm.core import connect

    answer: queue.Queue[Exception | None] = queue.Queue()

    async def greet() -> None:
        secured = Security().get_connection_args("client")
        connection = await connect(address, timeout=_ANSWER_WITHIN, **secured)
        await connection.close()

    def listen() -> None:
        try:
            asyncio.run(greet())
        except Exception as error:  # of what it was taken for a scheduler, there are many
            answer.put(error)
        else:
            answer.put(None)

    threading.Thread(target=listen, daemon=True).start()
    try:
        error = answer.get(timeout=2 * _ANSWER_WITHIN)
    except queue.Empty:
        error = TimeoutError("no answer")
    if error is not None:
        raise OSError(str(error)) from error


def _check_versions(client: Any) -> None:
    for worker, answer in client.run(check_version, __version__, on_error="return").items():
        if "ModuleNotFoundError" in repr(answer):  # Dask wraps it in a plain Exception
            raise ClusterError(
                f"the worker at {worker} has no roughline; install version {__version__} there"
            )
        if isinstance(answer, Exception):
            raise ClusterError(f"{worker}: {answer}; install version {__version__} there")


@contextmanager
def interrupts_held_back() -> Iterator[None]:
    """Hold interrupts back until the end of the context, so that its block is completed first.

    Threads and processes that are started meanwhile never get an interrupt, so that their parent
    alone handles it. Dask starts all its workers, also later ones, from a thread that it starts
    with the first.
    """
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        with _blocked_for_children():
            yield
        return
    came: list[int] = []
    # a thread of some library may take the signal, whatever this thread blocks: so it is noted
    signal.signal(signal.SIGINT, lambda number, _: came.append(number))
    try:
        with _blocked_for_children():
            yield
    finally:
        signal.signal(signal.SIGINT, handler)
    if came:
        handler(signal.SIGINT, None)


@contextmanager
def _blocked_for_children() -> Iterator[None]:
    """Block interrupts of this thread, and of the threads and processes that it starts."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    resource_tracker.ensure_running()  # or it would let interrupts through when it starts
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep Dask's messages on workers that join, leave or get lost off the terminal."""
    # Dask gives some of its loggers handlers and levels of their own
    loggers = [
        logging.getLogger(name)
        for name in ("distributed", "asyncio", *logging.root.manager.loggerDict)
        if name.partition(".")[0] in ("distributed", "asyncio")
    ]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def refuse_unguarded_script() -> None:
    """Refuse a script that starts a campaign when it is imported, because every worker imports it.

    A trial process imports the script first. If it reaches this function there, it ends with an
    exit code of its own.
    """
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        sys.exit(_CAMPAIGN_AT_IMPORT)
    main = sys.modules["__main__"]
    if getattr(main, "__spec__", None) is not None or not hasattr(main, "__file__"):
        return  # a module run with -m, a notebook, a prompt
    if not Path(str(main.__file__)).exists():
        raise InputError(
            "a program from standard input cannot start workers, because they must import it: save "
            "it in a file"
        )
    # without a target: it imports the script, and nothing of this package that the script does not
    trial = multiprocessing.get_context("spawn").Process()
    with interrupts_held_back():
        trial.start()
        trial.join()
    if trial.exitcode == _CAMPAIGN_AT_IMPORT:
        raise InputError(
            "this script starts the campaign again whenever a worker imports it: put what it does "
            'under `if __name__ == "__main__":`'
        )
