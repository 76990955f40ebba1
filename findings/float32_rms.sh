#!/usr/bin/env bash
# The rms height of a map in single precision comes out twenty times too large once Bottleneck is installed.
#
# One would guess that means and standard deviations of 32-bit heights are good to some digits, whichever
# library takes them, and that a package which only makes others faster changes none.
# What happens, a map of 2048 x 2048 heights, 1 um rms on a mean of 1 mm, NumPy 2.4.6, pandas 3.1.1,
# Bottleneck 1.6.0, Numba 0.68.1:
#   NumPy adds in pairs, and is right. So is pandas alone, which adds in double precision.
#   With Bottleneck installed, pandas takes its nanstd, which adds one after the other in single precision: the
#   mean is 2 % low, and the rms height about it is 20 times too large. pandas takes its own mean all the same.
#   Numba compiles a.mean() and np.std(a) to the same kind of sum, yet np.nanmean and np.nanstd to good ones.
# Output seen (mean in um, rms height in um):
#   double precision      1000.000     1.000
#   NumPy                 1000.000     1.000
#   pandas alone          1000.000     1.000
#   pandas, Bottleneck    1000.000    20.098
#   Bottleneck             979.911    20.098
#   Numba, np.mean         979.911    20.114
#   Numba, np.nanmean     1000.000     1.000
# Why it matters: instruments write 32-bit heights above a far datum, and load, area and stiffness of a rough
# contact go with the rms height and slope that such a line gives. Take the datum off first, or convert.
# In roughline: Heights are in double precision as soon as they are read, whatever their type in the file.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: \
  'numpy==2.4.6' 'pandas==3.1.1' 'Bottleneck==1.6.0' 'numba==0.68.1' 'llvmlite==0.50.0'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import bottleneck
import numba
import numpy as np
import pandas as pd

heights = (1e-3 + 1e-6 * np.random.default_rng(0).normal(size=(2048, 2048))).astype(np.float32)
column = pd.Series(heights.ravel())
plain = numba.njit(lambda a: (np.mean(a), np.std(a)))
without_missing = numba.njit(lambda a: (np.nanmean(a), np.nanstd(a)))

seen = {"double precision": (heights.mean(dtype=float), heights.std(dtype=float))}
seen["NumPy"] = heights.mean(), heights.std()
with pd.option_context("compute.use_bottleneck", False):
    seen["pandas alone"] = column.mean(), column.std()
seen["pandas, Bottleneck"] = column.mean(), column.std()
seen["Bottleneck"] = bottleneck.nanmean(heights), bottleneck.nanstd(heights)
seen["Numba, np.mean"] = plain(heights)
seen["Numba, np.nanmean"] = without_missing(heights)
for name, (mean, rms) in seen.items():
    print(f"{name:20} {1e6 * mean:9.3f} {1e6 * rms:9.3f}")

of_rms = {name: rms / seen["double precision"][1] for name, (_, rms) in seen.items()}
wrong = {"pandas, Bottleneck", "Bottleneck", "Numba, np.mean"}
assert all((factor > 19) == (name in wrong) for name, factor in of_rms.items()), of_rms
assert all(abs(factor - 1) < 1e-3 for name, factor in of_rms.items() if name not in wrong), of_rms
means = {name: mean / 1e-3 for name, (mean, _) in seen.items()}
assert {name for name, share in means.items() if share < 0.99} == wrong - {"pandas, Bottleneck"}, means
PYTHON
