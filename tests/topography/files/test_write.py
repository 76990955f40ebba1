"""What is written is read back by us and by other programs: heights, sides, unit."""

import hashlib
import zipfile
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
import xarray
from SurfaceTopography import open_topography

import roughline as rl

HEIGHTS = 1e-6 * np.random.default_rng(0).normal(size=(20, 12))  # (x, y) [m]
SIDES = (30e-6, 12e-6)
SURFACE = rl.Surface(HEIGHTS, SIDES, "m", is_cut_out=True)
IN_MICROMETRES = rl.Surface(1e6 * HEIGHTS, (30.0, 12.0), "um", is_cut_out=True)
SINGLE = 2**-24  # the most that rounding to single precision changes, as a share


@pytest.mark.parametrize("surface", [SURFACE, IN_MICROMETRES], ids=["m", "um"])
def test_x3p_has_the_heights_row_by_row_and_their_steps_in_metres(tmp_path, surface):
    rl.write(surface, tmp_path / "map.x3p")
    with zipfile.ZipFile(tmp_path / "map.x3p") as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    main = ElementTree.fromstring(parts["main.xml"])
    assert main.tag == "{http://www.opengps.eu/2008/ISO5436_2}ISO5436_2"
    said = {each.tag: each.text for each in main.iter()}
    assert (said["Revision"], said["FeatureType"]) == ("ISO5436 - 2000", "SUR")
    assert [said[f"Size{axis}"] for axis in "XYZ"] == ["20", "12", "1"]
    axes = {axis.tag: {each.tag: each.text for each in axis} for axis in main.find("Record1/Axes")}
    assert float(axes["CX"]["Increment"]) == pytest.approx(1.5e-6, rel=1e-15)
    assert float(axes["CY"]["Increment"]) == pytest.approx(1e-6, rel=1e-15)
    assert axes["CZ"] == {"AxisType": "A", "DataType": "D", "Increment": "1", "Offset": "0"}
    stored = np.frombuffer(parts[said["PointDataLink"]], "<f8").reshape(12, 20)
    np.testing.assert_allclose(stored, HEIGHTS.T, rtol=1e-15)
    for name, checksum in (
        (said["PointDataLink"], said["MD5ChecksumPointData"]),
        ("main.xml", parts[said["ChecksumFile"]].split()[0].decode()),
    ):
        assert hashlib.md5(parts[name]).hexdigest() == checksum.lower()


@pytest.mark.parametrize("surface", [SURFACE, IN_MICROMETRES], ids=["m", "um"])
def test_gsf_has_the_heights_row_by_row_and_its_sides_in_metres(tmp_path, surface):
    rl.write(surface, tmp_path / "map.gsf")
    content = (tmp_path / "map.gsf").read_bytes()
    magic, *lines = content[: content.index(b"\0")].decode().splitlines()
    assert magic == "Gwyddion Simple Field 1.0"
    said = dict(line.split(" = ") for line in lines)
    assert (said["XRes"], said["YRes"], said["XYUnits"], said["ZUnits"]) == ("20", "12", "m", "m")
    assert (float(said["XReal"]), float(said["YReal"])) == pytest.approx(SIDES, rel=1e-15)
    start = content.index(b"\0") // 4 * 4 + 4
    assert not content[content.index(b"\0") : start].strip(b"\0")
    stored = np.frombuffer(content[start:], "<f4").reshape(12, 20)
    np.testing.assert_allclose(stored, HEIGHTS.T, rtol=SINGLE)


@pytest.mark.parametrize("title", range(1, 5))
def test_a_head_of_gsf_ends_in_zeros_at_a_multiple_of_4(tmp_path, title):
    rl.write(rl.Surface(HEIGHTS[:, :2], (1e-3, float(f"1e-{10 * title}")), "m"), tmp_path / "a.gsf")
    content = (tmp_path / "a.gsf").read_bytes()
    zeros = (len(content) - 20 * 2 * 4) - content.index(b"\0")
    assert 1 <= zeros <= 4
    assert (len(content) - 20 * 2 * 4) % 4 == 0


