"""Unit and sides of a file: stated or given, metres in the end."""

import re

import numpy as np
import pytest

import roughline as rl

SPECTRUM = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)


def write_with_the_library(path, heights, sizes, unit):
    """Write a topography through SurfaceTopography's own NetCDF writer."""
    from SurfaceTopography import Topography

    Topography(heights, sizes, unit=unit).to_netcdf(str(path))


@pytest.mark.parametrize(("unit", "metres"), [("m", 1.0), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9)])
def test_a_surface_is_the_same_in_every_unit(tmp_path, unit, metres):
    surface = SPECTRUM.surface(24, 7)
    path = tmp_path / "map.nc"
    write_with_the_library(path, surface.heights / metres, (1e-3 / metres, 1e-3 / metres), unit)
    found = rl.read(path, trend="none")
    assert found.unit == "m"
    assert found.sizes == pytest.approx((1e-3, 1e-3), rel=1e-7)  # the writer keeps them in float32
    assert found.heights == pytest.approx(surface.heights, rel=1e-9, abs=1e-18)


def test_a_file_without_unit_is_refused_until_one_is_given(tmp_path):
    path = tmp_path / "body.nc"
    rl.write(SPECTRUM.surface(16, 7), path)
    with pytest.raises(rl.UnitError, match="body.nc states no unit; give the unit"):
        rl.read(path)
    found = rl.read(path, unit="mm")
    assert found.sizes == pytest.approx((1e-6, 1e-6))
    with pytest.raises(rl.UnitError, match='unit is "parsnip"'):
        rl.read(path, unit="parsnip")
    rl.write(found, path)
    with pytest.raises(rl.UnitError, match='states its unit, m; leave unit="nm" out'):
        rl.read(path, unit="nm")


@pytest.mark.parametrize("side", ["1e-310", "1e-150", "1e200"])
def test_a_side_that_is_no_length_is_refused_with_its_file(tmp_path, invoke, side):
    heights = np.random.default_rng(0).normal(size=(12, 9)).astype("<f4")
    head = f"Gwyddion Simple Field 1.0\nXRes = 9\nYRes = 12\nXReal = {side}\nYReal = 8e-06\n"
    head = f"{head}XYUnits = m\nZUnits = m\n".encode()
    path = tmp_path / "map.gsf"
    path.write_bytes(head + bytes(4 - len(head) % 4) + heights.tobytes())
    with pytest.raises(rl.InputError, match=re.escape(f"sides of {float(side):.6g} x 8e-06 m")):
        rl.read(path)
    code, out, errors = invoke("info", path)
    assert (code, out) == (2, "")
    assert len(errors.splitlines()) == 1


def test_a_text_scan_without_unit_is_refused_until_one_is_given(tmp_path):
    path = tmp_path / "scan.txt"
    x = np.linspace(0, 10, 50) ** 1.1
    np.savetxt(path, np.stack([x, np.sin(x)], axis=1))
    with pytest.raises(rl.UnitError, match="states no unit"):
        rl.read(path)
    line = rl.read(path, unit="um")
    assert (line.kind, line.unit) == ("profile", "m")
    assert line.length == pytest.approx((x[-1] - x[0]) * 1e-6, rel=0.03)


def test_plain_arrays_need_sizes_and_a_unit(tmp_path):
    surface = SPECTRUM.surface(24, 7)
    path = tmp_path / "map.npy"
    np.save(path, surface.heights * 1e6)
    with pytest.raises(rl.UnitError, match="states no unit"):
        rl.read(path, sizes=1e-3)
    with pytest.raises(rl.InputError, match="states no sizes for its 24 x 24 points"):
        rl.read(path, unit="um")
    found = rl.read(path, unit="um", sizes=1000, trend="none")
    assert found.heights == pytest.approx(surface.heights, rel=1e-12)
    text = tmp_path / "map.txt"
    np.savetxt(text, surface.heights * 1e6)
    found = rl.read(text, unit="um", sizes=(1000, 2000), trend="none")
    assert found.sizes == pytest.approx((1e-3, 2e-3))
    assert sorted(found.heights.ravel()) == pytest.approx(sorted(surface.heights.ravel()))


@pytest.mark.parametrize(
    ("sizes", "unit", "metres"),
    [
        (1000, "um", (1e-3, 1e-3)),
        ((1000, 500.0), "um", (1e-3, 0.5e-3)),
        (np.array([1.0, 2.0]), "mm", (1e-3, 2e-3)),
        ("1 mm, 0.5 mm", "um", (1e-3, 0.5e-3)),
        ("1 mm", "nm", (1e-3, 1e-3)),
        (("1 mm", 500), "um", (1e-3, 0.5e-3)),
    ],
)
def test_sizes_are_in_the_unit_of_the_file_or_in_their_own(tmp_path, sizes, unit, metres):
    path = tmp_path / "map.npy"
    np.save(path, np.random.default_rng(0).normal(size=(24, 24)))
    assert rl.read(path, unit=unit, sizes=sizes).sizes == pytest.approx(metres)


def test_sizes_without_a_unit_given_are_in_metres(tmp_path):
    """A file that states its unit but no sizes: the caller has named no unit to count in."""
    path = tmp_path / "map.asc"
    path.write_text("# Value units: nm\n" + "1 2 4 3\n" * 4)
    found = rl.read(path, sizes=1e-3, trend="none")
    assert found.sizes == pytest.approx((1e-3, 1e-3))
    assert found.heights.max() == pytest.approx(4e-9)


@pytest.mark.parametrize(
    ("sizes", "message"),
    [
        ((1e-3,) * 3, 'give 2 positive lengths, such as "1 mm, 0.5 mm"; numbers without a unit'),
        (-1.0, "give 2 positive lengths"),
        (float("nan"), "give 2 positive lengths"),
        (1e-4, "give 2 positive lengths"),
        (None, "states no sizes for its 24 x 36 points"),
        ([[1, 2], [3, 4]], "give 2 positive lengths"),
        (("1 mm", None), "give 2 positive lengths"),
        ("1, 2", 'sizes is "1", without a unit'),
        ("0,5 mm, 1 mm", 'with a comma in "0,5"'),
        ("1 mm, 2 parsnip", "is no quantity in m"),
    ],
)
def test_sizes_that_cannot_be_get_one_line(tmp_path, sizes, message):
    path = tmp_path / "map.npy"
    np.save(path, np.random.default_rng(0).normal(size=(24, 36)))
    with pytest.raises(rl.InputError, match=message):
        rl.read(path, unit="um", sizes=sizes)
