"""A small campaign for tests, and how two stores are compared."""

import signal
import subprocess
import sys
from pathlib import Path

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


def tree(store):
    """All files of a store, byte by byte."""
    store = Path(store)
    return {
        str(path.relative_to(store)): path.read_bytes()
        for path in sorted(store.rglob("*"))
        if path.is_file()
    }


def start(plan, store, *arguments, **options):
    """Start `roughline campaign run` in a process group of its own."""
    command = [sys.executable, "-c", "from roughline.cli import main; main()", "campaign", "run"]
    return subprocess.Popen(
        [*command, str(plan), "--store", str(store), *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        **{"preexec_fn": hear_interrupts, **options},
    )


def hear_interrupts():
    """Undo what a shell does to its background jobs: they, and theirs, are deaf to Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def finish(process, timeout=120):
    """Wait for a process; its exit code, output and errors."""
    out, err = process.communicate(timeout=timeout)
    return process.returncode, out, err


def run(plan, store, *arguments, **options):
    """Run a campaign to its end."""
    return finish(start(plan, store, *arguments, **options))
