#!/usr/bin/env bash
# Two functions of one package want two moduli: the approach of Hertz comes out 37 % too small.
#
# One would guess that the effective modulus that tribology's eeff returns is the one that all its functions of
# Hertz's contact take.
# What happens, tribology 0.4.5, two steel balls of 20 mm, 10 N:
#   eeff is the modulus of lubrication, 2 / [(1 - nu^2) / E of one + the other], twice that of contact mechanics.
#   ahertz and phertz take it so, and are right: area and mean pressure are Hertz's.
#   dhertz names its argument e_eff as well, but reads it as the modulus of contact mechanics: with eeff's the
#   approach is 2^(-2/3) = 0.63 of Hertz's. Given half of it, it is right.
# Output seen (over Hertz's):
#   ahertz, area               1.000
#   phertz, mean pressure      1.000
#   dhertz, approach           0.630
#   dhertz, half the modulus   1.000
# Why it matters: area and pressure, which one checks first, agree, so the approach and with it the stiffness
# of a ball contact are believed: a stiffness of 1.59 times the true one.
# In roughline: There is one modulus of contact, E*. rl.contact_modulus returns it of two materials, and all
# formulas take it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: \
  'numpy==2.4.6' 'scipy==1.17.1' 'matplotlib==3.11.2' 'setuptools==80.9.0' 'opencv-python-headless==5.0.0.93' \
  'numexpr==2.14.1'
"$folder/env/bin/pip" install -q --no-deps 'tribology==0.4.5'
OMP_NUM_THREADS=1 "$folder/env/bin/python" -W ignore - <<'PYTHON'
import math

import tribology

RADIUS, FORCE, YOUNG, POISSON = 0.01, 10.0, 200e9, 0.3
contact_modulus, radius = YOUNG / (1 - POISSON**2) / 2, RADIUS / 2
a = (3 * FORCE * radius / (4 * contact_modulus)) ** (1 / 3)

modulus = tribology.eeff(YOUNG, POISSON, YOUNG, POISSON)
radii = tribology.reff(*[RADIUS] * 4)
seen = {
    "ahertz, area": tribology.ahertz(*radii, modulus, FORCE)[2] / (math.pi * a**2),
    "phertz, mean pressure": tribology.phertz(*radii, modulus, FORCE) * math.pi * a**2 / FORCE,
    "dhertz, approach": tribology.dhertz(modulus, *[RADIUS] * 4, FORCE) / (a**2 / radius),
    "dhertz, half the modulus": tribology.dhertz(modulus / 2, *[RADIUS] * 4, FORCE) / (a**2 / radius),
}
for name, ratio in seen.items():
    print(f"{name:26} {ratio:.3f}")
expected = (1, 1, 2 ** (-2 / 3), 1)
assert all(math.isclose(ratio, right, rel_tol=1e-9) for ratio, right in zip(seen.values(), expected, strict=True))
assert math.isclose(modulus, 2 * contact_modulus)
PYTHON
