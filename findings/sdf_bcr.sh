#!/usr/bin/env bash
# A surface file of BCR-1.0 is upside down in sdfio, and its missing points are heights in Gwyddion.
#
# One would guess that BCR-1.0 is ISO-1.0 under its older name: one header, one order of the rows, and the
# least number of the type where nothing was measured.
# What happens, sdfio 2.0.0 and Gwyddion (the converter of gwyddionpy 0.1.0), 16-bit integers in two files
# that differ in the first eight letters alone, bISO-1.0 and bBCR-1.0:
#   Gwyddion reads both alike: -32768 was not measured and is filled in from its neighbours, 32767 is a height.
#   sdfio agrees for ISO-1.0. It turns the rows of BCR-1.0 round, as its pages say that MountainsMap does,
#   BCR having named no direction. And there 32767 was not measured, and -32768 is a height: the mark of BCR
#   is the greatest number, they say, as it had unsigned types as well.
# Output seen (nm, row by row; -- where not measured):
#   the file               0      1      2 |      3      4      5 |      6  32767 -32768
#   ISO-1.0, sdfio         0      1      2 |      3      4      5 |      6  32767     --
#   ISO-1.0, Gwyddion      0      1      2 |      3      4      5 |      6  32767  16386
#   BCR-1.0, sdfio         6     -- -32768 |      3      4      5 |      0      1      2
#   BCR-1.0, Gwyddion      0      1      2 |      3      4      5 |      6  32767  16386
# Why it matters: one missing point that is a height of 32767 steps is the peak that carries the contact, and
# a surface upside down has another lay and meets another partner.
# In roughline: Rows of BCR are in the order of the file, as Gwyddion has them, and both numbers are missing
# points. The handbook's list of formats names the difference.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: \
  'sdfio==2.0.0' 'gwyddionpy==0.1.0' 'gwyddionpy-converter==0.1.0' 'gwyfile==0.3.0' 'numpy==2.4.6'
cd "$folder"
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import struct
from pathlib import Path

import gwyddionpy
import numpy as np
import sdfio

STORED = np.array([[0, 1, 2], [3, 4, 5], [6, 32767, -32768]], "<i2")
file = Path("surface.sdf")


def write(name):
    date, unknown = b"010120260000", -1.0
    fields = (b"profiler  ", date, date, 3, 3, 1e-6, 1e-6, 1e-9, unknown, 0, 5, 0)
    file.write_bytes(b"b" + name + struct.pack("<10s12s12sHHddddBBB", *fields) + STORED.tobytes())


def of_gwyddion():
    (channel,) = gwyddionpy.load(file).channels.values()
    return np.array(channel.data)


def show(name, heights):
    rows = (" ".join("    --" if np.isnan(h) else f"{h * 1e9:6.0f}" for h in row) for row in heights)
    print(f"{name:17}", " | ".join(rows))


def check(name, found, expected):
    show(name, found)
    assert np.allclose(found * 1e9, expected, atol=1e-3, equal_nan=True)


gwyddion = [[0, 1, 2], [3, 4, 5], [6, 32767, (5 + 32767) / 2]]
show("the file", STORED * 1e-9)
write(b"ISO-1.0")
check("ISO-1.0, sdfio", sdfio.read(file).data, [[0, 1, 2], [3, 4, 5], [6, 32767, np.nan]])
check("ISO-1.0, Gwyddion", of_gwyddion(), gwyddion)
write(b"BCR-1.0")
check("BCR-1.0, sdfio", sdfio.read(file).data, [[6, np.nan, -32768], [3, 4, 5], [0, 1, 2]])
check("BCR-1.0, Gwyddion", of_gwyddion(), gwyddion)
PYTHON
