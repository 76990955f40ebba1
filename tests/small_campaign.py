"""A small campaign for tests, how it is disturbed, and how two stores are compared."""

import contextlib
import signal
import subprocess
import sys
from pathlib import Path

from reference import patience

# Nine batches of surfaces, of a fifth of a second under light loads, so that a campaign can be
# disturbed on its way.
PLAN = """
name = "small"
seed = 5

[[ensemble]]
name = "lines"
model = "reduced"
fractal_dimensions = [2.0, 2.4, 3.0]
points = 4096
realisations = 60
force_bars = { from = 1e-4, to = 10, per_decade = 6 }

[[ensemble]]
name = "surfaces"
model = "full"
fractal_dimensions = [2.0, 2.4, 3.0]
points = 128
realisations = 9
force_bars = { from = 1e-5, to = 0.1, per_decade = 6 }
"""

FEW = PLAN.replace("realisations = 60", "realisations = 6").replace(
    "points = 128\nrealisations = 9", "points = 64\nrealisations = 4"
)
"""The same with 30 cases, on coarser grids."""

HELD = """
import importlib, time
from pathlib import Path
runs = importlib.import_module("roughline.campaign.run")
evaluate = runs.evaluate
def held(batch, *rest):
    is_last = batch.ensemble.name == "surfaces" and batch.fractal_dimensions.max() == 3
    is_last = is_last and batch.cells[:, 1].max() == batch.ensemble.realisations - 1
    while is_last and not Path({end!r}).exists():
        time.sleep(0.02)
    return evaluate(batch, *rest)
runs.evaluate = held
"""
"""Makes the last batch of surfaces take until there is a file, so that a campaign is disturbed
before its end, however slow the test is, and then goes on."""


def tree(store):
    """All files of a store, byte by byte."""
    store = Path(store)
    return {
        str(path.relative_to(store)): path.read_bytes()
        for path in sorted(store.rglob("*"))
        if path.is_file()
    }


def start(plan, store, *arguments, until=None, **options):
    """Start `roughline campaign run` in a process group of its own.

    Its last batch of surfaces takes until there is a file, if one is named.
    """
    holding = "" if until is None else HELD.format(end=str(until))
    command = [sys.executable, "-c", f"{holding}from roughline.cli import main; main()"]
    return subprocess.Popen(
        [*command, "campaign", "run", str(plan), "--store", str(store), *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        **{"preexec_fn": hear_interrupts, **options},
    )


def hear_interrupts():
    """Undo what a shell does to its background jobs: they, and theirs, are deaf to Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def finish(process):
    """Wait for a process; its exit code, output and errors."""
    out, err = process.communicate(timeout=patience())
    return process.returncode, out, err


def run(plan, store, *arguments, **options):
    """Run a campaign to its end."""
    return finish(start(plan, store, *arguments, **options))


def with_first_results(monkeypatch, act, ensemble=None):
    """Act once, as soon as a command in this process has written the first results of a campaign.

    Or those of an ensemble. The command goes on afterwards: nothing depends on how long it takes.
    """
    to_come = [act]

    def progress(name, done, failed, total):
        if done and to_come and ensemble in (None, name):
            to_come.pop()()

    monkeypatch.setattr(
        "roughline.report.progress.campaign_progress", lambda: contextlib.nullcontext(progress)
    )