def test_xarray_reads_heights_and_positions_with_units(tmp_path):
    rl.write(SURFACE, tmp_path / "map.nc")
    with xarray.open_dataset(tmp_path / "map.nc") as data:
        assert data.heights.dims == ("x", "y")
        assert {data[name].attrs["units"] for name in ("heights", "x", "y")} == {"m"}
        np.testing.assert_array_equal(data.heights, HEIGHTS)
        np.testing.assert_allclose(data.x, 1.5e-6 * np.arange(20), rtol=1e-14)
        np.testing.assert_allclose(data.y, 1e-6 * np.arange(12), rtol=1e-14)


@pytest.mark.parametrize("is_cut_out", [True, False])
@pytest.mark.parametrize("surface", [SURFACE, IN_MICROMETRES], ids=["m", "um"])
def test_surface_topography_reads_heights_sides_unit_and_borders(tmp_path, surface, is_cut_out):
    rl.write(replace(surface, is_cut_out=is_cut_out), tmp_path / "map.nc")
    with open_topography(str(tmp_path / "map.nc")) as reader:
        found = reader.topography()
    assert found.physical_sizes == surface.sizes
    assert found.unit.replace("µ", "u") == surface.unit
    assert found.is_periodic is not is_cut_out
    np.testing.assert_array_equal(found.heights(), surface.heights)


def test_surface_topography_reads_lines(tmp_path):
    rl.write(rl.Line(HEIGHTS[:, 0], 1e-3, "m", kind="profile"), tmp_path / "line.nc")
    with open_topography(str(tmp_path / "line.nc")) as reader:
        found = reader.topography()
    assert (found.physical_sizes, found.unit) == ((1e-3,), "m")
    np.testing.assert_array_equal(found.heights(), HEIGHTS[:, 0])


def test_surface_topography_reads_x3p(tmp_path):
    rl.write(SURFACE, tmp_path / "map.x3p")
    with open_topography(str(tmp_path / "map.x3p")) as reader:
        found = reader.topography()
    assert found.physical_sizes == pytest.approx(SIDES, rel=1e-15)
    np.testing.assert_array_equal(found.heights(), HEIGHTS)


@pytest.mark.parametrize(("suffix", "rtol"), [("nc", 0), ("x3p", 0), ("gsf", SINGLE)])
def test_we_read_what_we_write(tmp_path, suffix, rtol):
    if suffix == "gsf":
        pytest.importorskip("roughline.topography.files.gsf")
    rl.write(SURFACE, tmp_path / f"map.{suffix}")
    found = rl.read(tmp_path / f"map.{suffix}", trend="none")
    assert found.sizes == pytest.approx(SIDES, rel=1e-15)
    assert found.is_cut_out
    np.testing.assert_allclose(found.heights, HEIGHTS, rtol=rtol)


@pytest.mark.parametrize("suffix", ["nc", "x3p", "gsf"])
def test_bytes_depend_on_the_surface_alone(tmp_path, suffix):
    content = []
    for name in ("one", "two"):
        rl.write(SURFACE, tmp_path / f"{name}.{suffix}")
        content.append((tmp_path / f"{name}.{suffix}").read_bytes())
    assert content[0] == content[1]


def test_settings_come_back_as_they_were(tmp_path):
    settings = {"seed": 2**70, "height_factor": 0.1, "origin": "µ \"'", "missing_points": 3}
    rl.write(replace(SURFACE, settings=settings | {"n": np.int64(7)}), tmp_path / "map.nc")
    assert rl.read(tmp_path / "map.nc").settings == settings | {"n": 7, "file": "map.nc"}


