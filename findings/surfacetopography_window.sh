#!/usr/bin/env bash
# SurfaceTopography's window makes the middle of a map 2.7 times as high, and not its border alone lower.
#
# One would guess that a window fades a map out towards its borders, and leaves the heights in the middle as they are,
# where the window is one.
# What happens, SurfaceTopography 1.27.1, white noise on 128 x 128 points, window() of a map that is not periodic:
#   The map is multiplied by a Hann window and divided by the rms value of that window, so that the map keeps its
#   rms height. A round one has an rms value of 0.37, one along x of 0.61: in the middle heights, slopes and
#   curvatures are 2.72 and 1.63 times those of the surface. Nothing is said. A periodic map has no window by itself.
# Output seen (over the heights before):
#   round                 middle 2.718  border 0.000  rms height 0.994
#   along x               middle 1.633  border 0.000  rms height 1.000
#   periodic, by itself   middle 1.000  border 1.000  rms height 1.000
# Why it matters: for a spectrum the factor is right. A map that is faded out in order to be pressed as a periodic one
# has hills that are 2.7 times too high and steep where they bear.
# In roughline: Windows belong to spectra, and no map comes back with one. What is pressed periodically repeats.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'SurfaceTopography==1.27.1' 'numpy==2.4.6'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import numpy as np
from SurfaceTopography import Topography

N = 128
heights = np.random.default_rng(1).normal(size=(N, N))


def shown(name, is_periodic, **window):
    faded = np.array(Topography(heights, (N, N), periodic=is_periodic).window(**window).heights())
    middle = faded[N // 2, N // 2] / heights[N // 2, N // 2]
    border = np.abs(faded[0] / heights[0]).max()
    rms = faded.std() / heights.std()
    print(f"{name:21} middle {middle:.3f}  border {border:.3f}  rms height {rms:.3f}")
    return middle, border, rms


assert np.allclose(shown("round", False), (2.718, 0, 0.994), atol=2e-3)
assert np.allclose(shown("along x", False, window="hann", direction="x"), (1.633, 0, 1.0), atol=2e-3)
assert np.allclose(shown("periodic, by itself", True), (1, 1, 1), atol=1e-12)
PYTHON
