#!/usr/bin/env bash
# What was cut off a Zarr array by making it shorter is back once it grows again.
#
# One would guess that resize throws away what lies beyond the new end, and that new elements are the fill value.
# What happens, Zarr 3.1.6, ten values in chunks of four, made six long and ten long again:
#   Whole chunks beyond the end are dropped. The chunk in which the new end lies keeps all its four values, so
#   the two beyond the end, which nobody sees while the array is short, are there again when it grows. Formats
#   2 and 3 do so, and shards as well, in which the chunks of a shard may come back, too.
#   append writes over them, and is safe.
# Output seen (-- is the fill value):
#   format 2           0  1  2  3  4  5  6  7 -- --
#   format 3           0  1  2  3  4  5  6  7 -- --
#   shards of two      0  1  2  3  4  5  6  7 -- --
#   format 3, append   0  1  2  3  4  5 99
# Why it matters: a store of many computations is cut back to drop a batch that failed, and enlarged before it is
# written again. Whoever then asks which rows are still the fill value, to compute those, skips the bad ones.
# In roughline: A store of a campaign grows only. Each case has a status of its own, by which it is computed
# again or not.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'zarr==3.1.6' 'numpy==2.4.6'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import numpy as np
import zarr


def shortened(**kind):
    array = zarr.create_array(store={}, shape=(10,), chunks=(4,), dtype="f8", fill_value=np.nan, **kind)
    array[:] = np.arange(10.0)
    array.resize((6,))
    assert np.array_equal(array[:], np.arange(6.0))
    return array


def show(name, array):
    values = array[:]
    print(f"{name:18}", *("--" if np.isnan(value) else f"{value:2.0f}" for value in values))
    return values


kinds = {"format 2": {"zarr_format": 2}, "format 3": {"zarr_format": 3}, "shards of two": {"shards": (8,)}}
for name, kind in kinds.items():
    array = shortened(**kind)
    array.resize((10,))
    assert np.array_equal(show(name, array), [*range(8), np.nan, np.nan], equal_nan=True)
array = shortened()
array.append(np.array([99.0]))
assert np.array_equal(show("format 3, append", array), [*range(6), 99])
PYTHON
