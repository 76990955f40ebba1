#!/usr/bin/env bash
# Tamaas counts waves in its spectral moments and radians in its slopes: they differ by 2 pi.
#
# One would guess that the second moment of the spectrum is the mean square slope along one direction,
# so that sqrt(2 m2) is the rms slope that the same program gives for the same heights.
# What happens, Tamaas 2.9.0, cos(6 pi x) + cos(6 pi y) on a unit square:
#   computeMoments counts the waves on the map, m2 = 9 / 2, so sqrt(2 m2) is 3.
#   computeSpectralRMSSlope takes radians on a side of 1 and gives 6 pi.
#   The spectra do the same: rmsSlopes() of Isopowerlaw2D is 2 pi times sqrt(2 m2) of its own moments().
#   Neither knows a length: the slope of a map of side L is the number over L, m2 is to be multiplied
#   by (2 pi / L)^2 and m4 by (2 pi / L)^4. Nayak's parameter m0 m4 / m2^2 needs neither.
# Output seen:
#   heights            m0 1.0000  m2 4.5000
#                      sqrt(2 m2)  3.0000  slope  18.8496  ratio 6.283185
#                      slope by finite differences 18.7815
#   power law spectrum sqrt(2 m2) 54.5907  slope 343.0035  ratio 6.283185
# Why it matters: asperity models take the density of summits from m4 / m2 and their curvature from
# sqrt(m4). Either is 39.5 times too small where radians are meant.
# In roughline: Wavenumbers are 2 pi over the wavelength throughout. Moments, slopes and curvatures have the
# units of the lengths that the surface has.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'tamaas==2.9.0'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import numpy as np
import tamaas

tamaas.initialize(1)
N = 64
wave = np.cos(6 * np.pi * np.arange(N) / N)
heights = wave[:, None] + wave
statistics = tamaas.Statistics2D
m0, m2, _ = statistics.computeMoments(heights)
slope = statistics.computeSpectralRMSSlope(heights)
differences = statistics.computeFDRMSSlope(heights)

spectrum = tamaas.Isopowerlaw2D()
spectrum.q0, spectrum.q1, spectrum.q2, spectrum.hurst = 4, 4, 16, 0.8
m0_theory, m2_theory, m4_theory = spectrum.moments()

counted, theory = np.sqrt(2 * m2), np.sqrt(2 * m2_theory)
of_theory = spectrum.rmsSlopes()
print(f"heights            m0 {m0:.4f}  m2 {m2:.4f}")
print(f"                   sqrt(2 m2)  {counted:.4f}  slope  {slope:.4f}  ratio {slope / counted:.6f}")
print(f"                   slope by finite differences {differences:.4f}")
print(f"power law spectrum sqrt(2 m2) {theory:.4f}  slope {of_theory:.4f}  ratio {of_theory / theory:.6f}")
assert np.isclose(m0, (heights**2).mean())
assert np.isclose(counted, 3.0)
assert np.isclose(slope, 6 * np.pi)
assert np.isclose(differences, slope, rtol=0.03)
assert np.isclose(of_theory, 2 * np.pi * theory)
assert np.isclose(spectrum.alpha(), m0_theory * m4_theory / m2_theory**2)
PYTHON
