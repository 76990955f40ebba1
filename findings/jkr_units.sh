#!/usr/bin/env bash
# The contact radius that Adhesion gives a sticking sphere hangs on the units: newtons and mm give none.
#
# One would guess that JKR.contact_radius, given penetration, radius, modulus and work of adhesion, returns
# one and the same radius in any consistent units, or a number to scale back.
# What happens, Adhesion 0.93, a sphere of 1 mm on a gel, E* = 0.1 MPa, work of adhesion 0.05 J/m^2:
#   In metres and pascals it is right at every penetration down to the pull-off, -10.1 um.
#   In millimetres and megapascals it is 0 at negative penetrations, where the sphere still sticks, and
#   Newton's method finds none from zero on. force(penetration=...) does the same. The zeros raise no warning.
#   The method starts from the radius at pull-off, which goes as K^(-1/3), K = 4 E* / 3, but is taken to go
#   as K^(1/3). Both are one at K = 1, the default. Above, the start is too far and still finds the root.
#   Below, it lies on the wrong side of the minimum, and the pull-off too close to zero.
#   contact_radius(force=...) needs no start, and is right in both (shown where the force rises with depth).
# Output seen (penetration in um; contact radius in um):
#   penetration                -9.0   -5.0   -1.0    0.0   10.0
#   JKR                        86.5  120.1  141.8  146.5  184.6
#   metres, pascals            86.5  120.1  141.8  146.5  184.6
#   millimetres, megapascals    0.0    0.0    0.0   none   none
#   the same, from the force                141.8  146.5  184.6
# Why it matters: fits of indentation of soft matter are made in such units, and a radius of zero looks like
# a sphere that has let go.
# In roughline: Bodies that stick are scaled before they are solved. The same one in other units has the same
# answer, which tests hold.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: \
  'Adhesion==0.93' 'ContactMechanics==1.8.3' 'SurfaceTopography==1.27.1'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import warnings

import numpy as np
from Adhesion.ReferenceSolutions import JKR
from scipy.optimize import brentq

RADIUS, MODULUS, WORK = 1e-3, 1e5, 0.05
PENETRATIONS = np.array([-9e-6, -5e-6, -1e-6, 0.0, 10e-6])
AT_PULL_OFF = (np.pi * WORK * RADIUS**2 / (8 * MODULUS)) ** (1 / 3)
warnings.simplefilter("error")
warnings.filterwarnings("ignore", message="invalid value encountered in sqrt")  # where no radius is found


def jkr(penetration):
    """The stable root of a^2 / R - sqrt(2 pi a w / E*) = penetration."""
    equation = lambda a: a**2 / RADIUS - np.sqrt(2 * np.pi * a * WORK / MODULUS) - penetration
    return brentq(equation, AT_PULL_OFF, 100 * AT_PULL_OFF)


def parameters(length):
    return {"radius": RADIUS / length, "contact_modulus": MODULUS * length**2, "work_of_adhesion": WORK * length}


def radii(length):
    """Contact radii in metres, computed with the unit of length given; no number where there is none."""
    found = []
    for penetration in PENETRATIONS / length:
        try:
            found.append(length * JKR.contact_radius(penetration=penetration, **parameters(length)))
        except RuntimeError as error:
            assert "Failed to converge" in str(error)
            found.append(np.nan)
    return np.array(found)


def show(name, values):
    print(f"{name:24}", *("  none" if np.isnan(value) else f"{value * 1e6:6.1f}" for value in values))


exact = np.array([jkr(penetration) for penetration in PENETRATIONS])
forces = 2 * MODULUS * exact * (PENETRATIONS - exact**2 / (3 * RADIUS))
by_force = np.array([1e-3 * JKR.contact_radius(force=force, **parameters(1e-3)) for force in forces[2:]])
metres, millimetres = radii(1.0), radii(1e-3)
print(f"{'penetration':24}", *(f"{value * 1e6:6.1f}" for value in PENETRATIONS))
show("JKR", exact)
show("metres, pascals", metres)
show("millimetres, megapascals", millimetres)
print(f"{'the same, from the force':24}", " " * 13, *(f"{value * 1e6:6.1f}" for value in by_force))
assert np.allclose(metres, exact, rtol=1e-5)
assert np.array_equal(millimetres, [0, 0, 0, np.nan, np.nan], equal_nan=True)
assert np.allclose(by_force, exact[2:], rtol=1e-5)
PYTHON
