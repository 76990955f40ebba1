"""A lab under attack, while one page of it is used as it is meant to be.

    python benchmarks/lab_attack.py [share] [seed]

At once come 1,000 sockets that are held half open, 500 sessions which end in every way, 100,000
messages and questions mutated at random, and 10,000 requests to every route; `share` takes a part
of each. Meanwhile an honest page, in a process of its own, asks and opens anew. Descriptors,
memory, processes, folder and log of the lab are noted every few seconds. When all has become quiet
they must be as before, or the exit code is 1. Linux alone has the addresses that this needs.
``make lab-attack`` writes a part of ``docs/measured.md``.
"""

import asyncio
import collections
import contextlib
import multiprocessing
import os
import random
import resource
import statistics
import sys
import tempfile
import time
from http.client import HTTPException
from pathlib import Path

import page
import psutil

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))
import attackers  # noqa: E402
from lab_sessions import Page, megabytes  # noqa: E402

from lab.server.serving import entered, running_lab  # noqa: E402

SOCKETS, SESSIONS, MESSAGES, REQUESTS = 1_000, 500, 100_000, 10_000
AT_ONCE = 32  # sessions
SECONDS = 45.0  # of a session, if the lab keeps up
FILES_OF_A_PROCESS = 1024  # that the system commonly lets a program open
EVERY = 5.0  # the lab is looked at [s]
LONGEST_QUIET = 900.0  # until all that was left is gone [s]
LONGEST_ANSWER = 120.0  # for the honest page [s]
ALONE = 30.0  # that the honest page is measured without an attack [s]


HELD = {
    "descriptors": ("descriptors of the server", 5),
    "resident": ("resident memory of the server [MB]", 40),
    "own": ("memory of the server alone [MB]", 40),
    "own_of_all": ("memory of all its processes alone [MB]", 100),
    "processes": ("processes", 0),
    "files": ("files in its folder", 0),
    "folder": ("size of its folder [kB]", 0),
    "log": ("what it wrote to the terminal [bytes]", 2000),
}
"""What the lab holds, as the table calls it, and by how much it may be more at the end."""
DRIFT = 15  # memory of the server alone, from the second quarter of the attack to the last [MB]
IDLE = 0.02  # of a core that the lab may take when nobody is there


class Watch:
    def __init__(self, lab):
        self.lab, self.server = lab, psutil.Process(lab.process.pid)
        self.samples = []

    def look(self):
        own = megabytes(self.server)
        files = [Path(at) / name for at, _, names in os.walk(self.lab.folder) for name in names]
        sizes = []
        for each in files:
            with contextlib.suppress(OSError):  # as it may be gone by now
                sizes.append(each.stat().st_size)
        memory = (self.server.memory_info().rss / 1e6, own[0], sum(own))
        on_disk = (len(files), sum(sizes) / 1e3, self.lab.log.stat().st_size)
        found = (self.server.num_fds(), *memory, len(own), *on_disk)
        return dict(zip(HELD, found, strict=True))

    async def run(self, counts):
        started = time.monotonic()
        while True:
            sample = await asyncio.to_thread(self.look)
            self.samples.append(sample)
            told = f"{counts['sessions']} sessions, {counts['messages']} messages"
            print(f"{time.monotonic() - started:.0f} s: {told}, {sample}", flush=True)
            await asyncio.sleep(EVERY)

    async def quiet(self, before=None):
        """Wait until nothing changes any more, or all is as before; what it holds then."""
        last, since = None, time.monotonic()
        while time.monotonic() - since < LONGEST_QUIET:
            await asyncio.sleep(EVERY)
            now = await asyncio.to_thread(self.look)
            calm = ("files", "processes", "descriptors")
            is_calm = last is not None and all(now[name] == last[name] for name in calm)
            if is_calm and (before is None or not exceeded(before, now)):
                break
            last = now
        return now, time.monotonic() - since

    def idle_share(self):
        """Share of a core that all its processes take in some seconds."""
        before, started = self._cpu(), time.monotonic()
        time.sleep(10)
        return (self._cpu() - before) / (time.monotonic() - started)

    def _cpu(self):
        used = 0.0
        for each in (self.server, *self.server.children(recursive=True)):
            with contextlib.suppress(psutil.Error):
                used += sum(each.cpu_times()[:2])
        return used


