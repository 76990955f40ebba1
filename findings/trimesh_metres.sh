#!/usr/bin/env bash
# trimesh joins points within 10 nm of each other where the file is in metres: a fine scan is lost.
#
# One would guess that an STL file, which states no unit, gives the same surface in metres as in
# micrometres, and that the joining of equal points on reading joins equal points only.
# What happens, trimesh 5.2.0, waves of 32 nm on a square of 256 nm, 257 x 257 points, 1 nm apart:
#   Points are joined where their coordinates agree in eight places behind the decimal point, whatever the
#   unit. In micrometres these are the equal ones. In metres they are all those within one box of 10 nm:
#   729 of 66049 points are left. All faces stay, 99 in 100 of them without area. Of the area that the
#   waves add to that of the plane, .077, some .03 is gone. No error, no warning, on reading a file and on
#   making a mesh from arrays alike. process=False keeps all points.
# Output seen (area over that of the plane):
#   read, in um                   points 66049  faces 131072  without area      0  area 1.077
#   read, in m                    points   729  faces 131072  without area 129720  area 1.044
#   made from arrays, in m        points   729  faces 131072  without area 129720  area 1.048
#   made with process=False, in m points 66049  faces 131072  without area      0  area 1.077
# Why it matters: files for finite elements are often in metres, and points of an AFM scan a nanometre apart.
# What is left is as large as before and has a point every 10 nm: its slopes and its contact are others.
# In roughline: Meshes are not read. Maps keep all their points in any unit.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'trimesh==5.2.0' 'numpy==2.4.6'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import io
import logging
import warnings

import numpy as np
import trimesh

N = 257
warnings.simplefilter("error")
messages = io.StringIO()
logging.basicConfig(stream=messages, level=logging.WARNING)


def wave(side):
    """Points and faces of eight waves along x and y on a square of the given side."""
    x, y = np.meshgrid(np.linspace(0, side, N), np.linspace(0, side, N), indexing="ij")
    z = 0.008 * side * (np.cos(16 * np.pi * x / side) + np.cos(16 * np.pi * y / side))
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    number = np.arange(N * N).reshape(N, N)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    return points, np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]).reshape(-1, 3)


def read(side):
    file = io.BytesIO(trimesh.Trimesh(*wave(side), process=False).export(file_type="stl"))
    return trimesh.load(file, file_type="stl")


def show(name, mesh, side):
    points, flat, area = len(mesh.vertices), int((mesh.area_faces == 0).sum()), mesh.area / side**2
    counts = f"points {points:5}  faces {len(mesh.faces)}  without area {flat:6}"
    print(f"{name:29} {counts}  area {area:.3f}")
    return points, area


def close(seen, expected):
    return seen[0] == expected[0] and abs(seen[1] - expected[1]) < 2e-3


UM, M = 0.256, 256e-9
assert close(show("read, in um", read(UM), UM), (N * N, 1.077))
assert close(show("read, in m", read(M), M), (729, 1.044))
assert close(show("made from arrays, in m", trimesh.Trimesh(*wave(M)), M), (729, 1.048))
whole = trimesh.Trimesh(*wave(M), process=False)
assert close(show("made with process=False, in m", whole, M), (N * N, 1.077))
assert messages.getvalue() == ""
PYTHON
