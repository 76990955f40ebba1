#!/usr/bin/env bash
# A linear pressure-overclosure law pulls in CalculiX, in one of the two penalty types of contact.
#
# One would guess that LINEAR with a slope K is p = K d where the surfaces overlap by d, and nothing where they are
# apart, in every type of contact pair.
# What happens, CalculiX 2.20 of Debian 12, two steel cubes of 1 mm, K = 30 MPa/um, no error, no warning:
#   SURFACE TO SURFACE is as guessed.
#   NODE TO SURFACE rounds the corner off, p = K d [1/2 + arctan(d / eps) / pi]. Told no tension, it pulls with
#   2.5 MPa where the surfaces are 0.5 um apart, and bears 0.66 and 0.86 of the law at overlaps of 0.17 and 0.64 um.
#   A second number, the tension, makes the corner sharper: of 0.01 MPa, it leaves the law. Two micrometres apart
#   no contact is looked for.
# Output seen (overclosure in um, pressure in MPa):
#   SURFACE TO SURFACE 3e13           -2.000   0.000 | -0.500   0.000 | -0.100   0.000 |  0.154   4.615 |  0.615  18.461
#   NODE TO SURFACE    3e13           -2.000   0.000 | -0.475  -2.549 | -0.089  -1.090 |  0.167   3.314 |  0.636  16.407
#   NODE TO SURFACE    3e13, 1e6      -2.000   0.000 | -0.490  -0.985 | -0.093  -0.749 |  0.161   3.934 |  0.623  17.699
#   NODE TO SURFACE    3e13, 1e4      -2.000   0.000 | -0.500  -0.010 | -0.100  -0.010 |  0.154   4.608 |  0.615  18.453
# Why it matters: rough joints are light, so that much of such a joint lies about the corner. It carries tension
# there, and an opened seal or a rocking foot is held down.
# In roughline: A joint for CalculiX is a table. The one linear law in it, with heat, is said to be for SURFACE
# TO SURFACE alone.
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

SIDE, YOUNG = 1e-3, 2e11
CLOSINGS = (-2e-6, -0.5e-6, -1e-7, 2e-7, 8e-7)
CASES = (
    ("SURFACE TO SURFACE", "3e13", (0, 0, 0, 4.615, 18.461)),
    ("NODE TO SURFACE", "3e13", (0, -2.549, -1.090, 3.314, 16.407)),
    ("NODE TO SURFACE", "3e13, 1e6", (0, -0.985, -0.749, 3.934, 17.699)),
    ("NODE TO SURFACE", "3e13, 1e4", (0, -0.010, -0.010, 4.608, 18.453)),
)


def run(kind, law):
    """Overclosures and pressures: what the cubes give is taken off what they are closed by."""
    square = [(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)]
    lines = ["*NODE, NSET=ALL"]
    for first, z in ((1, 0), (5, SIDE), (11, SIDE), (15, 2 * SIDE)):
        lines += [f"{first + i}, {x}, {y}, {z}" for i, (x, y) in enumerate(square)]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=CUBES", "1, 1,2,3,4,5,6,7,8", "2, 11,12,13,14,15,16,17,18"]
    lines += ["*NSET, NSET=FOOT", "1,2,3,4", "*NSET, NSET=HEAD", "15,16,17,18"]
    lines += ["*SURFACE, NAME=BELOW", "1, S2", "*SURFACE, NAME=ABOVE", "2, S1"]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{YOUNG:g}, 0", "*SOLID SECTION, ELSET=CUBES, MATERIAL=STEEL"]
    lines += ["*SURFACE INTERACTION, NAME=JOINT", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", law]
    lines += [f"*CONTACT PAIR, INTERACTION=JOINT, TYPE={kind}", "ABOVE, BELOW"]
    lines += ["*BOUNDARY", "ALL, 1, 2", "FOOT, 3, 3"]
    for closing in CLOSINGS:
        lines += ["*STEP, NLGEOM", "*STATIC", "1, 1", "*BOUNDARY", f"HEAD, 3, 3, {-closing}"]
        lines += ["*NODE PRINT, NSET=FOOT, TOTALS=ONLY", "RF", "*END STEP"]
    open("cubes.inp", "w").write("\n".join(lines) + "\n")
    subprocess.run([os.environ["CCX"], "cubes"], check=True, stdout=subprocess.DEVNULL)
    rows = [line.split() for line in open("cubes.dat") if re.match(r"\s+-?\d", line)]
    assert len(rows) == len(CLOSINGS)
    pressures = [float(row[2]) / SIDE**2 for row in rows]
    return [(closing - 2 * SIDE * p / YOUNG, p) for closing, p in zip(CLOSINGS, pressures)]


changed = []
for kind, law, expected in CASES:
    states = run(kind, law)
    shown = " |".join(f"{1e6 * d:7.3f} {round(p / 1e6, 3) + 0.0:7.3f}" for d, p in states)
    print(f"{kind:18} {law:14} {shown}")
    seen = [p / 1e6 for _, p in states]
    changed += [(kind, law)] * any(abs(a - b) > 0.01 * abs(b) + 0.002 for a, b in zip(seen, expected, strict=True))
raise SystemExit(f"Changed: {changed}" if changed else 0)
PYTHON