def exceeded(before, after):
    """What is more than before by more than is allowed."""
    grown = {name: after[name] - before[name] for name in HELD}
    return {name: by for name, by in grown.items() if by > HELD[name][1]}


def honest(address, cookie, seed, is_over, told):
    """Use the lab as it is meant to be, in a process of its own, and tell how long it took."""
    told.put(asyncio.run(_honest(address, cookie, seed, is_over)))


async def _honest(address, cookie, seed, is_over):
    times, refused = collections.defaultdict(list), []

    async def take(what, work):
        started = time.perf_counter()
        try:
            found = await asyncio.wait_for(work, LONGEST_ANSWER)
        except Exception as error:  # whatever it is, the page was not served
            refused.append(f"{what}: {error or type(error).__name__}")
            return None
        times[what].append(time.perf_counter() - started)
        return found

    lasting = await take("a new page", Page.open(address, cookie, seed))
    while lasting is not None and not is_over.is_set():
        for task, what in (("explore.coarse", "coarse contact"), ("explore.full", "at rest")):
            lasting.seed += 1
            await take(f"{what}, of a page that stays", lasting.ask(task))
            await asyncio.sleep(0.3)
        new = await take("a new page", Page.open(address, cookie, seed))
        if new is not None:
            await take("coarse contact, of a new page", new.ask("explore.coarse"))
            await new.close()
    return dict(times), refused


async def measured_honestly(opened, seed, work):
    """Have the honest page ask while something is done; its times, and what was refused."""
    context = multiprocessing.get_context("spawn")
    is_over, told = context.Event(), context.Queue()
    told_to = (*entered(opened), seed, is_over, told)
    process = context.Process(target=honest, args=told_to, daemon=True)
    process.start()
    await work
    is_over.set()
    found = await asyncio.to_thread(told.get, timeout=2 * LONGEST_ANSWER)
    process.join()
    return found


async def entered_soon(lab):
    """Open the printed address, as soon as the lab answers; the bare address and the cookie."""
    while True:
        with contextlib.suppress(OSError, HTTPException):
            return await asyncio.to_thread(entered, lab.opened)
        await asyncio.sleep(1)


