"""Lanes of processes: which request is next, which replaces another, and which is stopped."""

from __future__ import annotations

import asyncio
import logging
import time
from collections import Counter
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

from roughline.lab.server.budget import LaneLimits
from roughline.lab.server.process import LOST, LOWEST_PRIORITY, NOT_BEGUN, Process
from roughline.lab.server.tasks import Place, TaskOutcome

_log = logging.getLogger(__name__)
_LETS_PASS_AFTER = 1.5  # after which a task lets shorter ones pass [s]
_UNCROWDED_WAIT = 0.05  # that a request may wait without a crowd [s]
_CROWD_PER_PROCESS = 2  # requests that wait for each process, from which on answers are coarser
MOST_PARTS = 16  # of a page that may wait for something at once
TOO_MANY = TaskOutcome(error="too many requests of this page wait: let some end first")
_MOST_TRIES = 5  # of processes that may be gone before they have their task
_MOST_TASKS = 500  # of one process, before a fresh one takes its place


@dataclass(eq=False)
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
    answer: Callable[[TaskOutcome], None]
    progress: Callable[[int, int], None]  # told (steps done, steps in all)
    # when it, or an older one that it replaced, began to wait, on the monotonic clock [s]
    since: float = field(default_factory=time.monotonic)
    # while it is served: by which process, and whether it is still wanted, and takes long
    process: Process | None = field(default=None, init=False)
    is_wanted: bool = field(default=True, init=False)
    is_long: bool = field(default=False, init=False)
    tries: int = field(default=0, init=False)

    @property
    def key(self) -> tuple[str, str]:
        """What a newer request must share to take its place."""
        return self.session, self.slot


