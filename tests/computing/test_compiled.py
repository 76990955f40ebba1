"""Compiled loops are kept for the next process, and do without where nothing can be written."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from roughline.computing import compiled

ONE_LOOP = """
import numpy as np
from roughline.halfspace.operators.grid_nodes import GridNodes
GridNodes.of(np.arange(3), (2, 2))
"""
PRESS = """
import roughline as rl
rl.press(rl.Surface([[0.0, 1.0], [0.5, 0.2]], (1, 1)), E_star=1.0, forces=[0.1])
"""
COUNT = """
from roughline.halfspace.operators.grid_nodes import _list_rows
stats = _list_rows.stats
print(sum(stats.cache_hits.values()), sum(stats.cache_misses.values()))
"""


def hits_and_misses(program: str, cache: Path) -> list[int]:
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache)}
    call = [sys.executable, "-c", program + COUNT]
    done = subprocess.run(call, env=environment, capture_output=True, text=True, check=True)
    return [int(word) for word in done.stdout.split()]


@pytest.mark.parametrize("program", [ONE_LOOP, PRESS], ids=["one loop", "press"])
def test_a_second_process_does_not_compile_again(program, tmp_path):
    assert hits_and_misses(program, tmp_path)[1] > 0
    hits, misses = hits_and_misses(program, tmp_path)
    assert hits > 0
    assert misses == 0


def test_without_a_place_to_write_loops_are_compiled_all_the_same(monkeypatch):
    def no_cache(cache=False, **options):
        if cache:
            raise RuntimeError("cannot cache function: no locator available")
        return lambda loop: loop

    monkeypatch.setattr(compiled, "njit", no_cache)
    assert compiled.compiled(len)("four") == 4
