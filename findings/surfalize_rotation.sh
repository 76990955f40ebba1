#!/usr/bin/env bash
# surfalize turns the picture and not the surface where the steps along x and y differ.
#
# One would guess that rotate(angle) keeps the surface and turns it: its rms slope and its period stay.
# What happens, surfalize 0.19.2, a wave of 10 um along y on 0.5 um by 1 um steps, turned by 30 degrees:
#   The grid is turned as if its points were square, and the steps then become 0.661 and 0.901 um. The
#   wave comes out 1.22 times shorter and steeper: its wavenumbers along x and y are 2 pi / 10 um times
#   sin(30) / 0.661 and cos(30) / 0.901. Its heights stay. A quarter turn is right, and so is any turn of
#   equal steps. Unlike steps raise one general warning whenever a surface is made. The turn adds no
#   word of its own, and its new steps look as if the matter had been taken care of.
# Output seen (Sdq over that before, Sq over that before, steps in um):
#   steps 0.5, 1.0, by 90 degrees: Sdq x 1.002, Sq x 0.998, steps 1.000, 0.500
#   steps 0.5, 1.0, by 30 degrees: Sdq x 1.231, Sq x 0.998, steps 0.661, 0.901
#   steps 1.0, 1.0, by 30 degrees: Sdq x 1.006, Sq x 0.998, steps 1.000, 1.000
# Why it matters: profilers often have unlike steps, and a scan is turned to lay its lines along an axis.
# Slope, area and period then belong to another surface, and contact, which follows the slope, with them.
# In roughline: Maps are not turned by an angle. Their steps along x and y may differ everywhere.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'surfalize==0.19.2'
"$folder/env/bin/python" - <<'PYTHON'
import warnings

import numpy as np
from surfalize import Surface


def wave(step_x, step_y):
    rows = np.arange(256)[:, None] * np.ones(256)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        surface = Surface(np.cos(2 * np.pi * rows * step_y / 10), step_x, step_y)
    assert len(caught) == (step_x != step_y)
    return surface


def turned(step_x, angle):
    before = wave(step_x, 1.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", message="The surface has different pixel size")
        after = before.rotate(angle)
    slope, height = after.Sdq() / before.Sdq(), after.Sq() / before.Sq()
    steps = f"{after.step_x:.3f}, {after.step_y:.3f}"
    print(f"steps {step_x}, 1.0, by {angle} degrees: Sdq x {slope:.3f}, Sq x {height:.3f}, steps {steps}")
    assert abs(height - 1) < 0.01
    return slope, after.step_x, after.step_y


def close(seen, expected):
    return np.allclose(seen, expected, rtol=0.02)


s, c = np.sin(np.pi / 6), np.cos(np.pi / 6)
steps = np.hypot(0.5 * c, s), np.hypot(0.5 * s, c)
assert close(turned(0.5, 90), (1.0, 1.0, 0.5))
assert close(turned(0.5, 30), (np.hypot(s / steps[0], c / steps[1]), *steps))
assert close(turned(1.0, 30), (1.0, 1.0, 1.0))
PYTHON
