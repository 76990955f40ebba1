"""What ``import roughline`` offers, and what it costs."""

import subprocess
import sys

import pytest

import roughline as rl


def test_every_public_name_is_there():
    for name in rl.__all__:
        assert getattr(rl, name) is not None
    assert set(rl.__all__) <= set(dir(rl))
    with pytest.raises(AttributeError, match="no attribute 'Surfaces'"):
        _ = rl.Surfaces


@pytest.mark.parametrize(
    "first", ["roughline.contact.press", "roughline.cli", "roughline.contact.curve"]
)
def test_names_stay_functions_whatever_is_imported_first(first):
    code = f"import {first}, roughline as rl; assert callable(rl.press) and callable(rl.read)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_importing_loads_no_heavy_library():
    code = "import roughline, sys; print(*sys.modules)"
    loaded = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True
    ).stdout.split()
    heavy = {"numpy", "scipy", "numba", "matplotlib", "xarray", "zarr", "SurfaceTopography", "pint"}
    assert not heavy & set(loaded)


def test_numerics_load_no_plotting_and_no_tables():
    code = (
        "import roughline as rl, sys\n"
        "s = rl.SelfAffine(hurst=0.5, rms_height=1.0)\n"
        "rl.press(s.surface(8, 1), E_star=1.0, depths=[0.1])\n"
        "print(*sys.modules)"
    )
    loaded = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True
    ).stdout.split()
    assert not {"matplotlib", "xarray", "pandas", "zarr"} & set(loaded)
