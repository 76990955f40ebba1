"""Pages of the handbook that benchmarks write; no number of theirs is typed by hand."""

import platform
import statistics
from pathlib import Path

import numpy as np

import roughline as rl
from roughline.computing.cores import available_cores, processor_name


class Page:
    """A page in ``docs/``, printed while it is measured."""

    def __init__(self, name, title, target):
        self.path = Path(__file__).parents[1] / "docs" / name
        self.lines = []
        self.say(f"# {title}\n")
        self.say(f"Written by `make {target}`: {machine()}.\n")

    def say(self, line):
        """Add a line, and print it."""
        print(line, flush=True)
        self.lines.append(line)

    def table(self, *columns):
        """Begin a table."""
        self.row(*columns)
        self.row(*["---"] * len(columns))

    def row(self, *cells):
        """Add a row of a table."""
        self.say(f"| {' | '.join(map(str, cells))} |")

    def save(self):
        """Write the page."""
        self.path.write_text("\n".join(self.lines) + "\n", encoding="utf-8")


def machine():
    """Return what times depend on: the program, the machine and what computes on it."""
    return (
        f"roughline {rl.__version__}, {available_cores()} cores, {processor_name()}, "
        f"Python {platform.python_version()}, NumPy {np.__version__}"
    )


def percentiles(times):
    """Return the median of some times, their 95th percentile and the longest."""
    times = sorted(times)
    return statistics.median(times), times[int(0.95 * (len(times) - 1))], times[-1]