def test_a_map_too_large_for_netcdf_3_is_written_as_netcdf_4(tmp_path, monkeypatch):
    monkeypatch.setattr("roughline.topography.files.netcdf._LARGEST_ARRAY", HEIGHTS.nbytes)
    rl.write(SURFACE, tmp_path / "map.nc")
    assert (tmp_path / "map.nc").read_bytes().startswith(b"\x89HDF")
    np.testing.assert_array_equal(rl.read(tmp_path / "map.nc").heights, HEIGHTS)


@pytest.mark.parametrize(
    ("body", "name", "error", "message"),
    [
        (SURFACE, "map.txt", rl.InputError, 'does not end in ".nc", ".x3p" or ".gsf"'),
        (SURFACE, "map", rl.InputError, 'does not end in ".nc", ".x3p" or ".gsf"'),
        (rl.Line(HEIGHTS[0], 1.0, "m"), "line.x3p", rl.InputError, "a line is written as NetCDF"),
        (replace(SURFACE, unit=None), "map.gsf", rl.UnitError, "the surface states no unit"),
        (replace(SURFACE, heights=HEIGHTS + 10), "map.gsf", rl.InputError, "7 digits, too few"),
        (replace(SURFACE, heights=HEIGHTS * 1e50), "map.gsf", rl.InputError, "7 digits, too few"),
    ],
)
def test_what_a_format_cannot_hold_is_refused(tmp_path, body, name, error, message):
    with pytest.raises(error, match=message):
        rl.write(body, tmp_path / name)
    assert not (tmp_path / name).exists()


def test_a_flat_surface_is_written_as_gsf(tmp_path):
    rl.write(replace(SURFACE, heights=np.full((20, 12), 0.1)), tmp_path / "flat.gsf")
    stored = np.frombuffer((tmp_path / "flat.gsf").read_bytes()[-20 * 12 * 4 :], "<f4")
    assert (stored == np.float32(0.1)).all()


def test_x3pio_reads_x3p(tmp_path):
    x3pio = pytest.importorskip("x3pio")
    rl.write(SURFACE, tmp_path / "map.x3p")
    (layer,) = x3pio.read(tmp_path / "map.x3p").layers
    assert layer.spacing == pytest.approx((1.5e-6, 1e-6), rel=1e-15)
    np.testing.assert_array_equal(layer.z, HEIGHTS.T)


def test_surfalize_reads_x3p(tmp_path):
    surfalize = pytest.importorskip("surfalize")
    surface = rl.Surface(HEIGHTS, (20e-6, 12e-6), "m", is_cut_out=True)  # it warns of oblong pixels
    rl.write(surface, tmp_path / "map.x3p")
    found = surfalize.Surface.load(tmp_path / "map.x3p")
    assert (found.step_x, found.step_y) == pytest.approx((1.0, 1.0), rel=1e-14)
    np.testing.assert_allclose(found.data, 1e6 * HEIGHTS.T, rtol=1e-14)


def test_gsffile_reads_gsf(tmp_path):
    gsffile = pytest.importorskip("gsffile")
    rl.write(SURFACE, tmp_path / "map.gsf")
    heights, said = gsffile.read_gsf(tmp_path / "map.gsf")
    assert (said["XReal"], said["YReal"]) == pytest.approx(SIDES, rel=1e-15)
    np.testing.assert_allclose(heights, HEIGHTS.T, rtol=SINGLE)


def test_gwyddion_reads_gsf(tmp_path):
    gwyddionpy = pytest.importorskip("gwyddionpy")
    rl.write(SURFACE, tmp_path / "map.gsf")
    found = gwyddionpy.load(tmp_path / "map.gsf").channels["Height"]
    assert (found.xreal, found.yreal) == pytest.approx(SIDES, rel=1e-15)
    assert (found.si_unit_xy, found.si_unit_z) == ("m", "m")
    np.testing.assert_allclose(found.data, HEIGHTS.T, rtol=SINGLE)
