"""Kill a campaign a hundred times at random; it must end in the bytes of an undisturbed run.

    python benchmarks/soak.py [kills] [seed]

Kills are kill -9 of the client, of a worker, or of the scheduler of a cluster of its own, an
interrupt, and kill -9 of the client with a chunk cut off afterwards. A campaign that ends is
compared with an undisturbed one, and the next begins. Writes a part of ``docs/measured.md``.
"""

import collections
import contextlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil
from page import Page

from roughline import campaign

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from dask_processes import start_scheduler, start_worker
from small_campaign import PLAN, finish, start, tree

KINDS = {
    "client": "kill -9 of the client",
    "worker": "kill -9 of a worker",
    "scheduler": "kill -9 of the scheduler of a cluster",
    "interrupt": "Ctrl-C",
    "chunk": "kill -9 of the client, and a chunk cut off",
}
LONGEST = 8.0  # until a kill, from the start of the command [s]
WORKERS_A_RUN = 3


class Soak:
    """Campaigns that are killed, and what became of them."""

    def __init__(self, folder: Path, seed: int) -> None:
        self.folder, self.chance = folder, random.Random(seed)
        self.plan = folder / "plan.toml"
        self.plan.write_text(PLAN.replace("realisations = 60", "realisations = 200"))
        self.cases = campaign.read_plan(self.plan).cases
        self.kills: collections.Counter[str] = collections.Counter()
        self.campaigns = self.runs = 0
        code, _, err = finish(start(self.plan, folder / "calm"))
        assert code == 0, err
        self.calm = tree(folder / "calm")

    def disturb(self, kills: int) -> None:
        """Run campaigns to their ends until so many kills are done."""
        while sum(self.kills.values()) < kills:
            store = self.folder / "store"
            shutil.rmtree(store, ignore_errors=True)
            # the last kills fall on a campaign that may then end
            while not self._run(store, calm=sum(self.kills.values()) >= kills):
                print(dict(self.kills), flush=True)
            if tree(store) != self.calm:
                sys.exit(f"after {dict(self.kills)}: the store differs from an undisturbed one")
            self.campaigns += 1
            print(f"{sum(self.kills.values())} kills, {self.campaigns} campaigns", flush=True)

    def _run(self, store: Path, calm: bool) -> bool:
        """Run the command once, with or without a kill; whether the campaign is at its end."""
        self.runs += 1
        if calm:
            return finish(start(self.plan, store))[0] == 0
        kind = self.chance.choice([*KINDS])
        if kind == "scheduler":
            return self._with_cluster(store)
        process = start(self.plan, store)
        time.sleep(self.chance.uniform(0.5, LONGEST))
        for _ in range(WORKERS_A_RUN if kind == "worker" else 1):
            if process.poll() is not None:
                break
            with contextlib.suppress(psutil.Error):  # what is to be killed may have ended meanwhile
                self._kill(process, kind)
            time.sleep(self.chance.uniform(0.5, 2.0))
        code, _, err = finish(process)
        assert "Traceback" not in err, err
        if kind == "chunk":
            self._cut(store)
            return False
        return code == 0

    def _kill(self, process: subprocess.Popen, kind: str) -> None:
        if kind in ("client", "chunk"):
            process.kill()
        elif kind == "interrupt":
            os.killpg(process.pid, signal.SIGINT)
        else:
            children = psutil.Process(process.pid).children(recursive=True)
            workers = [c for c in children if "spawn_main" in " ".join(c.cmdline())]
            if not workers:
                return
            self.chance.choice(workers).kill()
        if kind != "chunk":
            self.kills[kind] += 1

    def _with_cluster(self, store: Path) -> bool:
        note = Path(tempfile.mkdtemp(dir=self.folder))
        scheduler, address = start_scheduler(note)
        workers = [start_worker(address, "--nthreads", "1") for _ in range(2)]
        process = start(self.plan, store, "--scheduler", address)
        time.sleep(self.chance.uniform(1.0, LONGEST))
        if process.poll() is None:
            scheduler.kill()
            self.kills["scheduler"] += 1
        code, _, err = finish(process)
        assert "Traceback" not in err, err
        for each in (*workers, scheduler):
            each.kill()
            each.wait()
        return code == 0

    def _cut(self, store: Path) -> None:
        chunks = [path for path in store.rglob("c/**/*") if path.is_file()]
        if chunks:
            path = self.chance.choice(chunks)
            path.write_bytes(path.read_bytes()[: self.chance.randrange(path.stat().st_size)])
            self.kills["chunk"] += 1


def main(kills: int, seed: int) -> None:
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        soak = Soak(Path(folder), seed)
        soak.disturb(kills)
    minutes = (time.monotonic() - started) / 60
    page = Page("soak", "measured.md", "soak")
    page.say(
        f"Of seed {seed}: {sum(soak.kills.values())} kills in {soak.runs} runs of {soak.campaigns} "
        f"campaigns of {soak.cases} cases, {minutes:.0f} minutes. Every "
        "campaign ended with the same bytes as one that was not disturbed."
    )
    page.table("disturbance", "times")
    for kind, name in KINDS.items():
        page.row(name, soak.kills[kind])
    page.save()


if __name__ == "__main__":
    numbers = [int(text) for text in sys.argv[1:]] + [100, 1][len(sys.argv) - 1 :]
    main(*numbers)
