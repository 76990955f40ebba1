#!/usr/bin/env bash
# A decimal comma is no comma to Pint: 1,5 mm are 15 mm, and 0,5 N are none.
#
# One would guess that a number with a decimal comma is refused, or that it is read as the number that was meant.
# What happens, Pint 0.25.3, its default registry, text given to Quantity:
#   Commas are taken out before the text is read, as if they parted thousands. Three digits behind one are read as
#   that, two or one as well. What is left of 0,5 begins with a zero, 05, and is read as nothing. A blank between
#   thousands, as the SI brochure wants it, drops what stands before it. Nothing is said.
# Output seen:
#   1,5 mm       15 millimeter
#   12,50 MPa    1250 megapascal
#   3,2e-3 m     0.032 meter
#   0,5 N        0 newton
#   0,001 mm     0 millimeter
#   1.234,5 mm   1.2345 millimeter
#   1,234.5 mm   1234.5 millimeter
#   1 234 mm     234 millimeter
# Why it matters: instruments and spreadsheets of half of the world write decimal commas. The unit is right, so no
# check of dimensions finds a thickness that is ten times the true one, or a force of zero.
# In roughline: A decimal comma is refused, in one line that shows the number with a point.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'pint==0.25.3'
"$folder/env/bin/python" -W error - <<'PYTHON'
import pint

SEEN = {
    "1,5 mm": (15, "millimeter"),
    "12,50 MPa": (1250, "megapascal"),
    "3,2e-3 m": (0.032, "meter"),
    "0,5 N": (0, "newton"),
    "0,001 mm": (0, "millimeter"),
    "1.234,5 mm": (1.2345, "millimeter"),
    "1,234.5 mm": (1234.5, "millimeter"),
    "1 234 mm": (234, "millimeter"),
}
registry = pint.UnitRegistry()
changed = []
for text, (magnitude, unit) in SEEN.items():
    read = registry.Quantity(text)
    print(f"{text:12} {read}")
    if read.magnitude != magnitude or str(read.units) != unit:
        changed.append(text)
raise SystemExit(f"Changed: {changed}" if changed else 0)
PYTHON
