"""Pages of the handbook that benchmarks write, and what they measure: times and memory."""

import multiprocessing
import platform
import resource
import statistics
import sys
import time
from concurrent.futures import ProcessPoolExecutor
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
        self.row(*columns)
        self.row(*["---"] * len(columns))

    def row(self, *cells):
        self.say(f"| {' | '.join(map(str, cells))} |")

    def save(self):
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


def once(function):
    """Return what a call gives, and its wall time. [s]"""
    start = time.perf_counter()
    return function(), time.perf_counter() - start


def peak():
    """Return the largest memory that this process has held so far. [bytes]"""
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def elsewhere(function, *given):
    """Return what a function gives in a process of its own."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as processes:
        return processes.submit(function, *given).result()
