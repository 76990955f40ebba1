#!/usr/bin/env bash
# CalculiX reads twenty characters of a number, so heights written in full are a thousand times too tall.
#
# One would guess that more digits do no harm, and that a number too long for a program is refused.
# What happens, CalculiX 2.20 of Debian 12, a block 1.234567890123456789 mm tall, given in metres:
#   Of every number the first 20 characters are read and the rest is dropped. NumPy's savetxt writes %.18e
#   unless told, which is 24 characters: its exponent is cut off, and the block is 1.23 m tall. With %.15e
#   the exponent loses its last digit, e-03 becomes e-0, with the same end. Neither is an error or a warning.
#   Only where the cut leaves a bare e or e- (%.17e, %.16e) the line is refused.
#   Up to 20 characters, or with all digits behind a plain point, all is well.
# Output seen (height taken from the volume of the element):
#   1.23456789012346e-03      20 characters  0.001234568 m
#   0.00123456789012345671    22 characters  0.001234568 m
#   1.234567890123457e-03     21 characters  1.234568 m
#   1.2345678901234567e-03    22 characters  refused
#   1.23456789012345671e-03   23 characters  refused
#   1.234567890123456713e-03  24 characters  1.234568 m
# Why it matters: heights of rough surfaces in metres have digits to the end and an exponent. A mesh of them
# that a script has written is the very case.
# In roughline: Numbers of a joint for CalculiX have ten digits, and sixteen characters at most.
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
from pathlib import Path

SIDE, HEIGHT = 1e-3, 1.234567890123456789e-3


def height_read(number):
    """The height of a block whose upper nodes stand at `number`, or None where the line is refused."""
    square = [(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)]
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i + 1}, {x}, {y}, 0." for i, (x, y) in enumerate(square)]
    lines += [f"{i + 5}, {x}, {y}, {number}" for i, (x, y) in enumerate(square)]
    lines += ["*NSET, NSET=FOOT", "1, 2, 3, 4", "*ELEMENT, TYPE=C3D8, ELSET=BLOCK", "1, 1,2,3,4,5,6,7,8"]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "2e11, 0", "*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL"]
    lines += ["*BOUNDARY", "ALL, 1, 2", "FOOT, 3, 3", "*STEP", "*STATIC", "*CLOAD", "5, 3, 1e-3"]
    lines += ["*EL PRINT, ELSET=BLOCK", "EVOL", "*END STEP"]
    Path("block.inp").write_text("\n".join(lines) + "\n")
    Path("block.dat").unlink(missing_ok=True)
    done = subprocess.run([os.environ["CCX"], "block"], capture_output=True, text=True)
    if done.returncode:
        assert "ERROR reading *NODE" in done.stdout
        return None
    assert not re.search(r"\*(ERROR|WARNING)", done.stdout)
    row = [line.split() for line in Path("block.dat").read_text().splitlines() if re.match(r"\s+1\s", line)]
    return float(row[0][1]) / SIDE**2


seen = {}
for form in ("%.14e", "%.20f", "%.15e", "%.16e", "%.17e", "%.18e"):
    number = form % HEIGHT
    seen[form] = height_read(number)
    told = "refused" if seen[form] is None else f"{seen[form]:.7g} m"
    print(f"{number:24}  {len(number)} characters  {told}")
right, tall, refused = 0.001234568, 1.234568, None
expected = {"%.14e": right, "%.20f": right, "%.15e": tall, "%.16e": refused, "%.17e": refused, "%.18e": tall}
for form, height in expected.items():
    assert (seen[form] is None) == (height is None), form
    assert height is None or abs(seen[form] / height - 1) < 1e-5, form
PYTHON
