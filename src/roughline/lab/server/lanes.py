"""Lanes of processes: which request is next, which replaces another, and which is stopped."""

from __future__ import annotations

import asyncio
import logging
import time
from collections import Counter
from collections.abc import Callable, Coroutine, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from roughline.lab.server.budget import Limits
from roughline.lab.server.process import LOST, LOWEST, NOT_BEGUN, Process
from roughline.lab.server.tasks import Outcome, Place

_log = logging.getLogger(__name__)
_PATIENCE = 1.5  # after which a task lets shorter ones pass [s]
_SOON = 0.05  # that a request may wait without a crowd [s]
_CROWD = 2  # requests that wait for each process, from which on answers are coarser
_MOST_PARTS = 16  # of a page that may wait for something at once
_MOST_TRIES = 5  # of processes that may be gone before they have their task
_MOST_TASKS = 500  # of one process, before a fresh one takes its place


@dataclass(frozen=True)
class Request:
    """One thing that a page asks for."""

    # where the page is, which page asks, and for which of its parts: a newer request for the same
    # part replaces an older one
    address: str
    session: str
    slot: str
    place: Place  # where the task is
    # of the task; with "refines" it refines an existing answer, and lets other requests pass
    arguments: Mapping[str, Any]
    # told the outcome, unless the request was replaced or withdrawn
    answer: Callable[[Outcome], None]
    progress: Callable[[int, int], None]  # told (steps done, steps in all)
    # when it, or an older one that it replaced, began to wait, on the monotonic clock [s]
    since: float = field(default_factory=time.monotonic)

    @property
    def key(self) -> tuple[str, str]:
        """What a newer request must share to take its place."""
        return self.session, self.slot

    @property
    def refines(self) -> bool:
        """Whether it makes an answer finer that is there already."""
        return self.arguments.get("refines") is True


@dataclass(eq=False)
class _Job:
    """A request that is being served."""

    request: Request
    process: Process | None = None
    is_wanted: bool = True
    is_long: bool = False


