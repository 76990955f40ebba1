"""Lanes of processes: which request is next, which replaces another, and which is stopped."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

from roughline.lab.server.process import LOST, Process
from roughline.lab.server.tasks import Place, TaskOutcome

_log = logging.getLogger(__name__)


@dataclass(eq=False)
class Request:
    """One thing that a page asks for."""

    # which page asks, and for which of its parts: a newer request for the same part replaces an
    # older one
    session: str
    slot: str
    place: Place  # where the task is
    arguments: Mapping[str, Any]  # of the task
    # told the outcome, unless the request was replaced or withdrawn
    answer: Callable[[TaskOutcome], None]
    progress: Callable[[int, int], None]  # told (steps done, steps in all)
    # while it is served: by which process, and whether it is still wanted
    process: Process | None = field(default=None, init=False)
    is_wanted: bool = field(default=True, init=False)

    @property
    def key(self) -> tuple[str, str]:
        """What a newer request must share to take its place."""
        return self.session, self.slot


class Lane:
    """Some processes and the requests that wait for them: first come, first served.

    Each task may take so much memory beside the program. [bytes] A process of a lasting lane
    finishes its task even if it is no longer wanted; in others it is stopped when its request is
    withdrawn or replaced.
    """

    def __init__(self, count: int, memory: float, *, lasting: bool) -> None:
        self._count, self._memory, self._lasting = count, memory, lasting
        self._waiting: dict[tuple[str, str], Request] = {}
        # with those no longer wanted, until their processes are free again or gone
        self._served: dict[Request, asyncio.Task[None]] = {}
        self._idle: list[Process] = []
        self._threads = ThreadPoolExecutor(2 * count + 2, thread_name_prefix="roughline lab")
        self._closed = False

    def submit(self, request: Request) -> None:
        """Take a request; it replaces one that waits for the same part of the same page."""
        if not self._lasting and request.key not in self._waiting:  # it has its place in turn
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
            self._served[request] = asyncio.create_task(self._serve(request))

    def _next(self) -> Request | None:
        """Who is served next; none if nobody waits, or all processes are busy."""
        if self._closed or len(self._served) >= self._count:
            return None
        running = {each.key for each in self._served if each.is_wanted}
        return next((each for key, each in self._waiting.items() if key not in running), None)

    async def _serve(self, request: Request) -> None:
        """Serve one request, and then the next."""
        process = request.process = self._spare()
        outcome = LOST
        try:
            await asyncio.wrap_future(process.begun)
            if request.is_wanted:
                outcome = await self._outcome(request, process)
        except Exception:  # such as no process to be had, or an argument that cannot be sent
            _log.exception("%s failed in the server", request.place)
        request.process = None
        try:
            if request.is_wanted:
                request.is_wanted = False
                request.answer(outcome)
            await self._put_back(process, has_read=request.place.reads_files)
        finally:
            del self._served[request]
            self._start()
            self._fill()

    async def _outcome(self, request: Request, process: Process) -> TaskOutcome:
        """Have a request done by a process."""
        loop, place, arguments = asyncio.get_running_loop(), request.place, request.arguments

        def progress(done: int, total: int) -> None:
            loop.call_soon_threadsafe(request.progress, done, total)

        return await loop.run_in_executor(self._threads, process.ask, place, arguments, progress)

    def _fill(self) -> None:
        """Have processes stand by."""
        wanted = max(self._count - len(self._served), 0 if self._lasting else 1)
        while not self._closed and len(self._idle) < wanted:
            self._idle.append(self._new_process())

    def _spare(self) -> Process:
        """A process that stands by, or a new one."""
        while self._idle:
            process = self._idle.pop()  # the one that has worked last, which knows the surface
            if process.is_alive:
                return process
            self._threads.submit(process.end)
        return self._new_process()

    def _new_process(self) -> Process:
        return Process(self._threads, self._memory, gives_way=not self._lasting)

    async def _put_back(self, process: Process, *, has_read: bool) -> None:
        """Keep a process for the next request, or end it; one that has read a file is ended."""
        is_wanted = self._lasting or len(self._idle) < self._count
        is_fit = process.is_alive and not has_read
        if is_fit and is_wanted and not self._closed:
            self._idle.append(process)
        else:
            await asyncio.get_running_loop().run_in_executor(self._threads, process.end)
