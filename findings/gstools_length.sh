#!/usr/bin/env bash
# The length of a GSTools model is where its correlation is 1/e, or 0.456, by the model.
#
# One would guess that len_scale is the correlation length of surface texture, where the autocorrelation
# has fallen to 1/e, as in exp(-r / l) and exp(-r^2 / l^2): change the model and keep the length.
# What happens, GSTools 1.7.0, len_scale = 10:
#   Exponential is exp(-r / 10), as guessed. Gaussian is exp(-pi r^2 / 400): it is stretched until the
#   integral of its correlation over r is len_scale, as that of the other is. At r = 10 it is exp(-pi / 4),
#   and 1/e is reached at 20 / sqrt(pi) = 11.28. Fields made from it are so, too. rescale=1 gives the guess.
# Output seen (correlation at r = 10, the r of 1/e, correlation at r = 10 over eight made fields):
#   Exponential          0.368  10.00  0.381
#   Gaussian             0.456  11.28  0.466
#   Gaussian, rescale=1  0.368  10.00  0.374
# Why it matters: correlation lengths of rough surfaces, Sal among them, are read off such a fall. The rms
# slope of a Gaussian surface, sqrt(2) Sq / l along a line, comes out 11 % too low, the curvature 21 %.
# In roughline: A spectrum is told by wavenumbers, q_roll and q_high, and by no correlation length. Sal is where
# the correlation has fallen to 0.2, as the standard says.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'gstools==1.7.0' 'numpy==2.4.6'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import gstools
import numpy as np

LENGTH, SEEDS = 10.0, range(8)
AXIS = 2.5 * LENGTH * np.arange(64)  # points far enough apart to be nearly independent


def of_fields(model, distance):
    """Correlation at a distance along x, over fields made from the model."""
    products, squares = [], []
    for seed in SEEDS:
        field = gstools.SRF(model, seed=seed)
        here, there = field.structured((AXIS, AXIS)), field.structured((AXIS + distance, AXIS))
        products.append(np.mean(here * there))
        squares.append(np.mean(here**2 + there**2) / 2)
    return np.sum(products) / np.sum(squares)


def look(name, model):
    r = np.linspace(0, 20, 2001)
    correlation = model.correlation(r)
    values = np.interp(LENGTH, r, correlation), np.interp(-np.exp(-1), -correlation, r), of_fields(model, LENGTH)
    print(f"{name:20} {values[0]:.3f}  {values[1]:5.2f}  {values[2]:.3f}")
    return values


def close(seen, expected):
    return np.allclose(seen, expected, atol=(1e-3, 0.02, 0.02))


exponential = look("Exponential", gstools.Exponential(dim=2, len_scale=LENGTH))
gaussian = look("Gaussian", gstools.Gaussian(dim=2, len_scale=LENGTH))
rescaled = look("Gaussian, rescale=1", gstools.Gaussian(dim=2, len_scale=LENGTH, rescale=1))
at_quarter_pi, usual = np.exp(-np.pi / 4), np.exp(-1)
assert close(exponential, (usual, 10, usual))
assert close(gaussian, (at_quarter_pi, 20 / np.sqrt(np.pi), at_quarter_pi))
assert close(rescaled, (usual, 10, usual))
PYTHON
