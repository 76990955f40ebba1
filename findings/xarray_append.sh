#!/usr/bin/env bash
# Appended to a Zarr store, micrometres become metres, and heights beyond the packing come back as others.
#
# One would guess that to_zarr(append_dim=...) refuses a variable whose units differ from those of the store, and
# one that does not fit into the integers in which the store packs it.
# What happens, xarray 2026.9.0 on Zarr 3.1.6:
#   The attributes of what is appended are dropped and those of the store stay: 3 um is read as 3 m, silently.
#   The packing of the store is kept, too. Beyond 32767 steps the integers go round: 30 um and 40 um, appended to
#   heights in 16 bits of 1 nm, are read as 30 um and -25.5 um. Nothing is said; no number that is far too large
#   gives it away. A first to_zarr of such heights goes round in the same way.
# Output seen (as read, in m):
#   units       1  2  3  4  m
#   packed      1.00e-06  2.00e-06  3.00e-05 -2.55e-05
#   at once     1.00e-06  2.00e-06  3.00e-05 -2.55e-05
# Why it matters: campaigns append one batch after another, made by other hands or other settings. Check the units
# of the store before, and pack only what is known to stay within its range.
# In roughline: A campaign's store has its units and types before the first batch, nothing is packed, and
# nothing is appended.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: 'xarray==2026.9.0' 'zarr==3.1.6' 'numpy==2.4.6'
cd "$folder"
OMP_NUM_THREADS=1 "$folder/env/bin/python" -W error - <<'PYTHON'
import warnings

import numpy as np
import xarray

warnings.filterwarnings("ignore", message="Consolidated metadata is currently not part")
PACKING = {"heights": {"dtype": "int16", "scale_factor": 1e-9, "_FillValue": -32768}}


def of(values, units="m"):
    return xarray.Dataset({"heights": ("row", np.array(values), {"units": units})})


def read(store):
    return xarray.open_zarr(store)["heights"].load()


of([1.0, 2.0]).to_zarr("units.zarr")
of([3.0, 4.0], "um").to_zarr("units.zarr", append_dim="row")
units = read("units.zarr")
print("units      ", *(f"{value:.0f} " for value in units.values), end=f"{units.attrs['units']}\n")
of([1e-6, 2e-6]).to_zarr("packed.zarr", encoding=PACKING)
of([3e-5, 4e-5]).to_zarr("packed.zarr", append_dim="row")
of([1e-6, 2e-6, 3e-5, 4e-5]).to_zarr("once.zarr", encoding=PACKING)
packed, once = read("packed.zarr").values, read("once.zarr").values
print("packed     ", *(f"{value:9.2e}" for value in packed))
print("at once    ", *(f"{value:9.2e}" for value in once))
assert units.values.tolist() == [1, 2, 3, 4] and units.attrs["units"] == "m"
assert np.allclose(packed, [1e-6, 2e-6, 3e-5, 4e-5 - 65536e-9], rtol=1e-9, atol=0)
assert np.array_equal(packed, once)
PYTHON
