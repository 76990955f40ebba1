#!/usr/bin/env bash
# Hard contact and sticking friction in CalculiX are as hard as the unit of length is small.
#
# One would guess that a model in metres, one in millimetres and one in micrometres, each with its own consistent
# units, give one answer, and that hard contact is rigid and friction without a stick slope sticks.
# What happens, CalculiX 2.20 of Debian 12, two steel cubes of 1 mm, pressed by 1 um (100 MPa if rigid), then
# slid by 0.1 um, no error, no warning:
#   Where no stiffness is told, the surfaces are joined by springs of 50 E per unit of length, whatever the unit, and
#   along them by E / 2 per unit of length. In metres steel has a spring of 10 MPa/um there: the pressure is a
#   tenth of that of rigid contact. In millimetres it is 1 % low, in micrometres 0.1 %. Sticking friction at the
#   slide of 0.1 um is 0.01, 10 and 30 MPa: nothing, a third of what slips, and all of it.
# Output seen (MPa: pressure of NODE TO SURFACE and SURFACE TO SURFACE, friction of both; coefficient 0.3):
#   metres          7.03    9.09    0.01    0.01
#   millimetres    98.91   98.94   10.00   10.00
#   micrometres    99.93   99.92   29.98   29.98
# Why it matters: meshes of rough surfaces are made in metres, as files of instruments are. A joint of them is then
# ten times softer than its roughness, and its fretting slip is all spring. Tell stiffness and stick slope.
# In roughline: A joint for CalculiX states its pressure over the overclosure, in metres and pascals, so that
# none is made up.
set -euo pipefail
for tool in apt-get dpkg; do
  command -v "$tool" >/dev/null || { echo "This needs apt-get and dpkg of Debian 12."; exit 1; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -q download calculix-ccx=2.20-1 libspooles2.2 libarpack2 liblapack3 libblas3 libgfortran5 \
  libquadmath0 libopenmpi3 libhwloc15 libevent-core-2.1-7 libevent-pthreads-2.1-7 >/dev/null 2>&1 ||
  { echo "This needs the packages of Debian 12: run apt-get update first."; exit 1; }
for package in *.deb; do dpkg -x "$package" root; done
LD_LIBRARY_PATH=$(find root -name '*.so*' -printf "$folder/%h\n" | sort -u | paste -sd:)
CCX=$(find "$folder/root" -type f -name ccx)
export LD_LIBRARY_PATH CCX OMP_NUM_THREADS=1
python3 - <<'PYTHON'
import os, re, subprocess

YOUNG, SIDE, CLOSING, SLIDE = 2e11, 1e-3, 1e-6, 1e-7  # Pa, m


def run(kind, length):
    """Pressure and friction in MPa, of a model with this unit of length in metres, and the newton."""
    side, young = SIDE / length, YOUNG * length**2
    square = [(0, 0), (side, 0), (side, side), (0, side)]
    lines = ["*NODE, NSET=ALL"]
    for first, z in ((1, 0), (5, side), (11, side), (15, 2 * side)):
        lines += [f"{first + i}, {x:.9g}, {y:.9g}, {z:.9g}" for i, (x, y) in enumerate(square)]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=CUBES", "1, 1,2,3,4,5,6,7,8", "2, 11,12,13,14,15,16,17,18"]
    lines += ["*NSET, NSET=FOOT", "1,2,3,4", "*NSET, NSET=HEAD", "15,16,17,18"]
    lines += ["*NSET, NSET=LOWER", "1,2,3,4,5,6,7,8", "*NSET, NSET=UPPER", "11,12,13,14,15,16,17,18"]
    lines += ["*SURFACE, NAME=BELOW", "1, S2", "*SURFACE, NAME=ABOVE", "2, S1"]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{young:.9g}, 0"]
    lines += ["*SOLID SECTION, ELSET=CUBES, MATERIAL=STEEL", "*SURFACE INTERACTION, NAME=JOINT"]
    lines += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD", "*FRICTION", "0.3"]
    lines += [f"*CONTACT PAIR, INTERACTION=JOINT, TYPE={kind}", "ABOVE, BELOW"]
    lines += ["*BOUNDARY", "ALL, 2, 2", "LOWER, 1, 1", "FOOT, 3, 3"]
    for slide in (0, SLIDE):
        lines += ["*STEP, NLGEOM", "*STATIC", "1, 1", "*BOUNDARY", f"HEAD, 3, 3, {-CLOSING / length:.9g}"]
        lines += [f"UPPER, 1, 1, {slide / length:.9g}"]
        lines += ["*NODE PRINT, NSET=LOWER, TOTALS=ONLY", "RF", "*END STEP"]
    open("cubes.inp", "w").write("\n".join(lines) + "\n")
    subprocess.run([os.environ["CCX"], "cubes"], check=True, stdout=subprocess.DEVNULL)
    rows = [line.split() for line in open("cubes.dat") if re.match(r"\s+-?\d", line)]
    assert len(rows) == 2
    return [abs(float(force)) / SIDE**2 / 1e6 for force in (rows[0][2], rows[1][0])]


expected = {"metres": (7.03, 9.09, 0.01, 0.01), "millimetres": (98.91, 98.94, 10, 10)}
expected["micrometres"] = (99.92, 99.92, 29.98, 29.98)
changed = []
for (name, values), length in zip(expected.items(), (1, 1e-3, 1e-6), strict=True):
    (p_nodes, q_nodes), (p_faces, q_faces) = run("NODE TO SURFACE", length), run("SURFACE TO SURFACE", length)
    seen = (p_nodes, p_faces, q_nodes, q_faces)
    print(f"{name:12}", *(f"{value:7.2f}" for value in seen))
    changed += [name] * any(abs(a - b) > 0.01 * b + 0.006 for a, b in zip(seen, values, strict=True))
raise SystemExit(f"Changed: {changed}" if changed else 0)
PYTHON