class Lane:
    """Some processes and the requests that wait for them: first come, first served.

    Requests that refine an answer that a page already has go last. Addresses with fewer running
    tasks go first, and among the pages of an address those with fewer running tasks. A process of a
    lasting lane finishes its task even if it is no longer wanted; in others it is stopped when its
    request is withdrawn or replaced.
    """

    def __init__(self, limits: LaneLimits, *, lasting: bool) -> None:
        self.limits, self._lasting = limits, lasting
        self._waiting: dict[tuple[str, str], Request] = {}
        # with those no longer wanted, until their processes are free again or gone
        self._served: dict[Request, asyncio.Task[None]] = {}
        self._idle: list[Process] = []
        self._threads = ThreadPoolExecutor(2 * limits.most + 2, thread_name_prefix="roughline lab")
        self._closed = False

    def submit(self, request: Request) -> None:
        """Take a request; it replaces one that waits for the same part of the same page."""
        if (older := self._waiting.get(request.key)) is not None:
            request.since = older.since
        elif sum(each.session == request.session for each in self._waiting.values()) >= MOST_PARTS:
            return request.answer(TOO_MANY)
        if not self._lasting:
            self.withdraw(*request.key)
        self._waiting[request.key] = request
        self._start()

    def withdraw(self, session: str, slot: str | None = None) -> list[asyncio.Task[None]]:
        """Forget what a page has asked for, or one part of it.

        Returns the work that ends when what is stopped is gone. A lasting process finishes its
        short task, and its answer is ignored.
        """
        own = [
            each
            for each in (*self._waiting.values(), *self._served)
            if each.session == session and slot in (None, each.slot)
        ]
        for each in own:
            self._waiting.pop(each.key, None)
            each.is_wanted = False
            if not self._lasting and each.process is not None:
                each.process.stop()
        return [] if self._lasting else [self._served[each] for each in own if each in self._served]

    async def prepare(self) -> None:
        """Start processes ahead of the first request."""
        self._fill()
        begun = (asyncio.wrap_future(each.begun) for each in self._idle)
        await asyncio.gather(*begun, return_exceptions=True)  # who asks is told of failures

    def renew(self) -> None:
        """Give back the memory of processes that have done a task and wait for the next one."""
        for process in [each for each in self._idle if each.tasks]:
            self._idle.remove(process)
            self._threads.submit(process.end)
        self._fill()

    async def close(self) -> None:
        """Stop everything, and wait until it is gone."""
        self._closed = True
        self._waiting.clear()
        for request in self._served:
            request.is_wanted = False
            if request.process is not None:
                request.process.stop()
        await asyncio.gather(*self._served.values(), return_exceptions=True)
        while self._idle:
            self._idle.pop().end()
        self._threads.shutdown(wait=False)

    def _start(self) -> None:
        """Serve who is next, as far as there are processes."""
        while (request := self._next()) is not None:
            del self._waiting[request.key]
            many = len(self._waiting) >= _CROWD_PER_PROCESS * self.limits.count
            crowded = many or time.monotonic() - request.since > _UNCROWDED_WAIT
            self._served[request] = asyncio.create_task(self._serve(request, crowded))

    def _next(self) -> Request | None:
        """Who is served next; none if nobody waits, or all processes are busy."""
        short = sum(not each.is_long for each in self._served)
        if self._closed or short >= self.limits.count or len(self._served) >= self.limits.most:
            return None
        pages = Counter(each.session for each in self._served)
        addresses = Counter(each.address for each in self._served)
        running = {each.key for each in self._served if each.is_wanted}
        free = [
            each
            for key, each in self._waiting.items()
            if key not in running and pages[each.session] < self.limits.per_session
        ]

        def turn(its: Request) -> tuple[bool, int, int, float]:
            refines = its.arguments.get("refines") is True
            return refines, addresses[its.address], pages[its.session], its.since

        return min(free, key=turn, default=None)

    async def _serve(self, request: Request, crowded: bool) -> None:
        """Serve one request, and then the next."""
        process = request.process = self._spare()
        outcome = LOST
        try:
            await asyncio.wrap_future(process.begun)
            if request.is_wanted:
                outcome = await self._outcome(request, process, crowded)
        except Exception:  # such as no process to be had, or an argument that cannot be sent
            _log.exception("%s failed in the server", request.place)
        request.process, request.tries = None, request.tries + 1
        try:
            if request.is_wanted and outcome is NOT_BEGUN and request.tries < _MOST_TRIES:
                self._waiting.setdefault(request.key, request)
            elif request.is_wanted:
                request.is_wanted = False
                request.answer(outcome)
            await self._put_back(process, has_read=request.place.reads_files)
        finally:
            del self._served[request]
            self._start()
            self._fill()

    async def _outcome(self, request: Request, process: Process, crowded: bool) -> TaskOutcome:
        """Have a request done by a process."""
        loop, seconds = asyncio.get_running_loop(), self.limits.seconds

        def progress(done: int, total: int) -> None:
            loop.call_soon_threadsafe(request.progress, done, total)

        arguments = {**request.arguments, "crowded": crowded}
        asked = loop.run_in_executor(self._threads, process.ask, request.place, arguments, progress)
        later = loop.call_later(_LETS_PASS_AFTER, self._let_pass, request, process)
        done, _ = await asyncio.wait([asked], timeout=seconds)
        later.cancel()
        if done:
            return asked.result()
        process.stop()
        await asked
        return TaskOutcome(
            error=f"this took longer than the {seconds:g} s that one request may take: take fewer "
            "points or loads"
        )

    def _let_pass(self, request: Request, process: Process) -> None:
        """Let others start beside a task that takes long, and go before it."""
        request.is_long = True
        if not self._lasting:
            process.lower_priority(LOWEST_PRIORITY)
        self._start()

    def _fill(self) -> None:
        """Have processes stand by."""
        wanted = max(self.limits.count - len(self._served), 0 if self._lasting else 1)
        while not self._closed and len(self._idle) < wanted:
            self._idle.append(self._new_process())

    def _spare(self) -> Process:
        """A process that stands by, or a new one."""
        while self._idle:
            process = self._idle.pop(0)
            if process.is_alive:
                return process
            self._threads.submit(process.end)
        return self._new_process()

    def _new_process(self) -> Process:
        return Process(self._threads, self.limits.memory, gives_way=not self._lasting)

    async def _put_back(self, process: Process, *, has_read: bool) -> None:
        """Keep a process for the next request, or end it; one that has read a file is ended."""
        is_wanted = self._lasting or len(self._idle) < self.limits.count
        is_fit = process.is_alive and process.tasks < _MOST_TASKS and not has_read
        if is_fit and is_wanted and not self._closed:
            self._idle.append(process)
        else:
            await asyncio.get_running_loop().run_in_executor(self._threads, process.end)
