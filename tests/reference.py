"""A fixed loop that tells how fast a machine is, and how long tests wait there for what must come.

No test's verdict depends on a number of seconds: a wait ends by what it waits for. Its limit is
there only so that what never comes is told at all.
"""

import json
import time
from functools import cache
from pathlib import Path

import numpy as np

DURATIONS = Path(__file__).parent / "durations.json"
_GENEROUS = 180.0  # [s] on the machine of the durations, on which nothing here waits for a tenth
_TIMES = 5


def loop():
    """Take as long as always on the same machine: half in Python, half in NumPy."""
    total = 0
    for i in range(400_000):
        total += i & 7
    heights = np.random.default_rng(1).normal(size=(128, 128))
    for _ in range(40):
        heights = np.fft.ifft2(np.fft.fft2(heights)).real
    return total, heights


@cache
def seconds_here():
    """Return how long the loop takes on this machine: the least of some times. [s]"""
    taken = []
    for _ in range(_TIMES):
        began = time.perf_counter()
        loop()
        taken.append(time.perf_counter() - began)
    return min(taken)


@cache
def slowness():
    """Return how many times as long the loop takes as on the machine of the durations."""
    if not DURATIONS.is_file():
        return 1.0
    return seconds_here() / json.loads(DURATIONS.read_text("utf-8"))["reference"]


def patience():
    """Return how long a test waits for what must come. [s]"""
    return _GENEROUS * max(1.0, slowness())
