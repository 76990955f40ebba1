"""Lanes of processes: who is served next, what replaces what, and what is stopped."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Any

from roughline.lab.process import Process
from roughline.lab.tasks import Outcome


@dataclass(frozen=True)
class Request:
    """One thing that a page asks for.

    Attributes
    ----------
    session, slot : str
        Who asks, and for which part of the page: a newer request for it takes the place of an
        older one.
    task : str
        One of :data:`roughline.lab.tasks.TASKS`.
    arguments : mapping
        Of the task.
    answer : callable
        Told the outcome, unless the request was replaced or withdrawn.
    progress : callable
        Told (steps done, steps in all).
    """

    session: str
    slot: str
    task: str
    arguments: Mapping[str, Any]
    answer: Callable[[Outcome], None]
    progress: Callable[[int, int], None]

    @property
    def key(self) -> tuple[str, str]:
        """What a newer request must share to take its place."""
        return self.session, self.slot


@dataclass(frozen=True)
class Limits:
    """What one task may take.

    Attributes
    ----------
    seconds : float
        Time. [s]
    memory : int
        Memory beside the program. [bytes]
    """

    seconds: float
    memory: int


class Lane:
    """Some processes and the requests that wait for them, first come, first served.

    Parameters
    ----------
    count : int
        Number of processes that work side by side.
    limits : Limits
        Of one task.
    lasting : bool
        Whether a process does many tasks. If not, each task has a process of its own; it is stopped
        when its request is withdrawn or replaced, and its memory is given back at its end.
    """

    def __init__(self, count: int, limits: Limits, *, lasting: bool) -> None:
        self._count, self._limits, self._lasting = count, limits, lasting
        self._waiting: dict[tuple[str, str], Request] = {}
        self._running: dict[tuple[str, str], tuple[Request, Process]] = {}
        self._busy = self._starting = 0
        self._idle: list[Process] = []
        self._work: set[asyncio.Task[None]] = set()
        self._threads = ThreadPoolExecutor(2 * count, thread_name_prefix="roughline lab")
        self._closed = False

    def submit(self, request: Request) -> None:
        """Take a request; one that waits for the same part of the same page gives it its place."""
        self._waiting[request.key] = request
        if not self._lasting and request.key in self._running:
            self._stop(request.key)
        self._start()

    def withdraw(self, session: str, slot: str | None = None) -> None:
        """Forget what a page has asked for, or one part of it, and stop it if it runs."""

        def is_meant(key: tuple[str, str]) -> bool:
            return key[0] == session and slot in (None, key[1])

        for key in [key for key in self._waiting if is_meant(key)]:
            del self._waiting[key]
        for key in [key for key in self._running if is_meant(key)]:
            self._stop(key)

    @property
    def pids(self) -> list[int]:
        """Numbers of its processes in the system."""
        processes = [*self._idle, *(process for _, process in self._running.values())]
        return [process.pid for process in processes if process.pid is not None]

    async def prepare(self) -> None:
        """Start processes ahead of the first request."""
        loop = asyncio.get_running_loop()
        while len(self._idle) + self._busy + self._starting < self._count and not self._closed:
            self._starting += 1
            try:
                process = await loop.run_in_executor(self._threads, Process, self._limits.memory)
            finally:
                self._starting -= 1
            self._put_back(process, is_new=True)

    def close(self) -> None:
        """Stop everything."""
        self._closed = True
        self._waiting.clear()
        for key in list(self._running):
            self._stop(key)
        while self._idle:
            self._idle.pop().stop()
        self._threads.shutdown(wait=False)

    def _start(self) -> None:
        """Start what waits, as far as there are processes for it."""
        for key, request in list(self._waiting.items()):
            if self._busy >= self._count or self._closed:
                return
            if key in self._running:  # its own turn comes when the older one has ended
                continue
            del self._waiting[key]
            self._busy += 1
            crowded = len(self._waiting) >= 2 * self._count
            arguments = {**request.arguments, "crowded": crowded}
            task = asyncio.create_task(self._do(replace(request, arguments=arguments)))
            self._work.add(task)
            task.add_done_callback(self._work.discard)

    async def _do(self, request: Request) -> None:
        """Do one task in a process, and serve the next."""
        loop = asyncio.get_running_loop()

        def progress(done: int, total: int) -> None:
            loop.call_soon_threadsafe(request.progress, done, total)

        process: Process | None = None
        while self._idle and process is None:
            spare = self._idle.pop()
            process = spare if spare.is_alive else None
        try:
            if process is None:
                process = await loop.run_in_executor(self._threads, Process, self._limits.memory)
            self._running[request.key] = request, process
            asked = loop.run_in_executor(
                self._threads, process.ask, request.task, request.arguments, progress
            )
            try:
                outcome = await asyncio.wait_for(asyncio.shield(asked), self._limits.seconds)
            except TimeoutError:
                process.stop()
                outcome = Outcome(
                    error=f"this took longer than the {self._limits.seconds:g} s that one request "
                    "may take: take fewer points or loads"
                )
            if self._running.pop(request.key, None) is not None:
                request.answer(outcome)
        finally:
            self._busy -= 1
            if process is not None:
                self._put_back(process, is_new=False)
            self._start()
        if not self._closed:
            await self.prepare()

    def _put_back(self, process: Process, *, is_new: bool) -> None:
        """Keep a process for the next request, or stop it."""
        if (is_new or self._lasting) and process.is_alive and not self._closed:
            self._idle.append(process)
        else:
            process.stop()

    def _stop(self, key: tuple[str, str]) -> None:
        """Stop what runs; a lasting process finishes its short task, and is not listened to."""
        _, process = self._running.pop(key)
        if not self._lasting or self._closed:
            process.stop()