async def attack(lab, share, chance):
    """Let everything loose, until all sessions have ended; what was done."""
    counts = collections.Counter()
    strangers = attackers.Lab(*entered(lab.opened), counts)
    crowd = attackers.Crowd(strangers, share)
    sessions = iter(range(round(SESSIONS * share)))

    async def people():
        for _ in sessions:
            visitor = attackers.Page(strangers, chance)
            await visitor.live(MESSAGES // SESSIONS, SECONDS)

    async def knocks():
        while counts["requests"] < REQUESTS * share and lab.process.poll() is None:
            own = attackers.Lab(*await entered_soon(lab), counts)
            for _ in range(50):  # one of them may log out
                await attackers.Requests(own, chance).send()

    watch = Watch(lab)
    watching, crowding = asyncio.create_task(watch.run(counts)), asyncio.create_task(crowd.run())
    knocking = [asyncio.create_task(knocks()) for _ in range(8)]
    await asyncio.gather(*(people() for _ in range(AT_ONCE)))
    await asyncio.gather(*knocking)
    crowd.is_over.set()
    await crowding
    watching.cancel()
    return counts, watch.samples, list(crowd.kinds)


async def run(lab, share, seed):
    """Attack, and compare with before; what the page tells, and the faults."""
    watch, chance = Watch(lab), random.Random(seed)
    before_all, _ = await measured_honestly(lab.opened, 10_000, asyncio.sleep(ALONE))
    before, _ = await watch.quiet()
    print("before:", before, flush=True)
    began, told = time.monotonic(), {}

    async def attacked():
        told["counts"], told["samples"], told["kinds"] = await attack(lab, share, chance)

    times, refused = await measured_honestly(lab.opened, 20_000, attacked())
    told["minutes"] = (time.monotonic() - began) / 60
    after, told["quiet"] = await watch.quiet(before)
    told |= {"before": before, "after": after, "alone": before_all, "times": times}
    told["idle"] = await asyncio.to_thread(watch.idle_share)
    return told, faults_of(told, refused, lab.log.read_text(errors="replace"))


def drift_of(samples):
    """By how much the server's own memory grew from the second quarter of them to the last."""
    quarter = max(1, len(samples) // 4)
    second, last = samples[quarter : 2 * quarter + 1], samples[-quarter:]
    early, late = (statistics.mean(each["own"] for each in some) for some in (second, last))
    return late - early


def faults_of(told, refused, log):
    exceeding = exceeded(told["before"], told["after"])
    faults = [f"{HELD[name][0]}: {by:.4g} more than before" for name, by in exceeding.items()]
    faults += [f"the honest page was refused: {each}" for each in refused]
    if told["counts"]["pages that waited in vain"]:
        faults.append(f"{told['counts']['pages that waited in vain']} pages were not answered")
    if (drift := drift_of(told["samples"])) > DRIFT:
        faults.append(f"the memory of the server still grows at the end, by {drift:.0f} MB")
    if told["idle"] > IDLE:
        faults.append(f"it takes {told['idle']:.0%} of a core when nobody is there")
    return [*faults, "it wrote a traceback"] if "Traceback" in log else faults


def write(told, share, seed):
    counts = told["counts"]
    written = page.Page("lab-attack", "measured.md", "lab-attack")
    written.say(
        f"{SOCKETS * share:.0f} sockets held open, {counts['sessions']} sessions, "
        f"{counts['messages']} messages of which some parts are mutated at random, and "
        f"{counts['requests']} requests to every route, in {told['minutes']:.0f} minutes on the "
        f"machine that serves, seed {seed}; meanwhile a page is used as it is meant to be."
    )
    written.say(
        f"All is quiet {told['quiet']:.0f} s after the last attacker has gone; it then takes "
        f"{told['idle']:.1%} of a core."
    )
    columns = ("before", "most meanwhile", "afterwards", "may be more by")
    written.table("what the lab holds", *columns, at_most=5)
    for name, (shown, allowed) in HELD.items():
        most = max(each[name] for each in told["samples"])
        values = told["before"][name], most, told["after"][name]
        written.row(shown, *(f"{value:.0f}" for value in values), allowed)
    written.heading("Times of the page that is used meanwhile")
    columns = ("alone, median", "times", "median", "95th percentile", "worst")
    written.table("question", *columns, at_most=0)
    for what, times in told["times"].items():
        parts = statistics.median(told["alone"][what]), *page.percentiles(times)
        shown = [f"{1e3 * part:.0f} ms" for part in parts]
        written.row(what, shown[0], len(times), *shown[1:])
    written.heading("What came")
    written.table("what", "times", at_most=0)
    for kind in told["kinds"]:
        written.row(f"socket: {kind}", counts.pop(kind))
    for what in sorted(counts):
        written.row(what, counts[what])
    if share == 1:
        written.save()


def main(share, seed):
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(limits[1], FILES_OF_A_PROCESS), limits[1]))
    with tempfile.TemporaryDirectory() as folder:
        with running_lab(temporary=Path(folder)) as lab:
            resource.setrlimit(resource.RLIMIT_NOFILE, (limits[1], limits[1]))
            told, faults = asyncio.run(run(lab, share, seed))
            log = lab.log.read_text(errors="replace")
        if lab.process.returncode or list(Path(folder).glob("roughline-lab-*")):
            faults.append(f"it ended with {lab.process.returncode}, or left its folder")
    write(told, share, seed)
    print(log[:3000], *faults, sep="\n")
    sys.exit(bool(faults))


if __name__ == "__main__":
    given = sys.argv[1:]
    main(float(given[0]) if given else 1, int(given[1]) if given[1:] else 1)
