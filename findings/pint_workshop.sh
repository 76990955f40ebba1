#!/usr/bin/env bash
# Units as a workshop writes them are other units to Pint: a ton of 907 kg, a roughness Ra of many years.
#
# One would guess that what Pint reads is what was meant, and that it refuses what it does not know.
# What happens, Pint 0.25.3, its default registry:
#   A ton is the short ton of the United States, not 1000 kg (tonne, t, which are). ton_force follows it.
#   Prefixes stand before short symbols of anything: a is a year, so Ra is a ronna-year, 10^27 years, and Pa is
#   safe only because pascal is defined by that name. 'Ra 0.8 um' is a product of both.
#   b is a barn, pt a pint, at a technical atmosphere, grade an angle. An inch mark is dropped: 1" is the number 1.
#   kp, sccm, Torr and HV are refused (torr is known).
# Output seen (in SI):
#   1 ton           907.185 kilogram
#   1 tonne         1000 kilogram
#   1 ton_force     8896.44 kilogram * meter / second ** 2
#   0.8 um Ra       2.52461e+28 meter * second
#   1"              1 dimensionless
#   1 at            98066.5 kilogram / meter / second ** 2
#   1 b             1e-28 meter ** 2
#   kp, sccm, Torr, HV: refused
# Why it matters: forces of presses are given in tons, roughness as Ra, seats in inches. A wrong dimension is
# found when the quantity is converted; a ton that is 9 % light is not.
# In roughline: Loads are forces or pressures: a ton or a tonne is refused as a load, kp too. Only ton_force is
# still the short one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'pint==0.25.3'
"$folder/env/bin/python" -W error - <<'PYTHON'
import math

import pint

units = pint.UnitRegistry()
expected = {
    "1 ton": 907.18474,
    "1 tonne": 1000.0,
    "1 ton_force": 907.18474 * 9.80665,
    "0.8 um Ra": 0.8e-6 * 1e27 * 365.25 * 86400,
    '1"': 1.0,
    "1 at": 98066.5,
    "1 b": 1e-28,
}
for text, value in expected.items():
    seen = units(text)
    seen = seen.to_base_units() if hasattr(seen, "to_base_units") else units.Quantity(seen)
    print(f"{text:15} {seen.magnitude:.6g} {seen.units}")
    assert math.isclose(seen.magnitude, value, rel_tol=1e-9)
refused = []
for name in ("kp", "sccm", "Torr", "HV"):
    try:
        units(f"1 {name}")
    except pint.UndefinedUnitError:
        refused.append(name)
print(", ".join(refused), end=": refused\n")
assert len(refused) == 4
PYTHON