class Lane:
    """Some processes and the requests that wait for them: first come, first served.

    Requests that refine an answer that a page already has go last. Addresses with fewer running
    tasks go first, and among the pages of an address those with fewer running tasks. A process of a
    lasting lane finishes its task even if it is no longer wanted; in others it is stopped when its
    request is withdrawn or replaced.
    """

    def __init__(self, limits: Limits, *, lasting: bool) -> None:
        self._limits, self._lasting = limits, lasting
        self._waiting: dict[tuple[str, str], Request] = {}
        self._running: dict[tuple[str, str], _Job] = {}  # those that are wanted
        self._jobs: set[_Job] = set()
        self._starting = 0
        self._idle: list[Process] = []
        self._work: set[asyncio.Task[None]] = set()
        self._threads = ThreadPoolExecutor(2 * limits.most + 2, thread_name_prefix="roughline lab")
        self._closed = False

    def submit(self, request: Request) -> None:
        """Take a request; it replaces one that waits for the same part of the same page."""
        asked = sum(key[0] == request.session for key in self._waiting)
        if request.key not in self._waiting and asked >= _MOST_PARTS:
            return request.answer(
                Outcome(error="too many requests of this page wait: let some end, then ask again")
            )
        older = self._waiting.get(request.key, request)
        self._waiting[request.key] = replace(request, since=older.since)
        if not self._lasting:
            self._stop(request.key)
        self._start()

    def withdraw(self, session: str, slot: str | None = None) -> list[Process]:
        """Forget what a page has asked for, or one part of it; returns processes that are stopped.

        A lasting process finishes its short task, and its answer is ignored.
        """

        def is_meant(key: tuple[str, str]) -> bool:
            return key[0] == session and slot in (None, key[1])

        for key in filter(is_meant, list(self._waiting)):
            del self._waiting[key]
        stopped = [self._stop(key) for key in filter(is_meant, list(self._running))]
        return [process for process in stopped if process is not None]

    @property
    def pids(self) -> list[int]:
        """Numbers of its processes in the system."""
        busy = [job.process.pid for job in self._jobs if job.process is not None]
        return [process.pid for process in self._idle] + busy

    @property
    def most(self) -> int:
        """Largest number of its processes that compute at once."""
        return self._limits.most

    async def prepare(self) -> None:
        """Start processes ahead of the first request."""
        await self._begin(self._fill())

    def renew(self) -> None:
        """Give back the memory of processes that have done a task and wait for the next one."""
        used = [process for process in self._idle if process.tasks]
        self._idle = [process for process in self._idle if not process.tasks]
        for process in used:
            self._threads.submit(process.end)
        self._begin(self._fill())

    async def close(self) -> None:
        """Stop everything, and wait until it is gone."""
        self._closed = True
        self._waiting.clear()
        for job in self._jobs:
            job.is_wanted = False
            if job.process is not None:
                job.process.stop()
        await asyncio.gather(*self._work, return_exceptions=True)
        while self._idle:
            self._idle.pop().end()
        self._threads.shutdown(wait=False)

    def _begin(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        """Begin work that has to end before the lane is closed."""
        task = asyncio.create_task(work)
        self._work.add(task)
        task.add_done_callback(self._work.discard)
        return task

    async def _fill(self) -> None:
        """Have processes stand by."""
        while not self._closed and self._wants_spare():
            try:
                process = await self._new_process()
            except OSError:
                return _log.exception("no process could be started")
            if not process.is_alive:
                return _log.error("a process that was started ended at once")
            await self._put_back(process)

    def _wants_spare(self) -> bool:
        """Whether a process more should stand by."""
        least = 0 if self._lasting else 1
        wanted = max(self._limits.count - len(self._jobs), least)
        return len(self._idle) + self._starting < wanted

    def _start(self) -> None:
        """Serve who is next, as far as there are processes."""
        while (request := self._next()) is not None:
            del self._waiting[request.key]
            job = _Job(request)
            self._jobs.add(job)
            self._running[request.key] = job
            many = len(self._waiting) >= _CROWD * self._limits.count
            crowded = many or time.monotonic() - request.since > _SOON
            self._begin(self._do(job, crowded))

    def _next(self) -> Request | None:
        """Who is served next; none if nobody waits, or all processes are busy."""
        short = sum(not job.is_long for job in self._jobs)
        if self._closed or short >= self._limits.count or len(self._jobs) >= self._limits.most:
            return None
        pages = Counter(job.request.session for job in self._jobs)
        addresses = Counter(job.request.address for job in self._jobs)
        free = [
            request
            for key, request in self._waiting.items()
            if key not in self._running and pages[request.session] < self._limits.per_session
        ]

        def turn(its: Request) -> tuple[bool, int, int]:
            return its.refines, addresses[its.address], pages[its.session]

        return min(free, key=turn, default=None)

    async def _do(self, job: _Job, crowded: bool) -> None:
        """Serve one request, and then the next."""
        outcome = LOST
        try:
            outcome = await self._outcome(job, crowded)
        except Exception:  # such as no process to be had, or an argument that cannot be sent
            _log.exception("%s failed in the server", job.request.place)
        finally:
            self._jobs.discard(job)
            if self._running.get(job.request.key) is job:
                del self._running[job.request.key]
            if job.is_wanted:
                job.request.answer(outcome)
            self._start()
            if job.process is not None:
                await self._put_back(job.process, job.request.place)
        await self._fill()

    async def _outcome(self, job: _Job, crowded: bool) -> Outcome:
        """Have a request done by a process, or by another one if the first had already ended."""
        outcome = NOT_BEGUN
        for _ in range(_MOST_TRIES):
            process = job.process = self._spare() or await self._new_process()
            if not job.is_wanted:
                return LOST
            outcome = await self._outcome_of(process, job, crowded)
            if outcome is not NOT_BEGUN or not job.is_wanted:
                break
            self._threads.submit(process.end)
        return outcome

    async def _outcome_of(self, process: Process, job: _Job, crowded: bool) -> Outcome:
        """Have a request done by this process."""
        loop = asyncio.get_running_loop()
        request, seconds = job.request, self._limits.seconds

        def tell(done: int, total: int) -> None:
            if job.is_wanted:
                request.progress(done, total)

        def progress(done: int, total: int) -> None:
            with suppress(RuntimeError):  # the loop is closed
                loop.call_soon_threadsafe(tell, done, total)

        arguments = {**request.arguments, "crowded": crowded}
        later = loop.call_later(_PATIENCE, self._let_pass, job)
        asked = loop.run_in_executor(self._threads, process.ask, request.place, arguments, progress)
        try:
            return await asyncio.wait_for(asyncio.shield(asked), seconds)
        except TimeoutError:
            process.stop()
            await asked
            return Outcome(
                error=f"this took longer than the {seconds:g} s that one request may take: take "
                "fewer points or loads"
            )
        finally:
            later.cancel()

    def _let_pass(self, job: _Job) -> None:
        """Let others start beside a task that takes long, and go before it."""
        job.is_long = True
        if job.process is not None and not self._lasting:
            job.process.lower_priority(LOWEST)
        self._start()

    def _spare(self) -> Process | None:
        """A process that stands by."""
        while self._idle:
            process = self._idle.pop(0)
            if process.is_alive:
                return process
            self._threads.submit(process.end)
        return None

    async def _new_process(self) -> Process:
        loop = asyncio.get_running_loop()
        self._starting += 1
        try:
            start = partial(Process, self._limits.memory, gives_way=not self._lasting)
            return await loop.run_in_executor(self._threads, start)
        finally:
            self._starting -= 1

    async def _put_back(self, process: Process, did: Place | None = None) -> None:
        """Keep a process for the next request, or end it; one that has read a file is ended."""
        has_read = did is not None and did.reads_files
        is_wanted = self._lasting or len(self._idle) < self._limits.count
        is_fit = process.is_alive and process.tasks < _MOST_TASKS and not has_read
        if is_fit and is_wanted and not self._closed:
            self._idle.append(process)
        else:
            await asyncio.get_running_loop().run_in_executor(self._threads, process.end)

    def _stop(self, key: tuple[str, str]) -> Process | None:
        """Stop what runs for a part of a page, if anything does."""
        job = self._running.pop(key, None)
        if job is None:
            return None
        job.is_wanted = False
        if self._lasting or job.process is None:
            return None
        job.process.stop()
        return job.process
