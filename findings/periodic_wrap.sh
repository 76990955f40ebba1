#!/usr/bin/env bash
# "wrap" is a period of n points in SciPy's filters, and of n - 1 in its shifts and interpolations.
#
# One would guess that mode="wrap" is one thing in scipy.ndimage: a periodic map of n points goes on with its
# first point after its last, so that a shift by ten points is a roll, and one by half a step is the wave.
# What happens, SciPy 1.17.1, a cosine of 4 waves on 64 points:
#   gaussian_filter and uniform_filter repeat the map after 64 points and are right to the last one.
#   shift and map_coordinates repeat it after 63, as if the last point were the first one again. A shift by
#   ten points misses the roll by 0.38 of the amplitude, one by half a step misses the wave by 0.13. No
#   warning. zoom with grid_mode=True warns. mode="grid-wrap" is right in all of them.
# Output seen (greatest departure from the exact value):
#                        wrap      grid-wrap
#   gaussian_filter      0.00003   0.00003
#   uniform_filter       0.00000   0.00000
#   shift by ten points  0.38268   0.00000
#   shift by half a step 0.12555   0.00006
#   map_coordinates      0.02376   0.00006
# Why it matters: periodic rough surfaces are shifted against each other (sliding, two bodies, a finer grid).
# Only a strip as wide as the shift is wrong, yet its false steps are the steepest of the map.
# In roughline: Of SciPy, periodic maps are given to filters alone. What is interpolated is no period, or is
# made longer first.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'scipy==1.17.1' 'numpy==2.4.6'
OMP_NUM_THREADS=1 "$folder/env/bin/python" -W error - <<'PYTHON'
import numpy as np
from scipy import ndimage

N, WAVES = 64, 4
wavenumber = 2 * np.pi * WAVES / N
points, between = np.arange(N), np.arange(0, N, 0.5)
wave = lambda x: np.cos(wavenumber * x)
heights = wave(points)
kept_by_gaussian = np.exp(-((2 * wavenumber) ** 2) / 2)
kept_by_uniform = (1 + 2 * np.cos(wavenumber)) / 3
tries = {
    "gaussian_filter": lambda m: ndimage.gaussian_filter(heights, 2, mode=m) - kept_by_gaussian * heights,
    "uniform_filter": lambda m: ndimage.uniform_filter(heights, 3, mode=m) - kept_by_uniform * heights,
    "shift by ten points": lambda m: ndimage.shift(heights, 10, mode=m) - np.roll(heights, 10),
    "shift by half a step": lambda m: ndimage.shift(heights, 0.5, mode=m) - wave(points - 0.5),
    "map_coordinates": lambda m: ndimage.map_coordinates(heights, [between], mode=m) - wave(between),
}
seen = {}
print(f"{'':20} wrap      grid-wrap")
for name, departure in tries.items():
    seen[name] = [np.abs(departure(mode)).max() for mode in ("wrap", "grid-wrap")]
    print(f"{name:20} {seen[name][0]:.5f}   {seen[name][1]:.5f}")
    assert seen[name][1] < 1e-4
assert max(seen["gaussian_filter"][0], seen["uniform_filter"][0]) < 1e-4
assert np.allclose([seen[name][0] for name in list(tries)[2:]], (0.38268, 0.12555, 0.02376), atol=1e-4)
PYTHON
