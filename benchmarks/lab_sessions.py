"""How soon the lab answers one page and 20 at once, and the memory of it.

All pages are plain websockets in this process; each has a seed of its own. They ask all at the same
instant (burst), or each moves a slider ten times a second for two seconds and rests then (people).
The time of an answer ends when the page has it all; that of the browser comes on top.
``make lab-sessions`` writes a part of ``docs/measured.md``.
"""

import asyncio
import json
import statistics
import sys
import tempfile
import time
from collections import defaultdict
from contextlib import suppress
from pathlib import Path

import page
import psutil
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from lab.server.serving import entered, running_lab

SESSIONS, LONELY_ROUNDS, MOVES, PAUSE = 20, 7, 20, 0.1
ASKED = {
    "explore.reduced": "reduced curve",
    "explore.coarse": "coarse contact",
    "explore.full": "contact at rest",
}
TASKS = tuple(ASKED)


class Page:
    """One page: a websocket, and when its questions were asked and answered."""

    def __init__(self, socket, seed):
        self.socket, self.seed, self.number, self.asked = socket, seed, 0, {}
        self.waiting: dict[int, asyncio.Future] = {}
        self.reading = asyncio.create_task(self._read())

    @classmethod
    async def open(cls, address, cookie, seed):
        url = f"ws{address.removeprefix('http')}/link"
        headers = {"Origin": address, "Cookie": cookie}
        socket = await websocket_connect(HTTPRequest(url, headers=headers), max_message_size=2**28)
        await socket.read_message()
        return cls(socket, seed)

    async def _read(self):
        while (message := await self.socket.read_message()) is not None:
            if isinstance(message, str) and "error" not in json.loads(message):
                continue  # progress
            number = int.from_bytes(message[:8], "little") if isinstance(message, bytes) else None
            if number is None:
                number, error = json.loads(message)["id"], json.loads(message)["error"]
                self.waiting[number].set_exception(RuntimeError(error))
            elif not self.waiting[number].done():
                self.waiting[number].set_result(message)

    async def ask(self, task, force="0.1", refines=False):
        """Ask; return the seconds until all of the answer is here, and whether it is coarse."""
        self.number += 1
        answer = self.waiting[self.number] = asyncio.get_running_loop().create_future()
        started = time.perf_counter()
        arguments = {"state": {"seed": str(self.seed), "F": force}, "refines": refines}
        slot = f"{task} finer" if refines else task
        said = {"id": self.number, "slot": slot, "task": task, "arguments": arguments}
        self.socket.write_message(json.dumps(said))
        message = await answer
        taken = time.perf_counter() - started
        length = int.from_bytes(message[8:12], "little")
        return taken, bool(json.loads(message[12 : 12 + length]).get("is_coarse"))

    async def ask_twice(self, task, times, force="0.1"):
        """Ask, and again if the first answer was one for a crowd; keep both times."""
        taken, is_coarse = await self.ask(task, force)
        times[task].append(taken)
        if is_coarse and task != "explore.coarse":
            taken += (await self.ask(task, force, refines=True))[0]
        times[f"{task}, all of it"].append(taken)

    async def move(self, times):
        """Move the load for two seconds, then rest; keep the times of answers that came."""
        pending = defaultdict(list)
        for move in range(MOVES):
            for task in ("explore.reduced", "explore.coarse"):
                asked = asyncio.create_task(self.ask(task, f"{0.05 + 0.01 * move:.3g}"))
                pending[task].append(asked)
            await asyncio.sleep(PAUSE)
        await asyncio.sleep(0.25)
        await self.ask_twice("explore.full", times, f"{0.04 + 0.01 * MOVES:.3g}")
        for task, all_asked in pending.items():
            await all_asked[-1]  # the last one is never replaced
            times[f"{task}, last move"].append(all_asked[-1].result()[0])
            times[task] += [asked.result()[0] for asked in all_asked if asked.done()]
            for asked in all_asked:
                asked.cancel()

    async def close(self):
        self.socket.close()
        await self.reading


def row(times, lonely):
    """How many times there are, and their percentiles beside the lonely median."""
    parts = page.percentiles(times)
    return len(times), *(f"{1e3 * part:.0f} ms, {part / lonely:.1f}" for part in parts)


def megabytes(server):
    """What a server, and each of its processes, hold for themselves."""
    own = []
    for each in (server, *server.children(recursive=True)):
        with suppress(psutil.Error):  # it has ended meanwhile
            own.append(each.memory_full_info().uss / 1e6)
    return own


async def measure(address, cookie, pid):
    """Measure one page, and many; write the tables."""
    server = psutil.Process(pid)
    before = megabytes(server)
    lone = await Page.open(address, cookie, 1000)
    lonely = {}
    for task in TASKS:
        await lone.ask(task)
        taken = []
        for lone.seed in range(1000, 1000 + LONELY_ROUNDS):
            taken.append((await lone.ask(task))[0])
            await asyncio.sleep(0.1)
        lonely[task] = statistics.median(taken)
    await lone.close()
    pages = [await Page.open(address, cookie, seed) for seed in range(SESSIONS)]
    burst, people = defaultdict(list), defaultdict(list)
    for task in TASKS:
        for each in pages:
            each.seed += SESSIONS
        await asyncio.gather(*(each.ask_twice(task, burst) for each in pages))
    await asyncio.gather(*(each.move(people) for each in pages))
    during = megabytes(server)
    await asyncio.gather(*(each.close() for each in pages))
    await asyncio.sleep(1)
    written = page.Page("sessions", "measured.md", "lab-sessions")
    written.say(
        f"{SESSIONS} pages ask for the same at once, and then move a slider {MOVES} times in two "
        "seconds each. Beside each time stands how often it holds that of one page alone. A first "
        "answer may be a coarser one; the whole is all of it."
    )
    percentiles = ("answers", "median", "95th percentile", "worst")
    written.table("question", "when", "one page alone", *percentiles, at_most=6)
    for task in TASKS:
        for when, times in {"all ask at once": burst, "all move a slider": people}.items():
            for what in (each for each in times if each.startswith(task)):
                question = ASKED[task] + what.removeprefix(task)
                alone = f"{1e3 * lonely[task]:.0f} ms"
                written.row(question, when, alone, *row(times[what], lonely[task]))
    written.heading("Memory of twenty pages")
    written.table("when", "the server", "with its processes")
    held = {"no page is open": before, "all are open": during, "all are closed": megabytes(server)}
    for when, own in held.items():
        written.row(when, f"{own[0]:.0f} MB", f"{sum(own):.0f} MB")
    written.save()


def main():
    with tempfile.TemporaryDirectory() as folder, running_lab(temporary=folder) as lab:
        time.sleep(3)  # what is prepared in the background
        asyncio.run(measure(*entered(lab.opened), lab.process.pid))


if __name__ == "__main__":
    main()
