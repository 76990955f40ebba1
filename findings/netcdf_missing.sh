#!/usr/bin/env bash
# Missing points of a NetCDF file are heights in xarray and SciPy, unless the file names their number.
#
# One would guess that programs which apply scale_factor and _FillValue by the same conventions (CF) agree on
# which points are missing.
# What happens, netCDF4 1.7.5.1.post1, xarray 2026.9.0, SciPy 1.17.1, one file of 16-bit integers in 0.5 nm
# with valid_range = -1000 to 1000 and without _FillValue:
#   netCDF4 takes as missing what lies outside valid_range, and -32767, which the library itself puts where
#   nothing was written. xarray, with either engine, and SciPy look at _FillValue and missing_value only: all
#   are heights, and nothing is said. xarray keeps valid_range among the attributes, still in whole numbers.
# Output seen (nm):
#   stored              -1000        0     1000     1001    30000  nothing
#   netCDF4            -500.0      0.0    500.0       --       --       --
#   xarray, netcdf4    -500.0      0.0    500.0    500.5  15000.0 -16383.5
#   xarray, scipy      -500.0      0.0    500.0    500.5  15000.0 -16383.5
#   SciPy              -500.0      0.0    500.0    500.5  15000.0 -16383.5
# Why it matters: the points that an instrument rules out by its range, and lines of a scan that ended early,
# come back as the highest peak and the deepest pit of the map.
# In roughline: What lies outside valid_range, valid_min or valid_max is missing, and so is what the library
# puts where nothing was written.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: \
  'netCDF4==1.7.5.1.post1' 'xarray==2026.9.0' 'scipy==1.17.1' 'numpy==2.4.6'
cd "$folder"
OMP_NUM_THREADS=1 "$folder/env/bin/python" -W error - <<'PYTHON'
import netCDF4
import numpy as np
import xarray
from scipy.io import netcdf_file

STORED = (-1000, 0, 1000, 1001, 30000)  # and a sixth point that is never written

with netCDF4.Dataset("map.nc", "w", format="NETCDF3_CLASSIC") as file:
    file.createDimension("x", len(STORED) + 1)
    heights = file.createVariable("heights", "i2", ("x",))
    heights.set_auto_maskandscale(False)
    heights.units, heights.scale_factor = "nm", 0.5
    heights.valid_range = np.array([-1000, 1000], "i2")
    heights[: len(STORED)] = STORED


def by_netcdf4():
    with netCDF4.Dataset("map.nc") as file:
        return np.ma.filled(file["heights"][:].astype(float), np.nan)


def by_xarray(engine):
    with xarray.open_dataset("map.nc", engine=engine) as file:
        assert list(file["heights"].attrs["valid_range"]) == [-1000, 1000]
        return file["heights"].values


def by_scipy():
    with netcdf_file("map.nc", mmap=False, maskandscale=True) as file:
        return np.ma.filled(file.variables["heights"][:].astype(float), np.nan)


def show(name, values):
    print(f"{name:16}", *("      --" if np.isnan(value) else f"{value:8.1f}" for value in values))
    return values


print(f"{'stored':16}", *(f"{value:8}" for value in STORED), " nothing")
masked = show("netCDF4", by_netcdf4())
kept = [show(f"xarray, {engine}", by_xarray(engine)) for engine in ("netcdf4", "scipy")]
kept.append(show("SciPy", by_scipy()))
assert np.array_equal(masked, [-500, 0, 500, np.nan, np.nan, np.nan], equal_nan=True)
for values in kept:
    assert np.array_equal(values, [-500, 0, 500, 500.5, 15000, -32767 / 2])
PYTHON
