"""What benchmarks write into the handbook, and what they measure: times and memory."""

import csv
import multiprocessing
import platform
import re
import resource
import statistics
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import psutil

import roughline as rl
from roughline.computing.cores import available_cores, processor_name

DOCS = Path(__file__).parents[1] / "docs"
SHOWN = 10  # rows of a table on its page; the others are in its file


class Page:
    """What a benchmark writes into a page of ``docs/``, printed while it is measured.

    It stands between two comments of the page, which name it. A table is a file of ``docs/data/``,
    of which the page shows some rows.
    """

    def __init__(self, part, page, target, conditions=None):
        self.part, self.path = part, DOCS / page
        self.begin = f"<!-- {part}: `make {target}` writes this -->"
        self.end = f"<!-- end of {part} -->"
        self.file = f"data/{part}.csv"  # of the next table
        self.tables, self.parts = {}, []  # rows by file; paragraphs, and files of tables
        self.say(f"Written by `make {target}`: {conditions or machine()}.")

    def say(self, paragraph):
        """Add a paragraph, and print it."""
        print(paragraph, "", sep="\n", flush=True)
        self.parts.append(paragraph.strip())

    def heading(self, text):
        """Begin a section, whose table has a file of its own."""
        self.say(f"### {text}")
        self.file = f"data/{self.part}/{file_name(text)}.csv"

    def table(self, *columns, shown=None, at_most=SHOWN):
        """Begin a table; the page shows a number of its rows, evenly from those that it may show.

        These are all, or those of which ``shown`` is true.
        """
        self.tables[self.file] = [], shown or (lambda row: True), at_most
        self.parts.append(self.file)
        self.row(*columns)

    def row(self, *cells):
        cells = [str(each) for each in cells]
        print(*cells, sep=" | ", flush=True)
        self.tables[self.file][0].append(cells)

    def save(self):
        """Write the page and the files of the tables."""
        for file, (rows, *_) in self.tables.items():
            path = DOCS / file
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("w", encoding="utf-8", newline="") as opened:
                csv.writer(opened, lineterminator="\n").writerows(rows)
        text = self.path.read_text("utf-8")
        before, _, rest = text.partition(self.begin)
        _, ended, after = rest.partition(self.end)
        if not ended:
            raise SystemExit(f"{self.path} has no lines {self.begin} and {self.end}")
        said = [self._in_short(each) if each in self.tables else each for each in self.parts]
        written = "\n\n".join([self.begin, *said, self.end])
        self.path.write_text(f"{before}{written}{after}", encoding="utf-8")

    def _in_short(self, file):
        """Return a table as Markdown, with a link to the whole of it."""
        (head, *rows), shown, at_most = self.tables[file]
        some = [row for row in rows if shown(row)]
        if len(some) > at_most:
            places = np.linspace(0, len(some) - 1, at_most).round().astype(int)
            some = [some[place] for place in places]
        count = f"all {len(rows)} rows" if len(some) < len(rows) else "these rows"
        lines = [head, *some] if some else []
        cells = ([cell.replace("|", "\\|") for cell in row] for row in lines)
        table = [f"| {' | '.join(row)} |" for row in cells]
        table[1:1] = [f"|{'---|' * len(head)}"] if some else []
        return "\n".join([*table, "", f"[As CSV, {count}]({file})."]).strip()


def file_name(text):
    """Return a heading as the name of a file."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")


def machine():
    """Return what times depend on: the program, the machine and what computes on it."""
    return (
        f"roughline {rl.__version__}, {available_cores()} cores, {processor_name()} with "
        f"{vector_units()}, Python {platform.python_version()}, NumPy {np.__version__}"
    )


def vector_units():
    """Name the vector units of the processor, on which times depend most."""
    info = Path("/proc/cpuinfo")
    flags = info.read_text().split() if info.exists() else []
    units = [unit for unit in ("avx2", "avx512f") if unit in flags]
    return " and ".join(units) or "unknown vector units"


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


def resident():
    """Return the memory that this process holds now. [bytes]"""
    return psutil.Process().memory_info().rss


def elsewhere(function, *given):
    """Return what a function gives in a process of its own."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as processes:
        return processes.submit(function, *given).result()
