#!/usr/bin/env bash
# The channels that gwyfile lists of a Gwyddion file go by their titles: of trace and retrace one is left.
#
# One would guess that util.get_datafields gives every data field of the file.
# What happens, gwyfile 0.3.0, a file of three height maps, trace and retrace, both named Height, and one
# that nobody has named:
#   The fields come in a dictionary by title, so the later Height takes the place of the earlier one, and a
#   field without a title, which the format allows, is left out. Nothing is said. The container that it was
#   made from holds all three, as /0/data, /1/data and /2/data.
#   gwyddionpy 0.1.0, which reads by gwyfile as well, lists three and numbers the names.
# Output seen (title and height of the first point):
#   gwyfile      Height 2
#   gwyddionpy   Height 1, Height (2) 2, Channel 2 3
#   container    /0/data 1, /1/data 2, /2/data 3
# Why it matters: a script that takes the height map of a title takes the retrace, without knowing that
# there was a choice, and one that counts channels finds fewer than Gwyddion shows.
# In roughline: Files of Gwyddion are read without that list: every channel can be had by its number, and those
# of one name are told by trace and retrace.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'gwyfile==0.3.0' 'gwyddionpy==0.1.0' 'numpy==2.4.6'
cd "$folder"
OMP_NUM_THREADS=1 "$folder/env/bin/python" -W error - <<'PYTHON'
import gwyddionpy
import gwyfile
import numpy as np
from gwyfile.objects import GwyContainer, GwyDataField, GwySIUnit


def field(height):
    units = {"si_unit_xy": GwySIUnit(unitstr="m"), "si_unit_z": GwySIUnit(unitstr="m")}
    return GwyDataField(np.full((2, 3), height), xreal=3e-6, yreal=2e-6, **units)


def show(name, found):
    print(f"{name:12}", ", ".join(f"{title} {height:.0f}" for title, height in found.items()))
    return found


made = GwyContainer()
for number, title in enumerate(("Height", "Height", None)):
    made[f"/{number}/data"] = field(number + 1.0)
    if title is not None:
        made[f"/{number}/data/title"] = title
made.tofile("scan.gwy")

container = gwyfile.load("scan.gwy")
listed = {title: data.data[0, 0] for title, data in gwyfile.util.get_datafields(container).items()}
numbered = {title: channel.data[0, 0] for title, channel in gwyddionpy.load("scan.gwy").channels.items()}
held = {key: data.data[0, 0] for key, data in container.items() if isinstance(data, GwyDataField)}
assert show("gwyfile", listed) == {"Height": 2}
assert show("gwyddionpy", numbered) == {"Height": 1, "Height (2)": 2, "Channel 2": 3}
assert show("container", held) == {"/0/data": 1, "/1/data": 2, "/2/data": 3}
PYTHON
