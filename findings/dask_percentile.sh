#!/usr/bin/env bash
# The median that Dask gives of a tilted map hangs on the chunks, and may lie a sixth of the range away.
#
# One would guess that dask.array.percentile, which says that it is approximate, is so by a per cent or so.
# What happens, Dask 2026.8.0, 2048 x 512 heights with 1 um rms of noise on a rise of 20 um along the rows:
#   Each chunk is asked for the percentiles that were asked for, no others, and the answers are merged. If the
#   median alone is wanted, that is one number a chunk: with eight chunks along the rise it is 3.6 um too high, and
#   the percentile of 1 % is 6.4 um too high. In one chunk it is exact. Asked for 101 percentiles at once, the same
#   median comes out within 0.1 um. Nothing is said.
# Output seen (um):
#   percentile                       1      50      99
#   NumPy                        -0.50   10.00   20.50
#   Dask, one chunk              -0.50   10.00   20.50
#   Dask, eight, one at a time    5.95   13.60   21.44
#   Dask, eight, 101 at once     -0.50   10.05   20.58
# Why it matters: the Abbott curve, Sk and a robust datum are percentiles of large maps, which are chunked, and
# which are tilted or wavy before they are levelled.
# In roughline: The material ratio, Sk and what follows from it are of all heights of a map, sorted, whatever
# its size.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'dask==2026.8.0' 'numpy==2.4.6'
OMP_NUM_THREADS=1 "$folder/env/bin/python" -W error - <<'PYTHON'
import dask.array
import numpy as np

rise = 20 * np.linspace(0, 1, 2048)[:, None]
heights = (np.random.default_rng(0).normal(size=(2048, 512)) + rise).ravel()
WANTED = (1, 50, 99)


def one_at_a_time(chunk):
    chunked = dask.array.from_array(heights, chunks=chunk)
    return [float(dask.array.percentile(chunked, each).compute()) for each in WANTED]


def show(name, values):
    print(f"{name:26}", *(f"{value:7.2f}" for value in values))
    return np.array(values)


print(f"{'percentile':26}", *(f"{each:7d}" for each in WANTED))
exact = show("NumPy", np.percentile(heights, WANTED))
one = show("Dask, one chunk", one_at_a_time(heights.size))
eight = show("Dask, eight, one at a time", one_at_a_time(heights.size // 8))
chunked = dask.array.from_array(heights, chunks=heights.size // 8)
together = show("Dask, eight, 101 at once", dask.array.percentile(chunked, range(101)).compute()[list(WANTED)])
assert np.allclose(one, exact, atol=1e-3)
assert np.allclose(eight - exact, [6.45, 3.60, 0.94], atol=0.02)
assert np.allclose(together, exact, atol=0.1)
PYTHON
