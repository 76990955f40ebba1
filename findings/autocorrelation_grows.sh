#!/usr/bin/env bash
# SurfaceTopography's autocorrelation begins at zero and grows; that of Tamaas and surfalize falls.
#
# One would guess that a function named autocorrelation gives the mean of h(x) h(x + r): the mean square
# height at r = 0, and for a cosine of amplitude 1, 64 points, 4 waves, minus one half at half a wave.
# What happens:
#   Tamaas 2.9.0, computeAutocorrelation, and surfalize 0.19.2, get_autocorrelation_function: as guessed
#   (surfalize does not wrap the map around, so within a few hundredths).
#   SurfaceTopography 1.27.1, autocorrelation_from_profile: half the mean square difference of the two
#   heights. That is zero at r = 0 and, on a periodic map, the mean square less the correlation.
# Output seen:
#   distance / wave      0.000  0.125  0.250  0.375  0.500
#   Tamaas               0.500  0.354 -0.000 -0.354 -0.500
#   surfalize            0.500  0.340 -0.020 -0.368 -0.500
#   SurfaceTopography    0.000  0.146  0.500  0.854  1.000
# Why it matters: a correlation length (Sal, 1/e) is where the curve has fallen to a share of its first
# value. Read from the third line, the first value is zero and nothing falls: it must be taken from the
# mean square height first.
# In roughline: Sal and Str of rl.iso are read from the correlation itself, which begins at the mean square
# height.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: \
  'SurfaceTopography==1.27.1' 'surfalize==0.19.2' 'tamaas==2.9.0'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import numpy as np
import tamaas
from SurfaceTopography import Topography
from surfalize import Surface

N, WAVES = 64, 4
heights = np.tile(np.cos(2 * np.pi * WAVES * np.arange(N) / N)[:, None], (1, N))  # along the first axis
distances = np.arange(0, N // WAVES // 2 + 1, 2)

tamaas.initialize(1)
of_tamaas = np.array(tamaas.Statistics2D.computeAutocorrelation(heights))[distances, 0]
centred = np.array(Surface(heights.T, 1.0, 1.0).get_autocorrelation_function().data)
of_surfalize = centred[N - 1, N - 1 + distances]
topography = Topography(heights, (N, N), periodic=True)
r, values = topography.autocorrelation_from_profile(resampling_method=None, reliable=False)
of_topography = np.array(values)[distances]
assert np.allclose(r[distances], distances)

print("distance / wave  ", *(f"{d * WAVES / N:6.3f}" for d in distances))
print("Tamaas           ", *(f"{value:6.3f}" for value in of_tamaas))
print("surfalize        ", *(f"{value:6.3f}" for value in of_surfalize))
print("SurfaceTopography", *(f"{value:6.3f}" for value in of_topography))
correlation = 0.5 * np.cos(2 * np.pi * WAVES * distances / N)
assert np.allclose(of_tamaas, correlation, atol=1e-12)
assert np.allclose(of_surfalize, correlation, atol=0.025)
assert np.allclose(of_topography, 0.5 - correlation, atol=1e-12)
PYTHON
