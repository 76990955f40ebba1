"""Compiled loops are kept for the next process, and do without where nothing can be written."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from roughline.computing import compiled

PROGRAM = """
import time, roughline as rl
rl.press(rl.Surface([[0.0, 1.0], [0.5, 0.2]], (1, 1)), E_star=1.0, forces=[0.1])
from roughline.halfspace.operators.grid_nodes import _list_rows
stats = _list_rows.stats
print(sum(stats.cache_hits.values()), sum(stats.cache_misses.values()))
"""


def hits_and_misses(cache: Path) -> list[int]:
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache)}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=True
    )
    return [int(word) for word in done.stdout.split()]


@pytest.mark.slow
def test_a_second_process_does_not_compile_again(tmp_path):
    assert hits_and_misses(tmp_path)[1] > 0
    hits, misses = hits_and_misses(tmp_path)
    assert hits > 0
    assert misses == 0


def test_without_a_place_to_write_loops_are_compiled_all_the_same(monkeypatch):
    def no_cache(cache=False, **options):
        if cache:
            raise RuntimeError("cannot cache function: no locator available")
        return lambda loop: loop

    monkeypatch.setattr(compiled, "njit", no_cache)
    assert compiled.compiled(len)("four") == 4
