"""What commands load: libraries that take long to load stay out where they are not needed."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl

TO_DRAW = {"matplotlib", "reportlab", "bokeh"}
TO_STORE = {"xarray", "pandas", "zarr", "distributed", "h5py", "h5netcdf"}
TO_READ = {"SurfaceTopography"}
TO_SOLVE = {"numba"}
TO_DESCRIBE = {"scipy.stats", "scipy.optimize"}
UNITS = {"pint"}

SIDES = ("--unit", "um", "--size", "1 mm")
LOADED = """
import atexit, sys
{}
before = {{*sys.modules}}
atexit.register(lambda: print(*(sys.modules.keys() - before), file=sys.stderr))
from roughline.cli import main
main()
"""
WRITTEN = """
import numpy
from SurfaceTopography import Topography
from SurfaceTopography.IO.X3P import write_x3p
write_x3p(Topography(numpy.load({!r}), (1000.0, 1000.0), unit="um"), {!r})
"""


def loaded_by(*arguments, after="pass"):
    """Names of the modules that a command has loaded when it ends, beside those of a statement."""
    command = [sys.executable, "-W", "ignore", "-c", LOADED.format(after), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return set(done.stderr.splitlines()[-1].split())


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """One surface as an array, as text, and as a file of our own."""
    folder = tmp_path_factory.mktemp("start_up")
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)
    surface = replace(spectrum.surface(32, 7), unit="m")
    np.save(folder / "map.npy", surface.heights * 1e6)
    np.savetxt(folder / "map.txt", surface.heights * 1e6)
    rl.write(surface, folder / "map.nc")
    return folder


@pytest.mark.parametrize("name", ["map.npy", "map.txt"])
def test_to_describe_an_array_or_text_loads_no_other_library(files, name):
    loaded = loaded_by("info", files / name, *SIDES)
    assert not loaded & (TO_DRAW | TO_STORE | TO_READ | TO_SOLVE | TO_DESCRIBE)


def test_to_describe_our_own_file_loads_no_units(files):
    loaded = loaded_by("info", files / "map.nc")
    allowed = {"h5py", "h5netcdf"}
    assert not loaded & ((TO_DRAW | TO_STORE | TO_READ | TO_SOLVE | TO_DESCRIBE | UNITS) - allowed)


def test_to_press_an_array_loads_nothing_for_figures_and_tables(files):
    loaded = loaded_by("press", files / "map.npy", *SIDES, "--modulus", "110 GPa", "--load", "1 N")
    assert not loaded & (TO_DRAW | TO_STORE | TO_READ | TO_DESCRIBE)
    assert "numba" in loaded


@pytest.mark.parametrize(
    "asked",
    [
        ("--joint-area", "1 cm^2"),
        ("--fluid", "helium", "--inlet", "1 bar", "--outlet", "0 bar", "--seal", "5 mm .. 6 mm"),
    ],
    ids=["a joint", "a fluid"],
)
def test_answers_load_no_registry_of_units(files, asked):
    materials = ("--materials", "steel,copper", "--load", "1 MPa")
    loaded = loaded_by("press", files / "map.npy", *SIDES, *materials, *asked)
    assert not loaded & (TO_DRAW | TO_STORE | TO_READ | TO_DESCRIBE | UNITS)


def test_to_describe_what_an_instrument_measured_loads_its_reader_alone(files, tmp_path):
    """SurfaceTopography, with which the file is written there, loads some libraries itself."""
    written = WRITTEN.format(str(files / "map.npy"), str(tmp_path / "map.x3p"))
    loaded = loaded_by("info", tmp_path / "map.x3p", after=written)
    assert not loaded & (TO_DRAW | TO_STORE | TO_SOLVE | TO_DESCRIBE)


def test_the_lab_serves_its_page_before_it_can_draw():
    code = "import sys; from roughline.lab.site import site; site().page(); print(*sys.modules)"
    made = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not set(made.stdout.split()) & (TO_DRAW | TO_STORE | TO_READ)


def test_the_package_runs_as_a_module():
    command = [sys.executable, "-m", "roughline", "--version"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == f"roughline {rl.__version__}\n"


GARBAGE = """
import atexit, gc
usual = gc.get_threshold()
atexit.register(lambda: print(gc.get_freeze_count() > 30_000, gc.get_threshold() == usual))
from roughline.cli import main
main()
"""


@pytest.mark.parametrize(
    ("command", "is_long"), [("info", False), ("press", True)], ids=["info", "press"]
)
def test_what_stays_is_not_searched_for_garbage(files, command, is_long):
    """When the process ends all of it is frozen; in long work garbage is looked for as usual."""
    asked = ("--modulus", "110 GPa", "--load", "1 N") if is_long else ()
    call = [sys.executable, "-c", GARBAGE, command, files / "map.npy", *SIDES, *asked]
    done = subprocess.run(call, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == f"True {is_long}"
