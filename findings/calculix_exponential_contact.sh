#!/usr/bin/env bash
# One exponential pressure-overclosure law is three laws in CalculiX, by the type of the contact pair.
#
# One would guess that EXPONENTIAL with c0 and p0, that is p = p0 100^(d / c0) with the overclosure d,
# is the same law in every type of contact pair, apart from the accuracy.
# What happens, CalculiX 2.20 of Debian 12, two cubes, c0 = 1 um, p0 = 1 MPa, no error, no warning:
#   NODE TO SURFACE keeps the law on both sides of d = 0.
#   SURFACE TO SURFACE keeps it for d > 0. Below it the pressure is zero, so it jumps by p0 at d = 0.
#   MORTAR and LINMORTAR give nothing below d = 0 and 47 % to 18 % of the law above it. What they
#   give depends on the steps, too. A table of two points is followed exactly by the same model.
# Output seen (overclosure in um, pressure in MPa, share of the law):
#   NODE TO SURFACE       -0.501   0.100 1.000 |  0.177   2.263 1.000 |  0.428   7.183 1.000 |  0.623  17.655 1.000
#   SURFACE TO SURFACE    -0.500   0.000 0.000 |  0.177   2.263 1.000 |  0.428   7.183 1.000 |  0.623  17.655 1.000
#   MORTAR                -0.500   0.000 0.000 |  0.189   1.120 0.469 |  0.468   3.194 0.370 |  0.746   5.447 0.176
#   LINMORTAR             -0.500   0.000 0.000 |  0.189   1.120 0.469 |  0.468   3.194 0.370 |  0.746   5.447 0.176
#   MORTAR, one step       0.731   6.949 0.240
#   MORTAR, a table        0.154   4.615 1.000 |  0.385  11.538 1.000 |  0.615  18.461 1.000
# Why it matters: light rough contact is close to exponential in the gap of the mean planes, which is
# open as long as the law holds. SURFACE TO SURFACE drops all of that; MORTAR bears too little after it.
# In roughline: A joint for CalculiX is a table. An exponential law stands beside it only where it meets the
# loads within 5 %, and the file says which type of contact keeps which part of it.
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

SIDE, C0, P0 = 1e-3, 1e-6, 1e6
LAW = f"EXPONENTIAL\n{C0}, {P0}"

def run(kind, law, closings):
    square = [(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)]
    lines = ["*NODE, NSET=ALL"]
    for first, z in ((1, 0), (5, SIDE), (11, SIDE), (15, 2 * SIDE)):
        lines += [f"{first + i}, {x}, {y}, {z}" for i, (x, y) in enumerate(square)]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=CUBES", "1, 1,2,3,4,5,6,7,8", "2, 11,12,13,14,15,16,17,18"]
    lines += ["*NSET, NSET=FOOT", "1,2,3,4", "*NSET, NSET=HEAD", "15,16,17,18"]
    lines += ["*SURFACE, NAME=BELOW", "1, S2", "*SURFACE, NAME=ABOVE", "2, S1"]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "2e11, 0", "*SOLID SECTION, ELSET=CUBES, MATERIAL=STEEL"]
    lines += ["*SURFACE INTERACTION, NAME=JOINT", f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}"]
    lines += [f"*CONTACT PAIR, INTERACTION=JOINT, TYPE={kind}", "ABOVE, BELOW"]
    lines += ["*BOUNDARY", "ALL, 1, 2", "FOOT, 3, 3"]
    for closing in closings:
        lines += ["*STEP, NLGEOM", "*STATIC", "1, 1", "*BOUNDARY", f"HEAD, 3, 3, {-closing}"]
        lines += ["*NODE PRINT, NSET=FOOT, TOTALS=ONLY", "RF", "*END STEP"]
    open("cubes.inp", "w").write("\n".join(lines) + "\n")
    subprocess.run([os.environ["CCX"], "cubes"], check=True, stdout=subprocess.DEVNULL)
    rows = [line.split() for line in open("cubes.dat") if re.match(r"\s+-?\d", line)]
    pressures = [float(row[2]) / SIDE**2 for row in rows]
    assert len(pressures) == len(closings)
    return [(d - 2 * SIDE * p / 2e11, p) for d, p in zip(closings, pressures)]  # less what the cubes give

def show(name, states, law):
    shares = [p / law(d) for d, p in states]
    print(f"{name:20}", " | ".join(f"{d * 1e6:6.3f} {abs(p) / 1e6:7.3f} {abs(s):.3f}" for (d, p), s in zip(states, shares)))
    return shares

def differs(seen, expected):
    return any(abs(a - b) > 0.01 for a, b in zip(seen, expected, strict=True))

exponential = lambda d: P0 * 100 ** (d / C0)
closings = (-0.5e-6, 0.2e-6, 0.5e-6, 0.8e-6)
mortar = (0, 0.469, 0.370, 0.176)
seen = {"NODE TO SURFACE": (1, 1, 1, 1), "SURFACE TO SURFACE": (0, 1, 1, 1), "MORTAR": mortar, "LINMORTAR": mortar}
changed = [k for k, shares in seen.items() if differs(show(k, run(k, LAW, closings), exponential), shares)]
changed += ["one step"] * differs(show("MORTAR, one step", run("MORTAR", LAW, (0.8e-6,)), exponential), (0.240,))
table = run("MORTAR", "TABULAR\n0, 0\n3e7, 1e-6", closings[1:])
changed += ["table"] * differs(show("MORTAR, a table", table, lambda d: 3e13 * d), (1, 1, 1))
raise SystemExit(f"Changed: {changed}" if changed else 0)
PYTHON
